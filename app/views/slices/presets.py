"""The windows to choose from, with their keys and their names in the user's language."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.imaging.volume import Volume
from app.imaging.window import FROM_DICOM, FROM_VALUES, MINIMUM_WIDTH, PRESETS, WindowLevel, presets
from app.views.kit.text import tr

KEYED = (
    "Soft tissue", "Lung", "Bone", "Brain", "Mediastinum", "Liver", "Angio", "Spine", "Needle",
)  # fmt: skip
"""Presets with a digit as their key: 1 to 4 as in OHIF, then what a puncture needs."""

OWN_KEY = 0
"""Digit of the file's own window; once more for its next one."""

NOTHING_KEPT: Mapping[str, WindowLevel] = MappingProxyType({})


def preset_name(name: str) -> str:
    """Name of a preset for people."""
    known = {
        "Soft tissue": tr("Soft tissue"),
        "Lung": tr("Lung"),
        "Bone": tr("Bone"),
        "Liver": tr("Liver"),
        "Mediastinum": tr("Mediastinum"),
        "Brain": tr("Brain"),
        "Angio": tr("Angio"),
        "Spine": tr("Spine"),
        "Needle": tr("Needle"),
        FROM_VALUES: tr("From values"),
    }
    if name.startswith(FROM_DICOM):
        return tr("From DICOM") + name.removeprefix(FROM_DICOM)
    return known.get(name, name)


def menu_windows(
    volume: Volume | None, kept: Mapping[str, WindowLevel] = NOTHING_KEPT
) -> list[tuple[str, str, WindowLevel]]:
    """Name, key (or nothing) and window of every choice.

    The files' own come first, then the presets in the order of their keys, then those that the
    user has kept.
    """
    choices = dict(PRESETS if volume is None else presets(volume))
    keys = {name: str(number) for number, name in enumerate(KEYED, start=1)}
    own = [name for name in choices if name.startswith(FROM_DICOM)]
    if own:
        keys[own[0]] = str(OWN_KEY)
    order = [*own, *(name for name in KEYED if name in choices)]
    order += [name for name in choices if name not in order]
    rows = [(preset_name(name), keys.get(name, ""), choices[name]) for name in order]
    return rows + [(name, "", window) for name, window in kept.items()]


def keyed_window(
    digit: int, volume: Volume | None = None, present: WindowLevel | None = None
) -> WindowLevel | None:
    """Window of key 1 … 9, or with 0 the files' own that follows the present one."""
    if digit != OWN_KEY:
        return PRESETS[KEYED[digit - 1]] if 1 <= digit <= len(KEYED) else None
    choices = {} if volume is None else presets(volume)
    own = [window for name, window in choices.items() if name.startswith(FROM_DICOM)]
    if not own:
        return None
    return own[(own.index(present) + 1) % len(own)] if present in own else own[0]


def default_window() -> WindowLevel:
    """Window that a volume is shown in at first: soft tissue."""
    return PRESETS[KEYED[0]]


def best_window(hu: NDArray[Any]) -> WindowLevel | None:
    """Window for what a box holds: from the 1st to the 99th percentile; None for an empty box."""
    if hu.size == 0:
        return None
    low, high = (float(value) for value in np.percentile(hu, (1.0, 99.0)))
    return WindowLevel(max(MINIMUM_WIDTH, high - low), 0.5 * (low + high))
