"""Short attempts in virtual time, each on another device, with other laws, effects and needles.

`python -m tests.machine_records OUT`, in the root, makes them: the records in
`tests/data/records-machines` were made by it before devices
had kinds, and `test_replay_machines` recomputes them.
"""

import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from shutil import copyfile
from typing import Any, Final

import numpy as np

from app.compose.cameras import AttachedCameras
from app.compose.trainer import TrainerSetup, _context, build_loop, device_of
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.parts import EffectPart, LawPart, NeedlePart
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from app.session.ct_facts import CtFacts
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.rig import load_rig
from tests.layered import layered

FOLDER: Final = Path(__file__).parent / "data" / "records-machines"
PLAN: Final = Plan(np.array([0.0, -100.0, 0.0]), np.array([9.0, -45.0, 6.0]), "test")
SECONDS: Final = 1.2


@dataclass(frozen=True)
class Made:
    """What one record is of."""

    device: str
    laws: dict[str, dict[str, float]] = field(default_factory=dict)
    effects: tuple[str, ...] = ()
    assistance: float = 0.6
    joint: str = ""
    needle_mm: float | None = None
    skill: str | None = None
    depth_known: bool = True


_BENCH, _LAB = (f"tests/data/profiles/{name}.yaml" for name in ("bench-arm", "lab-two"))
_VESSEL = {"from_x": -0.006, "from_y": 0.166, "from_z": 0.06}
_VESSEL |= {"to_x": 0.010, "to_y": 0.166, "to_z": 0.05, "radius": 0.006, "margin": 0.012}

RECORDS: Final = {
    "icube-fixture-tissue": Made("icube", {"fixture": {}}, ("lateral_tissue", "shaft_friction")),
    "icube-repels": Made("icube", {"fixture": {}}, ("lateral_tissue",), assistance=-0.8),
    "icube-impedance-compensation": Made("icube", {"impedance": {}, "compensation": {}}),
    "icube-cone-wall-old-joint": Made("icube", {"cone_wall": {}, "fixture": {}}, joint="old"),
    "icube-forbidden-region": Made("icube", {"forbidden_region": _VESSEL}, assistance=0.2),
    "icube-short-needle": Made("icube", {"fixture": {}}, ("lateral_tissue",), needle_mm=150.0),
    "icube-long-needle-no-depth": Made(
        "icube", {"fixture": {}, "compensation": {}}, needle_mm=250.0, depth_known=False
    ),
    "haply-2diy-fixture": Made("haply-2diy", {"fixture": {}}, ("lateral_tissue", "breathing")),
    "haply-2diy-impedance": Made("haply-2diy", {"impedance": {}}, ("shaft_friction",)),
    "bench-arm-fixture": Made(_BENCH, {"fixture": {}}, ("lateral_tissue", "breathing")),
    "bench-arm-novice": Made(
        _BENCH, {"fixture": {}, "compensation": {}}, ("lateral_tissue",), skill="novice"
    ),
    "lab-two-all-laws": Made(
        _LAB,
        {"fixture": {}, "compensation": {}, "impedance": {}, "cone_wall": {}},
        ("lateral_tissue", "shaft_friction"),
    ),
    "lab-two-short-needle": Made(_LAB, {"fixture": {}}, assistance=1.0, needle_mm=140.0),
}  # fmt: skip
"""Name of the record -> what it is of."""


def make(made: Made, folder: Path) -> Path:
    """Record an attempt whose hand swings and pushes; returns the record."""
    chosen = layered("thick-tissue").model_copy(
        update={
            "device": made.device,
            "joint": made.joint,
            "needle": NeedlePart(length_mm=made.needle_mm),
            "laws": {name: LawPart(parameters=given) for name, given in made.laws.items()},
            "effects": {name: EffectPart() for name in made.effects},
            "assistance": made.assistance,
        }
    )
    profile, clock = device_of(chosen), VirtualClock(50.0)
    placed = placed_plan_of(chosen, profile, PLAN)
    setup = TrainerSetup(chosen, placed, CtFacts("ct-1"), made.skill, 3, folder, clock)
    loop = build_loop(setup, profile)

    def measure(now: float) -> None:
        state = loop.latest()
        tip = placed.p_entry + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))

    context = _context(setup, profile, AttachedCameras((), load_rig(chosen.rig), {}), None)
    see = measure if made.depth_known else (lambda now: None)
    trainer = Trainer(loop, None, placed, chosen, context, clock, see, dial=made.assistance)
    loop.open()
    trainer.heartbeat()
    trainer.step(300)
    trainer.begin("tester")
    for k in range(round(SECONDS / 0.02)):
        if made.skill is None:
            trainer.hand(0.12 * np.sin(0.11 * k), 0.06 * np.cos(0.07 * k), 0.0012 * k)
        trainer.step(round(0.02 * profile.rate_hz))
    result: Any = trainer.end()
    loop.close()
    return Path(result.record)


def main(out: Path) -> None:
    """Make all records."""
    out.mkdir(parents=True, exist_ok=True)
    for name, made in RECORDS.items():
        with tempfile.TemporaryDirectory() as folder:
            copyfile(make(made, Path(folder)), out / f"{name}.mcap")
        print(name)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
