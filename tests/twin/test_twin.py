"""The twin laboratory, short: robot, cameras, trainer and two listeners; the robot is killed.

`make twin` has all parts and all faults.
"""

import numpy as np
import pytest

from tests.twin.agreement import FULCRUM, TO_WORLD, Agreement, Track
from tests.twin.run import Twin


@pytest.mark.long("journey")
@pytest.mark.timeout(300)
def test_what_listeners_hear_is_what_is_recorded_and_a_robot_that_is_killed_comes_back():
    outcome = Twin(["robot"], ["killed"], 1, 0.0, besides=["slicer", "gui"]).run(0.0)
    assert outcome.broken == []
    assert set(outcome.agrees) >= {"slicer", "gui"}
    assert outcome.trials["robot"]["killed"].zero_s < 0.15
    assert outcome.attempts >= 2


def track(times, tips, name="a"):
    return Track(name, np.array(times), np.array(tips), np.zeros(3), (times[0], times[-1]))


def test_a_pose_that_no_row_of_its_moment_has_is_called_wrong():
    tracks = [track([10.0, 10.02, 10.04], [[0, 0, 0], [1e-3, 0, 0], [2e-3, 0, 0]])]
    found = Agreement()
    found.take(tracks, np.array([1e-3 + 5e-7, 0.0, 0.0]), 10.02, 10.05)
    found.take(tracks, np.array([1.5e-3, 0.0, 0.0]), 10.02, 10.05)
    found.take(tracks, np.array([1e-3, 0.0, 0.0]), 11.0, 11.0)  # between two attempts
    assert (found.compared, len(found.wrong)) == (2, 1)
    assert found.worst_m == pytest.approx(5e-7)


def test_a_pose_of_more_than_fifty_milliseconds_before_is_called_wrong():
    tracks = [track([10.0, 10.2, 10.3], [[0, 0, 0], [1e-3, 0, 0], [2e-3, 0, 0]])]
    found = Agreement()
    found.take(tracks, np.array([1e-3, 0.0, 0.0]), 10.26, 10.3)
    assert len(found.wrong) == 1


def test_a_supine_patient_s_sides_are_those_of_the_page():
    left, head, front = np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), np.array([0, -1.0, 0])
    np.testing.assert_array_equal(TO_WORLD @ left, [1, 0, 0])
    np.testing.assert_array_equal(TO_WORLD @ head, [0, 1, 0])
    np.testing.assert_array_equal(TO_WORLD @ front, [0, 0, 1])
    assert FULCRUM.tolist() == [0.0, 0.16056, 0.090]
