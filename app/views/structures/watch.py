"""Keeps an eye on how far path and needle are from structures, and says so once each time."""

from __future__ import annotations

from time import monotonic

import numpy as np
from PySide6.QtCore import QObject, Signal

from app.core.events import Event
from app.planning.clearance import Nearness, PathClearance, clearances, worst
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.session.snapshot import Snapshot
from app.views.kit.text import tr
from app.views.kit.verdict import StatusItem, Verdict
from app.views.structures.book import StructureBook

PERIOD_S = 0.05
"""The live needle is measured at most this often."""

HYSTERESIS_MM = 1.0
"""Who was warned of is only warned of anew after it was this much further away."""


class StructureWatch(QObject):
    """Distances of path and needle.

    Signals:
        path_changed(): distances of the planned path are others.
        needle_changed(object): what the needle is too near to now, a `PathClearance`, or None.
        breached(Event): the needle came too near, or into a structure: once each time.
    """

    path_changed = Signal()
    needle_changed = Signal(object)
    breached = Signal(object)

    def __init__(self, book: StructureBook, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._book = book
        self._draft = DraftPlan()
        self.path: dict[str, PathClearance] = {}
        self.needle: PathClearance | None = None
        self._measured_at = -PERIOD_S
        self._told: dict[str, Nearness] = {}
        self._judges = False
        book.measured.connect(self._measure_path)
        book.changed.connect(self._measure_path)

    def set_draft(self, draft: DraftPlan) -> None:
        """Measure another path."""
        if draft != self._draft:
            self._draft = draft
            self._measure_path()

    def _measure_path(self) -> None:
        draft, self.path = self._draft, {}
        if draft.entry_mm is not None and draft.target_mm is not None:
            found = clearances(draft.entry_mm, draft.target_mm, self._book.fields)
            self.path = {one.structure.name: one for one in found}
        self.path_changed.emit()

    def set_needle(self, needle: NeedleOverlay | None) -> None:
        """Measure the live needle; one that is hidden, or not tracked, is not judged."""
        self._judges = needle is not None and needle.valid
        if needle is None or not needle.valid or not len(self._book.structures):
            self._show(None)
            return
        now = monotonic()
        if now - self._measured_at < PERIOD_S:
            return
        self._measured_at = now
        found = clearances(
            _near_end(needle), needle.tip_mm, self._book.fields, beyond_mm=2.0 * HYSTERESIS_MM
        )
        self._tell(found, now)
        self._show(worst(found))

    def _show(self, clearance: PathClearance | None) -> None:
        if clearance is not None or self.needle is not None:
            self.needle = clearance
            self.needle_changed.emit(clearance)

    def _tell(self, result: tuple[PathClearance, ...], now: float) -> None:
        for one in result:
            name, before = one.structure.name, self._told.get(one.structure.name, Nearness.FREE)
            if one.nearness is Nearness.FREE:
                if one.distance_mm > one.structure.warn_mm + HYSTERESIS_MM:
                    self._told.pop(name, None)
            elif one.nearness is not before and before is not Nearness.HIT:
                self._told[name] = one.nearness
                data = {"structure": name, "distance_mm": round(one.distance_mm, 2)}
                self.breached.emit(Event(now, "breach", words(one), data))

    def items(self, _: Snapshot) -> tuple[StatusItem, ...]:
        """Say it in the status strip; nothing without structures, or of a needle not shown."""
        if not len(self._book.structures) or not self._judges:
            return ()
        help_text = tr(
            "Smallest distance between the needle and a structure that warns. The "
            "Structures panel lists distances and kinds."
        )
        if self.needle is None:
            return (StatusItem(Verdict.GOOD, tr("Structures"), tr("clear"), help_text),)
        hit = self.needle.nearness is Nearness.HIT
        verdict = Verdict.BAD if hit else Verdict.WARNING
        return (StatusItem(verdict, tr("Structures"), words(self.needle), help_text),)


def words(clearance: PathClearance) -> str:
    """Say how near something is."""
    name = clearance.structure.name
    if clearance.nearness is Nearness.HIT:
        return tr(
            "needle in {name}, {depth:.1f} mm deep",
            name=name,
            depth=max(0.0, -clearance.distance_mm),
        )
    return tr("{distance:.1f} mm from {name}", distance=clearance.distance_mm, name=name)


def _near_end(needle: NeedleOverlay) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return np.asarray(needle.start_mm, np.float64)
