"""When the window lets simulated robot and cameras rest, and what it looks at meanwhile."""

import time
from dataclasses import replace

import pytest
from PySide6.QtGui import QCursor
from PySide6.QtTest import QTest
from views_exercise_fakes import FakeTrainer, pose, run, snapshot

from app.core.clock import VirtualClock
from app.session.machine import RUNNING, State
from app.session.needle import DepthSource
from app.session.resting import Resting
from app.views.exercise.controller import PERIOD_MS, REST_MS
from app.views.exercise.resting import ENDED_S, SETTLES_S, STILL_S, UNSEEN_S, patience


@pytest.fixture
def rested(desk):
    """A controller whose robot and cameras may rest; seen, with nobody watching."""
    clock = desk.controller._clock
    assert isinstance(clock, VirtualClock)
    desk.resting = Resting(True, clock, lambda: False, lambda: None, lambda: None)
    desk.seen = True
    desk.trainer = FakeTrainer()
    desk.controller.rester.seen = lambda: desk.seen
    desk.controller.attach(run(desk.trainer, resting=desk.resting))
    desk.controller._timer.stop()  # read at by hand
    return desk


def look(desk, seconds, every=0.5):
    """Look for a while; the pointer stands still."""
    for _ in range(round(seconds / every)):
        desk.controller._clock.sleep(every)
        desk.controller.poll()
        end = time.monotonic() + 10.0
        while desk.controller.rester._asked and time.monotonic() < end:
            QTest.qWait(5)


@pytest.mark.parametrize("state", sorted(RUNNING))
def test_nothing_rests_while_an_attempt_is_prepared_or_runs(state):
    assert patience(False, state, False) is None


def test_what_nobody_sees_rests_soon_and_what_breathes_before_eyes_never():
    assert patience(False, State.READY, True) == UNSEEN_S
    assert patience(True, State.ENDED, True) == ENDED_S
    assert patience(True, State.READY, False) == STILL_S
    assert patience(True, State.READY, True) is None
    assert patience(True, State.READY, False, measured=False) > STILL_S  # it may come yet


def test_behind_another_page_they_rest_and_with_the_views_they_are_back(rested):
    look(rested, 5.0)
    assert not rested.resting.rests
    rested.seen = False
    look(rested, UNSEEN_S + 1.0)
    assert rested.resting.rests
    assert rested.controller._timer.interval() == REST_MS
    rested.seen = True
    look(rested, 0.5)
    assert not rested.resting.rests
    assert rested.controller._timer.interval() == PERIOD_MS


def test_an_ended_attempt_rests_before_eyes_and_the_pointer_wakes_it(rested):
    rested.trainer.now = snapshot(rested.trainer.placed, state=State.ENDED)
    look(rested, ENDED_S + 1.5)
    assert rested.resting.rests
    QCursor.setPos(QCursor.pos().x() + 40, QCursor.pos().y() + 30)
    look(rested, 0.5)
    assert not rested.resting.rests


def test_while_they_rest_nothing_is_drawn_anew(rested):
    drawn = []
    rested.controller.snapshot_taken.connect(drawn.append)
    rested.seen = False
    look(rested, UNSEEN_S + 1.0)
    before = len(drawn)
    look(rested, 20.0)
    assert len(drawn) == before


def test_whoever_watches_keeps_them_going(rested):
    rested.controller.rester.watched.append(lambda: True)
    rested.seen = False
    look(rested, 30.0)
    assert not rested.resting.rests


def test_begin_and_a_moved_hand_wake_them(rested):
    rested.seen = False
    look(rested, UNSEEN_S + 1.0)
    rested.controller.begin("student")
    assert not rested.resting.rests


def test_after_a_rest_nothing_unmeasured_flashes_up(rested):
    rested.seen = False
    look(rested, UNSEEN_S + 1.0)
    blind = pose(rested.trainer.placed, depth_source=DepthSource.MODEL)
    measured = rested.trainer.now
    rested.trainer.now = replace(measured, pose=blind)
    drawn = []
    rested.controller.snapshot_taken.connect(drawn.append)
    rested.seen = True
    look(rested, 0.9 * SETTLES_S, 0.05)
    assert drawn == []
    rested.trainer.now = measured
    look(rested, 0.05, 0.05)
    assert len(drawn) == 1


def test_what_stays_unmeasured_after_a_rest_is_shown_as_it_is(rested):
    rested.seen = False
    look(rested, UNSEEN_S + 1.0)
    rested.trainer.now = snapshot(
        rested.trainer.placed, pose=pose(rested.trainer.placed, depth_source=DepthSource.MODEL)
    )
    drawn = []
    rested.controller.snapshot_taken.connect(drawn.append)
    rested.seen = True
    look(rested, 3.0 * SETTLES_S, 0.05)
    assert drawn
