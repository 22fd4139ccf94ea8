"""Checks of the whole set-up: every day, and of the registration with a fiducial plate."""
