"""Rocking a pen: sides that are covered, positions held back, how fast it moves, what is kept."""

import dataclasses

import numpy as np
import pytest
from pen_rig import ENTRY, PEN, TIP, camera, picture, renderer, step

from app.core.errors import ConfigurationError
from app.core.transform import RigidTransform
from app.tracking.pen.calibrating import (
    EVERY,
    LEANT,
    SIDES,
    WANTED,
    Lean,
    Rocking,
    held_back,
    lean_of,
)
from app.tracking.pen.errors import PenError
from app.tracking.pen.needle import PenTip
from app.tracking.pen.pivot import FEWEST, MeasuredPose
from app.tracking.pen.pose import BoardPose, PoseStatus
from app.tracking.pen.settings import (
    PenSettings,
    before_path,
    calibrated_path,
    can_undo,
    save_pen,
    undo_pen,
)
from app.tracking.pen.tracker import Motion
from app.tracking.simulated.pen_scene import rocked

MODEL = camera()
SPREAD = np.diag([3e-4] * 3 + [1e-3] * 3) ** 2
UPRIGHT = np.diag([1.0, -1.0, -1.0])


def positions(count=60, seed=1, most=0.5):
    rng, found = np.random.default_rng(seed), []
    for k in range(count):
        way, lean = 2.4 * k, most * np.sqrt((k + 1) / count)
        turn = RigidTransform.exp([0, 0, 0, lean * np.cos(way), lean * np.sin(way), 0.1 * k])
        turn = turn.rotation @ UPRIGHT
        error = RigidTransform.exp(np.sqrt(np.diag(SPREAD)) * rng.normal(size=6))
        found.append(MeasuredPose(error @ RigidTransform(turn, ENTRY - turn @ TIP), SPREAD))
    return found


@pytest.fixture(scope="module")
def looks():
    """One round of a simulated pen that is rocked before the webcam."""
    known, scene = step(MODEL), rocked(ENTRY, PenTip.of(PEN.tip))
    draw = renderer(MODEL)
    times = np.arange(3.0, 7.0, 1.0 / 6.0)
    return [known.observe(picture(draw, scene(t), k, time=t)) for k, t in enumerate(times)]


@pytest.mark.long("statistics")
def test_a_rocked_pen_covers_all_sides_and_each_position_counts_for_the_side_it_leans_to(looks):
    rocking = Rocking()
    assert rocking.missing == SIDES
    for seen in looks:
        rocking.add(seen)
    assert rocking.covered == frozenset(range(len(SIDES)))
    assert rocking.missing == ()
    assert 0.0 < rocking.progress < 1.0, "all sides, but fewer positions than are wanted"
    assert not rocking.enough
    assert rocking.computable == (len(rocking.collector.poses) >= FEWEST)
    assert len(rocking.leans) == len(rocking.collector.poses) <= WANTED


def test_right_is_right_in_the_picture_and_away_is_away_from_the_webcam(looks):
    for seen in looks:
        lean = lean_of(seen)
        if seen.needle is None or lean is None:
            continue
        up = -seen.needle.axis
        camera_axes = seen.needle.T_world_camera.rotation
        across = up @ camera_axes[:, 0]
        assert lean.right == pytest.approx(across, abs=0.02)
        ahead = np.cross([0.0, 0.0, 1.0], camera_axes[:, 0])  # of the webcam, level
        assert lean.away == pytest.approx(up @ ahead, abs=0.02)


@pytest.mark.parametrize(
    ("right", "away", "side"),
    [(0.4, 0.0, "right"), (0.0, 0.4, "away"), (-0.4, 0.0, "left"), (0.3, -0.3, "near, right")],
)
def test_a_lean_has_the_name_of_its_side(right, away, side):
    assert SIDES[Lean(right, away).side] == side


def test_a_pen_that_stands_upright_counts_for_no_side_and_one_that_is_not_seen_has_no_lean(looks):
    assert Lean(0.5 * LEANT, 0.0).side is None
    gone = dataclasses.replace(looks[0], body=BoardPose.none(PoseStatus.UNSEEN, "gone"))
    assert lean_of(gone) is None
    rocking = Rocking()
    rocking.add(gone)
    assert rocking.now is None
    assert not rocking.leans


def test_on_positions_held_back_a_tip_that_stood_still_is_found_where_its_dimple_is():
    found = held_back(positions())
    assert found.poses == 60 // EVERY
    expected = np.hypot(3e-4, 1e-3 * 0.18) * np.sqrt(3.0)
    assert found.rms < 1.5 * expected
    assert found.rms <= found.worst
    assert "held back" in found.words


def test_a_tip_that_crept_is_found_out_by_the_positions_held_back():
    crept = [
        MeasuredPose(RigidTransform.from_translation([0, 0, 8e-5 * k]) @ pose.T, pose.covariance)
        for k, pose in enumerate(positions())
    ]
    assert held_back(crept).rms > 2.0 * held_back(positions()).rms


def test_with_few_positions_none_are_held_back_and_a_poor_motion_is_refused_by_name():
    assert held_back(positions(24)) is None
    with pytest.raises(PenError, match="only rolled"):
        held_back(positions(most=0.0))


def test_a_speed_is_the_mean_over_the_last_pictures_and_an_old_one_is_forgotten():
    motion = Motion()
    assert motion.speed(0.0) == 0.0
    for k in range(10):
        motion.add(0.05 * k, np.array([0.01 * k, 0.0, 0.0]))
    assert motion.speed(0.45) == pytest.approx(0.2)
    assert motion.speed(5.0) == 0.0
    motion.add(0.1, np.zeros(3))  # a clock that begins anew
    assert motion.speed(0.1) == 0.0


def test_a_tip_that_is_saved_can_be_undone_and_done_again():
    first = PEN.model_copy(update={"description": "first"})
    second = PEN.model_copy(update={"description": "second"})
    settings = PenSettings()
    assert not can_undo("cube")
    save_pen(first)
    assert settings.profile().description == "first"
    save_pen(second)
    assert undo_pen("cube")
    assert settings.profile().description == "first"
    assert undo_pen("cube")
    assert settings.profile().description == "second"


def test_the_undo_of_a_first_tip_leads_back_to_the_drawing():
    tip = PEN.tip.model_copy(update={"calibrated": True})
    save_pen(PEN.model_copy(update={"tip": tip}))
    assert not undo_pen("cube")
    assert not PenSettings().profile().tip.calibrated
    assert can_undo("cube")
    assert before_path("cube").is_file()
    assert undo_pen("cube")
    assert PenSettings().profile().tip.calibrated


def test_a_cube_of_another_size_is_another_pen_with_markers_that_fit_it():
    small = PenSettings(edge_mm=30.0)
    pen = small.profile()
    assert pen.body.edge_mm == 30.0
    assert pen.body.marker_mm == pytest.approx(22.5)
    assert pen.base == PEN.base
    save_pen(pen.model_copy(update={"description": "small"}), small.kept_name)
    assert small.profile().description == "small"
    assert PenSettings().profile().description != "small"
    assert calibrated_path(small.kept_name).stem == "cube-30mm"


def test_a_size_that_no_pen_has_is_refused():
    from app.core.configuration import parse

    with pytest.raises(ConfigurationError, match="edge_mm"):
        parse({"edge_mm": 1.0}, PenSettings, "test")
