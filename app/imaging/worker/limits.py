"""What the child may take: memory, processor time, no core dumps."""

import resource
from pathlib import Path

MEMORY_BYTES = 1 << 31
"""Memory that the child may take for one file beside its own [bytes]."""

FILE_SECONDS = 1.5
"""Processor time after which a small file is given up; with what follows nobody waits over 2 s."""

SECONDS_PER_BYTE = 5e-8
"""What a large file may take beside that: one of many frames has a long header."""

SECONDS_PER_PIXEL = 5e-7
"""What decoding a frame may take beside that; JPEG 2000 needs a quarter of it."""

MOST_SECONDS = 30.0
"""What no file may exceed, however large."""

WAITING_SECONDS = 20.0
"""Time on the clock after which a file is given up: a disk may sleep, a network may stall."""

_KILLED_AFTER = 60
"""Seconds of processor time on one file after which the system itself ends the child: the
program's watchdog comes first, unless the program is gone."""


def limit_memory() -> None:
    """Let this process grow by `MEMORY_BYTES` and no further; never write a core dump."""
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    most = pages * resource.getpagesize() + MEMORY_BYTES
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    if hard != resource.RLIM_INFINITY:
        most = min(most, hard)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def limit_time() -> None:
    """Let this process work for a few seconds from now on."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    soft = int(used.ru_utime + used.ru_stime) + 1 + _KILLED_AFTER
    resource.setrlimit(resource.RLIMIT_CPU, (soft, resource.RLIM_INFINITY))


def processor_seconds(pid: int) -> float:
    """Processor time that a process has used so far; infinite if there is no such process."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return float("inf")
    fields = text[text.rindex(")") + 2 :].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS


def _ticks() -> int:
    import os

    return os.sysconf("SC_CLK_TCK")


_TICKS = _ticks()
