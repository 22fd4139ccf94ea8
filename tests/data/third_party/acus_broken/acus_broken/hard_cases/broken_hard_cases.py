"""Broken."""

DECLARATION = {"title": "Broken", "subsystems": {"broken": "nothing"}}

raise RuntimeError("broken on purpose")


CASES = ()
