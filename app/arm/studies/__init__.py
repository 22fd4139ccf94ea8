"""The arm's studies, one a file."""
