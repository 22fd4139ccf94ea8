"""What is to be done before an attempt can begin with the needle out of the skin."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from app.session.snapshot import Snapshot
from app.views.kit import theme
from app.views.kit.text import tr


class WithdrawalNote(QWidget):
    """Words and, where nothing measures the depth, the button by which the student vouches for it.

    Signals:
        confirmed(): the student says that the needle is out.
    """

    confirmed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._words = QLabel(self)
        self._words.setWordWrap(True)
        self._words.setStyleSheet(f"color: {theme.WARNING};")
        self.button = QPushButton(tr("The needle is out"), self)
        self.button.setToolTip(
            tr("Recorded as your word, not as measured; a depth inside the skin refutes it")
        )
        self.button.clicked.connect(self.confirmed)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._words)
        column.addWidget(self.button)
        self.hide()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show what a snapshot says, or nothing."""
        if snapshot.withdrawal != self._words.text():
            self._words.setText(snapshot.withdrawal)
            self.setVisible(bool(snapshot.withdrawal))
        self.button.setVisible(snapshot.may_confirm)
