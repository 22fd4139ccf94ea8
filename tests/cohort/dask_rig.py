"""Dask's own scheduler and workers as programs of their own, and `acus` as somebody runs it."""

import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def environment(**more):
    return os.environ | {"PYTHONPATH": str(ROOT), "COLUMNS": "300"} | more


def acus(*words, folder, **more):
    """Run a command; return its code, and what it wrote on both streams."""
    done = subprocess.run(
        [sys.executable, "-P", "-m", "acus", *map(str, words)],
        cwd=folder, env=environment(**more), capture_output=True, text=True, timeout=400,
    )  # fmt: skip
    return done.returncode, done.stdout, done.stderr


def begun(*words, folder, **more):
    """Begin a command."""
    return subprocess.Popen(
        [sys.executable, "-P", "-m", "acus", *map(str, words)],
        cwd=folder, env=environment(**more), text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip


def free_port():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return free.getsockname()[1]


class Dask:
    """A scheduler and its workers; all end with it."""

    def __init__(self, folder, host="127.0.0.1"):
        self.folder, self.port = folder, free_port()
        self.address = f"tcp://127.0.0.1:{self.port}"
        self._programs = []
        self.scheduler = self._begin(
            "scheduler", "--host", host, "--port", self.port, "--dashboard-address", "127.0.0.1:0"
        )
        self._wait(lambda: self._answers(), "no scheduler")

    def worker(self, **more):
        """Begin a worker without anybody who begins it anew; return its program."""
        return self._begin(
            "worker", self.address, "--nthreads", 1, "--no-nanny", "--no-dashboard",
            "--host", "127.0.0.1", "--local-directory", self.folder, **more,
        )  # fmt: skip

    def _begin(self, what, *words, **more):
        program = subprocess.Popen(
            [sys.executable, "-P", "-m", f"distributed.cli.dask_{what}", *map(str, words)],
            cwd=self.folder, env=environment(**more),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self._programs.append(program)
        return program

    def has_workers(self, number, seconds=240.0):
        """Wait until the scheduler knows so many workers; asked by Dask's own client apart."""
        ask = (
            f"import distributed; c = distributed.Client({self.address!r}); "
            f"c.wait_for_workers({number}, timeout={seconds})"
        )
        subprocess.run([sys.executable, "-P", "-c", ask], check=True, capture_output=True)

    def _answers(self):
        with suppress(OSError), socket.create_connection(("127.0.0.1", self.port), 1.0):
            return True
        return False

    @staticmethod
    def _wait(there, otherwise, seconds=60.0):
        end = time.monotonic() + seconds
        while not there():
            assert time.monotonic() < end, otherwise
            time.sleep(0.1)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for program in reversed(self._programs):
            with suppress(ProcessLookupError):
                program.send_signal(signal.SIGKILL)
            program.wait()


def parts(folder):
    """Return the finished parts that lie in a folder by now."""
    return sorted(folder.glob("*.parts/[0-9a-f]*.parquet"))


def wait_for_parts(folder, number, program, seconds=400.0):
    """Wait until so many parts are there, or the program has ended."""
    end = time.monotonic() + seconds
    while len(parts(folder)) < number and program.poll() is None:
        assert time.monotonic() < end, f"{len(parts(folder))} parts"
        time.sleep(0.02)
