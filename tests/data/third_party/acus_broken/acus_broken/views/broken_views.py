"""Broken."""

DECLARATION = {"view": "broken", "title": "Broken", "reads": ("no_such_slot",)}

raise RuntimeError("broken on purpose")
