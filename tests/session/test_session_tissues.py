"""What the needle met: from the samples into record, score and replay."""

import csv
import io
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from field_rig import ball, beyond, field_of_shapes
from session_fakes import Bench

from app.core.events import Event
from app.exchange.csv_export import trajectory_table
from app.imaging.field import TissueKind
from app.imaging.field.walking import Crossed, joined
from app.scoring.result import Score, judge
from app.scoring.rows import ScoreRules
from app.session.along_path import AlongPath
from app.session.planned import judged_plan
from app.session.reasons import AttemptEvidence, reasons
from app.session.recording import messages_agree, read_recording
from app.session.replay import contents
from app.session.tissue_force import feels_along
from app.session.tissues import GAP_MM, event_of, stretches, tissues_met, tissues_met_of
from app.session.verify import verify

ENTRY = np.array([-12.5, -98.0, 310.2])
"""Of the bench's plan, DICOM LPS [mm]; the path runs along +P."""

Kind = TissueKind


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    yield bench
    bench.trainer.close()


def body(*more):
    """Skin of 2 mm, fat of 10, muscle of 8, then liver, across the path; and what is laid over."""
    x, y, z = ENTRY
    shapes = [
        (Kind.AIR, "", lambda points: np.full(len(points), -50.0)),
        (Kind.SKIN, "", beyond((0, 1, 0), y)),
        (Kind.FAT, "", beyond((0, 1, 0), y + 2.0)),
        (Kind.MUSCLE, "", beyond((0, 1, 0), y + 12.0)),
        (Kind.ORGAN, "liver", beyond((0, 1, 0), y + 20.0)),
        *more,
    ]
    return field_of_shapes(shapes, (x - 30.0, y - 20.0, z - 30.0), (61, 110, 61))


def rib(depth, beside=0.0, radius=4.0):
    return (Kind.BONE, "rib", ball(ENTRY + [beside, depth, 0.0], radius))


def attempt(bench: Bench, field, depth: float = 0.04):
    bench.trainer._tissues = field
    bench.run(0.2)
    bench.trainer.begin("s")
    bench.insertion(depth)
    return bench.trainer.end()


@pytest.mark.long("machine")
def test_layer_after_layer_is_told_where_it_lies(bench: Bench) -> None:
    result = attempt(bench, body())
    met = result.trajectory.met
    assert [one.words for one in met] == ["skin", "fat", "muscle", "liver"]
    assert [one.entered_mm for one in met] == pytest.approx([0.0, 2.0, 12.0, 20.0], abs=0.15)
    assert [one.length_mm for one in met] == pytest.approx([2.0, 10.0, 8.0, 20.0], abs=0.6)
    assert met[3].holds_target
    assert met[3].angle_deg == pytest.approx(0.0, abs=2.0)
    values = {row.name: row.value for row in result.score.rows}
    assert (values["skin_passes"], values["capsule_passes"]) == (1.0, 1.0)
    assert (values["bone_contacts"], values["lung_crossed"]) == (0.0, 0.0)


@pytest.mark.long("machine")
def test_it_is_in_the_record_and_scored_from_it_again(bench: Bench) -> None:
    result = attempt(bench, body(rib(30.0)))
    recording = read_recording(result.record)
    assert tissues_met(recording.events) == result.trajectory.met
    assert recording.trajectory().met == result.trajectory.met
    assert verify(recording).confirmed
    listed = contents(recording)
    assert any("rib touched at 26.0" in line for line in listed.sentences())
    kinds = [row["kind"] for row in listed.document()["tissues_met"]]
    assert kinds == ["skin", "fat", "muscle", "organ", "bone", "organ"]


@pytest.mark.long("machine")
def test_a_rib_fails_where_it_is_forbidden_and_only_there(bench: Bench) -> None:
    score = attempt(bench, body(rib(30.0))).score
    assert score.hard_fails == ()
    rules = score.rules.model_copy(update={"forbidden": ("bone",), "pass_mark": 0.0})
    rows = tuple(row for row in score.rows if row.tolerance is None or not row.tolerance.required)
    judged = judge(rows, rules, "", score.met)
    (said,) = judged.hard_fails
    assert said.startswith("rib touched at 26.0")
    assert judged.total is not None
    assert not judged.passed
    assert judge(rows, rules.model_copy(update={"forbidden": ()}), "", score.met).passed
    again = Score.from_json(judged.to_json())
    assert again == judged
    assert again.recomputed(rules=rules).hard_fails == (said,)


