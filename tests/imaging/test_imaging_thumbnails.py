"""Thumbnails of usable and refused series."""

import numpy as np
import pytest

from app.imaging.errors import SeriesRefusedError
from app.imaging.scanning import scan_folder
from app.imaging.thumbnails import thumbnail, try_thumbnail
from tests.imaging.dicom_factory import Slices


def of(folder, size=64):
    (series,) = scan_folder(folder).series
    return thumbnail(series, size)


def test_a_thumbnail_is_to_scale_and_fills_the_square(tmp_path):
    tags = {"WindowWidth": "3000", "WindowCenter": "1500"}
    Slices(shape=(64, 80), spacing=(1.0, 0.5), tags=tags).write(tmp_path)
    grey = of(tmp_path)
    assert grey.shape == (64, 40)
    assert grey.dtype == np.uint8
    assert np.ptp(grey) > 50


def test_a_small_picture_is_enlarged(tmp_path):
    Slices(shape=(6, 8), spacing=(1.0, 1.0)).write(tmp_path)
    assert of(tmp_path, 32).shape == (24, 32)


def test_refused_series_have_pictures_too(tmp_path):
    Slices(tags={"ImageType": ["ORIGINAL", "PRIMARY", "LOCALIZER"]}).write(tmp_path / "a")
    assert of(tmp_path / "a").any()
    Slices(tags={"RescaleSlope": None, "PhotometricInterpretation": "MONOCHROME1"}).write(
        tmp_path / "b"
    )
    assert of(tmp_path / "b").any()


def test_what_has_no_grey_pixels_has_no_thumbnail(tmp_path):
    Slices(tags={"SamplesPerPixel": 3, "PhotometricInterpretation": "RGB"}).write(tmp_path)
    (series,) = scan_folder(tmp_path).series
    with pytest.raises(SeriesRefusedError):
        thumbnail(series)
    assert try_thumbnail(series) is None


def test_a_folder_removed_meanwhile_gives_no_thumbnail(tmp_path):
    paths = Slices().write(tmp_path)
    (series,) = scan_folder(tmp_path).series
    for path in paths:
        path.unlink()
    assert try_thumbnail(series) is None
