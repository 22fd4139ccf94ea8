"""Commands about the arm."""
