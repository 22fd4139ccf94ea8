"""The workspace while an attempt runs: pictures, rail, bull's-eye; all else is put away meanwhile.

What was put away comes back when the attempt is over, as it was, and before that for as long as
somebody asks for it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Protocol

from PySide6.QtCore import QObject
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QLabel, QWidget

from app.exercises.reading import LayoutName
from app.views.exercise.attempt_rail import AttemptRail
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.panel import ExercisePanel
from app.views.exercise.scan_view import ScanView
from app.views.exercise.status import StatusStrip
from app.views.exercise.steps import NextStepLine
from app.views.kit.side_panel import SidePanel
from app.views.kit.text import keys_text, tr
from app.views.reading.layouts import (
    ATTEMPT,
    BULLSEYE,
    SCAN,
    SCENE,
    Layout,
    ViewGrid,
    attempt_layout,
)
from app.views.scene.view import SceneView

PANELS_KEY: Final = "Ctrl+B"
PICTURES_KEY: Final = "Ctrl+T"


class LendsScan(Protocol):
    """The cell that has the control scan while no attempt has the room."""

    def lend_scan(self) -> None:
        """Let somebody else show the control scan."""

    def take_scan_back(self) -> None:
        """Show the control scan again."""


class Furniture(Protocol):
    """The workspace's parts that an attempt puts away or arranges anew."""

    layout_name: str
    has_bullseye: bool
    has_more_than_scan: bool
    is_left_handed: bool
    grid: ViewGrid
    side: SidePanel
    scene: SceneView
    bullseye: Bullseye
    scan_view: ScanView
    exercise_panel: ExercisePanel
    status: StatusStrip
    next_step: NextStepLine
    disclaimer: QLabel

    @property
    def needle_cell(self) -> LendsScan:
        """The cell that has the control scan otherwise."""

    def arrange(self) -> None:
        """Arrange the panes as the layout is now."""


@dataclass(frozen=True, slots=True)
class PutAway:
    """How the workspace was.

    Attributes:
        panel: number of the side panel in front.
        layout: name of the layout.
        bullseye: whether it had the bull's-eye's cell.
        maximised: the pane that had the whole room, if one had.
    """

    panel: int
    layout: str
    bullseye: bool
    maximised: QWidget | None


class AttemptRoom(QObject):
    """Puts panels and words away for an attempt, and brings them back.

    Args:
        page: the workspace's parts.
        host: the widget that they lie in; its keys are the room's.
        rail: shown beside the pictures meanwhile.

    Attributes:
        is_on: whether an attempt has the room.
        is_open: whether the panels are back although it has.
        shows_scan: whether the control scan has the place of the live pictures.
    """

    def __init__(self, page: Furniture, host: QWidget, rail: AttemptRail) -> None:
        super().__init__(host)
        self._page, self._host, self.rail = page, host, rail
        self.is_on = self.is_open = self.shows_scan = False
        self._own, self._live = "", True
        self._was: PutAway | None = None
        self._panels = self._key(PANELS_KEY, self.toggle_panels)
        self._pictures = self._key(PICTURES_KEY, self.toggle_scan)
        rail.panel_wanted.connect(self.toggle_panels)
        rail.pictures_wanted.connect(self.toggle_scan)
        page.scan_view.arrived.connect(self._take_scan)

    def _key(self, keys: str, command: Callable[[], None]) -> QShortcut:
        shortcut = QShortcut(QKeySequence(keys), self._host)
        shortcut.setAutoRepeat(False)
        shortcut.activated.connect(command)
        shortcut.setEnabled(False)
        return shortcut

    # --- beginning and end ------------------------------------------------------------------------
    def begin(self, own: str = "", live: bool = True) -> None:
        """Give an attempt the room; does nothing while one has it.

        Args:
            own: name of the layout that the exercise itself chose; empty where it chose none.
            live: whether the needle is shown live; else control scans guide.
        """
        self.rail.begin()
        if self.is_on:
            return
        page = self._page
        self._was = PutAway(
            page.side.currentIndex(), page.layout_name, page.has_bullseye, page.grid.maximised
        )
        self._own, self._live = own, live
        self.is_on, self.is_open, self.shows_scan = True, False, False
        page.needle_cell.lend_scan()
        page.grid.add(SCAN, page.scan_view)
        page.exercise_panel.lend_tools(True)
        page.bullseye.set_plain(True)
        self._show()

    def end(self) -> None:
        """Bring everything back as it was; idempotent."""
        if not self.is_on or self._was is None:
            return
        page, was = self._page, self._was
        self.is_on, self.is_open, self.shows_scan, self._was = False, False, False, None
        page.grid.remove(SCAN)
        page.needle_cell.take_scan_back()
        page.exercise_panel.lend_tools(False)
        page.bullseye.set_plain(False)
        page.layout_name, page.has_bullseye = was.layout, was.bullseye
        page.side.setCurrentIndex(was.panel)
        self._show()
        if was.maximised is not None:
            page.grid.toggle(was.maximised)

    # --- meanwhile --------------------------------------------------------------------------------
    def toggle_panels(self) -> None:
        """Bring the panels back while the attempt runs, or put them away again."""
        if self.is_on:
            self.is_open = not self.is_open
            if self.is_open:
                page = self._page
                page.side.setCurrentWidget(page.exercise_panel)
            self._show()

    def toggle_scan(self) -> None:
        """Show the live pictures in place of the control scan, or that again."""
        if self.is_on and self._page.scan_view.scan is not None:
            self.shows_scan = not self.shows_scan
            self._show()

    def _take_scan(self) -> None:
        if self.is_on:
            self.shows_scan = True
            self._show()

    def choose(self, name: str) -> None:
        """Show the slices of another layout in this attempt."""
        self._own, self.shows_scan = name, False

    def layout(self) -> Layout:
        """Return how the panes are arranged now."""
        page = self._page
        # The scan has the place of the slices here: where its cell held nothing else, it is empty.
        beside = [BULLSEYE] if page.has_more_than_scan else []
        if not page.scene.off:
            beside.append(SCENE)
        return attempt_layout(self.layout_name, tuple(beside), page.is_left_handed)

    @property
    def layout_name(self) -> str:
        """Return the name of the layout whose slices are shown; one that is in no menu where the
        attempt chose them itself.
        """
        if self.shows_scan:
            return SCAN
        return self._own or (ATTEMPT if self._live else LayoutName.FOUR)

    def suit_window(self) -> None:
        """Take the room that the window has now."""
        self.rail.suit_window(self._host.width())

    def _show(self) -> None:
        page, on = self._page, self.is_on
        put_away = on and not self.is_open
        self._panels.setEnabled(on)
        self._pictures.setEnabled(on)
        self.suit_window()
        self.rail.setVisible(on)
        page.side.setVisible(not put_away)
        page.status.setVisible(not put_away)
        page.disclaimer.setVisible(not on)  # the rail has it, and the order
        page.next_step.set_aside(on)
        self.rail.panel.setText(
            tr("Put panels away ({key})", key=keys_text(PANELS_KEY))
            if self.is_open
            else tr("All panels ({key})", key=keys_text(PANELS_KEY))
        )
        self.rail.pictures.setVisible(on and page.scan_view.scan is not None)
        self.rail.pictures.setText(
            tr("Live pictures ({key})", key=keys_text(PICTURES_KEY))
            if self.shows_scan
            else tr("Control scan again ({key})", key=keys_text(PICTURES_KEY))
        )
        page.arrange()
