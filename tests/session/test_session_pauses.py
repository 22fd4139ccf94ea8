"""Attempts pause without cameras, go on with them; what is shown is ahead of what is recorded."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from session_fakes import Bench

from app.core.arrays import read_only
from app.core.events import Event
from app.session.conditions import computer_of
from app.session.fusion import DISPLAY_LATENCY, FARTHEST, moment, predicted
from app.session.machine import AttemptEvent, State
from app.session.needle import DepthSource, NeedlePose
from app.session.recording import read_recording
from app.session.transitions import (
    BACK,
    LOST,
    PauseCause,
    Pauses,
    excused,
    paused_words,
    waited_for_computer,
)
from app.session.verify import verify
from app.tracking.motion.depth_filter import HAND_SPEED, DepthMotion

DOWN = np.array([0.0, 0.0, -1.0])


def pose(time: float, source: DepthSource = DepthSource.TRACKED, age: float = 0.04) -> NeedlePose:
    return NeedlePose(
        p_tip=read_only(np.array([0.0, 0.16, 0.04])),
        axis=read_only(DOWN.copy()),
        depth=0.05,
        time=time,
        orientation_age=0.0,
        depth_age=age,
        depth_source=source,
        valid=source is not DepthSource.NONE,
        covariance=read_only(1e-9 * np.eye(3)),
    )


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    yield bench
    bench.trainer.close()


def _events(bench: Bench, kind: str) -> list[str]:
    return [event.message for event in bench.trainer.events.drain() if event.kind == kind]


def test_without_a_measured_depth_in_the_body_the_attempt_pauses_and_goes_on_by_itself(
    bench: Bench,
) -> None:
    bench.trainer.begin()
    bench.run(0.5, -0.02)
    bench.run(2.0, 0.04)
    bench.tracker.status = "out_of_view"
    assert bench.run(1.0).state is State.INSERTING
    snapshot = bench.run(0.5)
    assert snapshot.state is State.PAUSED
    assert not snapshot.armed
    assert bench.loop.inbox.values["enabled"] == 0.0
    assert any("clock stands still" in message for message in snapshot.messages)
    elapsed = snapshot.elapsed
    assert bench.run(3.0).elapsed == pytest.approx(elapsed)
    bench.tracker.status = "valid"
    assert bench.run(0.8).state is State.PAUSED, "ten pictures agree, then half a second"
    snapshot = bench.run(0.3)
    assert snapshot.state is State.INSERTING
    assert snapshot.armed
    assert snapshot.elapsed < elapsed + 0.3
    told = _events(bench, "pause")
    assert len(told) == 2
    assert "goes on" in told[1]


@pytest.mark.long("journey")
def test_a_pause_stands_in_the_record_and_in_the_times_and_too_long_ones_void_the_score(
    bench: Bench,
) -> None:
    bench.trainer.begin()
    bench.run(0.5, -0.02)
    bench.run(10.0, 0.055)
    bench.tracker.status = "out_of_view"
    bench.run(23.0)
    bench.tracker.status = "valid"
    bench.run(1.0)
    result = bench.trainer.end()
    assert result.phases[State.PAUSED] == pytest.approx(22.0 + BACK, abs=0.5)
    assert result.duration == pytest.approx(35.5 - 1.0 - result.phases[State.PAUSED], abs=1.5)
    assert result.score is not None
    assert result.score.total is None
    assert "waited" in result.score.void_reason


@pytest.mark.long("journey")
def test_a_short_pause_leaves_the_score_standing(bench: Bench) -> None:
    bench.trainer.begin()
    bench.insertion()
    bench.tracker.status = "out_of_view"
    bench.run(2.0)
    bench.tracker.status = "valid"
    bench.run(8.0)
    result = bench.trainer.end()
    assert result.score is not None
    assert result.score.void_reason == ""
    assert result.score.row("tracking_valid").value < 95.0


@pytest.mark.long("journey")
def test_a_lost_camera_on_the_way_in_lets_the_path_be_judged_from_the_skin_on(bench: Bench) -> None:
    bench.trainer.begin()
    bench.run(0.5, -0.02)
    bench.run(2.0, 0.04)
    bench.tracker.status = "out_of_view"
    assert bench.run(1.6).state is State.PAUSED
    bench.tracker.status = "valid"
    bench.run(1.5)
    bench.run(1.0, 0.06)
    bench.run(2.0, 0.06)
    score = bench.trainer.end().score
    assert score is not None
    assert score.row("frechet_distance").value < 20.0, "the target is 20 mm beyond the last place"
    assert score.row("path_ratio").value == pytest.approx(1.0, abs=0.02)
    (file,) = bench.folder.glob("*.mcap")
    assert verify(read_recording(file)).changes == ()


def test_a_pause_can_be_ended_and_its_forces_stay_off(bench: Bench) -> None:
    bench.trainer.begin()
    bench.run(2.0, 0.04)
    bench.tracker.status = "out_of_view"
    assert bench.run(1.6).state is State.PAUSED
    bench.trainer.disarm()
    assert bench.trainer.end().state is State.ENDED
    assert bench.loop.inbox.values["enabled"] == 0.0


def test_cameras_that_fall_silent_are_not_excused_by_what_they_said_last(bench: Bench) -> None:
    bench.trainer.begin()
    bench.run(2.0, 0.04)
    bench.tracker.status = "not_yet_visible"
    assert bench.run(2.0).state is State.INSERTING
    bench.tracker.seen = np.inf  # no fix any more
    snapshot = bench.run(2.0)
    assert snapshot.fix_status == "no_picture"
    assert snapshot.state is State.PAUSED


def _paused(source: DepthSource, state: State, status: str = "") -> bool:
    pauses = Pauses()
    pauses.judge(state, pose(0.0), "valid")
    return any(
        pauses.judge(state, pose(0.02 * k, source), status) is AttemptEvent.PAUSE
        for k in range(1, 200)
    )


@pytest.mark.promise("docs/sessions.md: never a pause")
def test_only_a_loss_in_the_body_pauses() -> None:
    assert _paused(DepthSource.MODEL, State.INSERTING)
    assert _paused(DepthSource.MODEL, State.HOLDING)
    assert not _paused(DepthSource.MODEL, State.ALIGNING)
    assert not _paused(DepthSource.ONE_CAMERA, State.INSERTING)
    assert not _paused(DepthSource.HELD, State.INSERTING)
    assert not _paused(DepthSource.NONE, State.INSERTING)  # the robot's trouble
    assert not _paused(DepthSource.MODEL, State.INSERTING, "not_yet_visible")


def test_a_marker_drawn_into_the_tube_in_a_pause_keeps_it_until_it_is_seen_again() -> None:
    pauses = Pauses()
    for k in range(60):
        event = pauses.judge(State.INSERTING, pose(0.02 * k, DepthSource.MODEL), "out_of_view")
        if event is not None:
            break
    assert event is AttemptEvent.PAUSE
    for k in range(100):
        seen = pose(2.0 + 0.02 * k, DepthSource.MODEL)
        assert pauses.judge(State.PAUSED, seen, "not_yet_visible") is None
    events = [pauses.judge(State.PAUSED, pose(5.0 + 0.02 * k), "valid") for k in range(40)]
    assert events.index(AttemptEvent.RESUME) == pytest.approx(BACK / 0.02, abs=1)


def test_a_flickering_marker_neither_pauses_nor_resumes() -> None:
    pauses = Pauses()
    for k in range(400):
        seen = DepthSource.TRACKED if k % 20 == 0 else DepthSource.MODEL
        assert pauses.judge(State.INSERTING, pose(0.02 * k, seen), "") is None
    assert LOST > BACK
    for k in range(400):
        seen = DepthSource.MODEL if k % 20 == 0 else DepthSource.TRACKED
        assert pauses.judge(State.PAUSED, pose(8.0 + 0.02 * k, seen), "") is None


# --- a busy window --------------------------------------------------------------------------------
def _blocked(bench: Bench, seconds: float) -> Any:
    """Let time pass in which the window gives no sign of life."""
    snapshot = None
    for _ in range(round(seconds / 0.02)):
        bench.loop.step(20)
        now = bench.clock.now()
        bench.tracker.advance(now)
        if now - bench.loop.inbox.values["heartbeat"] > 1.0:
            bench.loop.extra["fault"] = 9.0 * bench.loop.inbox.values["enabled"]
        snapshot = bench.trainer.tick(now)
    bench.loop.extra["fault"] = 0.0
    return snapshot


@pytest.mark.long("journey")
@pytest.mark.parametrize(("depth", "state"), [(-0.02, State.ALIGNING), (0.04, State.INSERTING)])
def test_a_busy_window_pauses_and_the_attempt_goes_on_where_it_was(
    bench: Bench, depth: float, state: State
) -> None:
    bench.trainer.begin()
    before = bench.run(2.0, depth)
    assert before.state is state
    snapshot = _blocked(bench, 3.0)
    assert snapshot.state is State.PAUSED
    assert (before.pause, snapshot.pause) == (None, PauseCause.WINDOW)
    assert not snapshot.armed
    assert any(
        "computer is busy" in message and "close other programs" in message
        for message in snapshot.messages
    )
    assert snapshot.elapsed - before.elapsed == pytest.approx(1.0, abs=0.05)
    assert bench.run(0.4).state is State.PAUSED
    snapshot = bench.run(0.3)
    assert snapshot.state is state
    assert snapshot.armed
    result = bench.trainer.end()
    assert result.record is not None
    told = [dict(e.data) for e in read_recording(result.record).events if e.kind == "pause"]
    assert [data["cause"] for data in told] == ["window", "window"]
    assert told[1]["duration_s"] == pytest.approx(2.0 + BACK, abs=0.1)


@pytest.mark.long("journey")
def test_a_window_that_was_busy_for_long_voids_nothing(bench: Bench) -> None:
    bench.trainer.begin()
    bench.insertion()
    _blocked(bench, 40.0)
    bench.run(3.0, 0.06)
    result = bench.trainer.end()
    assert result.phases[State.PAUSED] > 38.0
    assert result.duration < 15.0
    assert result.score is not None
    assert result.score.void_reason == ""
    assert result.record is not None
    assert read_recording(result.record).trajectory().waited == pytest.approx(0.0, abs=0.1)


def test_an_attempt_that_ends_in_a_pause_says_how_long_it_was(bench: Bench) -> None:
    bench.trainer.begin()
    bench.run(2.0, 0.04)
    _blocked(bench, 5.0)
    result = bench.trainer.end()
    told = [e for e in result.events if e.kind == "pause"]
    assert told[-1].data["duration_s"] == pytest.approx(4.0, abs=0.1)


# --- shown ----------------------------------------------------------------------------------------
def test_the_shown_pose_is_ahead_by_age_and_display_and_says_so() -> None:
    measured = pose(10.0)
    assert moment(measured) == pytest.approx(10.0 + DISPLAY_LATENCY)
    ahead = predicted(measured, DepthMotion(moment(measured), 0.0535, 0.05, 4e-9))
    assert ahead.predicted == pytest.approx(0.04 + DISPLAY_LATENCY)
    assert ahead.rate == 0.05
    np.testing.assert_allclose(ahead.p_tip, measured.p_tip + 0.0035 * DOWN)
    assert ahead.covariance[2, 2] == pytest.approx(4e-9)
    assert ahead.covariance[0, 0] == pytest.approx(1e-9)


def test_a_depth_that_a_filter_follows_is_known_better_than_one_that_nothing_followed() -> None:
    measured = pose(10.0)
    aged = (HAND_SPEED * measured.depth_age) ** 2
    allowed = measured.covariance + aged * np.outer(measured.axis, measured.axis)
    measured = replace(measured, covariance=allowed)
    followed = predicted(measured, DepthMotion(moment(measured), measured.depth, 0.0, 1e-10))
    assert followed.covariance[2, 2] == pytest.approx(allowed[2, 2] - aged)
    assert np.linalg.eigvalsh(followed.covariance).min() > 0.0
    aged = (HAND_SPEED * 0.18) ** 2
    allowed = 1e-9 * np.eye(3) + aged * np.outer(measured.axis, measured.axis)
    old = replace(measured, depth_age=0.18, covariance=allowed)
    late = predicted(old, DepthMotion(moment(old), old.depth, 0.0, 1e-10))
    assert late.covariance[2, 2] == pytest.approx((HAND_SPEED * (0.18 - FARTHEST)) ** 2, rel=0.3)


def test_an_old_depth_is_predicted_no_further_than_its_limit() -> None:
    old = pose(10.0, DepthSource.HELD, age=0.18)
    assert moment(old) == pytest.approx(10.0 - 0.18 + FARTHEST)


@pytest.mark.parametrize("source", [DepthSource.MODEL, DepthSource.NONE])
def test_a_depth_that_no_camera_measured_is_not_predicted(source: DepthSource) -> None:
    other = pose(10.0, source)
    assert predicted(other, DepthMotion(10.03, 0.09, 0.5, 1e-9)) is other


@pytest.mark.promise("docs/sessions.md: Record, score and force never use a prediction")
def test_the_window_sees_the_prediction_and_the_record_the_measurement(bench: Bench) -> None:
    bench.trainer.begin()
    bench.run(0.5, -0.02)
    snapshot = bench.run(1.0, 0.03)  # 50 mm/s
    true = float(bench.loop.latest().depth)
    assert snapshot.pose.predicted > DISPLAY_LATENCY
    assert snapshot.measured_pose.predicted == 0.0
    assert snapshot.pose.depth == pytest.approx(true + 0.05 * DISPLAY_LATENCY, abs=0.3e-3)
    assert snapshot.measured_pose.depth < true + 1e-9
    result = bench.trainer.end()
    samples = read_recording(result.record).samples
    known = samples.radius[np.isfinite(samples.radius)]
    assert len(known) > 50
    assert read_recording(result.record).samples.tip_radius() == pytest.approx(np.median(known))
    assert known[-1] == pytest.approx(snapshot.measured_pose.radius, rel=0.01)
    assert result.trajectory.depth[-1] == pytest.approx(snapshot.measured_pose.depth)


# --- a computer that is too slow ----------------------------------------------------------------
@pytest.mark.parametrize(
    ("simulated", "status", "cause"),
    [
        (True, "no_picture", PauseCause.COMPUTER),
        (True, "valid", PauseCause.COMPUTER),  # seen, but too long ago whenever it is told
        (True, "no_orientation", PauseCause.COMPUTER),
        (False, "valid", PauseCause.CAMERAS),
        (True, "out_of_view", PauseCause.CAMERAS),
        (False, "no_picture", PauseCause.CAMERAS),
    ],
)
def test_pictures_of_simulated_cameras_that_do_not_come_are_the_computer_s_trouble(
    simulated: bool, status: str, cause: PauseCause
) -> None:
    pauses = Pauses()
    events = [
        pauses.judge(
            State.INSERTING, pose(0.02 * k, DepthSource.MODEL), status, simulated=simulated
        )
        for k in range(60)
    ]
    assert AttemptEvent.PAUSE in events
    assert pauses.cause is cause
    seen = [
        pauses.judge(State.PAUSED, pose(2.0 + 0.02 * k), "valid", simulated=simulated)
        for k in range(40)
    ]
    assert AttemptEvent.RESUME in seen


def test_no_pause_with_simulated_cameras_asks_for_a_marker_or_for_light() -> None:
    for cause in PauseCause:
        words = paused_words(cause, simulated=True)
        assert "show the marker" not in words
        assert " light" not in words
    assert "show the marker" in paused_words(PauseCause.CAMERAS)


@pytest.mark.parametrize("every", [0.3, 0.45])
def test_a_computer_that_draws_two_pictures_a_second_is_what_a_simulated_attempt_waits_for(
    tmp_path: Path, every: float
) -> None:
    """Each picture is told as late as it is apart from the next: valid, and never new."""
    bench = Bench(tmp_path, simulated=True)
    bench.trainer.begin()
    bench.run(0.5, -0.02)
    bench.run(2.0, 0.03)
    bench.tracker.every = bench.tracker.late = every
    snapshot = bench.run(3.0)
    told = [event for event in bench.trainer.events.drain() if event.kind == "pause"]
    bench.trainer.close()
    assert snapshot.state is State.PAUSED
    assert snapshot.pause is PauseCause.COMPUTER
    assert [event.data["cause"] for event in told] == ["computer"]
    assert not any("marker" in message for message in (*snapshot.messages, told[0].message))


def test_what_the_computer_could_not_do_is_named_in_the_conditions_and_excuses_nothing() -> None:
    def told(cause: str, seconds: object) -> Event:
        return Event(1.0, "pause", "", {"cause": cause, "duration_s": seconds})

    slow = [told("computer", 21.0), told("computer", 4.0), told("window", 3.0)]
    assert waited_for_computer(slow) == 25.0
    assert excused(slow) == 3.0
    assert computer_of(slow) == "too slow: the attempt waited 25 s for its simulated cameras"
    assert computer_of([told("cameras", 25.0)]) == ""
    slowed = [Event(1.0, "slowed", "", {"seconds": 40.0})]
    assert computer_of(slowed) == "too slow by 40 s: the simulated world was slowed with it"
    for bad in (float("nan"), "40", None, -3.0):
        assert computer_of([Event(1.0, "slowed", "", {"seconds": bad})]) == ""


def test_pictures_that_this_computer_draws_late_are_told_as_its_trouble_and_not_the_cameras(
    tmp_path: Path,
) -> None:
    bench = Bench(tmp_path, simulated=True)
    bench.trainer.begin()
    bench.run(2.0, 0.04)
    bench.tracker.seen = np.inf  # no fix any more
    bench.run(0.6)
    (told,) = _events(bench, "depth")
    assert "this computer is busy" in told
    assert "close other programs" in told
    bench.trainer.close()
