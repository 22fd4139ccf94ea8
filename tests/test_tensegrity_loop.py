"""The needle holder in the loop: it holds a direction, pulls within limits, and says what fails."""

import numpy as np
import pytest
from tensegrity_rig import PROFILE, HolderRig, leaning

from app.core import state_vector as sv
from app.core.arrays import angle_between
from app.device.control import laws
from app.device.errors import LawError
from app.device.faults import Fault
from app.mechanisms.profile import load_profile
from app.mechanisms.tensegrity import encoder_error, torques
from app.mechanisms.tensegrity.efforts import BROKEN, LOST, SLACK

HOLDS = {"hold_direction": {}}
PULLS = {"fixture": {}}
GEOMETRY = PROFILE.geometry.bars
LATEST = 20  # ticks from what shows to the end of the force


def by_current():
    cables = PROFILE.cables.model_copy(update={"tension_from": "current"})
    return PROFILE.model_copy(update={"cables": cables})


def test_codes_of_faults_are_those_of_the_device():
    assert (SLACK, BROKEN, LOST) == (Fault.CABLE_SLACK, Fault.CABLE_BROKEN, Fault.ENCODER_LOST)
    assert all(Fault(code).message for code in (SLACK, BROKEN, LOST))


@pytest.mark.long("journey")
@pytest.mark.parametrize("tilt", [0.0, 20.0, 40.0])
@pytest.mark.parametrize("azimuth", [10.0, 100.0, 190.0, 280.0])
def test_a_direction_is_held_against_five_newtons_better_than_encoders_and_a_tenth(tilt, azimuth):
    path = leaning(tilt, azimuth)
    rig = HolderRig(HOLDS, path)
    rig.run(8.0)  # it turns there by itself
    allowed = encoder_error(GEOMETRY, rig.machine.usable(path))[0] + np.radians(0.1)
    assert angle_between(rig.axis, path) <= allowed
    side = np.cross(path, (0.3, 1.0, 0.2))
    side /= np.linalg.norm(side)
    for push in (side, np.cross(path, side)):
        lever = PROFILE.needle_length - rig.depth
        beside = path - push * 5.0 / (300.0 * lever)  # the hub goes the other way
        rig.hand(beside / np.linalg.norm(beside))
        rows = rig.run(2.5)
        pull = np.linalg.norm(rows[-1][[sv.PULL_X, sv.PULL_Y, sv.PULL_Z]])
        assert pull == pytest.approx(5.0, rel=0.1)
        worst = max(
            angle_between(rig.machine.axis(row[sv.PLANT_Q]), path) for row in rows[-1000::50]
        )
        assert worst <= allowed
        assert not rows[:, sv.FAULT].any()


def test_while_it_turns_by_itself_the_hub_is_slow_and_a_hand_that_resists_is_not_pushed():
    rig = HolderRig(HOLDS, leaning(30.0, 60.0))
    rig.hand((0.0, 0.0, -1.0), holds=False)
    rows = rig.run(6.0)
    speed = np.linalg.norm(rows[:, sv.HUB_V], axis=1)
    assert speed.max() < 0.12
    rig = HolderRig(HOLDS, leaning(30.0, 60.0))
    rig.hand((0.0, 0.0, -1.0), holds=True)
    rows = rig.run(6.0)
    pull = np.linalg.norm(rows[:, [sv.PULL_X, sv.PULL_Y, sv.PULL_Z]], axis=1)
    assert pull.max() < PROFILE.limits.hand_force + 1.0
    assert angle_between(rig.axis, leaning(30.0, 60.0)) > np.radians(20.0)


def test_a_hand_that_presses_by_more_than_five_newtons_is_not_pushed_on_near_the_path_either():
    lever = PROFILE.needle_length - HolderRig(HOLDS, leaning(0.0, 0.0)).depth
    path = leaning(np.degrees(6.5 / (300.0 * lever)), 60.0)  # at the path the hand presses by 6.5 N
    rig = HolderRig(HOLDS, path)
    rig.hand((0.0, 0.0, -1.0), holds=True)
    rows = rig.run(6.0)
    pull = np.linalg.norm(rows[:, [sv.PULL_X, sv.PULL_Y, sv.PULL_Z]], axis=1)
    assert 4.5 < pull[-1] < PROFILE.limits.hand_force + 0.3
    rig.hand(path, holds=True)  # it gives way, and the guide goes on
    rig.run(6.0)
    assert angle_between(rig.axis, path) < np.radians(0.6)


def test_tensions_give_the_torques_within_their_limits_or_say_what_is_missing():
    for dial, path in ((1.0, leaning(25.0, 30.0)), (-1.0, leaning(5.0, 200.0))):
        rig = HolderRig(PULLS, path, dial=dial)
        rows = rig.run(1.5)[::25]
        assert np.abs(rows[:, sv.TORQUE]).max() > 1e-3
        for row in rows:
            tension = row[sv.TENSION]
            assert (tension >= PROFILE.cables.least - 1e-12).all()
            assert (tension <= PROFILE.cables.most + 1e-12).all()
            had = torques(GEOMETRY, row[sv.Q], tension)
            assert had + row[sv.SHORTFALL] == pytest.approx(row[sv.TORQUE], abs=1e-10)
        assert not rows[:, sv.FAULT].any()


