"""The study of the fulcrum: a few pictures of it."""

import numpy as np
import pytest

from app.arm.eyes.fulcrum import FulcrumStatus
from app.arm.studies.fulcrum import Stand, by_lines, by_planes, motion, poses, spiral
from app.core.units import DEGREE
from app.studies.kept import kept


def test_a_spiral_covers_its_cone_and_its_beginning_does_too():
    axes = np.array(list(spiral(0.5, 200, 0.0)))
    lean = np.arccos(-axes[:, 2])
    assert lean.max() <= 0.5
    assert np.mean(lean < 0.5 / np.sqrt(2.0)) == pytest.approx(0.5, abs=0.05)
    assert np.linalg.norm(axes[:12, :2].mean(axis=0)) < 0.06


@pytest.mark.long("machine")
def test_both_ways_by_motion_find_the_fulcrum_in_pictures():
    stand = Stand()
    moved = motion(stand, 15.0 * DEGREE, 4, seed=3)
    assert len(moved.poses) == 4
    for way in (by_lines, by_planes):
        found = way(moved.poses)
        assert found.status is FulcrumStatus.FOUND
        assert np.linalg.norm(found.p_world - stand.trocar.p_world) < 0.5e-3


@pytest.mark.long("machine")
@pytest.mark.parametrize("inserted", [False, True])
def test_tools_are_found_within_the_goal(inserted):
    found = poses(8, inserted, seed=5)
    assert found.refused == ()
    assert found.wrong_tips == 0
    assert np.median(found.position) < 1e-3
    assert np.median(found.angle) < 1.0 * DEGREE


def test_the_kept_table_reaches_the_goals_and_names_what_it_cannot_tell():
    found = kept("fulcrum").result
    rows = {sheet.name: sheet.rows for sheet in found.findings.sheets}
    assert all(row[1] <= 1.0 and row[4] <= 1.0 for row in rows["pose"])
    still = [row for row in rows["motion"] if row[0] == 0.2]
    assert all("degenerate" in row[-1] for row in still)
    assert max(point.error for point in found.points) <= 0.5
