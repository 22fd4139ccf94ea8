"""What a real hand needs: clearance, a held key, who held the needle, where a force comes from."""

import csv
import io
import json
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from session_fakes import EXERCISE, Bench

from app.device.errors import LinkError
from app.exchange.csv_export import trajectory_table
from app.session.context import RunContext
from app.session.errors import NotReadyError, SessionError
from app.session.machine import State
from app.session.recording import Recording, read_recording
from app.session.scan import scan
from app.session.trainer import Trainer


@dataclass
class Cleared:
    homed: float = 1.0
    force_cap: float = 5.0
    reason: str = ""


Make = Callable[..., Bench]


@pytest.fixture
def make(tmp_path: Path) -> Iterator[Make]:
    """Benches whose trainers take options; closed at the end."""
    made: list[Bench] = []

    def bench_with(**options: Any) -> Bench:
        bench = Bench(tmp_path)
        parts = (bench.loop, bench.tracker, bench.placed, EXERCISE)
        context = options.pop("context", bench.context)
        virtual = {"clock": bench.clock, "advance": bench.tracker.advance}
        bench.trainer = Trainer(*parts, context, **virtual, **options)
        made.append(bench)
        return bench

    yield bench_with
    for bench in made:
        bench.trainer.close()


def recorded(bench: Bench) -> Recording:
    result = bench.trainer.end()
    assert result.record is not None
    return read_recording(result.record)


# --- clearance --------------------------------------------------------------------------------
def test_the_clearance_is_written_when_it_changes_and_shown(make: Make) -> None:
    cleared = Cleared(force_cap=1.0, reason="forces are held to 1 N")
    bench = make(clearance=lambda: cleared)
    bench.run(0.2)
    snapshot = bench.trainer.snapshot()
    assert snapshot.clearance is cleared
    assert "forces are held to 1 N" in snapshot.messages
    assert (bench.loop.inbox.values["homed"], bench.loop.inbox.values["force_cap"]) == (1.0, 1.0)
    cleared.force_cap, cleared.reason = 5.0, ""
    snapshot = bench.run(0.2)
    assert bench.loop.inbox.values["force_cap"] == 5.0
    assert "forces are held to 1 N" not in snapshot.messages
    assert len([w for w in bench.loop.inbox.writes if "force_cap" in w]) == 2


def test_no_attempt_begins_on_a_robot_that_is_not_homed(make: Make, tmp_path: Path) -> None:
    cleared = Cleared(0.0, 0.0, "no force: the robot was not homed since it was switched on")
    bench = make(clearance=lambda: cleared)
    with pytest.raises(NotReadyError, match="not homed"):
        bench.trainer.begin()
    assert not list(tmp_path.glob("*.mcap"))
    assert bench.loop.inbox.values.get("enabled", 0.0) == 0.0
    cleared.homed, cleared.force_cap = 1.0, 1.0
    bench.trainer.begin()
    assert bench.trainer.snapshot().armed


def test_a_device_that_cannot_be_asked_is_cleared_for_nothing(make: Make) -> None:
    def unplugged() -> Cleared:
        raise LinkError("the robot does not answer")

    bench = make(clearance=unplugged)
    snapshot = bench.run(0.1)
    assert (bench.loop.inbox.values["homed"], bench.loop.inbox.values["force_cap"]) == (0.0, 0.0)
    assert "the robot does not answer" in snapshot.messages
    with pytest.raises(NotReadyError, match="does not answer"):
        bench.trainer.begin()


def test_without_a_clearance_nobody_overwrites_what_the_builder_wrote(make: Make) -> None:
    bench = make()
    bench.trainer.begin()
    bench.run(0.1)
    assert not [w for w in bench.loop.inbox.writes if "homed" in w]
    assert bench.trainer.snapshot().clearance is None


# --- held arming --------------------------------------------------------------------------------
def enabled(bench: Bench) -> float:
    return bench.loop.inbox.values.get("enabled", 0.0)


def test_with_a_held_key_an_attempt_begins_without_force_and_follows_the_key(make: Make) -> None:
    bench = make(held_arming=True)
    bench.trainer.begin()
    snapshot = bench.run(0.1)
    assert (snapshot.held_arming, snapshot.armed, enabled(bench)) == (True, False, 0.0)
    bench.trainer.arm()
    assert bench.run(0.1).armed
    assert enabled(bench) == 1.0
    bench.trainer.disarm()
    assert enabled(bench) == 0.0
    bench.trainer.arm()
    recording = recorded(bench)
    assert enabled(bench) == 0.0
    changes = recording.inputs.column("enabled")
    assert changes.min() == 0.0
    assert changes.max() == 1.0


@pytest.mark.parametrize(
    ("fault", "silence", "held", "ends"),
    [
        (10.0, 0.0, True, False),
        (12.0, 0.3, True, False),
        (12.0, 1.2, True, True),
        (8.0, 0.3, True, True),
        (10.0, 0.0, False, True),
    ],
)
def test_an_attempt_outlives_only_what_arming_again_ends(
    make: Make, fault: float, silence: float, held: bool, ends: bool
) -> None:
    bench = make(held_arming=held)
    bench.run(0.1)
    bench.trainer.begin()
    bench.run(0.5)
    bench.loop.extra["fault"] = fault
    bench.loop.extra["q_time"] = bench.loop.clock.now() - silence
    assert (bench.run(0.2).state is State.ABORTED) is ends


