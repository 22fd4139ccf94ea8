"""The trainer in virtual time, on fakes of loop and tracker."""

import json
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from session_fakes import Bench

from app.core.errors import NumericalError
from app.core.events import Event
from app.core.transform import rotation_between
from app.device.errors import LoopError
from app.exercises.drill import DrillKind, DrillPart
from app.planning.placement import PlacedPlan, Placement
from app.session.errors import IllegalTransitionError, NotReadyError, SessionError
from app.session.machine import State
from app.session.recording import read_recording
from app.session.store import list_sessions


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    yield bench
    bench.trainer.close()


def test_one_insertion_goes_through_every_state_and_is_scored(bench: Bench) -> None:
    bench.run(0.1)
    bench.trainer.begin("s-7f3a")
    bench.insertion(0.0612, x=0.01)
    assert bench.trainer.snapshot().state is State.HOLDING
    bench.trainer.scan()
    result = bench.trainer.end()
    states = [e.data["state"] for e in bench.trainer.events.drain() if e.kind == "state"]
    assert states == ["aligning", "inserting", "holding", "ended"]
    assert result.score is not None
    assert result.score.void_reason == ""
    assert result.score.row("lateral_error").value == pytest.approx(0.612, abs=0.02)
    assert result.score.row("depth_error").value == pytest.approx(1.2, abs=0.05)
    assert result.scans == 1
    assert result.duration == pytest.approx(5.5, abs=1e-6)
    assert set(result.phases) == {State.ALIGNING, State.INSERTING, State.HOLDING}
    assert sum(result.phases.values()) == pytest.approx(result.duration)


def test_the_record_gives_the_same_trajectory_and_score_as_the_attempt_did(bench: Bench) -> None:
    bench.run(0.1)
    bench.trainer.begin("s-7f3a")
    bench.insertion(0.058, x=0.02, y=-0.01)
    result = bench.trainer.end()
    assert result.record is not None
    recording = read_recording(result.record)
    again = recording.trajectory()
    live = result.trajectory
    assert live is not None
    assert recording.complete
    assert recording.problems == ()
    for name in ("time", "tip", "axis", "depth", "felt", "phase", "depth_valid", "hub", "guide"):
        np.testing.assert_array_equal(getattr(again, name), getattr(live, name), err_msg=name)
    assert json.loads(recording.attachments["score.json"])["total"] == result.score.total
    assert recording.attachments["plan.mrk.json"] == b"{}"
    assert recording.placed_plan().p_target == pytest.approx(bench.placed.p_target, abs=1e-15)


def test_every_tick_of_the_loop_stands_in_the_record(bench: Bench) -> None:
    bench.run(0.2)
    bench.trainer.begin()
    bench.run(3.0, 0.03)
    result = bench.trainer.end()
    inputs = read_recording(result.record).inputs
    ticks = inputs.column("tick")
    assert inputs.lost == 0
    np.testing.assert_array_equal(ticks, np.arange(201, 201 + 3000))
    assert inputs.column("hand_depth")[-1] == pytest.approx(0.03)


def test_rows_overwritten_before_they_were_read_are_counted_as_lost(bench: Bench) -> None:
    bench.loop.ring = 50
    bench.trainer.begin()
    bench.trainer.step(20)
    bench.trainer.step(400)
    snapshot = bench.trainer.step(20)
    assert snapshot.recording is not None
    assert snapshot.recording.lost_rows > 300
    assert any("not recorded" in message for message in snapshot.messages)
    result = bench.trainer.end()
    recording = read_recording(result.record)
    assert recording.inputs.lost == snapshot.recording.lost_rows
    assert any("lost" in problem for problem in recording.problems)
    assert any("lost" in problem for problem in result.summary.problems)


def test_begin_arms_the_forces_and_end_disarms_them(bench: Bench) -> None:
    bench.run(0.1)
    assert bench.loop.inbox.values.get("enabled", 0.0) == 0.0
    bench.trainer.begin()
    assert bench.loop.inbox.values["enabled"] == 1.0
    assert bench.loop.inbox.values["assistance"] == 0.5
    assert bench.loop.inbox.values["path_z"] == pytest.approx(-1.0)
    assert bench.loop.inbox.values["target_z"] == pytest.approx(0.03)
    bench.run(0.1)
    bench.trainer.end()
    assert bench.loop.inbox.values["enabled"] == 0.0


