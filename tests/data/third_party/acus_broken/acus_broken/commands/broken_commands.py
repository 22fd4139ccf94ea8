"""Broken."""

raise RuntimeError("broken on purpose")


def register(root): ...
