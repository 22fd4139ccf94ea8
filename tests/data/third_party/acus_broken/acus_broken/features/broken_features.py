"""Broken."""

DECLARATION = {"title": "Broken", "after": "robot"}

raise RuntimeError("broken on purpose")


FEATURE = None
