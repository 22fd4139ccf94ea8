"""Choosing among the series of a folder."""
