"""Window and level: Hounsfield values to grey (DICOM PS3.3 C.11.2.1.2, linear)."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.errors import NumericalError
from app.core.messages import sentence
from app.imaging.volume import Volume

MINIMUM_WIDTH: Final = 1.0
"""Smallest window width that the standard allows [HU]."""

_LIMIT: Final = 1e6


@dataclass(frozen=True, slots=True)
class WindowLevel:
    """A linear window.

    Attributes:
        width: range of values spread over all grey levels [HU], at least 1.
        level: value at the middle of it [HU].

    Raises:
        NumericalError: if either is not finite or the width is below 1.
    """

    width: float
    level: float

    def __post_init__(self) -> None:
        if not (MINIMUM_WIDTH <= self.width <= _LIMIT and abs(self.level) <= _LIMIT):
            raise NumericalError(
                sentence(
                    "window width {width} / level {level} HU: the width must be "
                    "{minimum_width:g} to {limit:g} and the level within ±{limit:g}",
                    width=self.width,
                    level=self.level,
                    minimum_width=MINIMUM_WIDTH,
                    limit=_LIMIT,
                )
            )

    def dragged(self, width_change: float, level_change: float) -> "WindowLevel":
        """Window after a drag by these amounts [HU], kept within what is allowed."""
        width = min(max(self.width + width_change, MINIMUM_WIDTH), _LIMIT)
        return WindowLevel(width, min(max(self.level + level_change, -_LIMIT), _LIMIT))


FROM_DICOM: Final = "From DICOM"
"""Name of the window that the files themselves ask for."""

FROM_VALUES: Final = "From values"
"""Name of the window that shows most of the values of a volume without a unit."""

PRESETS: Final[dict[str, WindowLevel]] = {
    "Soft tissue": WindowLevel(400, 40),
    "Lung": WindowLevel(1500, -600),
    "Bone": WindowLevel(1800, 400),
    "Liver": WindowLevel(150, 60),
    "Mediastinum": WindowLevel(350, 50),
    "Brain": WindowLevel(80, 40),
    "Angio": WindowLevel(600, 200),
    "Spine": WindowLevel(250, 50),
    "Needle": WindowLevel(3000, 600),
}
"""Width and level [HU] by name, the first being the default."""


def presets(volume: Volume) -> dict[str, WindowLevel]:
    """Windows to choose from for a volume: those of its files first, then `PRESETS`.

    Of values without a unit no preset holds: instead of them stands the range of most values.
    """
    own = [WindowLevel(*pair) for pair in volume.series.windows if pair[0] <= _LIMIT]
    names = [FROM_DICOM, *(f"{FROM_DICOM} {n}" for n in range(2, len(own) + 1))]
    found = dict(zip(names, own, strict=False))
    return found | PRESETS if volume.unit == "HU" else {FROM_VALUES: _range(volume), **found}


def _range(volume: Volume) -> WindowLevel:
    """Window of the values but the lowest and the highest 2 %, of every fourth voxel."""
    low, high = np.percentile(volume.hu[::4, ::4, ::4], (2.0, 98.0)).tolist()
    return WindowLevel(min(max(high - low, MINIMUM_WIDTH), _LIMIT), (low + high) / 2.0)


def to_grey(hu: NDArray[Any], window: WindowLevel) -> NDArray[np.uint8]:
    """Grey levels 0 to 255 of Hounsfield values, any shape, int16 or float32.

    C.11.2.1.2: y = ((x - (c - 0.5)) / (w - 1) + 0.5) * 255, clamped; rounded to nearest.
    """
    if hu.dtype == np.int16:
        return np.take(grey_table(window), hu.view(np.uint16))
    return _linear(hu.astype(np.float32, copy=False), window)


@lru_cache(maxsize=16)
def grey_table(window: WindowLevel) -> NDArray[np.uint8]:
    """Grey level of each int16 value, indexed by its bits as unsigned."""
    values = np.arange(65536, dtype=np.uint16).view(np.int16)
    table = _linear(values.astype(np.float32), window)
    table.setflags(write=False)
    return table


def _linear(values: NDArray[np.float32], window: WindowLevel) -> NDArray[np.uint8]:
    span = window.width - 1.0
    if span < 1e-3:  # width 1: a step at the level (C.11.2.1.2.1)
        return np.where(values > window.level - 0.5, 255, 0).astype(np.uint8)
    scaled = (values - np.float32(window.level - 0.5)) * np.float32(255.0 / span)
    scaled += np.float32(127.5 + 0.5)  # and half a grey level, as the cast truncates
    np.clip(scaled, 0.0, 255.0, out=scaled)
    return scaled.astype(np.uint8)
