"""The pictures of a series before it is taken in: writing in them is covered by boxes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSignalBlocker, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QImage,
    QKeyEvent,
    QKeySequence,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QShortcut,
    QWheelEvent,
)
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QListWidget,
    QPushButton,
    QSlider,
    QVBoxLayout,
    QWidget,
)

from app.imaging.window import PRESETS, to_grey
from app.planning.history import UndoHistory
from app.views.kit import theme
from app.views.kit.parts import PlainLabel, size_dialog
from app.views.kit.text import tr
from app.views.slices.presets import preset_name

if TYPE_CHECKING:
    from app.imaging.privacy.burned_in import MaskBox
    from app.imaging.privacy.pictures import Pictures


_LEAST_PX = 1
_ALL, _ONE = Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine


class MaskCanvas(QWidget):
    """Shows a grey picture as large as fits, and the boxes on it with their numbers.

    Signals:
        drawn(int, int, int, int): column, row, width and height [pixels of the picture] of a box.
        scrolled(int): pictures to go on.
    """

    drawn = Signal(int, int, int, int)
    scrolled = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(420, 420)
        self.setCursor(Qt.CursorShape.CrossCursor)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Picture; drag to draw a box over writing"))
        self._image, self._aspect = QImage(), 1.0
        self._boxes: tuple[tuple[int, MaskBox], ...] = ()
        self._chosen = -1
        self._from: QPointF | None = None
        self._to = QPointF()
        self._turned = 0
        self.may_draw = True

    def show_picture(self, grey: NDArray[np.uint8], aspect: float) -> None:
        """Show grey levels, shape (rows, columns), pixels `aspect` times as high as wide."""
        rows, columns = grey.shape
        grey = np.ascontiguousarray(grey)
        picture = QImage(grey.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
        self._image, self._aspect = picture.copy(), aspect
        self.update()

    def show_boxes(self, boxes: Sequence[tuple[int, MaskBox]], chosen: int) -> None:
        """Outline boxes, each with its number; the one of the number `chosen` thicker."""
        self._boxes, self._chosen = tuple(boxes), chosen
        self.update()

    # --- where things are -----------------------------------------------------------------------
    def frame(self) -> QRectF:
        """Rectangle of the picture in the widget [px]."""
        columns, rows = self._image.width(), self._image.height() * self._aspect
        if not columns or not rows:
            return QRectF()
        scale = min(self.width() / columns, self.height() / rows)
        wide, high = scale * columns, scale * rows
        return QRectF((self.width() - wide) / 2.0, (self.height() - high) / 2.0, wide, high)

    def _rectangle(self, box: MaskBox) -> QRectF:
        frame = self.frame()
        x, y = frame.width() / self._image.width(), frame.height() / self._image.height()
        return QRectF(
            frame.left() + x * box.column, frame.top() + y * box.row, x * box.columns, y * box.rows
        )

    def _box(self) -> tuple[int, int, int, int] | None:
        """Column, row, width and height of what is being drawn: whole pixels, cut at the edges."""
        frame = self.frame()
        if self._from is None or frame.isEmpty():
            return None
        rectangle = QRectF(self._from, self._to).normalized().intersected(frame)
        columns, rows = self._image.width(), self._image.height()
        x, y = columns / frame.width(), rows / frame.height()
        left, top = x * (rectangle.left() - frame.left()), y * (rectangle.top() - frame.top())
        right, bottom = left + x * rectangle.width(), top + y * rectangle.height()
        column, row = int(left), int(top)
        width = min(int(np.ceil(right)), columns) - column
        height = min(int(np.ceil(bottom)), rows) - row
        return (column, row, width, height) if min(width, height) >= _LEAST_PX else None

    # --- events ---------------------------------------------------------------------------------
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw picture, boxes, and the one that is being drawn."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), theme.IMAGE_BACKGROUND)
        if self._image.isNull():
            return
        painter.drawImage(self.frame(), self._image)
        for number, box in self._boxes:
            self._outline(painter, number, box)
        if self._from is not None:
            painter.setPen(QPen(QColor(theme.on_image(theme.WARNING)), 2.0, Qt.PenStyle.DotLine))
            painter.drawRect(QRectF(self._from, self._to).normalized().intersected(self.frame()))

    def _outline(self, painter: QPainter, number: int, box: MaskBox) -> None:
        style = _ALL if box.picture is None else _ONE
        width = 3.0 if number == self._chosen else 1.5
        colour = theme.on_image(theme.WARNING if number == self._chosen else theme.ACCENT)
        painter.setPen(QPen(QColor(colour), width, style))
        rectangle = self._rectangle(box)
        painter.drawRect(rectangle)
        text = rectangle.adjusted(4.0, 2.0, 60.0, 40.0)
        painter.drawText(text, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, str(number))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a box."""
        if event.button() == Qt.MouseButton.LeftButton and self.may_draw:
            self._from = self._to = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Go on with it."""
        if self._from is not None:
            self._to = event.position()
            self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End it; a mere click draws nothing."""
        if self._from is None or event.button() != Qt.MouseButton.LeftButton:
            return
        moved = (event.position() - self._from).manhattanLength() >= 4.0
        self._to = event.position()
        box, self._from = self._box(), None
        self.update()
        if moved and box is not None:
            self.drawn.emit(*box)

    def abandon(self) -> bool:
        """Let go of a box that is being drawn; return whether there was one."""
        was, self._from = self._from is not None, None
        self.update()
        return was

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Go on through the pictures, a notch each; fine wheels add up."""
        self._turned += event.angleDelta().y()
        steps, self._turned = int(self._turned / 120), self._turned - 120 * int(self._turned / 120)
        if steps:
            self.scrolled.emit(-steps)


def explanation(can_draw: bool) -> str:
    """Say what to look for and what to do with it."""
    if can_draw:
        return tr(
            "Names can be written into the picture itself. Nothing finds them by itself: look "
            "through the pictures and drag a box over any writing. What is shown black in a box is "
            "black in the library for good; the original stays as it is."
        )
    return tr(
        "Look through the pictures for writing. These files hold many pictures each; on such files "
        "no boxes can be drawn: do not take them in if there is any."
    )


def box_words(number: int, box: MaskBox) -> str:
    """Line of a box in the list."""
    on = tr("all pictures") if box.picture is None else tr("picture {number}", number=box.picture)
    return f"{number}  {on}: {box.columns} × {box.rows} px, ({box.column}, {box.row})"


Boxes = tuple["MaskBox", ...]
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
        self.setWindowTitle(tr("Look at the pictures before they are imported"))
        size_dialog(self, 1080, 760)
        self.pictures = pictures
        self._history: UndoHistory[Boxes] = UndoHistory(boxes)
        self.canvas, self.slider = MaskCanvas(self), QSlider(Qt.Orientation.Horizontal, self)
        self.where, self.windows = PlainLabel(self), QComboBox(self)
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
        self._note = PlainLabel(note, self)
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
        from app.imaging.privacy.burned_in import MaskBox  # pydicom: not before the window

        one = self.scope.currentIndex() == 1 and not self.brightest.isChecked()
        self._do((*self.boxes, MaskBox(column, row, columns, rows, self.number if one else None)))
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
            tr("all {count} at once", count=seen.count)
            if everything
            else tr("picture {number} of {count}", number=self.number, count=seen.count)
        )
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
            (self.undo_button, self.undo),
            (self.redo_button, self.redo),
            (self.remove_button, self.remove),
            (self.clear_button, self.clear),
        ):
            button.setAutoDefault(False)
            button.clicked.connect(lambda _=False, command=command: command())
        self.buttons.accepted.connect(self._want)
        self.buttons.rejected.connect(self.reject)
        for keys, command in (
            ("Ctrl+Z", self.undo),
            ("Ctrl+Y", self.redo),
            ("Ctrl+Shift+Z", self.redo),
            ("Delete", self.remove),
            ("PgUp", lambda: self.step(-10)),
            ("PgDown", lambda: self.step(10)),
        ):
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
        help_ = PlainLabel(explanation(self.pictures.one_per_file), self)
        help_.setWordWrap(True)
        column = QVBoxLayout()
        column.setSpacing(theme.SPACING)
        column.addWidget(help_)
        column.addWidget(self.brightest)
        for title, box in ((tr("Window"), self.windows), (tr("New boxes"), self.scope)):
            row = QHBoxLayout()
            row.addWidget(PlainLabel(title, self))
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
