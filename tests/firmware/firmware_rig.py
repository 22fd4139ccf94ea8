"""The board's program, built for a test: as a library, as a program behind a terminal, for QEMU."""

import ctypes
import os
import shutil
import subprocess
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FIRMWARE = ROOT / "firmware"
OUT = ROOT / "out" / "firmware"
STATES = ("BOOT", "IDLE", "ENABLED", "REJECTED", "REFUSED", "FAULT")
EVENTS = (
    *("GREETED", "ESTRANGED", "ENABLE", "DISABLE", "BAD_TORQUE", "HOMED", "BAD_HOME", "LATE"),
    "BROKEN",
)


def need(*programs):
    """Skip where a program is not installed; where all is to be tested, fail."""
    for program in programs:
        if shutil.which(program) is None:
            if os.environ.get("CI"):
                pytest.fail(f"{program} is needed here: tools/install-system tests")
            pytest.skip(f"{program} is not installed")


def make(target, device="icube", *options):
    """Run the firmware's Makefile; return what it says."""
    need("make", "cc")
    command = ["make", "-C", str(FIRMWARE), target, f"DEVICE={device}", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@cache
def built(target, device="icube", serial="A0001"):
    """Build one of its programs; return its file."""
    out = OUT / f"{device}-{serial}"
    make(target, device, f"OUT={out}", f"SERIAL={serial}")
    return out / {"host": "acus-board", "bench": "bench.so", "stm32f405": "stm32f405.elf"}.get(
        target, f"{target}.elf"
    )


class Health(ctypes.Structure):
    _fields_ = (("hottest", ctypes.c_float), ("supply", ctypes.c_float), ("ready", ctypes.c_bool))


class Bench:
    """The core as a library, with the outside world in variables; started like after power-up."""

    def __init__(self, device="icube", library=None, boot=1):
        given = os.environ.get("ACUS_FIRMWARE_BENCH", "")  # device=library:device=library
        chosen = dict(one.split("=") for one in given.split(os.pathsep) if one).get(device)
        self.lib = ctypes.CDLL(str(library or chosen or built("bench", device)))
        self.channels = 4 if device == "tensegrity" else 2
        self.now = self._variable("time", ctypes.c_uint32)
        self.encoders = self._variable("encoder", ctypes.c_uint16 * 2)
        self.latched = self._variable("latched", ctypes.c_uint16 * 2)
        self.index = self._variable("index", ctypes.c_bool * 2)
        self.health = self._variable("health", Health)
        self.current = self._variable("current", ctypes.c_float * self.channels)
        self.reel = self._variable("reel", ctypes.c_float * self.channels)
        self.tension = self._variable("tension", ctypes.c_float * self.channels)
        self.reeled = self._variable("reeled", ctypes.c_float * self.channels)
        self._enabled = self._variable("enabled", ctypes.c_bool)
        self._locks = self._variable("locks", ctypes.c_int)
        self._out = self._variable("out", ctypes.c_uint8 * 65536)
        self._count = self._variable("out_count", ctypes.c_size_t)
        self._variable("boot", ctypes.c_uint32).value = boot
        self.now.value = self._count.value = 0
        self.encoders[:], self.index[:] = (0, 0), (False, False)
        self.health.hottest, self.health.supply, self.health.ready = 25.0, 24.0, True
        self.lib.board_start()

    def _variable(self, name, kind):
        return kind.in_dll(self.lib, f"bench_{name}")

    def feed(self, data):
        """Give it bytes; return what it sends."""
        for start in range(0, len(data), 4096):
            piece = data[start : start + 4096]
            self.lib.bench_feed(piece, ctypes.c_size_t(len(piece)))
        answer = bytes(self._out[: self._count.value])
        self._count.value = 0
        return answer

    def tick(self, milliseconds=1):
        """Let time pass; its timer ticks."""
        for _ in range(milliseconds):
            self.now.value = (self.now.value + 1000) & 0xFFFFFFFF
            self.lib.board_tick()

    @property
    def state(self):
        return STATES[self.lib.bench_state()]

    @property
    def error(self):
        return self.lib.bench_error()

    @property
    def pushes(self):
        """Whether any motor is driven."""
        assert self._locks.value == 0
        driven = any(self.current) or any(self.reel)
        assert self._enabled.value or not driven
        return self._enabled.value and driven


class BoardProcess:
    """The host port as a program of its own behind a terminal."""

    def __init__(self, program, path):
        self.path = str(path)
        self._process = subprocess.Popen(
            [program, self.path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert self._process.stdout.readline().strip() == self.path

    def order(self, text):
        """Give an order; return what is said before the `ok`."""
        self._process.stdin.write(text + "\n")
        self._process.stdin.flush()
        said = self._process.stdout.readline().strip()
        assert said.endswith("ok"), said
        return said.removesuffix("ok").strip()

    def close(self):
        self._process.stdin.close()
        self._process.wait(10)
        self._process.stdout.close()


@contextmanager
def board_process(folder, device="icube", program=None):
    """A board on this computer, from its power-up to its end."""
    process = BoardProcess(program or built("host", device), folder / f"board-{device}")
    try:
        yield process
    finally:
        process.close()
