"""Folders for the time that a program runs, in the system's temporary folder.

Their names say whose they are, by process and the moment it started, so that those of a program
that was killed can be told from those of one that lives, and are swept away by the next.
"""

import os
import re
import shutil
import tempfile
from pathlib import Path

_NAME = re.compile(r"acus-[a-z]+-(\d+)-(\d+)-.*")


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
    """Whether it is a folder, no link, and of this user: others' are theirs to sweep."""
    try:
        return not folder.is_symlink() and folder.is_dir() and folder.stat().st_uid == os.getuid()
    except OSError:
        return False


def _started(pid: int) -> str:
    """When a process started, in ticks since the machine did; empty if there is none."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return ""
    return text[text.rindex(")") + 2 :].split()[19]
