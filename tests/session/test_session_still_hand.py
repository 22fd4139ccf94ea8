"""In a pause the clock stands, and so does the simulated hand, whatever moves it."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from session_fakes import Bench

from app.core.staleness import HEARTBEAT
from app.session.machine import State
from app.session.transitions import BACK, LOST, PauseCause


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    bench.trainer.begin()
    bench.run(0.5, -0.02)
    bench.run(2.0, 0.03)
    yield bench
    bench.trainer.close()


def silent(bench: Bench, seconds: float) -> None:
    """Let time pass in which the window gives no sign of life."""
    for _ in range(round(seconds / 0.02)):
        bench.loop.step(20)
        now = bench.clock.now()
        bench.tracker.advance(now)
        bench.trainer.tick(now)


def depth(bench: Bench) -> float:
    return float(bench.loop.latest().depth)


def test_what_is_pushed_while_the_window_is_waited_for_moves_nothing_then_or_later(
    bench: Bench,
) -> None:
    silent(bench, HEARTBEAT + 0.1)
    assert bench.trainer.snapshot().pause is PauseCause.WINDOW
    for k in range(20):  # twenty clicks of the wheel, that had waited for the window
        bench.trainer.hand(0.0, 0.0, 0.03 + 1e-3 * k)
        bench.trainer.roll(0.1)
        bench.trainer.step(20)
    assert bench.trainer.snapshot().state is State.PAUSED
    assert depth(bench) == pytest.approx(0.03)
    assert bench.trainer.snapshot().roll in (None, 0.0)
    for _ in range(round((BACK + 0.2) / 0.02)):
        bench.trainer.step(20)
    assert bench.trainer.snapshot().state is State.INSERTING
    assert depth(bench) == pytest.approx(0.03)
    assert bench.loop.inbox.values.get("needle_roll", 0.0) == 0.0
    bench.trainer.hand(0.0, 0.0, 0.031)  # it obeys again
    bench.trainer.step(20)
    assert depth(bench) == pytest.approx(0.031)


def test_where_the_cameras_do_not_see_it_the_needle_goes_back_and_no_deeper(bench: Bench) -> None:
    bench.run(0.3)
    bench.tracker.status = "out_of_view"
    bench.run(LOST + 0.4, 0.035, 0.05)  # lost on the way deeper and to one side
    assert bench.trainer.snapshot().pause is PauseCause.CAMERAS
    deepest, values = bench.loop.inbox.values["hand_depth"], bench.loop.inbox.values
    assert deepest == pytest.approx(0.035, abs=0.002)
    bench.run(0.5, 0.06, 0.05, 0.2)
    assert depth(bench) == pytest.approx(deepest)
    assert values["hand_y"] == pytest.approx(0.0, abs=1e-9), "it leans to no other side"
    bench.run(0.5, 0.028, 0.0)
    assert depth(bench) == pytest.approx(0.028)
    assert values["hand_x"] == pytest.approx(0.0, abs=1e-9), "and back to where it was seen"
    bench.tracker.status = "valid"
    bench.run(BACK + 0.6)
    assert bench.trainer.snapshot().state is State.INSERTING


def test_a_pause_of_one_attempt_holds_no_hand_of_the_next(bench: Bench) -> None:
    silent(bench, HEARTBEAT + 0.1)
    assert bench.trainer.snapshot().state is State.PAUSED
    bench.trainer.abort()
    bench.trainer.hand(0.0, 0.0, -0.02)
    bench.trainer.step(20)
    assert depth(bench) == pytest.approx(-0.02)
