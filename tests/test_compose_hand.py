"""No movement of mouse, wheel, keys, pen or gamepad voids an attempt on a simulated robot."""

from pathlib import Path

import numpy as np
import pytest
from hard.let_go_rig import LetGoRig
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from virtual_student import Student

from app.core import state_vector as sv
from app.core.arrays import unit
from app.device.faults import Fault
from app.mechanisms.profile import load_profile
from app.session.machine import RUNNING, State
from app.session.recorder import Recorder, TickWriter
from app.session.transitions import excused


@pytest.fixture(autouse=True)
def nothing_is_recorded(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody reads these attempts again, and writing them takes a third of their time."""
    monkeypatch.setattr(Recorder, "sample", lambda *_: None)
    monkeypatch.setattr(TickWriter, "write", lambda *_: None)


MOVE = st.one_of(
    st.tuples(
        st.just("drag"),
        st.tuples(st.floats(-2000.0, 2000.0), st.floats(-2000.0, 2000.0)),
        st.sampled_from([10, 50, 200, 700, 1500]),
    ),
    st.tuples(
        st.just("wheel"),
        st.tuples(st.floats(-150.0, 150.0), st.just(0.0)),
        st.sampled_from([10, 50, 300, 1000]),
    ),
    st.tuples(
        st.just("tilt"),
        st.tuples(st.floats(-60.0, 60.0), st.floats(-60.0, 60.0)),
        st.sampled_from([10, 50, 300, 1000]),
    ),
    st.tuples(
        st.just("dial"), st.tuples(st.floats(-2.0, 2.0), st.just(0.0)), st.sampled_from([10, 500])
    ),
)


@pytest.mark.long("machine")
@pytest.mark.parametrize("exercise", ["first-insertion", "against-repulsion", "thick-tissue"])
@settings(
    max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@example(moves=[("wheel", (126.0, 0.0), 1000), ("drag", (-1200.0, 0.0), 10),
                ("dial", (0.0, 0.0), 500), ("drag", (34.0, 0.0), 700)])  # fmt: skip
@given(moves=st.lists(MOVE, min_size=1, max_size=12))
def test_no_movement_voids_an_attempt(
    tmp_path: Path, exercise: str, moves: list[tuple[str, tuple[float, float], int]]
) -> None:
    student = Student(tmp_path, exercise)
    try:
        student.pause(200)
        student.trainer.begin()
        student.pause(1200)  # the force has come up
        for kind, amount, milliseconds in moves:
            student.do(kind, amount, milliseconds)
        student.pause(800)
        snapshot = student.trainer.snapshot()
        assert snapshot.state is not State.ABORTED, snapshot.reason
        assert student.fault == Fault.NONE
    finally:
        student.close()


@pytest.mark.long("machine")
@pytest.mark.parametrize("dial", [1.0, 0.5, 0.0, -1.0])
@pytest.mark.parametrize(
    "moves",
    [
        [("drag", (100.0, 0.0), 700)],
        [("drag", (2000.0, 0.0), 50)],
        [("drag", (2000.0 * (-1) ** k, 700.0 * (-1) ** (k // 2)), 50) for k in range(30)],
        [("drag", (300.0 * (-1) ** k, 0.0), 200) for k in range(20)],
        [("tilt", (40.0, 0.0), 500), ("tilt", (-60.0, 0.0), 100), ("tilt", (0.0, 60.0), 100)],
        [("wheel", (126.0, 0.0), 1000), ("drag", (-1200.0, 0.0), 10), ("drag", (35.0, 0.0), 700)],
        [("wheel", (100.0, 0.0), 50), ("drag", (400.0, 0.0), 50), ("wheel", (-130.0, 0.0), 50)] * 3,
    ],
    ids=["slow", "wild", "alternating", "shaking", "keys", "deep", "in and out"],
)
def test_a_wild_mouse_voids_nothing(
    tmp_path: Path, dial: float, moves: list[tuple[str, tuple[float, float], int]]
) -> None:
    student = Student(tmp_path)
    try:
        student.trainer.begin()
        student.trainer.assistance(dial)
        student.pause(1200)
        for kind, amount, milliseconds in moves:
            student.do(kind, amount, milliseconds)
        student.pause(500)
        snapshot = student.trainer.snapshot()
        assert snapshot.state is not State.ABORTED, snapshot.reason
    finally:
        student.close()


def test_a_pause_stops_the_needle_where_it_is_and_what_is_pushed_in_it_is_lost(
    tmp_path: Path,
) -> None:
    student = Student(tmp_path)
    try:
        student.trainer.begin()
        student.pause(1200)
        student.do("wheel", (40.0, 0.0), 500)
        student.busy(940)
        x, y, _ = student.hand.pose.direction.tolist()
        student.trainer.hand(x, y, 0.08)  # far more than the hand comes in what is left
        while student.trainer.snapshot().state is not State.PAUSED:
            student.busy(10)
        row = student.rig.loop.latest().row
        before = float(row[sv.PLANT_DEPTH])
        assert before < 0.06, "it is still on its way"
        for k in range(40):  # now the window is there again
            student.trainer.hand(x, y, 0.08 + 1e-3 * k)
            student.trainer.heartbeat()
            student._pass(10)
        assert student.trainer.snapshot().state is State.PAUSED
        student.pause(600)
        assert student.trainer.snapshot().state is not State.PAUSED
        assert abs(student.rig.loop.latest().row[sv.PLANT_DEPTH] - before) < 3e-3
    finally:
        student.close()


@pytest.mark.parametrize(("lean", "depth"), [(0.15, 0.0), (0.3, 0.03), (0.25, -0.015), (0.2, 0.06)])
def test_a_hand_that_lets_go_still_ends_in_the_fault(
    tmp_path: Path, lean: float, depth: float
) -> None:
    student = Student(tmp_path)
    try:
        student.trainer.begin()
        student.trainer.assistance(1.0)
        axis = student.trainer._placed.axis
        student.hand.follow(unit(axis + np.array([lean, 0.0, 0.0])), depth)
        student.pause(3000)
        student.hand.release()
        student.pause(1000)
        snapshot = student.trainer.snapshot()
        assert snapshot.state is State.ABORTED
        assert "as if nobody held it" in snapshot.reason
    finally:
        student.close()


def test_a_window_that_is_blocked_has_no_torque_on_the_board_after_a_second() -> None:
    path = (0.3, 0.1, -np.sqrt(0.9))
    rig = LetGoRig(load_profile("icube"), (0.0, 0.0, -1.0), path, 0.03, wire=True)
    with rig.loop:
        rig.arm()
        torques = []
        for k in range(150):
            rig.loop.inbox.write(tracked_depth=rig.depth, tracked_time=rig.clock.now())
            rig.loop.step(10)
            row = rig.loop.latest().row
            torques.append((0.01 * (k + 1), np.abs(row[sv.TORQUE]).max()))
    before = [torque for age, torque in torques if age <= 0.5]
    after = [torque for age, torque in torques if age >= 1.01]
    assert min(before) > 0.05
    assert max(after) == 0.0
    falling = [torque for age, torque in torques if 0.6 < age < 0.9]
    assert falling[0] > falling[-1] > 0.0, "it fades, it does not break off"
    assert row[sv.FAULT] == Fault.HEARTBEAT_LOST


@pytest.mark.long("machine")
@pytest.mark.parametrize("silence", [700, 800, 950, 1500, 3000])
@pytest.mark.parametrize("pixels", [150.0, 2000.0])
def test_a_window_that_is_busy_while_the_hand_moves_voids_nothing(
    tmp_path: Path, silence: int, pixels: float
) -> None:
    """The force that fades meanwhile comes back slowly: in one tick it would throw the needle."""
    student = Student(tmp_path)
    try:
        student.trainer.begin()
        student.trainer.assistance(1.0)
        student.pause(1200)
        for sign in (1.0, -1.0, 1.0):
            student.do("drag", (sign * pixels, 0.5 * pixels), 100)
            student.busy(silence)
            before = student.rig.loop.latest().row[sv.ARMING]
            student.pause(100)
            assert student.rig.loop.latest().row[sv.ARMING] - before < 0.11
            student.pause(1500)
        snapshot = student.trainer.snapshot()
        assert snapshot.state is State.ALIGNING, snapshot.reason
        assert snapshot.armed
    finally:
        student.close()


SWINGS = [
    ("wheel", (109.9, 0.0), 300), ("drag", (-10.4, 3.4), 700), ("blind",),
    ("drag", (265.9, -370.6), 200), (800,), ("drag", (87.5, -394.5), 700), (200,), ("sees",),
    (650,), ("wheel", (-3.0, 0.0), 300), (50,), ("drag", (84.0, 63.0), 200), (1000,),
]  # fmt: skip
"""Deep in the body, across while the cameras see nothing, back while the force comes up again: the
governor takes the needle that swings in the hand's springs for one let go. A hand that stands still
in a pause does not come to it: here it is let move."""


@pytest.mark.long("machine")
def test_a_needle_that_swings_in_the_simulated_hand_pauses_the_attempt_and_voids_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    student = Student(tmp_path, "thick-tissue")
    try:
        monkeypatch.setattr(student.trainer._hand, "follow", lambda *_: None)
        student.pause(200)
        student.trainer.begin()
        student.pause(600)
        for step in SWINGS:
            if step[0] in ("blind", "sees"):
                student.blind = step[0] == "blind"
            elif isinstance(step[0], int):
                student.pause(step[0])
            else:
                student.do(*step)
        student.pause(1500)
        snapshot = student.trainer.snapshot()
        assert snapshot.state in RUNNING, snapshot.reason
        told = [event for event in student.trainer.events.drain() if event.kind == "pause"]
        hand = [event for event in told if event.data["cause"] == "hand"]
        assert len(hand) == 2, told
        assert 0.5 <= hand[1].data["duration_s"] < 1.0
        assert excused(hand) == hand[1].data["duration_s"], "it costs the student nothing"
    finally:
        student.close()
