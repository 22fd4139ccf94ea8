"""The debrief replays an attempt: slices, 3D, bull's-eye and curves stand at one moment."""

from dataclasses import replace
from time import thread_time
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from views_exercise_attempts import review

from app.core.bend import Bend
from app.exercises.guidance import Purpose
from app.imaging.structures.structure import Structure, StructureKind, StructureSet
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.conditions import Conditions
from app.session.course import Course, CourseItem, held_back
from app.session.ct_facts import CtFacts
from app.session.curves import at_rest, curves
from app.session.motion import ShownMotion, motion
from app.session.next_exercise import Proposal, ProposalReason
from app.session.people import People
from app.session.roster import RosterLine
from app.session.samples import Samples
from app.session.summary import Summary
from app.session.timeline import spans
from app.views.debrief.feature import EXPERT, IDEAL, DebriefFeature
from app.views.debrief.replay import Ghost
from app.views.debrief.sessions import SCORE, SORT_ROLE, Listed
from app.views.kit.access import ACCESS
from app.views.people.feature import PeopleFeature
from app.views.slices.needle_source import Along

FULCRUM = (0.0, 0.16056, 0.090)
PLAN = Plan(np.array([5.0, -18.0, 140.0]), np.array([5.0, 5.0, 140.0]), "plan")
BESIDE = 0.004
"""The needle of these attempts ends so far beside the target [m]."""


def attempted(volume, side=BESIDE, seconds=20.0, bent=False, **changes):
    """An attempt on the small CT whose needle drifts to one side on its way down."""
    placed = PlacedPlan.of(PLAN, Placement(), FULCRUM)
    time = np.arange(0.0, seconds, 0.02)
    share = time / time[-1]
    depth = np.interp(share, [0.0, 0.2, 0.9, 1.0], [-0.01, -0.01, placed.length, placed.length])
    across = np.cross(placed.axis, [0.0, 1.0, 0.0])
    across /= np.linalg.norm(across)
    axis = placed.axis + (share * side / placed.length)[:, None] * across
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    tip, bend = placed.p_entry + depth[:, None] * axis, None
    if bent:
        shape = Bend(0.002 * across, 0.15 * across, 2.0 * across, placed.length)
        bend = np.tile(shape.numbers(), (len(time), 1))
        tip = tip + np.stack([shape.at(one) if one > 0 else np.zeros(3) for one in depth])
    n = len(time)
    samples = Samples(
        time=50.0 + time,
        state=np.where(share < 0.2, "aligning", "inserting"),
        valid=np.ones(n, dtype=bool),
        depth_source=np.full(n, "tracked"),
        depth=depth,
        tip=tip,
        axis=axis,
        target=np.tile(placed.p_target, (n, 1)),
        hub=np.full((n, 3), np.nan),
        guide=np.zeros((n, 3)),
        felt=np.outer(share, 2.0 * across),
        measured=np.full(n, np.nan),
        bend=bend,
    )
    figures = curves(samples, placed)
    facts = {
        "placed": placed,
        "motion": motion(samples, placed, 0.12),
        "curves": figures,
        "spans": spans(figures.time, samples.state),
        "marks": (),
        "tip": at_rest(samples, placed),
        "ct": CtFacts.of_volume(volume),
    }
    return review(**(facts | changes))


@pytest.fixture
def shown(window, patient, settle):
    """The page of the debrief with an attempt on the CT that is open, in slices and 3D."""
    window.resize(1366, 768)
    window.show_patient(patient)
    feature = window.feature(DebriefFeature)
    feature._controller._show(attempted(patient.volume), "")
    assert settle(lambda: feature.page.views.has_ct)
    settle()
    return feature.page


def needle_of(page):
    return page.views.viewing.needle


def go(page, time):
    page.replayer.seek(time)
    page.views.viewing._go_on()
    return needle_of(page)


