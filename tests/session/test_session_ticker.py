"""The ticker's rate: also after a late look no two are so near that the record keeps one."""

import threading
import time
from itertools import pairwise

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
