"""Measurements mean the same in every plane, and count voxels where voxels can be counted."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.core.errors import AcusError
from app.core.rotation import rotation_exp
from app.exchange.csv_export import (
    measurements_document,
    measurements_table,
    write_measurements,
)
from app.exchange.errors import ExportError
from app.imaging.series import Series
from app.imaging.volume import Volume
from app.planning.errors import MeasurementError
from app.planning.measurements import Angle, Distance, Probe, Region, checked
from app.planning.measuring import measured


def volume(turn: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Volume:
    """Noise on a grid of 0.8 × 0.9 × 2 mm."""
    hu = np.random.default_rng(4).integers(-200, 300, (20, 40, 50)).astype(np.int16)
    affine = np.eye(4)
    affine[:3, :3] = rotation_exp(turn) @ np.diag([0.8, 0.9, 2.0])
    affine[:3, 3] = (-20.0, 10.0, 100.0)
    series = Series("1", "CT", "", (50, 40, 20), None, None, None, True, "", (), "", "", ())
    return Volume(hu, affine, series)


def value(item, name, where=None):  # type: ignore[no-untyped-def]
    return {q.name: q.value for q in measured(item, where or volume())}[name]


def test_a_distance_is_true_in_space() -> None:
    assert value(Distance((0, 0, 0), (3, 4, 12)), "length") == pytest.approx(13.0)
    assert measured(Distance((0, 0, 0), (3, 4, 12)), volume()).text == "13.0 mm"


@given(st.floats(0.0, 180.0))
def test_an_angle_is_exact_from_end_to_end(wanted: float) -> None:
    turn = np.radians(wanted)
    arm = (float(5 + 30 * np.cos(turn)), float(-2 + 30 * np.sin(turn)), 7.0)
    item = Angle((15.0, -2.0, 7.0), (5.0, -2.0, 7.0), arm)
    assert value(item, "angle") == pytest.approx(wanted, abs=1e-9)


def test_an_angle_without_an_arm_says_so() -> None:
    assert measured(Angle((1, 1, 1), (1, 1, 1), (2, 2, 2)), volume()).text == (
        "two points fall together"
    )


def test_a_probe_gives_the_voxel_it_stands_in_and_says_where_there_is_none() -> None:
    where = volume((0.1, 0.2, -0.1))
    at = where.lps_mm((12.4, 7.3, 9.2))
    assert value(Probe(tuple(at.tolist())), "value", where) == float(where.hu[9, 7, 12])
    assert measured(Probe((1e4, 0.0, 0.0)), where).text == "outside the image"


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (0.2, -0.1, 0.3)])
def test_a_region_along_the_voxels_counts_those_whose_centres_lie_inside(
    turn: tuple[float, float, float],
) -> None:
    where = volume(turn)
    centre = where.lps_mm((24.3, 19.2, 8.0))
    right, down = 6.1 * where.direction[:, 0], 4.7 * where.direction[:, 1]
    item = Region(*(tuple(v.tolist()) for v in (centre, right, down)))
    j, i = np.mgrid[0:40, 0:50]
    inside = ((i - 24.3) * 0.8 / 6.1) ** 2 + ((j - 19.2) * 0.9 / 4.7) ** 2 <= 1.0
    voxels = where.hu[8][inside].astype(float)
    assert value(item, "samples", where) == inside.sum()
    assert value(item, "mean", where) == pytest.approx(voxels.mean())
    assert value(item, "deviation", where) == pytest.approx(voxels.std(ddof=1))
    assert value(item, "area", where) == pytest.approx(np.pi * 6.1 * 4.7)


def test_an_oblique_region_has_the_mean_of_a_plain_field() -> None:
    where = volume((0.3, 0.2, 0.1))
    flat = Volume(np.full((20, 40, 50), 55, np.int16), where.affine_mm, where.series)
    centre = tuple(flat.lps_mm((25.0, 20.0, 10.0)).tolist())
    item = Region(centre, (5.0, 0.0, 0.0), (0.0, 0.0, 5.0))
    assert value(item, "mean", flat) == pytest.approx(55.0)
    assert value(item, "deviation", flat) == pytest.approx(0.0, abs=1e-6)


def test_a_region_beside_the_image_or_without_end_says_so() -> None:
    away = Region((1e4, 0.0, 0.0), (5.0, 0.0, 0.0), (0.0, 5.0, 0.0))
    assert measured(away, volume()).text == "no voxel inside"
    huge = Region((0.0, 20.0, 110.0), (1e6, 0.0, 0.0), (0.0, 1e6, 0.0))
    assert measured(huge, volume()).note == "too large"


@pytest.mark.parametrize("flat", [0.0, 1e-9])
def test_a_region_that_is_still_being_drawn_along_a_line_holds_no_voxel(flat: float) -> None:
    item = Region((0.0, 20.0, 110.0), (flat, 0.0, 0.0), (0.0, 5.0, 0.0))
    assert "no voxel inside" in measured(item, volume()).text


@given(st.integers(0, 4), st.tuples(*[st.floats(-50, 50)] * 3))
def test_moving_a_handle_of_a_region_keeps_the_end_that_was_not_moved(
    handle: int, to: tuple[float, float, float]
) -> None:
    item = Region((1.0, 2.0, 3.0), (4.0, 0.0, 0.0), (0.0, 3.0, 0.0))
    moved = checked(item.moved(handle, to))
    if handle < 4:
        np.testing.assert_allclose(moved.points[handle ^ 1], item.points[handle ^ 1], atol=1e-9)
    else:
        np.testing.assert_allclose(moved.points[4], to)


@pytest.mark.parametrize(
    "item",
    [Distance((0, 0, 0), (float("nan"), 0, 0)), Region((0, 0, 0), (0, 0, 0), (0, 1, 0))],
)
def test_what_measures_nothing_is_refused(item) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(AcusError):
        checked(item)
    assert issubclass(MeasurementError, AcusError)


ITEMS = (
    Distance((0, 20, 110), (10, 20, 110), "=rib"),
    Angle((0, 20, 110), (5, 20, 110), (5, 25, 110)),
    Probe((0, 20, 110)),
    Region((0, 25, 110), (5, 0, 0), (0, 4, 0), "lesion"),
)


def test_the_table_has_a_row_for_each_value_and_runs_no_formula() -> None:
    lines = measurements_table(ITEMS, volume()).splitlines()
    assert lines[0].startswith("name,kind,quantity,value,unit,x_mm")
    assert lines[1].startswith("'=rib,distance,length,10,mm,0,20,110")
    assert sum(line.startswith("lesion,region") for line in lines) == 6
    assert all("raining" in line for line in lines[1:])


def test_slicer_gets_one_markup_for_each_with_its_values() -> None:
    document = measurements_document(ITEMS, volume())
    assert [m["type"] for m in document["markups"]] == ["Line", "Angle", "Fiducial", "ClosedCurve"]
    line, angle, _, region = document["markups"]
    assert line["measurements"][0]["value"] == pytest.approx(10.0)
    assert angle["measurements"][0]["value"] == pytest.approx(90.0)
    assert angle["controlPoints"][1]["position"] == [5, 20, 110]
    assert {p["positionStatus"] for p in region["controlPoints"]} == {"defined"}
    assert json.loads(json.dumps(document, allow_nan=False)) == document


def test_files_are_written_by_their_name(tmp_path: Path) -> None:
    write_measurements(tmp_path / "a.csv", ITEMS, volume())
    write_measurements(tmp_path / "a.mrk.json", ITEMS, volume())
    assert (tmp_path / "a.csv").read_bytes().startswith(b"\xef\xbb\xbfname,")
    with pytest.raises(ExportError, match="csv or"):
        write_measurements(tmp_path / "a.txt", ITEMS, volume())
    with pytest.raises(ExportError, match="no measurement"):
        write_measurements(tmp_path / "b.csv", (), volume())
    with pytest.raises(ExportError, match="cannot write"):
        write_measurements(tmp_path / "a.csv" / "a.mrk.json", ITEMS, volume())
