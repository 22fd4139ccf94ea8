"""Compiled kernels: where they are cached and the one signature of everything in a tick.

Import `njit` from here, never from numba: the cache folder must be set before numba is loaded.
Numba's own cache looks at the file of a kernel only, not at the files it calls; the folder
therefore carries a digest of every file that holds kernels or the constants they are built with
(`Final`), so that an edit in any of them is never run from a stale build. The program's own folders
of plug-ins count in it. Kernels of somebody else's plug-in lie in a folder of their own, which
carries the digest of his files too: an edit there makes his kernels anew, and nobody else's.
"""

import atexit
import hashlib
import os
import shutil
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FunctionType
from typing import Any

from app.core import paths, plugin_folders
from app.core.loading import COMPILED
from app.core.parameters import StageFunction

_ROOMS = ("core", "mechanisms", "imaging", "simulation", "tracking", "device")
_MARKS = (b"app.core.compiled", b": Final")
_TOPMOST = frozenset(
    ("commands", "comparisons", "demonstrations", "features", "hard_cases", "studies", "views")
)
"""Subfolders of a folder of plug-ins whose constants no kernel but their own is built with."""
_KEPT_BUILDS = 12
_OWN = os.path.join(os.path.dirname(os.path.dirname(__file__)), "")
"""Folder of the program, as the files in it name themselves."""


def kernels_digest() -> str:
    """Digest of every file of the program that holds kernels or constants they are built with."""
    app = plugin_folders.APP
    digest = hashlib.sha256()
    for room, marks in (*((room, _MARKS) for room in _ROOMS), ("studies", _MARKS[:1])):
        _take(digest, app / room, marks, app)
    for folder in plugin_folders.folders():
        if folder.is_own:
            for part in sorted(folder.path.iterdir()):
                marks = _MARKS[:1] if part.name in _TOPMOST else _MARKS
                _take(digest, part, marks, app)
    return digest.hexdigest()[:16]


def plugin_digest(file: Path) -> str:
    """Digest of what somebody else's plug-in is compiled from; empty for a file of the program.

    Args:
        file: of the plug-in, in a folder of plug-ins or in a machine's folder of the user's own.
    """
    if file.is_relative_to(plugin_folders.APP):
        return ""
    shared, places = plugin_folders.folder_of(file), paths.plugin_places("mechanisms")
    if shared is not None:
        folder = shared.path
    elif own := next((place for place in places if file.is_relative_to(place)), None):
        folder = own / file.relative_to(own).parts[0]
    else:
        return ""
    digest = hashlib.sha256()
    _take(digest, folder, _MARKS, folder)
    return digest.hexdigest()[:16]


def _take(digest: Any, place: Path, marks: tuple[bytes, ...], root: Path) -> None:
    """Let a file, or all files in a folder, that one of these marks is in count in a digest."""
    for file in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
        content = file.read_bytes() if file.suffix == ".py" else b""
        if any(mark in content for mark in marks):
            digest.update(str(file.relative_to(root)).encode() + content)


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
from numba.core import event, typeinfer  # noqa: E402
from numba.core.compiler_lock import global_compiler_lock  # noqa: E402
from numba.core.registry import CPUDispatcher  # noqa: E402
from numba.core.typing.templates import builtin_registry  # noqa: E402
from numba.np import arrayobj  # noqa: E402

_CHOOSING = threading.RLock()


def complete_file(part: str, made_by: bytes = b"") -> Path:
    """Return the file in the cache that says that it holds every kernel of some part.

    Numba keeps what was compiled apart by the folder of its source: another copy of the program,
    equal to the last byte, finds none of it.

    Args:
        part: a word for what is compiled.
        made_by: what chooses the kernels of that part, beside their sources.
    """
    place = hashlib.sha256(made_by + str(Path(__file__).resolve()).encode()).hexdigest()[:8]
    version = f"{sys.version_info.major}.{sys.version_info.minor}-numba-{numba.__version__}"
    return Path(os.environ["NUMBA_CACHE_DIR"]) / f"{part}-{version}-{place}"


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
    plain = not args or isinstance(args[0], FunctionType)
    options = {
        "nogil": True,
        "cache": True,
        "error_model": "numpy",
        "no_cfunc_wrapper": plain,
    } | options
    signature = () if plain else args

    def compiled(function: FunctionType) -> Any:
        with _cached_for(function):
            return numba.njit(*signature, **options | _checks(function))(function)

    return compiled(args[0]) if plain and args else compiled


