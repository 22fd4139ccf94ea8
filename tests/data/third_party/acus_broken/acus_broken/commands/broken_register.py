"""Can be imported, and does not register."""


def register(root):
    raise RuntimeError("broken on purpose")
