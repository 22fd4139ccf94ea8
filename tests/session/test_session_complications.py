"""Complications of an attempt: by lot given what is done, seen in scans, noticed and answered."""

import json
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from chest import DOWN, ENTRY, TARGET, chest
from field_rig import ball
from session_fakes import EXERCISE, Bench

from app.core.events import Event
from app.exercises.guidance import Purpose
from app.exercises.procedure import ComplicationsPart, ProcedurePart
from app.imaging.field import TissueKind
from app.imaging.inside import lung_shape
from app.imaging.scan_order import ScanOrder
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.complications.answers import Kind, Reaction
from app.scoring.complications.course import Vitals
from app.scoring.complications.factors import Lying
from app.scoring.complications.lots import Lots
from app.scoring.procedure import ProcedureMarks
from app.scoring.trajectory import Trajectory
from app.session import trainer
from app.session.complication_case import KIND, ComplicationCase, lying_of
from app.session.complications import Complications, attempt_seed
from app.session.control_scan import ControlScan, scans_of
from app.session.errors import ProcedureNotPossibleError
from app.session.lung_watch import LungWatch, lesion_facts
from app.session.needle_now import NeedleNow
from app.session.procedure_marks import marks_of_complications
from app.session.recording import read_recording
from app.session.scan_reading import ScanReading
from app.session.scripted_answers import MANNERS, ScriptedAnswers
from app.simulation.bound_field import BoundField

FIELD = chest()
PLACED = PlacedPlan.of(Plan(ENTRY, TARGET, "p"), Placement(), np.array([0.0, 0.16, 0.09]))


def case(field=FIELD, samples=True, **part) -> ComplicationCase:
    return ComplicationCase(
        part=ComplicationsPart(**part),
        placed=PLACED,
        field=field,
        bound=BoundField(field, PLACED.T_world_patient, PLACED.p_target),
        seed=5,
        gauge=17,
        samples=samples,
        shape=lung_shape(field, TARGET, DOWN),
        lying=Lying.SUPINE,
        lesion=lesion_facts(field, TARGET),
    )


CASE = case()


def needle(depth_mm: float) -> NeedleNow:
    tip = PLACED.p_entry + 1e-3 * depth_mm * PLACED.axis
    return NeedleNow(tip, PLACED.axis, 1e-3 * depth_mm, PLACED.p_target, True)


class Attempt:
    """One attempt at 50 Hz, and what its record keeps."""

    def __init__(self, of: ComplicationCase = CASE, attempt: int = 0) -> None:
        self.happens, self.now, self.depth = Complications(of, attempt), 100.0, -5.0
        self.events = [self._event(self.happens.begin())]

    def go(self, depth_mm: float, speed: float = 10.0) -> "Attempt":
        """Move the tip at a speed [mm/s], looked at 50 times a second."""
        steps = max(1, round(abs(depth_mm - self.depth) / speed / 0.02))
        for depth in np.linspace(self.depth, depth_mm, steps + 1)[1:]:
            self._look(float(depth))
        return self

    def wait(self, seconds: float, waits: bool = False) -> "Attempt":
        for _ in range(round(seconds / 0.1)):
            self._look(self.depth, waits, 0.1)
        return self

    def do(self, answer: Reaction) -> str:
        happening = self.happens.answer(answer)
        self.events.append(self._event(happening))
        return happening.words

    def _look(self, depth: float, waits: bool = False, after: float = 0.02) -> None:
        self.now, self.depth = self.now + after, depth
        for one in self.happens.look(needle(depth), True, self.now, waits):
            self.events.append(self._event(one))

    def _event(self, one) -> Event:
        return Event(self.now, KIND, one.words, json.loads(json.dumps(one.data)))

    @property
    def onset(self) -> float | None:
        return next((e.time for e in self.events if e.data["step"] == "onset"), None)

    @property
    def probability(self) -> float:
        risks = [e.data["probability"] for e in self.events if e.data["step"] == "risk"]
        return risks[-1] if risks else 0.0

    def marks(self):
        return marks_of_complications(self.events, PLACED, self.now)


