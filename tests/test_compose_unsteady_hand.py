"""The hand of mouse, keys, pen tablet and gamepad: its start, clock, unsteadiness and replay."""

from dataclasses import replace
from math import degrees
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
from scipy.signal import welch
from virtual_student import Student

from app.compose.recomputed import replay_recording
from app.compose.trainer import (
    TrainerSetup,
    beginnings_of,
    build_rig,
    loop_table,
)
from app.core import state_vector as sv
from app.exercises.library import load_exercise
from app.exercises.parts import TissueSource
from app.exercises.procedure import BiopsyPart, ChecklistPart, ProcedurePart
from app.exercises.scene import device_of, placed_plan_of
from app.imaging.field import TissueKind
from app.session.beginnings import LEAST_OFF, MOST_OFF, Beginnings
from app.session.errors import ProcedureNotPossibleError
from app.session.machine import State
from app.session.procedure import KIND as PROCEDURE
from app.session.procedure import Step
from app.session.recording import read_recording
from app.session.shown_views import Shown
from app.session.snapshot import NextSteps, StepKind
from app.session.trainer import Trainer
from app.session.verify import verify
from app.simulation.unsteady import LEVEL_1, LEVEL_5
from app.simulation.unsteady_hand import NAME
from tests.field_rig import ball, field_of_shapes
from tests.layered import layered

MEASURED_TREMOR = (15e-6, 254e-6)
"""RMS of physiological tremor of the hand [m] (PMC3032442)."""


def beginnings(student: Student, seed: int = 3, level: int = 1) -> None:
    """Let the student's attempts begin as those of a person at the window."""
    student.trainer._beginnings = Beginnings(seed, level, student.rig.profile.tilt_limit)


@pytest.fixture
def student(tmp_path: Path):
    made = Student(tmp_path)
    beginnings(made)
    yield made
    made.close()


def make_ready(student: Student) -> np.ndarray:
    """Begin an attempt and wait until it is ready; returns the needle's direction."""
    student.trainer.begin(hand="mouse")
    for _ in range(300):
        snapshot = student.trainer.step(20)
        if snapshot.ready:
            return student.rig.loop.latest().row[[sv.GRIP_X, sv.GRIP_Y]].copy()
    raise AssertionError("the attempt never became ready")


def wanted(student: Student) -> tuple[float, float, float]:
    x, y, depth = student.rig.loop.latest().row[[sv.HAND_X, sv.HAND_Y, sv.HAND_DEPTH]].tolist()
    return x, y, depth


@pytest.mark.long("machine")
def test_every_attempt_begins_off_the_path_elsewhere_and_the_same_for_a_seed(
    student: Student,
) -> None:
    axis, starts = student.trainer._placed.axis, []
    for _ in range(3):
        x, y = make_ready(student)
        needle = np.array([x, y, -np.sqrt(1.0 - x * x - y * y)])
        angle = np.arccos(needle @ axis)
        assert degrees(LEAST_OFF) - 1.0 < degrees(angle) < degrees(MOST_OFF) + 1.0
        starts.append((x, y))
        student.trainer.end()
    assert np.hypot(*np.subtract(starts[0], starts[1])) > 0.02, "Again begins elsewhere"
    beginnings(student)
    assert make_ready(student) == pytest.approx(starts[0], abs=2e-3)


@pytest.mark.long("machine")
def test_the_clock_runs_from_the_first_movement_of_the_hand(student: Student) -> None:
    make_ready(student)
    for _ in range(100):
        snapshot = student.trainer.step(20)
    assert snapshot.ready
    assert snapshot.elapsed == 0.0, "somebody who looks at the CT loses no time"
    assert not snapshot.armed
    x, y, depth = wanted(student)
    student.trainer.hand(x, y, depth)
    assert student.trainer.step(20).ready, "a wish for where it is already is no movement"
    student.trainer.hand(x + 0.01, y, depth)
    for _ in range(5):
        snapshot = student.trainer.step(20)
    assert snapshot.state is State.ALIGNING
    assert 0.0 < snapshot.elapsed < 0.15
    assert NextSteps(student.trainer._placed, 2e-3, 2e-3).of(snapshot).kind is not StepKind.MOVE


