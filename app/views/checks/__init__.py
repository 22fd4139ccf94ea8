"""Checks of the whole set-up: every morning, and of the registration with a fiducial plate."""