def seed_with(of: ComplicationCase = CASE, **limits: tuple[float, float]) -> int:
    """Return the first attempt whose lots lie within limits."""
    return next(
        n for n in range(5000)
        if all(a <= getattr(Lots.of(of.seed, n), k) < b for k, (a, b) in limits.items())
    )  # fmt: skip


LARGE = seed_with(air=(0.0, 0.05), drain=(0.0, 0.25), size=(0.8, 1.0))
SMALL = seed_with(air=(0.0, 0.05), drain=(0.3, 1.0))
NOTHING = seed_with(air=(0.9, 1.0), blood=(0.5, 1.0))


@pytest.mark.long("machine")
def test_nothing_happens_until_the_pleura_is_punctured() -> None:
    attempt = Attempt(attempt=LARGE).go(14.0).wait(120.0)
    assert attempt.probability == 0.0
    assert attempt.onset is None
    attempt.go(30.0)
    assert attempt.probability > 0.1


@pytest.mark.long("machine")
def test_a_second_puncture_raises_the_odds_and_dwelling_and_hurrying_do_not() -> None:
    fast = Attempt(attempt=NOTHING).go(40.0, speed=40.0)
    slow = Attempt(attempt=NOTHING).go(40.0, speed=5.0).wait(200.0)
    assert fast.probability == slow.probability > 0.0
    again = Attempt(attempt=NOTHING).go(40.0).go(5.0).go(40.0)
    assert again.probability > fast.probability
    facts = [e.data["facts"] for e in again.events if e.data["step"] == "risk"]
    assert [one["again"] for one in facts] == [False, True]


@pytest.mark.long("machine")
def test_a_deep_way_a_thick_needle_and_emphysema_raise_the_odds() -> None:
    shallow, deep = Attempt(attempt=NOTHING).go(40.0), Attempt(attempt=NOTHING).go(60.0)
    assert deep.probability > shallow.probability
    thin = Attempt(replace(CASE, gauge=20), NOTHING).go(40.0)
    assert thin.probability < shallow.probability
    sick = Attempt(case(emphysema=True), NOTHING).go(40.0)
    well = Attempt(case(emphysema=False), NOTHING).go(40.0)
    assert well.probability < shallow.probability < sick.probability  # not known lies between
    down = Attempt(replace(CASE, lying=Lying.DOWN), NOTHING).go(40.0)
    assert down.probability < shallow.probability


def test_the_needle_for_local_anaesthetic_punctures_too_and_is_thin() -> None:
    attempt = Attempt(attempt=NOTHING)
    for depth in (10.0, 20.0, 30.0):
        attempt.now += 1.0
        for one in attempt.happens.look(needle(depth), False, attempt.now):
            attempt.events.append(attempt._event(one))
    facts = [e.data["facts"] for e in attempt.events if e.data["step"] == "risk"]
    assert facts[-1]["thick"] is False
    assert attempt.go(5.0).go(30.0).probability > 0.0
    assert (
        attempt.events[-1].data["facts"] | {"again": True, "thick": True}
        == (attempt.events[-1].data["facts"])
    )


@pytest.mark.long("machine")
def test_the_same_seed_gives_the_same_complication_and_the_record_gives_it_again() -> None:
    one, two = (Attempt(attempt=LARGE).go(48.0).wait(200.0) for _ in range(2))
    assert one.onset == two.onset is not None
    assert [e.data for e in one.events] == [e.data for e in two.events]
    begun = one.events[0].data
    assert Lots.read(begun["lots"]) == Lots.of(begun["seed"], begun["attempt"])
    again = Attempt(attempt=begun["attempt"]).go(48.0).wait(200.0)
    assert again.marks() == one.marks()


def test_an_assessment_gives_all_one_seed_and_practice_each_its_own() -> None:
    ids = ("20260101T000000-aaaa", "20260101T000000-bbbb")
    assert {attempt_seed(one, True) for one in ids} == {0}
    assert len({attempt_seed(one, False) for one in ids}) == 2
    assert attempt_seed(ids[0], False) == attempt_seed(ids[0], False)