MUSCLE = field_of_shapes(
    [(TissueKind.MUSCLE, "muscle", ball([0.0, -70.0, 0.0], 50.0))],
    (-60.0, -120.0, -60.0),
    (31, 31, 31),
    4.0,
)
"""Where the student's plan leads."""


@pytest.fixture
def asking(tmp_path: Path):
    """A student whose exercise has a checklist before any needle."""
    asked = ProcedurePart(biopsy=BiopsyPart(), checklist=ChecklistPart())
    chosen = layered("first-insertion").model_copy(
        update={"procedure": asked, "tissue": TissueSource.FIELD}
    )
    with patch("virtual_student.layered", lambda _: chosen):
        made = Student(tmp_path, tissues=MUSCLE)
    beginnings(made)
    yield made
    made.close()


def test_what_needs_no_needle_can_be_done_before_the_first_movement_and_begins_the_attempt(
    asking: Student,
) -> None:
    """Seen: while the line said "Then: Ask for consent (J)", J did nothing until the hand moved."""
    trainer = asking.trainer
    make_ready(asking)
    assert trainer.snapshot().takes_steps
    for refused in (Step.STYLET_OUT, Step.INJECT, Step.PLACE_ELECTRODE):
        with pytest.raises(ProcedureNotPossibleError):
            trainer.perform(refused)
        assert trainer.step(20).ready, "what is refused begins nothing"
    trainer.perform(Step.CONSENT)
    snapshot = trainer.step(20)
    assert snapshot.state is State.ALIGNING
    assert snapshot.armed
    assert 0.0 < snapshot.elapsed < 0.05
    assert snapshot.procedure.checked == (Step.CONSENT,)
    trainer.perform(Step.COAGULATION)
    for _ in range(50):
        snapshot = trainer.step(20)
    assert snapshot.state is State.ALIGNING, "a hand that has not moved is waited for no more"
    result = trainer.end()
    kinds = [(one.kind, one.data.get("step", one.data.get("state"))) for one in result.events]
    order = [("state", "aligning"), (PROCEDURE, "consent"), (PROCEDURE, "coagulation")]
    assert [one for one in kinds if one in order] == order
    recording = read_recording(result.record)
    assert replay_recording(recording).identical
    checked = verify(recording)
    assert checked.changes == (), checked.sentences()


def test_before_an_attempt_is_ready_no_step_begins_it(asking: Student) -> None:
    asking.trainer.begin(hand="mouse")
    snapshot = asking.trainer.step(20)
    assert snapshot.state is State.WITHDRAWING
    assert not snapshot.ready
    assert not snapshot.takes_steps
    with pytest.raises(ProcedureNotPossibleError, match="begin an attempt"):
        asking.trainer.perform(Step.CONSENT)


def test_what_leads_the_needle_by_itself_begins_at_once_with_a_steady_hand(
    student: Student,
) -> None:
    student.trainer.begin()
    for _ in range(50):
        snapshot = student.trainer.step(20)
    assert snapshot.state is State.ALIGNING
    assert (
        not student.rig.loop.latest().row[[sv.UNSTEADY_X, sv.UNSTEADY_DEPTH, sv.HAND_LEVEL]].any()
    )


def rows_of_a_hand_at_rest(student: Student, level: int, seconds: int = 20) -> np.ndarray:
    beginnings(student, level=level)
    make_ready(student)
    parts = []
    for _ in range(50 * seconds):
        student.trainer.step(20)
        parts.append(student.rig.loop.rows(student.rig.loop.latest().tick - 20)[:20].copy())
    return np.concatenate(parts)


