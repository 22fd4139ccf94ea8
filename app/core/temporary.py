"""Folders for the time that a program runs, in the system's temporary folder, and temporary names.

They say whose they are, by process and the moment it started, so that those of a program that was
killed can be told from those of one that lives, and are swept away by the next.
"""

import hashlib
import os
import platform
import re
import shutil
import tempfile
from functools import cache
from pathlib import Path
from uuid import uuid4

_NAME = re.compile(r"acus-[a-z]+-(\d+)-(\d+)-.*")


_PROCESS = re.compile(r".*\.([0-9a-f]{8})-(\d+)-(\d+)-[0-9a-f]{32}")


def name_of_process() -> str:
    """Return a new name that tells of which computer and process it is."""
    own = os.getpid()
    return f"{_computer()}-{own}-{_started(own) or 0}-{uuid4().hex}"


def hidden(folder: Path) -> list[str]:
    """Return the names in a folder that begin with a dot; none of one that cannot be read."""
    try:
        return [name for name in os.listdir(folder) if name[0] == "."]
    except OSError:
        return []


def process_has_gone(name: str) -> bool:
    """Return whether a file's name ends in that of a process of this computer that runs no more.

    False where the system does not tell which processes run, and for files of other computers.
    """
    match = _PROCESS.fullmatch(name)
    if match is None or match[1] != _computer() or not tells_processes():
        return False
    return _started(int(match[2])) != match[3]


def tells_processes() -> bool:
    """Return whether this system tells which processes run, and since when."""
    return bool(_started(os.getpid()))


@cache
def _computer() -> str:
    return hashlib.sha256(platform.node().encode()).hexdigest()[:8]


def temporary_folder(kind: str) -> Path:
    """Make a folder of this process, for this user only.

    Args:
        kind: what it is for, small letters.

    Raises:
        OSError: if the temporary folder cannot be written.
    """
    own = os.getpid()
    return Path(tempfile.mkdtemp(prefix=f"acus-{kind}-{own}-{_started(own)}-"))


def sweep_temporary() -> int:
    """Delete the folders of processes that are gone; returns how many there were."""
    swept = 0
    for folder in Path(tempfile.gettempdir()).glob("acus-*-*-*-*"):
        match = _NAME.fullmatch(folder.name)
        if match and _is_own(folder) and _started(int(match[1])) != match[2]:
            shutil.rmtree(folder, ignore_errors=True)
            swept += 1
    return swept


def _is_own(folder: Path) -> bool:
    """Return whether it is a folder, no link, and of this user: others' are theirs to sweep."""
    try:
        owner = os.getuid() if hasattr(os, "getuid") else folder.stat().st_uid
        return not folder.is_symlink() and folder.is_dir() and folder.stat().st_uid == owner
    except OSError:
        return False


def _started(pid: int) -> str:
    """Return when a process started, in ticks since the machine did; empty if none runs."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return ""
    fields = text[text.rindex(")") + 2 :].split()
    return "" if fields[0] in "ZX" else fields[19]  # ended, and nobody has asked how
