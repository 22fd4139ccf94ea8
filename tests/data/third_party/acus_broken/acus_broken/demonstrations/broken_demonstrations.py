"""Broken."""

DECLARATION = {"title": "Broken"}

raise RuntimeError("broken on purpose")