@pytest.mark.long("machine")
@pytest.mark.parametrize("level", [1, 5])
def test_the_tremor_has_the_band_and_the_size_that_were_measured(
    student: Student, level: int
) -> None:
    rows = rows_of_a_hand_at_rest(student, level)
    lever = student.rig.profile.needle_length - rows[:, sv.PLANT_DEPTH]
    f, power = welch(rows[:, sv.UNSTEADY_X] * lever, 1000.0, nperseg=4096)
    band, fast = (f >= 8.0) & (f <= 12.0), f >= 5.0
    assert f[fast][np.argmax(power[fast])] == pytest.approx(10.0, abs=1.5)
    rms = np.sqrt(np.trapezoid(power[fast], f[fast]))
    assert MEASURED_TREMOR[0] < rms < MEASURED_TREMOR[1]
    assert np.trapezoid(power[band], f[band]) > 0.5 * rms**2
    asked = LEVEL_1.tremor if level == 1 else LEVEL_5.tremor
    assert rms == pytest.approx(asked, rel=0.25)


@pytest.mark.long("machine")
def test_pushing_bends_the_direction_and_rest_brings_no_such_turn(student: Student) -> None:
    rows = rows_of_a_hand_at_rest(student, 1, seconds=3)
    still = np.ptp(rows[:, [sv.UNSTEADY_X, sv.UNSTEADY_Y]], axis=0).max()
    x, y, depth = wanted(student)
    for k in range(100):  # 20 mm/s in the air
        student.trainer.hand(x, y, depth + 4e-4 * k - 0.03)
        student.trainer.step(20)
    row = student.rig.loop.latest().row
    assert np.hypot(row[sv.UNSTEADY_X], row[sv.UNSTEADY_Y]) > 2.0 * still


@pytest.mark.long("machine")
def test_an_attempt_with_an_unsteady_hand_is_recomputed_to_the_last_bit(student: Student) -> None:
    make_ready(student)
    x, y, depth = wanted(student)
    for k in range(150):
        student.trainer.hand(x * (1.0 - k / 150.0), y, depth + 3e-4 * k)
        student.trainer.step(20)
    off = student.rig.loop.latest().row[[sv.UNSTEADY_X, sv.UNSTEADY_Y, sv.UNSTEADY_DEPTH]]
    assert np.abs(off).min() > 1e-6, "there is noise to be computed anew"
    result = student.trainer.end()
    recording = read_recording(result.record)
    assert recording.inputs.column("hand_level").max() == 1.0
    assert recording.inputs.column("hand_seed").max() > 0.0
    report = replay_recording(recording)
    assert report.identical, report
    values = recording.inputs.values.copy()
    values[:, recording.inputs.columns.index("hand_seed")] += 1.0
    other = replace(recording, inputs=replace(recording.inputs, values=values))
    assert not replay_recording(other).identical, "the seed is what the hand follows from"


@pytest.mark.long("machine")
def test_a_hand_that_takes_over_from_the_arm_is_as_unsteady_as_one_that_began(
    student: Student,
) -> None:
    beginnings(student, level=4)
    student.trainer.begin(hand="arm")
    for _ in range(50):
        student.trainer.step(20)
    row = student.rig.loop.latest().row
    assert not row[[sv.HAND_LEVEL, sv.UNSTEADY_X, sv.UNSTEADY_DEPTH]].any(), "the arm is steady"
    student.trainer.take_over("mouse")
    x, y, depth = wanted(student)
    sizes = []
    for k in range(150):
        student.trainer.hand(x, y, depth + 2e-4 * k)
        student.trainer.step(20)
        row = student.rig.loop.latest().row
        sizes.append(np.abs(row[[sv.UNSTEADY_X, sv.UNSTEADY_Y, sv.UNSTEADY_DEPTH]]))
    assert sizes[0].max() < 1e-3, "taken over without a jump"
    assert np.max(sizes, axis=0).min() > 1e-5
    seed = row[sv.HAND_SEED]
    recording = read_recording(student.trainer.end().record)
    levels = recording.inputs.column("hand_level")
    assert (levels.min(), levels.max()) == (0.0, 4.0)
    assert recording.inputs.column("hand_seed").max() == seed > 0.0
    assert replay_recording(recording).identical
    student.trainer.begin(hand="arm")
    student.trainer.step(20)
    student.trainer.take_over("keyboard")
    student.trainer.step(20)
    assert student.rig.loop.latest().row[sv.HAND_SEED] != seed, "another time, another hand"
    student.trainer.take_over("arm")
    student.trainer.step(20)
    assert student.rig.loop.latest().row[sv.HAND_LEVEL] == 0.0
    student.trainer.end()


