"""Structures in the window: list, outlines, surfaces, brush and warnings."""
