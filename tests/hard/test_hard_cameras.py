"""Streams as bad drivers make them: pictures repeat, times go back, stop, or are no numbers."""

import threading
import time as real_time
from itertools import pairwise
from queue import SimpleQueue

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.core.clock import VirtualClock
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.cameras.intake import Intake, IntakeVerdict
from app.tracking.cameras.usb import CaptureTime
from app.tracking.cameras.watch import CameraReader, CameraState
from app.tracking.errors import CameraError


def _frame(time, grey=0):
    return CameraFrame(np.full((32, 32, 3), grey, np.uint8), time)


_TIMES = st.floats(allow_nan=True, allow_infinity=True) | st.floats(0.0, 20.0)


@pytest.mark.long("statistics")
@given(st.lists(st.tuples(_TIMES, st.integers(0, 3)), max_size=40))
def test_whatever_a_driver_says_the_times_that_pass_only_grow_and_each_picture_is_counted(stream):
    intake, passed = Intake(noise_expected=True), []
    for time, grey in stream:
        if intake.judge(_frame(time, grey), 10.0) is IntakeVerdict.NEW:
            passed.append(time)
    assert all(np.isfinite(t) for t in passed)
    assert all(late > early for early, late in pairwise(passed))
    figures = intake.figures()
    counted = figures.taken + figures.repeated + figures.backwards + figures.impossible
    assert counted == len(stream)


@given(st.lists(_TIMES, min_size=1, max_size=30))
def test_capture_times_are_finite_and_never_in_the_future(stamps):
    capture = CaptureTime(latency=0.03)
    for number, stamp in enumerate(stamps):
        delivered = 5.0 + number / 30.0
        time = capture.of(1e3 * stamp, delivered)
        assert delivered - 1.0 <= time <= delivered + 0.002


@pytest.mark.parametrize(
    ("time", "grey", "verdict"),
    [
        (5.0, 1, IntakeVerdict.REPEATED),
        (5.1, 0, IntakeVerdict.REPEATED),
        (4.9, 1, IntakeVerdict.BACKWARDS),
        (9.0, 1, IntakeVerdict.IMPOSSIBLE),
        (np.nan, 1, IntakeVerdict.IMPOSSIBLE),
        (-np.inf, 1, IntakeVerdict.IMPOSSIBLE),
        (-1e160, 1, IntakeVerdict.IMPOSSIBLE),
        (5.1, 1, IntakeVerdict.NEW),
    ],
)
def test_a_picture_is_refused_by_name(time, grey, verdict):
    intake = Intake(noise_expected=True)
    assert intake.judge(_frame(5.0, 0), 5.1) is IntakeVerdict.NEW
    assert intake.judge(_frame(time, grey), 5.1) is verdict


class _OnOrder(Camera):
    """Hands out what it is given, one after the other; hangs meanwhile."""

    def __init__(self):
        self.orders, self.asked = SimpleQueue(), 0

    def open(self):
        pass

    def read(self):
        self.asked += 1
        order = self.orders.get()
        if isinstance(order, Exception):
            raise order
        return order

    def close(self):
        self.orders.put(CameraError("closed"))


def _state_after(seconds, later):
    """State `seconds` after a good picture, if `later` (time, grey or an error) follow it."""
    clock, camera = VirtualClock(10.0), _OnOrder()
    reader = CameraReader(camera, "left", clock, threading.Condition(), True)
    reader.open()
    camera.orders.put(_frame(10.0, 1))
    _until(lambda: reader.newest() is not None)
    for number, order in enumerate(later, 1):
        clock.time = 10.0 + seconds * number / len(later)
        camera.orders.put(order if isinstance(order, Exception) else _frame(*order))
        _until(lambda number=number: camera.asked >= number + 2)  # it has taken this one in
    state = reader.health(10.0 + seconds).state
    reader.close()
    return state


def _until(condition):
    end = real_time.monotonic() + 60.0
    while not condition():
        assert real_time.monotonic() < end
        real_time.sleep(0.001)


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    ("later", "state"),
    [
        ([], CameraState.STALLED),
        ([(10.0, 2), (10.0, 2)], CameraState.FROZEN),
        ([(10.2, 1), (10.5, 1)], CameraState.FROZEN),
        ([(9.0, 2)], CameraState.FAILED),
        ([CameraError("unplugged")], CameraState.FAILED),
        ([(10.2, 2), (10.4, 3)], CameraState.LIVE),
    ],
)
def test_half_a_second_after_a_camera_goes_wrong_it_is_known(later, state):
    assert _state_after(0.5, later) is state


class _Scripted(Camera):
    """Hands out a list, then stops the reader."""

    def __init__(self, frames):
        self.frames, self.stop = list(frames), threading.Event()

    def open(self):
        pass

    def read(self):
        if not self.frames:
            self.stop.wait(2.0)
            raise OSError("over")
        return self.frames.pop(0)

    def close(self):
        self.stop.set()


@pytest.mark.long("statistics")
def test_refused_pictures_never_replace_the_newest_one():
    clock = VirtualClock(10.0)
    frames = [_frame(9.0, 1), _frame(9.1, 2), _frame(9.05, 3), _frame(9.1, 4), _frame(11.0, 5)]
    camera = _Scripted(frames)
    reader = CameraReader(camera, "left", clock, threading.Condition(), True)
    reader.open()
    while camera.frames:
        threading.Event().wait(0.005)
    threading.Event().wait(0.02)
    newest = reader.newest()
    figures = reader.health(10.0).figures
    reader.close()
    assert newest is not None
    assert newest.time == 9.1
    assert (figures.taken, figures.repeated, figures.backwards, figures.impossible) == (2, 1, 1, 1)