def test_the_tracked_depth_reaches_the_loop_once_per_fix_once_ten_have_agreed(bench: Bench) -> None:
    bench.run(1.0, 0.03)
    told = [w for w in bench.loop.inbox.writes if "tracked_depth" in w]
    refused = [w for w in bench.loop.inbox.writes if w.get("tracked_time") == 0.0]
    assert len(told) == len({w["tracked_time"] for w in told})
    assert len(refused) == 10
    assert 25 <= len(told) + len(refused) <= 31
    assert told[-1]["tracked_depth"] == pytest.approx(0.03, abs=0.003)
    assert told[-1]["tracked_variance"] == pytest.approx(1e-8)


@pytest.mark.promise("README.md: out of view is said, never guessed")
def test_a_marker_out_of_view_is_said_and_moves_nothing(bench: Bench) -> None:
    bench.trainer.begin()
    bench.run(0.6)
    bench.tracker.status = "out_of_view"
    snapshot = bench.run(0.16)
    assert snapshot.pose.depth_source == "held"
    snapshot = bench.run(1.0, 0.03)
    assert "marker out of view" in snapshot.messages
    assert snapshot.pose.depth_source == "model"
    assert snapshot.state is State.ALIGNING


def test_a_fault_of_the_device_aborts_with_its_reason(bench: Bench) -> None:
    bench.run(0.1)
    bench.trainer.begin()
    bench.run(0.5)
    bench.loop.extra["fault"] = 8.0
    snapshot = bench.run(0.04)
    assert snapshot.state is State.ABORTED
    assert "encoders" in snapshot.reason
    assert not snapshot.armed
    assert bench.trainer.result is not None
    assert bench.trainer.result.score.void_reason.startswith("the attempt was aborted")
    assert list_sessions(bench.folder)[0].state == "aborted"


def test_a_fault_of_the_tracker_aborts_with_its_reason_and_other_news_do_not(bench: Bench) -> None:
    bench.run(0.1)
    bench.tracker.events.put(Event(100.0, "fault", "before the attempt"))
    bench.run(0.02)
    bench.trainer.begin()
    bench.tracker.events.put(Event(bench.clock.now(), "camera", "camera left was unplugged"))
    assert bench.run(0.1).state is State.ALIGNING
    bench.tracker.events.put(Event(bench.clock.now(), "fault", "the tracker failed"))
    assert bench.run(0.02).reason == "the tracker failed"
    told = {event.message for event in bench.trainer.events.drain()}
    assert {"before the attempt", "camera left was unplugged", "the tracker failed"} <= told


def test_a_queue_shared_with_the_tracker_is_not_drained_in_circles(bench: Bench) -> None:
    bench.tracker.events = bench.trainer.events
    bench.trainer.begin()
    bench.run(0.2)
    assert len(bench.trainer.events.drain()) == 1


def test_a_loop_that_stands_still_aborts_the_attempt(bench: Bench) -> None:
    bench.run(0.1)
    bench.trainer.begin()
    bench.run(0.5)
    bench.loop.frozen = True
    snapshot = bench.run(0.2)
    assert snapshot.state is State.ALIGNING
    assert not snapshot.pose.valid
    snapshot = bench.run(0.6)
    assert snapshot.state is State.ABORTED
    assert "the loop has stopped" in snapshot.reason


def test_a_loop_that_never_ran_aborts_the_attempt(bench: Bench) -> None:
    bench.loop.frozen = True
    bench.trainer.begin()
    snapshot = bench.run(1.0)
    assert snapshot.state is State.ABORTED
    assert "loop" in snapshot.reason


def test_a_fault_left_from_before_arming_does_not_abort(bench: Bench) -> None:
    bench.loop.extra["fault"] = 9.0
    bench.run(0.1)
    bench.trainer.begin()
    bench.run(0.06)
    bench.loop.extra.clear()
    assert bench.run(0.5).state is State.ALIGNING


def test_attempts_follow_one_another_each_with_its_own_record(bench: Bench) -> None:
    ids = []
    for _ in range(3):
        ids.append(bench.trainer.begin("a"))
        bench.run(0.3)
        bench.trainer.end()
    assert len(set(ids)) == 3
    assert [s.id for s in list_sessions(bench.folder)] == sorted(ids, reverse=True)


