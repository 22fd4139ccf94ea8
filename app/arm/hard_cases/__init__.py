"""The arm's hard cases; a file that defines `CASES` is in the register."""
