"""The attempt's table: every legal pair, and that nothing else is legal."""

from itertools import product

import pytest

from app.core.errors import NumericalError
from app.session.errors import IllegalTransitionError
from app.session.machine import FINAL, RUNNING, TABLE, Attempt, AttemptEvent, State, advance, legal

LEGAL = [
    ("ready", "begin", "aligning"),
    ("ready", "abort", "aborted"),
    ("aligning", "insert", "inserting"),
    ("ready", "prepare", "withdrawing"),
    ("withdrawing", "begin", "aligning"),
    ("withdrawing", "end", "ended"),
    ("withdrawing", "abort", "aborted"),
    ("aligning", "pause", "paused"),
    ("paused", "withdraw", "aligning"),
    ("aligning", "end", "ended"),
    ("aligning", "abort", "aborted"),
    ("inserting", "hold", "holding"),
    ("inserting", "withdraw", "aligning"),
    ("inserting", "end", "ended"),
    ("inserting", "abort", "aborted"),
    ("holding", "insert", "inserting"),
    ("holding", "withdraw", "aligning"),
    ("holding", "end", "ended"),
    ("holding", "abort", "aborted"),
    ("inserting", "pause", "paused"),
    ("holding", "pause", "paused"),
    ("paused", "resume", "inserting"),
    ("paused", "end", "ended"),
    ("paused", "abort", "aborted"),
]


@pytest.mark.parametrize(("origin", "event", "target"), LEGAL)
def test_a_legal_event_leads_to_its_state(origin: str, event: str, target: str) -> None:
    after = advance(
        Attempt(State(origin), since=3.0, began=1.0), AttemptEvent(event), 5.0, "because"
    )
    assert after.state == target
    assert after.since == 5.0
    assert after.reason == ("because" if event == "abort" else "")


def test_every_other_event_is_refused_and_the_possible_ones_are_named() -> None:
    legal_pairs = {(origin, event) for origin, event, _ in LEGAL}
    assert {(o.value, e.value): t.value for (o, e), t in TABLE.items()} == {
        (o, e): t for o, e, t in LEGAL
    }
    for origin, event in product(State, AttemptEvent):
        if (origin.value, event.value) in legal_pairs:
            continue
        with pytest.raises(IllegalTransitionError) as caught:
            advance(Attempt(origin, since=3.0, began=1.0), event, 5.0)
        for name in legal(origin):
            assert name.value in str(caught.value)


def test_running_and_final_states_are_those_that_something_or_nothing_leaves() -> None:
    assert frozenset(s for s in State if not legal(s)) == FINAL
    assert frozenset(s for s in State if AttemptEvent.END in legal(s)) == RUNNING


def test_times_per_state_add_up_over_several_visits() -> None:
    attempt = Attempt()
    for event, time in (
        (AttemptEvent.BEGIN, 10.0),
        (AttemptEvent.INSERT, 12.0),
        (AttemptEvent.WITHDRAW, 15.0),
        (AttemptEvent.INSERT, 16.0),
        (AttemptEvent.HOLD, 20.0),
    ):
        attempt = advance(attempt, event, time)
    assert attempt.phases(21.5) == {
        State.ALIGNING: 3.0,
        State.INSERTING: 7.0,
        State.HOLDING: 1.5,
    }
    ended = advance(attempt, AttemptEvent.END, 22.0)
    assert ended.duration(99.0) == 12.0
    assert sum(ended.phases(99.0).values()) == ended.duration(99.0)


def test_the_clock_of_an_attempt_stands_still_while_it_is_paused() -> None:
    attempt = Attempt()
    for event, time in (
        (AttemptEvent.BEGIN, 10.0),
        (AttemptEvent.INSERT, 12.0),
        (AttemptEvent.PAUSE, 15.0),
        (AttemptEvent.RESUME, 21.0),
        (AttemptEvent.PAUSE, 22.0),
    ):
        attempt = advance(attempt, event, time)
    assert attempt.duration(23.0) == 6.0
    assert attempt.duration(99.0) == 6.0
    assert advance(attempt, AttemptEvent.END, 30.0).duration(99.0) == 6.0


def test_transitions_at_equal_times_take_no_time() -> None:
    attempt = advance(advance(Attempt(), AttemptEvent.BEGIN, 1.0), AttemptEvent.END, 1.0)
    assert attempt.duration(2.0) == 0.0


@pytest.mark.parametrize("time", [0.5, float("nan"), float("inf")])
def test_a_time_before_the_last_change_or_no_time_is_refused(time: float) -> None:
    attempt = advance(Attempt(), AttemptEvent.BEGIN, 1.0)
    with pytest.raises(NumericalError, match="lies before"):
        advance(attempt, AttemptEvent.INSERT, time)
