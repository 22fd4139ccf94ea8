"""The work that goes on beside the window: a thin strip with a bar and Cancel for each task."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QToolButton, QVBoxLayout, QWidget

from app.views.kit import theme
from app.views.kit.background import BackgroundTask
from app.views.kit.elided_label import ElidedLabel
from app.views.kit.names import NAMES
from app.views.kit.text import tr


class ProgressStrip(QWidget):
    """Shows every task it is given until it ends; an `Indicator` for `run_in_background`."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._rows = QVBoxLayout(self)
        self._rows.setContentsMargins(0, 0, 0, 0)
        self._rows.setSpacing(0)
        self._shown = 0
        self.hide()

    @property
    def count(self) -> int:
        """Tasks that are shown."""
        return self._shown

    def show_task(self, task: BackgroundTask, title: str) -> None:
        """Follow a task."""
        row = _Row(title, self)
        row.cancel.clicked.connect(task.cancel)
        task.progressed.connect(row.show_progress)
        task.finished.connect(lambda: self._remove(row))
        self._rows.addWidget(row)
        self._shown += 1
        self.show()

    def _remove(self, row: QWidget) -> None:
        self._rows.removeWidget(row)
        row.hide()
        row.deleteLater()
        self._shown -= 1
        self.setVisible(self._shown > 0)


class _Row(QWidget):
    def __init__(self, title: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._title, self._line = title, title
        self._text = ElidedLabel(parent=self)
        self._bar = QProgressBar(self)
        self._bar.setRange(0, 1000)
        self._bar.setTextVisible(False)
        self._bar.setFixedHeight(8)
        self._bar.setMinimumWidth(80)
        self.cancel = QToolButton(self)
        self.cancel.setText(tr("Cancel"))
        row = QHBoxLayout(self)
        row.setContentsMargins(theme.MARGIN, 2, theme.SPACING, 2)
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

    def _write(self) -> None:
        """Write the title, without names while they are hidden."""
        self._text.set_whole(NAMES.without_names(self._line))
