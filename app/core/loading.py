"""Loading heavy modules beside the window, one thread at a time."""

import threading
import time
from collections.abc import Iterable
from importlib import import_module
from typing import Final

from app.core.progress import Progress

ONE_AT_A_TIME: Final = threading.RLock()
"""Held by whoever imports a heavy module inside a function.

Python locks every module while it is imported. Of two threads that import from the same packages
each can hold what the other waits for; Python then raises a deadlock error in one of them, or hands
it a module that is only half there. Never import under it at the top of a module: that thread
already holds the lock of the module.
"""

_TURN: Final = 1e-3
"""A released lock goes to whoever asks first; this long [s] the loader does not ask again."""


def load_modules(names: Iterable[str], progress: Progress) -> None:
    """Import modules, and between two of them let others have their turn.

    Args:
        names: full names of modules.
        progress: stops the loading between two modules.

    Raises:
        ImportError: if one cannot be imported; says which.
        Cancelled: if `progress` was cancelled.
    """
    modules = tuple(names)
    for number, name in enumerate(modules):
        progress.report(number / len(modules), "loading")
        with ONE_AT_A_TIME:
            import_module(name)
        time.sleep(_TURN)
