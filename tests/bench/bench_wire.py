"""Round trip over a pseudo-terminal at the profile's rate, beside an echo of plain bytes.

For each protocol: `acus device emulate` in a process of its own, commands at 1 kHz, each answer
awaited within its tick. The peer in the same run is a process that echoes 16 bytes as soon as they
come, asked in the same way: what the pseudo-terminal and the scheduler cost without any protocol.

Run as `python -m tests.bench.bench_wire`.
"""

import os
import pty
import select
import subprocess
import sys
import tempfile
import time
import tty
from pathlib import Path

import numpy as np

from app.device.link_test import measure_link
from app.mechanisms.profile import load_profile

SECONDS = 10.0
ECHO = """
import os, sys
fd = os.open(sys.argv[1], os.O_RDWR | os.O_NOCTTY)
while True:
    os.write(fd, os.read(fd, 64))
"""


def emulated(profile: str, folder: Path) -> tuple[float, float, float, int, int]:
    """Round trip p50, p99 and largest [ms], lost and late answers, over the emulator."""
    path = folder / profile
    command = [sys.executable, "-m", "app", "device", "emulate", "--profile", profile]
    process = subprocess.Popen(
        [*command, "--link", str(path), "--hand", "rest"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdin is not None
    assert process.stdout is not None
    process.stdout.readline()
    try:
        result = measure_link(str(path), load_profile(profile), SECONDS)
    finally:
        process.stdin.close()
        process.wait(10)
    return (
        result.round_trip_p50_ms,
        result.round_trip_p99_ms,
        result.round_trip_max_ms,
        result.lost,
        result.late,
    )


def echo() -> tuple[float, float, float]:
    """Round trip p50, p99 and largest [ms] of 16 bytes echoed by another process."""
    master, slave = pty.openpty()
    tty.setraw(slave)
    process = subprocess.Popen([sys.executable, "-c", ECHO, os.ttyname(slave)])
    trips, deadline = [], time.monotonic() + 1.0
    for _ in range(round(SECONDS * 1000)):
        time.sleep(max(deadline - time.monotonic(), 0.0))
        deadline += 1e-3
        sent = time.monotonic()
        os.write(master, bytes(16))
        got = 0
        while got < 16:
            select.select([master], [], [])
            got += len(os.read(master, 64))
        trips.append(time.monotonic() - sent)
    process.kill()
    process.wait()
    os.close(master)
    os.close(slave)
    p50, p99, largest = np.percentile(trips, (50, 99, 100)) * 1e3
    return float(p50), float(p99), float(largest)


def main() -> None:
    """Print the table."""
    peer = echo()
    print(f"{'round trip [ms]':28}{'p50':>8}{'p99':>8}{'max':>8}   at 1 kHz for {SECONDS:g} s")
    print(f"{'echo of plain bytes':28}{peer[0]:8.3f}{peer[1]:8.3f}{peer[2]:8.3f}")
    with tempfile.TemporaryDirectory() as folder:
        for profile in ("icube", "haply-2diy"):
            p50, p99, largest, lost, late = emulated(profile, Path(folder))
            label = f"{profile} over the emulator"
            print(
                f"{label:28}{p50:8.3f}{p99:8.3f}{largest:8.3f}   lost {lost}, late {late},"
                f" p50 {p50 / peer[0]:.2f} x echo"
            )


if __name__ == "__main__":
    main()