@pytest.mark.long("journey")
def test_it_opens_where_the_needle_ended_in_slices_and_3d_with_plan_and_tolerances(shown):
    views, motion_ = shown.views, shown.review.motion
    assert {str(name) for name in views.grid.shown.panes} == {
        "in_plane", "probe", "scene", "bullseye",
    }  # fmt: skip
    assert shown.replayer.time == pytest.approx(motion_.end, abs=0.03)
    assert needle_of(shown).tip_mm == pytest.approx(motion_.needle(motion_.last).tip_mm)
    assert np.linalg.norm(needle_of(shown).tip_mm - PLAN.target_mm) == pytest.approx(4.0, abs=0.1)
    assert views.viewing.draft.target_mm == pytest.approx(tuple(PLAN.target_mm))
    assert len(views.viewing.tolerances_mm) == 2
    assert all(pane.canvas.plane is not None for pane in views.panes)
    assert shown.card.ending.text() == (
        "The needle ended 3.9 mm beside the target to the left, and 0.3 mm short of it."
    )


@pytest.mark.long("journey")
def test_slider_arrows_home_end_and_a_click_on_a_curve_move_every_view_together(shown, settle):
    shown.bar.slider.setValue(8000)
    assert shown.replayer.time == pytest.approx(8.0)
    for line in shown.curves._nows:
        assert line.value() == pytest.approx(8.0)
    assert "8.0\u00a0s" in shown.curves.readout.text()
    shown.views.viewing._go_on()
    at_eight = shown.review.motion.row(8.0)
    assert needle_of(shown).tip_mm == pytest.approx(shown.review.motion.needle(at_eight).tip_mm)
    shown.activateWindow()
    shown.bar.slider.setFocus()
    QTest.keyClick(shown.bar.slider, Qt.Key.Key_Right)
    assert shown.replayer.time == pytest.approx(8.1)
    QTest.keyClick(shown.bar.slider, Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    assert shown.replayer.time == pytest.approx(6.1)
    QTest.keyClick(shown.bar.slider, Qt.Key.Key_Home)
    assert shown.replayer.time == 0.0
    QTest.keyClick(shown.bar.slider, Qt.Key.Key_End)
    assert shown.replayer.time == pytest.approx(shown.replayer.end)
    assert settle(lambda: len(shown.curves._nows) == len(shown.curves._curves))
    box = shown.curves._plots[0].getViewBox()
    at = box.mapViewToScene(QPointF(5.0, 0.0))
    place = shown.curves.graphics.mapFromScene(at)
    QTest.mouseClick(shown.curves.graphics.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(place))
    assert shown.replayer.time == pytest.approx(5.0, abs=0.2)


@pytest.mark.long("journey")
def test_the_keys_replay_from_within_a_slice_too_and_up_and_down_still_scroll_it(shown):
    canvas = shown.views.panes[0].canvas
    canvas.setFocus()
    shown.replayer.seek(5.0)
    QTest.keyClick(canvas, Qt.Key.Key_Right)
    assert shown.replayer.time == pytest.approx(5.1)
    before = canvas.index
    QTest.keyClick(canvas, Qt.Key.Key_Up)
    assert canvas.index != before
    assert shown.replayer.time == pytest.approx(5.1)


@pytest.mark.long("journey")
def test_it_plays_at_the_speed_that_was_chosen_and_stands_still_at_the_end(shown, monkeypatch):
    now = [0.0]
    monkeypatch.setattr("app.views.debrief.replay.monotonic", lambda: now[0])
    shown.replayer.seek(2.0)
    shown.bar.play.click()
    assert shown.replayer.is_playing
    assert "Pause" in shown.bar.play.text()
    now[0] = 1.0
    shown.replayer.advance()
    assert shown.replayer.time == pytest.approx(3.0)
    shown.bar.speed.setCurrentIndex(shown.bar.speed.findData(4.0))
    now[0] = 2.0
    shown.replayer.advance()
    assert shown.replayer.time == pytest.approx(7.0)
    now[0] = 60.0
    shown.replayer.advance()
    assert shown.replayer.time == pytest.approx(shown.replayer.end)
    assert not shown.replayer.is_playing
    shown.bar.play.click()
    assert shown.replayer.time == 0.0
    shown.hide()
    assert not shown.replayer.is_playing


@pytest.mark.long("journey")
def test_a_needle_that_tissue_bent_is_drawn_bent(shown, settle):
    volume = shown.views.viewing.volume
    shown.show_review(attempted(volume, bent=True))
    shown.views.show_ct(volume)
    assert settle(lambda: len(needle_of(shown).points_mm) > 2)


@pytest.mark.long("journey")
def test_slices_lie_along_the_needle_or_along_the_planned_path_as_one_chooses(shown):
    frame = shown.views.planes.frame
    assert shown.views.planes.along is Along.NEEDLE
    shown.bar.along.setCurrentIndex(1)
    assert shown.views.planes.shows_path
    path = (PLAN.target_mm - PLAN.entry_mm) / np.linalg.norm(PLAN.target_mm - PLAN.entry_mm)
    assert shown.views.planes.frame.axis == pytest.approx(path)
    assert np.abs(frame.axis - path).max() > 0.05


@pytest.mark.long("journey")
def test_the_ideal_path_stands_beside_the_needle_as_deep_as_it_dotted_with_another_tip(shown):
    shown.show_ghost(Ghost("ideal"))
    shown.replayer.seek(12.0)
    layer = shown.views.ghosts[0]
    row = shown.review.motion.row(12.0)
    assert layer._needle.tip_mm == pytest.approx(shown.review.motion.ideal(row).tip_mm)
    drawn, own = layer._layer, shown.views.panes[0].canvas.layers.needle
    assert drawn._mark.dash
    assert not own._mark.dash
    assert drawn.tip._mark.symbol is not own.tip._mark.symbol
    assert drawn.title == "ideal"
    assert not shown.bar.by.isVisibleTo(shown)
    assert [line is None for line in shown.curves._ghost] == [True, False, False]


@pytest.mark.long("journey")
def test_another_attempt_stands_beside_it_at_the_same_time_or_at_the_same_depth(shown, settle):
    volume = shown.views.viewing.volume
    other = attempted(volume, side=0.001, seconds=10.0)
    settle(lambda: shown._ghost is not None, timeout=3.0)  # the expert, whom nobody chose
    shown.bar.by.setCurrentIndex(0)
    shown.show_ghost(Ghost("ghost, 91 points", other))
    assert shown.bar.by.isVisibleTo(shown)
    layer, own = shown.views.ghosts[0], shown.review.motion
    shown.replayer.seek(8.0)
    assert layer._needle.tip_mm == pytest.approx(
        other.motion.needle(other.motion.row(8.0)).tip_mm, abs=0.2
    )
    shown.bar.by.setCurrentIndex(1)
    shown.replayer.seek(14.0)
    depth = own.depth[own.row(14.0)]
    there = layer._needle.tip_mm - PLAN.entry_mm
    assert np.linalg.norm(there) == pytest.approx(1e3 * depth, abs=0.5)
    assert settle(lambda: len(shown.curves._dotted) == len(shown.curves._curves))
    assert len(shown.views.path._ghost) > 2
    shown.show_ghost(None)
    assert layer._needle is None
    assert not shown.curves._dotted


@pytest.mark.long("journey")
def test_without_its_ct_it_says_so_offers_to_open_it_and_replays_the_rest(window, patient, settle):
    feature = window.feature(DebriefFeature)
    feature._controller._show(attempted(patient.volume), "")
    settle()
    page = feature.page
    assert not page.views.has_ct
    assert "not open" in page.views.why.text()
    assert page.views.open.isVisibleTo(page)
    page.replayer.seek(8.0)
    assert page.path._now is not None
    window.show_patient(patient)
    assert settle(lambda: page.views.has_ct)


@pytest.mark.long("journey")
@pytest.mark.promise("docs/user-guide.md: another patient's is never shown")
def test_another_patients_ct_is_never_shown_under_an_attempt(window, patient, settle):
    window.show_patient(patient)
    feature = window.feature(DebriefFeature)
    views = feature.page.views
    same = CtFacts.of_volume(patient.volume)
    for facts in (CtFacts("CT-OTHER"), CtFacts(), replace(same, digest="0" * 64)):
        feature._controller._show(attempted(patient.volume, ct=facts), "")
        assert settle(lambda: "not the one" in views.why.text()), facts
        assert not views.has_ct
    known = replace(same, digest=patient.volume.digest)
    feature._controller._show(attempted(patient.volume, ct=known), "")
    assert settle(lambda: views.has_ct)
    window.conductor.leave_patient()
    assert not views.has_ct
    assert views.viewing.volume is None


@pytest.mark.long("journey")
def test_the_ct_is_opened_as_the_exercise_has_it_and_the_debrief_comes_back(
    window, patient, settle, monkeypatch
):
    feature = window.feature(DebriefFeature)
    asked = []
    monkeypatch.setattr(window.open_ct, "open_phantom", asked.append)
    feature._controller._show(attempted(patient.volume), "")
    feature._controller.exercise = "first-insertion"
    feature.show()
    feature.page.views.open.click()
    assert asked == [1]
    window.open_ct.opened.emit(patient)
    assert settle(lambda: window.pages.currentWidget() is feature.page)
    assert settle(lambda: feature.page.views.has_ct)


@pytest.mark.long("journey")
def test_what_comes_next_is_said_and_begun_by_its_button(shown, window):
    begun = []
    window.feature(DebriefFeature).begin_wanted.disconnect()
    window.feature(DebriefFeature).begin_wanted.connect(begun.append)
    shown.show_proposal(
        Proposal("thick-tissue", "Thick tissue", ProposalReason.LEVEL, level=2, metric="")
    )
    assert shown.next.isVisibleTo(shown)
    assert shown.next.text() == "Next: Thick tissue"
    assert "level 2" in shown.proposal.text()
    shown.next.click()
    assert begun == ["thick-tissue"]
    again = Proposal(
        "first-insertion", "First insertion", ProposalReason.AGAIN, "Angle error", 12.0
    )
    shown.show_proposal(again)
    assert not shown.next.isVisibleTo(shown)
    assert "Angle error cost most: 12 points" in shown.proposal.text()
    window.feature(DebriefFeature)._controller.exercise = "first-insertion"
    shown.retry.click()
    assert begun == ["thick-tissue", "first-insertion"]


@pytest.mark.long("journey")
def test_a_result_that_is_held_shows_neither_score_nor_replay_but_who_releases_it(shown, window):
    controller = window.feature(DebriefFeature)._controller
    controller._show(attempted(shown.views.viewing.volume), "Autumn")
    assert "The instructor releases its result" in shown.held.text()
    assert "Autumn" in shown.held.text()
    for widget in (shown.table, shown.views, shown.curves, shown.bar, shown.report, shown.export):
        assert not widget.isVisibleTo(shown)
    assert not shown.proposal.isVisibleTo(shown)
    assert shown.review is None
    assert shown.retry.isVisibleTo(shown)


@pytest.mark.long("journey")
def test_beside_an_attempt_stand_the_ideal_path_and_comparable_ones_by_their_points(shown, window):
    from app.views.debrief.feature import ghost_words

    def attempt(key, total, student, hand="mouse"):
        made = Conditions("one", hand=hand)
        return SimpleNamespace(
            id=key, total=total, started="2026-11-20T10:00:00", student=student, conditions=made
        )

    arms = attempt("z", 100.0, "ada", "arm")
    one, two = attempt("a", 87.4, "ada"), attempt("b", 80.0, "ada")
    other = attempt("c", 99.0, "ben")
    words = ghost_words([(arms, True), (one, True), (two, True), (other, False)], shown.review)
    assert [key for key, _ in words] == [EXPERT, IDEAL, "z", "a", "b", "c"]
    assert words[2][1].startswith("the arm (simulation): 100")  # nobody's best
    assert words[3][1].startswith("own best: 87")
    assert words[5][1].startswith("ben: 99")
    shown.offer_ghosts(words)
    assert shown.bar.ghost.count() == 7
    got = []
    shown.ghost_wanted.connect(got.append)
    shown.bar.ghost.setCurrentIndex(shown.bar.ghost.findData(IDEAL))
    assert got == [IDEAL]
    assert shown.curves._ghost[0] is None
    assert window.feature(DebriefFeature).page._ghost.title == "ideal"


@pytest.mark.long("journey")
def test_a_click_into_an_attempt_of_three_minutes_does_not_hold_the_window(shown, settle):
    volume = shown.views.viewing.volume
    long = attempted(volume, seconds=180.0)
    shown.show_review(long)
    shown.views.show_ct(volume)
    shown.show_ghost(Ghost("ghost", attempted(volume, side=0.001, seconds=180.0)))
    assert settle(lambda: shown.views.is_settled)
    spent = []
    for time in np.linspace(0.0, 179.0, 25):
        begin = thread_time()
        shown.replayer.seek(float(time))
        QCoreApplication.processEvents()
        spent.append(thread_time() - begin)
        settle()
    assert sorted(spent)[-3] < 0.1


@pytest.fixture
def assessed(window):
    """Ada takes an assessment whose results the instructor releases; a password is set."""
    people = People()
    people.set_instructor("correct horse")
    ada, _ = people.add(RosterLine("Ada", groups=("A",)))
    item = CourseItem(exercise="first-insertion", purpose=Purpose.ASSESSMENT)
    Course(id="autumn", title="Autumn", groups=("A",), items=(item,)).save()
    yield ada
    window.feature(PeopleFeature).close()


@pytest.mark.long("journey")
def test_the_list_tells_a_student_no_result_that_is_held_and_the_instructor_every_one(
    window, assessed, settle
):
    sessions = window.feature(DebriefFeature).sessions
    score = {"total": 87.0, "passed": True, "void_reason": "", "rows": []}
    under = Conditions("first-insertion", 1)
    mine = Summary("a", "2026-11-20T10:00:00+00:00", assessed.key, "first-insertion",
                   state="ended", score=score, conditions=under)  # fmt: skip
    practice = replace(mine, id="b", exercise_id="thick-tissue",
                       conditions=Conditions("thick-tissue", 1))  # fmt: skip
    ACCESS.sign_in(assessed)
    window.feature(PeopleFeature).look()
    assert settle(lambda: ACCESS.guarded and bool(ACCESS.owner(assessed.key)))
    asked = ((one.id, one.student, one.exercise_id, 1) for one in (mine, practice))
    sessions.show_listed(Listed([mine, practice], held_back(asked)))
    cells = {sessions.model.index(row, SCORE).data(Qt.ItemDataRole.DisplayRole) for row in (0, 1)}
    assert cells == {"held", "✔ 87"}
    assert sessions.model.index(0, SCORE).data(SORT_ROLE) == -1.0
    assert "Autumn" in sessions.model.index(0, SCORE).data(Qt.ItemDataRole.ToolTipRole)
    ACCESS.sign_in(None, instructor=True)
    assert sessions.model.index(0, SCORE).data(Qt.ItemDataRole.DisplayRole) == "✔ 87"
    People().remark("a", released=True)
    assert held_back([("a", assessed.key, "first-insertion", 1)]) == {}


@pytest.mark.long("journey")
def test_whoever_signs_in_sees_of_the_attempt_on_the_page_what_he_may(
    window, patient, assessed, settle
):
    window.show_patient(patient)
    feature = window.feature(DebriefFeature)
    page = feature.page
    ACCESS.sign_in(assessed)
    window.feature(PeopleFeature).look()
    assert settle(lambda: ACCESS.guarded and bool(ACCESS.owner(assessed.key)))
    mine = attempted(
        patient.volume, student=assessed.key, conditions=Conditions("first-insertion", 1)
    )
    feature._controller._show(mine, "Autumn")
    assert page.review is None
    ACCESS.sign_in(None, instructor=True)
    assert settle(lambda: page.review is mine)
    assert "Not released" in page.comment.text()
    assert page.remarks.release.isEnabled()
    People().remark(mine.id, comment="well held", void="the cable was loose")
    feature._controller.look_again()
    assert settle(lambda: "well held" in page.comment.text())
    assert "the cable was loose" in page.card.reason.text()
    assert "Void" in page.card.verdict.text()
    page.remarks.count.trigger()
    assert settle(lambda: "cable" not in page.card.reason.text())
    ACCESS.sign_in(assessed)
    assert settle(lambda: page.review is None)
    assert "Autumn" in page.held.text()
    assert not page.comment.isVisibleTo(page)
    assert page.remarks.button.isHidden()
    People().remark(mine.id, released=True)
    ACCESS.changed.emit()
    assert settle(lambda: page.review is not None)
    assert "well held" in page.comment.text()
    ACCESS.sign_in(None)
    assert settle(lambda: "another one's" in page.held.text())
    assert not page.table.isVisibleTo(page)


@pytest.mark.long("journey")
def test_structures_that_the_patient_has_are_drawn_in_the_replay_too(shown, window, settle):
    volume = window.conductor.patient.volume
    voxels = np.ones((8, 6, 10), dtype=bool)
    place, colour = (20, 30, 16), (200, 40, 40)
    vessel = Structure("vessel", StructureKind.VESSEL, colour, voxels, place, volume.affine_mm)
    window.editors.structures.add(StructureSet((vessel,)))
    assert settle(lambda: window.workspace.scene.structures != ())
    assert settle(lambda: len(shown.views.scene.structures) == 1)
    assert shown.views.scene.legend[0][1].endswith("vessel")


@pytest.mark.long("journey")
def test_a_target_that_breathing_moves_is_shown_where_it_was(shown):
    volume, placed = shown.views.viewing.volume, shown.review.placed
    breathing = attempted(volume)
    away = np.tile(placed.p_target, (len(breathing.motion), 1))
    away[:, 1] += 0.006 * np.sin(breathing.motion.time)
    moving = replace(breathing, motion=replace(breathing.motion, target=away))
    shown.show_review(moving)
    shown.views.show_ct(volume)
    row = moving.motion.row(4.7)
    shown.replayer.seek(4.7)
    assert shown.views.viewing.target_now_mm == pytest.approx(moving.motion.target_mm(row), abs=0.1)
    assert np.abs(shown.views.viewing.target_now_mm - PLAN.target_mm).max() > 5.0


@pytest.mark.long("journey")
def test_a_scan_in_the_list_leads_to_the_moment_it_was_taken(shown):
    scan = SimpleNamespace(time=shown.review.origin + 7.0)
    shown._review = replace(shown.review, control_scans=(scan,))
    shown.scans.cellClicked.emit(0, 0)
    assert shown.replayer.time == pytest.approx(7.0)


@pytest.mark.long("journey")
def test_the_instructor_lets_an_attempt_be_shown_in_place_of_the_expert(shown, window, monkeypatch):
    feature = window.feature(DebriefFeature)
    take, expert = feature._choices
    under = Conditions("first-insertion", version=3)
    feature._controller._show(replace(shown.review, conditions=under), "")
    feature._offer_choices()
    assert (take.isEnabled(), expert.isEnabled()) == (True, False)
    take.trigger()
    kept = ShownMotion.kept("first-insertion", 3)
    assert kept.depth[-1] == pytest.approx(shown.review.motion.depth[-1], abs=1e-3)
    feature._offer_choices()
    assert expert.isEnabled()

    with monkeypatch.context() as student:
        student.setattr(type(ACCESS), "may_manage", property(lambda _: False))
        feature._offer_choices()
        assert (take.isEnabled(), expert.isEnabled()) == (False, False)
        feature.choose_expert()  # whatever calls it
        assert ShownMotion.kept("first-insertion", 3) is not None
    expert.trigger()
    feature._offer_choices()
    expert.trigger()
    assert ShownMotion.kept("first-insertion", 3) is None
