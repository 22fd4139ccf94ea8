"""Wherever a series is taken as it is, every voxel lies where its own file puts it, to 0.01 mm."""

import numpy as np
import pydicom
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.imaging import stack
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from tests.imaging import dicom_factory as factory
from tests.imaging.dicom_factory import Slices

REFUSED = ("uneven", "slices turned", "slices shifted sideways", "damaged")
WIDE = (5.0, 4.0)  # [mm]: a picture of 320 mm from few pixels
QUICK = settings(
    derandomize=True,
    deadline=None,
    max_examples=60,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


def corners_mm(path) -> np.ndarray:
    """Corners of a picture by equation C.7.6.2.1-1 with the file's own numbers."""
    file = pydicom.dcmread(path, stop_before_pixels=True)
    row, column = np.reshape(np.array(file.ImageOrientationPatient, float), (2, 3))
    down, across = map(float, file.PixelSpacing)
    return np.array(
        [
            np.array(file.ImagePositionPatient, float) + i * across * row + j * down * column
            for i in (0, file.Columns - 1)
            for j in (0, file.Rows - 1)
        ]
    )


def off_mm(folder) -> float:
    """Worst distance of a voxel of the volume from where its file puts it."""
    volume = load_ct(folder)
    worst = 0.0
    i, j, _ = volume.size
    for k, header in enumerate(volume.series.slices):
        own = corners_mm(header.path)
        grid = volume.lps_mm([(a, b, k) for a in (0, i - 1) for b in (0, j - 1)])
        worst = max(worst, float(np.abs(np.linalg.norm(own - grid, axis=1)).max()))
    return worst


@pytest.mark.long("statistics")
@pytest.mark.promise(
    "README.md: every voxel within 0.01 mm of where its own file's IPP and IOP put it, or "
    "refused with the reason"
)
@given(
    angle=st.floats(-80.0, 80.0),
    shear=st.floats(-0.5, 0.5),
    decimals=st.integers(1, 6),
    jitter=st.floats(0.0, 0.03),
    scale=st.floats(-9e-4, 9e-4),
    wobble=st.floats(0.0, 1e-4),
    seed=st.integers(0, 1000),
)
@QUICK
def test_a_series_is_refused_or_right_everywhere(
    tmp_path, angle, shear, decimals, jitter, scale, wobble, seed
):
    folder = tmp_path / "series"
    folder.mkdir(exist_ok=True)
    for old in folder.iterdir():
        old.unlink()
    random = np.random.default_rng(seed)
    slices = Slices(factory.oblique(angle), spacing=WIDE, shape=(64, 64), shear=shear)
    for k, offset in enumerate(np.arange(7) * 1.37):
        place = slices.position(offset) + random.uniform(-jitter, jitter, 3)
        cosines = np.array(slices.orientation) * (1 + scale) + random.uniform(-wobble, wobble, 6)
        slices.write_one(
            folder / f"s{k}",
            k,
            offset,
            ImagePositionPatient=[round(v, decimals) for v in place.tolist()],
            ImageOrientationPatient=[round(v, 8) for v in cosines.tolist()],
        )
    (series,) = scan_folder(folder).series
    if series.usable:
        assert off_mm(folder) <= stack.TOLERANCE_MM + 1e-9
    else:
        assert series.reason.startswith(REFUSED)


@pytest.mark.parametrize("decimals", [2, 3, 6])
@pytest.mark.parametrize("shear", [0.0, 0.25])
def test_a_long_series_with_rounded_places_is_taken_and_right(tmp_path, decimals, shear):
    slices = Slices(factory.oblique(), spacing=WIDE, shape=(64, 64), shear=shear)
    for k, offset in enumerate(np.arange(60) * 0.625):
        place = [round(v, decimals) for v in slices.position(offset).tolist()]
        slices.write_one(tmp_path / f"s{k:02d}", k, offset, ImagePositionPatient=place)
    assert off_mm(tmp_path) <= stack.TOLERANCE_MM


def test_slices_turned_a_little_against_each_other_are_refused_by_name(tmp_path):
    slices = Slices(spacing=WIDE, shape=(64, 64))
    slices.write(tmp_path)
    slices.write_one(tmp_path / "odd", 9, 10.0, ImageOrientationPatient=[1, 1e-4, 0, -1e-4, 1, 0])
    (series,) = scan_folder(tmp_path).series
    assert series.reason.startswith("slices turned against each other: the corners of odd")
    assert series.remedy == "none"


def test_direction_cosines_that_are_not_unit_are_taken_as_written_and_said(tmp_path):
    tags = {"ImageOrientationPatient": [1.0004, 0, 0, 0, 1, 0]}
    Slices(spacing=WIDE, shape=(64, 64), tags=tags).write(tmp_path)
    (series,) = scan_folder(tmp_path).series
    assert any("taken as they are written" in note for note in series.notes)
    assert off_mm(tmp_path) <= 1e-6
