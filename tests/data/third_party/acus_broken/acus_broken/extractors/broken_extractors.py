"""Broken."""

DECLARATION = {"title": "Broken"}

raise RuntimeError("broken on purpose")


def extractor(setup): ...