@pytest.mark.long("machine")
def test_onset_comes_after_its_cause_and_in_a_share_of_seeds_that_is_the_probability() -> None:
    begun, dry = 0, case(bleeding=False)
    for n in range(120):
        attempt = Attempt(dry, n)
        attempt.go(48.0, speed=100.0).wait(0.1)
        caused = attempt.now
        attempt._look(48.0)
        attempt.now += 60.0
        attempt._look(48.0)
        begun += attempt.onset is not None
        assert attempt.onset is None or attempt.onset > caused
    p = attempt.probability
    assert begun / 120 == pytest.approx(p, abs=3.0 * np.sqrt(p * (1 - p) / 120))


@pytest.mark.long("machine")
def test_the_lung_falls_back_in_the_next_scans_more_and_more() -> None:
    attempt = Attempt(case(bleeding=False), LARGE).go(48.0)
    assert attempt.happens.scanned() is None
    attempt.wait(60.0)
    first = attempt.happens.scanned()
    attempt.wait(60.0)
    second = attempt.happens.scanned()
    assert 0.0 < first.share < second.share < 0.8
    assert np.linalg.norm(second.displacement_mm) > np.linalg.norm(first.displacement_mm) > 0.0
    np.testing.assert_array_equal(attempt.happens.fallen_mm, second.displacement_mm)


def test_a_patient_turned_before_it_begins_has_a_smaller_leak_or_none() -> None:
    up, turned = (Attempt(case(bleeding=False), LARGE).go(48.0) for _ in range(2))
    turned.happens.rolled_over()
    for attempt in (up, turned):
        attempt.wait(80.0)
    assert 0.0 <= turned.happens.share < 0.7 * up.happens.share


@pytest.mark.long("machine")
def test_what_waits_for_the_program_does_not_grow() -> None:
    attempt = Attempt(attempt=LARGE).go(48.0).wait(60.0)
    share = attempt.happens.share
    attempt.wait(100.0, waits=True)
    assert attempt.happens.share == share > 0.0


@pytest.mark.long("machine")
def test_it_is_noticed_and_answered_by_size() -> None:
    attempt = Attempt(case(bleeding=False), SMALL).go(48.0).wait(60.0)
    assert "right" in attempt.do(Reaction.GO_ON)
    marks = attempt.marks()
    assert marks.worth() == (1.0,)
    assert marks.waits() == (attempt.now - attempt.onset,)
    late = Attempt(case(bleeding=False), LARGE).go(48.0).wait(250.0)
    words = late.do(Reaction.GO_ON)
    assert "wrong" in words
    assert "pneumothorax of" in words
    assert "right" in late.do(Reaction.DRAIN)
    assert late.wait(60.0).happens.share < 0.1


def test_an_answer_to_a_complication_that_is_not_there_is_told_in_one_line_and_recorded() -> None:
    attempt = Attempt(attempt=NOTHING).go(30.0)
    words = attempt.do(Reaction.DRAIN)
    assert words == "place a chest drain: there is no complication"
    assert "\n" not in words
    kept = attempt.events[-1].data
    assert (kept["verdict"], kept["answer"], kept["kinds"]) == ("nothing_there", "drain", [])
    assert attempt.marks().worth() == (0.0,)
    assert attempt.happens.state.answers == (words,)


@pytest.mark.long("machine")
def test_the_lung_bleeds_after_a_sample_about_the_needles_way() -> None:
    bleeds = seed_with(air=(0.9, 1.0), blood=(0.0, 0.3), grade=(0.0, 0.2))
    attempt = Attempt(attempt=bleeds).go(48.0).wait(30.0)
    assert attempt.onset is None
    attempt.happens.fired(needle(48.0))
    attempt.wait(120.0)
    inside = attempt.happens.scanned()
    assert inside.dense
    assert inside.blood_mm > 10.0
    np.testing.assert_allclose(inside.way_mm[1], TARGET - [0.0, 2.0, 0.0], atol=0.5)
    np.testing.assert_allclose(inside.way_mm[0], ENTRY + [0.0, 16.1, 0.0], atol=1.5)
    assert "right" in attempt.do(Reaction.TURN)