@pytest.mark.long("machine")
def test_bone_that_stops_the_tip_at_its_surface_is_touched(bench: Bench) -> None:
    result = attempt(bench, body(rib(44.1)), depth=0.040)
    (bone,) = (one for one in result.trajectory.met if one.kind == "bone")
    assert bone.entered_mm == pytest.approx(40.0, abs=0.3)
    assert bone.length_mm < 0.3
    assert bone.is_forbidden(("bone",))


@pytest.mark.long("machine")
def test_the_largest_force_of_each_tissue_is_that_while_the_tip_was_in_it(bench: Bench) -> None:
    """A ramp of 0.1 N for each mm of depth, and 20 N while the tip stands at its end, on a rib."""
    attempt(bench, body(rib(44.1)))
    recording = read_recording(next(bench.folder.glob("*.mcap")))
    samples, placed, field = recording.samples, recording.placed_plan(), body(rib(44.1))
    assert {one.force_n for one in tissues_met_of(samples, placed, field, True)} == {0.0}
    deep = 1e3 * np.nan_to_num(samples.depth)
    along = np.where(deep > 39.9, 20.0, 0.1 * deep)
    pushed = replace(samples, along=along)
    forces = {one.words: one.force_n for one in tissues_met_of(pushed, placed, field, True)}
    assert forces["skin"] == pytest.approx(0.2, abs=0.06)
    assert forces["fat"] == pytest.approx(1.2, abs=0.06)
    assert forces["muscle"] == pytest.approx(2.0, abs=0.06)
    assert forces["rib"] == 20.0
    unfelt = tissues_met_of(pushed, placed, field)
    assert {one.force_n for one in unfelt} == {None}
    older = tissues_met_of(replace(samples, along=None), placed, field, True)
    assert {one.force_n for one in older} == {None}


@pytest.mark.long("machine")
def test_the_force_along_the_needle_stands_in_the_record_and_its_table(bench: Bench) -> None:
    attempt(bench, body())
    recording = read_recording(next(bench.folder.glob("*.mcap")))
    assert (recording.samples.along == 0.0).all()
    assert messages_agree(recording) == ""
    along = np.linspace(-1.0, 2.0, len(recording.samples.time))
    pushed = replace(recording, samples=replace(recording.samples, along=along))
    rows = list(csv.DictReader(io.StringIO(trajectory_table(pushed))))
    assert [float(row["tissue_along_n"]) for row in rows] == pytest.approx(along)
    older = replace(recording, samples=replace(recording.samples, along=None))
    rows = list(csv.DictReader(io.StringIO(trajectory_table(older))))
    assert {row["tissue_along_n"] for row in rows} == {""}


def test_who_felt_the_field_is_told_by_the_head_of_the_record() -> None:
    looked, simulated = {"tissue_field": {"digest": ""}}, {"device": {"simulated": "yes"}}
    assert feels_along(looked | simulated, {})
    assert not feels_along(simulated, {})
    for renders, felt in (('["lateral"]', False), ('["lateral", "axial"]', True)):
        device = f'{{"loop": {{"renders": {renders}}}}}'.encode()
        assert feels_along(looked, {"device.json": device}) is felt
    assert not feels_along(looked, {"device.json": b"[]"})
    assert not feels_along(looked, {})


@pytest.mark.long("machine")
def test_a_rib_beside_the_path_is_not_met(bench: Bench) -> None:
    result = attempt(bench, body(rib(30.0, beside=5.0)))
    assert "bone" not in [one.kind for one in result.trajectory.met]


@pytest.mark.long("machine")
def test_the_breath_that_moves_the_target_moves_no_rib(bench: Bench) -> None:
    """A control scan's whole picture moves with the target; the ribs of a patient do not."""
    field = body(rib(15.2, beside=-6.3, radius=3.2))
    attempt(bench, field)
    recording = read_recording(next(bench.folder.glob("*.mcap")))
    samples, placed = recording.samples, recording.placed_plan()
    met = tissues_met_of(samples, placed, field)
    assert [one.kind for one in met] == ["skin", "fat", "muscle", "organ"]
    breathed = replace(samples, target=samples.target + [0.006, 0.0, 0.0])
    moved = tissues_met_of(breathed, placed, field)
    assert [one.kind for one in moved] == ["skin", "fat", "muscle", "organ"]
    side = moved[-1].points[-1][0] - met[-1].points[-1][0]
    assert side == pytest.approx(-6.0, abs=0.1)  # the liver, which went along, is met elsewhere


