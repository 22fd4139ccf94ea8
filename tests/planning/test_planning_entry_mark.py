"""The marked entry, and the angles of a path as a protractor has them."""

import json

import numpy as np
import pytest

from app.imaging.scan_order import ScanOrder
from app.imaging.skin_grid import GridPlace
from app.planning.entry_mark import (
    BORE_MM,
    EntryMark,
    NeedleAngles,
    bore_room_mm,
    direction_of,
    mark_of,
    needle_angles,
)
from app.planning.plan import Plan

SUPINE = (0.0, -1.0)


def path(*way: float) -> Plan:
    entry = np.array([10.0, -100.0, 50.0])
    return Plan(entry, entry + np.array(way))


@pytest.mark.parametrize(
    ("way", "angles"),
    [((0, 60, 0), (0, 0)), ((60, 60, 0), (45, 0)), ((-30, 30 * np.sqrt(3), 0), (-30, 0)),
     ((0, 60, 60), (0, 45)), ((0, 100, -100 * np.tan(np.radians(10))), (0, -10))],
)  # fmt: skip
def test_angles_are_those_of_a_protractor(way, angles) -> None:
    found = needle_angles(path(*way), SUPINE)
    assert (found.in_plane_deg, found.cranio_caudal_deg) == pytest.approx(angles, abs=1e-9)


def test_a_patient_on_the_left_side_has_other_angles_for_the_same_path() -> None:
    found = needle_angles(path(60, 60, 0), (-1.0, 0.0))  # his right lies up
    assert found.in_plane_deg == pytest.approx(-45.0)


@pytest.mark.parametrize("tilt", [0.0, -20.0])
def test_what_is_dialled_is_the_direction_of_the_path(tilt: float) -> None:
    for way, up in (((20, 60, -9), SUPINE), ((30, -4, 12), (-1.0, 0.0))):
        leaning = path(*way)
        angles = needle_angles(leaning, up, tilt)
        wanted = np.array(way) / np.linalg.norm(way)
        np.testing.assert_allclose(direction_of(angles, up, tilt), wanted, atol=1e-12)


def test_a_gantry_tilted_along_the_path_takes_its_angle_out_of_the_slice() -> None:
    lean = np.tan(np.radians(12.0))
    leaning = path(0, 80, -80 * lean)
    assert needle_angles(leaning, SUPINE).cranio_caudal_deg == pytest.approx(-12.0)
    assert needle_angles(leaning, SUPINE, 12.0).cranio_caudal_deg == pytest.approx(0.0, abs=1e-9)


def test_the_room_in_the_bore_is_what_the_hub_leaves_and_a_tilt_changes_it() -> None:
    isocentre = np.array([10.0, 0.0, 50.0])
    order = ScanOrder(50.0)
    assert bore_room_mm(order, isocentre, path(0, 60, 0), 150.0) == pytest.approx(BORE_MM - 250.0)
    leaning = path(0, 80, -80 * np.tan(np.radians(20.0)))
    straight = bore_room_mm(order, isocentre, leaning, 150.0)
    tilted = bore_room_mm(ScanOrder(50.0, tilt_deg=20.0), isocentre, leaning, 150.0)
    hub = -100.0 - 150.0 * np.cos(np.radians(20.0))
    assert straight == pytest.approx(BORE_MM + hub)
    assert tilted < straight  # it stands upright in the tilted bore


def test_a_mark_is_read_back_as_it_was() -> None:
    mark = EntryMark(GridPlace(50.5, 6, -2.0), np.array([1.0, -2.0, 50.5]),
                     np.array([2.0, -2.5, 52.0]), 1.9, NeedleAngles(12.0, -3.0))  # fmt: skip
    again = mark_of(json.loads(json.dumps(mark.data())))
    assert again.data() == mark.data()
    assert "line 6 -2.0 mm: 1.9 mm on the skin" in mark.words