@pytest.mark.long("machine")
def test_a_scan_keeps_what_it_showed() -> None:
    attempt = Attempt(attempt=LARGE).go(48.0).wait(120.0)
    inside = attempt.happens.scanned()
    document = json.loads(json.dumps({"inside": inside.document(), "number": 1}))
    marks = marks_of_complications(
        [*attempt.events, Event(attempt.now, "scan", "", document)], PLACED, attempt.now
    )
    shift = PLACED.T_world_patient.rotate(1e-3 * inside.displacement_mm)
    np.testing.assert_allclose(marks.fallen(attempt.now + 1.0), shift)


def test_the_needle_is_judged_by_where_the_target_lay_or_where_the_scan_showed_it() -> None:
    shift = (0.0, 0.004, -0.003)
    marks = marks_of_complications(Attempt().events, PLACED, 10.0)
    fallen = ProcedureMarks(complications=replace(marks, shown=((5.0, shift),)))
    n = 4
    for tip, error in (
        (PLACED.p_target, 0.0),
        (PLACED.p_target + shift, 0.0),
        (PLACED.p_target + np.multiply(0.8, shift), 0.001),
    ):
        path = Trajectory(
            placed=PLACED,
            time=np.arange(n, dtype=float) + 4.0,
            tip=np.tile(tip, (n, 1)),
            axis=np.tile(PLACED.axis, (n, 1)),
            depth=np.full(n, 0.05),
            felt=None,
            phase=np.full(n, 2),
            depth_valid=np.ones(n, bool),
            procedure=fallen,
        )
        assert path.offset(n - 1).distance == pytest.approx(error, abs=1e-12)
        before = float(np.linalg.norm(tip - PLACED.p_target))
        assert path.offset(0).distance == pytest.approx(before, abs=1e-12)  # no scan showed it yet


def test_damaged_events_are_left_out() -> None:
    broken = [
        Event(1.0, KIND, "", {}),
        Event(2.0, KIND, "", {"step": "onset", "kind": "plague"}),
        Event(3.0, KIND, "", {"step": "stage", "row": 7}),
        Event(4.0, KIND, "", {"step": "answer", "answer": "drain"}),
        Event(5.0, "scan", "", {"inside": {"share": "x"}}),
    ]
    marks = marks_of_complications(broken, PLACED, 9.0)
    assert (marks.begun, marks.demands, marks.given, marks.shown) == ((), (), (), ())
    assert marks_of_complications([Event(5.0, "scan", "", {})], PLACED, 9.0) is None


def test_lungs_lie_as_the_patient_does() -> None:
    left_down, right_down = PatientOrientation.LEFT_DOWN, PatientOrientation.RIGHT_DOWN
    assert lying_of(PatientOrientation.PRONE, True) is Lying.PRONE
    assert lying_of(left_down, True) is lying_of(right_down, False) is Lying.DOWN
    assert lying_of(left_down, False) is lying_of(right_down, True) is Lying.UP


def watched(field=FIELD, depths=(-5.0, 48.0)) -> LungWatch:
    watch, way = LungWatch(field, TARGET), (TARGET - ENTRY) / np.linalg.norm(TARGET - ENTRY)
    last = depths[0]
    for depth in depths:
        for at in np.arange(last, depth, 0.3 if depth > last else -0.3):
            watch.look(ENTRY + at * way, float(at))
        last = depth
    return watch


def test_punctures_and_the_aerated_way_are_counted_as_they_are_done() -> None:
    once = watched()
    assert once.punctures == 1
    assert once.aerated_mm == pytest.approx(45.0 - 16.1, abs=1.0)  # pleura to the nodule's edge
    assert watched(depths=(-5.0, 30.0, 26.0, 40.0)).punctures == 1  # not drawn out of the lung
    assert watched(depths=(-5.0, 30.0, 8.0, 30.0)).punctures == 2
    assert watched(depths=(-5.0, 30.0, -5.0, 30.0)).punctures == 2


