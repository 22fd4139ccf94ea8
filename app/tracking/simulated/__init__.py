"""Simulated cameras that look at the needle."""
