"""An exercise whose tissue is looked up in the patient: felt, recorded, replayed without CT."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest

from app.compose.cameras import AttachedCameras
from app.compose.exercise_ct import load_field, read_ct
from app.compose.exercise_field import FIELD, resolve_tissue
from app.compose.explaining import quick_explanation
from app.compose.loop_truth import disagreements, met_in_loop
from app.compose.recomputed import replay_recording
from app.compose.trainer import TrainerSetup, _context, build_loop
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.errors import ExerciseError
from app.exercises.library import library, load_exercise
from app.exercises.parts import TissueSource
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.schema import Exercise
from app.exercises.tissue_choice import Needles, choose
from app.imaging.field import TissueField
from app.imaging.volume import Volume
from app.planning.plan import Plan
from app.session.ct_facts import CtFacts
from app.session.errors import ReplayError
from app.session.header import TISSUE_FILE
from app.session.recording import Recording, read_recording
from app.session.trainer import Trainer
from app.session.verify import verify
from app.simulation.consumers import DevicePort
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.rig import load_rig

EFFECTS = (
    *("lateral_tissue", "puncture", "cutting", "relaxation", "shaft_friction"),
    *("bone_contact", "breathing"),
)


def exercise(**changes: Any) -> Exercise:
    """Return the exercise in which the student plans, with its tissue in the patient."""
    document = load_exercise("plan-it-yourself").model_dump(mode="json", by_alias=True)
    document["without"] = {}
    effects = {name: {} for name in EFFECTS}
    return Exercise.model_validate(document | {"tissue": "field", "effects": effects} | changes)


@pytest.fixture(scope="module")
def patient() -> Volume:
    return read_ct(exercise())


def lesion() -> np.ndarray:
    from app.imaging.phantom.anatomy import anatomy

    return np.array(anatomy(6).lesion_mm)


def field_for(volume: Volume, plan: Plan) -> TissueField:
    made = load_field(exercise(), volume, plan)
    assert made is not None
    return made


@pytest.fixture(scope="module")
def field(patient: Volume) -> TissueField:
    from app.imaging.phantom.anatomy import anatomy

    return field_for(patient, Plan(anatomy(6).entry_mm, lesion()))  # type: ignore[arg-type]


def through_rib(field: TissueField) -> Plan:
    """Plan to the lesion with 6 mm of rib or more on the way, 5 to 40 mm below the skin."""
    from app.imaging.field.walking import walk
    from app.imaging.phantom.anatomy import anatomy

    target, entry = lesion(), np.array(anatomy(6).entry_mm)
    rng = np.random.default_rng(1)
    for _ in range(3000):
        moved = entry + rng.normal(0.0, 30.0, 3)
        way = (target - moved) / np.linalg.norm(target - moved)
        parts = walk(field, [moved - 60.0 * way, target], 0.5)
        solid = [p for p in parts if field.tissues[p.code].kind not in ("air", "unknown")]
        if not solid or field.tissues[solid[0].code].kind != "skin":
            continue
        skin = solid[0].begin_mm
        ribs = [p for p in solid if field.tissues[p.code].name == "rib"]
        tilt = np.degrees(np.arccos(way @ [0.0, 1.0, 0.0]))
        if (
            ribs
            and ribs[0].length_mm > 6.0
            and 5.0 < ribs[0].begin_mm - skin < 40.0
            and tilt < 37.0
        ):
            return Plan(moved + (skin - 60.0) * way, target, "through a rib")
    raise AssertionError("no such path")


def attempt(
    folder: Path,
    chosen: Exercise,
    plan: Plan,
    field: TissueField | None,
    seconds: float,
    skill: str | None = "expert",
    hand: Callable[[Trainer, int], None] = lambda trainer, k: None,
) -> tuple[Recording, np.ndarray]:
    """An attempt in virtual time; its record, and the states of the loop every 20 ms."""
    profile, clock = device_of(chosen), VirtualClock(100.0)
    placed = placed_plan_of(chosen, profile, plan)
    setup = TrainerSetup(chosen, placed, CtFacts("ct-1"), skill, 3, folder, clock, tissues=field)
    loop = build_loop(setup, profile)

    def measure(now: float) -> None:
        state = loop.latest()
        tip = profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))

    context = _context(setup, profile, AttachedCameras((), load_rig(chosen.rig), {}), None)
    trainer = Trainer(loop, None, placed, chosen, context, clock, measure, dial=0.7, tissues=field)
    loop.open()
    trainer.heartbeat()
    trainer.step(300)
    trainer.begin("tester")
    rows = []
    for k in range(round(seconds / 0.02)):
        hand(trainer, k)
        trainer.step()
        rows.append(loop.latest().row.copy())
    result = trainer.end()
    trainer.close()
    loop.close()
    assert result.record is not None
    assert result.trajectory is not None
    assert read_recording(result.record).trajectory().met == result.trajectory.met
    return read_recording(result.record), np.array(rows)


@pytest.fixture(scope="module")
def stopped(field: TissueField, tmp_path_factory: pytest.TempPathFactory) -> Any:
    plan = through_rib(field)
    chosen = exercise()
    return (*attempt(tmp_path_factory.mktemp("rib"), chosen, plan, field, 30.0), plan, field)


@pytest.mark.long("machine")
def test_a_needle_on_a_path_through_a_rib_is_stopped_where_the_rib_begins(stopped: Any) -> None:
    _, rows, plan, own = stopped
    from app.imaging.field.walking import walk

    way = (plan.target_mm - plan.entry_mm) / np.linalg.norm(plan.target_mm - plan.entry_mm)
    parts = walk(own, [plan.entry_mm, plan.entry_mm + 80.0 * way], 0.2)
    rib = next(p for p in parts if own.tissues[p.code].name == "rib")
    assert rows[:, sv.BONE_CONTACT].max() == 1.0
    deepest = 1e3 * rows[:, sv.PLANT_DEPTH].max()
    assert deepest == pytest.approx(rib.begin_mm, abs=2.0), "no hand goes through a rib"
    assert rows[:, sv.BONE_CROSSED].max() < 1.5e-3, "30 N bend bone by a millimetre"
    assert 29.0 < rows[:, sv.AXIAL_FORCE].max() < 33.0, "all that the hand has"
    assert np.linalg.norm(plan.target_mm - plan.entry_mm) - deepest > 40.0
    assert rows[:, sv.PUNCTURES].max() >= 1.0
    assert np.isfinite(rows).all()


@pytest.mark.long("machine")
def test_the_rib_is_told_with_its_depth_and_its_force_and_fails_the_attempt(stopped: Any) -> None:
    recording, rows, plan, own = stopped
    from app.imaging.field.walking import walk

    way = (plan.target_mm - plan.entry_mm) / np.linalg.norm(plan.target_mm - plan.entry_mm)
    parts = walk(own, [plan.entry_mm, plan.entry_mm + 80.0 * way], 0.2)
    begins = next(p for p in parts if own.tissues[p.code].name == "rib").begin_mm
    ribs = [one for one in recording.trajectory().met if one.name == "rib" and one.by == "tip"]
    assert ribs
    assert ribs[0].entered_mm == pytest.approx(begins, abs=2.0)
    strongest = max(one.force_n for one in ribs)
    assert strongest == pytest.approx(rows[:, sv.AXIAL_FORCE].max(), abs=1.0)
    soft = [one.force_n for one in recording.trajectory().met if one.kind == "fat"]
    assert all(0.0 <= force < strongest for force in soft)
    score = verify(recording).standing
    assert score is not None
    assert not score.passed
    (fail,) = (text for text in score.hard_fails if text.startswith("rib touched at"))
    assert fail == ribs[0].sentence
    assert fail.endswith(" N")
    assert next(row.value for row in score.rows if row.name == "bone_force") == strongest


@pytest.mark.long("machine")
def test_the_loops_own_state_tells_the_same_and_finds_a_judge_that_is_wrong(stopped: Any) -> None:
    recording, rows, _, own = stopped
    placed, walked = recording.placed_plan(), recording.trajectory().met
    looped = met_in_loop(rows, own, placed)
    assert looped is not None
    assert [one.words for one in looped] == ["skin", "fat", "muscle", "rib"]
    by_walk = {one.words: one for one in walked if one.by == "tip"}
    for one in looped:
        assert one.entered_mm == pytest.approx(by_walk[one.words].entered_mm, abs=1.0)
        assert one.length_mm == pytest.approx(by_walk[one.words].length_mm, abs=1.5)
    assert disagreements(walked, looped) == ()
    blind = [one for one in walked if not one.is_bone]
    assert disagreements(blind, looped) == ("rib: the loop had it, the walk had not",)
    unfelt = [one for one in looped if one.words != "muscle"]
    assert disagreements(walked, unfelt) == ("muscle: the walk had it, the loop had not",)
    in_layers = rows.copy()
    in_layers[:, [sv.TISSUE, sv.BONE_CONTACT]] = 0.0
    assert met_in_loop(in_layers, own, placed) is None
    assert disagreements(walked, None) == ()


@pytest.mark.long("machine")
def test_a_replay_needs_no_ct_and_is_the_same_to_the_last_bit(stopped: Any) -> None:
    recording, _, _, own = stopped
    assert recording.metadata[FIELD] == {"digest": own.digest, "patient_data": "yes"}
    assert len(recording.attachments[TISSUE_FILE]) < 4_000_000
    report = replay_recording(recording)
    assert report.identical
    assert report.every_slot
    assert report.ticks > 29_000


@pytest.mark.long("machine")
def test_a_record_whose_field_is_missing_damaged_or_another_is_refused(stopped: Any) -> None:
    recording = stopped[0]
    files = dict(recording.attachments)
    content = bytearray(files[TISSUE_FILE])
    content[len(content) // 2] ^= 0xFF
    for spoilt, why in (
        ({k: v for k, v in files.items() if k != TISSUE_FILE}, "has no tissue-field.bin"),
        (files | {TISSUE_FILE: bytes(content)}, "damaged"),
    ):
        changed = replace(recording, attachments=MappingProxyType(spoilt))
        with pytest.raises(ReplayError, match=why):
            replay_recording(changed)
    other = dict(recording.metadata) | {FIELD: {"digest": "0" * 64, "patient_data": "yes"}}
    with pytest.raises(ReplayError, match="it was made with 000000000000"):
        replay_recording(replace(recording, metadata=MappingProxyType(other)))


def test_an_exercise_of_before_keeps_its_layers() -> None:
    assert {one.tissue for one in library()} == {TissueSource.LAYERS, TissueSource.FIELD}
    older = load_exercise("plan-it-yourself").model_dump(mode="json", by_alias=True)
    del older["tissue"]
    assert Exercise.model_validate(older).tissue is TissueSource.LAYERS


@pytest.mark.long("machine")
def test_an_exercise_without_the_field_that_it_asks_for_is_refused(field: TissueField) -> None:
    chosen = exercise()
    profile = device_of(chosen)
    placed = placed_plan_of(chosen, profile, Plan(lesion() - [0.0, 80.0, 0.0], lesion()))
    with pytest.raises(ExerciseError, match="its field has not been made"):
        build_loop(TrainerSetup(chosen, placed, clock=VirtualClock(1.0)), profile)


def test_the_author_is_told_what_is_simulated_in_a_field_before_it_is_made() -> None:
    why, wrong = quick_explanation(exercise())
    assert not wrong
    assert why["bone_contact"].startswith("✔")
    assert {"tissue_field", "bone_slide"} <= why.keys()


@pytest.mark.long("machine")
def test_what_needles_within_reach_meet_decides_between_layers_and_the_field(
    patient: Volume,
) -> None:
    from app.imaging.phantom.anatomy import anatomy

    chosen = exercise(tissue="auto")
    profile = device_of(chosen)
    plan = Plan(anatomy(6).entry_mm, lesion())  # type: ignore[arg-type]
    placed = placed_plan_of(chosen, profile, plan)
    made = field_for(patient, plan)
    decided, why = resolve_tissue(chosen, placed, made)
    assert decided.tissue is TissueSource.FIELD
    assert "the path does not" in why or "the path" in why
    same = np.ones_like(made.labels) * np.uint8(made.of_kind("organ")[0].code)  # type: ignore[arg-type]
    even = replace(made, labels=same, distance=np.full_like(made.distance, 127))
    choice = choose(chosen, Needles(even, placed, profile))
    assert choice.source is TissueSource.LAYERS
    assert "with the same force to 0.00 N" in choice.reason


def test_a_device_without_a_port_along_the_needle_is_never_shown_as_stopped() -> None:
    assert "axial" not in DevicePort("icube").renders
