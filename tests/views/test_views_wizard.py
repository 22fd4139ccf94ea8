"""The commissioning wizard on a robot that finds what it is told to find."""

from dataclasses import replace

import pytest
from views_robot_fakes import RESULTS, FakeBench

from app.device.commissioning.results import RoutineName
from app.views.kit.verdict import Verdict
from app.views.robot.wizard import CommissioningWizard
from app.views.robot.wizard_pages import (
    RoutinePage,
    SummaryPage,
    clearance_words,
    state_of,
    step_words,
    steps_of,
)


@pytest.fixture
def bench():
    return FakeBench()


@pytest.fixture
def wizard(application, bench, destroy):
    dialog = CommissioningWizard(bench)
    destroy(dialog)
    dialog.show()
    dialog.runner._timer.setInterval(10**6)  # read at by hand
    yield dialog
    dialog.close()


def go(wizard, step):
    """Go to a step's page, begin it, and return the page."""
    wizard.show_page(1 + wizard.steps.index(step))
    wizard.page.start.click()
    return wizard.page


def carry_out(wizard, step, reading=""):
    page = go(wizard, step)
    page.reading.setText(reading)
    page.confirm.click()
    wizard.runner.poll()
    return page


def titles(wizard):
    return [wizard.list.item(i).text() for i in range(wizard.list.count())]


def test_the_steps_are_listed_in_order_with_what_is_missing(wizard):
    assert titles(wizard) == [
        "✔ Connect", "✖ Homing", "✖ Sign check", "– Force scale", "– Latency", "– Friction",
        "▲ Summary",
    ]  # fmt: skip


def test_a_gauge_is_calibrated_only_where_there_is_one(bench):
    assert RoutineName.GAUGE not in steps_of(bench)
    bench.info = replace(bench.info, gauge=True)
    assert steps_of(bench)[-1] is RoutineName.GAUGE


def test_a_routine_asks_is_answered_and_its_result_is_kept(wizard, bench):
    page = go(wizard, RoutineName.HOMING)
    assert page.question.text() == "➜ bring both links to the stops and confirm"
    assert page.confirm.isEnabled()
    assert not page.reading.isEnabled()
    assert not wizard.next.isEnabled()
    page.confirm.click()
    wizard.runner.poll()
    assert bench.record.newest(RoutineName.HOMING).result == RESULTS[RoutineName.HOMING]
    assert titles(wizard)[1] == "✔ Homing"
    assert "2026-11-21 10:15" in page._state.text()
    assert wizard.next.isEnabled()


def test_a_reading_is_typed_with_its_unit_and_nonsense_is_refused(wizard, bench):
    carry_out(wizard, RoutineName.HOMING)
    carry_out(wizard, RoutineName.SIGNS)
    page = go(wizard, RoutineName.FORCE)
    assert page.reading.isEnabled()
    assert page._unit.text() == "g"
    for nonsense in ("", "-3", "0"):
        page.reading.setText(nonsense)
        page.confirm.click()
        assert bench.routines[-1].answers == []
        assert "✖" in page._state.text()
        assert wizard.runner.running
    page.reading.setText("51,5")
    page.confirm.click()
    wizard.runner.poll()
    assert bench.routines[-1].answers == [51.5]
    assert clearance_words(bench) == (Verdict.GOOD, "cleared for 5 N at the hand")


def test_a_step_that_must_wait_says_what_comes_first(wizard):
    page = go(wizard, RoutineName.FORCE)
    assert "signs to be checked first" in page._state.text()
    assert page.start.isEnabled()
    assert not wizard.runner.running


def test_a_failure_says_why_and_may_be_tried_again(wizard, bench):
    bench.failure = "the left motor turns backwards: exchange its two leads"
    page = carry_out(wizard, RoutineName.SIGNS)
    assert "exchange its two leads" in page._state.text()
    assert page.start.isEnabled()
    assert bench.record.newest(RoutineName.SIGNS) is None


