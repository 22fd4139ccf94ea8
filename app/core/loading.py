"""Loading heavy modules beside the window, one thread at a time."""

import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Final

from app.core.messages import sentence
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


_LOOK: Final = 0.1
"""How often [s] who waits for a turn says so and may be cancelled."""


class CompiledKernels:
    """Count of the kernels that this process has compiled; a bar of a first start goes by it.

    Attributes:
        count: how many.
    """

    ABOUT: Final = 280
    """Compiled by a whole first start, numba's own among them, but for the tracker's."""

    def __init__(self) -> None:
        self.count = 0
        self._listener: Callable[[], object] = int

    def listen(self, listener: Callable[[], object]) -> None:
        """Have a function called after each kernel, in the thread that compiled it."""
        self._listener = listener

    def add(self) -> None:
        """Count a kernel."""
        self.count += 1
        self._listener()

    @property
    def share(self) -> float:
        """About how far a first start's compiling is, 0 to 0.99."""
        return min(self.count / self.ABOUT, 0.99)


COMPILED: Final = CompiledKernels()


def is_loaded(name: str) -> bool:
    """Return whether a module has been imported, to its end and not only begun."""
    module = sys.modules.get(name)
    spec = getattr(module, "__spec__", None)
    return module is not None and not getattr(spec, "_initializing", False)


@contextmanager
def turn(progress: Progress, *names: str) -> Iterator[None]:
    """Hold `ONE_AT_A_TIME`; as long as somebody else loads, say so and how long already.

    A first start compiles kernels while it imports them: whoever waits for that must be told, and
    must be able to give up. Whoever wants modules alone that are loaded already need not wait:
    another may hold the lock for a minute.

    Args:
        progress: told of the waiting; cancels it.
        names: full names of all modules that are wanted; without any, the turn is waited for.

    Raises:
        Cancelled: if `progress` was cancelled before the turn came.
    """
    if names and all(map(is_loaded, names)):
        yield
        return
    begin = time.monotonic()
    progress.report(0.0)
    while not ONE_AT_A_TIME.acquire(timeout=_LOOK):
        waited = time.monotonic() - begin
        progress.report(
            COMPILED.share,
            sentence(
                "waiting {waited:.0f} s for the program to load (the first start after an "
                "installation compiles, for a minute or two)",
                waited=waited,
            ),
        )
    try:
        yield
    finally:
        ONE_AT_A_TIME.release()


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
        progress.report(number / len(modules), sentence("loading"))
        with ONE_AT_A_TIME:
            import_module(name)
        time.sleep(_TURN)
