"""The registration check: each fiducial touched, or its bead picked in the CT; the result live.

The result is said large to everybody, its figures to technicians below, troubles between.
"""

from __future__ import annotations

from datetime import datetime
from typing import Protocol

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QCloseEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QDialog,
    QHBoxLayout,
    QHeaderView,
    QProgressBar,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.arrays import FloatArray
from app.core.confidence import covariance_radius
from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.imaging.volume import Volume
from app.planning.history import UndoHistory
from app.planning.registration import words
from app.planning.registration.check import RegistrationCheck
from app.planning.registration.draft import CheckDraft
from app.planning.registration.plate import load_plate, plate_names
from app.planning.registration.record import RegistrationRecord, Registrations, new_id, points_of
from app.session.touch import Touch
from app.views.checks.toucher import Toucher, move_there
from app.views.exercise.run import ExerciseRun
from app.views.kit import theme
from app.views.kit.parts import PlainLabel, size_dialog
from app.views.kit.text import begun, tr, translated

_STRETCHED = (1, 3)


class FiducialTable(QTableWidget):
    """One row per fiducial; the chosen row is the next to be touched or picked."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setTabKeyNavigation(False)
        titles = [
            tr("Fiducial"),
            tr("Tip: x  y  z [mm]"),
            tr("± 95 % [mm]"),
            tr("CT: L  P  S [mm]"),
            tr("Residual [mm]"),
        ]
        self.setAccessibleName(titles[0])
        self.setColumnCount(len(titles))
        self.setHorizontalHeaderLabels(titles)
        self.verticalHeader().hide()
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        for column in _STRETCHED:
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)

    def show_points(
        self, names: tuple[str, ...], draft: CheckDraft, check: RegistrationCheck | None
    ) -> None:
        """Show what was found; the chosen row stays."""
        row = max(0, self.currentRow())
        self.setRowCount(len(names))
        for i, name in enumerate(names):
            for column, text in enumerate(_cells(draft, check, name)):
                item = QTableWidgetItem(text)
                if column:
                    right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
                    item.setTextAlignment(right)
                self.setItem(i, column, item)
        self.selectRow(min(row, self.rowCount() - 1))


def _cells(draft: CheckDraft, check: RegistrationCheck | None, name: str) -> tuple[str, ...]:
    touched = next((one for one in draft.touched if one.name == name), None)
    picked = next((one for one in draft.picked if one.name == name), None)
    radius = ""
    if touched is not None:
        spread = points_of((touched,)).covariances[0]
        radius = f"{covariance_radius(spread) / MILLIMETRE:.2f}" if spread.any() else "–"
    residual = ""
    if check is not None and name in check.world.names:
        row = check.world.fit.residuals[check.world.names.index(name)]
        residual = f"{float(np.linalg.norm(row)) / MILLIMETRE:.2f}"
    return (
        name,
        _coordinates(touched.point_mm) if touched is not None else "",
        radius,
        _coordinates(picked.point_mm) if picked is not None else "",
        residual,
    )


def _coordinates(point_mm: tuple[float, float, float]) -> str:
    return "  ".join(f"{value:.1f}" for value in point_mm)


class RegistrationResult(QWidget):
    """Three texts.

    Attributes:
        student: the sentence for everybody; names no figure without a check.
        trouble: what is wrong or still to be done.
        figures: FRE, FLE, TRE and what they mean.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.student, self.trouble, self.figures = (
            PlainLabel(self),
            PlainLabel(self),
            PlainLabel(self),
        )
        self.student.setStyleSheet(f"font-size: {theme.TITLE_PX}px;")
        self.trouble.setStyleSheet(f"color: {theme.WARNING};")
        self.figures.setProperty("role", "dim")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(theme.SPACING)
        for label in (self.student, self.trouble, self.figures):
            label.setWordWrap(True)
            column.addWidget(label)

    def say(self, text: str) -> None:
        """Say what is wrong; nothing for an empty text."""
        self.trouble.setText(f"▲ {text}" if text else "")

    def show_check(
        self, result: RegistrationCheck | str, p_target: FloatArray, used: RigidTransform | None
    ) -> None:
        """Show a check, or why there is none yet.

        Args:
            result: the check, or what is still missing.
            p_target: target in world [m], shape (3,).
            used: T_world_patient that the screen uses; None without a run.
        """
        if isinstance(result, str):
            self.student.setText(begun(words.NOT_CHECKED))
            self.say(begun(result))
            self.figures.setText("")
            return
        try:
            agreement = result.agreement(p_target, T_world_patient=used)
            self.student.setText(begun(words.student_line(agreement)))
            self.say("")
        except AcusError as error:
            self.student.setText(begun(words.NOT_CHECKED))
            self.say(translated(error))
        if troubles := words.troubles(result):
            self.say("\n".join(map(translated, troubles)))
        lines = list(words.technician_lines(result))
        if result.trusted:
            lines.append(words.target_line(result, p_target))
        self.figures.setText("\n".join(map(translated, [*lines, *words.MEANING])))


