"""The ticker's rate: also after a late look no two are so near that the record keeps one."""

import threading
import time
from itertools import pairwise

from app.core.paced_clock import PacedClock
from app.session.samples import SAMPLE_PERIOD
from app.session.ticker import Ticker
from app.session.trainer import TICK_PERIOD


class Oversleeping:
    """An event whose third wait wakes three quarters of a period too late."""

    def __init__(self):
        self._waits, self._over = 0, False

    def is_set(self):
        return self._over

    def set(self):
        self._over = True

    def clear(self):
        self._over = False

    def wait(self, seconds):
        self._waits += 1
        time.sleep(max(0.0, seconds) + (0.75 * TICK_PERIOD if self._waits == 3 else 0.0))


def test_a_late_look_is_not_followed_by_one_that_the_record_would_leave_out():
    times, enough = [], threading.Event()

    def look():
        times.append(time.monotonic())
        if len(times) == 8:
            enough.set()

    ticker = Ticker(look, TICK_PERIOD, lambda error: None)
    ticker._stop = Oversleeping()
    ticker.open()
    assert enough.wait(10.0)
    ticker.close()
    apart = [later - earlier for earlier, later in pairwise(times)]
    assert min(apart) > SAMPLE_PERIOD, "a pose that was told is recorded"
    assert max(apart) > 1.5 * TICK_PERIOD, "one was late"


class Switched(PacedClock):
    """A clock whose loop lets all time pass that may before a sleeper has begun to sleep."""

    def _pass(self):
        while (may := self.grant(1e-3)) > 0.0:
            self.advance(may)

    def sleep(self, duration):
        self._pass()
        super().sleep(duration)

    def sleep_until(self, moment):
        self._pass()
        super().sleep_until(moment)


def test_time_that_comes_to_the_next_look_before_the_ticker_sleeps_does_not_stand_for_ever():
    """The ticker holds time until its next look: if it slept past that, both would wait."""
    clock, looks, enough = Switched(), [], threading.Event()
    clock.start()

    def look():
        looks.append(clock.now())
        time.sleep(2.0 * TICK_PERIOD)  # the wall is ahead: all that may pass does so at once
        if len(looks) == 5:
            enough.set()

    ticker = Ticker(look, TICK_PERIOD, lambda error: None, clock)
    ticker.open()
    came = enough.wait(5.0)
    clock.stop()
    ticker.close()
    assert came
