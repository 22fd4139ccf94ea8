"""Ways around things: found again with the same seed, free all along, short, and in the fulcrum."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from app.arm.mechanics import solve
from app.arm.motion.errors import PlannerMissingError
from app.arm.motion.path import JointPath
from app.arm.motion.searching import Budget, Collisions, Planner, SearchError, search
from app.core.transform import RigidTransform
from tests.arm.motion_rig import ARM, post

pytest.importorskip("ompl", reason="the extra `arm` is not installed")

POST = post()
DOWN = np.diag([1.0, -1.0, -1.0])
START = solve(ARM, ARM.wrist_pose(RigidTransform(DOWN, [0.5, -0.35, 0.3]))).q
GOAL = solve(ARM, ARM.wrist_pose(RigidTransform(DOWN, [0.5, 0.35, 0.3])), near=START).q
FREE = Collisions(lambda q: True)


def fine(found):
    return np.concatenate(
        [path.at(np.linspace(path.s[0], path.s[-1], 999)) for path in found.paths]
    )


@pytest.mark.long("statistics")
@pytest.mark.parametrize("planner", Planner)
def test_a_way_around_a_post_is_free_all_along_and_shorter_than_it_was_found(planner):
    assert POST.stopped(ARM, JointPath.straight(START, GOAL)) is not None
    found = search(ARM, POST, START, GOAL, planner, Budget(20.0, 8000))
    q = fine(found)
    assert min(POST.distance(one) for one in q) > 0.0
    assert all((ARM.beyond(one) <= 1e-9).all() for one in q)
    assert np.abs(q[0] - START).max() < 1e-12
    assert np.abs(q[-1] - GOAL).max() < 1e-12
    assert found.length < found.first_length


@pytest.mark.long("machine")
def test_the_same_seed_finds_the_same_way_and_another_seed_another():
    def found(seed):
        return search(ARM, POST, START, GOAL, budget=Budget(60.0, 20_000, seed))

    first, again, other = found(3), found(3), found(4)
    assert (fine(first) == fine(again)).all()
    assert first.tests == again.tests
    assert first.first_length != other.first_length


def test_where_the_straight_line_is_free_it_is_taken():
    found = search(ARM, FREE, START, GOAL)
    assert len(found.paths) == 1
    assert len(found.paths[0].s) == 2


def test_distances_see_a_thin_wall_that_steps_would_pass():
    wall = 0.5 * (START[0] + GOAL[0]) + 0.003

    def distance(q):  # a wall of no thickness across the turn of joint 1
        return 0.1 * abs(float(q[0]) - wall)

    path = JointPath.straight(START, GOAL)
    blind = Collisions(lambda q: abs(q[0] - wall) > 1e-5, step=0.05)
    assert blind.stopped(ARM, path) is None
    seeing = replace(blind, distance=distance)
    stopped = seeing.stopped(ARM, path)
    assert stopped is not None
    assert abs(path.at(stopped)[0] - wall) < 0.01


def test_ends_that_are_not_free_and_budgets_that_end_are_named():
    inside = solve(ARM, ARM.wrist_pose(RigidTransform(DOWN, [0.5, 0.0, 0.5]))).q
    with pytest.raises(SearchError, match="at the goal"):
        search(ARM, POST, START, inside)
    with pytest.raises(SearchError, match="beyond"):
        search(ARM, POST, START, np.full(7, 3.0))
    with pytest.raises(SearchError, match="nothing to move"):
        search(ARM, POST, START, START)
    with pytest.raises(SearchError, match=r"found no way in .* seed 1"):
        search(ARM, POST, START, GOAL, budget=Budget(5.0, 20))


def test_without_ompl_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "ompl.base", None)
    with pytest.raises(PlannerMissingError, match=r"make extra NAME=arm"):
        search(ARM, POST, START, GOAL)


@pytest.mark.long("statistics")
def test_neither_package_is_imported_before_it_is_used():
    code = (
        "import sys, app.arm.motion.pick_place;"
        "sys.exit(bool({'ompl', 'ruckig', 'mujoco'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
