"""The student's clock starts with the attempt and stands in its pauses, as the rail's does."""

from pathlib import Path

import pytest
from session_fakes import Bench

from app.core.events import Event
from app.session.attempt_clock import AttemptClock
from app.session.machine import Attempt, AttemptEvent, advance
from app.session.recording import read_recording

COURSE = (
    (100.0, AttemptEvent.PREPARE),
    (112.0, AttemptEvent.BEGIN),
    (130.0, AttemptEvent.INSERT),
    (140.0, AttemptEvent.PAUSE),
    (146.5, AttemptEvent.RESUME),
    (150.0, AttemptEvent.PAUSE),
    (151.0, AttemptEvent.WITHDRAW),
    (170.0, AttemptEvent.END),
)


def walked(until):
    """Return the attempt of the state machine, and what was said of it, up to a moment."""
    attempt, events = Attempt(), []
    for time, step in COURSE:
        if time > until:
            break
        attempt = advance(attempt, step, time)
        events.append(Event(time, "state", attempt.state, {"state": attempt.state.value}))
    return attempt, events


@pytest.mark.parametrize("moment", [90.0, 105.0, 112.0, 125.0, 143.0, 148.0, 150.5, 160.0, 170.0])
def test_it_shows_what_the_rail_showed_at_that_moment(moment):
    attempt, events = walked(moment)
    assert AttemptClock.of(events).at(moment) == pytest.approx(attempt.duration(moment))


@pytest.mark.parametrize("moment", [90.0, 105.0, 112.0, 125.0, 143.0, 148.0, 150.5, 160.0, 170.0])
def test_the_whole_record_tells_the_same_as_what_was_known_then(moment):
    now, whole = walked(moment)[1], walked(1000.0)[1]
    assert AttemptClock.of(whole).at(moment) == pytest.approx(AttemptClock.of(now).at(moment))


def test_the_clock_stands_once_the_attempt_is_over():
    clock = AttemptClock.of(walked(1000.0)[1])
    assert clock.at(500.0) == clock.at(170.0) == pytest.approx(170.0 - 112.0 - 6.5 - 1.0)


@pytest.mark.parametrize("shown", [0.0, 10.0, 28.0, 29.0, 31.5, 40.0])
def test_the_moment_of_what_it_shows_is_where_it_shows_it(shown):
    clock = AttemptClock.of(walked(1000.0)[1])
    assert clock.at(clock.moment(shown)) == pytest.approx(shown)


def test_a_pause_begins_at_the_first_moment_that_shows_its_time():
    """The clock shows 28 s all through a pause: what happened then happened as it began."""
    clock = AttemptClock.of(walked(1000.0)[1])
    assert clock.moment(28.0) == pytest.approx(140.0)
    assert clock.moment(28.0 + 1e-6) == pytest.approx(146.5)


@pytest.mark.parametrize("end", ["end", "abort"])
def test_the_clock_of_a_record_stops_however_the_attempt_was_over(tmp_path: Path, end: str):
    bench = Bench(tmp_path)
    bench.trainer.begin()
    bench.run(0.5, -0.02)
    bench.run(2.0, 0.03)
    result = getattr(bench.trainer, end)()
    bench.trainer.close()
    clock = AttemptClock.of(read_recording(result.record).events)
    assert clock.at(1e6) == pytest.approx(result.duration, abs=1e-6)


def test_of_nothing_it_shows_nothing():
    assert AttemptClock.of([Event(3.0, "scan", "control scan 1")]).at(10.0) == 0.0
