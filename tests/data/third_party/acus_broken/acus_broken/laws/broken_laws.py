"""Broken."""

DECLARATION = {"title": "Broken", "reads": (), "writes": ("force",), "energy": ("active", "it is"), "parameters": {}}

raise RuntimeError("broken on purpose")


def parameters(given, profile): ...


def energy_bound(array): ...


def step(state, p): ...
