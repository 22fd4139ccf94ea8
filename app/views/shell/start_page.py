"""The first page: what this is, and the three ways to begin."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from app.exercises.schema import Exercise
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.shell.shortcuts import disclaimer_label

CARD_WIDTH = 420


class StartPage(QWidget):
    """Exercises, own CTs, past sessions.

    Signals:
        exercise_chosen(str): identifier of the exercise to begin.
        open_wanted(): a CT folder shall be asked for.
        recent_chosen(object): path of a CT that was opened before.
        sessions_wanted(): past attempts.
    """

    exercise_chosen = Signal(str)
    open_wanted = Signal()
    recent_chosen = Signal(object)
    sessions_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.exercises, self.recents = QListWidget(self), QListWidget(self)
        self.search, self.hint = QLineEdit(self), QLabel(self)
        self.search.setPlaceholderText(tr("Search exercises"))
        self.search.setAccessibleName(tr("Search exercises"))
        self.search.setClearButtonEnabled(True)
        self.hint.setWordWrap(True)
        self.hint.setTextFormat(Qt.TextFormat.PlainText)
        self.hint.setProperty("role", "dim")
        self.begin = QPushButton(tr("Begin exercise"), self)
        self.begin.setProperty("role", "primary")
        self.open = QPushButton(tr("Open CT folder…"), self)
        self.sessions = QPushButton(tr("Past sessions"), self)
        self.exercises.setWordWrap(True)
        self._lay_out()
        self.setTabOrder(self.exercises, self.search)  # arrows and Enter choose from the start
        self.begin.clicked.connect(self._begin)
        self.search.textChanged.connect(self._find)
        self.search.returnPressed.connect(self._begin)
        self.exercises.itemActivated.connect(self._begin)
        self.open.clicked.connect(self.open_wanted)
        self.sessions.clicked.connect(self.sessions_wanted)
        self.recents.itemActivated.connect(
            lambda item: self.recent_chosen.emit(item.data(Qt.ItemDataRole.UserRole))
        )

    def set_exercises(self, exercises: Sequence[Exercise]) -> None:
        """List the exercises, easiest first."""
        self.exercises.clear()
        for exercise in exercises:
            item = QListWidgetItem(f"{'●' * exercise.level}  {exercise.title}")
            item.setToolTip(exercise.description)
            item.setData(Qt.ItemDataRole.UserRole, exercise.id)
            self.exercises.addItem(item)
        self.exercises.setCurrentRow(0)
        self._find()

    def set_recents(self, paths: Sequence[Path]) -> None:
        """List CTs that were opened before."""
        self.recents.clear()
        for path in paths:
            item = QListWidgetItem(NAMES.shown(path.name))
            item.setToolTip(NAMES.shown(str(path)))
            item.setData(Qt.ItemDataRole.UserRole, path)
            self.recents.addItem(item)
        if not paths:
            hint = QListWidgetItem(tr("CTs that you open are listed here."))
            hint.setFlags(Qt.ItemFlag.NoItemFlags)
            self.recents.addItem(hint)

    def _find(self) -> None:
        """Show the exercises whose title or description holds every word that is searched."""
        words = self.search.text().casefold().split()
        found: list[QListWidgetItem] = []
        for row in range(self.exercises.count()):
            item = self.exercises.item(row)
            text = f"{item.text()} {item.toolTip()}".casefold()
            item.setHidden(not all(word in text for word in words))
            if not item.isHidden():
                found.append(item)
        if found and self.exercises.currentItem() not in found:
            self.exercises.setCurrentItem(found[0])
        self.begin.setEnabled(bool(found))
        self.hint.setVisible(not found)
        self.hint.setText(
            tr("No exercise holds these words: clear the search to see all.")
            if self.exercises.count()
            else tr("No exercises found.")
        )

    def _begin(self) -> None:
        item = self.exercises.currentItem()
        if item is not None and not item.isHidden():
            self.exercise_chosen.emit(item.data(Qt.ItemDataRole.UserRole))

    def _lay_out(self) -> None:
        title, what = QLabel("Acus"), QLabel(tr("CT-guided needle insertion, practised by hand"))
        title.setStyleSheet("font-size: 44px; font-weight: 300; letter-spacing: 4px;")
        what.setProperty("role", "dim")
        cards = QHBoxLayout()
        cards.setSpacing(2 * theme.MARGIN)
        cards.addWidget(
            _card(tr("Exercises"), [self.search, self.exercises, self.hint, self.begin])
        )
        cards.addWidget(_card(tr("Your own CT"), [self.recents, self.open, self.sessions]))
        page = QVBoxLayout(self)
        page.setSpacing(theme.SPACING)
        page.addStretch(1)
        for widget in (title, what):
            page.addWidget(widget, 0, Qt.AlignmentFlag.AlignHCenter)
        page.addSpacing(2 * theme.MARGIN)
        row = QHBoxLayout()
        row.addStretch(1)
        row.addLayout(cards)
        row.addStretch(1)
        page.addLayout(row)
        page.addStretch(2)
        page.addWidget(disclaimer_label(self))


def _card(heading: str, widgets: Sequence[QWidget]) -> QFrame:
    card = QFrame()
    card.setProperty("role", "panel")
    card.setFixedSize(CARD_WIDTH, 340)
    column = QVBoxLayout(card)
    column.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
    column.setSpacing(theme.SPACING)
    label = QLabel(heading)
    label.setProperty("role", "heading")
    column.addWidget(label)
    for widget in widgets:
        column.addWidget(widget)
    return card