def test_begin_during_an_attempt_is_refused_and_disturbs_nothing(bench: Bench) -> None:
    bench.trainer.begin()
    bench.run(0.2)
    with pytest.raises(IllegalTransitionError, match="aligning"):
        bench.trainer.begin()
    with pytest.raises(IllegalTransitionError, match="plan cannot change"):
        bench.trainer.place(bench.placed)
    assert bench.run(0.1).state is State.ALIGNING
    assert len(list(bench.folder.glob("*.mcap"))) == 1


def test_scan_and_end_need_a_running_attempt(bench: Bench) -> None:
    with pytest.raises(IllegalTransitionError, match="ready"):
        bench.trainer.scan()
    with pytest.raises(IllegalTransitionError, match="begin"):
        bench.trainer.end()
    assert bench.trainer.abort() is None


def test_an_attempt_ended_at_once_is_recorded_and_says_why_it_has_no_score(bench: Bench) -> None:
    bench.trainer.begin()
    result = bench.trainer.end()
    assert result.duration == 0.0
    assert result.score is None
    assert "no sample" in result.unscored
    recording = read_recording(result.record)
    assert recording.complete
    with pytest.raises(SessionError, match="no sample"):
        recording.trajectory()


def test_an_attempt_ended_after_one_tick_is_void(bench: Bench) -> None:
    bench.trainer.begin()
    bench.run(0.02)
    result = bench.trainer.end()
    assert result.score is not None
    assert result.score.total is None
    assert result.score.void_reason == "nothing measured how deep the needle was"