def _checks(function: FunctionType) -> dict[str, bool]:
    """Check every index of a function that is not the program's own, wherever it runs.

    An index outside raises IndexError, which ends the loop at zero force, instead of writing into
    memory of the program.
    """
    is_own = function.__code__.co_filename.startswith(_OWN)
    return {} if is_own else {"boundscheck": True}


@contextmanager
def _cached_for(function: FunctionType) -> Iterator[None]:
    """Let a function of somebody else's plug-in be cached by what it is compiled from too."""
    digest = plugin_digest(Path(function.__code__.co_filename))
    if not digest:
        yield
        return
    with _CHOOSING:
        shared = numba.config.CACHE_DIR
        numba.config.CACHE_DIR = str(Path(shared) / f"plugin-{digest}")
        try:
            yield
        finally:
            numba.config.CACHE_DIR = shared


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


class _KernelCounter(event.Listener):
    """Counts what is compiled, not what is loaded."""

    def on_start(self, event: Any) -> None:
        """Do nothing."""

    def on_end(self, event: Any) -> None:
        """Count."""
        COMPILED.add()


event.register("numba:compile", _KernelCounter())


class _WaitingStage(CPUDispatcher):
    """A stage that nobody has called, looked at or put into a table; an ordinary kernel then.

    An exercise runs one of several estimators of velocity, and no wire where the robot is
    simulated: what it does not run is not compiled for it. Numba reads what a kernel is compiled
    for from `overloads`, and asks for more by the three methods here.
    """

    @property
    def overloads(self) -> dict[Any, Any]:
        """Return what it is compiled for, by its types."""
        self.compile_now()
        compiled: dict[Any, Any] = self.__dict__["overloads"]
        return compiled

    def compile_now(self) -> None:
        """Compile, or load from the cache; whoever asks meanwhile on another thread waits."""
        with global_compiler_lock:
            if type(self) is not _WaitingStage or self.__dict__.get("_begun"):
                return
            self._begun = True
            try:
                with typeinfer.register_dispatcher(self):
                    self.compile(STAGE_SIGNATURE)
                self.disable_compile()
                self.__class__ = CPUDispatcher
            finally:
                del self._begun

    def _compile_for_args(self, *_args: Any, **_named: Any) -> Any:
        self.compile_now()
        return self  # numba calls what it is given with the same arguments

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Return what numba calls it by from another kernel."""
        self.compile_now()
        return CPUDispatcher.get_call_template(self, args, kws)

    def get_function_type(self) -> Any:
        """Return its type as a first-class function."""
        self.compile_now()
        return CPUDispatcher.get_function_type(self)


_WAITING: list[_WaitingStage] = []


def compile_waiting() -> None:
    """Compile every stage of the modules imported so far, as who fills the cache for others."""
    while _WAITING:
        _WAITING.pop().compile_now()


def is_stage(function: Any) -> bool:
    """Return whether something is compiled as a stage of the tick, or will be when it is called."""
    waits = isinstance(function, _WaitingStage)
    return waits or STAGE_SIGNATURE.args in getattr(function, "signatures", ())


def stage(function: StageFunction) -> StageFunction:
    """Compile a function of (state, parameters) as a stage of the tick, cached on disk.

    One of the program's own waits until it is called or put into a table; somebody else's is
    compiled at once, so that the file that it is in is refused where it cannot be.
    """
    if not function.__code__.co_filename.startswith(_OWN):
        compiled: StageFunction = njit(STAGE_SIGNATURE)(function)
        return compiled
    waiting: Any = njit(function, no_cfunc_wrapper=False)
    if isinstance(waiting, CPUDispatcher):  # not where numba compiles nothing
        waiting.__class__ = _WaitingStage
        _WAITING.append(waiting)
    return waiting
