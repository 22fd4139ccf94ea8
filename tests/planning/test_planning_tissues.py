"""Paths scored with a tissue field: what they meet blocks them, the pleura's angle counts."""

import numpy as np
import pytest
from field_rig import ball, beyond, field_of_shapes

from app.imaging.field import TissueKind
from app.planning.tissues import along

TARGET = np.array([40.0, 40.0, 10.0])


def paths(*entries):
    entries = np.array(entries, float)
    share = np.linspace(0.0, 1.0, 61)[None, :, None]
    return entries[:, None] + share * (TARGET - entries[:, None]), np.linalg.norm(
        TARGET - entries, axis=1
    )


@pytest.fixture(scope="module")
def field():
    return field_of_shapes(
        [
            (TissueKind.FAT, "", lambda p: np.full(len(p), -50.0)),
            (TissueKind.ORGAN, "liver", beyond((0, 0, -1), -25.0)),
            (TissueKind.LUNG, "", ball((20, 40, 45), 10.0)),
            (TissueKind.BONE, "rib", ball((60, 40, 45), 5.0)),
            (TissueKind.VESSEL, "portal vein", ball((40, 60, 45), 4.0)),
            (TissueKind.GUT, "colon", ball((40, 20, 45), 6.0)),
        ],
        (0, 0, 0),
        (81, 81, 71),
    )


def test_lengths_through_each_are_told_and_what_holds_the_target_is_none(field):
    points, length = paths((10, 40, 58), (70, 40, 58), (40, 70, 58), (40, 10, 58), (40, 40, 68))
    met = along(field, TARGET, points, length)
    assert met.lung_mm[0] == pytest.approx(19.0, abs=2.0)
    assert met.bone_mm[1] > 5.0
    assert met.vessel_mm[2] > 3.0
    assert met.gut_mm[3] > 5.0
    assert met.lung_mm[4] == met.bone_mm[4] == met.vessel_mm[4] == met.gut_mm[4] == 0.0
    assert np.isnan(met.pleural_deg[1:]).all()
    assert not met.unknown_mm.any()


def test_the_lung_is_entered_at_an_angle(field):
    points, length = paths((10, 40, 58), (20, 36, 68))
    met = along(field, TARGET, points, length)
    for n, entry in enumerate(np.array([(10, 40, 58), (20, 36, 68)], float)):
        way = (TARGET - entry) / np.linalg.norm(TARGET - entry)
        to = entry - np.array([20, 40, 45])
        depth = -to @ way - np.sqrt((to @ way) ** 2 - to @ to + 100.0)
        normal = (entry + depth * way - np.array([20, 40, 45])) / 10.0
        right = np.degrees(np.arccos(abs(normal @ way)))
        assert met.pleural_deg[n] == pytest.approx(right, abs=6.0)


def test_beyond_the_field_all_is_unknown(field):
    points, length = paths((40, 40, 300))
    assert along(field, TARGET, points, length).unknown_mm[0] > 200.0
