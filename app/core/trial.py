"""The trial of somebody else's code before it may run in the control loop or the tracker.

A process of its own compiles it with every index checked (in a cache of its own) and gives it what
it may meet at the worst; see `core.trial_process`. Code that does not return is ended by the clock,
and a crash takes nothing with it. Force laws, effects, machines and marker extractors are tried by
this one policy, each by a program of its room.

The verdict is kept by the digest of the file and of this build, and counts while every other file
that the trial imported is as it was, so that a start does not pay for it again. Where the trial did
not live to say which files those are, the verdict is kept in memory alone: the next program tries
again. What a trial cannot show, and what bounds it then: docs/decisions/0018.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import mmap
import os
import shutil
import signal
import struct
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

from app.core import paths
from app.core.child_process import environment, module_command
from app.core.errors import AcusError
from app.core.files import read_at_most, write_atomically
from app.core.trial_states import words
from app.core.trial_watch import CLOCK, HEAD, PAGE, PATIENCE, doing_in

_KEPT_BUILDS: Final = 3

_in_memory: Final[dict[Path, dict[str, Any]]] = {}
"""Verdicts of trials that did not say which files they imported, by where they would be kept."""


@dataclass(frozen=True, slots=True)
class Trial:
    """How one kind of code is tried.

    Attributes:
        program: module whose `run(path, argument, watch)` tries a file and returns a verdict.
        bare: packages whose own file that process leaves out: it would compile all beside.
    """

    program: str
    bare: tuple[str, ...] = ()

    def fault(self, path: Path, argument: str = "") -> str:
        """Try a file, or remember its trial; return why it is refused, or nothing."""
        return str(self.verdict(path, argument)["reason"])

    def verdict(self, path: Path, argument: str = "") -> dict[str, Any]:
        """Return what the trial of a file has shown.

        `reason` (empty: accepted), `states` and `seconds` (of processor, beyond compiling) of a
        finished one, `shortest` (array of parameters that was tried), `again` where the next start
        tries again.

        Args:
            path: the file.
            argument: what the trial depends on beside it, such as a device profile.
        """
        if verdict := self.known(path, argument):
            return verdict
        try:
            place = self._place(path, argument)
        except (OSError, AcusError) as error:
            return {"reason": f"{path} cannot be read: {error}"}
        verdict = _run(self, path, argument)
        if verdict.get("again"):
            return verdict
        verdict |= {"path": str(path), "content": digest_of(path), "by": self._by()}
        if not verdict.get("files"):
            _in_memory[place] = verdict
            return verdict
        with contextlib.suppress(OSError, AcusError):  # a cache that cannot be written
            place.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(place, json.dumps(verdict).encode())
        return verdict

    def known(self, path: Path, argument: str = "") -> dict[str, Any]:
        """Return the verdict of a trial that was made before; empty if there was none."""
        try:
            place = self._place(path, argument)
            if place in _in_memory:
                return _in_memory[place]
            verdict = json.loads(place.read_text(encoding="utf-8"))
        except (OSError, ValueError, AcusError):
            return {}
        usable = isinstance(verdict, dict) and isinstance(verdict.get("reason"), str)
        return verdict if usable and _same(verdict.get("files")) else {}

    def refusal(self, path: Path) -> str:
        """Return why a trial of a file has refused it, whatever its argument was; else nothing."""
        verdicts = [*_in_memory.values()]
        for place in sorted(_verdicts().glob("*.json")):
            with contextlib.suppress(OSError, ValueError):
                verdicts.append(json.loads(place.read_text(encoding="utf-8")))
        asked = {"path": str(path), "content": digest_of(path), "by": self._by()}
        for verdict in verdicts:
            if (
                isinstance(verdict, dict)
                and asked.items() <= verdict.items()
                and (not verdict.get("files") or _same(verdict["files"]))
                and verdict["reason"]
            ):
                return str(verdict["reason"])
        return ""

    def _by(self) -> str:
        """Name what tries: the program, and this build of it."""
        return hashlib.sha256(f"{_build()}\n{self.program}".encode()).hexdigest()[:32]

    def _place(self, path: Path, argument: str) -> Path:
        digest = hashlib.sha256(f"{_build()}\n{self.program}\n{path}\n{argument}\n".encode())
        digest.update(read_at_most(path))
        return _verdicts() / f"{digest.hexdigest()[:32]}.json"


def _verdicts() -> Path:
    return paths.cache() / "trials" / "verdicts"


@cache
def _build() -> str:
    from app.core.build import build

    return json.dumps(build())


def digest_of(path: Path) -> str:
    """Digest of a file that a trial imported; empty if it cannot be read."""
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()[:32]
    except OSError:
        return ""


def _same(files: Any) -> bool:
    """Return whether files, path -> digest, are as they were; False where there are none."""
    return (
        isinstance(files, dict)
        and bool(files)
        and all(digest_of(Path(path)) == digest for path, digest in files.items())
    )


def _run(trial: Trial, path: Path, argument: str) -> dict[str, Any]:
    request = {
        "program": trial.program,
        "bare": list(trial.bare),
        "path": str(path),
        "argument": argument,
    }
    surroundings = environment(
        NUMBA_BOUNDSCHECK="1",
        NUMBA_NRT_STATS="1",  # counts what a tick allocates
        NUMBA_CACHE_DIR=str(_kernels()),
    )
    with _page() as (name, page):
        try:
            done = subprocess.run(
                module_command("app.core.trial_process"),
                input=json.dumps(request | {"page": name}),
                env=surroundings,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
                timeout=CLOCK,
                check=False,
                start_new_session=True,
            )
        except subprocess.TimeoutExpired:
            where = f"in the trial {_last_words(page)} had not ended after {CLOCK:g} s"
            return {"reason": f"{path}: {where}; on a busy computer try again", "again": True}
        except OSError as error:
            why = f"no process can be started for its trial: {error}"
            return {"reason": f"{path}: {why}", "again": True}
        try:
            verdict: dict[str, Any] = json.loads(done.stdout.rsplit("\n", 1)[-1])
        except ValueError:
            waited = done.returncode == -getattr(signal, "SIGALRM", 0)
            return {"reason": f"{path}: {_ended(done.returncode, page)}", "again": waited}
    return verdict


@contextlib.contextmanager
def _page() -> Iterator[tuple[str, mmap.mmap]]:
    with tempfile.TemporaryDirectory(prefix="acus-trial-") as folder:
        name = str(Path(folder) / "page")
        Path(name).write_bytes(struct.pack(HEAD, -1, 0.0).ljust(PAGE, b"\0"))
        with Path(name).open("r+b") as file, mmap.mmap(file.fileno(), PAGE) as page:
            yield name, page


def _last_words(page: mmap.mmap) -> str:
    """Say what the process did last."""
    number, _ = struct.unpack_from(HEAD, page)
    doing = doing_in(page)
    if number < 0:
        return doing
    return f"{doing} in state {number} ({words(number)})"


def _ended(code: int, page: mmap.mmap) -> str:
    place, (_, allowed) = _last_words(page), struct.unpack_from(HEAD, page)
    if code in (-getattr(signal, "SIGPROF", 0), -getattr(signal, "SIGALRM", 0)):
        if code == -signal.SIGALRM:
            return f"in the trial {place} waits: it had not returned after {PATIENCE:g} s or more"
        return (
            f"in the trial {place} did not return within {allowed:g} s; a tick has 1 ms: loop over"
            " a fixed range of numbers, and wait for nothing"
        )
    by = f"by {signal.Signals(-code).name}" if code < 0 else f"with code {code}"
    return f"in the trial {place} ended its process {by}; it must return"


def _kernels() -> Path:
    """Folder of what this build compiles with every index checked; the oldest builds' go."""
    from app.core.compiled import kernels_digest

    folder = paths.cache() / "trials" / kernels_digest()
    with contextlib.suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        others = [path for path in folder.parent.iterdir() if path.name != "verdicts"]
        for old in sorted(others, key=lambda path: path.stat().st_mtime)[:-_KEPT_BUILDS]:
            shutil.rmtree(old, ignore_errors=True)
    return folder
