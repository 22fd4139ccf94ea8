"""Cameras: what they are, which there are, and whether they are well."""
