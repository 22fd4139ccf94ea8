"""A real needle is out of the skin before an attempt begins: measured, or said and then checked."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from session_fakes import EXERCISE, Bench

from app.session.machine import State
from app.session.recording import read_recording
from app.session.trainer import Trainer
from app.session.withdrawal import REFUTES, Start


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    bench.trainer = Trainer(
        bench.loop, bench.tracker, bench.placed, EXERCISE, bench.context,
        clock=bench.clock, advance=bench.tracker.advance, start=Start.REAL,
    )  # fmt: skip
    yield bench
    bench.trainer.close()


def interval(bench: Bench, least: float, most: float) -> None:
    bench.loop.extra |= {"depth_least": least, "depth_most": most}


def unseen(bench: Bench) -> None:
    """No camera sees the needle: it may be anywhere."""
    bench.tracker.status = "out_of_view"
    interval(bench, -0.03, 0.12)


def told(result: Any) -> list[dict[str, Any]]:
    events = read_recording(result.record).events
    return [dict(e.data) for e in events if e.kind == "withdrawal" and "how" in e.data]


def test_a_needle_that_is_measured_outside_begins_at_once(bench: Bench) -> None:
    interval(bench, -0.022, -0.018)
    bench.run(0.3, -0.02)
    bench.trainer.begin()
    assert bench.run(0.1).state is State.ALIGNING


def test_a_needle_inside_is_asked_out_and_the_attempt_begins_once_it_is_measured_out(
    bench: Bench,
) -> None:
    interval(bench, 0.038, 0.042)
    bench.run(0.3, 0.04)
    bench.trainer.begin()
    snapshot = bench.run(0.5)
    assert snapshot.state is State.WITHDRAWING
    assert "withdraw the needle first" in snapshot.messages[0]
    assert not snapshot.may_confirm
    assert not snapshot.armed
    bench.trainer.confirm_outside()
    assert bench.run(0.2).state is State.WITHDRAWING, "what is measured is not argued with"
    interval(bench, -0.001, 0.003)
    assert bench.run(0.2, 0.001).state is State.WITHDRAWING, "the whole interval must be outside"
    interval(bench, -0.012, -0.008)
    snapshot = bench.run(0.2, -0.01)
    assert snapshot.state is State.ALIGNING
    assert snapshot.armed
    assert snapshot.elapsed < 0.3
    assert [data["how"] for data in told(bench.trainer.end())] == ["measured"]


def test_where_nothing_measures_it_the_student_says_so_and_the_record_knows(bench: Bench) -> None:
    unseen(bench)
    bench.run(1.0)
    bench.trainer.begin()
    snapshot = bench.run(2.0)
    assert snapshot.state is State.WITHDRAWING
    assert snapshot.may_confirm
    assert "press" in snapshot.withdrawal
    bench.trainer.confirm_outside()
    snapshot = bench.run(0.1)
    assert snapshot.state is State.ALIGNING
    assert not snapshot.may_confirm
    result = bench.trainer.end()
    assert [data["how"] for data in told(result)] == ["confirmed"]
    assert result.score is None or result.score.total is None


def test_a_depth_inside_the_skin_soon_after_refutes_the_students_word(bench: Bench) -> None:
    unseen(bench)
    bench.run(1.0, 0.05)
    bench.trainer.begin()
    bench.run(0.2)
    bench.trainer.confirm_outside()
    bench.run(0.5)
    bench.tracker.status = "valid"
    interval(bench, 0.048, 0.052)
    snapshot = bench.run(0.8)  # ten fixes agree before a depth is believed
    assert snapshot.state is State.ABORTED
    assert "50 mm inside the skin" in snapshot.reason
    result = bench.trainer.result
    assert result is not None
    assert result.score is None or result.score.total is None


def test_later_than_that_the_needle_may_have_been_inserted(bench: Bench) -> None:
    unseen(bench)
    bench.run(1.0, 0.05)
    bench.trainer.begin()
    bench.run(0.2)
    bench.trainer.confirm_outside()
    bench.run(REFUTES + 0.3)
    bench.tracker.status = "valid"
    interval(bench, 0.048, 0.052)
    assert bench.run(0.8).state is State.INSERTING


def test_a_word_given_before_it_is_asked_for_does_not_count(bench: Bench) -> None:
    unseen(bench)
    bench.run(1.0)
    bench.trainer.confirm_outside()
    bench.trainer.begin()
    assert bench.run(0.5).state is State.WITHDRAWING


def test_waiting_can_be_broken_off_and_begun_again(bench: Bench) -> None:
    unseen(bench)
    bench.run(1.0)
    bench.trainer.begin()
    bench.run(0.2)
    assert bench.trainer.abort() is not None
    bench.trainer.begin()
    assert bench.run(0.2).may_confirm
    assert bench.trainer.end().state is State.ENDED
    assert bench.loop.inbox.values["enabled"] == 0.0