@pytest.mark.long("machine")
def test_a_steady_hand_is_recorded_as_such_and_has_no_noise(student: Student) -> None:
    chosen = student.rig.setup.exercise.model_copy(update={"unsteady_hand": 0, "level": 3})
    assert chosen.hand_level == 0
    beginnings(student, level=chosen.hand_level)
    start = make_ready(student)
    assert np.hypot(*start) > 0.0, "it begins off the path all the same"
    x, y, depth = wanted(student)
    for k in range(100):
        student.trainer.hand(x, y, depth + 3e-4 * k)
        student.trainer.step(20)
        row = student.rig.loop.latest().row
        assert not row[[sv.UNSTEADY_X, sv.UNSTEADY_Y, sv.UNSTEADY_DEPTH]].any()
    recording = read_recording(student.trainer.end().record)
    assert not recording.inputs.column("hand_level").any()
    assert replay_recording(recording).identical


@pytest.mark.long("machine")
@pytest.mark.parametrize("unsteady", [None, 0, 4])
def test_the_program_takes_the_hand_from_the_exercise(
    student: Student, unsteady: int | None
) -> None:
    setup = student.rig.setup
    chosen = setup.exercise.model_copy(update={"unsteady_hand": unsteady})
    rig = build_rig(replace(setup, exercise=chosen))
    try:
        made = rig.trainer._beginnings
        assert made is not None
        assert made.level == (chosen.level if unsteady is None else unsteady)
        assert made.next(rig.trainer._placed).level == made.level
    finally:
        rig.close()


def test_no_real_robot_has_an_unsteady_hand(student: Student) -> None:
    setup, profile = student.rig.setup, student.rig.profile
    assert NAME in [stage.name for stage in loop_table(setup, profile)]
    assert NAME not in [stage.name for stage in loop_table(setup, profile, simulated=False)]
    assert isinstance(student.trainer, Trainer)


@pytest.mark.long("machine")
@pytest.mark.parametrize(
    ("exercise", "orders", "numbers"),
    [("first-insertion", True, True), ("thick-tissue", True, False), ("kidney", False, False),
     ("laparoscopic-tool", True, True)],
)  # fmt: skip
def test_orders_fade_with_the_level_and_from_the_third_on_the_ct_leads(
    student: Student, exercise: str, orders: bool, numbers: bool
) -> None:
    shown = Shown.of_exercise(load_exercise(exercise))
    assert (shown.orders, shown.numbers) == (orders, numbers)
    assert ("bullseye" in shown.views) == orders
    snapshot = student.trainer.step(20)
    make_ready(student)
    x, y, depth = wanted(student)
    student.trainer.hand(x + 0.01, y, depth)
    for _ in range(20):
        snapshot = student.trainer.step(20)
    step = NextSteps(student.trainer._placed, 2e-3, 2e-3).of(snapshot, orders=shown.orders)
    assert step.kind is (StepKind.TILT if orders else StepKind.LOOK)


def test_each_run_of_the_window_begins_elsewhere_and_one_with_a_seed_alike() -> None:
    exercise = load_exercise("first-insertion")
    profile = device_of(exercise)
    setup = TrainerSetup(exercise, placed_plan_of(exercise, profile), seed=1)
    first = [
        beginnings_of(replace(setup, hand_seed=seed), profile).next(setup.placed)
        for seed in (None, None, 7, 8)
    ]
    assert first[0] == first[1]
    assert len(set(first[1:])) == 3
