"""Complications of a biopsy of the lung: how likely, how they run, and how they are answered."""
