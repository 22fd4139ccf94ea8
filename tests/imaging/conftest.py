"""The phantom patient, small, made once for all tests of this room."""

from pathlib import Path

import pytest

from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.volume import Volume


@pytest.fixture(scope="session")
def small_phantom() -> Path:
    return phantom_series(1, slices=64, rows=128)


@pytest.fixture(scope="session")
def phantom_volume(small_phantom: Path) -> Volume:
    return load_ct(small_phantom)