def test_a_folder_that_cannot_be_written_lets_the_attempt_go_on(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    bench = Bench(blocked / "sessions")
    bench.run(0.1)
    bench.trainer.begin()
    bench.insertion(0.06)
    assert any("cannot record" in m for m in bench.trainer.snapshot().messages)
    result = bench.trainer.end()
    assert result.record is None
    assert result.score is not None
    assert result.score.total is not None
    assert any("cannot record" in p for p in result.summary.problems)
    kinds = {e.kind for e in bench.trainer.events.drain()}
    assert "recorder" in kinds


def test_another_plan_is_taken_between_attempts(bench: Bench) -> None:
    tilted = Placement().turned(np.array([0.3, 0.0, 0.0]))
    placed = PlacedPlan.of(bench.placed.plan, tilted, bench.placed.p_entry)
    bench.trainer.place(placed)
    turned = rotation_between(bench.placed.axis, placed.axis) @ bench.placed.axis
    assert bench.loop.inbox.values["path_y"] == pytest.approx(turned[1])


def test_inputs_that_are_not_numbers_never_reach_the_loop(bench: Bench) -> None:
    for wrong in (np.nan, np.inf):
        with pytest.raises(NumericalError):
            bench.trainer.hand(0.0, 0.0, wrong, True)
        with pytest.raises(NumericalError):
            bench.trainer.assistance(wrong)
    bench.trainer.assistance(7.0)
    assert bench.loop.inbox.values["assistance"] == 1.0


def test_the_snapshot_says_how_far_it_is_to_the_target(bench: Bench) -> None:
    bench.run(0.5, 0.02, x=0.1)
    snapshot = bench.run(1.0, 0.02, x=0.1)
    assert snapshot.offset.remaining == pytest.approx(0.06 - 0.02 * np.sqrt(0.99), abs=1e-4)
    assert snapshot.offset.lateral == pytest.approx(0.002, abs=1e-9)
    assert snapshot.offset.angle == pytest.approx(np.arcsin(0.1), abs=1e-12)


def test_a_moving_target_moves_the_offset(bench: Bench) -> None:
    bench.loop.extra["target_shift_y"] = 0.005
    snapshot = bench.run(0.2, 0.06)
    # Across the path to the target as it is now: 5 mm aside at 60 mm, from the entry.
    aside = np.arctan2(0.005, 0.06)
    assert snapshot.offset.lateral == pytest.approx(snapshot.pose.depth * np.sin(aside), abs=1e-9)
    assert snapshot.offset.angle == pytest.approx(aside, abs=1e-9)


def test_open_and_close_start_and_stop_everything_once(tmp_path: Path) -> None:
    others = set(threading.enumerate())  # that other tests left to their end
    bench = Bench(tmp_path)
    bench.trainer.open()
    bench.trainer.open()
    assert (bench.loop.opened, bench.tracker.opened) == (1, 1)
    assert any(thread.name == "acus-ticker" for thread in threading.enumerate())
    with pytest.raises(NotReadyError, match="still starting"):
        bench.trainer.begin()
    bench.loop.step(20)
    bench.trainer.begin()
    bench.trainer.close()
    bench.trainer.close()
    assert (bench.loop.opened, bench.tracker.opened) == (0, 0)
    assert bench.trainer.snapshot().state is State.ABORTED
    assert bench.trainer.result is not None
    assert bench.trainer.result.reason == "the trainer was closed"
    mine = set(threading.enumerate()) - others
    assert not [thread for thread in mine if thread.name.startswith("acus-")]


def test_a_tracker_that_cannot_open_leaves_nothing_open(tmp_path: Path) -> None:
    bench = Bench(tmp_path)

    def refuse() -> None:
        raise NumericalError("no camera")

    bench.tracker.open = refuse
    with pytest.raises(NumericalError, match="no camera"):
        bench.trainer.open()
    assert bench.loop.opened == 0


def test_a_fault_of_the_program_in_the_ticker_switches_the_forces_off(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench = Bench(tmp_path)
    bench.run(0.1)
    died = threading.Event()
    monkeypatch.setattr(threading, "excepthook", lambda args: died.set())
    bench.trainer.open()
    bench.trainer.begin()
    bench.loop.latest = lambda: 1 / 0
    assert died.wait(30.0)
    assert bench.loop.inbox.values["enabled"] == 0.0
    assert bench.trainer.result is not None
    assert "ZeroDivisionError" in bench.trainer.result.reason
    bench.trainer.close()


def test_a_loop_that_has_ended_leaves_no_valid_pose_even_between_attempts(bench: Bench) -> None:
    assert bench.run(1.0, -0.02).pose.valid

    def ended() -> None:
        raise LoopError("the loop has ended: out of memory")

    bench.loop.latest = ended  # type: ignore[assignment,method-assign]
    snapshot = bench.trainer.tick(bench.clock.now() + 1.0)
    assert not snapshot.pose.valid
    assert snapshot.device is None
    assert "the loop has ended: out of memory" in snapshot.messages


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_after_a_fault_of_the_program_the_forces_are_off_and_stay_off(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench.run(0.5, -0.02)
    bench.trainer.open()
    bench.trainer.begin("s-1")

    def broken(placed: PlacedPlan, now: float) -> None:
        raise ZeroDivisionError("nobody thought of it")

    monkeypatch.setattr(bench.trainer._sources, "observe", broken)
    deadline = time.monotonic() + 30.0
    while bench.trainer.result is None and time.monotonic() < deadline:
        time.sleep(0.01)
    assert bench.trainer.result is not None
    assert "ZeroDivisionError: nobody thought of it" in bench.trainer.result.reason
    assert bench.loop.inbox.values["enabled"] == 0.0
    with pytest.raises(NotReadyError, match="open it again"):
        bench.trainer.begin("s-1")
    assert bench.loop.inbox.values["enabled"] == 0.0
    bench.trainer.close()


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("kind", "lasts"), [("align", 2.7), ("depth", None), ("breath", None), ("repeat", 9.0)]
)
def test_a_drill_ends_by_itself_scored_and_whole_exercises_do_not(
    tmp_path: Path, kind: str, lasts: float | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The needle is pushed from 20 mm before the skin by 27 mm/s, and stays in the body."""
    monkeypatch.setattr("app.exercises.drill.ROUND_S", 9.0)
    bench = Bench(tmp_path, drill=DrillPart(kind=DrillKind(kind), of="liver-01"))
    bench.run(0.1)
    bench.trainer.begin("s-7f3a")
    bench.insertion(0.06)
    bench.run(5.0, 0.06)
    result = bench.trainer.result
    bench.trainer.close()
    if lasts is None:
        assert result is None  # until the trainer was closed
        return
    assert result is not None
    assert result.duration == pytest.approx(lasts, abs=1.6)
    assert result.trajectory is not None
    assert (kind == "align") == bool(result.trajectory.depth.max() < 0.03)
