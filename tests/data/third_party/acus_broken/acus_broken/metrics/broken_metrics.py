"""Broken."""

DECLARATION = {"title": "Broken", "unit": "mm", "higher_is_better": False, "reads": ()}

raise RuntimeError("broken on purpose")


def compute(trajectory): ...
