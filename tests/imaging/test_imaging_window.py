"""Window and level."""

import numpy as np
import pytest

from app.core.errors import NumericalError
from app.imaging.reading import load_ct
from app.imaging.window import FROM_DICOM, PRESETS, WindowLevel, presets, to_grey
from tests.imaging.dicom_factory import Slices


def standard(x: np.ndarray, window: WindowLevel) -> np.ndarray:
    """PS3.3 C.11.2.1.2.1 as written there, y from 0 to 255."""
    c, w = window.level, window.width
    y = ((x - (c - 0.5)) / (w - 1) + 0.5) * 255.0
    y = np.where(x <= c - 0.5 - (w - 1) / 2, 0.0, y)
    return np.where(x > c - 0.5 + (w - 1) / 2, 255.0, y)


@pytest.mark.parametrize("window", [*PRESETS.values(), WindowLevel(2, 0), WindowLevel(1e4, -500)])
def test_grey_is_the_standard_s_within_rounding_for_every_int16(window):
    x = np.arange(-32768, 32768)
    grey = to_grey(x.astype(np.int16), window)
    assert np.abs(grey - standard(x.astype(float), window)).max() <= 0.5 + 2e-3
    assert grey.dtype == np.uint8


def test_width_one_is_a_step_at_the_level():
    values = np.array([38, 39, 40, 41], np.int16)
    assert to_grey(values, WindowLevel(1, 40)).tolist() == [0, 0, 255, 255]


def test_both_types_and_any_memory_order_give_the_same():
    rng = np.random.default_rng(2)
    hu = rng.integers(-1024, 3071, (20, 30, 40)).astype(np.int16)
    window = PRESETS["Lung"]
    for part in (hu[3], hu[:, 4], hu[::-1, :, 5], hu[..., ::-2]):
        whole = to_grey(part, window)
        np.testing.assert_array_equal(whole, to_grey(part.astype(np.float32), window))
        np.testing.assert_array_equal(whole, to_grey(part.copy(), window))


@pytest.mark.parametrize(("width", "level"), [(0.5, 0), (-1, 0), (np.nan, 0), (1, np.inf)])
def test_impossible_windows_are_refused(width, level):
    with pytest.raises(NumericalError, match="width"):
        WindowLevel(width, level)


def test_a_drag_never_leaves_what_is_allowed():
    assert WindowLevel(400, 40).dragged(-1e9, 10) == WindowLevel(1, 50)


def test_the_files_own_windows_come_first(tmp_path):
    Slices().write(tmp_path)
    choices = presets(load_ct(tmp_path))
    names = list(choices)
    assert names[:3] == [FROM_DICOM, f"{FROM_DICOM} 2", "Soft tissue"]
    assert choices[FROM_DICOM] == WindowLevel(400, 40)
