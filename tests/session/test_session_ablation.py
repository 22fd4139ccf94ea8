"""Electrodes left in place one after another, and what the generator ablates by them."""

import json

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.spatial import cKDTree

from app.core.errors import ConfigurationError
from app.core.events import Event
from app.exercises.ablation import ElectrodePart, check_electrodes, electrode_plans
from app.exercises.errors import ExerciseError
from app.exercises.library import load_exercise, read_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.imaging.field.walking import directions
from app.planning.ablation.judging import Lesion, judge
from app.planning.ablation.zone import Zone
from app.session.ablation_shown import AblationShown
from app.session.errors import ProcedureNotPossibleError
from app.session.procedure import KIND, ProcedureState, Step, begin_data, perform
from app.session.procedure_marks import marks_of
from app.session.samples import SampleHistory
from tests.ablation_rig import begin, liver, needle, part, placed

NOTHING = SampleHistory().arrays()


def do(state, step, look, row=0):
    return perform(state, step, look, placed(), state.ablation.lesion.field, row)


def placed_three(state, off=(0.0, 0.0, 0.0)):
    """Place all electrodes; returns the state and the events' data."""
    data = []
    for plan in state.ablation.plans:
        state, _, more = do(state, Step.PLACE_ELECTRODE, needle(plan, off))
        data.append(more)
    return state, data


@pytest.mark.long("machine")
def test_the_aim_goes_from_electrode_to_electrode_and_the_generator_comes_last():
    state = begin(liver())
    assert state.possible == (Step.PLACE_ELECTRODE,)
    for number, plan in enumerate(state.ablation.plans, start=1):
        assert state.ablation.number == number
        assert state.ablation.aim is plan
        with pytest.raises(ProcedureNotPossibleError, match=f"{number - 1} of 3 electrodes"):
            do(state, Step.ABLATE, needle(plan))
        state, words, data = do(state, Step.PLACE_ELECTRODE, needle(plan))
        assert str(words) == f"electrode {number} of 3 left in place"
        assert data["off_mm"] == pytest.approx(0.0, abs=1e-6)
    assert state.possible == (Step.ABLATE,)
    state, _, data = do(state, Step.ABLATE, needle(plan), state.ablation.planned_row)
    assert data["power_w"] == 40.0
    assert data["ex_vivo"] is False
    assert state.possible == ()
    with pytest.raises(ProcedureNotPossibleError, match="was ablated already"):
        do(state, Step.PLACE_ELECTRODE, needle(plan))


@pytest.mark.long("machine")
def test_electrodes_where_they_were_planned_reach_the_planned_margin():
    state = begin(liver())
    planned = state.ablation.planned
    # By hand: spheroids of 47 × 33 mm reach 8 mm ahead of tips 15 mm behind the lesion's middle.
    assert 5.0 < planned.least_mm < 9.0
    assert planned.share == pytest.approx(1.0, abs=1e-3)
    state, _ = placed_three(state)
    state, _, data = do(state, Step.ABLATE, needle(placed()), state.ablation.planned_row)
    assert data["reached"]["least_margin_mm"] == pytest.approx(planned.least_mm, abs=0.02)
    assert data["spacing_error_mm"] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.long("machine")
def test_electrodes_beside_their_places_reach_less_and_the_error_of_spacing_is_told():
    state = begin(liver())
    planned = state.ablation.planned.least_mm
    offs = ((0.004, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.006))
    for plan, off in zip(state.ablation.plans, offs, strict=True):
        state, _, _ = do(state, Step.PLACE_ELECTRODE, needle(plan, off))
    state, _, data = do(state, Step.ABLATE, needle(placed()), state.ablation.planned_row)
    assert data["reached"]["least_margin_mm"] < planned - 1.0
    tips = np.array([one.tip_mm for one in state.ablation.electrodes])
    targets = np.array([plan.plan.target_mm for plan in state.ablation.plans])
    apart = [
        abs(np.linalg.norm(tips[k] - tips[n]) - np.linalg.norm(targets[k] - targets[n]))
        for k, n in ((0, 1), (0, 2), (1, 2))
    ]
    assert data["spacing_error_mm"] == pytest.approx(max(apart))


@pytest.mark.long("machine")
def test_less_power_ablates_less_and_a_row_that_is_none_is_refused():
    state, _ = placed_three(begin(liver()))
    with pytest.raises(ProcedureNotPossibleError, match="there are 0 to 15"):
        do(state, Step.ABLATE, needle(placed()), 16)
    weak, _, data = do(state, Step.ABLATE, needle(placed()), 0)
    assert data["reached"]["share"] < 1.0
    assert data["reached"]["least_margin_mm"] < 0.0
    assert weak.ablation.reached.least_mm < 0.0


