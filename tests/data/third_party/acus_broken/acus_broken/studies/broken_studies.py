"""Broken."""

DECLARATION = {"title": "Broken", "question": "Why?", "reference": "none"}

raise RuntimeError("broken on purpose")


STUDY = None
