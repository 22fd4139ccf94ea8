"""The plan in the window: its points, the position, whether the robot can follow, its files.

Nothing is lost without a question.
"""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from PySide6.QtCore import QSignalBlocker, SignalInstance
from PySide6.QtWidgets import (
    QComboBox,
    QDoubleSpinBox,
    QGridLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from app.planning.placement import PatientOrientation, Placement
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.coordinates import lps_words
from app.views.kit.menu_entries import add_entries, add_recent
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel
from app.views.kit.roles import EVERYBODY, STAFF, Role
from app.views.kit.text import literal, tr
from app.views.plan.editor import PlanEditor, PlanFiles, Point
from app.views.plan.verdict import PlannedWay, verdict_words
from app.views.plan.way import WayWatch
from app.views.shell.feature import Context, Feature
from app.views.shell.settings import Recents
from app.views.slices.viewing import Tool, Viewing


def left_slice_words(editor: PlanEditor, viewing: Viewing) -> str:
    """Say how far the entry lies out of the slice in which it was clicked; empty for within it."""
    moved, pane = editor.from_click_mm, viewing.clicked_pane
    plane = None if pane is None else viewing.plane(pane)
    if moved is None or plane is None:
        return ""
    out = abs(sum(a * b for a, b in zip(moved, plane.ahead, strict=True)))
    if out <= max(plane.half_slab_mm, plane.step_mm / 2.0):
        return ""
    return tr(
        "The skin next to your click is {distance:.1f} mm out of the slice you clicked in: the "
        "entry lies in another one.",
        distance=out,
    )


class PlanPanel(QWidget):
    """Shows the editor's plan and turns clicks into edits; its files are in the menu."""

    def __init__(self, editor: PlanEditor, viewing: Viewing, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._editor, self._viewing, self._way = editor, viewing, PlannedWay()
        self.title = _label("heading")
        self.entry, self.target, self.length = _label(), _label(), _label("dim")
        self.length.setWordWrap(True)
        self.left_slice = _label("dim")
        self.left_slice.setWordWrap(True)
        self.place_entry = _button(tr("Place  E"), checkable=True)
        self.place_target = _button(tr("Place  T"), checkable=True)
        self.place_entry.setToolTip(tr("Then click near the skin in any view (key E)"))
        self.place_target.setToolTip(tr("Then click inside the patient in any view (key T)"))
        self.orientation = _orientation_box()
        self.turns = tuple(_angle_box(axis) for axis in "xyz")
        self.verdict = PlainLabel(self)
        self.verdict.setWordWrap(True)
        self.remedy = _button(tr("Apply suggested rotation"))
        self._lay_out()
        self._connect()
        self.refresh()

    # --- shown --------------------------------------------------------------------------------
    def refresh(self) -> None:
        """Show the editor's present state."""
        editor, draft, placement = (
            self._editor,
            self._editor.edit.draft,
            self._editor.edit.placement,
        )
        name = NAMES.shown(editor.name)
        self.title.setText(f"{name} •" if editor.dirty else name)
        self.title.setToolTip(tr("• unsaved changes") if editor.dirty else "")
        self.entry.setText(_point_text(draft.entry_mm))
        self.left_slice.setText(left_slice_words(editor, self._viewing))
        self.left_slice.setVisible(bool(self.left_slice.text()))
        self.target.setText(_point_text(draft.target_mm))
        self._show_placement(placement)
        words = verdict_words(editor, self._way)
        colour, symbol = theme.VERDICTS.get(words.kind, (theme.TEXT, "…"))
        self.verdict.setText(f"{symbol}  {words.text}")
        self.verdict.setStyleSheet(f"color: {colour};")
        self.length.setText(words.measures)
        self.remedy.setVisible(words.remedy)
        for widget in (
            self.place_entry,
            self.place_target,
            self.remedy,
            self.orientation,
            *self.turns,
        ):
            widget.setEnabled(not editor.locked)

    def show_way(self, way: PlannedWay) -> None:
        """Say what is known of what lies on the way."""
        self._way = way
        self.refresh()

    def _show_placement(self, placement: Placement) -> None:
        with QSignalBlocker(self.orientation):
            index = self.orientation.findData(placement.orientation.value)
            self.orientation.setCurrentIndex(index)
        for box, angle in zip(self.turns, placement.rotation_deg, strict=True):
            if not box.hasFocus() or abs(box.value() - angle) > 0.05:
                with QSignalBlocker(box):
                    box.setValue(angle)

    def _show_tool(self) -> None:
        tool = self._viewing.tool
        self.place_entry.setChecked(tool is Tool.ENTRY)
        self.place_target.setChecked(tool is Tool.TARGET)

    # --- wanted -------------------------------------------------------------------------------
    def _placement_wanted(self) -> None:
        x, y, z = (box.value() for box in self.turns)
        orientation = PatientOrientation(self.orientation.currentData())
        self._editor.set_placement(Placement(orientation, (x, y, z)))

    def _tool_wanted(self, tool: Tool, on: bool) -> None:
        self._viewing.set_tool(tool if on else Tool.NAVIGATE)
        self._show_tool()

    def _connect(self) -> None:
        self._editor.changed.connect(self.refresh)
        self._viewing.tool_changed.connect(self._show_tool)
        self.place_entry.clicked.connect(lambda on: self._tool_wanted(Tool.ENTRY, on))
        self.place_target.clicked.connect(lambda on: self._tool_wanted(Tool.TARGET, on))
        self.orientation.activated.connect(lambda _: self._placement_wanted())
        for box in self.turns:
            box.valueChanged.connect(lambda _: self._placement_wanted())
        self.remedy.clicked.connect(self._editor.apply_remedy)

    # --- layout -------------------------------------------------------------------------------
    def _lay_out(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.MARGIN, theme.SPACING, theme.MARGIN, theme.SPACING)
        column.setSpacing(theme.SPACING)
        column.addWidget(self.title)
        column.addLayout(self._points())
        column.addWidget(self.left_slice)
        column.addWidget(self.length)
        column.addLayout(self._position())
        column.addWidget(self.verdict)
        column.addWidget(self.remedy)
        column.addStretch(1)

    def _points(self) -> QGridLayout:
        grid = QGridLayout()
        grid.setColumnStretch(0, 1)
        rows = (
            (theme.ENTRY, "○", tr("Entry"), self.entry, self.place_entry),
            (theme.TARGET, "◉", tr("Target"), self.target, self.place_target),
        )
        for row, (mark, symbol, name, value, button) in enumerate(rows):
            head = PlainLabel(f"{symbol}  {name}")
            head.setStyleSheet(f"color: {theme.now(mark.colour)}; font-weight: 600;")
            grid.addWidget(head, 2 * row, 0)
            grid.addWidget(button, 2 * row, 1)
            grid.addWidget(value, 2 * row + 1, 0, 1, 2)
        return grid

    def _position(self) -> QGridLayout:
        grid = QGridLayout()
        heading = _label("heading")
        heading.setText(tr("Patient position"))
        grid.addWidget(heading, 0, 0, 1, 3)
        grid.addWidget(self.orientation, 1, 0, 1, 3)
        for column, box in enumerate(self.turns):
            grid.addWidget(box, 2, column)
            grid.setColumnStretch(column, 1)
        return grid


def orientation_names() -> dict[PatientOrientation, str]:
    """Names of the positions for people."""
    return {
        PatientOrientation.SUPINE: tr("Supine (on the back)"),
        PatientOrientation.PRONE: tr("Prone (on the belly)"),
        PatientOrientation.LEFT_DOWN: tr("Left side down"),
        PatientOrientation.RIGHT_DOWN: tr("Right side down"),
    }


def _point_text(point: Point | None) -> str:
    if point is None:
        return tr("not placed yet")
    return lps_words(point)


def _orientation_box() -> QComboBox:
    box = QComboBox()
    for orientation, name in orientation_names().items():
        box.addItem(name, orientation.value)
    box.setAccessibleName(tr("Patient position"))
    return box


def _angle_box(axis: str) -> QDoubleSpinBox:
    box = QDoubleSpinBox()
    box.setRange(-180.0, 180.0)
    box.setDecimals(1)
    box.setSingleStep(1.0)
    box.setPrefix(f"{axis} ")
    box.setSuffix(" °")
    box.setKeyboardTracking(False)
    box.setMinimumSize(70, theme.CONTROL_HEIGHT)
    box.setAccessibleName(tr("Patient position") + f" {axis}")
    box.setToolTip(
        literal(tr("Free rotation about the robot's {axis} axis (rotation vector)", axis=axis))
    )
    return box


def _label(role: str = "") -> QLabel:
    label = PlainLabel()
    label.setProperty("role", role)
    return label


def _button(text: str, checkable: bool = False) -> QPushButton:
    button = QPushButton(text)
    button.setCheckable(checkable)
    button.setStyleSheet("padding: 4px 6px;")
    button.setMinimumWidth(48)
    return button


SUFFIX = ".mrk.json"


class PlanFeature(Feature):
    """Panel, menu entries and files of the plan."""

    topic: ClassVar[str] = "plan"
    place: ClassVar[int] = 30
    roles: ClassVar[frozenset[Role]] = EVERYBODY

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._editor, viewing, shell = context.editors.plan, context.views.viewing, context.shell
        recents = Recents(shell.settings, "recent/plans")
        self.files = files = PlanFiles(self._editor, recents, shell.dialog_parent)
        files.failed.connect(self.failed)
        files.noted.connect(self.noted)
        self.panel = PlanPanel(self._editor, viewing)
        shell.add_panel(self.panel, tr("Plan"))
        self.way = WayWatch(context, self)
        context.conductor.controller.began.connect(lambda _: self._note_attempt())
        self.way.changed.connect(lambda: self.panel.show_way(self.way.way))
        with shell.made_for(STAFF):
            self._add_files(recents)
        shell.add_keys(
            [
                (tr("Place entry"), "E", lambda: viewing.set_tool(Tool.ENTRY)),
                (tr("Place target"), "T", lambda: viewing.set_tool(Tool.TARGET)),
            ]
        )

    def _add_files(self, recents: Recents) -> None:
        """Add what opens and saves plans to the menu of files."""
        menu, files = self.context.shell.menu(tr("&File")), self.files
        add_entries(
            menu,
            [
                (tr("New plan"), "Ctrl+N", files.new),
                (tr("Open plan…"), "Ctrl+Shift+O", files.ask_open),
            ],
        )
        add_recent(menu, tr("Recent plans"), recents.paths, files.open)
        add_entries(
            menu,
            [
                (tr("Save plan"), "Ctrl+S", files.save),
                (tr("Save plan as…"), "Ctrl+Shift+S", files.save_as),
            ],
        )

    def _note_attempt(self) -> None:
        run = self.context.conductor.controller.run
        if run is not None and not run.demonstrates:
            self._editor.note_attempt()

    # --- what the window asks -----------------------------------------------------------------
    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.noted,)

    def suit_room(self) -> None:
        """Write the panel anew: names are hidden, or shown again."""
        self.panel.refresh()

    def unsaved(self) -> str:
        """Say that the plan has unsaved changes; empty where it has none."""
        if not self._editor.dirty:
            return ""
        name = NAMES.shown(self._editor.name)
        if ACCESS.role is Role.STUDENT:
            made = tr("the plan “{name}”, which no attempt has", name=name)
            return "" if self._editor.attempted else made
        return tr("the plan “{name}”, which has unsaved changes", name=name)

    def save(self) -> bool:
        """Write the plan to its file, or ask for one; return whether it was written."""
        return self.files.save()

    def opens(self, path: Path) -> bool:
        """Open a dropped plan."""
        if path.suffix != ".json":
            return False
        self.files.open(path)
        return True

    def may_go(self) -> bool:
        """Ask whether unsaved changes may go, or save them; True where there are none."""
        return self.files.after_question(lambda: None)

    def close(self) -> None:
        """End what looks up the way; idempotent."""
        self.way.close()