@pytest.mark.promise(
    "docs/sessions.md: after the attempt has ended, was aborted or has failed, a key that is "
    "still down does nothing"
)
@pytest.mark.parametrize("ending", ["end", "abort", "fault", "close"])
def test_a_key_that_stays_down_gives_no_force_after_the_attempt(make: Make, ending: str) -> None:
    bench = make(held_arming=True)
    bench.run(0.1)
    bench.trainer.begin()
    bench.trainer.arm()
    bench.run(0.2)
    if ending == "fault":
        bench.loop.extra["fault"] = 8.0
        bench.run(0.04)
    else:
        getattr(bench.trainer, ending)()
    assert enabled(bench) == 0.0
    bench.trainer.arm()
    assert enabled(bench) == 0.0
    assert not bench.trainer.snapshot().armed


def test_a_key_pressed_while_an_attempt_ends_never_leaves_the_forces_on(make: Make) -> None:
    bench = make(held_arming=True)
    stop = threading.Event()

    def press() -> None:
        while not stop.is_set():
            bench.trainer.arm()

    presser = threading.Thread(target=press)
    presser.start()
    try:
        for _ in range(5):
            bench.trainer.begin()
            bench.run(0.02)
            bench.trainer.end()
    finally:
        stop.set()
        presser.join()
    assert enabled(bench) == 0.0


def test_without_a_held_key_an_attempt_begins_armed(make: Make) -> None:
    bench = make()
    bench.trainer.begin()
    assert enabled(bench) == 1.0
    assert not bench.trainer.held_arming


# --- who held the needle ------------------------------------------------------------------------
@pytest.mark.parametrize("hand", ["mouse", "tablet", "gamepad", "keyboard", "robot"])
def test_the_hand_stands_in_the_record(make: Make, hand: str) -> None:
    bench = make()
    bench.trainer.begin("s-1", hand)
    bench.run(0.1)
    assert recorded(bench).metadata["trainee"]["hand"] == hand


def test_a_scripted_trainee_is_the_hand_whatever_is_asked(make: Make, tmp_path: Path) -> None:
    context = RunContext(folder=tmp_path, metadata={"trainee": {"scripted": "expert"}})
    bench = make(context=context)
    bench.trainer.begin("s-1", "mouse")
    assert recorded(bench).metadata["trainee"] == {"scripted": "expert", "hand": "script"}


def test_an_unknown_hand_is_refused_with_the_valid_ones(make: Make) -> None:
    bench = make()
    with pytest.raises(SessionError, match=r"'foot'.*mouse, keyboard, tablet"):
        bench.trainer.begin("s-1", "foot")
    assert bench.trainer.begin("s-1")


# --- where the depth comes from -----------------------------------------------------------------
def depth_news(bench: Bench) -> list[str]:
    return [e.message for e in bench.trainer.events.drain() if e.kind == "depth"]


def test_the_loss_of_the_needle_is_said_once_and_its_return_once(make: Make) -> None:
    bench = make()
    bench.run(0.3)
    bench.trainer.begin()
    bench.run(0.5)
    assert depth_news(bench) == []
    bench.tracker.status = "out_of_view"
    bench.run(0.16)
    assert depth_news(bench) == [], "held for 200 ms"
    bench.run(2.0)
    (lost,) = depth_news(bench)
    assert "200 ms" in lost
    assert "not measured" in lost
    bench.tracker.status = "valid"
    bench.run(0.5)
    assert depth_news(bench) == []
    bench.run(1.0)
    (found,) = depth_news(bench)
    assert "again" in found
    assert [e.kind for e in recorded(bench).events].count("depth") == 2


def test_fixes_that_come_and_go_are_told_once(make: Make) -> None:
    bench = make()
    bench.trainer.begin()
    bench.run(0.5)
    for _ in range(6):
        bench.tracker.status = "out_of_view"
        bench.run(0.4)
        bench.tracker.status = "valid"
        bench.run(0.4)
    assert len(depth_news(bench)) == 1


def test_a_needle_that_was_never_seen_is_not_lost(make: Make) -> None:
    bench = make()
    bench.tracker.status = "out_of_view"
    bench.run(0.3)
    bench.trainer.begin()
    snapshot = bench.run(1.0)
    assert depth_news(bench) == []
    (said,) = [m for m in snapshot.messages if m.startswith("depth not measured")]
    assert "from -30 to 120 mm" in said
    assert (snapshot.pose.depth_least, snapshot.pose.depth_most) == (-0.03, 0.12)


# --- where the force comes from -----------------------------------------------------------------
@pytest.mark.parametrize(("gauge", "source"), [(0.0, "estimated"), (1.0, "measured")])
def test_the_record_says_whether_the_force_is_measured(
    make: Make, gauge: float, source: str
) -> None:
    bench = make()
    bench.loop.extra |= {"gauge": gauge, "gauge_force": 1.25}
    bench.trainer.begin()
    device = bench.run(0.3, 0.01).device
    assert (device.force_measured, device.measured_force) == (bool(gauge), 1.25 * gauge)
    recording = recorded(bench)
    for data in scan(recording.path).messages["/haptic/wrench"]:
        wrench = json.loads(data)
        assert wrench["felt_source"] == source
        assert wrench["measured"] == (1.25 if gauge else None)
    table = list(csv.DictReader(io.StringIO(trajectory_table(recording))))
    assert {row["felt_source"] for row in table} == {source}
    assert {row["felt_measured_n"] for row in table} == {"1.25" if gauge else ""}
    assert recording.inputs.column("gauge_force")[-1] == 1.25
