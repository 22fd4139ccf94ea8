"""Scores of paths and the skin they start from, on a made-up body whose answers are known."""

import numpy as np
import pytest

from app.core.progress import Cancelled, Progress
from app.core.units import DEGREE
from app.imaging.body import find_body
from app.imaging.errors import InvalidEntryError
from app.imaging.series import Series
from app.imaging.skin import skin_points
from app.imaging.structures.distance import SignedDistance
from app.imaging.structures.structure import Structure, StructureKind
from app.imaging.volume import Volume
from app.planning.clearance import Nearness, clearances, worst
from app.planning.limits import ReachLimits
from app.planning.paths import PathObstacle, best, score_paths
from app.planning.placement import PatientOrientation, Placement

RADIUS = 60.0
"""Of a cylinder along the patient: the body."""


def cylinder(turn=None):
    size, spacing = (80, 80, 60), 2.0
    affine = np.eye(4)
    affine[:3, :3] = (np.eye(3) if turn is None else turn) * spacing
    affine[:3, 3] = -(affine[:3, :3] @ (np.array(size) - 1)) / 2
    _, j, i = np.indices(size[::-1])
    away = np.hypot(i - 39.5, j - 39.5) * spacing
    # the skin lies at -400 HU half way between two voxels at most
    hu = np.clip(-400.0 - (away - RADIUS) * 700.0 / 2.0, -1000.0, 40.0).astype(np.int16)
    series = Series("1", "CT", "", size, None, None, None, True, "", (), "", "", ())
    return Volume(hu, affine, series)


@pytest.fixture(scope="module")
def body():
    return find_body(cylinder())


@pytest.fixture(scope="module")
def skin(body):
    return skin_points(body)


LIMITS = ReachLimits(np.zeros(3), 30.0 * DEGREE, 0.1, lambda x, y: True)
TARGET = np.array([0.0, -10.0, 0.0])


@pytest.mark.parametrize("angle", [0.0, 35.0])
def test_skin_points_lie_on_the_skin_and_look_outwards(angle):
    c, s = np.cos(angle * DEGREE), np.sin(angle * DEGREE)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    skin = skin_points(find_body(cylinder(turn)))
    assert 600 < len(skin) < 4000
    assert np.abs(np.hypot(*skin.points_mm[:, :2].T) - RADIUS).max() < 1.0
    radial = skin.points_mm[:, :2] / np.hypot(*skin.points_mm[:, :2].T)[:, None]
    middle = np.abs(skin.points_mm[:, 2]) < 40.0
    assert (skin.outward[middle, :2] * radial[middle]).sum(axis=1).min() > np.cos(12 * DEGREE)
    assert np.linalg.norm(skin.outward, axis=1) == pytest.approx(1.0)


def test_a_volume_without_a_body_has_no_skin():
    volume = cylinder()
    empty = Volume(np.full(volume.hu.shape, -1000, np.int16), volume.affine_mm, volume.series)
    with pytest.raises(InvalidEntryError, match="no body"):
        skin_points(find_body(empty))


def test_the_best_path_is_the_short_straight_one_from_above(body, skin):
    scores = score_paths(TARGET, skin, body, [], Placement(), LIMITS)
    first = scores.entries_mm[best(scores)[0]]
    assert np.linalg.norm(first - [0.0, -RADIUS, 0.0]) < 12.0  # supine: anterior is up
    assert scores.score[best(scores)[0]] == np.nanmax(scores.score)
    assert np.isnan(scores.score[~scores.free]).all()
    assert ((scores.score[scores.free] >= 0) & (scores.score[scores.free] <= 100)).all()
    turned = score_paths(TARGET, skin, body, [], Placement(PatientOrientation.PRONE), LIMITS)
    assert (turned.entries_mm[turned.free][:, 1] > 0.0).all()


