"""What the arm adds to the window; a file is a feature."""
