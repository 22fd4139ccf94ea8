"""The pictures of a series before it is taken in: looked at, writing in them covered by boxes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QPushButton,
    QSlider,
    QVBoxLayout,
    QWidget,
)

from app.imaging.window import PRESETS, to_grey
from app.planning.history import History
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.series.mask_canvas import MaskCanvas
from app.views.series.mask_words import box_words, explanation
from app.views.slices.presets import preset_name

if TYPE_CHECKING:
    from app.imaging.privacy.burned_in import Box
    from app.imaging.privacy.pictures import Pictures

Boxes = tuple["Box", ...]
_SHOWN = ("Soft tissue", "Lung", "Bone", "Brain")


class MaskDialog(QDialog):
    """Lets look through the pictures and draw boxes; what is shown is what will be written.

    Signals:
        wanted(tuple): take the series in with these boxes, perhaps none.
    """

    wanted = Signal(object)

    def __init__(
        self, pictures: Pictures, boxes: Boxes = (), note: str = "", parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Look at the pictures before they are taken in"))
        self.resize(1080, 760)
        self.pictures = pictures
        self._history: History[Boxes] = History(boxes)
        self.canvas, self.slider = MaskCanvas(self), QSlider(Qt.Orientation.Horizontal, self)
        self.where, self.windows = QLabel(self), QComboBox(self)
        self.brightest = QCheckBox(tr("Brightest of all pictures"), self)
        self.scope, self.list = QComboBox(self), QListWidget(self)
        self.undo_button = QPushButton(tr("Undo"), self)
        self.redo_button = QPushButton(tr("Redo"), self)
        self.remove_button = QPushButton(tr("Remove"), self)
        self.clear_button = QPushButton(tr("Clear"), self)
        kinds = QDialogButtonBox.StandardButton
        self.buttons = QDialogButtonBox(kinds.Cancel, parent=self)
        self.take = self.buttons.addButton(
            tr("Import, de-identified"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self.take.setProperty("role", "primary")
        self._note = QLabel(note, self)
        self._fill()
        self._lay_out()
        self._connect()
        self._refresh()
        self.canvas.setFocus()

    # --- what is there --------------------------------------------------------------------------
    @property
    def boxes(self) -> Boxes:
        """Boxes as they are now."""
        return self._history.present

    @property
    def number(self) -> int:
        """Number of the picture that is shown, from 1."""
        return self.slider.value()

    def draw(self, column: int, row: int, columns: int, rows: int) -> None:
        """Add a box, on every picture or on this one as chosen."""
        from app.imaging.privacy.burned_in import Box  # pydicom: not before the window

        one = self.scope.currentIndex() == 1 and not self.brightest.isChecked()
        self._do((*self.boxes, Box(column, row, columns, rows, self.number if one else None)))
        self.list.setCurrentRow(len(self.boxes) - 1)

    def undo(self) -> None:
        """Take the last step back."""
        self._history = self._history.undo()
        self._refresh()

    def redo(self) -> None:
        """Take it again."""
        self._history = self._history.redo()
        self._refresh()

    def clear(self) -> None:
        """Take every box away; can be undone."""
        self._do(())

    def remove(self) -> None:
        """Take the chosen box away."""
        chosen = self.list.currentRow()
        if 0 <= chosen < len(self.boxes):
            self._do(tuple(box for n, box in enumerate(self.boxes) if n != chosen))

    def step(self, pictures: int) -> None:
        """Go on through the pictures."""
        self.slider.setValue(self.number + pictures)

    # --- inside ---------------------------------------------------------------------------------
    def _do(self, boxes: Boxes) -> None:
        self._history = self._history.do(boxes)
        self._refresh()

    def _fill(self) -> None:
        for name in _SHOWN:
            self.windows.addItem(preset_name(name), PRESETS[name])
        self.windows.addItem(tr("All values"), self.pictures.window)
        self.scope.addItems([tr("on all pictures"), tr("on this picture only")])
        self.slider.setRange(1, self.pictures.count)
        self.slider.setValue((self.pictures.count + 1) // 2)
        self.slider.setAccessibleName(tr("Picture"))
        self.brightest.setToolTip(
            tr("Of every pixel the highest value in any picture: writing in one of them shows.")
        )

    def _refresh(self) -> None:
        everything = self.brightest.isChecked()
        self.slider.setEnabled(not everything)
        self.scope.setEnabled(self.pictures.one_per_file and not everything)
        seen = self.pictures
        values = seen.all_seen(self.boxes) if everything else seen.seen(self.number, self.boxes)
        grey = to_grey(values, self.windows.currentData())
        self.canvas.show_picture(255 - grey if seen.inverted else grey, seen.aspect)
        self.where.setText(
            tr("all {count} at once", count=seen.count) if everything
            else tr("picture {number} of {count}", number=self.number, count=seen.count)
        )  # fmt: skip
        self._show_boxes()

    def _show_boxes(self) -> None:
        chosen = self.list.currentRow()
        with QSignalBlocker(self.list):
            self.list.clear()
            self.list.addItems([box_words(n, box) for n, box in enumerate(self.boxes, start=1)])
            self.list.setCurrentRow(min(chosen, len(self.boxes) - 1))
        here = None if self.brightest.isChecked() else self.number
        shown = [(n, box) for n, box in enumerate(self.boxes, 1) if box.picture in (None, here)]
        self.canvas.show_boxes(shown, self.list.currentRow() + 1)
        self.undo_button.setEnabled(self._history.can_undo)
        self.redo_button.setEnabled(self._history.can_redo)
        self.remove_button.setEnabled(self.list.currentRow() >= 0)
        self.clear_button.setEnabled(bool(self.boxes))

    def _choose(self, row: int) -> None:
        """Show the picture of the box that was chosen in the list."""
        if 0 <= row < len(self.boxes) and (picture := self.boxes[row].picture):
            self.slider.setValue(picture)
        self._show_boxes()

    def _want(self) -> None:
        self.accept()
        self.wanted.emit(self.boxes)

    def _connect(self) -> None:
        self.canvas.drawn.connect(self.draw)
        self.canvas.scrolled.connect(self.step)
        self.slider.valueChanged.connect(self._refresh)
        self.windows.currentIndexChanged.connect(self._refresh)
        self.brightest.toggled.connect(self._refresh)
        self.list.currentRowChanged.connect(self._choose)
        for button, command in (
            (self.undo_button, self.undo), (self.redo_button, self.redo),
            (self.remove_button, self.remove), (self.clear_button, self.clear),
        ):  # fmt: skip
            button.setAutoDefault(False)
            button.clicked.connect(lambda _=False, command=command: command())
        self.buttons.accepted.connect(self._want)
        self.buttons.rejected.connect(self.reject)
        for keys, command in (
            ("Ctrl+Z", self.undo), ("Ctrl+Y", self.redo), ("Ctrl+Shift+Z", self.redo),
            ("Delete", self.remove),
            ("PgUp", lambda: self.step(-10)), ("PgDown", lambda: self.step(10)),
        ):  # fmt: skip
            QShortcut(QKeySequence(keys), self, command)
        for keys, pictures in (("Up", -1), ("Down", 1)):
            shortcut = QShortcut(QKeySequence(keys), self.canvas)
            shortcut.setContext(Qt.ShortcutContext.WidgetShortcut)
            shortcut.activated.connect(lambda n=pictures: self.step(n))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Let Escape end a box that is being drawn before it ends the dialog."""
        if event.key() == Qt.Key.Key_Escape and self.canvas.abandon():
            return
        super().keyPressEvent(event)

    # --- layout ---------------------------------------------------------------------------------
    def _lay_out(self) -> None:
        picture = QVBoxLayout()
        picture.addWidget(self.canvas, 1)
        foot = QHBoxLayout()
        foot.addWidget(self.slider, 1)
        foot.addWidget(self.where)
        picture.addLayout(foot)
        self.where.setMinimumWidth(
            self.where.fontMetrics().horizontalAdvance("picture 8888 of 8888")
        )
        both = QHBoxLayout()
        both.addLayout(picture, 1)
        both.addLayout(self._side())
        column = QVBoxLayout(self)
        column.setSpacing(theme.SPACING)
        self._note.setWordWrap(True)
        self._note.setStyleSheet(f"color: {theme.WARNING}; font-weight: 600;")
        self._note.setVisible(bool(self._note.text()))
        column.addWidget(self._note)
        column.addLayout(both, 1)
        column.addWidget(self.buttons)

    def _side(self) -> QVBoxLayout:
        self.canvas.may_draw = self.pictures.one_per_file
        help_ = QLabel(explanation(self.pictures.one_per_file), self)
        help_.setWordWrap(True)
        column = QVBoxLayout()
        column.setSpacing(theme.SPACING)
        column.addWidget(help_)
        column.addWidget(self.brightest)
        for title, box in ((tr("Window"), self.windows), (tr("New boxes"), self.scope)):
            row = QHBoxLayout()
            row.addWidget(QLabel(title, self))
            row.addWidget(box, 1)
            column.addLayout(row)
        column.addWidget(self.list, 1)
        for pair in ((self.undo_button, self.redo_button), (self.remove_button, self.clear_button)):
            row = QHBoxLayout()
            for button in pair:
                row.addWidget(button)
            column.addLayout(row)
        for widget in (help_, self.list):
            widget.setFixedWidth(300)
        return column