def test_a_tip_that_breathes_at_the_pleura_punctures_it_once() -> None:
    depths = [-5.0, *(16.1 + 0.8 * np.sin(np.arange(40)))]
    assert watched(depths=tuple(depths)).punctures == 1


def test_fissures_and_bullae_are_counted_where_somebody_labelled_them() -> None:
    assert not watched().knows_lobes
    upper = (TissueKind.LUNG, "right lower lobe", lambda p: np.maximum(
        ball((-60.0, 0.0, 0.0), 45.0)(p), -25.0 - p[:, 1]))  # fmt: skip
    bulla = (TissueKind.AIR, "bulla", ball((-60.0, -35.0, 0.0), 4.0))
    left = (TissueKind.LUNG, "left lung", ball((60.0, 0.0, 0.0), 45.0))
    parted = chest((left, upper, bulla))
    watch = watched(parted)
    assert watch.knows_lobes
    assert watch.knows_bullae
    assert (watch.punctures, watch.fissures, watch.bullae) == (1, 1, 1)


def test_a_lesion_is_measured_and_its_contact_to_the_pleura_seen() -> None:
    facts = lesion_facts(FIELD, TARGET)
    assert facts.diameter_mm == pytest.approx(2.0 * (9.0 * 5.0 * 5.0) ** (1.0 / 3.0), rel=0.1)
    assert not facts.touches
    near = (TissueKind.ORGAN, "mass", ball((-60.0, -42.0, 0.0), 8.0))
    assert lesion_facts(chest((near,)), (-60.0, -42.0, 0.0)).touches


@pytest.mark.long("machine")
@pytest.mark.parametrize(("skill", "right"), [("expert", True), ("novice", False)])
def test_an_expert_answers_soon_and_rightly_and_a_novice_late(skill: str, right: bool) -> None:
    attempt = Attempt(case(bleeding=False), LARGE)
    answers = ScriptedAnswers.of(skill)
    attempt.go(48.0)
    for _ in range(300):
        attempt.wait(1.0)
        if answers.wants_scan(True, attempt.now):
            answers.see(ScanReading(attempt.happens.rim_mm), attempt.now)
        if answers.notices(attempt.happens.state.vitals, attempt.now):
            attempt.events.append(attempt._event(attempt.happens.notice()))
        answer = answers.look(attempt.happens.state.vitals, attempt.now)
        if answer is not None:
            attempt.do(answer)
    marks, manner = attempt.marks(), MANNERS[skill]
    if right:  # who hears the cough; no scan shows anything yet
        assert marks.waits()[0] == pytest.approx(manner.delay, abs=2.1)
    else:
        assert marks.waits()[0] > manner.delay
    assert all(value == 1.0 for value in marks.worth()) is right
    assert ScriptedAnswers.of("") is None


def test_what_no_scan_shows_is_not_answered_whatever_is_so() -> None:
    attempt, answers = Attempt(case(bleeding=False), LARGE), ScriptedAnswers.of("expert")
    attempt.go(48.0).wait(20.0)
    while attempt.happens.rim_mm < 8.0:
        attempt.wait(1.0)
    assert attempt.happens.rows, "there is something to be answered"
    for _ in range(30):
        answers.see(ScanReading(), attempt.now)
        assert answers.look(Vitals(), attempt.now) is None


def test_a_worse_skill_misses_thinner_rims_and_overlooks_more() -> None:
    order = [MANNERS[skill] for skill in ("expert", "proficient", "competent", "beginner")]
    for better, worse in pairwise([*order, MANNERS["novice"]]):
        assert (better.least_mm, better.overlooks) < (worse.least_mm, worse.overlooks)
    for skill, seen in (("expert", 1), ("novice", 0)):
        answers = ScriptedAnswers.of(skill)
        for _ in range(6):
            answers.see(ScanReading(rim_mm=7.0), 0.0)
        assert len(answers.rows(Vitals())) == seen