@pytest.mark.long("machine")
def test_two_electrodes_at_one_place_are_refused_in_one_line():
    state = begin(liver())
    first = state.ablation.plans[0]
    state, _, _ = do(state, Step.PLACE_ELECTRODE, needle(first))
    with pytest.raises(ProcedureNotPossibleError, match=r"electrode 1 is 0\.0 mm from here") as one:
        do(state, Step.PLACE_ELECTRODE, needle(first, target=state.ablation.aim.p_target))
    assert "\n" not in str(one.value)
    with pytest.raises(ValidationError, match=r"electrodes 2 and 3 are at one place, 1\.0 mm"):
        part(electrodes=({"target_mm": (7.0, 15.0, 0.0)}, {"target_mm": (7.0, 15.0, 1.0)}))
    same = part(electrodes=({"target_mm": (7.5, 15.0, 0.0)},)).ablation
    with pytest.raises(ExerciseError, match=r"electrodes 1 and 2 are at one place, 0\.5 mm"):
        electrode_plans(same, placed())


def test_a_power_that_the_generator_does_not_have_is_refused_by_the_exercise():
    with pytest.raises(ValidationError, match="45 W for 20 min is not in the generator's table"):
        part(power_w=45.0)
    with pytest.raises(ValidationError, match="no generator's table is called 'nobodys'"):
        part(generator="nobodys")


@pytest.mark.long("machine")
def test_an_electrode_is_left_only_in_the_body_and_where_the_cameras_see_it():
    state = begin(liver())
    plan = state.ablation.plans[0]
    with pytest.raises(ProcedureNotPossibleError, match="outside the skin"):
        do(state, Step.PLACE_ELECTRODE, needle(plan, depth=-0.002))
    with pytest.raises(ProcedureNotPossibleError, match="not measured"):
        perform(state, Step.PLACE_ELECTRODE, None, placed(), state.ablation.lesion.field)


@pytest.mark.long("machine")
def test_an_electrode_in_breathing_tissue_is_kept_where_that_rests():
    field = liver()
    state = begin(field)
    plan, shift = state.ablation.plans[0], np.array([0.0, 0.008, 0.0])
    look = needle(plan, shift)
    look = type(look)(look.p_tip, look.tip_axis, look.depth, plan.p_target + shift, True)
    _, _, data = do(state, Step.PLACE_ELECTRODE, look)
    assert data["off_mm"] < 1.5  # the field carries it back with its target


