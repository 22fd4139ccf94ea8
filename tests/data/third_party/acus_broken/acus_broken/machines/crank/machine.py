raise RuntimeError("broken on purpose")


def machine(profile): ...
