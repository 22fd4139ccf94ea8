"""What the window has more."""
