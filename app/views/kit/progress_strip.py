"""The work that goes on beside the window: a thin strip with one bar, and Cancel.

Of several tasks the oldest is shown, and how many others there are: two bars would lie over the
picture, and tell no more.
"""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QHBoxLayout,
    QProgressBar,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.views.kit import theme
from app.views.kit.background import BackgroundTask
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, tr

NARROWEST_PX = 60


class ElidedLabel(PlainLabel):
    """A label of one line that never asks for more room than there is.

    Attributes:
        narrowest: width [px] at the usual size of the text that it asks for in any case.
    """

    def __init__(
        self, text: str = "", parent: QWidget | None = None, narrowest: int = NARROWEST_PX
    ) -> None:
        super().__init__(parent)
        self._whole, self.narrowest = "", narrowest
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Preferred)
        self.set_whole(text)

    @property
    def whole(self) -> str:
        """The text as it is, whatever of it can be seen."""
        return self._whole

    def set_whole(self, text: str) -> None:
        """Show as much of a text as there is room for."""
        self._whole = " ".join(text.split())
        self.updateGeometry()
        self._elide()

    def sizeHint(self) -> QSize:
        """Return what the whole text would take."""
        return QSize(self.fontMetrics().horizontalAdvance(self._whole) + 2, self._height())

    def minimumSizeHint(self) -> QSize:
        """Return what a few letters take, or more where more is asked for."""
        return QSize(min(theme.px(self.narrowest), self.sizeHint().width()), self._height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show more or less of it."""
        super().resizeEvent(event)
        self._elide()

    def _height(self) -> int:
        return super().sizeHint().height()

    def _elide(self) -> None:
        room = self.contentsRect().width()
        shown = self.fontMetrics().elidedText(self._whole, Qt.TextElideMode.ElideRight, room)
        if shown != self.text():
            self.setText(shown)
        self.setToolTip(literal(self._whole if shown != self._whole else ""))


class ProgressStrip(QWidget):
    """Shows the oldest task that it was given until it ends, then the next one.

    An `Indicator` for `run_in_background`.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._rows = QVBoxLayout(self)
        self._rows.setContentsMargins(0, 0, 0, 0)
        self._rows.setSpacing(0)
        self._tasks: list[_Row] = []
        self.hide()

    @property
    def count(self) -> int:
        """Tasks that go on."""
        return len(self._tasks)

    def show_task(self, task: BackgroundTask, title: str) -> None:
        """Follow a task."""
        row = _Row(title, self)
        row.cancel.clicked.connect(row.say_cancelling)
        row.cancel.clicked.connect(task.cancel)
        task.progressed.connect(row.show_progress)
        task.finished.connect(lambda: self._remove(row))
        self._rows.addWidget(row)
        self._tasks.append(row)
        self._show_oldest()

    def _remove(self, row: _Row) -> None:
        self._rows.removeWidget(row)
        row.hide()
        row.deleteLater()
        self._tasks.remove(row)
        self._show_oldest()

    def _show_oldest(self) -> None:
        for row in self._tasks[1:]:
            row.hide()
        for row in self._tasks[:1]:
            row.set_others(len(self._tasks) - 1)
            row.show()
        self.setVisible(bool(self._tasks))


class _Row(QWidget):
    def __init__(self, title: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._title, self._line, self._others = title, title, 0
        self._text = ElidedLabel(parent=self)
        self._bar = QProgressBar(self)
        self._bar.setRange(0, 1000)
        self._bar.setTextVisible(False)
        self._bar.setFixedHeight(8)
        self._bar.setMinimumWidth(80)
        self.cancel = QToolButton(self)
        self.cancel.setText(tr("Cancel"))
        self.cancel.setProperty("role", "notice")
        row = QHBoxLayout(self)
        row.setContentsMargins(theme.MARGIN, 1, theme.SPACING, 1)
        row.addWidget(self._text)
        row.addWidget(self._bar, 1, Qt.AlignmentFlag.AlignVCenter)
        row.addWidget(self.cancel)
        NAMES.changed.connect(self._write)
        self._write()

    def show_progress(self, fraction: float, text: str) -> None:
        """Move the bar."""
        self._bar.setValue(int(1000 * fraction))
        self._line = f"{self._title}: {text}" if text else self._title
        self._write()

    def set_others(self, count: int) -> None:
        """Say how many tasks go on beside this one."""
        self._others = count
        self._write()

    def say_cancelling(self) -> None:
        """Say that the wish was heard: the work ends where it can."""
        self.cancel.setEnabled(False)
        self.cancel.setText(tr("Cancelling…"))

    def _write(self) -> None:
        """Write the title, without names while they are hidden."""
        line = self._line
        if self._others:
            line = tr("{work} (and {count} more)", work=line, count=self._others)
        self._text.set_whole(NAMES.without_names(line))