@pytest.mark.long("machine")
def test_unknown_tissue_is_neither_met_nor_failed(bench: Bench) -> None:
    field = body()
    hole = np.array(field.labels)
    hole[:, 45:55] = 0
    result = attempt(bench, replace(field, labels=hole))
    assert "unknown" not in [one.kind for one in result.trajectory.met]
    assert result.score.hard_fails == ()


@pytest.mark.long("machine")
def test_lung_is_crossed_twice_at_its_pleura_with_vessels_in_it(bench: Bench) -> None:
    lung = (Kind.LUNG, "", lambda points: np.abs(points[:, 1] - ENTRY[1] - 27.0) - 5.0)
    vessel = (Kind.VESSEL, "lung vessel", ball(ENTRY + [0.0, 27.0, 0.0], 2.0))
    result = attempt(bench, body(lung, vessel))
    values = {row.name: row.value for row in result.score.rows}
    assert values["pleural_crossings"] == 2.0
    assert values["pleural_angle"] == pytest.approx(0.0, abs=3.0)
    assert values["lung_crossed"] == pytest.approx(10.0, abs=0.3)
    assert values["vessels_touched"] == 0.0


@pytest.mark.long("machine")
def test_a_nodule_that_the_needle_goes_through_is_no_aerated_lung(bench: Bench) -> None:
    lung = (Kind.LUNG, "", lambda points: np.abs(points[:, 1] - ENTRY[1] - 55.0) - 25.0)
    nodule = (Kind.ORGAN, "nodule", ball(ENTRY + [0.0, 60.0, 0.0], 3.0))  # holds the target
    result = attempt(bench, body(lung, nodule), depth=0.070)
    values = {row.name: row.value for row in result.score.rows}
    assert values["lung_crossed"] == pytest.approx(40.0 - 6.0, abs=0.5)
    lengths = {one.words: one.length_mm for one in result.trajectory.met}
    assert lengths["nodule"] == pytest.approx(6.0, abs=0.5)


def test_without_a_field_nothing_is_told_and_nothing_asked(bench: Bench) -> None:
    result = attempt(bench, None)
    assert result.trajectory.met is None
    assert result.score.met is None
    assert "bone_contacts" not in [row.name for row in result.score.rows]
    assert tissues_met(()) is None


@pytest.mark.long("machine")
def test_damaged_events_are_left_out(bench: Bench) -> None:
    met = attempt(bench, body()).trajectory.met[0]
    event = event_of(met)
    assert tissues_met([event]) == (met,)
    broken = [
        Event(1.0, event.kind, "", {**event.data, **change})
        for change in (
            {"length_mm": -1.0},
            {"kind": "granite"},
            {"points": [[0, 0, 0]]},
            {"entered_mm": "deep"},
        )
    ]
    assert tissues_met(broken) == ()


def test_rules_refuse_a_tissue_that_there_is_none_of() -> None:
    with pytest.raises(ValueError, match="no tissue is called 'granite'"):
        ScoreRules(forbidden=("granite",))
    with pytest.raises(ValueError, match="forbidden twice"):
        ScoreRules(forbidden=("bone", "bone"))


@pytest.mark.long("machine")
def test_a_plan_of_the_students_own_is_judged_and_scored_from_the_record_again(
    bench: Bench,
) -> None:
    bench.trainer._exercise.is_own_plan = True
    result = attempt(bench, body(rib(20.0, 8.0), (Kind.LUNG, "", beyond((0, 1, 0), 70.0))))
    recording = read_recording(result.record)
    planned = judged_plan(recording.events)
    assert planned == result.trajectory.planned == recording.trajectory().planned
    assert planned.length_mm == pytest.approx(60.0)
    assert planned.angle_deg == pytest.approx(0.0, abs=1.5)
    assert planned.clear_mm == pytest.approx(4.0, abs=0.6)
    values = {row.name: row.value for row in result.score.rows}
    assert values["plan_score"] == planned.points
    assert values["plan_clearance"] == planned.clear_mm
    assert verify(recording).confirmed
    past = AttemptEvidence(
        AlongPath.of(recording.samples, recording.placed_plan()), planned=planned
    )
    assert reasons("plan_score", past)[0] == "The path comes within 4.0 mm of rib, 20 mm deep."


