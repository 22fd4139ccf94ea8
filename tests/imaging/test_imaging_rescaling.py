"""Memory for a volume."""

import numpy as np
import pytest

from app.imaging.errors import SeriesRefusedError
from app.imaging.rescaling import fresh_array


def test_a_fresh_array_can_be_written_and_keeps_its_memory():
    array = fresh_array((2, 3, 4), np.dtype(np.float32))
    array[...] = 5.0
    assert array.shape == (2, 3, 4)
    assert array.sum() == 120.0


def test_a_volume_beyond_all_memory_is_refused_in_words():
    with pytest.raises(SeriesRefusedError, match="GB of memory"):
        fresh_array((1 << 20, 1 << 16, 1 << 16), np.dtype(np.int16))
