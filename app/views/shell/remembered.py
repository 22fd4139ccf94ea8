"""What the window remembers of itself: size, place, how one works, how one reads each exercise."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from PySide6.QtCore import QSettings, QSize
from PySide6.QtWidgets import QWidget

from app.core.errors import AcusError
from app.exercises.locks import Lock
from app.imaging.window import WindowLevel
from app.views.exercise.conductor import Conductor
from app.views.reading.fixed_reading import apply, let_go
from app.views.reading.layouts import LAYOUTS
from app.views.reading.workspace import WorkspacePage
from app.views.shell.projector import Projector
from app.views.slices.bindings import SCHEMES
from app.views.slices.panes import PaneId
from app.views.slices.presentation import KINDS, THICKEST_MM, Presentation, Slab, Turn

SMALLEST = (900, 560)
PREFERRED = (1400, 900)

_UNUSABLE = (ValueError, TypeError, KeyError, AttributeError, AcusError)


class Remembered:
    """Keeps the state of one window in its settings file; what cannot be used is left.

    How one reads (window, layout, slabs, turns) is kept for each exercise, and once more for
    whatever comes next; how one works (mouse and keys, hand, projector, kept windows) for all.
    """

    def __init__(
        self,
        window: QWidget,
        settings: QSettings,
        workspace: WorkspacePage,
        conductor: Conductor,
        projector: Projector,
    ) -> None:
        self._window, self._settings = window, settings
        self._workspace, self._conductor, self._projector = workspace, conductor, projector
        self._exercise = ""

    def restore(self) -> None:
        """Give the window what was remembered."""
        window, settings = self._window, self._settings
        window.setMinimumSize(*SMALLEST)
        wanted, available = QSize(*PREFERRED), window.screen().availableGeometry().size()
        window.resize(wanted.boundedTo(available))
        geometry = settings.value("window/geometry")
        if geometry is not None:
            window.restoreGeometry(geometry)
        self._take("work", self._set_work)
        self._take("reading", lambda state: set_reading(self._workspace, state))

    def remember(self) -> None:
        """Keep everything."""
        self._settings.setValue("window/geometry", self._window.saveGeometry())
        self._settings.setValue("work", json.dumps(self._work()))
        self._keep_reading()
        self._settings.sync()

    def follow(self, exercise: str) -> None:
        """Keep how the last exercise was read, and read this one as it was read before.

        What the exercise itself says of that counts the first time, and always where it locks it.
        """
        if exercise == self._exercise:
            return
        if self._exercise:
            self._keep_reading()
        self._exercise = exercise
        workspace, key = self._workspace, f"exercises/{exercise}"
        let_go(workspace)
        self._take(key, lambda state: set_reading(workspace, state))
        taken = self._conductor.exercise
        if taken is None:
            return
        held = taken.reading.locked or Lock.READING in taken.locked
        if held or self._settings.value(key) is None:
            apply(workspace, taken)

    def _keep_reading(self) -> None:
        state = json.dumps(reading(self._workspace))
        self._settings.setValue("reading", state)
        if self._exercise:
            self._settings.setValue(f"exercises/{self._exercise}", state)

    def _take(self, key: str, take: Callable[[Mapping[str, Any]], None]) -> None:
        stored = self._settings.value(key)
        if stored is None:
            return
        try:
            take(json.loads(str(stored)))
        except _UNUSABLE:  # written by hand or by another version: as if there were nothing
            return

    def _work(self) -> dict[str, Any]:
        projector, viewing = self._projector, self._workspace.viewing
        return {
            "scheme": viewing.scheme.name,
            "reversed": viewing.level_reversed,
            "left_handed": self._workspace.is_left_handed,
            "traces": viewing.shows_traces,
            "moves_hub": self._workspace.bullseye.source.own_moves_hub,
            "legend": self._workspace.bullseye.legend.isChecked(),
            "detailed": self._workspace.status.is_detailed,
            "light": projector.is_light,
            "large": projector.is_large,
            "kept": {name: [w.width, w.level] for name, w in viewing.greys.kept.items()},
        }

    def _set_work(self, state: Mapping[str, Any]) -> None:
        workspace, viewing = self._workspace, self._workspace.viewing
        viewing.level_reversed = bool(state["reversed"])
        viewing.set_scheme(SCHEMES[state["scheme"]])
        viewing.set_shows_traces(bool(state["traces"]))
        workspace.set_left_handed(bool(state["left_handed"]))
        workspace.bullseye.source.set_moves_hub(bool(state["moves_hub"]))
        workspace.bullseye.legend.setChecked(bool(state["legend"]))
        workspace.status.set_detailed(bool(state["detailed"]))
        for name, (width, level) in state["kept"].items():
            viewing.greys.keep(str(name), WindowLevel(float(width), float(level)))
        self._projector.set(light=bool(state["light"]), large=bool(state["large"]))


def show_as_remembered(window: QWidget, settings: QSettings) -> None:
    """Show a window as large as it was; at a first start over the whole screen, because frames and
    bars of a desktop are known only then, and what is below the screen cannot be read.
    """
    if settings.value("window/geometry") is None:
        window.showMaximized()
    else:
        window.show()


def reading(workspace: WorkspacePage) -> dict[str, Any]:
    """Return how the slices are read now, as JSON can hold it."""
    viewing, greys = workspace.viewing, workspace.viewing.greys
    presentations = {}
    for pane in PaneId:
        presentation = viewing.presentation(pane)
        slab, turn = presentation.slab, presentation.turn
        if presentation != Presentation():
            presentations[str(pane)] = [slab.kind, slab.thickness_mm, turn.quarters, turn.mirrored]
    return {
        "window": [greys.common.width, greys.common.level],
        "linked": greys.is_linked,
        "inverted": greys.is_inverted,
        "layout": workspace.layout_name,
        "looks": presentations,
        "locked": greys.is_locked and not greys.is_fixed,
    }


def set_reading(workspace: WorkspacePage, state: Mapping[str, Any]) -> None:
    """Read as a state says.

    Raises:
        ValueError, TypeError, KeyError, AcusError: if it is not one; nothing has changed then.
    """
    window = WindowLevel(*(float(value) for value in state["window"]))
    presentations = {
        PaneId(name): _presentation(*values) for name, values in state["looks"].items()
    }
    layout, viewing = state["layout"], workspace.viewing
    if layout not in LAYOUTS:
        raise ValueError(f"there is no layout {layout}")
    greys = viewing.greys
    greys.set_locked(False)
    greys.set_linked(bool(state["linked"]))
    viewing.set_window(window)
    greys.set_locked(bool(state["locked"]))
    greys.set_inverted(bool(state["inverted"]))
    for pane in PaneId:
        viewing.set_presentation(pane, presentations.get(pane, Presentation()))
    workspace.show_layout(layout)


def _presentation(kind: str, thickness_mm: float, quarters: int, mirrored: bool) -> Presentation:
    if kind not in KINDS or not 0.0 <= thickness_mm <= THICKEST_MM or quarters not in range(4):
        raise ValueError("not a presentation")
    return Presentation(Slab(kind, float(thickness_mm)), Turn(int(quarters), bool(mirrored)))
