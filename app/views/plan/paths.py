"""Planning help: scores paths beside the window, shows their map and table, takes the one chosen.

Nothing is chosen by the program: the plan changes when the user takes a path, as one step to undo.
The map is for who made it, and for planning: it goes when somebody else comes, when an exercise is
taken, and when an attempt begins.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from PySide6.QtCore import Signal, SignalInstance
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QGridLayout,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.loading import turn
from app.core.progress import Progress
from app.imaging.field.tissue_words import tissue_words
from app.planning.clearance import Field
from app.planning.draft import DraftPlan
from app.planning.limits import ReachLimits
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.parts import FittingButton, PlainLabel
from app.views.kit.roles import EVERYBODY, Role
from app.views.kit.text import literal, tr, translated
from app.views.plan.entry_map import EntryMap, EntryMapLayer, legend
from app.views.plan.lung_path import LungPathPart
from app.views.plan.way import ABOUT_TARGET_MM
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.imaging.field import TissueField
    from app.planning.paths import PathScores


_MODULES = "app.imaging.field.making", "app.imaging.skin", "app.planning.paths"

_WIDTHS = 58, 64, 58
"""Of the columns before the last [px]."""


class PathsPanel(QWidget):
    """Shows what the map found; who chooses is the user.

    Signals:
        map_wanted(), clear_wanted().
        shown(int): look at the candidate of this number.
        taken(int): make it the plan.
    """

    map_wanted = Signal()
    clear_wanted = Signal()
    shown = Signal(int)
    taken = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.make = FittingButton(tr("Map entries for this target"))
        self.clear = FittingButton(tr("Clear"))
        self.take = FittingButton(tr("Take this path"))
        self.note = PlainLabel(self)
        self.note.setWordWrap(True)
        self.note.setProperty("role", "dim")
        self.meets = PlainLabel(self)
        self.meets.setWordWrap(True)
        self.table = _table()
        self._numbers: tuple[int, ...] = ()
        self._key = QWidget(self)
        self._lay_out()
        self.make.clicked.connect(self.map_wanted)
        self.clear.clicked.connect(self.clear_wanted)
        self.take.clicked.connect(self._take)
        self.table.itemSelectionChanged.connect(self._poll)
        self.suit_text()
        self.show_scores(None, ())

    def show_scores(self, scores: PathScores | None, numbers: tuple[int, ...]) -> None:
        """List candidates of scored paths by their numbers; nothing is chosen."""
        self._numbers = numbers
        self._key.setVisible(scores is not None)
        self.table.setVisible(scores is not None)
        self.take.setVisible(scores is not None)
        self.clear.setEnabled(scores is not None)
        self.table.clearSelection()
        self.table.setCurrentCell(-1, -1)
        self.table.setRowCount(len(numbers))
        self.take.setEnabled(False)
        if scores is None:
            self.note.setText(
                tr(
                    "Scores straight paths to the target from all over the skin: length, angle to "
                    "the skin, bone, lung, vessels and gut on the way, distance to structures that "
                    "warn, and the robot's reach."
                )
            )
            return
        for row, number in enumerate(numbers):
            self._show_row(row, scores, number)
        free = int(scores.free.sum())
        words = tr("{free} of {all} entries are possible.", free=free, all=len(scores))
        if not free:
            words = tr("No entry is possible: turn the patient, or choose another target.")
        if not scores.names:
            words += " " + tr("No structure warns: the scores know tissue and reach only.")
        self.note.setText(words)

    def suit_text(self) -> None:
        """Give the columns room for the present size of the text."""
        for column, width in enumerate(_WIDTHS):
            self.table.setColumnWidth(column, theme.px(width))
        for label, (rgb, _) in zip(self._key.findChildren(QLabel), legend(), strict=True):
            label.setStyleSheet(f"color: {readable(rgb)};")

    def _show_row(self, row: int, scores: PathScores, number: int) -> None:
        nearest = tr("none")
        if scores.nearest[number] >= 0:
            name = tissue_words(scores.names[int(scores.nearest[number])])
            nearest = f"{scores.nearest_mm[number]:.0f} {translated(name)}"
        texts = (
            f"{scores.score[number]:.0f}",
            f"{scores.length_mm[number]:.0f}",
            f"{scores.angle_deg[number]:.0f}",
            nearest,
        )
        for column, text in enumerate(texts):
            item = QTableWidgetItem(text)
            item.setToolTip(literal(text))
            self.table.setItem(row, column, item)

    def _poll(self) -> None:
        row = self.table.currentRow() if self.table.selectedItems() else -1
        self.take.setEnabled(0 <= row < len(self._numbers))
        if 0 <= row < len(self._numbers):
            self.shown.emit(self._numbers[row])

    def _take(self) -> None:
        row = self.table.currentRow()
        if 0 <= row < len(self._numbers):
            self.taken.emit(self._numbers[row])

    def _lay_out(self) -> None:
        heading = PlainLabel(tr("Planning help"))
        heading.setProperty("role", "heading")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, theme.SPACING, 0, 0)
        column.setSpacing(theme.SPACING)
        column.addWidget(heading)
        row = QHBoxLayout()
        row.addWidget(self.make, 1)
        row.addWidget(self.clear)
        column.addLayout(row)
        column.addWidget(self.note)
        column.addWidget(self.meets)
        grid = QGridLayout(self._key)
        grid.setContentsMargins(0, 0, 0, 0)
        for place, (_, text) in enumerate(legend()):
            label = PlainLabel(text)
            grid.addWidget(label, place // 3, place % 3)
        column.addWidget(self._key)
        column.addWidget(self.table)
        column.addWidget(self.take)


def _table() -> QTableWidget:
    table = QTableWidget(0, 4)
    table.setTabKeyNavigation(False)
    table.setHorizontalHeaderLabels(
        [tr("Score"), tr("Length\n[mm]"), tr("Angle\n[°]"), tr("Nearest\n[mm]")]
    )
    table.verticalHeader().setVisible(False)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setMinimumHeight(230)
    header = table.horizontalHeader()
    for column in range(len(_WIDTHS)):
        header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
    header.setSectionResizeMode(3, QHeaderView.ResizeMode.Stretch)
    table.setAccessibleName(tr("Candidate paths"))
    return table


def readable(rgb: tuple[int, int, int]) -> str:
    """Return a colour of the map as words can have it: lighter on dark, darker on light."""
    colour, ground = QColor(*rgb), QColor(theme.BACKGROUND)
    if ground.lightnessF() > 0.5:
        return QColor.fromHslF(colour.hslHueF() % 1.0, colour.hslSaturationF(), 0.27).name()
    return QColor.fromHslF(
        colour.hslHueF() % 1.0, colour.hslSaturationF(), max(0.65, 1.1 * colour.lightnessF())
    ).name()


class PathsFeature(Feature):
    """Connects the panel below the plan with target, structures, panes and 3D view."""

    topic: ClassVar[str] = "paths"
    place: ClassVar[int] = 40
    roles: ClassVar[frozenset[Role]] = EVERYBODY

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._conductor, self._views = context.conductor, context.views
        self._editor, self._book = context.editors.plan, context.editors.structures
        self.panel = PathsPanel()
        context.shell.add_panel(self.panel, below=tr("Plan"))
        self.lung = LungPathPart(context, self)
        context.shell.add_panel(self.lung.panel, below=tr("Plan"))
        self.scores: PathScores | None = None
        self._task: BackgroundTask | None = None
        self._stands_on: tuple[object, ...] = ()
        self._tissues: TissueField | None = None
        self._here = ACCESS.student, ACCESS.instructor
        self._layers = []
        for pane in self._views.slices:
            layer = EntryMapLayer(pane.canvas.drawing)
            pane.canvas.add_layer(layer)
            self._layers.append(layer)
        self.panel.map_wanted.connect(self.make)
        self.panel.clear_wanted.connect(self.clear)
        self.panel.shown.connect(self._preview)
        self.panel.taken.connect(self._take)
        self._editor.changed.connect(self._check)
        self._conductor.patient_changed.connect(self.clear)
        self._conductor.exercise_taken.connect(lambda _: self.clear())
        self._conductor.controller.beginning.connect(self.clear)
        for left in (
            self._conductor.patient_changed,
            self._conductor.exercise_taken,
            self._conductor.controller.beginning,
        ):
            left.connect(lambda *_: self.lung.clear())
        ACCESS.changed.connect(self._look_who_is_here)
        self._check()

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._editor.changed,)

    def forget(self) -> None:
        """Take map and report of the patient who leaves away."""
        self.clear()
        self.lung.clear()

    def suit_room(self) -> None:
        """Take another size of text."""
        self.panel.suit_text()

    def _look_who_is_here(self) -> None:
        here = ACCESS.student, ACCESS.instructor
        if here != self._here:
            self._here = here
            self.clear()
            self.lung.clear()

    def _standing(self) -> tuple[object, ...]:
        """Return what the scores depend on."""
        edit = self._editor.edit
        patient = self._conductor.patient
        return (edit.draft.target_mm, edit.placement, None if patient is None else patient.volume)

    def _check(self) -> None:
        """Take a map away that belongs to another target or position."""
        if self._stands_on and self._stands_on != self._standing():
            self.clear()
        self._say_what_it_meets()
        ready = self._editor.edit.draft.target_mm is not None and not self._editor.locked
        self.panel.make.setEnabled(ready and self._conductor.profile is not None)
        self.panel.make.setToolTip("" if ready else tr("Place the target first (key T)"))

    def _say_what_it_meets(self) -> None:
        """Say what the planned path meets, by the field that the map was made with."""
        draft, tissues = self._editor.edit.draft, self._tissues
        entry, target = draft.entry_mm, draft.target_mm
        shown = tissues is not None and entry is not None and target is not None
        if tissues is not None and entry is not None and target is not None:
            from app.imaging.field.walking import words

            said = words(tissues, [entry, target])
            self.panel.meets.setText(tr("The planned path meets: {tissues}.", tissues=said))
        self.panel.meets.setVisible(shown)

    def make(self) -> None:
        """Score the paths to the target, beside the window."""
        patient, profile = self._conductor.patient, self._conductor.profile
        edit, fields = self._editor.edit, self._book.fields
        if patient is None or profile is None or edit.draft.target_mm is None:
            return
        if self._task is not None:
            self._task.drop()
        standing = self._standing()
        limits, target = ReachLimits.of(profile), np.array(edit.draft.target_mm)

        def work(progress: Progress) -> tuple[PathScores, TissueField | None]:
            with turn(progress, *_MODULES):  # scipy: behind the window
                from app.imaging.field.making import field_of
                from app.imaging.skin import skin_points
                from app.planning.paths import score_paths
            skin = skin_points(patient.body, progress=progress.part(0.0, 0.2))
            tissues: TissueField | None = None
            if patient.volume.unit == "HU":
                structures = [structure for structure, _ in fields]
                tissues = field_of(
                    patient.volume,
                    structures,
                    target,
                    ABOUT_TARGET_MM,
                    progress=progress.part(0.2, 0.7),
                    body=patient.body,
                )
            scores = score_paths(
                target,
                skin,
                patient.body,
                _warning(fields),
                edit.placement,
                limits,
                progress=progress.part(0.7, 1.0),
                tissues=tissues,
            )
            return scores, tissues

        self.panel.make.setEnabled(False)
        self._task = run_in_background(
            self,
            work,
            lambda made: self._show(*made, standing),
            self._failed,
            self._ended,
            title=tr("Scoring paths"),
            indicator=self.context.shell.progress,
        )

    def _show(
        self, scores: PathScores, tissues: TissueField | None, standing: tuple[object, ...]
    ) -> None:
        self._ended()
        if standing != self._standing():
            return
        from app.planning.paths import best

        self.scores, self._stands_on, self._tissues = scores, standing, tissues
        self.panel.show_scores(scores, best(scores))
        self._draw(EntryMap.of(scores))
        self._say_what_it_meets()

    def clear(self) -> None:
        """Take map and table away, and one that is being made."""
        if self._task is not None:
            self._task.drop()
            self._task = None
        self.scores, self._stands_on, self._tissues = None, (), None
        self.panel.show_scores(None, ())
        self.lung.show_alternative(None, "")
        self._draw(None)
        self._check()  # another may be made

    def _draw(self, shown: EntryMap | None) -> None:
        for layer in self._layers:
            layer.set_map(shown)
        self._views.refresh()
        self._views.scene.set_entry_map(shown)

    def _failed(self, error: Exception) -> None:
        self._ended()
        self.failed.emit(error)

    def _ended(self) -> None:
        self._task = None
        self._check()

    def _preview(self, number: int) -> None:
        if self.scores is not None:
            entry = self.scores.entries_mm[number]
            self._views.viewing.set_cursor(entry)
            name = tr("Alternative\n{points:.0f} points", points=self.scores.score[number])
            self.lung.show_alternative(entry, name)

    def _take(self, number: int) -> None:
        if self.scores is not None:
            x, y, z = self.scores.entries_mm[number].tolist()
            draft: DraftPlan = self._editor.edit.draft.with_entry((x, y, z))
            self._editor.take(draft, self._editor.edit.placement)

    def close(self) -> None:
        """End what runs; idempotent."""
        self.lung.close()
        if self._task is not None:
            self._task.close()
            self._task = None


def _warning(fields: tuple[Field, ...]) -> list[Field]:
    return [one for one in fields if one[0].warn_mm > 0.0]
