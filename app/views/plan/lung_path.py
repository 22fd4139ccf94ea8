"""The path report of a lung biopsy in the window: the plan's beside the alternative's looked at.

Made when the user asks for it, beside the window; from then on it follows the plan until it is
cleared. Its places are marked in the slices and in 3D. What nobody labelled is "not known".
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.loading import turn
from app.core.progress import Progress
from app.imaging.field.tissue_words import tissue_words
from app.planning.lung_path.sentences import lung_rows, not_known
from app.planning.lung_path.values import LungPathReport, Place
from app.views.debrief.met_marks import MetLayer, MetPlace, MetScene
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.parts import FittingButton, PlainLabel
from app.views.kit.text import literal, tr, translated
from app.views.plan.way import ABOUT_TARGET_MM

if TYPE_CHECKING:
    from app.core.arrays import FloatArray
    from app.views.shell.feature import Context

_MODULES: Final = "app.imaging.field.making", "app.planning.lung_path.reporting"

AFTER_MS: Final = 300
"""So long a plan stays as it is before it is reported anew."""

Both = tuple[LungPathReport, LungPathReport | None]


class LungPathPanel(QWidget):
    """Button and table of the report; a column for the plan, one for the alternative.

    Signals:
        wanted(), clear_wanted().
    """

    wanted = Signal()
    clear_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.make = FittingButton(tr("Report the path through the lung"))
        self.clear = FittingButton(tr("Clear"))
        self.note = PlainLabel(self)
        self.note.setWordWrap(True)
        self.note.setProperty("role", "dim")
        self.table = _table()
        row = QHBoxLayout()
        row.addWidget(self.make, 1)
        row.addWidget(self.clear)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, theme.SPACING, 0, 0)
        column.setSpacing(theme.SPACING)
        column.addLayout(row)
        column.addWidget(self.note)
        column.addWidget(self.table)
        self.make.clicked.connect(self.wanted)
        self.clear.clicked.connect(self.clear_wanted)
        self.show_nothing()

    def show_nothing(self) -> None:
        """Say what the report would tell."""
        self.clear.setEnabled(False)
        self.table.setVisible(False)
        self.note.setText(
            tr(
                "For a target in the lung: pleura and fissures crossed with their angles, lung and "
                "emphysema on the way, room to ribs and intercostal vessels, vessels and bronchi."
            )
        )

    def show_problem(self, text: str) -> None:
        """Say in one line that there is no report."""
        self.table.setVisible(False)
        self.clear.setEnabled(True)
        self.note.setText(text)

    def show_reports(self, plan: LungPathReport, other: LungPathReport | None, name: str) -> None:
        """Show the plan's report, and that of an alternative of a name beside it."""
        self.clear.setEnabled(True)
        self.table.setVisible(True)
        columns = [lung_rows(plan), *([] if other is None else [lung_rows(other)])]
        self.table.setColumnCount(1 + len(columns))
        heads = [tr("Path"), tr("Your plan"), name][: 1 + len(columns)]
        self.table.setHorizontalHeaderLabels(heads)
        self.table.setRowCount(len(columns[0]))
        unknown = translated(not_known())
        for row, (label, _) in enumerate(columns[0]):
            texts = [translated(label), *(translated(rows[row][1]) for rows in columns)]
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                item.setToolTip(literal(f"{texts[0]}: {text}" if column else text))
                if text == unknown:
                    font = item.font()
                    font.setItalic(True)
                    item.setFont(font)
                self.table.setItem(row, column, item)
        header = self.table.horizontalHeader()
        for column in range(self.table.columnCount()):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)
        self.table.resizeRowsToContents()
        rows_px = sum(self.table.rowHeight(row) for row in range(self.table.rowCount()))
        self.table.setFixedHeight(rows_px + header.sizeHint().height() + 6)
        words = tr("The selected alternative stands beside your plan.")
        if other is None:
            words = tr("Select a path of the map to see its figures beside your plan's.")
        self.note.setText(words)


def _table() -> QTableWidget:
    table = QTableWidget(0, 2)
    table.setTabKeyNavigation(False)
    table.setWordWrap(True)
    table.verticalHeader().setVisible(False)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setAccessibleName(tr("Path through the lung"))
    return table


