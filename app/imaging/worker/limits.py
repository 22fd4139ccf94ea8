"""What the child may take: memory, processor time, no core dumps."""

import contextlib
from dataclasses import dataclass
from pathlib import Path

import psutil

try:
    import resource
except ImportError:  # Windows: the watchdog alone ends what takes too long
    resource = None  # type: ignore[assignment]

MEMORY_BYTES = 1 << 31
"""Memory that the child may take for one file beside its own [bytes]."""

FILE_SECONDS = 1.5
"""Processor time after which a small file is given up; with what follows nobody waits over 2 s."""

PACKAGE_SECONDS = 10.0
"""The same where a package may have to be loaded first, which the child does when it meets a file
of its kind."""

SECONDS_PER_BYTE = 5e-8
"""What a large file may take beside that: one of many frames has a long header."""

SECONDS_PER_PIXEL = 5e-7
"""What decoding a frame may take beside that; JPEG 2000 needs a quarter of it."""

MOST_SECONDS = 60.0
"""What no file may exceed, however large, without a sign of progress."""

CLOCK_FACTOR = 10.0
"""Time on the clock for each second of computing that is allowed: the machine may be busy."""

LEAST_CLOCK_SECONDS = 20.0
"""Time on the clock that every file gets: a disk may sleep, a network may stall."""

_KILLED_AFTER = 120
"""Seconds of processor time without a sign of progress after which the system itself ends the
child: the program's watchdog comes first, unless the program is gone."""


@dataclass(frozen=True, slots=True)
class Allowance:
    """What a job may take between two signs of progress.

    Attributes:
        seconds: of processor time: a file is judged by what it makes the machine do, not by what
            else the machine has to do.
        bytes: of memory, beside what the child has anyway.
        clock: what may pass on the clock meanwhile [s]; 0 for what `seconds` make of it.
    """

    seconds: float
    bytes: int = MEMORY_BYTES
    clock: float = 0.0

    @property
    def clock_seconds(self) -> float:
        """Return what may pass on the clock meanwhile."""
        return self.clock or max(LEAST_CLOCK_SECONDS, CLOCK_FACTOR * self.seconds)


def for_file(size: int, pixels: int = 0, least: float = FILE_SECONDS) -> Allowance:
    """Return what one file may take.

    Args:
        size: of the file [bytes].
        pixels: to decode.
        least: processor time for the smallest [s].
    """
    seconds = least + size * SECONDS_PER_BYTE + pixels * SECONDS_PER_PIXEL
    return Allowance(min(MOST_SECONDS, seconds))


def size_of(path: Path) -> int:
    """Size of a file [bytes]; 0 where nobody says: the child tells what is wrong with it."""
    try:
        return path.stat().st_size
    except OSError:
        return 0


class MemoryLimit:
    """How far this process may grow beyond what it is now.

    It never writes a core dump, and where the machine runs out of memory it is the first to go,
    not the program.
    """

    def __init__(self) -> None:
        if resource is None:
            return
        self._own = psutil.Process().memory_info().vms
        self._hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        with contextlib.suppress(OSError):  # where the machine runs out, it goes first
            Path("/proc/self/oom_score_adj").write_text("800")

    def set(self, allowed: int) -> None:
        """Let the process grow by so many bytes and no further."""
        if resource is None:
            return
        most = self._own + allowed
        if self._hard != resource.RLIM_INFINITY:
            most = min(most, self._hard)
        with contextlib.suppress(ValueError, OSError):  # macOS bounds no process's memory
            resource.setrlimit(resource.RLIMIT_AS, (most, self._hard))


def limit_time() -> None:
    """Let this process work for a few seconds from now on."""
    if resource is None:
        return
    used = resource.getrusage(resource.RUSAGE_SELF)
    soft = int(used.ru_utime + used.ru_stime) + 1 + _KILLED_AFTER
    resource.setrlimit(resource.RLIMIT_CPU, (soft, resource.RLIM_INFINITY))


def processor_seconds(pid: int) -> float:
    """Processor time that a process has used so far; infinite if there is no such process."""
    try:
        times = psutil.Process(pid).cpu_times()
    except (psutil.NoSuchProcess, psutil.AccessDenied):
        return float("inf")
    return float(times.user + times.system)
