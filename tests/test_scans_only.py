"""A whole attempt at the assessment `scans-only`, in virtual time, guided by its pictures alone."""

import numpy as np
import pytest
from scan_reading import remaining_mm

from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.guidance import GuidanceMode
from app.exercises.scene import placed_plan_of
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.scan_order import ScanOrder, Seen
from app.imaging.scanned import scan_image
from app.session.control_scan import scans_of
from app.session.ct_facts import CtFacts
from app.session.recording import read_recording
from app.session.replay import contents
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from tests.layered import layered

CAREFUL_MM = 45.0
"""So deep the student pushes before the first scan."""


@pytest.mark.long("journey")
def test_a_needle_is_brought_to_the_target_by_control_scans_alone(tmp_path) -> None:
    exercise, clock = layered("scans-only"), VirtualClock(100.0)
    assert exercise.guidance_mode is GuidanceMode.CONTROL_CT
    volume = load_ct(phantom_series(1))
    placed = placed_plan_of(exercise, device_of(exercise))
    rig = build_rig(
        TrainerSetup(
            exercise, placed, CtFacts.of_volume(volume), seed=1, sessions=tmp_path, clock=clock
        )
    )

    def measure(now: float) -> None:
        state = rig.loop.latest()
        tip = rig.profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))

    trainer = Trainer(rig.loop, None, placed, exercise, rig.trainer._context, clock, measure)
    rig.loop.open()
    trainer.step()
    trainer.begin("tester")

    def push(start: float, end: float) -> None:
        """Move the hand along the planned direction, as the ruler beside the skin says [mm]."""
        for depth in [*np.linspace(start, end, 100), *[end] * 40]:
            trainer.hand(float(placed.axis[0]), float(placed.axis[1]), 1e-3 * depth)
            trainer.step()

    push(-15.0, depth := CAREFUL_MM)
    plan, seen = placed.plan, []
    order = ScanOrder(float(plan.target_mm[2]), 5, exercise.guidance.slice_mm)
    for _ in range(4):
        trainer.scan(order)
        scan = scans_of(trainer.events.drain())[-1]
        picture = scan_image(volume, scan.order, scan.needle, scan.streak, scan.shift_mm)
        seen.append(remaining_mm(picture, plan.entry_mm, plan.target_mm))
        assert seen[-1] is not None
        if abs(seen[-1]) < 1.0:
            break
        push(depth, depth := depth + seen[-1])
    result = trainer.end()
    rig.loop.close()

    assert seen[0] > 20.0  # the first picture showed how far it still was
    assert result.scans == len(seen) <= 3
    assert result.score is not None
    assert result.score.passed
    values = {row.name: row.value for row in result.score.rows}
    assert values["control_scans"] == len(seen)
    assert values["notional_dose"] == pytest.approx(5 * 3.85 * len(seen))
    assert values["target_error"] < 2.0
    recording = read_recording(result.record)
    scans = recording.control_scans()
    assert [scan.streak for scan in scans] == [True] * len(seen)
    assert scans[-1].seen is Seen.TIP
    assert recording.ct == CtFacts.of_volume(volume)
    assert "as its files are" in "\n".join(contents(recording).sentences())
