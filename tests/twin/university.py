"""The university: a learning record store that keeps what it has on the disk.

`python -m tests.twin.university PORT FILE`: a statement is on the disk before it is answered. While
a file FILE.die is there, the next batch is stored, and the program ends before its answer.
"""

from __future__ import annotations

import json
import os
import signal
import socket
import sys
import time
from collections import Counter
from contextlib import suppress
from pathlib import Path

from tests.twin.part import ROOT, ProcessPart, module

sys.path.append(str(ROOT / "tests" / "exchange"))
from lrs_server import ScriptedLrs


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as one:
        return one.getsockname()[1]


class University(ProcessPart):
    """A record store at one port."""

    def __init__(self, folder: Path) -> None:
        super().__init__("university", folder / "university.log")
        self.port, self._file = free_port(), folder / "statements.jsonl"
        self.url = f"http://127.0.0.1:{self.port}/xAPI"

    def command(self) -> list[str]:
        return module("university", self.port, self._file)

    def start(self) -> None:
        self._file.with_suffix(".die").unlink(missing_ok=True)
        super().start()
        assert self.hear() == "listens"

    def kill_in_answer(self) -> None:
        """Have it die once it has stored the next batch, before it has said so."""
        self._file.with_suffix(".die").touch()

    @property
    def is_dead(self) -> bool:
        return self._process is None or self._process.poll() is not None

    def held(self) -> Counter[str]:
        """Return how often it has each statement, by its id."""
        lines = self._file.read_text().splitlines() if self._file.exists() else []
        return Counter(json.loads(line)["id"] for line in lines)

    def told(self) -> list[dict]:
        """Return all statements."""
        lines = self._file.read_text().splitlines() if self._file.exists() else []
        return [json.loads(line) for line in lines]


class StoreOnDisk(ScriptedLrs):
    """The scripted store, which also answers after a restart for what it took before."""

    def __init__(self, port: int, file: Path) -> None:
        super().__init__()
        self._listening.close()
        self._listening, self.port, self._file = (
            socket.create_server(("127.0.0.1", port)),
            port,
            file,
        )
        if file.exists():
            some = [json.loads(line) for line in file.read_text().splitlines()]
            self.held = {one["id"]: one for one in some}

    def take(self, some: list[dict]) -> bytes:
        answer = super().take(some)
        with self._file.open("a") as out:
            out.writelines(json.dumps(self.held[one["id"]]) + "\n" for one in some)
            out.flush()
            os.fsync(out.fileno())
        if self._file.with_suffix(".die").exists():
            os.kill(os.getpid(), signal.SIGKILL)
        return answer


def main(port: str, file: str) -> None:
    with StoreOnDisk(int(port), Path(file)):
        print("listens", flush=True)
        while True:
            time.sleep(1.0)


if __name__ == "__main__":
    with suppress(KeyboardInterrupt):
        main(*sys.argv[1:])
