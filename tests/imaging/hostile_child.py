"""A child of the worker that misbehaves at files of certain names, as hostile ones make it."""

import os
import signal
import sys
import time
from pathlib import Path

from app.core.progress import Progress
from app.imaging import header_reading
from app.imaging.series import Ignored
from app.imaging.worker import child


class PanicException(BaseException):
    """What packages written in Rust raise."""


def busy(seconds, progress):
    """Compute for ten times as long as is told in between."""
    for step in range(10):
        begin = time.process_time()
        while time.process_time() - begin < seconds:
            pass
        progress.report(step / 10, f"step {step}")


def headers_in(path: Path, settings: Path, progress: Progress):
    if path.name == "crash":
        os.abort()
    if path.name == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    if path.name == "exit":
        os._exit(3)
    while path.name == "hang":
        pass
    if path.name == "sleep":
        time.sleep(60)
    if path.name == "nonsense":
        os.write(int(sys.argv[1]), b"\x04\0\0\0nope")
    if path.name == "huge":
        os.write(int(sys.argv[1]), b"\xff\xff\xff\xff")
    if path.name == "memory":
        return Ignored(path, str(len(bytearray(1 << 40))))
    if path.name == "surprise":
        raise KeyError("DOE^JANE")
    if path.name == "panic":
        raise PanicException("DOE^JANE")
    if path.name == "slow":
        busy(0.2, progress)  # two seconds: longer than a file may take in silence
    if path.name == "wrong":
        return (Ignored(path, "no header"),)
    return Ignored(path, f"read {path.name}")


if __name__ == "__main__":
    header_reading.headers_in = headers_in
    child.main(sys.argv[1])
