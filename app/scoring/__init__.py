"""Metrics, tolerance bands and the score of an attempt."""
