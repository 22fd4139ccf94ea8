"""From the card of a debrief to the drill, on the same patient and plan, and back."""

from dataclasses import replace

import numpy as np
import pytest
from test_views_replay import PLAN, attempted

from app.exercises.drill import DrillKind, DrillPart
from app.exercises.drilled import drilled
from app.exercises.guidance import Purpose
from app.exercises.library import load_exercise
from app.scoring.conditions import Conditions, DeviceKind
from app.session.course import Course, CourseItem
from app.session.next_exercise import Proposal, ProposalReason
from app.session.people import People
from app.session.roster import RosterLine
from app.views.debrief.card import drill_title
from app.views.debrief.feature import EXPERT, DebriefFeature
from app.views.exercise.feature import ExerciseFeature
from app.views.kit.access import ACCESS
from app.views.people.feature import PeopleFeature

WHOLE = load_exercise("first-insertion")
UNDER = Conditions(WHOLE.id, WHOLE.version, hand="mouse")


@pytest.fixture
def shown(window, patient, settle):
    """A debrief of an attempt that calls for aligning, on its own patient."""
    fits = replace(patient, phantom_seed=WHOLE.ct.phantom.seed)
    window.show_patient(fits)
    feature = window.feature(DebriefFeature)

    def show(**changes):
        facts = {"conditions": UNDER, "practise": DrillKind.ALIGN} | changes
        feature._controller._show(attempted(fits.volume, **facts), "")
        assert settle(lambda: feature.page.review is not None and feature.page._proposal)
        settle()
        return feature.page

    return show


@pytest.mark.long("journey")
def test_the_button_begins_exactly_that_drill_on_the_plan_of_the_attempt(window, shown, settle):
    page = shown()
    assert drill_title(DrillKind.ALIGN) in page.card.drill.text()
    page.card.drill.click()
    assert settle(lambda: window.conductor.exercise.drill is not None)
    drill = window.conductor.exercise
    assert drill.drill == DrillPart(kind="align", of=WHOLE.id, version=WHOLE.version)
    draft = window.editor.edit.draft
    assert np.allclose(draft.entry_mm, PLAN.entry_mm)
    assert np.allclose(draft.target_mm, PLAN.target_mm)
    titles = dict(window.feature(ExerciseFeature).titles)
    assert titles[drill.id].startswith("Drill: ")
    assert window.workspace.rail.drill.whole == titles[drill.id]
    window.conductor.set_exercise(WHOLE)
    assert window.workspace.rail.drill.whole == ""


@pytest.mark.long("journey")
def test_again_after_a_drill_is_the_drill_and_next_is_the_whole_exercise(window, shown, settle):
    part = DrillPart(kind="depth", of=WHOLE.id, version=WHOLE.version)
    under = replace(UNDER, exercise="drill-depth-first-insertion", version=1, drill="depth")
    page = shown(drill=part, conditions=under, practise=None, score=None)
    assert page._proposal.reason is ProposalReason.WHOLE
    assert page.next.isVisibleTo(page)
    assert page.card.kind is DrillKind.DEPTH
    page.retry.click()
    assert settle(lambda: window.conductor.exercise.drill is not None)
    assert window.conductor.exercise.drill.kind is DrillKind.DEPTH


@pytest.mark.long("journey")
def test_no_drill_of_another_version_or_of_what_may_not_be_begun(shown, monkeypatch):
    assert shown(conditions=replace(UNDER, version=WHOLE.version + 1)).card.kind is None
    assert shown(conditions=replace(UNDER, exercise="gone")).card.kind is None
    monkeypatch.setattr(type(ACCESS), "refusal", lambda self, name: "used up")
    assert shown().card.kind is None


@pytest.mark.long("journey")
def test_the_depth_begins_aligned_with_a_pointer_and_not_with_robot_or_pen(shown, settle):
    simulated = replace(UNDER, kind=DeviceKind.SIMULATED)
    page = shown(conditions=simulated, practise=DrillKind.DEPTH)
    assert "you begin aligned" in page.card.practise.text()
    for hand, kind in (("robot", DeviceKind.REAL), ("pen", DeviceKind.PEN)):
        held = replace(UNDER, hand=hand, kind=kind)
        page = shown(conditions=held, practise=DrillKind.DEPTH)
        assert page.card.kind is DrillKind.DEPTH
        assert "aligned" not in page.card.practise.text()


@pytest.mark.long("journey")
def test_nobody_drills_what_a_course_of_his_holds_as_an_assessment(window, shown, settle):
    ada, _ = People().add(RosterLine("Ada"))
    item = CourseItem(exercise=WHOLE.id, version=WHOLE.version, purpose=Purpose.ASSESSMENT)
    Course(id="autumn", title="Autumn", items=(item,)).save()
    page, conductor = shown(), window.conductor
    conductor.set_exercise(drilled(WHOLE, DrillKind.ALIGN, page.review.placed))
    assert page.card.kind is DrillKind.ALIGN
    assert conductor.controller.refusal() == ""
    window.feature(PeopleFeature).look()
    ACCESS.sign_in(ada)
    assert settle(lambda: "course Autumn: nobody rehearses it" in conductor.controller.refusal())
    assert ACCESS.refusal(WHOLE.id) == ""  # it is his to do
    assert shown().card.kind is None
    page.drill_wanted.emit(DrillKind.ALIGN)
    assert "course Autumn: nobody rehearses it" in window.message_bar.text


@pytest.mark.long("journey")
def test_the_expert_stands_beside_an_attempt_until_somebody_chooses_otherwise(shown, settle):
    page = shown()
    assert page.bar.ghost.currentData() == EXPERT
    assert settle(lambda: page._ghost is not None)
    expert, own = page._ghost.review, page.review
    assert expert.score is None
    ends = expert.motion.ending()
    assert ends.distance < 0.004  # an expert's, by the published errors, on this very plan
    assert np.allclose(expert.placed.p_target, own.placed.p_target)
    page.bar.ghost.setCurrentIndex(0)
    assert settle(lambda: page._ghost is None)
    page.offer_ghosts([(EXPERT, "the expert")], EXPERT)
    assert page.bar.ghost.currentData() is None


@pytest.mark.long("journey")
def test_where_the_drill_stands_out_nothing_else_does(shown):
    page = shown(score=None)
    page.show_proposal(Proposal(WHOLE.id, WHOLE.title, ProposalReason.AGAIN))
    assert page.card.drill.property("role") == "primary"
    assert page.retry.property("role") != "primary"
    page.offer_drill(None)
    assert page.retry.property("role") == "primary"
