"""Limits, safety and faults of the whole force path, tick by tick on a virtual clock."""

import numpy as np
import pytest
from device.device_rig import GEOMETRY, HAND_LIMIT, TORQUE_LIMIT, Rig

from app.core import state_vector as sv
from app.device.control import Fault
from app.device.control.safety import fade
from app.mechanisms.lever import ForceLaw


@pytest.fixture
def rig():
    rig = Rig()
    with rig.loop:
        yield rig


def test_force_stays_zero_after_opening_until_armed(rig):
    rig.write(assistance=1.0, path_z=-1.0)
    rig.step(500)
    assert rig.sent[3] == 0.0
    assert rig.loop.latest().fault is Fault.NONE


def test_force_comes_up_over_a_second_after_arming(rig):
    rig.write(enabled=1.0, assistance=1.0, path_z=-1.0)
    forces = []
    for _ in range(110):
        rig.step(10)
        forces.append(rig.felt)
    assert forces[0] < 0.02 * forces[-1]
    assert forces[49] == pytest.approx(0.5 * forces[-1], rel=0.02)
    assert np.abs(np.diff(forces)).max() < 0.02 * HAND_LIMIT
    assert forces[-1] == pytest.approx(HAND_LIMIT, rel=1e-9)


def test_force_is_zero_in_the_tick_after_disarming(rig):
    rig.arm()
    assert rig.felt > 1.0
    rig.write(enabled=0.0)
    rig.step(1)
    assert rig.felt == 0.0
    assert rig.sent[:2].tolist() == [0.0, 0.0]


def test_force_is_zero_after_closing_and_closing_twice_is_fine(rig):
    rig.arm()
    calls = rig.sent[2]
    rig.loop.close()
    assert rig.sent[:2].tolist() == [0.0, 0.0]
    assert rig.sent[2] == calls + 1
    assert not rig.loop.latest().felt.any()
    rig.loop.close()
    assert rig.sent[2] == calls + 1


def test_force_is_zero_after_an_exception_in_a_with_block():
    rig = Rig()

    def arm_and_fail():
        with rig.loop:
            rig.arm()
            assert rig.felt > 1.0
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        arm_and_fail()
    assert rig.sent[:2].tolist() == [0.0, 0.0]


def test_after_reopening_the_force_starts_again_at_zero(rig):
    rig.arm()
    rig.loop.close()
    rig.loop.open()
    rig.step(5)
    assert rig.felt == 0.0
    rig.write(enabled=1.0)
    rig.step(1)
    assert 0.0 < rig.felt < 0.01 * HAND_LIMIT


@pytest.mark.parametrize(
    "name", ["tracked_depth", "hand_x", "hand_depth", "path_x", "assistance", "target_z"]
)
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_an_input_that_is_no_number_holds_the_force_at_zero_and_is_named(rig, name, bad):
    rig.arm()
    rig.write(**{name: bad})
    rig.step(1)
    state = rig.loop.latest()
    assert (rig.felt, state.fault) == (0.0, Fault.INPUT_NOT_FINITE)
    assert np.isfinite(state.row).all()
    rig.write(**{name: 0.0})
    rig.step(1)
    assert rig.loop.latest().fault is Fault.NONE


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_an_encoder_that_gives_no_number_holds_the_force_at_zero_and_is_named(bad):
    rig = Rig()
    with rig.loop:
        rig.arm()
        state = rig.loop._state
        good = state[sv.PLANT_Q_LEFT]
        state[sv.PLANT_Q_LEFT] = bad
        rig.step(1)
        assert (rig.felt, rig.loop.latest().fault) == (0.0, Fault.ENCODER_NOT_FINITE)
        state[sv.PLANT_Q_LEFT] = good
        rig.step(1)
        assert rig.loop.latest().fault is Fault.NONE
        assert rig.felt < 0.01 * HAND_LIMIT
        rig.step(1100)
        assert rig.felt == pytest.approx(HAND_LIMIT)


def test_a_singular_pose_holds_the_force_at_zero_and_is_named(rig):
    rig.arm()
    rig.loop.inbox.write(homed=0.0)  # a needle that is suddenly elsewhere is no motion
    rig.step(1)
    meeting = np.arccos(GEOMETRY.base / (2.0 * GEOMETRY.proximal))
    rig.loop._state[[sv.PLANT_Q_LEFT, sv.PLANT_Q_RIGHT]] = meeting, np.pi - meeting
    rig.step(1)
    assert (rig.felt, rig.loop.latest().fault) == (0.0, Fault.SINGULAR)


def test_an_effect_that_gives_no_number_holds_the_force_at_zero_and_is_named(rig):
    rig.arm()
    rig.force[0] = np.nan
    rig.step(1)
    state = rig.loop.latest()
    assert (rig.felt, state.fault) == (0.0, Fault.FORCE_NOT_FINITE)
    assert np.isfinite(state.row).all()


