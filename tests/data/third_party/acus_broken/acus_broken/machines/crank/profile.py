raise RuntimeError("broken on purpose")

PROFILE = None
