"""What an attempt says while it prepares, and what its line says less and less of by level."""

import pytest
from views_exercise_fakes import FakeTrainer, pose, snapshot

from app.core.units import MILLIMETRE
from app.exercises.library import load_exercise
from app.exercises.parts import ViewName
from app.exercises.scene import device_of, placed_plan_of
from app.session.curves import offset
from app.session.machine import State
from app.session.pad.view import depth_tolerance_of, rings_of
from app.session.shown_views import Shown
from app.session.snapshot import NextStep, StepKind
from app.views.exercise.attempt_rail import AttemptRail
from app.views.exercise.bullseye import Bullseye, figure_of
from app.views.exercise.run import ExerciseRun
from app.views.exercise.stages import Steps
from app.views.exercise.steps import NextStepLine, step_words

EXERCISE = load_exercise("first-insertion")
PROFILE = device_of(EXERCISE)
PLACED = placed_plan_of(EXERCISE, PROFILE)
DIGITS = frozenset("0123456789")


def pixels(widget) -> bytes:
    image = widget.grab().toImage()
    return bytes(image.constBits())


# --- the ring -----------------------------------------------------------------------------------
@pytest.fixture(params=["row", "rail"])
def steps(qt, request):
    rail = AttemptRail()
    steps = Steps() if request.param == "row" else rail.stage
    steps.resize(330, 48)
    yield steps
    steps.show_state(None)


def test_a_ring_goes_round_while_the_needle_goes_to_its_start(steps):
    steps.show_state(State.WITHDRAWING)
    assert steps.ring.turns
    before = pixels(steps)
    steps.ring.advance()
    assert pixels(steps) != before, "it moves: nobody takes it for stuck"
    assert steps.accessibleName() != "Ready"


def test_the_ring_stands_when_only_the_first_movement_is_waited_for(steps):
    steps.show_state(State.WITHDRAWING)
    steps.show_state(State.WITHDRAWING, ready=True)
    assert not steps.ring.turns
    assert steps.accessibleName() == "Ready"
    before = pixels(steps)
    steps.ring.advance()
    assert pixels(steps) == before


@pytest.mark.parametrize("state", [None, State.READY, State.ALIGNING, State.ENDED, State.ABORTED])
def test_nothing_turns_in_any_other_state(steps, state):
    steps.show_state(State.WITHDRAWING)
    steps.show_state(state)
    assert not steps.ring.turns, "an idle window costs nothing"


def test_fewer_steps_are_another_row_of_the_same_moment(steps):
    steps.show_state(State.WITHDRAWING, ready=True)
    steps.set_brief(True)
    assert steps.accessibleName() == "Ready"
    steps.show_state(State.INSERTING)
    assert steps.accessibleName() == "Under way"
    inserting = pixels(steps)
    steps.show_state(State.READY)
    assert pixels(steps) != inserting
    steps.set_brief(False)
    steps.show_state(State.INSERTING)
    steps.set_brief(True)
    assert pixels(steps) == inserting, "however it came there"


# --- orders -------------------------------------------------------------------------------------
ORDERS = (StepKind.TILT, StepKind.DEEPER, StepKind.BACK)


@pytest.mark.parametrize("kind", ORDERS)
@pytest.mark.parametrize("by_mouse", [True, False])
@pytest.mark.parametrize("tip", [True, False])
def test_an_order_without_numbers_says_which_way_and_no_figure(kind, by_mouse, tip):
    step = NextStep(kind, "IL", 0.012, 0.003)
    with_them = step_words(step, by_mouse, tip)
    without = step_words(step, by_mouse, tip, numbers=False)
    assert DIGITS & set(with_them)
    assert not DIGITS & set(without)
    assert "mm" not in without
    if kind is StepKind.TILT:
        assert "the feet" in without or "the head" in without
    assert ("wheel" in without) == ("wheel" in with_them)


def moment(level: int, depth_mm: float):
    """A needle on the path, so deep."""
    where = pose(PLACED, tilt=0.0, depth=depth_mm * MILLIMETRE)
    return snapshot(
        PLACED,
        pose=where,
        state=State.INSERTING,
        p_target=PLACED.p_target,
        offset=offset(where, PLACED.p_target, PLACED),
    )


@pytest.mark.parametrize(
    ("level", "words"),
    [
        (1, "Push 20 mm deeper (wheel away from you)"),
        (2, "Push deeper (wheel away from you)"),
        (3, "Steer by the CT: S takes a scan, Enter ends the attempt"),
    ],
)
def test_the_line_over_the_views_says_less_from_level_to_level(qt, level, words):
    of_level = EXERCISE.model_copy(update={"level": level})
    run = ExerciseRun(
        FakeTrainer(PLACED), PLACED, PROFILE, shown=Shown.of_exercise(of_level),
        rings=rings_of(EXERCISE), depth_tolerance=depth_tolerance_of(EXERCISE), interactive=True,
    )  # fmt: skip
    line, pad = NextStepLine(), Bullseye()
    line.stepped.connect(pad.show_step)
    line.begin(run)
    line.show_snapshot(moment(level, PLACED.length / MILLIMETRE - 20.0))
    assert line.text() == words
    assert pad._figure.text() == ("▼ 20 mm" if level == 1 else "")


@pytest.mark.parametrize("kind", StepKind)
def test_the_pad_says_no_figure_where_the_order_says_none(kind):
    words = figure_of(NextStep(kind, towards="IL", distance=0.012, across=0.003), numbers=False)
    assert not DIGITS & set(words)
    assert (words == "✔ hold") == (kind in (StepKind.HOLD, StepKind.STAY, StepKind.FINISH))


@pytest.mark.parametrize("steadiness", [None, 0, 5])
def test_a_steady_hand_takes_no_help_away_and_brings_none_back(steadiness):
    for level in (1, 2, 3):
        of_level = EXERCISE.model_copy(update={"level": level})
        chosen = of_level.model_copy(update={"unsteady_hand": steadiness})
        assert Shown.of_exercise(chosen) == Shown.of_exercise(of_level)
        assert chosen.hand_level == (level if steadiness is None else steadiness)
    assert ViewName.BULLSEYE in Shown.of_exercise(EXERCISE).views