@pytest.mark.parametrize("step", [RoutineName.SIGNS, RoutineName.FORCE])
def test_a_check_that_fails_takes_its_earlier_success_back_and_says_so(wizard, bench, step):
    for earlier in (RoutineName.HOMING, RoutineName.SIGNS):
        carry_out(wizard, earlier)
    bench.keep(RESULTS[RoutineName.FORCE])
    assert bench.clearance().full
    bench.failure = "the scale does not feel the robot"
    if step is RoutineName.FORCE:
        page = go(wizard, step)
        page.reading.setText("51")
        page.confirm.click()
        wizard.runner.poll()
    else:
        page = carry_out(wizard, step)
    assert "counts no more" in page._state.text()
    assert bench.record.newest(step) is None
    assert not bench.clearance().full


def test_a_check_that_is_cancelled_leaves_its_earlier_success(wizard, bench):
    for earlier in (RoutineName.HOMING, RoutineName.SIGNS):
        carry_out(wizard, earlier)
    go(wizard, RoutineName.SIGNS).cancel.click()
    assert bench.done(RoutineName.SIGNS)


def test_cancel_ends_the_routine_with_the_forces_off_at_any_time(wizard, bench):
    page = go(wizard, RoutineName.SIGNS)
    page.cancel.click()
    assert bench.routines[-1].cancelled == 1
    assert "forces are off" in page._state.text()
    wizard.runner.poll()
    assert bench.routines[-1].steps == 1


@pytest.mark.parametrize(
    "leave", [CommissioningWizard.close, CommissioningWizard.reject, CommissioningWizard.accept]
)
def test_leaving_the_wizard_cancels_and_lets_the_robot_go(wizard, bench, leave):
    go(wizard, RoutineName.SIGNS)
    leave(wizard)
    assert bench.routines[-1].cancelled == 1
    assert bench.closed >= 1


def test_the_page_stays_while_its_routine_runs(wizard):
    page = go(wizard, RoutineName.HOMING)
    wizard.show_page(5)
    wizard.list.setCurrentRow(3)
    assert wizard.page is page


def test_the_last_result_can_be_undone(wizard, bench):
    page = carry_out(wizard, RoutineName.HOMING)
    assert page.undo.isEnabled()
    page.undo.click()
    assert bench.record.newest(RoutineName.HOMING) is None
    assert titles(wizard)[1] == "✖ Homing"
    assert not page.undo.isEnabled()


def test_what_was_done_before_the_robot_was_switched_on_anew_counts_no_more(wizard, bench):
    carry_out(wizard, RoutineName.HOMING)
    bench.info = replace(bench.info, boot=8)
    verdict, words, _ = state_of(bench, RoutineName.HOMING)
    assert verdict is Verdict.BAD
    assert "before it was switched on again" in words


def test_the_summary_tells_what_was_found_with_its_date(wizard, bench):
    for step in (RoutineName.HOMING, RoutineName.SIGNS):
        carry_out(wizard, step)
    carry_out(wizard, RoutineName.FORCE, "51")
    wizard.show_page(99)
    page = wizard.page
    assert isinstance(page, SummaryPage)
    when, found = page._rows[RoutineName.FORCE]
    assert when.text() == "✔ 2026-11-21 10:15"
    assert "force scale 1.005" in found.text()
    assert "cleared for 5 N" in page._clearance.text()
    assert wizard.next.text() == "Close"


def test_a_fault_of_the_program_leaves_no_force_behind(wizard, bench, monkeypatch):
    go(wizard, RoutineName.HOMING)
    routine = bench.routines[-1]
    monkeypatch.setattr(routine, "step", lambda now: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        wizard.runner.poll()
    assert routine.cancelled == 1


def test_every_step_has_words(application):
    assert all(step_words(step).title for step in RoutineName)


def test_every_page_is_drawn(wizard):
    for number in range(wizard.pages.count()):
        wizard.show_page(number)
        assert not wizard.grab().isNull()
        if isinstance(wizard.page, RoutinePage):
            assert wizard.page.sizeHint().height() < 540