_BUTTONS = {
    "touch": sentence("Touch now"),
    "move": sentence("Bring the simulated tip there"),
    "pick": sentence("Pick the bead at the crosshair"),
    "forget": sentence("Forget"),
    "undo": sentence("Undo"),
    "redo": sentence("Redo"),
    "place": sentence("Use the measured place"),
    "save": sentence("Save"),
}


def make_buttons(parent: QWidget) -> dict[str, QPushButton]:
    """Return the buttons by name."""
    buttons = {name: QPushButton(translated(title), parent) for name, title in _BUTTONS.items()}
    buttons["save"].setProperty("role", "primary")
    return buttons


def row_of(buttons: dict[str, QPushButton], *names: str | None) -> QHBoxLayout:
    """Return a row of some of them; None is where the room is left, the end without one."""
    row = QHBoxLayout()
    for name in names:
        if name is None:
            row.addStretch(1)
        else:
            row.addWidget(buttons[name])
    if None not in names:
        row.addStretch(1)
    return row


class CheckSources(Protocol):
    """What the dialog needs of the window."""

    def run(self) -> ExerciseRun | None:
        """Return what runs now."""
        ...

    def volume(self) -> Volume | None:
        """Return the CT that is shown."""
        ...

    def cursor_mm(self) -> FloatArray:
        """Return the crosshair in the CT (LPS, mm), shape (3,)."""
        ...