def test_paths_out_of_reach_or_too_long_are_blocked_with_their_reason(body, skin):
    limits = ReachLimits(np.zeros(3), 30.0 * DEGREE, 0.08, lambda x, y: True)
    scores = score_paths(TARGET, skin, body, [], Placement(), limits)
    far = int(np.argmax(scores.length_mm))
    assert scores.why(far) is PathObstacle.LONG
    for number in np.flatnonzero(scores.length_mm < 80.0):
        way = TARGET - scores.entries_mm[number]
        tilt = np.arccos(way[1] / np.linalg.norm(way))  # straight down is posterior
        assert (tilt <= LIMITS.tilt_limit + 1e-9) == scores.free[number]
    nowhere = ReachLimits(np.zeros(3), 30.0 * DEGREE, 0.1, lambda x, y: False)
    none = score_paths(TARGET, skin, body, [], Placement(), nowhere)
    assert not none.free.any()
    assert best(none) == ()


@pytest.mark.long("statistics")
def test_bone_blocks_and_a_structure_keeps_paths_away(skin):
    volume = cylinder()
    hu = volume.hu.copy()
    hu[:, 15:18, 38:43] = 900  # a bar of bone before the target, along the patient
    body = find_body(Volume(hu, volume.affine_mm, volume.series))
    scores = score_paths(TARGET, skin, body, [], Placement(), LIMITS)
    ahead = np.linalg.norm(skin.points_mm - [0.0, -RADIUS, 0.0], axis=1) < 6.0
    assert {scores.why(n) for n in np.flatnonzero(ahead)} == {PathObstacle.BONE}
    assert (scores.bone_mm[ahead] > 3.0).all()

    mask = np.zeros(volume.hu.shape, bool)
    mask[26:34, 22:26, 38:42] = True
    vessel = Structure.of("vessel", mask, volume, StructureKind.VESSEL)
    field = (vessel, SignedDistance.of(vessel))
    plain = find_body(volume)
    without = score_paths(TARGET, skin, plain, [], Placement(), LIMITS)
    scores = score_paths(TARGET, skin, plain, [field], Placement(), LIMITS)
    assert scores.names == ("vessel",)
    assert {scores.why(n) for n in np.flatnonzero(ahead)} == {PathObstacle.STRUCTURE}
    both = scores.free & without.free
    assert (scores.score[both] <= 100.0).all()
    for number in np.flatnonzero(scores.free)[::17]:
        found = clearances(scores.entries_mm[number], TARGET, [field])[0]
        assert found.distance_mm == pytest.approx(scores.nearest_mm[number], abs=0.5)


def test_a_structure_that_may_be_met_changes_nothing(body, skin):
    volume = body.volume
    mask = np.zeros(volume.hu.shape, bool)
    mask[26:34, 22:26, 38:42] = True
    lesion = Structure.of("lesion", mask, volume, StructureKind.TARGET)
    field = (lesion, SignedDistance.of(lesion))
    with_it = score_paths(TARGET, skin, body, [field], Placement(), LIMITS)
    without = score_paths(TARGET, skin, body, [], Placement(), LIMITS)
    assert np.array_equal(with_it.score, without.score, equal_nan=True)
    inside = clearances(lesion.centre_mm - [0, 30, 0], lesion.centre_mm, [field])
    assert inside[0].distance_mm < 0.0
    assert inside[0].nearness is Nearness.FREE
    assert worst(inside) is None


def test_candidates_lie_apart_and_come_best_first(body, skin):
    scores = score_paths(TARGET, skin, body, [], Placement(), LIMITS)
    numbers = list(best(scores, 5, 12.0))
    entries = scores.entries_mm[numbers]
    gaps = np.linalg.norm(entries[:, None] - entries[None], axis=2) + 99.0 * np.eye(len(numbers))
    assert gaps.min() >= 12.0
    assert (np.diff(scores.score[numbers]) <= 0.0).all()


def test_scoring_can_be_cancelled(body, skin):
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        score_paths(TARGET, skin, body, [], Placement(), LIMITS, progress=progress)
    with pytest.raises(Cancelled):
        skin_points(body, progress=progress)
