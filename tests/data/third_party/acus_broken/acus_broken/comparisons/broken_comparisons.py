"""Broken."""

raise RuntimeError("broken on purpose")


COMPARISON = None
