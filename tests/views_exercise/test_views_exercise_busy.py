"""On a busy computer an attempt draws less, by how late the window's own looks come."""

from itertools import pairwise

import pytest
from views_exercise_attempts import placed_plan
from views_exercise_fakes import FakeTrainer, pose, run, snapshot, statistics

from app.session.display_load import LONGEST_S, OVER_S, WAIT_S, BusyWatch
from app.session.machine import State
from app.session.snapshot import NextStep, StepKind, advice
from app.session.transitions import PauseCause, paused_words
from app.tracking.fix import FixStatus
from app.views.exercise.attempt_rail import AttemptRail
from app.views.exercise.controller import LIGHT_MS, PERIOD_MS
from app.views.exercise.readings import problem
from app.views.exercise.status_items import tracker_item
from app.views.exercise.steps import step_words

PERIOD = 0.016


class Looks:
    """Looks of a window, each so late [s]."""

    def __init__(self):
        self.watch, self.now = BusyWatch(), 50.0

    def go_on(self, seconds, late, period=PERIOD):
        """Look for a while; returns whether each found the display light."""
        said, end = [], self.now + seconds
        while self.now < end:
            self.now += period + late
            self.watch.note(self.now, period + late, period)
            said.append(self.watch.is_light)
        return said

    def until(self, light, late, limit=300.0):
        """Look until the display is so; returns how long that took [s]."""
        began = self.now
        while self.watch.is_light is not light:
            assert self.now - began < limit
            self.go_on(0.1, late)
        return self.now - began


@pytest.fixture
def looks():
    return Looks()


def test_looks_on_time_leave_everything_drawn(looks):
    assert set(looks.go_on(60.0, 0.004)) == {False}


def test_one_long_standstill_is_no_busy_computer(looks):
    looks.go_on(5.0, 0.001)
    looks.go_on(0.1, 1.2)
    assert set(looks.go_on(10.0, 0.001)) == {False}


def test_looks_that_stay_late_make_the_display_lighter_within_some_seconds(looks):
    looks.go_on(5.0, 0.002)
    assert looks.until(True, 0.060) <= 2.0 * OVER_S


def test_it_is_full_again_only_after_looks_on_time_for_a_while(looks):
    looks.until(True, 0.060)
    assert set(looks.go_on(10.0, 0.020)) == {True}  # neither late nor on time
    assert looks.until(False, 0.001) >= WAIT_S


def test_a_display_that_makes_the_computer_late_itself_is_tried_ever_more_seldom(looks):
    waits = []
    for _ in range(8):
        looks.until(True, 0.060)
        waits.append(looks.until(False, 0.001))
    assert all(after > before - 1.0 for before, after in pairwise(waits))
    assert waits[1] > 1.5 * waits[0]
    assert waits[-1] == pytest.approx(LONGEST_S, abs=1.5 * OVER_S)


def test_another_attempt_begins_with_everything_drawn(looks):
    looks.until(True, 0.060)
    looks.watch.begin()
    assert looks.watch.is_light is False


def look(desk, count, seconds):
    for _ in range(count):
        desk.controller._clock.sleep(seconds)
        desk.controller.poll()


def test_late_looks_lighten_the_display_in_an_attempt_alone_and_it_goes_back(desk):
    said = []
    desk.controller.burdened.connect(said.append)
    look(desk, 100, 0.08)
    assert said == []
    desk.trainer.now = snapshot(desk.trainer.placed, state=State.ALIGNING)
    look(desk, 100, 0.08)
    assert said == [True]
    assert desk.controller._timer.interval() == LIGHT_MS
    look(desk, 200, 1e-3 * LIGHT_MS + 0.002)
    assert said == [True, False]
    assert desk.controller._timer.interval() == PERIOD_MS
    look(desk, 100, 0.08)
    desk.trainer.now = snapshot(desk.trainer.placed, state=State.ENDED)
    look(desk, 1, 0.08)
    assert said == [True, False, True, False]


def test_a_run_that_goes_leaves_no_light_display_behind(desk):
    said = []
    desk.controller.burdened.connect(said.append)
    desk.trainer.now = snapshot(desk.trainer.placed, state=State.ALIGNING)
    look(desk, 100, 0.08)
    desk.controller.attach(run(FakeTrainer()))
    desk.controller._timer.stop()
    assert said == [True, False]


def test_the_rail_says_quietly_what_stands_still(qt):
    rail = AttemptRail()
    rail.show()
    rail.set_busy(True)
    assert rail._busy.isVisible()
    assert rail._busy.text() == (
        "This computer is busy: the 3D view stands still. Close other programs."
    )
    rail.set_busy(True, has_scene=False)
    assert "3D" not in rail._busy.text()
    rail.set_busy(False)
    assert not rail._busy.isVisible()
    rail.deleteLater()


@pytest.mark.parametrize("pause", [PauseCause.WINDOW, PauseCause.COMPUTER, None])
def test_whoever_waits_for_a_busy_computer_reads_so_and_what_to_do(pause):
    words = step_words(NextStep(StepKind.WAIT, pause=pause), by_mouse=True).lower()
    late = statistics(status=FixStatus.NO_PICTURE, reason="")
    said = [words, problem(late, simulated=True)]
    said += advice(pose(placed_plan()), "no_picture", "", "", None, simulated=True)
    if pause is not None:
        said.append(paused_words(pause, simulated=True))
    for one in said:
        assert "busy" in one or "too slow" in one
        assert "close other programs" in one


def test_the_light_and_the_rail_say_what_to_do_about_a_busy_computer(qt):
    assert tracker_item(30.0, 0.2, 0.1, "", simulated=True).plain.endswith("close other programs")
    rail = AttemptRail()
    for has_scene in (True, False):
        rail.set_busy(True, has_scene)
        assert "Close other programs" in rail._busy.text()
    rail.deleteLater()