@pytest.mark.promise(
    "docs/protocol.md: the force fades from 20 ms of encoder age and is zero by 100 ms"
)
def test_stale_encoders_fade_the_force_from_20_ms_to_zero_at_100_ms(rig):
    rig.arm()
    full = rig.felt
    rig.freeze[0] = 1.0
    rig.step(120)
    rows = rig.loop.rows()[-120:]
    scales = rows[:, sv.SAFETY_SCALE]
    assert scales[18] == 1.0
    assert scales[59] == pytest.approx(0.5, rel=0.02)
    assert np.abs(np.diff(scales)).max() < 0.02
    forces = np.linalg.norm(rows[:, sv.FELT], axis=1)
    assert (forces <= scales * full + 1e-9).all()
    assert forces[1] > 0.0
    assert forces[100] == 0.0
    assert rig.loop.latest().fault is Fault.ENCODERS_STALE
    rig.freeze[0] = 0.0
    rig.step(1)
    assert rig.felt < 0.01 * full


def test_a_strong_force_ends_where_encoders_are_silent_for_as_long_as_a_hub_let_go_needs(rig):
    """Blind at full force, the governor takes it away before 0.25 m/s can have been reached."""
    rig.arm()
    rig.freeze[0] = 1.0
    rig.step(20)
    rows = rig.loop.rows()[-20:]
    assert rig.felt < 0.1
    assert np.abs(rows[-1, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]).max() < 0.02
    assert rows[-1, sv.LET_GO_SCALE] < 0.1
    rig.freeze[0] = 0.0
    rig.step(60)
    assert rig.felt > 1.0


def test_a_silent_window_holds_the_force_at_zero_after_a_second(rig):
    rig.arm()
    rig.beating = False
    rig.step(590)
    assert rig.felt > 1.0
    before, falls = rig.felt, []
    for _ in range(42):
        rig.step(10)
        falls.append(before - rig.felt)
        before = rig.felt
    assert min(falls) >= -1e-9  # from six tenths of the second on it only falls, without a jump
    assert max(falls) < 0.2
    assert (rig.felt, rig.loop.latest().fault) == (0.0, Fault.HEARTBEAT_LOST)
    rig.beating = True
    rig.step(1)
    assert rig.loop.latest().fault is Fault.NONE


def test_a_heartbeat_or_a_reading_from_the_future_is_not_trusted(rig):
    rig.arm()
    rig.beating = False
    rig.write(heartbeat=rig.clock.now() + 1e6)
    rig.step()
    assert rig.loop.latest().fault is Fault.HEARTBEAT_LOST
    assert rig.felt == 0.0
    assert fade(-0.01, 0.02, 0.1) == 1.0
    assert fade(-0.2, 0.02, 0.1) == 0.0


def test_a_silent_window_is_no_fault_while_disarmed():
    rig = Rig()
    rig.beating = False
    with rig.loop:
        rig.step(2000)
        assert rig.loop.latest().fault is Fault.NONE


def test_every_fault_says_what_to_do():
    for fault in Fault:
        assert len(fault.message) > 5


def test_a_large_force_is_limited_at_the_hand_in_its_direction():
    rig = Rig(force=(40.0, 10.0, 0.0), laws=[])
    with rig.loop:
        rig.arm()
        state = rig.loop.latest()
    wanted = rig.force - state.axis * np.dot(state.axis, rig.force)
    assert state.felt_most == pytest.approx(HAND_LIMIT)
    felt = np.linalg.norm(state.felt)
    assert felt == pytest.approx(
        HAND_LIMIT * (GEOMETRY.needle_length - state.depth_most) / state.l_out
    )
    assert np.cross(state.felt, wanted) == pytest.approx(np.zeros(3), abs=1e-9)
    assert state.limit_scale == pytest.approx(felt / np.linalg.norm(wanted))


def test_the_torque_limit_scales_both_joints_so_that_the_direction_stays():
    rig = Rig(force=(3.0, 4.0, 0.0), laws=[], tilt=0.0)
    for stage in rig.table:
        if stage.name in ("transmission", "safety"):
            stage.parameters[1] = 0.2  # the joints' limit
    with rig.loop:
        rig.arm()
        state = rig.loop.latest()
    assert np.abs(state.torque).max() == pytest.approx(0.2)
    assert state.limit_scale < 1.0
    assert state.felt[:2] / np.linalg.norm(state.felt) == pytest.approx([0.6, 0.8])


@pytest.mark.parametrize(("tilt_deg", "gain"), [(39, 1.6558), (45, 2.0)])
@pytest.mark.parametrize("azimuth", [0.0, 1.0, 2.5, -2.0])
def test_the_printed_law_delivers_the_studys_figures(tilt_deg, gain, azimuth):
    outwards = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    sideways = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    for direction, expected in ((outwards, gain), (sideways, 1.0)):
        felt = []
        for law in (ForceLaw.PRINTED, ForceLaw.VIRTUAL_WORK):
            rig = Rig(np.radians(tilt_deg), azimuth, law, tuple(direction), laws=[])
            with rig.loop:
                rig.arm()
                felt.append(rig.felt)
        assert felt[0] / felt[1] == pytest.approx(expected, abs=1e-4)


def test_the_printed_law_too_never_exceeds_the_hands_limit():
    rig = Rig(np.radians(45.0), 0.0, ForceLaw.PRINTED, (8.0, 0.0, 0.0), laws=[])
    with rig.loop:
        rig.arm()
        assert rig.felt == pytest.approx(HAND_LIMIT)
        assert np.abs(rig.loop.latest().torque).max() <= TORQUE_LIMIT
