"""What every part of the twin laboratory is to whoever runs it: a program that can be ended."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import IO, Protocol

ROOT = Path(__file__).resolve().parents[2]

FAULTS = ("killed", "hung", "restarted")
"""What happens to each part in turn."""


class Part(Protocol):
    """A program of the laboratory."""

    name: str

    def start(self) -> None:
        """Start it, and return once it works; also after it has been killed or stopped."""

    def kill(self) -> None:
        """End it as a power cut would (SIGKILL)."""

    def hang(self) -> None:
        """Let it stand still (SIGSTOP)."""

    def go_on(self) -> None:
        """Let it go on (SIGCONT)."""

    def stop(self) -> None:
        """End it in an orderly way; idempotent."""


class ProcessPart:
    """A part that is one process.

    Args:
        name: of the part.
        log: what it says on its standard error is added here.
    """

    def __init__(self, name: str, log: Path) -> None:
        self.name, self._log = name, log
        self._process: subprocess.Popen[str] | None = None
        self._err: IO[str] | None = None

    def start(self) -> None:
        self._err = self._log.open("a")
        self._process = subprocess.Popen(
            self.command(), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._err,
            text=True, cwd=ROOT, env=self.environment(),
        )  # fmt: skip

    def command(self) -> list[str]:
        raise NotImplementedError

    def environment(self) -> dict[str, str] | None:
        return None

    @property
    def works(self) -> bool:
        return self._process is not None

    @property
    def pid(self) -> int:
        assert self._process is not None, f"{self.name} has not been started"
        return self._process.pid

    def hear(self) -> str:
        """Return its next line; empty once it has ended."""
        return self._process.stdout.readline().strip()

    def say(self, line: str) -> None:
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()

    def kill(self) -> None:
        self._process.kill()
        self._gone()

    def hang(self) -> None:
        os.kill(self.pid, signal.SIGSTOP)

    def go_on(self) -> None:
        os.kill(self.pid, signal.SIGCONT)

    def stop(self) -> None:
        if self._process is None:
            return
        self._process.send_signal(signal.SIGCONT)
        self._process.terminate()
        try:
            self._process.wait(20)
        except subprocess.TimeoutExpired:
            self._process.kill()
        self._gone()

    def _gone(self) -> None:
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout, self._err):
            with suppress(BrokenPipeError):
                pipe.close()
        self._process = None


def ahead(*how: str) -> list[str]:
    """Return what begins a command that is served before others, where the system lets it.

    Board and cameras are machines of their own, and nothing else runs on the trainer's: here all
    share one.
    """
    allowed = subprocess.run([*how, "true"], capture_output=True, check=False).returncode == 0
    return list(how) if allowed else []


def module(name: str, *words: object) -> list[str]:
    """Return the command of a program of this package."""
    return [sys.executable, "-m", f"tests.twin.{name}", *map(str, words)]


class BrokenRuleError(Exception):
    """A rule of the laboratory is broken; the text says which."""
