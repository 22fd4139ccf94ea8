"""The page where one works: panes on a grid in the middle, plan and exercise beside them, status
below.
"""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QResizeEvent, QShortcut
from PySide6.QtWidgets import (
    QBoxLayout,
    QHBoxLayout,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from app.core.units import MILLIMETRE
from app.exercises.parts import ViewName
from app.planning.draft import DraftPlan
from app.session.pad.view import rings
from app.session.shown_views import Shown
from app.views.exercise.axial_gauge import AxialGauge
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.controller import ExerciseViews
from app.views.exercise.panel import ExercisePanel
from app.views.exercise.scan_view import ScanView
from app.views.exercise.status import MessageList, StatusStrip
from app.views.exercise.steps import NextStepLine
from app.views.exercise.tracker_panel import TrackerPanel
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.side_panel import SidePanel
from app.views.plan.editor import PlanEditor
from app.views.reading.attempt_room import AttemptRoom
from app.views.reading.layouts import BULLSEYE, FOUR, SCENE, ViewGrid, chosen, possible
from app.views.reading.lock_words import off_words
from app.views.reading.patient_views import PatientViews
from app.views.scene.renderer import SceneRenderer
from app.views.scene.view import SceneView
from app.views.shell.shortcuts import disclaimer_label
from app.views.slices.needle_source import Along, NeedlePlanes, fill_needle_menu
from app.views.slices.pane import SlicePane
from app.views.slices.panes import MPR_PANES, NEEDLE_PANES
from app.views.slices.presets import default_window
from app.views.slices.turning import LineGrip, fill_turn_menu
from app.views.slices.two_points import TwoPoints
from app.views.slices.viewing import Tool, Viewing


class Cell(QWidget):
    """Gives a widget whose texts wrap the size of its cell, not the height it would like."""

    def __init__(self, content: QWidget) -> None:
        super().__init__()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(content)

    def hasHeightForWidth(self) -> bool:
        """Return False: the grid's shares decide."""
        return False


class NeedleCell(QWidget):
    """Holds all three; the bull's-eye stays where it moves a simulated hand, whatever it shows.

    Attributes:
        gauge: of the force along the needle, above the rest.
    """

    def __init__(self, bullseye: Bullseye, scan: ScanView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._bullseye, self._scan = bullseye, scan
        self._scanning = self._lent = False
        self.gauge = AxialGauge(self)
        self._row = row = QHBoxLayout()
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(scan, 2)
        row.addWidget(bullseye, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.gauge)
        column.addLayout(row, 1)
        self.gauge.hide()
        self.set_shown(scanning=False)

    def set_shown(
        self, scanning: bool, has_hand: bool = True, pad: bool = True, gauge: bool = False
    ) -> None:
        """Show what the exercise shows.

        Args:
            scanning: the control scan.
            has_hand: whether the bull's-eye moves a simulated hand: then it is there, if empty.
            pad: the bull's-eye.
            gauge: the force along the needle.
        """
        self._scanning = scanning
        if not self._lent:
            self._scan.setVisible(scanning)
        self._bullseye.setVisible((pad and not scanning) or has_hand)
        self.gauge.setVisible(gauge)

    def lend_scan(self) -> None:
        """Let somebody else show the control scan."""
        self._lent = True
        self._row.removeWidget(self._scan)

    def take_scan_back(self) -> None:
        """Show the control scan here again."""
        self._lent = False
        self._row.insertWidget(0, self._scan, 2)
        self._scan.setVisible(self._scanning)


SIDE_WIDTH = 376
_LEFT_TO_RIGHT, _RIGHT_TO_LEFT = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.RightToLeft


class WorkspacePage(QWidget):
    """Owns the panes and panels; what they do together stands in `Conductor`.

    Signals:
        arranged(): another layout, with or without the bull's-eye, or the other hand's.
    """

    arranged = Signal()
    room: AttemptRoom

    def __init__(self, editor: PlanEditor, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.viewing = Viewing(default_window(), self)
        self.panes = tuple(SlicePane(self.viewing, pane, self) for pane in MPR_PANES)
        self.needle_planes = NeedlePlanes(self.viewing, self)
        self.needle_panes = tuple(SlicePane(self.viewing, pane, self) for pane in NEEDLE_PANES)
        for pane in self.panes:
            pane.gestures.add_grip(LineGrip(pane.canvas))
            pane.menu_parts.append(lambda menu: fill_turn_menu(menu, self.viewing))
        self.two_points = TwoPoints(self.viewing, self.needle_planes, self)
        self.viewing.set_tolerances(tuple(ring / MILLIMETRE for ring in rings()))
        self.scene = SceneView(SceneRenderer(), self)
        self.bullseye = Bullseye(self)
        self.scan_view = ScanView(self.viewing, self)
        self.needle_cell = NeedleCell(self.bullseye, self.scan_view)
        panes: dict[str, QWidget] = {str(pane.pane): pane for pane in self.slices}
        self.grid = ViewGrid(panes | {SCENE: self.scene, BULLSEYE: Cell(self.needle_cell)}, self)
        self.layout_name, self.has_bullseye, self.is_left_handed = FOUR.name, False, False
        self._bar: QWidget | None = None
        self.is_layout_fixed = self.is_cell_fixed = False
        self.has_cell = self.has_more_than_scan = True
        for pane in self.slices:
            pane.maximise_wanted.connect(lambda pane=pane: self.grid.toggle(pane))
            pane.leave_wanted.connect(lambda on, pane=pane: self._go_on(pane, on))
        cell = self.grid.pane(BULLSEYE)
        self.scan_view.pane.maximise_wanted.connect(
            lambda: self.grid.toggle(self.scan_view if self.room.is_on else cell)
        )
        self._set_up_needle_panes()
        self.needle_planes.refused.connect(editor.refused)
        self.scene.maximise_wanted.connect(lambda: self.grid.toggle(self.scene))
        self.exercise_panel = ExercisePanel(self)
        self.tracker_panel = TrackerPanel(self)
        self.messages = MessageList(self)
        self.status = StatusStrip(self)
        self.status.detailed.connect(self._show_details)
        self.status.set_detailed(False)
        self.next_step = NextStepLine(self, lambda: self.side.is_shown(self.exercise_panel))
        hand = self.bullseye.source
        hand.turned.connect(lambda: self.next_step.set_moves_hub(hand.moves_hub))
        panel = self.exercise_panel
        panel.start_changed.connect(
            lambda: self.next_step.set_start(panel.may_start, panel.why_not)
        )
        self.side = SidePanel(self)
        self.side.setFixedWidth(SIDE_WIDTH)
        self.side.changed.connect(lambda _: self.next_step.follow_panel())
        self.disclaimer = disclaimer_label(self)
        self.rail = panel.rail
        self.rail.set_note(self.disclaimer.text())
        self.room = AttemptRoom(self, self, self.rail)
        self.next_step.spoken.connect(self.rail.order.say)
        self.next_step.stepped.connect(self.bullseye.show_step)
        self.status.shown.connect(self.rail.show_health)
        self._lay_out()
        self.exercise_panel.listen(self)
        start = QShortcut(QKeySequence(Qt.Key.Key_F5), self)
        start.setAutoRepeat(False)
        start.activated.connect(self.exercise_panel.press_start)

    @property
    def slices(self) -> tuple[SlicePane, ...]:
        """All slice panes of the planning CT, whether the layout shows them or not."""
        return (*self.panes, *self.needle_panes)

    @property
    def views(self) -> PatientViews:
        """Return where the patient is seen, for those who draw there."""
        return PatientViews(self.viewing, self.panes, self.needle_panes, self.scene)

    @property
    def exercise_views(self) -> ExerciseViews:
        """The widgets that the exercise controller feeds."""
        return ExerciseViews(
            self.bullseye,
            self.exercise_panel,
            self.status,
            self.tracker_panel,
            self.messages,
            self.needle_cell.gauge,
        )

    def _set_up_needle_panes(self) -> None:
        planes, viewing = self.needle_planes, self.viewing
        for pane in self.needle_panes:
            pane.canvas.seen.connect(self._watch_needle_panes)
            pane.menu_parts.append(lambda menu: fill_needle_menu(menu, planes, viewing))
        for pane in self.slices:
            self.two_points.show_in(pane)
        planes.changed.connect(self._show_needle_words)
        planes.changed.connect(self._show_two_points)
        self._show_needle_words()

    def _show_needle_words(self) -> None:
        planes = self.needle_planes
        for pane in self.needle_panes:
            pane.readouts.set_note(planes.words(), planes.laid_along)

    def _show_two_points(self) -> None:
        """Make room for a plane that was asked for while nobody sees the needle's panes."""
        seen = any(pane.isVisible() for pane in self.needle_panes)
        if self.needle_planes.along is Along.POINTS and self.isVisible() and not seen:
            self.show_layout("6-up")

    def _watch_needle_panes(self) -> None:
        seen = [pane.pane for pane in self.needle_panes if pane.isVisible()]
        self.needle_planes.set_watched(bool(seen))
        self.viewing.set_seen(seen)

    def setFocus(self, *reason: Qt.FocusReason) -> None:
        """Give the keyboard to the first pane; as its proxy the page would send Tab back to it."""
        self.panes[0].setFocus(*reason)

    # --- layouts ------------------------------------------------------------------------------
    @property
    def layouts(self) -> tuple[str, ...]:
        """Names of the layouts whose panes are all there."""
        return possible(self.grid.names)

    @property
    def shown_layout(self) -> str:
        """Return the name of the layout that is shown: in an attempt that of its own slices."""
        return self.room.layout_name if self.room.is_on else self.layout_name

    def show_layout(self, name: str) -> None:
        """Arrange the panes otherwise, unless they are fixed; the bull's-eye stays."""
        if not self.is_layout_fixed:
            self.layout_name = name if name in self.layouts else FOUR.name
            self.room.choose(self.layout_name)
        self.arrange()

    def share_room(self) -> None:
        """Let a pane that has the whole room share it again."""
        if self.grid.maximised is not None:
            self.arrange()

    def fix_layout(self, fixed: bool) -> None:
        """Keep the layout as it is for an exercise, or end that."""
        self.is_layout_fixed = fixed
        self.arranged.emit()

    def show_bullseye(self, shown: bool) -> None:
        """Give the bull's-eye's cell a place in the layout, or take it away, if there is anything
        in it and the exercise lets it go.
        """
        self.has_bullseye = self.has_cell and (shown or self.is_cell_fixed)
        self.arrange()

    def show_views(self, shown: Shown, has_hand: bool, why_fixed: str = "") -> None:
        """Show what an exercise shows, and nothing that it does not.

        Args:
            shown: says what.
            has_hand: whether there is a simulated hand to move.
            why_fixed: why the student cannot change it; empty where he can.
        """
        shows, scanning = shown.shows, not shown.live
        pad, gauge = shows(ViewName.BULLSEYE), shows(ViewName.FORCE_GAUGE)
        self.needle_cell.set_shown(scanning, has_hand, pad, gauge)
        self.has_cell = scanning or has_hand or pad or gauge
        self.has_more_than_scan = has_hand or (pad and not scanning) or gauge
        self.is_cell_fixed = bool(why_fixed)
        self.scene.set_off("" if shows(ViewName.THREE_D) else off_words(why_fixed))
        self.tracker_panel.set_off("" if shows(ViewName.CAMERAS) else off_words(why_fixed))
        if self.has_bullseye and not self.has_cell:
            self.show_bullseye(False)
        self.arranged.emit()

    def set_left_handed(self, left_handed: bool) -> None:
        """Put panel and panes where the left hand at the mouse leaves them free to see."""
        self.is_left_handed = left_handed
        self._row.setDirection(_RIGHT_TO_LEFT if left_handed else _LEFT_TO_RIGHT)
        self.arrange()

    def arrange(self) -> None:
        """Put the panes where layout, hand and attempt have them."""
        self.grid.arrange(
            self.room.layout()
            if self.room.is_on
            else chosen(self.layout_name, self.has_bullseye, self.is_left_handed, self.grid.names)
        )
        self.arranged.emit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Let the rail have its share of the new width."""
        super().resizeEvent(event)
        self.room.suit_window()

    def _go_on(self, pane: QWidget, on: bool) -> None:
        """Give the keyboard to the next pane that is shown, or to the previous one."""
        shown = [self.grid.pane(name) for name in self.grid.shown.panes]
        if self.grid.maximised is None and pane in shown:
            step = 1 if on else -1
            shown[(shown.index(pane) + step) % len(shown)].setFocus()

    # --- panels -------------------------------------------------------------------------------
    def show_exercise(self) -> None:
        """Bring the exercise panel and the bull's-eye to the front."""
        self.side.setCurrentWidget(self.exercise_panel)
        self.show_bullseye(True)

    def lead_by(self, bar: QWidget | None) -> None:
        """Let a bar stand where the next step is said, in its place; None brings that back."""
        if self._bar is not None and self._bar is not bar:
            self._bar.hide()
            self._right.removeWidget(self._bar)
        if bar is not None and self._bar is not bar:
            self._right.insertWidget(0, bar)
            bar.show()
        self._bar = bar
        self.next_step.give_way(bar is not None)

    def _show_details(self, detailed: bool) -> None:
        self.exercise_panel.energy.set_detailed(detailed)
        self.exercise_panel.readouts.set_detailed(detailed)
        self.exercise_panel.rail.force.set_detailed(detailed)
        self.arranged.emit()

    def show_cameras(self) -> None:
        """Bring the camera pictures to the front."""
        self.side.setCurrentWidget(self.tracker_panel)

    # --- patient and room ---------------------------------------------------------------------
    def forget(self) -> None:
        """Empty everything that belongs to the patient who leaves."""
        self.share_room()
        self.viewing.set_tool(Tool.NAVIGATE)
        self.viewing.set_needle(None)
        self.viewing.set_draft(DraftPlan())
        self.scene.set_surfaces(None)
        self.scene.set_needle(None)
        self.scene.set_plan(DraftPlan())
        self.scene.set_note("")
        self.exercise_panel.forget()
        self.bullseye.set_scene(None, False)
        self.needle_cell.gauge.show_force(None)
        self.tracker_panel.forget()
        self.status.show_items(())
        self.messages.clear()
        self.room.end()

    def suit_room(self) -> None:
        """Take another size of text, and hide the student's name or show it."""
        self.side.setFixedWidth(round(SIDE_WIDTH * theme.scale()))
        mode = QLineEdit.EchoMode.Password if NAMES.are_hidden else QLineEdit.EchoMode.Normal
        self.exercise_panel.student.setEchoMode(mode)
        self.bullseye.suit_text()
        self.next_step.suit_room()
        self.room.suit_window()
        self.viewing.plan_changed.emit()  # names of marks are as large as the text
        self.viewing.needle_changed.emit()
        self.messages.suit_room()

    def _lay_out(self) -> None:
        self._right = right = QVBoxLayout()
        right.setContentsMargins(0, 0, 0, 0)
        right.setSpacing(0)
        right.addWidget(self.next_step)
        right.addWidget(self.grid, 1)
        right.addWidget(self.disclaimer)
        self._row = row = QHBoxLayout()
        row.setSpacing(3)
        row.addWidget(self.side)
        row.addWidget(self.rail)
        row.addLayout(right, 1)
        page = QVBoxLayout(self)
        page.setContentsMargins(0, 0, 0, 0)
        page.setSpacing(0)
        page.addLayout(row, 1)
        page.addWidget(self.status)
