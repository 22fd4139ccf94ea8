"""On a busy computer an attempt draws less, by how late the window's own looks come."""

from itertools import pairwise

import pytest
from views_exercise_attempts import placed_plan
from views_exercise_fakes import FakeTrainer, pose, run, snapshot, statistics

from app.session.display_load import LONGEST_S, OVER_S, WAIT_S, BusyWatch, WorldPace
from app.session.machine import State
from app.session.snapshot import NextStep, StepKind, advice
from app.session.transitions import PauseCause, paused_words
from app.tracking.fix import FixStatus
from app.views.exercise.attempt_rail import AttemptRail
from app.views.exercise.controller import LIGHT_MS, PERIOD_MS, SHOWN_S
from app.views.exercise.readings import problem
from app.views.exercise.status_items import TipTeller, tracker_item
from app.views.exercise.steps import step_words
from app.views.kit.verdict import StatusItem, Verdict

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


def test_time_waits_for_what_a_person_is_shown_in_an_attempt_and_for_no_script(desk):
    look(desk, 3, 0.016)
    assert desk.trainer.told("lead") == []
    desk.trainer.now = snapshot(desk.trainer.placed, state=State.ALIGNING)
    look(desk, 3, 0.016)
    assert desk.trainer.told("lead") == 3 * [("lead", SHOWN_S)]
    desk.controller.lead("arm")
    look(desk, 3, 0.016)
    assert len(desk.trainer.told("lead")) == 3


def test_time_waits_for_nobody_where_an_expert_only_shows_the_exercise(desk):
    trainer = FakeTrainer()
    trainer.now = snapshot(trainer.placed, state=State.ALIGNING)
    desk.controller.attach(run(trainer, demonstrates=True))
    desk.controller._timer.stop()
    look(desk, 3, 0.016)
    assert trainer.told("lead") == []


def test_a_slowed_world_is_spoken_of_and_no_longer_when_it_is_as_fast_as_the_wall(desk):
    shares = []
    desk.controller.slowed.connect(shares.append)
    trainer = desk.trainer
    trainer.now, trainer.paced = snapshot(trainer.placed, state=State.ALIGNING), 100.0

    def go(count, world):
        for _ in range(count):
            trainer.paced += world
            look(desk, 1, 0.02)

    go(200, 0.02)
    assert shares == []
    go(200, 0.012)
    assert shares[-1] == pytest.approx(0.6)
    go(300, 0.02)
    assert shares[-1] == 1.0
    go(200, 0.005)
    trainer.now = snapshot(trainer.placed, state=State.ENDED)
    go(1, 0.005)
    assert shares[-1] == 1.0


def test_the_share_does_not_flicker_and_is_never_nothing():
    pace, now, time, shares = WorldPace(), 0.0, 0.0, []
    for i in range(2000):
        now += 0.02
        time += 0.02 * (0.62 if i % 2 else 0.58)
        shares.append(pace.note(now, time))
    assert set(shares[100:]) == {0.6}
    for _ in range(500):
        now += 0.02
        shares.append(pace.note(now, time))
    assert shares[-1] == pytest.approx(0.1)


def test_a_share_between_two_tenths_is_said_as_one_of_them_and_forgotten_with_the_attempt():
    pace, now, time, shares = WorldPace(), 0.0, 0.0, []
    for i in range(2000):
        now += 0.02
        time += 0.02 * (0.66 if i // 150 % 2 else 0.64)
        shares.append(pace.note(now, time))
    assert len(set(shares[100:])) == 1
    pace.begin()
    assert pace.note(now + 0.02, time + 0.002) == 1.0


def test_the_rail_says_that_time_runs_slower_before_what_is_not_drawn(qt):
    rail = AttemptRail()
    rail.show()
    rail.set_busy(True)
    rail.set_slowed(0.6)
    assert "60 %" in rail._busy.text()
    rail.set_slowed(1.0)
    assert "3D" in rail._busy.text()
    rail.set_busy(False)
    rail.set_slowed(0.5)
    assert rail._busy.isVisible()
    rail.set_slowed(1.0)
    assert not rail._busy.isVisible()
    rail.deleteLater()


def test_what_is_held_moves_the_needle_by_its_own_slowed_time(desk):
    trainer, pad = desk.trainer, desk.controller._views.bullseye.pad
    trainer.paced, steps = 10.0, []
    pad.feed.advanced.connect(steps.append)
    pad.feed.press("key", True, False)
    trainer.paced += 1.0
    pad.feed.step()
    steps.clear()
    pad.feed.step()  # the wall went on, the needle's time did not
    assert sum(steps) == 0.0
    trainer.paced += 0.02
    pad.feed.step()
    assert sum(steps) == pytest.approx(0.02 * 0.02)
    pad.let_go()


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
    assert (
        "close other programs" in tracker_item(30.0, 0.2, 0.1, "", TipTeller(simulated=True)).plain
    )
    rail = AttemptRail()
    for has_scene in (True, False):
        rail.set_busy(True, has_scene)
        assert "Close other programs" in rail._busy.text()
    rail.deleteLater()


def test_a_slowed_world_is_told_once_and_not_as_a_fault_of_cameras_besides(qt):
    """Seen: two notes, one of them that simulated cameras' pictures come late."""
    rail = AttemptRail()
    late = StatusItem(
        Verdict.WARNING, "Depth", "held, 149 ms old", "help", plain="measured a moment ago"
    )
    gone = StatusItem(Verdict.BAD, "Depth", "lost", "help", plain="not known")
    rail.show_health([late], None)
    assert "Depth" in rail._health.text()
    rail.set_slowed(0.2)
    rail.show_health([late], None)
    assert rail._health.text() == ""
    rail.show_health([late], late)  # the robot's own word stays
    assert rail._health.text()
    rail.show_health([gone], None)
    assert "lost" in rail._health.text()
    rail.deleteLater()


def test_a_window_that_is_late_in_a_slowed_world_is_late_by_that_worlds_time(desk, monkeypatch):
    """Seen: "Robot stopped: computer busy" beside a robot whose time had waited for the window."""
    silent = []
    show = lambda run, shown, now, late: silent.append(late)  # noqa: E731
    monkeypatch.setattr(desk.controller._display, "show", show)
    trainer = desk.trainer
    trainer.now, trainer.paced = snapshot(trainer.placed, state=State.ALIGNING), 100.0
    look(desk, 1, 1.6)
    assert silent[-1] == pytest.approx(0.016)
    trainer.paced = None  # a robot on the wall's time has missed it
    look(desk, 1, 1.6)
    assert silent[-1] == pytest.approx(1.6)
