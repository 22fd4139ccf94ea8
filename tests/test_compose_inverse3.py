"""A Haply Inverse3 in the trainer, against a scripted service: its cursor is the needle."""

import time
from contextlib import suppress

import numpy as np
import pytest
from device.inverse3_rig import DEVICE, ScriptedService

from app.compose.hub_tracker import HubTracker
from app.compose.recomputed import replay_recording
from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.core.clock import VirtualClock
from app.core.events import EventQueue
from app.core.latest import Latest
from app.device.links import inverse3
from app.device.links.link import Hub, ToldHub
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from app.session.errors import IllegalTransitionError
from app.session.recording import read_recording
from app.tracking.fix import FixStatus
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")
EXERCISE = layered("first-insertion")
PROFILE = device_of(EXERCISE)
ENTRY = np.array([0.0, -0.12, 0.0])


def tracker(clock):
    told, fixes = ToldHub(Latest(), EventQueue()), []
    return told, fixes, HubTracker(told, PROFILE, clock, fixes.append)


def test_a_place_of_the_hub_is_one_fix_with_the_tip_at_its_depth():
    clock = VirtualClock(10.0)
    told, fixes, looks = tracker(clock)
    axis = np.array([0.6, 0.0, -0.8])
    told.latest.publish(Hub(tuple(axis.tolist()), 0.15, inside=True), 9.99)
    looks.look()
    looks.look()
    (fix,) = fixes
    assert fix.usable
    assert fix.time == 9.99
    assert fix.depth == pytest.approx(PROFILE.needle_length - 0.15)
    np.testing.assert_allclose(fix.p_tip_world, PROFILE.fulcrum + fix.depth * axis)
    assert looks.statistics().status is FixStatus.VALID
    assert looks.statistics().told_by == "Haply Inverse3"
    assert looks.inspect().pictures == ()


def test_a_hub_where_no_needle_can_be_and_one_that_is_told_no_more_give_no_tip():
    clock = VirtualClock(10.0)
    told, fixes, looks = tracker(clock)
    looks.look()
    told.latest.publish(Hub((0.0, 0.0, -1.0), 0.01, inside=False), 10.0)
    looks.look()
    clock.sleep(0.3)
    looks.look()
    assert [fix.status for fix in fixes] == [
        FixStatus.NO_PICTURE,
        FixStatus.OUT_OF_VIEW,
        FixStatus.NO_PICTURE,
    ]
    assert not any(fix.usable for fix in fixes)
    assert "lift it over the entry" in fixes[1].reason


def wait(ready, seconds=60.0):
    end = time.monotonic() + seconds
    while not ready():
        assert time.monotonic() < end
        time.sleep(0.02)


@pytest.mark.long("journey")
@pytest.mark.timeout(300)
def test_an_attempt_has_its_needle_from_the_cursor_and_its_record_is_computed_again(
    tmp_path, monkeypatch
):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("ACUS_SETTINGS", str(tmp_path / "settings"))
    monkeypatch.setattr(inverse3, "ANSWER_WITHIN", 0.1)  # the tests' computer is busy
    placed = placed_plan_of(EXERCISE, PROFILE, PLAN)
    service = ScriptedService(tuple((ENTRY - 0.22 * placed.axis).tolist()))
    setup = TrainerSetup(EXERCISE, placed, sessions=tmp_path / "sessions", port=service.name)
    rig = build_rig(setup)

    def depth(wanted):
        rig.trainer.heartbeat()
        pose = rig.trainer.snapshot().pose
        return pose is not None and abs(pose.depth - wanted) < 1e-3

    try:
        rig.trainer.open()
        wait(lambda: depth(PROFILE.needle_length - 0.22))
        np.testing.assert_allclose(rig.loop.latest().axis, placed.axis, atol=1e-3)
        rig.trainer.begin("tester")
        with suppress(IllegalTransitionError):  # its depth was measured outside
            rig.trainer.confirm_outside()
        for l_out in np.linspace(0.22, 0.18, 40).tolist():
            service.place = tuple((ENTRY - l_out * placed.axis).tolist())
            rig.trainer.heartbeat()
            time.sleep(0.03)
        with suppress(IllegalTransitionError):  # where the attempt was aborted
            rig.trainer.end()
        wait(lambda: rig.trainer.result is not None)
        result = rig.trainer.result
    finally:
        rig.close()
        service.close()
    assert service.force() == (0.0, 0.0, 0.0)
    recording = read_recording(result.record)
    assert recording.metadata["device"]["serial"] == DEVICE
    assert recording.metadata["device"]["force_cap"] == "1"
    assert recording.metadata["cameras"]["name"] == "Haply Inverse3"
    assert replay_recording(recording).first_difference is None
