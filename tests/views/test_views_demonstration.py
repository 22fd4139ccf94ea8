"""The demonstration and exercises that leave the entry to the student, or show nothing live."""

import numpy as np
import pytest
from window_rig import plan

from app.exercises.parts import OwnPlan
from app.session.shown_views import Shown
from app.views.exercise.feature import ExerciseFeature
from app.views.shell import demonstration
from app.views.shell.demonstration import (
    FRESH_S,
    Demonstration,
    DemonstrationError,
    DemonstrationScript,
    has_fresh_fix,
)


@pytest.fixture
def own(window, monkeypatch):
    """A window with an exercise that gives the target alone."""
    monkeypatch.setattr(window.conductor, "fits", lambda _: True)
    first = next(iter(window.feature(ExerciseFeature).exercises.values()))

    def shown(patient, target):
        exercise = first.model_copy(update={"plan": OwnPlan(own=True, target_mm=target)})
        window.feature(ExerciseFeature).exercises[exercise.id] = exercise
        window.conductor.set_exercise(exercise)
        window.show_patient(patient)
        return Demonstration(window, DemonstrationScript(exercise.id))

    return shown


@pytest.mark.long("journey")
def test_the_proposed_entry_is_taken_and_said(window, own, patient, settle) -> None:
    from dataclasses import replace

    from app.planning.plan import Plan

    proposed = Plan(np.array([5.0, -18.0, 140.0]), np.array([5.0, 5.0, 140.0]), "proposed")
    show, said = own(replace(patient, proposed=proposed), (5.0, 5.0, 140.0)), []
    show.told.connect(said.append)
    assert window.editor.edit.draft.entry_mm is None
    assert show._patient_is_open()
    draft = window.editor.edit.draft
    np.testing.assert_allclose(draft.entry_mm, proposed.entry_mm, atol=2.0)  # on the skin
    np.testing.assert_allclose(draft.target_mm, (5.0, 5.0, 140.0))
    assert "taking the proposed one" in said[0]
    window.undo.undo()  # as if the student had placed it
    assert window.editor.edit.draft.entry_mm is None


@pytest.mark.long("journey")
def test_without_a_proposed_entry_it_says_what_to_do(window, own, patient) -> None:
    show, failed = own(patient, (5.0, 5.0, 140.0)), []
    assert patient.proposed is None
    with pytest.raises(DemonstrationError, match="leaves the entry to the student"):
        show._patient_is_open()
    show.failed.connect(failed.append)
    show._timer.start()
    show._poll()
    assert "acus run" in failed[0]


@pytest.mark.long("journey")
def test_where_scans_guide_one_is_taken_at_the_target(window, patient, settle) -> None:
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None and window.conductor.settled)
    run = window.conductor.controller.run
    object.__setattr__(run, "shown", Shown(live=False))
    scans = []
    run.trainer.scan = lambda order=None, choice=None: scans.append(order)
    show = Demonstration(window, DemonstrationScript())
    snapshot = run.trainer.snapshot()
    snapshot.device.row[show_slot()] = 9.0
    run.trainer.snapshot = lambda: snapshot
    assert show._needle_is_in()
    assert show._step == show._scan_is_shown
    assert scans[0].centre_mm == pytest.approx(window.workspace.viewing.cursor_mm[2], abs=0.1)
    assert not show._scan_is_shown()  # its slices are not there yet


def show_slot() -> int:
    from app.core import state_vector as sv

    return sv.TRAINEE_PHASE


@pytest.mark.parametrize(
    ("age", "fresh"), [(None, False), (0.0, True), (FRESH_S, True), (2 * FRESH_S, False)]
)
def test_before_the_first_fix_pictures_on_the_way_wait(age, fresh) -> None:
    from types import SimpleNamespace

    assert has_fresh_fix(SimpleNamespace(tracker=SimpleNamespace(age=age))) is fresh
    assert not has_fresh_fix(SimpleNamespace(tracker=None))


@pytest.mark.long("journey")
def test_its_patience_is_measured_in_this_computers_work_not_in_time_lost_to_others(
    window, own, patient, monkeypatch
):
    show, failed, used = own(patient, (5.0, 5.0, 140.0)), [], [0.0]
    monkeypatch.setattr(demonstration, "process_time", lambda: used[0])
    show.failed.connect(failed.append)
    show._then("waiting", lambda: False)
    show._timer.start()
    for _ in range(int(2 * demonstration.PATIENCE_S / (1e-3 * demonstration.PERIOD_MS))):
        show._poll()  # twice the patience by the clock, beside a program that takes everything
    assert failed == []
    used[0] = demonstration.PATIENCE_S + 1.0
    show._poll()
    assert "nothing has happened" in failed[0]


@pytest.mark.long("journey")
def test_a_slow_attempt_that_goes_on_is_waited_for_and_one_without_end_is_not(
    window, patient, monkeypatch
) -> None:
    """At a computer 20 times as slow an attempt of 20 s takes more than its patience."""
    window.show_patient(patient)
    used = [0.0]
    monkeypatch.setattr(demonstration, "process_time", lambda: used[0])
    show, failed = Demonstration(window, DemonstrationScript()), []
    show.failed.connect(failed.append)
    show._timer.start()
    show._timer.setInterval(10**6)
    elapsed = [0.0]

    def goes_on() -> bool:
        show._note_progress(elapsed[0])
        return False

    show._step = goes_on
    for _ in range(30):
        elapsed[0] += 1.0
        used[0] += 0.5 * demonstration.PATIENCE_S
        show._poll()
    assert failed == []
    used[0] += demonstration.PATIENCE_S + 1.0  # no second more of the attempt has passed
    show._poll()
    assert "nothing has happened" in failed[0]
    show._timer.start()
    elapsed[0] = demonstration.LONGEST_S + 1.0
    show._poll()
    assert "the attempt is not over after" in failed[1]
