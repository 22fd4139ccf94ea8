"""The needle's planes on every path of the needle: square, bounded in their turn, never a jump."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from app.core.arrays import angle_between, unit
from app.planning.needle_planes import (
    BACK_TO_SUPERIOR,
    LEAVE_SUPERIOR,
    ROLL_PER_TURN,
    Reference,
    follow,
    frame_of,
    in_plane,
    in_plane_90,
    probe,
    through,
)

TIP = np.zeros(3)
AXES = [sign * axis for axis in np.eye(3) for sign in (1.0, -1.0)]
share = st.floats(-1.0, 1.0)
vectors = st.tuples(share, share, share).filter(lambda v: np.linalg.norm(v) > 1e-3)
hard = settings(derandomize=True, deadline=None, max_examples=40)


def check(frame):
    axes = np.stack([frame.axis, frame.x, frame.y])
    assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert_allclose(np.cross(frame.axis, frame.y), frame.x, atol=1e-12)
    for view in (in_plane(frame), in_plane_90(frame), probe(frame)):
        assert abs(np.linalg.norm(view.normal) - 1.0) < 1e-12


def rotation_angle(one, other):
    """Angle by which the whole frame turned [rad]."""
    first, second = (np.stack([f.axis, f.x, f.y]) for f in (one, other))
    cosine = (np.trace(second.T @ first) - 1.0) / 2.0
    sine = np.linalg.norm(second.T @ first - first.T @ second) / np.sqrt(8.0)
    return float(np.arctan2(sine, cosine))


def walk(axes, **bands):
    frames = [frame_of(TIP, axes[0])]
    for axis in axes[1:]:
        frames.append(follow(frames[-1], TIP, axis, **bands))
        check(frames[-1])
    return frames


def arc(start, end, steps):
    """Directions from one to another, by way of a third where they are opposite."""
    u, v = unit(start), unit(end)
    if angle_between(u, v) > 3.1:
        middle = unit(np.cross(u, [0.36, -0.48, 0.8]))
        return [*arc(u, middle, steps), *arc(middle, v, steps)[1:]]
    whole = angle_between(u, v)
    across = v - (u @ v) * u
    if whole < 1e-9:
        return [u] * steps
    across = unit(across)
    return [np.cos(a) * u + np.sin(a) * across for a in np.linspace(0.0, whole, steps)]


@pytest.mark.parametrize("axis", AXES)
def test_along_every_axis_of_the_patient_and_against_it_the_planes_stand_square(axis):
    check(frame_of(TIP, axis))
    check(follow(frame_of(TIP, axis), TIP, -axis))


@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("tilt", [1e-12, 1e-9, 1e-6, 1e-3])
def test_a_needle_turned_to_nearly_its_opposite_gives_square_planes(axis, tilt):
    for aside in np.eye(3):
        check(follow(frame_of(TIP, axis), TIP, -axis + tilt * aside))


@pytest.mark.long("statistics")
@given(st.lists(vectors, min_size=2, max_size=12))
@example([(0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.0, 0.0, 1.0)])
@example([(0.0, 1.0, 0.0), (0.0, -1.0, 0.0)])
@hard
def test_whatever_the_needle_does_the_planes_stay_square_and_turn_no_faster_than_allowed(axes):
    frames = walk(axes)
    for before, after in pairwise(frames):
        turn = angle_between(before.axis, after.axis)
        assert rotation_angle(before, after) <= (1.0 + ROLL_PER_TURN) * turn + 1e-9


@pytest.mark.long("statistics")
@pytest.mark.promise("README.md: the needle's own planes that never jump")
@given(vectors, vectors, st.integers(20, 80))
@example((0.0, 1.0, 0.0), (0.0, -1.0, 0.0), 60)
@example((0.3, 0.0, 0.95), (-0.3, 0.0, 0.95), 50)
@hard
def test_a_needle_that_turns_slowly_never_makes_the_picture_jump(start, end, steps):
    axes = arc(start, end, steps)
    frames = walk(axes, dead_deg=0.0)
    largest = max(angle_between(a, b) for a, b in pairwise(axes))
    for before, after in pairwise(frames):
        assert rotation_angle(before, after) <= (1.0 + ROLL_PER_TURN) * largest + 1e-9


@pytest.mark.long("statistics")
@given(st.floats(0.0, 0.94), st.booleans(), st.floats(2.0, 6.0))
@settings(hard, max_examples=12)
def test_where_superior_holds_the_planes_depend_on_the_direction_alone(height, below, step_deg):
    height = -height if below else height
    turns = np.radians(np.arange(0.0, 360.0, step_deg))
    radius = np.sqrt(1.0 - height**2)
    axes = [(radius * np.cos(a), radius * np.sin(a), height) for a in turns]
    for frame, axis in zip(walk(axes, dead_deg=0.0), axes, strict=True):
        assert_allclose(frame.y, frame_of(TIP, axis).y, atol=1e-9)


def test_the_reference_changes_late_and_comes_back_late():
    def at(height):
        return (np.sqrt(1.0 - height**2), 0.0, height)

    frame = frame_of(TIP, at(LEAVE_SUPERIOR - 0.01))
    assert frame.reference is Reference.SUPERIOR
    frame = follow(frame, TIP, at(LEAVE_SUPERIOR + 0.01))
    assert frame.reference is Reference.ANTERIOR
    frame = follow(frame, TIP, at(BACK_TO_SUPERIOR + 0.01))
    assert frame.reference is Reference.ANTERIOR
    assert follow(frame, TIP, at(BACK_TO_SUPERIOR - 0.01)).reference is Reference.SUPERIOR


def test_a_needle_that_trembles_at_the_switch_changes_its_reference_once():
    rng = np.random.default_rng(4)
    heights = LEAVE_SUPERIOR + 0.01 * rng.standard_normal(500)
    axes = [(np.sqrt(1.0 - h**2), 0.0, h) for h in heights]
    references = [frame.reference for frame in walk(axes, dead_deg=0.0)]
    assert sum(a is not b for a, b in pairwise(references)) <= 1


def test_a_resting_needle_with_noise_leaves_the_planes_where_they_are():
    rng = np.random.default_rng(5)
    start = frame = frame_of(TIP, (0.2, 0.9, 0.3))
    for _ in range(500):
        noisy = start.axis + np.radians(0.05) * rng.standard_normal(3)
        frame = follow(frame, 0.05 * rng.standard_normal(3), noisy)
    assert frame is start


def test_the_roll_comes_home_after_the_reference_has_changed():
    """Over the pole and down the other side: a quarter of a turn further, superior rules again."""
    axes = [(np.sin(a), 0.0, np.cos(a)) for a in np.radians(np.arange(-60.0, 91.0, 0.5))]
    last = walk(axes, dead_deg=0.0)[-1]
    assert last.reference is Reference.SUPERIOR
    assert_allclose(last.y, frame_of(TIP, last.axis).y, atol=1e-9)


def test_a_given_roll_is_carried_along_whatever_the_direction():
    frame = through(TIP, [0.0, 0.0, 50.0], [1.0, 0.0, 0.0])
    for axis in arc((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), 90):
        frame = follow(frame, TIP, axis, dead_deg=0.0)
        check(frame)
    assert_allclose(frame.x, (1.0, 0.0, 0.0), atol=1e-9)
