"""Whether somebody's file can be imported: tried in a process of its own before the program does.

A file that ends the process, crashes it or never comes back cannot be caught by whoever imports it.
Tried, it costs that process alone, and is refused with what it did. What was found fine is kept by
the digest of the file and of the program's version, so that the next start does not pay for it;
what failed is tried again by the next program, for a package may have been installed meanwhile.

A trial is no judge of a file that means harm: what it does there it does with all rights of the
user, and it may do something else the next time.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import signal
import subprocess
from pathlib import Path
from typing import Final

from app import __version__
from app.core import paths
from app.core.child_process import environment, interpreter
from app.core.files import read_at_most, write_atomically

SECONDS: Final = 5
"""Processor time that an import may take at the least [s].

All of numpy, scipy, vtk and OpenCV with a compiled function takes 2.2 s on a computer where numpy
and numba alone, which the process imports first, take 0.23 s. A slow one takes longer for both, so
an import may take `TIMES` as long as those two, up to `MOST`: a file that loops ends after 5 s on
that computer, and an honest one is not refused on another four times as slow."""

TIMES: Final = 20
MOST: Final = 20
"""Processor time that no import may exceed [s], whatever importing those two has taken."""

MACHINE: Final = 4
"""How many times as long a file of a folder of its own may take: a machine is compiled when it is
imported, which takes 6 s by itself on a busy computer, and what it calls as well the first time."""

CLOCK: Final = 120.0
"""Time on the clock that it may take [s]."""

_CHILD: Final = """
import importlib, importlib.util, json, os, re, sys, time
path, package, name, least, times, most = *sys.argv[1:4], *map(int, sys.argv[4:7])
answer, said = os.fdopen(os.dup(1), "w"), ""
os.dup2(2, 1)  # what it prints is not the answer
before = time.process_time()
import numba, numpy
used = time.process_time()
seconds = round(min(max(least, times * (used - before)), most))
print(seconds, file=answer, flush=True)
try:
    import resource
    seconds += round(used)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
except ImportError:
    pass
try:
    if len(sys.argv) > 7:  # a folder of packages: its files import one another
        importlib.import_module(package).__path__.append(sys.argv[7])
        importlib.import_module(name)
    else:
        specification = importlib.util.spec_from_file_location(name, path)
        module = sys.modules[name] = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(module)
except SystemExit:
    said = "it ends the program (SystemExit)"
except BaseException as error:
    said = f"{type(error).__name__}: {error}"
said = " ".join(re.sub("\\x1b\\[[0-9;]*m", "", said).split())
answer.write(json.dumps(said[:500]))
answer.flush()
os._exit(0)
"""

_failed: dict[str, str] = {}


def import_fault(path: Path, package: str, folder: Path | None = None) -> str:
    """Try to import a file; return why it cannot be, or nothing.

    Args:
        path: the file.
        package: that it would be a module of.
        folder: in which it lies in a folder of its own, with others that it may import; they join
            the package.
    """
    try:
        key = hashlib.sha256(f"{__version__}\n{_CHILD}\n{path}\n".encode() + read_at_most(path))
    except OSError as error:
        return f"it cannot be read: {error.strerror or error}"
    digest = key.hexdigest()[:32]
    if digest in _failed:
        return _failed[digest]
    kept = paths.cache() / "plugins" / digest
    if kept.exists():
        return ""
    fault = _tried(path, package, folder)
    if fault:
        _failed[digest] = fault
    else:
        with contextlib.suppress(OSError):  # a cache that cannot be written: tried again next time
            kept.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(kept, str(path))
    return fault


def _tried(path: Path, package: str, folder: Path | None) -> str:
    parts = (path.stem,) if folder is None else path.relative_to(folder).with_suffix("").parts
    name, more = ".".join((package, *parts)), () if folder is None else (str(folder),)
    longer = 1 if folder is None else MACHINE
    limits = tuple(str(longer * limit) for limit in (SECONDS, TIMES, MOST))
    try:
        done = subprocess.run(
            [*interpreter(), "-c", _CHILD, str(path), package, name, *limits, *more],
            env=environment(),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            timeout=CLOCK,
            check=False,
            start_new_session=True,
        )
    except subprocess.TimeoutExpired:
        return f"it had not come back after {CLOCK:g} s"
    except OSError as error:
        return f"no process can be started to try it: {error.strerror or error}"
    allowed, _, answer = done.stdout.partition("\n")
    if done.returncode in (-getattr(signal, "SIGXCPU", 0), -getattr(signal, "SIGKILL", 0)):
        return (
            f"it had not come back after {allowed or longer * MOST} s of computing; if it only "
            "takes long to compile, try again: what has been compiled is kept"
        )
    try:
        return str(json.loads(answer))
    except ValueError:
        return f"it ends the program (its process ended with code {done.returncode})"
