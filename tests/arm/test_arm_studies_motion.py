"""The study of the arm's motion, small."""

import pytest

from app.arm.mechanics import load_arm
from app.arm.studies.arm_motion import MotionSize, Post, ends, measured
from app.studies.runner import examine

pytest.importorskip("ompl", reason="the extra `arm` is not installed")
pytest.importorskip("ruckig", reason="the extra `arm` is not installed")


@pytest.mark.long("statistics")
def test_it_holds_what_it_says_and_draws():
    found = measured(MotionSize(1, (1000,)))
    assert found.passed
    sheets = {sheet.name: sheet for sheet in found.sheets}
    assert set(sheets) == {"planners", "checks", "insertion", "profiles"}
    knots = [row[1] for row in sheets["insertion"].rows]
    assert knots == sorted(knots)
    figure = pytest.importorskip("matplotlib.figure").Figure()
    for picture in found.figures:
        figure.clear()
        picture.draw(figure)
        assert figure.axes


def test_the_post_stands_between_the_ends():
    post = Post(load_arm())
    start, goal = ends(post.arm)
    assert post.distance(start) > 0.1
    assert post.distance(goal) > 0.1
    assert post.collisions(0.02).distance is None


@pytest.mark.long("statistics")
def test_the_runner_knows_it():
    assert examine("arm_motion", quick=True).findings.passed
