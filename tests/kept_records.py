"""Two short attempts in virtual time, as today's program records them.

`python -m tests.kept_records`, in the root, makes those in `tests/data/records`. They are made
anew only where a release changes the form of records, and says so.
"""

import struct
import tempfile
import zlib
from dataclasses import replace
from pathlib import Path
from shutil import copyfile
from typing import Any, Final

import numpy as np

from app.compose.cameras import AttachedCameras
from app.compose.trainer import TrainerSetup, _context, build_loop, device_of
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from app.session.ct_facts import CtFacts
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.rig import load_rig
from tests.layered import layered

FOLDER: Final = Path(__file__).parent / "data" / "records"
PLAN: Final = Plan(np.array([0.0, -100.0, 0.0]), np.array([9.0, -45.0, 6.0]), "test")
SECONDS: Final = 1.2

RECORDS: Final = {
    "20261120-080001-a001": "first-insertion",
    "20261120-081002-a002": "against-repulsion",
}
"""Id of the record -> its exercise."""

TURNED: Final = (-0.5, 0.65)
"""Dial of the second one: as the exercise sets it, and from its middle on."""


def make(name: str, folder: Path) -> Path:
    """Record an attempt whose hand swings and pushes; return the record."""
    unlocked = {"locks": ()}
    exercise = layered(RECORDS[name]).model_copy(update=unlocked)
    profile, clock = device_of(exercise), VirtualClock(50.0)
    placed = placed_plan_of(exercise, profile, PLAN)
    setup = TrainerSetup(exercise, placed, CtFacts("ct-1"), None, 3, folder, clock)
    loop = build_loop(setup, profile)

    def measure(now: float) -> None:
        state = loop.latest()
        tip = placed.p_entry + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))

    cameras = AttachedCameras((), load_rig(exercise.rig), {})
    context = replace(_context(setup, profile, cameras, None), identify=lambda _: name)
    trainer = Trainer(
        loop, None, placed, exercise, context, clock, measure, dial=exercise.assistance
    )
    loop.open()
    trainer.heartbeat()
    trainer.step(300)
    trainer.begin("tester")
    steps = round(SECONDS / 0.02)
    for k in range(steps):
        if exercise.assistance == TURNED[0] and k == steps // 2:
            trainer.assistance(TURNED[1])
        trainer.hand(0.12 * np.sin(0.11 * k), 0.06 * np.cos(0.07 * k), 0.0012 * k)
        trainer.step(round(0.02 * profile.rate_hz))
    result: Any = trainer.end()
    loop.close()
    return Path(result.record)


def with_score(path: Path, change: str, to: str) -> None:
    """Rewrite the score inside a record as an editor would: same length, right CRC."""
    data = bytearray(path.read_bytes())
    name = data.index(b"score.json")
    start = name - 4 - 16 - 9  # opcode and length, two times, length of the name
    size = struct.unpack_from("<Q", data, start + 1)[0]
    body = start + 9
    old, new = change.encode(), to.encode()
    assert len(old) == len(new)
    at = data.index(old, body, body + size)
    data[at : at + len(old)] = new
    crc = zlib.crc32(data[body : body + size - 4])
    struct.pack_into("<I", data, body + size - 4, crc)
    path.write_bytes(data)


def main() -> None:
    """Make all records."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in RECORDS:
        with tempfile.TemporaryDirectory() as folder:
            copyfile(make(name, Path(folder)), FOLDER / f"{name}.mcap")
        print(name)


if __name__ == "__main__":
    main()
