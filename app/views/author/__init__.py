"""Exercises made and changed in the window."""
