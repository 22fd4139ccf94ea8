"""The process of a trial, run as a program: see `core.trial`.

It reads a request from its input, lets the program of the room try the file and prints the verdict.
Where it is and in which state is written into a page of memory that outlives it.
"""

import importlib
import json
import mmap
import os
import sys
import sysconfig
import types
from pathlib import Path
from typing import Any, Final

from app.core import plugin_folders
from app.core.errors import AcusError
from app.core.trial import digest_of
from app.core.trial_watch import PAGE, Watch, doing_in

_MEMORY: Final = 4 << 30
"""Memory that the process may take [bytes]."""


def _follow_compiler(watch: Watch) -> None:
    from app.core import compiled  # noqa: F401  (before numba: it says where kernels are cached)

    from numba.core import event  # isort: skip

    class Compiling(event.Listener):
        def on_start(self, event: Any) -> None:
            watch.compiling(1)

        def on_end(self, event: Any) -> None:
            watch.compiling(-1)

    event.register("numba:compile", Compiling())


def _bound() -> None:
    try:
        import resource
    except ImportError:  # Windows: the clock ends it
        return
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_DATA, (_MEMORY, _MEMORY))


def _leave_out(package: str, root: Path) -> None:
    """Let a package be there without its own file having run."""
    bare = types.ModuleType(package)
    bare.__path__ = [str(root.joinpath(*package.split(".")))]
    sys.modules[package] = bare
    above, _, name = package.rpartition(".")
    setattr(importlib.import_module(above), name, bare)


def _files(path: Path, root: Path) -> dict[str, str]:
    """Digests of the files that were imported beside the program's and the libraries' own."""
    libraries = _within(*sysconfig.get_paths().values(), sys.prefix, sys.base_prefix)
    shared = plugin_folders.folder_of(path)
    own = _within(str(root / "app"))
    near = _within(str(shared.path if shared else path.parents[1]))
    names = {getattr(module, "__file__", None) or "" for module in list(sys.modules.values())}
    return {
        name: digest_of(Path(name))
        for name in sorted(names)
        if name.endswith(".py")
        and not name.startswith(own)
        and (name.startswith(near) or not name.startswith(libraries))
    }


def _within(*folders: str) -> tuple[str, ...]:
    return tuple(os.path.join(folder, "") for folder in folders)


def main() -> None:
    """Try what the request names; never returns."""
    request = json.load(sys.stdin)
    answer = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what the file prints is no answer
    _bound()
    root, path = Path(__file__).resolve().parents[2], Path(request["path"])
    verdict: dict[str, Any]
    with open(request["page"], "r+b") as file:
        page = mmap.mmap(file.fileno(), PAGE)
    try:
        for package in request["bare"]:
            _leave_out(package, root)
        program = importlib.import_module(request["program"])
        watch = Watch(page)
        _follow_compiler(watch)
        verdict = program.run(path, request["argument"], watch)
        verdict |= {"seconds": round(watch.seconds, 3), "files": _files(path, root)}
    except AcusError as error:
        verdict = {"reason": str(error)}
    except BaseException as error:
        text = f"{type(error).__name__}: {error}".rstrip(": ")
        verdict = {"reason": f"{path}: {doing_in(page)} does not work: {text} (trial)"}
    answer.write("\n" + json.dumps(verdict))
    answer.flush()
    os._exit(0)  # whatever the file has left running


if __name__ == "__main__":
    main()
