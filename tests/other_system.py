"""What macOS and Windows lack of the standard library, hidden from the program on Linux.

`imitate(name)` is called before anything of Acus is imported, in every process of it. Only the
modules of Acus see a system that lacks things: the library and other packages have their own ways
there, which cannot be had here. What the program would do with a descriptor, a lock or a folder
that the other system does not have ends in the error of that system.
"""

import builtins
import errno
import importlib
import io
import logging
import mmap
import os
import sys
from pathlib import Path

LINUX_ONLY = {
    "os": (
        *("memfd_create", "MFD_CLOEXEC", "MFD_ALLOW_SEALING", "posix_fallocate", "posix_fadvise"),
        *("sched_setscheduler", "sched_setaffinity", "sched_getaffinity", "sched_param"),
        *("SCHED_FIFO", "SCHED_IDLE", "eventfd", "fdatasync", "O_DIRECT", "O_TMPFILE"),
    ),
    "socket": ("AF_NETLINK", "AF_PACKET", "SO_PEERCRED"),
    "signal": ("sigtimedwait", "SIGPWR"),
    "time": ("CLOCK_BOOTTIME",),
    "select": ("epoll",),
}
"""By module; from the *Availability* notes of the library's manual (Python 3.11)."""

UNIX_ONLY = {
    "os": (
        *LINUX_ONLY["os"],
        *(
            "getuid",
            "geteuid",
            "getgid",
            "setuid",
            "fork",
            "forkpty",
            "killpg",
            "getpgid",
            "setsid",
        ),
        *(
            "pread",
            "pwrite",
            "preadv",
            "pwritev",
            "sysconf",
            "statvfs",
            "mkfifo",
            "fchmod",
            "fchown",
        ),
        *("chown", "openpty", "ttyname", "nice", "getpriority", "set_blocking", "get_blocking"),
        *("sync", "uname", "getloadavg", "register_at_fork", "sendfile", "posix_spawn", "wait3"),
        *("O_NONBLOCK", "O_CLOEXEC", "O_DIRECTORY", "O_NOFOLLOW", "O_NOCTTY", "O_SYNC"),
    ),
    "socket": (
        *LINUX_ONLY["socket"],
        *("AF_UNIX", "send_fds", "recv_fds", "CMSG_SPACE", "CMSG_LEN", "SCM_RIGHTS"),
    ),
    "signal": (
        *LINUX_ONLY["signal"],
        *("SIGKILL", "SIGHUP", "SIGALRM", "SIGXCPU", "SIGUSR1", "SIGSTOP", "SIGCONT", "SIGCHLD"),
        *("setitimer", "ITIMER_PROF", "ITIMER_REAL", "pthread_sigmask", "sigwait", "alarm"),
    ),
    "time": (
        *LINUX_ONLY["time"],
        "clock_gettime",
        "clock_gettime_ns",
        "CLOCK_MONOTONIC",
        "pthread_getcpuclockid",
    ),
    "select": (*LINUX_ONLY["select"], "poll"),
    "mmap": ("MAP_PRIVATE", "MAP_SHARED", "MAP_ANONYMOUS", "PROT_READ"),
}

NO_MODULES = ("fcntl", "resource", "pty", "tty", "termios", "grp", "pwd")
"""Modules that Windows lacks."""


class Lacking:
    """A module of the library without some of its names, and with others in their place."""

    def __init__(self, module, absent, instead):
        self.__dict__.update(_module=module, _absent=frozenset(absent), **instead)

    def __getattr__(self, name):
        if name in self._absent:
            raise AttributeError(f"module {self._module.__name__!r} has no attribute {name!r} here")
        return getattr(self._module, name)

    def __setattr__(self, name, value):
        setattr(self._module, name, value)


class NamedMemory(mmap.mmap):
    """`mmap.mmap` of Windows: memory of a name, for as long as somebody has it."""

    def __new__(cls, fileno, length, tagname=None, access=mmap.ACCESS_WRITE, offset=0):
        if tagname is None:
            return super().__new__(cls, fileno, length, access=access, offset=offset)
        place = Path("/dev/shm") / f"imitated-{tagname}"
        descriptor = os.open(place, os.O_RDWR | os.O_CREAT, 0o600)
        try:
            if os.fstat(descriptor).st_size < length:
                os.ftruncate(descriptor, length)
            return super().__new__(cls, descriptor, length)
        finally:
            os.close(descriptor)


def _opens_no_folder(path, flags, mode=0o777, *, dir_fd=None):
    if isinstance(path, str | bytes | os.PathLike) and os.path.isdir(path):
        raise PermissionError(errno.EACCES, "Permission denied", str(path))  # as on Windows
    return os.open(path, flags, mode, dir_fd=dir_fd)


def _without_proc(opened):
    """Let nobody of Acus open anything in /proc, also through pathlib."""

    def refused(path, *given, **more):
        text = os.fspath(path) if isinstance(path, str | os.PathLike) else ""
        if str(text).startswith("/proc/") and _asked_by_acus():
            raise FileNotFoundError(errno.ENOENT, "No such file or directory", str(text))
        return opened(path, *given, **more)

    return refused


def _asked_by_acus():
    frame = sys._getframe(2)
    for _ in range(4):
        if frame is None:
            return False
        if str(frame.f_globals.get("__name__", "")).split(".")[0] in ("app", "acus"):
            return True
        frame = frame.f_back
    return False


def imitate(system, log=""):
    """Hide what a system lacks: `macos` or `windows`; write a log of the process where asked to."""
    absent = LINUX_ONLY if system == "macos" else UNIX_ONLY
    instead = {}
    if system == "windows":
        instead = {"mmap": {"mmap": NamedMemory}, "os": {"open": _opens_no_folder}}
    lacking = {
        name: Lacking(importlib.import_module(name), names, instead.get(name, {}))
        for name, names in absent.items()
    }
    whole = builtins.__import__

    def imported(name, globals=None, locals=None, fromlist=(), level=0):
        asking = str((globals or {}).get("__name__", "")).split(".")[0]
        if asking not in ("app", "acus") or level:
            return whole(name, globals, locals, fromlist, level)
        if system == "windows" and name in NO_MODULES:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        if name in lacking:
            for wanted in fromlist or ():
                if wanted in absent[name]:
                    raise ImportError(f"cannot import name {wanted!r} from {name!r}")
            return lacking[name]
        return whole(name, globals, locals, fromlist, level)

    builtins.__import__ = imported
    io.open = builtins.open = _without_proc(builtins.open)
    if log:
        logging.basicConfig(filename=log, level=logging.DEBUG)
        logging.getLogger("numba").setLevel(logging.WARNING)
        logging.captureWarnings(True)
        logging.getLogger(__name__).info("the log is open")
