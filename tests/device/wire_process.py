"""A robot as a process of its own, for tests over a pseudo-terminal."""

import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from app.core import state_vector as sv
from app.core.compiled import stage

CLIENT = """
import sys, time
import numpy as np
from device.wire_process import want_torque
from app.device.control import Loop, Table
from app.device.links.serial_link import SerialLink
from app.mechanisms.profile import load_profile
profile = load_profile(sys.argv[2])
link = SerialLink(sys.argv[1], profile)
stages = link.stages()
want = ("want", want_torque, np.array([0.05, -0.04]))
loop = Loop(Table.of([*stages.read, want], stages.write), profile.rate_hz, link=link)
loop.open()
loop.inbox.write(enabled=1.0)
print("pushing", flush=True)
time.sleep(60)
"""


@stage
def want_torque(state, p):
    """A controller that always wants the same torques."""
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = p[0], p[1]


def wait_for(condition, seconds=60.0, what="it"):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"waited too long for {what}"
        time.sleep(0.01)


class EmulatorProcess:
    """`acus device emulate`, its orders and its record."""

    def __init__(self, folder: Path, profile: str, *options: str) -> None:
        self.profile = profile
        self.path = str(folder / f"robot-{profile}")
        self._record = folder / f"record-{profile}.csv"
        command = [sys.executable, "-m", "app", "device", "emulate", "--profile", profile]
        command += ["--link", self.path, "--record", str(self._record), *options]
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self.hear(self.path)
        self._offset = 0
        self._rest = b""

    def order(self, text: str) -> None:
        """Give an order and wait until it is done."""
        self._process.stdin.write(text + "\n")
        self._process.stdin.flush()
        self.hear(f"ok {text}")

    def hear(self, wanted: str) -> None:
        """Read lines up to a wanted one."""
        for line in self._process.stdout:
            if line.strip() == wanted:
                return
            assert "not understood" not in line, line
        raise AssertionError(f"the emulator ended before it said {wanted!r}")

    def skip(self) -> None:
        """Pass over the rows written so far: 4000 a second, too many to parse for nothing."""
        self._offset = self._record.stat().st_size
        self._rest = None

    def rows(self) -> np.ndarray:
        """Rows of the record since the last call, as a record array."""
        with self._record.open("rb") as file:
            names = file.readline().decode().strip().split(",")
            file.seek(max(self._offset, file.tell()))
            data = file.read()
            self._offset = file.tell()
        if self._rest is None:  # the first line after a skip may be half a line
            data, self._rest = data.partition(b"\n")[2], b""
        whole, _, self._rest = (self._rest + data).rpartition(b"\n")
        table = [tuple(map(float, line.split(b","))) for line in whole.split(b"\n") if line]
        return np.array(table, dtype=[(name, float) for name in names])

    def torques(self) -> tuple[float, float]:
        """Torques of the motors a moment from now; the record may lag on a busy machine."""
        self.skip()
        moment = time.monotonic() + 0.03
        rows = self.rows_until(lambda rows: len(rows) and rows["time"][-1] >= moment)
        row = rows[np.searchsorted(rows["time"], moment)]
        return row["torque_left"], row["torque_right"]

    def rows_until(self, condition, seconds=10.0) -> np.ndarray:
        """Collect rows until a condition on all of them holds."""
        kept = [self.rows()]
        end = time.monotonic() + seconds
        while not condition(np.concatenate(kept)):
            assert time.monotonic() < end, "the record does not show what was waited for"
            time.sleep(0.02)
            kept.append(self.rows())
        return np.concatenate(kept)

    def close(self) -> None:
        self._process.stdin.close()
        self._process.wait(10)
        self._process.stdout.close()


@contextmanager
def emulator(folder: Path, profile: str, *options: str):
    process = EmulatorProcess(folder, profile, *options)
    try:
        yield process
    finally:
        process.close()


def pushing(rows) -> np.ndarray:
    """Where the motors of the board turn."""
    return (rows["torque_left"] != 0.0) | (rows["torque_right"] != 0.0)


def time_to_zero(rows) -> float:
    """Time from the newest valid command to the first round at zero torque, less its lateness."""
    moving = pushing(rows)
    last = int(np.flatnonzero(moving)[-1])
    first_zero = rows[last + 1]
    return float(first_zero["since_command"] - first_zero["lateness"])