@pytest.mark.long("machine")
def test_the_path_report_of_a_lung_biopsy_is_scored_from_the_record_alone(bench: Bench) -> None:
    bench.trainer._exercise.is_own_plan = True
    field = body(rib(14.0, 0.0), (Kind.LUNG, "lung", beyond((0, 1, 0), ENTRY[1] + 20.0)))
    plain = attempt(bench, field)
    (kept,) = [event for event in plain.events if event.kind == "plan"]
    assert "lung" not in kept.data  # nobody asked
    assert "planned_lung" not in {row.name for row in plain.score.rows}
    bench.trainer._exercise.asks_lung_path = True
    result = attempt(bench, field)
    recording = read_recording(result.record)
    report = judged_plan(recording.events).lung
    assert report is not None
    assert report.lung_mm == pytest.approx(40.0, abs=0.2)
    values = {row.name: row.value for row in result.score.rows}
    assert values["planned_lung"] == report.lung_mm
    assert values["planned_rib_border"] == 0.0
    assert "planned_fissures" not in values or values["planned_fissures"] is None
    assert verify(recording).confirmed
    assert recording.trajectory().planned.lung == report


@pytest.mark.long("machine")
def test_lobes_one_after_the_other_are_one_way_through_the_lung(bench: Bench) -> None:
    y = ENTRY[1]
    bulla = ball(ENTRY + [0.0, 28.0, 0.0], 3.0)
    result = attempt(
        bench,
        body(
            (Kind.LUNG, "right upper lobe", beyond((0, 1, 0), y + 20.0)),
            (Kind.LUNG, "right lower lobe", beyond((0, 1, 0), y + 34.0)),
            (Kind.LUNG, "emphysema", bulla),
        ),
    )
    values = {row.name: row.value for row in result.score.rows}
    assert values["pleural_crossings"] == 1.0  # a fissure is none
    assert values["lung_crossed"] == pytest.approx(20.0, abs=0.7)


@pytest.mark.long("machine")
def test_a_plan_that_was_given_is_nobodys_to_be_judged(bench: Bench) -> None:
    result = attempt(bench, body(rib(20.0, 8.0)))
    assert result.trajectory.planned is None
    assert not {"plan_score", "plan_clearance"} & {row.name for row in result.score.rows}
    assert judged_plan(result.events) is None


@pytest.mark.long("machine")
@pytest.mark.parametrize("damage", [{"points": 1e9}, {"meets": 3}, {"clear_mm": "far"}])
def test_a_damaged_word_on_a_plan_is_none(bench: Bench, damage) -> None:
    bench.trainer._exercise.is_own_plan = True
    events = attempt(bench, body(rib(20.0, 8.0))).events
    (kept,) = [event for event in events if event.kind == "plan"]
    assert judged_plan([kept]) is not None
    assert judged_plan([replace(kept, data=dict(kept.data) | damage)]) is None


def test_bone_touched_before_the_tip_lay_in_it_is_met_apart_and_backwards_nothing_is() -> None:
    def part(code: int, begin: float, end: float) -> Crossed:
        places = np.array([0.0, begin, 0.0]), np.array([0.0, end, 0.0])
        return Crossed(code, begin, end, *places, 0.0)

    muscle, rib = 1, 2
    walked = [part(muscle, 0.0, 19.4), part(rib, 19.4, 21.0), part(muscle, 21.0, 30.0)]
    met = stretches([*walked, part(rib, 17.0, 17.0)], 3, rib, set())
    assert [(one.begin_mm, one.end_mm) for one in met] == [(19.4, 21.0), (17.0, 17.0)]
    later = [*walked, part(rib, 25.0, 25.0)]
    assert stretches(later, 3, rib, set()) == joined(later, {rib}, GAP_MM, set())