def test_guidance_by_force_turns_the_needle_to_the_path_and_repulsion_away_from_it():
    path = leaning(10.0, 40.0)
    for dial, nearer in ((1.0, True), (-1.0, False)):
        rig = HolderRig(PULLS, path, start=leaning(14.0, 50.0), dial=dial)
        before = angle_between(rig.axis, path)
        rig.hand(rig.axis, holds=False)
        rows = rig.run(1.0)
        assert (angle_between(rig.axis, path) < before) is nearer
        speed = np.linalg.norm(rows[:, sv.HUB_V], axis=1)
        assert speed.max() < PROFILE.let_go.speed + 0.15  # 2000 counts tell a speed late


@pytest.mark.parametrize("cable", range(4))
@pytest.mark.parametrize("requests", [HOLDS, PULLS])
@pytest.mark.parametrize("profile", [PROFILE, by_current()], ids=["sensor", "current"])
def test_a_torn_cable_ends_the_force_within_twenty_milliseconds_and_is_named(
    cable, requests, profile
):
    rig = HolderRig(requests, leaning(12.0, 70.0), profile=profile)
    rig.run(3.0)
    rig.tear(cable)
    rows = rig.run(0.2)
    ended = int(np.argmax(rows[:, sv.FAULT] != 0.0))
    assert rows[ended, sv.FAULT] == Fault.CABLE_BROKEN
    assert 0 < ended <= LATEST + 2
    assert not rows[ended:][:, sv.TENSION].any()
    assert not rows[ended:][:, sv.TORQUE].any()


@pytest.mark.parametrize("requests", [HOLDS, PULLS])
def test_a_cable_that_hangs_ends_the_force_and_is_named(requests):
    rig = HolderRig(requests, leaning(12.0, 70.0))
    rig.run(3.0)
    rig.block(1, 0.02)
    rows = rig.run(0.2)
    ended = int(np.argmax(rows[:, sv.FAULT] != 0.0))
    assert rows[ended, sv.FAULT] == Fault.CABLE_SLACK
    assert 0 < ended <= LATEST
    assert not rows[ended:][:, sv.TENSION].any()


@pytest.mark.parametrize("how", [2.0, 3.0])
def test_an_encoder_that_gives_nothing_ends_the_force_and_is_named(how):
    rig = HolderRig(PULLS, leaning(12.0, 70.0))
    rig.run(2.0)
    rig.encoder[0] = how
    rows = rig.run(0.1)
    ended = int(np.argmax(rows[:, sv.FAULT] != 0.0))
    assert rows[ended, sv.FAULT] == Fault.ENCODER_LOST
    assert ended <= LATEST
    assert not rows[ended:][:, sv.TENSION].any()
    assert np.isfinite(rows[:, sv.TORQUE]).all()


@pytest.mark.parametrize("requests", [HOLDS, PULLS])
def test_an_encoder_that_sticks_is_told_by_its_cables(requests):
    rig = HolderRig(requests, leaning(20.0, 70.0))
    rig.encoder[0] = 1.0
    if requests is PULLS:
        rig.run(0.5)
        rig.hand(leaning(20.0, 70.0))
    rows = rig.run(4.0)
    ended = int(np.argmax(rows[:, sv.FAULT] != 0.0))
    assert rows[ended, sv.FAULT] == Fault.ENCODER_LOST
    beside = np.abs(rows[:, sv.PLANT_Q_LEFT] - rows[:, sv.Q_LEFT])
    shown = int(np.argmax(beside > 0.04))
    assert 0 < ended <= shown + LATEST
    assert not rows[ended:][:, sv.TENSION].any()


def test_after_disarming_a_whole_machine_goes_on_and_a_torn_one_does_not():
    rig = HolderRig(PULLS)
    rig.run(1.0)
    rig.encoder[0] = 3.0
    rig.run(0.1)
    rig.encoder[0] = 0.0
    rig.loop.inbox.write(enabled=0.0)
    rig.run(0.3)
    rig.loop.inbox.write(enabled=1.0)
    assert not rig.run(1.0)[:, sv.FAULT].any()
    rig.tear(2)
    rig.run(0.1)
    rig.loop.inbox.write(enabled=0.0)
    rig.run(0.3)
    rig.loop.inbox.write(enabled=1.0)
    assert rig.run(1.5)[-1, sv.FAULT] == Fault.CABLE_BROKEN


def test_a_machine_whose_motors_push_cannot_hold_a_direction():
    with pytest.raises(LawError, match="cannot hold a direction by itself"):
        laws.stages_of(HOLDS, load_profile("icube"))
