"""The windows to choose from, with their keys and their names in the user's language."""

from __future__ import annotations

from app.imaging.volume import Volume
from app.imaging.window import FROM_DICOM, PRESETS, WindowLevel, presets
from app.views.text import tr

KEYED = 9
"""Presets that have a digit as their key, in the order of `PRESETS`."""


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
    }
    if name.startswith(FROM_DICOM):
        return tr("From DICOM") + name.removeprefix(FROM_DICOM)
    return known.get(name, name)


def menu_windows(volume: Volume | None) -> list[tuple[str, str, WindowLevel]]:
    """Name, key (or nothing) and window of every choice, the files' own first."""
    keys = {name: str(number + 1) for number, name in enumerate(list(PRESETS)[:KEYED])}
    choices = PRESETS if volume is None else presets(volume)
    return [(preset_name(name), keys.get(name, ""), window) for name, window in choices.items()]


def keyed_window(digit: int) -> WindowLevel | None:
    """Window of key 1 … 9."""
    windows = list(PRESETS.values())[:KEYED]
    return windows[digit - 1] if 1 <= digit <= len(windows) else None


def default_window() -> WindowLevel:
    """Window that a volume is shown in at first: soft tissue."""
    return next(iter(PRESETS.values()))
