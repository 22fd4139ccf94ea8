"""The next step, by what the program knows: a table, and a whole insertion."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

from app.core import state_vector as sv
from app.core.rotation import rotation_exp
from app.exercises.library import load_exercise
from app.exercises.procedure import AnaestheticPart, BiopsyPart, ProcedurePart
from app.exercises.scene import device_of, placed_plan_of
from app.planning.off_path import offset
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.plan import Plan
from app.session.machine import State
from app.session.procedure import ProcedureState, ToolInHand
from app.session.snapshot import NextSteps, StepKind
from app.session.touching import TouchState
from app.session.transitions import PauseCause

FULCRUM = (0.0, 0.16056, 0.090)
PLAN = Plan(np.array([-40.0, -120.0, 60.0]), np.array([-40.0, -40.0, 60.0]), "straight down")


def placed(orientation=PatientOrientation.SUPINE):
    return PlacedPlan.of(PLAN, Placement(orientation), FULCRUM)


@dataclass(frozen=True)
class Moment:
    """What the next step looks at of a snapshot."""

    state: State
    pose: SimpleNamespace
    offset: object
    touch: object = None
    procedure: object = None
    device: object = None
    pause: object = None
    ready: bool = False
    simulated: bool = False
    out_of_room: float | None = None


def moment(plan, depth, turn=None, state=State.INSERTING, measured=True, valid=True, p_target=None):
    """The needle at a depth [m], turned from the path by a vector in the patient [rad]."""
    axis = plan.axis
    if turn is not None:
        way = plan.T_world_patient.rotation @ np.asarray(turn)
        axis = plan.axis + way
        axis = axis / np.linalg.norm(axis)
    tip = plan.p_entry + depth * axis
    target = plan.p_target if p_target is None else p_target
    pose = SimpleNamespace(axis=axis, depth=depth, measured=measured, valid=valid, covariance=None)
    return Moment(state, pose, offset(tip, axis, plan, target))


def steps(plan):
    return NextSteps(plan, across=0.002, along=0.002)


@pytest.mark.parametrize(
    ("state", "kind"),
    [
        (State.READY, "start"),
        (State.ENDED, "start"),
        (State.ABORTED, "start"),
        (State.WITHDRAWING, "withdraw"),
        (State.PAUSED, "see"),
    ],
)
def test_states_that_leave_one_thing_to_do(state, kind):
    plan = placed()
    assert steps(plan).of(moment(plan, 0.03, state=state)).kind.value == kind


@pytest.mark.parametrize(
    ("depth", "turn", "kind"),
    [
        (-0.01, None, "insert"),
        (0.02, None, "deeper"),
        (0.0785, None, "hold"),
        (0.083, None, "back"),
        (0.02, (0.1, 0.0, 0.0), "tilt"),
        (-0.01, (0.1, 0.0, 0.0), "tilt"),
    ],
)
def test_the_needle_says_what_comes(depth, turn, kind):
    plan = placed()
    assert steps(plan).of(moment(plan, depth, turn)).kind.value == kind


@pytest.mark.parametrize("orientation", list(PatientOrientation))
@pytest.mark.parametrize(
    ("turn", "sides"),
    [
        ((0.1, 0.0, 0.0), "L"),  # the tip points to the left: the hub must go there
        ((-0.1, 0.0, 0.0), "R"),
        ((0.0, 0.0, 0.1), "S"),
        ((0.0, 0.0, -0.1), "I"),
        ((0.06, 0.0, 0.1), "SL"),
        ((0.02, 0.0, -0.1), "I"),
    ],
)
def test_the_hub_goes_to_the_side_of_the_tip_however_the_patient_lies(orientation, turn, sides):
    plan = placed(orientation)
    step = steps(plan).of(moment(plan, 0.03, turn))
    assert step.kind is StepKind.TILT
    assert step.towards == sides
    tilt = np.arctan(np.linalg.norm(turn))
    assert step.across == pytest.approx(plan.length * tilt, rel=1e-6)


def test_who_follows_the_tilt_is_on_the_path():
    plan = placed()
    wrong = moment(plan, 0.03, (0.08, 0.0, -0.05))
    step = steps(plan).of(wrong)
    towards = -np.cross(wrong.pose.axis, plan.axis)
    angle = step.across / plan.length
    turned = rotation_exp(-angle * towards / np.linalg.norm(towards)) @ wrong.pose.axis
    np.testing.assert_allclose(turned, plan.axis, atol=1e-9)


def on_bone(contact):
    row = np.zeros(sv.BONE_CONTACT + 1)
    row[sv.BONE_CONTACT] = contact
    return SimpleNamespace(row=row)


@pytest.mark.parametrize("turn", [None, (0.1, 0.0, 0.0)])
def test_a_tip_on_bone_is_not_ordered_deeper(turn):
    plan = placed()
    stopped = replace(moment(plan, 0.015, turn), device=on_bone(1.0))
    assert steps(plan).of(stopped).kind.value == "bone"
    assert steps(plan).of(stopped, live=False).kind is StepKind.SCAN
    freed = replace(moment(plan, 0.014), device=on_bone(0.0))
    assert steps(plan).of(freed).kind is StepKind.DEEPER


def test_holding_at_the_target_ends_the_attempt():
    plan = placed()
    step = steps(plan).of(moment(plan, 0.08, state=State.HOLDING))
    assert step.kind is StepKind.FINISH


def test_control_scans_alone_tell_nothing_of_the_needle():
    plan = placed()
    for depth, turn in ((0.02, (0.1, 0.0, 0.0)), (0.09, None)):
        step = steps(plan).of(moment(plan, depth, turn), live=False)
        assert (step.kind, step.across, step.towards, step.distance) == (StepKind.SCAN, 0, "", 0)


def test_a_depth_that_nobody_measures_is_not_told():
    plan = placed()
    step = steps(plan).of(moment(plan, 0.06, measured=False))
    assert (step.kind, step.distance) == (StepKind.FEEL, 0.0)
    assert steps(plan).of(moment(plan, 0.06, valid=False)).kind is StepKind.SEE


@pytest.mark.parametrize("live", [True, False])
@pytest.mark.parametrize("cause", list(PauseCause))
def test_only_a_pause_for_the_cameras_asks_for_the_marker(cause, live):
    plan = placed()
    paused = replace(moment(plan, 0.03, state=State.PAUSED, measured=False), pause=cause)
    step = steps(plan).of(paused, live)
    if cause is PauseCause.CAMERAS:
        assert (step.kind, step.pause) == (StepKind.SEE if live else StepKind.SCAN, None)
    else:
        assert (step.kind, step.pause) == (StepKind.WAIT, cause)


@pytest.mark.parametrize("cause", list(PauseCause))
def test_nobody_is_asked_to_show_a_marker_to_simulated_cameras(cause):
    plan = placed()
    paused = replace(moment(plan, 0.03, state=State.PAUSED, measured=False), pause=cause)
    step = steps(plan).of(replace(paused, simulated=True))
    assert (step.kind, step.pause) == (StepKind.WAIT, cause)
    silent = replace(moment(plan, 0.06, valid=False), simulated=True)
    assert steps(plan).of(silent).kind is StepKind.WAIT


def test_an_order_does_not_flicker_at_its_limit():
    plan = placed()
    saying, limit = steps(plan), np.arctan2(0.002, 0.08)
    kinds = [
        saying.of(moment(plan, 0.03, (limit * (1.0 + 0.1 * (-1) ** n), 0.0, 0.0))).kind
        for n in range(20)
    ]
    assert kinds[0] is StepKind.TILT
    assert set(kinds) == {StepKind.TILT}
    assert saying.of(moment(plan, 0.03, (0.5 * limit, 0.0, 0.0))).kind is StepKind.DEEPER


def test_a_bent_needle_at_depth_is_tilted_by_its_tip():
    plan = placed()
    straight = moment(plan, 0.08)
    beside = replace(
        straight, offset=offset(plan.p_target + [0.004, 0.0, 0.0], plan.axis, plan, plan.p_target)
    )
    assert steps(plan).of(beside).kind is StepKind.TILT


def test_a_whole_insertion_by_the_orders_alone_ends_at_the_target():
    plan = placed()
    saying, depth, turn = steps(plan), -0.01, np.array([0.12, 0.0, -0.2])
    sides = {"L": (0, 1), "R": (0, -1), "S": (2, 1), "I": (2, -1)}
    state, kinds = State.ALIGNING, []
    for _ in range(400):
        step = saying.of(moment(plan, depth, turn, state))
        kinds.append(step.kind)
        if step.kind is StepKind.FINISH:
            break
        if step.kind is StepKind.TILT:
            for letter in step.towards:
                if letter in sides:
                    axis, sign = sides[letter]
                    turn[axis] -= sign * min(0.01, abs(turn[axis]))
        elif step.kind in (StepKind.INSERT, StepKind.DEEPER):
            depth += 0.001
        elif step.kind is StepKind.HOLD:
            state = State.HOLDING
    assert kinds[-1] is StepKind.FINISH
    assert depth == pytest.approx(0.08, abs=0.002)
    order = list(dict.fromkeys(kinds))
    assert order[0] is StepKind.TILT
    assert order[-2:] == [StepKind.HOLD, StepKind.FINISH]


def test_a_tool_is_led_to_its_target_by_where_the_tip_goes_and_how_deep():
    exercise = load_exercise("laparoscopic-tool")
    placed = placed_plan_of(exercise, device_of(exercise))
    task = exercise.touch_task(placed)
    steps = NextSteps(placed, task.radius, task.radius)

    def step(p_tip, touched=0, measured=True, depth=0.05):
        pose = SimpleNamespace(
            valid=True, measured=measured, p_tip=np.asarray(p_tip), axis=placed.axis, depth=depth
        )
        touch = TouchState(task, touched)
        away = offset(pose.p_tip, pose.axis, touch.aim, touch.aim.p_target)
        return steps.of(Moment(State.INSERTING, pose, away, touch))

    second = task.p_targets[1]
    towards_left = placed.T_world_patient.rotation @ np.array([-1.0, 0.0, 0.0])
    path = task.plans[1].axis
    aside = towards_left - (towards_left @ path) * path
    found = step(second + 0.012 * aside - 0.02 * path, touched=1)
    assert found.kind is StepKind.TOUCH
    assert found.towards == "L"  # the tip lies to the right of it
    assert found.distance == pytest.approx(0.02)
    assert found.across == pytest.approx(0.012 * np.linalg.norm(aside), rel=1e-6)
    assert step(second + 0.003 * aside, touched=1).kind is StepKind.STAY
    assert step(second, touched=1, measured=False).kind is StepKind.SEE
    assert step(second, touched=0, measured=False, depth=-0.01).kind is StepKind.FEEL
    assert step(second, touched=0).kind is StepKind.TOUCH  # the wrong one
    assert step(placed.p_entry, depth=-0.01).kind is StepKind.INSERT
    assert step(second, touched=len(task)).kind is StepKind.FINISH


BIOPSY = ProcedurePart(anaesthetic=AnaestheticPart(), biopsy=BiopsyPart())


@pytest.mark.parametrize("tool", [tool for tool in ToolInHand if tool is not ToolInHand.ELECTRODE])
def test_where_control_scans_guide_the_steps_of_the_procedure_are_said_all_the_same(tool):
    plan = placed()
    now = replace(moment(plan, 0.0, valid=False), procedure=ProcedureState(BIOPSY, tool))
    step = steps(plan).of(now, live=False)
    assert step.kind is StepKind.PROCEDURE
    assert step.procedure.tool is tool
    assert step.inside is None


@pytest.mark.parametrize("live", [True, False])
def test_who_is_out_of_the_room_for_a_scan_is_told_for_how_long(live):
    plan = placed()
    procedure = ProcedureState(BIOPSY, ToolInHand.STYLET)
    for part in (None, procedure):
        now = replace(moment(plan, 0.03), procedure=part, out_of_room=12.0)
        step = steps(plan).of(now, live=live)
        assert (step.kind, step.left) == (StepKind.AWAY, 12.0)
    ready = replace(now, state=State.READY)
    assert steps(plan).of(ready, live=live).kind is StepKind.START


def test_before_the_first_movement_it_is_known_which_step_comes_then():
    plan = placed()
    begun = ProcedureState(BIOPSY, ToolInHand.STYLET)
    now = replace(moment(plan, -0.01, state=State.WITHDRAWING), procedure=begun, ready=True)
    step = steps(plan).of(now)
    assert step.kind is StepKind.MOVE
    assert step.procedure is begun
    assert steps(plan).of(replace(now, ready=False)).procedure is None
