"""Locks and seals of open files, where the system has them (Linux); elsewhere nothing is held.

Windows has no `fcntl`. What is only a safeguard there falls away; what would be harm without a
lock is not done.
"""

import errno
import tempfile
from pathlib import Path

try:
    import fcntl
except ImportError:  # pragma: no cover - tested in a process without it
    fcntl = None  # type: ignore[assignment]

_ADD_SEALS = 1033  # fcntl(2), F_ADD_SEALS
SEAL_SEAL, SEAL_SHRINK, SEAL_GROW, SEAL_WRITE = 0x1, 0x2, 0x4, 0x8
"""What `seal` forbids: further seals, a smaller size, a larger size, other content."""


def hold(descriptor: int) -> None:
    """Hold a file together with others (a shared lock) until it is closed.

    Raises:
        OSError: if somebody holds it alone.
    """
    if fcntl is not None:
        fcntl.flock(descriptor, fcntl.LOCK_SH)


def is_held(descriptor: int) -> bool:
    """Return whether somebody else holds a file; True where the system cannot tell."""
    return hold_alone(descriptor) is not True


def hold_alone(descriptor: int) -> bool | None:
    """Hold a file alone until it is closed, unless somebody else holds it (False).

    None where the system cannot tell: it has no locks, or this file system has none.
    """
    if fcntl is None:
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return None
    return True


def has_locks(folder: Path) -> bool:
    """Return whether files in a folder can be locked; True where that cannot be tried."""
    if fcntl is None:
        return True
    try:
        with tempfile.TemporaryFile(dir=folder) as probe:
            fcntl.lockf(probe.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno not in (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL)
    return True


def seal(descriptor: int, seals: int) -> None:
    """Forbid changes of anonymous memory from now on.

    Raises:
        OSError: if it is no memory that can be sealed.
    """
    if fcntl is not None:
        fcntl.fcntl(descriptor, _ADD_SEALS, seals)
