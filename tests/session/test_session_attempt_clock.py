"""The student's clock starts with the attempt and stands in its pauses, as the rail's does."""

import pytest

from app.core.events import Event
from app.session.attempt_clock import AttemptClock
from app.session.machine import Attempt, AttemptEvent, advance

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


def test_of_nothing_it_shows_nothing():
    assert AttemptClock.of([Event(3.0, "scan", "control scan 1")]).at(10.0) == 0.0
