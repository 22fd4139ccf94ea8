"""Cameras, marker extraction, stereo and the tracker thread."""
