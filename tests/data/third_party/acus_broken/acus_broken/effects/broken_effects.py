"""Broken."""

DECLARATION = {"title": "Broken", "reads": (), "writes": ("force",), "consumers": (), "needs": (), "models": {"a": "b"}, "energy": ("active", "it is"), "cost_class": "A", "parameters": {}}

raise RuntimeError("broken on purpose")


def parameters(values, binding): ...


def step(state, p): ...