class LungPathPart(QObject):
    """Makes the report, follows the plan, and marks its places.

    Args:
        context: of the window.
        parent: the feature that shows it.

    Attributes:
        panel: what is shown of it.
        reports: the plan's and the alternative's; None where there is no report.
    """

    def __init__(self, context: Context, parent: QObject) -> None:
        super().__init__(parent)
        self._context = context
        self._conductor, self._editor = context.conductor, context.editors.plan
        self._book = context.editors.structures
        self.panel = LungPathPanel()
        self.reports: Both | None = None
        self._wanted = False
        self._other: FloatArray | None = None
        self._name = ""
        self._stands_on: object = None
        self._task: BackgroundTask | None = None
        self._layers = tuple(MetLayer(pane.canvas) for pane in context.views.slices)
        self._scene = MetScene(context.views.scene)
        self._timer = QTimer(self, singleShot=True, interval=AFTER_MS)
        self._timer.timeout.connect(self._begin)
        self.panel.wanted.connect(self.make)
        self.panel.clear_wanted.connect(self.clear)
        self._editor.changed.connect(self.look)
        self.look()

    def make(self) -> None:
        """Report the plan, and from now on each that it becomes."""
        self._wanted, self._stands_on = True, None
        self.panel.note.setText(tr("The path is being looked up…"))
        self._begin()

    def clear(self) -> None:
        """Take report and marks away."""
        self._wanted, self.reports, self._other, self._stands_on = False, None, None, None
        self._timer.stop()
        self._drop()
        self.panel.show_nothing()
        self._mark()
        self.look()

    def look(self) -> None:
        """Follow plan and patient."""
        draft = self._editor.edit.draft
        ready = draft.complete and self._conductor.patient is not None and not self._editor.locked
        self.panel.make.setEnabled(ready)
        self.panel.make.setToolTip("" if ready else tr("Place entry and target first (keys E, T)"))
        if self._wanted and self._standing() != self._stands_on:
            self.reports = None
            self._mark()
            self._timer.start()

    def show_alternative(self, entry_mm: FloatArray | None, name: str) -> None:
        """Report a path from another entry to the same target besides; None for none."""
        self._other, self._name = entry_mm, name
        if self._wanted:
            self._stands_on = None
            self._timer.start()

    def close(self) -> None:
        """End what runs; idempotent."""
        self._timer.stop()
        if self._task is not None:
            self._task.close()
            self._task = None

    # --- inside -----------------------------------------------------------------------------------
    def _standing(self) -> object:
        draft, patient = self._editor.edit.draft, self._conductor.patient
        volume = None if patient is None else id(patient.volume)
        return draft.entry_mm, draft.target_mm, volume

    def _begin(self) -> None:
        patient, draft = self._conductor.patient, self._editor.edit.draft
        if patient is None or draft.entry_mm is None or draft.target_mm is None:
            return
        if patient.volume.unit != "HU":
            self.panel.show_problem(tr("the CT has no Hounsfield values"))
            return
        self._drop()
        self._stands_on = standing = self._standing()
        structures = [structure for structure, _ in self._book.fields]
        ends, other = (draft.entry_mm, draft.target_mm), self._other

        def work(progress: Progress) -> Both:
            with turn(progress, *_MODULES):  # scipy: behind the window
                from app.imaging.field.making import field_of
                from app.planning.lung_path.reporting import LungPaths
            field = field_of(
                patient.volume,
                structures,
                np.array(ends[1]),
                ABOUT_TARGET_MM,
                progress=progress,
                body=patient.body,
            )
            paths = LungPaths(field, patient.volume)
            beside = None if other is None else paths.report_or_none(other, ends[1])
            return paths.report(*ends), beside

        def done(made: Both) -> None:
            self._task = None
            if standing == self._standing() and self._wanted:
                self.reports = made
                self.panel.show_reports(*made, self._name)
                self._mark()

        def failed(error: Exception) -> None:
            self._task = None
            self.panel.show_problem(translated(error))

        def stopped() -> None:
            self._task = None

        self._task = run_in_background(
            self,
            work,
            done,
            failed,
            stopped,
            title=tr("Reporting the path"),
            indicator=self._context.shell.progress,
        )

    def _drop(self) -> None:
        if self._task is not None:
            self._task.drop()
            self._task = None

    def _mark(self) -> None:
        places = () if self.reports is None else places_of(self.reports[0])
        for layer in self._layers:
            layer.set_places(places)
        self._scene.set_places(places)


def places_of(report: LungPathReport) -> tuple[MetPlace, ...]:
    """Return what is marked of a path: pleura, fissures, ribs' borders, vessels and bronchi met."""
    found = []
    for one in report.pleura or ():
        angle = one.angle_deg or 0.0
        found.append(_place("lung", tr("Pleura {angle:.0f}°", angle=angle), one.place_mm))
    for one in report.fissures or ():
        name = tr("Fissure")
        if one.angle_deg is not None:
            name = tr("Fissure {angle:.0f}°", angle=one.angle_deg)
        found.append(_place("organ", name, one.place_mm))
    borders = (
        (report.rib_below_at, report.rib_below_mm, tr("Rib below")),
        (report.rib_above_at, report.rib_above_mm, tr("Rib above")),
    )
    for at, mm, name in borders:
        if at is not None and mm is not None:
            words = tr("{name} {mm:.1f} mm", name=name, mm=mm) if mm > 0.0 else tr("Rib met")
            found.append(_place("bone", words, at))
    for tube in (*(report.vessels or ()), *(report.bronchi or ())):
        if tube.away_mm <= 0.0:
            word = translated(tissue_words(tube.name))
            name = tr("{name} {mm:.1f} mm", name=word, mm=tube.diameter_mm)
            found.append(_place("vessel", name, tube.place_mm))
    return tuple(found)


def _place(kind: str, name: str, at: Place) -> MetPlace:
    return MetPlace(kind, name, np.array([at, at]), name, fails=False)
