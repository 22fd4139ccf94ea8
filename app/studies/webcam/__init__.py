"""Conditions and trials of the study of the pen."""