@pytest.mark.long("machine")
def test_no_margin_is_asked_for_beyond_the_capsule_and_vessels_and_gut_are_named():
    # 13 mm to the capsule: the lesion's surface has 2 mm of liver there.
    inner = judge(Lesion.at(liver(), (0.0, 0.0, 0.0)), [Zone(np.zeros(3), [0, 1, 0], 14.0, 14.0)])
    assert inner.least_mm == pytest.approx(3.0, abs=0.15)
    moved = [Zone(np.array([-4.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), 17.5, 17.5)]
    free = judge(Lesion.at(liver(), (0.0, 0.0, 0.0)), moved)
    # The nearest that is left lies to the left, at 13.5 mm: beyond a capsule at 13.3 mm nothing is,
    # and what is left beside it is where the capsule leaves the zone.
    within = judge(Lesion.at(liver(capsule_mm=13.3), (0.0, 0.0, 0.0)), moved)
    lies = np.hypot(13.3, np.sqrt(17.5**2 - 17.3**2)) - 11.0
    assert within.least_mm == pytest.approx(lies, abs=0.15)
    assert free.least_mm == pytest.approx(17.5 - 4.0 - 11.0, abs=0.15)
    deep = judge(Lesion.at(liver(capsule_mm=12.3), (0.0, 0.0, 0.0)), moved)
    lies = np.hypot(12.3, np.sqrt(17.5**2 - 16.3**2)) - 11.0
    assert deep.least_mm == pytest.approx(lies, abs=0.2)
    assert deep.least_mm > free.least_mm + 0.3
    near = judge(Lesion.at(liver(vessel_mm=25.5), (0.0, 0.0, 0.0)), moved)
    assert [one.name for one in near.vessels] == ["hepatic vein"]
    assert near.vessels[0].distance_mm == pytest.approx(25.5 - 3.0 - 21.5, abs=0.8)
    far = judge(Lesion.at(liver(vessel_mm=30.5), (0.0, 0.0, 0.0)), moved)
    assert far.vessels == ()
    burnt = judge(Lesion.at(liver(gut_mm=14.3), (0.0, 0.0, 0.0)), moved)
    assert [one.name for one in burnt.reached] == ["colon"]
    cap = np.pi * 3.2**2 * (3.0 * 17.5 - 3.2) / 3.0
    assert burnt.reached[0].volume_mm3 == pytest.approx(cap, rel=0.15)


def test_the_share_of_a_lesion_in_a_field_is_that_of_its_ball():
    lesion = Lesion.at(liver(), (0.0, 0.0, 0.0))
    ball = 4.0 / 3.0 * np.pi * 11.0**3
    assert lesion.volume_mm3 == pytest.approx(ball, rel=8e-3)
    away, _ = cKDTree(lesion.surface_mm).query(11.0 * directions(4000))
    assert away.max() < 1.0  # its surface has no hole
    assert np.linalg.norm(lesion.surface_mm, axis=1) == pytest.approx(11.0, abs=0.06)
    half = judge(lesion, [Zone(np.array([0.0, 0.0, -30.0]), np.array([0, 0, 1.0]), 30.0, 30.0)])
    d, a, b = 30.0, 30.0, 11.0
    lens = np.pi * (a + b - d) ** 2 * (d * d + 2 * d * (a + b) - 3 * (a - b) ** 2) / (12.0 * d)
    assert half.share == pytest.approx(lens / ball, abs=8e-3)


@pytest.mark.long("machine")
def test_what_scoring_reads_of_a_record_is_what_the_attempt_had():
    state = begin(liver(vessel_mm=18.0))
    events = [Event(0.0, KIND, state.words, begin_data(state))]
    for k, plan in enumerate(state.ablation.plans, start=1):
        state, words, data = do(state, Step.PLACE_ELECTRODE, needle(plan, (0.002, 0.0, 0.0)))
        events.append(Event(float(k), KIND, words, data))
    state, words, data = do(state, Step.ABLATE, needle(placed()), state.ablation.planned_row)
    events.append(Event(9.0, KIND, words, data))
    read = [
        Event(one.time, one.kind, str(one.message), json.loads(json.dumps(dict(one.data))))
        for one in events
    ]
    mark = marks_of(read, NOTHING, ()).ablated()
    reached = state.ablation.reached
    assert mark.least_margin_mm == pytest.approx(reached.least_mm, abs=1e-3)
    assert mark.share == pytest.approx(reached.share, abs=1e-5)
    assert mark.vessels == ("hepatic vein",)
    shown, live = AblationShown.of_events(read), AblationShown.of_state(state.ablation)
    assert shown.newest.least_mm == pytest.approx(live.newest.least_mm, abs=1e-3)
    assert np.abs(shown.shafts_mm - live.shafts_mm).max() < 1e-6
    assert shown.off_mm == pytest.approx(live.off_mm)
    assert len(shown.planned.at_mm) == len(shown.reached.margin_mm)


def test_a_damaged_event_shows_and_scores_nothing():
    event = Event(1.0, KIND, "", {"step": "ablate", "reached": {"share": "much"}})
    assert AblationShown.of_events([event]) is None
    marks = marks_of([event], NOTHING, ())
    assert marks.ablation is None


def test_an_exercise_judges_an_ablation_only_where_it_asks_for_one(tmp_path):
    text = (
        "id: mine\ntitle: Mine\ntissue: field\ntolerances:\n"
        "  least_margin: {expert: 6, good: 5, pass: 3, zero: 0}\n"
    )
    path = tmp_path / "mine.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigurationError, match="add ablation to procedure"):
        read_exercise(path)
    with pytest.raises(ValidationError, match="samples and ablation are two exercises"):
        type(part())(biopsy={}, ablation=part().ablation)


def test_the_shipped_exercise_can_be_reached_and_plans_what_it_wants():
    exercise = load_exercise("liver-ablation")
    profile = device_of(exercise)
    plan = placed_plan_of(exercise, profile)
    check_electrodes(exercise.procedure.ablation, plan, profile)
    asked = exercise.procedure.ablation
    out_of_reach = (ElectrodePart(target_mm=(200.0, 0.0, 176.0)),)
    far = asked.model_copy(update={"electrodes": out_of_reach})
    with pytest.raises(ExerciseError, match="electrode 2 cannot be placed with icube"):
        check_electrodes(far, plan, profile)


def test_exercises_without_electrodes_have_no_state_of_them():
    asked = load_exercise("lung-biopsy").procedure
    state = ProcedureState.at_begin(asked)
    assert state.ablation is None
    assert "this exercise ablates nothing" in str(state.refusal(Step.ABLATE))