@pytest.mark.long("machine")
def test_a_scan_of_a_record_is_read_with_what_it_showed() -> None:
    attempt = Attempt(attempt=LARGE).go(48.0).wait(120.0)
    data = {
        "number": 1, "order": {"centre_mm": 0.0, "slices": 3, "slice_mm": 5.0}, "streak": False,
        "dose_mgy_cm": 1.0, "hub_lps_mm": [0, -200, 0], "tip_lps_mm": [0, 0, 0],
        "shift_lps_mm": [0, 0, 2.0],
    }  # fmt: skip
    plain = ControlScan.of(Event(1.0, "scan", "", data))
    assert plain.inside is None
    assert "inside" not in plain.data()
    assert plain.tissue_range_mm == (-9.5, 5.5)
    shown = data | {"inside": attempt.happens.scanned().document()}
    scan = ControlScan.of(Event(1.0, "scan", "", shown))
    assert scan.data()["inside"] == json.loads(json.dumps(shown["inside"]))
    assert Kind.PNEUMOTHORAX in {row.kind for row in attempt.happens.rows}


@pytest.fixture
def bench(tmp_path, monkeypatch):
    """A trainer in virtual time whose patient has the chest's lung on his plan."""
    bench, part = Bench(tmp_path), ProcedurePart(complications=ComplicationsPart(bleeding=False))
    placed = bench.trainer._placed
    shifted = FIELD.affine_mm.copy()
    shifted[:3, 3] += placed.plan.target_mm - TARGET
    field = replace(FIELD, affine_mm=shifted)
    bench.trainer._exercise = SimpleNamespace(
        **vars(EXERCISE) | {"procedure": part, "purpose": Purpose.PRACTICE}
    )
    bench.trainer._case = replace(
        case(bleeding=False),
        placed=placed,
        field=field,
        bound=BoundField(field, placed.T_world_patient, placed.p_target),
        shape=lung_shape(field, placed.plan.target_mm, DOWN),
    )
    monkeypatch.setattr(trainer, "attempt_seed", lambda *_: LARGE)
    yield bench
    bench.trainer.close()


@pytest.mark.long("machine")
def test_an_attempt_runs_shows_records_and_scores_what_happens(bench) -> None:
    running = bench.trainer
    bench.run(0.2)
    running.begin("s")
    bench.insertion(0.055)
    for _ in range(5):
        bench.run(20.0)
    assert running.snapshot().complications.vitals.saturation < 97
    running.scan(ScanOrder(310.2))
    running.notice()
    running.answer(Reaction.GO_ON)
    running.answer(Reaction.DRAIN)
    told = [e for e in running.events.drain() if e.kind == KIND]
    assert [e.data["step"] for e in told] == ["notice", "answer", "answer"]  # onset is not told
    result = running.end()
    marks = result.trajectory.complications()
    assert marks.begun[0][0] is Kind.PNEUMOTHORAX
    assert marks.fallen(marks.until) is not None
    assert 0.0 < marks.waits()[0] < 600.0
    recording = read_recording(result.record)
    assert recording.trajectory().complications() == marks  # from the record alone
    (scan,) = scans_of(recording.events)
    assert scan.inside.share > 0.1
    begun = next(e.data for e in recording.events if e.kind == KIND)
    assert Lots.read(begun["lots"]) == Lots.of(5, LARGE)


def test_outside_an_attempt_nothing_can_be_answered(bench) -> None:
    with pytest.raises(ProcedureNotPossibleError, match="begin an attempt"):
        bench.trainer.answer(Reaction.STOP)


@pytest.mark.long("machine")
def test_an_attempt_that_does_not_ask_has_no_trace_of_complications(tmp_path) -> None:
    plain = Bench(tmp_path)
    plain.run(0.2)
    plain.trainer.begin("s")
    plain.insertion(0.04)
    plain.trainer.scan(ScanOrder(310.2))
    assert plain.trainer.snapshot().complications is None
    with pytest.raises(ProcedureNotPossibleError):
        plain.trainer.notice()
    result = plain.trainer.end()
    events = read_recording(result.record).events
    assert not [e for e in events if e.kind == KIND]
    assert not [e for e in events if e.kind == "scan" and "inside" in e.data]
    plain.trainer.close()
