"""Simulated robot and cameras rest while nobody wants them, and run before anybody is served."""

import threading

import pytest

from app.core.clock import VirtualClock
from app.core.errors import AcusError
from app.session.resting import Resting
from app.session.ticker import Standstill


class Parts:
    """Parts that write down when they were stopped and started."""

    def __init__(self, may=True):
        self.calls, self.needed, self.fails = [], False, False
        self.clock = VirtualClock(100.0)
        self.resting = Resting(may, self.clock, lambda: self.needed, self.stop, self.start)

    def stop(self):
        self.calls.append("stop")

    def start(self):
        if self.fails:
            raise AcusError("no")
        self.calls.append("start")


@pytest.fixture
def parts():
    return Parts()


def test_they_rest_once_and_run_again_for_whoever_wants_them(parts):
    assert parts.resting.rest()
    assert parts.resting.rest()
    assert parts.resting.rests
    parts.resting.want()
    parts.resting.want()
    assert not parts.resting.rests
    assert parts.calls == ["stop", "start"]


def test_they_do_not_rest_where_they_may_not_or_are_needed(parts):
    assert not Parts(may=False).resting.rest()
    parts.needed = True
    assert not parts.resting.rest()
    assert parts.calls == []


def test_the_time_since_somebody_wanted_them_is_that_of_the_last_one(parts):
    parts.clock.sleep(7.0)
    assert parts.resting.unwanted == pytest.approx(7.0)
    parts.resting.want()
    parts.clock.sleep(2.0)
    assert parts.resting.unwanted == pytest.approx(2.0)


def test_nobody_puts_them_to_rest_while_they_are_held_awake(parts):
    done = threading.Event()

    def rest():
        parts.resting.rest()
        done.set()

    with parts.resting.awake():
        thread = threading.Thread(target=rest)
        thread.start()
        assert not done.wait(0.1)
        parts.needed = True  # an attempt has begun meanwhile
    thread.join(5.0)
    assert not parts.resting.rests
    assert parts.calls == []


def test_what_cannot_be_started_again_rests_on_and_says_so(parts):
    parts.resting.rest()
    parts.fails = True
    with pytest.raises(AcusError):
        parts.resting.want()
    assert parts.resting.rests
    parts.fails = False
    parts.resting.want()
    assert not parts.resting.rests


def test_after_the_end_nothing_is_stopped_or_started(parts):
    parts.resting.rest()
    parts.resting.end()
    parts.resting.want()
    assert not parts.resting.rest()
    assert parts.calls == ["stop"]


def test_a_rest_is_no_standstill_of_the_computer():
    watch = Standstill(lambda: 0.0)
    watch.before(1.0, 1000)
    assert watch.before(61.0, 1001) == pytest.approx(60.0)
    watch.forget()
    assert watch.before(161.0, 1001) == 0.0
    assert watch.before(261.0, 1002) == pytest.approx(100.0)
