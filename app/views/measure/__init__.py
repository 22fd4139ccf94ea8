"""Measuring in the slices: tools, drawing, list, undo, export."""
