"""Windows: those to choose from, with keys and names, and which of them each pane has."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, Signal

from app.imaging.volume import Volume
from app.imaging.window import FROM_DICOM, FROM_VALUES, MINIMUM_WIDTH, PRESETS, WindowLevel, presets
from app.views.kit.text import tr
from app.views.slices.panes import PaneId

KEYED = (
    "Soft tissue",
    "Lung",
    "Bone",
    "Brain",
    "Mediastinum",
    "Liver",
    "Angio",
    "Spine",
    "Needle",
)
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
    volume: Volume | None, stored: Mapping[str, WindowLevel] = NOTHING_KEPT
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
    return rows + [(name, "", window) for name, window in stored.items()]


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


class Greys(QObject):
    """Window and level of every pane.

    Signals:
        changed(): some pane is to be drawn with other greys.
        refused(): somebody wished another window while it is locked.

    Attributes:
        common: window of the panes that have none of their own.
        is_linked: whether all panes share one window.
        is_locked: whether window and level stay as they are.
        is_fixed: whether the exercise has locked them: nobody else can unlock them then.
        is_inverted: whether what is dense is dark.
        kept: windows that the user has named.
    """

    changed = Signal()
    refused = Signal()

    def __init__(self, window: WindowLevel, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.common = window
        self.is_linked, self.is_locked, self.is_inverted = True, False, False
        self.is_fixed = False
        self.kept: dict[str, WindowLevel] = {}
        self._own: dict[PaneId, WindowLevel] = {}

    def of(self, pane: PaneId) -> WindowLevel:
        """Window of a pane."""
        return self._own.get(pane, self.common)

    def set(self, window: WindowLevel, pane: PaneId | None = None) -> None:
        """Take a window for all panes, or for one if each has its own."""
        if self.is_locked:
            self.refused.emit()
            return
        if self.is_linked or pane is None:
            changed = window != self.common or bool(self._own)
            self.common = window
            self._own.clear()
        else:
            changed = window != self.of(pane)
            self._own[pane] = window
        if changed:
            self.changed.emit()

    def set_linked(self, linked: bool) -> None:
        """Let all panes share one window from now on, or let each have its own."""
        self.is_linked = linked
        if linked and self._own:
            self._own.clear()
        self.changed.emit()

    def set_locked(self, locked: bool) -> None:
        """Keep window and level from being changed by a slip; not what the exercise has fixed."""
        if self.is_fixed:
            self.refused.emit()
        else:
            self.is_locked = locked
        self.changed.emit()

    def fix(self, fixed: bool) -> None:
        """Lock window and level for an exercise, or end that lock."""
        if fixed or self.is_fixed:
            self.is_fixed = self.is_locked = fixed
            self.changed.emit()

    def set_inverted(self, inverted: bool) -> None:
        """Show what is dense dark, or bright again."""
        self.is_inverted = inverted
        self.changed.emit()

    def keep(self, name: str, window: WindowLevel) -> None:
        """Give a window a name; one of this name that there was is replaced."""
        self.kept[name] = window
        self.changed.emit()

    def forget(self, name: str) -> None:
        """Take a name away."""
        self.kept.pop(name, None)
        self.changed.emit()