class RegistrationDialog(QDialog):
    """Stands beside the window, so that hand and slices can be used meanwhile.

    Signals:
        saved(RegistrationRecord): a check was written.
        place_wanted(object): T_world_patient that was measured shall be used.
    """

    saved = Signal(object)
    place_wanted = Signal(object)

    def __init__(self, around: CheckSources, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Registration check"))
        size_dialog(self, theme.px(780), 640)
        self._around = around
        self._history = UndoHistory(CheckDraft())
        self._touching = ""
        self.toucher = Toucher(around.run, self)
        self.plates, self.table = QComboBox(self), FiducialTable(self)
        self.plates.addItems(plate_names())
        self.plate = load_plate(self.plates.currentText())
        self.buttons = make_buttons(self)
        self.progress = QProgressBar(self)
        self.outcome = RegistrationResult(self)
        self._lay_out()
        self._connect()
        self._fill()

    # --- what was found -----------------------------------------------------------------------
    @property
    def draft(self) -> CheckDraft:
        """Points so far."""
        return self._history.present

    @property
    def selected(self) -> str:
        """Fiducial of the chosen row."""
        return self.plate.names[max(0, self.table.currentRow())]

    def touch(self) -> None:
        """Average the tip for a second: it touches the chosen fiducial."""
        self._touching = self.selected
        self.toucher.start()
        self._refresh()

    def pick(self) -> None:
        """Take the bead at the crosshair as the chosen fiducial."""
        from app.planning.registration.points import find_bead  # scipy: only with a CT

        volume = self._around.volume()
        if volume is None:
            self.outcome.say(tr("No CT is shown: open the CT of the scanned phantom."))
            return
        try:
            bead = find_bead(volume, self._around.cursor_mm(), self.plate.bead_diameter_mm)
        except AcusError as error:
            self.outcome.say(translated(error))
            return
        self._do(self.draft.with_pick(self.selected, bead.centre_mm))

    def forget(self) -> None:
        """Forget what was found of the chosen fiducial."""
        self._do(self.draft.without(self.selected), advance=False)

    def undo(self) -> None:
        """Take the last step back."""
        self._history = self._history.undo()
        self._fill()

    def redo(self) -> None:
        """Take it again."""
        self._history = self._history.redo()
        self._fill()

    def choose_plate(self, name: str) -> None:
        """Take another plate; points of the one before are forgotten."""
        self.plate = load_plate(name)
        self._history = UndoHistory(CheckDraft())
        self._fill()

    def save(self) -> None:
        """Write the check; it is used from now on."""
        found, run = self.draft.check(self.plate), self._around.run()
        if isinstance(found, str) or run is None or run.inspect is None:
            return
        seen, volume, now = run.inspect(False, False), self._around.volume(), datetime.now()
        used = volume.series if volume is not None and self.draft.picked else None
        record = RegistrationRecord(
            id=new_id(now),
            created=now.astimezone(),
            plate=self.plate,
            touched=self.draft.touched,
            picked=self.draft.picked,
            series=used.pseudonym if used is not None else "",
            frame=used.frame if used is not None else "",
            calibration=seen.calibration,
            rig=seen.rig,
            simulated=not run.is_real,
        )
        try:
            Registrations.own().save(record)
        except OSError as error:
            self.outcome.say(tr("The check could not be written: {why}", why=error))
            return
        self.saved.emit(record)

    def use_place(self) -> None:
        """Have the measured T_world_patient used in place of the computed one."""
        found = self.draft.check(self.plate)
        if isinstance(found, RegistrationCheck) and found.T_world_patient is not None:
            self.place_wanted.emit(found.T_world_patient)

    # --- inside -------------------------------------------------------------------------------
    def _touched(self, touch: Touch) -> None:
        self._do(self.draft.with_touch(self._touching, touch.p_world, touch.covariance))

    def _do(self, draft: CheckDraft, advance: bool = True) -> None:
        self._history = self._history.do(draft)
        row = self.table.currentRow()
        self._fill()
        if advance and row + 1 < self.table.rowCount():
            self.table.selectRow(row + 1)

    def _fill(self) -> None:
        found = self.draft.check(self.plate)
        check = found if isinstance(found, RegistrationCheck) else None
        self.table.show_points(self.plate.names, self.draft, check)
        self.outcome.show_check(found, *self._target())
        self._refresh()

    def _target(self) -> tuple[FloatArray, RigidTransform | None]:
        run = self._around.run()
        if run is None:
            return np.array([0.0, 0.16056, 0.03]), None
        return run.placed.p_target, run.placed.T_world_patient

    def _refresh(self) -> None:
        run, buttons = self._around.run(), self.buttons
        found = self.draft.check(self.plate)
        check = found if isinstance(found, RegistrationCheck) else None
        buttons["touch"].setEnabled(run is not None and not self.toucher.active)
        buttons["move"].setVisible(run is not None and not run.is_real and run.interactive)
        buttons["pick"].setEnabled(self._around.volume() is not None)
        buttons["undo"].setEnabled(self._history.can_undo)
        buttons["redo"].setEnabled(self._history.can_redo)
        buttons["save"].setEnabled(check is not None and check.trusted and run is not None)
        measured = check is not None and check.trusted and check.patient is not None
        buttons["place"].setEnabled(measured)

    def _move(self) -> None:
        run = self._around.run()
        if run is not None and self.plate.place is not None:
            row = self.plate.rows((self.selected,))[0]
            move_there(run, self.plate.place.transform @ self.plate.touch[row])

    def _lay_out(self) -> None:
        self.progress.setRange(0, 100)
        self.progress.setTextVisible(False)
        self.progress.setFixedHeight(10)
        head = QHBoxLayout()
        head.addWidget(PlainLabel(tr("Plate"), self))
        head.addWidget(self.plates)
        head.addStretch(1)
        page = QVBoxLayout(self)
        page.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
        page.setSpacing(theme.SPACING)
        page.addLayout(head)
        page.addWidget(self.table, 1)
        page.addLayout(row_of(self.buttons, "touch", "move", "pick", "forget"))
        page.addWidget(self.progress)
        page.addWidget(self.outcome)
        page.addLayout(row_of(self.buttons, "undo", "redo", None, "place", "save"))

    def _connect(self) -> None:
        for name, command in (
            ("touch", self.touch),
            ("move", self._move),
            ("pick", self.pick),
            ("forget", self.forget),
            ("undo", self.undo),
            ("redo", self.redo),
            ("save", self.save),
            ("place", self.use_place),
        ):
            self.buttons[name].clicked.connect(command)
        for keys, command in (("Ctrl+Z", self.undo), ("Ctrl+Y", self.redo)):
            QShortcut(QKeySequence(keys), self, command)
        self.plates.textActivated.connect(self.choose_plate)
        self.toucher.progressed.connect(lambda share: self.progress.setValue(round(100 * share)))
        self.toucher.touched.connect(self._touched)
        self.toucher.failed.connect(self._failed)

    def _failed(self, reason: str) -> None:
        self._refresh()
        self.outcome.say(reason)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Stop measuring."""
        self.toucher.stop()
        super().closeEvent(event)
