"""Compiled kernels: where they are cached and the one signature of everything in a tick.

Import `njit` from here, never from numba: the cache folder must be set before numba is loaded.
Numba's own cache looks at the file of a kernel only, not at the files it calls; the folder
therefore carries a digest of every file that holds kernels or the constants they are built with
(`Final`), so that an edit in any of them is never run from a stale build.
"""

import atexit
import hashlib
import os
import shutil
import tempfile
from pathlib import Path
from typing import Any

from app.core import paths
from app.core.loading import COMPILED
from app.core.parameters import StageFunction

_ROOMS = ("core", "mechanisms", "imaging", "simulation", "tracking", "device")
_MARKS = (b"app.core.compiled", b": Final")
_KEPT_BUILDS = 12
_OWN = os.path.join(os.path.dirname(os.path.dirname(__file__)), "")
"""Folder of the program, as the files in it name themselves."""


def kernels_digest() -> str:
    """Digest of every file that holds kernels or constants that they are built with."""
    app = Path(__file__).resolve().parents[1]
    digest = hashlib.sha256()
    for room, marks in (*((room, _MARKS) for room in _ROOMS), ("studies", _MARKS[:1])):
        for file in sorted((app / room).rglob("*.py")):
            content = file.read_bytes()
            if any(mark in content for mark in marks):
                digest.update(str(file.relative_to(app)).encode() + content)
    return digest.hexdigest()[:16]


def _cache_folder() -> Path:
    kernels = paths.cache() / "kernels"
    folder = kernels / kernels_digest()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        old = sorted(kernels.iterdir(), key=lambda path: path.stat().st_mtime)[:-_KEPT_BUILDS]
        for path in old:
            shutil.rmtree(path, ignore_errors=True)
    except OSError:
        pass
    if os.access(folder, os.W_OK):
        return folder
    # A read-only home: numba refuses a folder that it cannot write; this run gets its own.
    temporary = Path(tempfile.mkdtemp(prefix="acus-kernels-"))
    atexit.register(shutil.rmtree, temporary, ignore_errors=True)
    return temporary


os.environ.setdefault("NUMBA_CACHE_DIR", str(_cache_folder()))

import numba  # noqa: E402  (after the cache folder is set)
from numba import types  # noqa: E402
from numba.core import event  # noqa: E402
from numba.core.typing.templates import builtin_registry  # noqa: E402
from numba.np import arrayobj  # noqa: E402

STAGE_SIGNATURE = types.void(types.float64[::1], types.float64[::1])
"""`void(state[::1], parameters[::1])`: every stage of a tick. Memory of a stage lives in its own
parameters array."""

STAGE_TYPE = types.FunctionType(STAGE_SIGNATURE)
"""Type of a stage as a first-class function, for the loop's table."""


REORDERED = {"contract", "arcp", "reassoc", "nsz"}
"""For `fastmath`: sums in any order, products and sums in one, a common divisor as a factor. NaN
and infinity keep their meaning, so that checks against them hold."""


def njit(*args: Any, **options: Any) -> Any:
    """Compile as `numba.njit`, release the interpreter lock, cache, and divide as C does.

    What has no signature goes into no table of stages, and needs no wrapper for C (13 % of the time
    that the tracker's kernels compile).
    """
    plain = not args or callable(args[0])
    options = {
        "nogil": True,
        "cache": True,
        "error_model": "numpy",
        "no_cfunc_wrapper": plain,
    } | options
    if plain and args:
        return numba.njit(*args, **options, **_checks(args[0]))

    def compiled(function: Any) -> Any:
        return numba.njit(*args, **options, **_checks(function))(function)

    return compiled


def _checks(function: Any) -> dict[str, bool]:
    """Check every index of a function that is not the program's own, wherever it runs.

    An index outside raises IndexError, which ends the loop at zero force, instead of writing into
    memory of the program.
    """
    is_own = function.__code__.co_filename.startswith(_OWN)
    return {} if is_own else {"boundscheck": True}


def _leave_shapes_out() -> None:
    """Let an assignment of a slice of another size fail without naming both shapes.

    Numba compiles what formats them, with strings of its own, into every kernel that assigns a
    slice: a fifth of the functions and an eighth of the time of the tracker's kernels. `ValueError`
    is raised as before.
    """
    for function, kind in builtin_registry.globals:
        if function is arrayobj.raise_with_shape_context:
            for template in kind.templates:
                if template._overload_func is arrayobj.ol_raise_with_shape_context_cpu:  # noqa: SLF001
                    short = staticmethod(arrayobj.ol_raise_with_shape_context_generic)
                    template._overload_func = short  # noqa: SLF001  (numba offers no other way)


_leave_shapes_out()


class _Counter(event.Listener):
    """Counts what is compiled, not what is loaded."""

    def on_start(self, event: Any) -> None:
        """Do nothing."""

    def on_end(self, event: Any) -> None:
        """Count."""
        COMPILED.add()


event.register("numba:compile", _Counter())


def is_stage(function: Any) -> bool:
    """Whether something has been compiled as a stage of the tick."""
    return STAGE_SIGNATURE.args in getattr(function, "signatures", ())


def stage(function: StageFunction) -> StageFunction:
    """Compile a function of (state, parameters) as a stage of the tick, cached on disk."""
    compiled: StageFunction = njit(STAGE_SIGNATURE)(function)
    return compiled
