"""The first page: the exercise that comes next as one big button, and the map of all skills.

It stands before anything heavy is loaded. Pictures that are kept and what has been done so far are
read beside the window, by `StartFacts`, once it is shown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFontMetrics,
    QKeySequence,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QResizeEvent,
    QShortcut,
    QShowEvent,
)
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app.exercises.portrait import Portrait
from app.exercises.schema import Exercise
from app.views.kit import theme
from app.views.kit.lines import PseudonymLine, SearchLine
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel
from app.views.kit.text import declared, literal, tr
from app.views.shell.shortcuts import disclaimer_label
from app.views.shell.skill_map import SkillMap
from app.views.shell.skill_place import fitting
from app.views.shell.skill_portrait import paint_face

if TYPE_CHECKING:
    from app.session.board import Standing

CARD: Final = (320, 0.235, 460)
"""Width of what stands beside the map: least [px], share of the page, most [px]."""

SEARCH_WIDTH: Final = 240
PICTURE: Final = (110, 360)
"""Least and largest height of the picture of what comes next [px]."""

AROUND: Final = 1.35
"""How many times as wide as in the map its patient is shown beside it."""

ABOUT_LINES: Final = 4


class StartPage(QWidget):
    """What comes next, the map of skills, own CTs.

    Attributes:
        map: all exercises.
        begin: the big button; it begins the exercise that it names.
        comes: identifier of that exercise, which the map marks; empty for none.

    Signals:
        exercise_chosen(str): identifier of the exercise to begin.
        recent_chosen(object): path of a CT that was opened before.
        named(str): the name under which who is here practises.
        tour_wanted(bool): whether the tour that is offered shall begin, or not be offered again.
    """

    exercise_chosen = Signal(str)
    recent_chosen = Signal(object)
    named = Signal(str)
    tour_wanted = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.comes = ""
        self.begin, self.map = BigButton(self), SkillMap(self)
        self.recents = QListWidget(self)
        self.recents.setAccessibleName(tr("Your own CT"))
        self.recents.setWordWrap(True)
        self.recents.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.search, self.hint = SearchLine(tr("Search exercises"), self), PlainLabel(self)
        self.hint.setWordWrap(True)
        self.hint.setProperty("role", "dim")
        self.whose, self.about = PlainLabel(self), PlainLabel(self)
        for label in (self.whose, self.about):
            label.setProperty("role", "dim")
            label.setWordWrap(True)
        self.picture, self.who = NextPicture(self), NameLine(self)
        self.offer = QWidget(self)
        self.tour = QPushButton(tr("Three-minute tour"), self.offer)
        self.no_tour = QPushButton(tr("Not now"), self.offer)
        self.offer.hide()
        self._lay_out()
        self.tour.clicked.connect(lambda: self._answer(True))
        self.no_tour.clicked.connect(lambda: self._answer(False))
        self.begin.clicked.connect(self._begin)
        self.map.chosen.connect(self.exercise_chosen)
        self.search.textChanged.connect(self._find)
        self.search.returnPressed.connect(self._begin_first)
        start = QShortcut(QKeySequence(Qt.Key.Key_F5), self)
        start.activated.connect(self._begin)
        self.who.line.editingFinished.connect(lambda: self.named.emit(self.who.line.text()))
        self.recents.itemActivated.connect(
            lambda item: self.recent_chosen.emit(item.data(Qt.ItemDataRole.UserRole))
        )

    def set_exercises(self, exercises: Sequence[Exercise]) -> None:
        """Show the exercises, easiest first; what is known of them stays."""
        self.map.set_exercises(exercises)
        if self.comes not in self.map.places:
            self.comes = next(iter(self.map.places), "")
        self._show_next()
        self._find()

    def set_portrait(self, identifier: str, portrait: Portrait) -> None:
        """Show the patient of an exercise."""
        self.map.show_portrait(identifier, portrait)
        if identifier == self.comes:
            self._show_next()

    def set_standings(
        self,
        standings: Mapping[str, Standing],
        comes: str,
        whose: str,
        of_one: bool = True,
        course: Sequence[str] = (),
    ) -> None:
        """Show how far somebody has come.

        Args:
            standings: by identifier of the exercise; those that are not in it were never done.
            comes: identifier of the exercise that comes next; empty for none.
            whose: says whose these are.
            of_one: whether they are one person's.
            course: identifiers in the order of the course that is followed; empty for none.
        """
        self.whose.setText(whose)
        self.comes = comes
        self.map.set_standings(standings, comes, of_one, course)
        self._show_next()

    def set_recents(self, paths: Sequence[Path]) -> None:
        """List CTs that were opened before."""
        self.recents.clear()
        for path in paths:
            item = QListWidgetItem(NAMES.shown(path.name))
            item.setToolTip(literal(NAMES.shown(str(path))))
            item.setData(Qt.ItemDataRole.UserRole, path)
            self.recents.addItem(item)
        if not paths:
            hint = QListWidgetItem(tr("CTs that you open are listed here: File ▸ Open CT folder…"))
            hint.setFlags(Qt.ItemFlag.NoItemFlags)
            self.recents.addItem(hint)

    def offer_tour(self, offered: bool) -> None:
        """Offer the tour, beside everything else, or no more."""
        self.offer.setVisible(offered)

    def showEvent(self, event: QShowEvent) -> None:
        """Let Enter begin what comes next."""
        super().showEvent(event)
        self.begin.setFocus()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Share the width between card and map."""
        super().resizeEvent(event)
        self._share()

    def changeEvent(self, event: QEvent) -> None:
        """Share it anew where the text has another size."""
        super().changeEvent(event)
        if event.type() is QEvent.Type.StyleChange:
            self._share()

    # --- inside -------------------------------------------------------------------------------
    def _share(self) -> None:
        least, share, most = CARD
        larger = theme.scale() ** 0.5
        width = min(max(least * larger, share * self.width()), most * larger)
        if round(width) != self.card.width():
            self.card.setFixedWidth(round(width))
        self._write_about()

    def _answer(self, wanted: bool) -> None:
        self.offer_tour(False)
        self.tour_wanted.emit(wanted)

    def _show_next(self) -> None:
        """Name what comes next, on the button and over it."""
        place = self.map.places.get(self.comes)
        self.begin.setEnabled(place is not None)
        if place is None:
            self.begin.say(tr("Continue"), tr("No exercise is open to you now."))
            self.about.setText("")
            self.picture.show_exercise(None, None)
            return
        self.begin.say(tr("Continue"), declared(place.exercise.title))
        self.picture.show_exercise(place.exercise, place.portrait)
        self._write_about()

    def _write_about(self) -> None:
        place = self.map.places.get(self.comes)
        if place is None:
            return
        metrics = QFontMetrics(theme.font_of(theme.SMALL_PX))
        width = self.card.width() - 2 * theme.MARGIN - 2
        whole = declared(place.exercise.description)
        text = fitting(whole, metrics, width, ABOUT_LINES)
        self.about.setText(text)
        self.about.setToolTip(literal(whole) if text != whole else "")

    def _find(self) -> None:
        """Show the exercises whose title or description holds every word that is searched."""
        found = self.map.narrow(self.search.text().casefold().split())
        self.hint.setVisible(not found)
        self.hint.setText(
            tr("No exercise holds these words: clear the search to see all.")
            if self.map.places
            else tr("No exercises found.")
        )

    def _begin(self) -> None:
        if self.comes in self.map.places:
            self.exercise_chosen.emit(self.comes)

    def _begin_first(self) -> None:
        """Begin the first exercise that the search shows."""
        words = self.search.text().casefold().split()
        found = self.map.narrow(words) if words else []
        if found:
            self.exercise_chosen.emit(found[0])

    def _lay_out(self) -> None:
        title, what = (
            PlainLabel("Acus"),
            PlainLabel(tr("CT-guided needle insertion, practised by hand")),
        )
        title.setStyleSheet("font-size: 32px; font-weight: 300; letter-spacing: 3px;")
        what.setProperty("role", "dim")
        head = QHBoxLayout()
        head.setSpacing(2 * theme.MARGIN)
        for widget in (title, what):
            head.addWidget(widget, 0, Qt.AlignmentFlag.AlignBottom)
        head.addStretch(1)
        self.search.setFixedWidth(SEARCH_WIDTH)
        head.addWidget(self.search, 0, Qt.AlignmentFlag.AlignBottom)
        self.offer.setProperty("role", "clear")
        first = QGridLayout(self.offer)
        first.setContentsMargins(0, 0, 0, 0)
        first.setSpacing(theme.SPACING)
        first.addWidget(PlainLabel(tr("First time here?"), self.offer), 0, 0)
        first.addWidget(self.no_tour, 0, 1)
        first.addWidget(self.tour, 1, 0, 1, 2)
        first.setColumnStretch(0, 1)
        lessons = QVBoxLayout()
        lessons.setSpacing(theme.SPACING)
        lessons.addWidget(self.hint)
        lessons.addWidget(self.map, 1)
        row = QHBoxLayout()
        row.setSpacing(2 * theme.MARGIN)
        row.addWidget(self._card())
        row.addLayout(lessons, 1)
        page = QVBoxLayout(self)
        page.setContentsMargins(2 * theme.MARGIN, theme.MARGIN, 2 * theme.MARGIN, 0)
        page.setSpacing(theme.MARGIN)
        page.addLayout(head)
        page.addLayout(row, 1)
        page.addWidget(disclaimer_label(self))

    def _card(self) -> QFrame:
        """Return what stands beside the map: picture and button of what comes next, who, CTs."""
        self.own = QWidget(self)
        self.own.setProperty("role", "clear")
        own = QVBoxLayout(self.own)
        own.setContentsMargins(0, theme.SPACING, 0, 0)
        heading = PlainLabel(tr("Your own CT"))
        heading.setProperty("role", "heading")
        own.addWidget(heading)
        own.addWidget(self.recents, 1)
        self.card = QFrame(self)
        self.card.setProperty("role", "panel")
        column = QVBoxLayout(self.card)
        column.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
        column.setSpacing(theme.SPACING)
        column.addWidget(self.picture, 2)  # it takes what the others leave
        column.addWidget(self.begin)
        column.addWidget(self.about)
        column.addWidget(self.own, 1)
        column.addStretch()
        for widget in (self.offer, self.who, self.whose):
            column.addWidget(widget)
        return self.card


class BigButton(QPushButton):
    """The one big button: what it does, and the exercise that it names below."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._name = ""
        self.verb, self.name = PlainLabel(self), PlainLabel(self)
        self.verb.setProperty("role", "title")
        self.name.setProperty("role", "heading")
        lines = QVBoxLayout(self)
        lines.setContentsMargins(theme.MARGIN, theme.SPACING, theme.MARGIN, theme.SPACING)
        lines.setSpacing(0)
        for label in (self.verb, self.name):
            label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            label.setAlignment(Qt.AlignmentFlag.AlignCenter)
            lines.addWidget(label)
        self.setProperty("role", "primary")
        self.setAutoDefault(True)  # Enter presses it
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)

    def say(self, verb: str, name: str) -> None:
        """Show a verb and the title of an exercise."""
        self._name = name
        self.verb.setText(verb)
        self.setAccessibleName(f"{verb}: {name}")
        ink = theme.present().on_accent if self.isEnabled() else theme.present().disabled
        for label in (self.verb, self.name):
            label.setStyleSheet(f"color: {ink};")
        self._fit()

    def sizeHint(self) -> QSize:
        """Return two lines with air."""
        verb = QFontMetrics(theme.font_of(theme.TITLE_PX, True)).height()
        name = QFontMetrics(theme.font_of(theme.FONT_PX, True)).height()
        return QSize(theme.px(160), verb + name + 2 * theme.px(theme.MARGIN))

    def minimumSizeHint(self) -> QSize:
        """Return the same: a long title gives way."""
        return self.sizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show more or less of the title."""
        super().resizeEvent(event)
        self._fit()

    def changeEvent(self, event: QEvent) -> None:
        """Take another height where the text has another size."""
        super().changeEvent(event)
        if event.type() is QEvent.Type.StyleChange:
            self.updateGeometry()

    def _fit(self) -> None:
        room = max(self.width() - 3 * theme.MARGIN, theme.px(80))
        metrics = QFontMetrics(theme.font_of(theme.FONT_PX, True))
        name = metrics.elidedText(self._name, Qt.TextElideMode.ElideRight, room)
        self.name.setText(name)
        for widget in (self.name, self):
            widget.setToolTip(literal(self._name) if name != self._name else "")


class NextPicture(QWidget):
    """The patient of the exercise that comes next."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._exercise: Exercise | None = None
        self._portrait: Portrait | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumHeight(PICTURE[0])
        self.setMaximumHeight(PICTURE[1])

    def sizeHint(self) -> QSize:
        """Return the least: its place in the layout gives it more."""
        return QSize(CARD[0], PICTURE[0])

    def show_exercise(self, exercise: Exercise | None, portrait: Portrait | None) -> None:
        """Show the patient of an exercise; nothing without one."""
        self._exercise, self._portrait = exercise, portrait
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw."""
        painter, box = QPainter(self), QRectF(self.rect())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QPainterPath()
        frame.addRoundedRect(box, 6, 6)
        painter.setClipPath(frame)
        painter.fillRect(box, QColor(theme.IMAGE_BACKGROUND))
        if self._exercise is not None and self._portrait is not None:
            paint_face(painter, box, self._exercise, self._portrait, AROUND)


class NameLine(QWidget):
    """Asks under which name somebody practises who does not sign in.

    Attributes:
        line: where it is typed.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.line = PseudonymLine(self)
        self.line.setPlaceholderText(tr("a name of your choice"))
        self.line.setAccessibleName(tr("Your name"))
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(theme.SPACING // 2)
        rows.addWidget(PlainLabel(tr("You practise as"), self))
        rows.addWidget(self.line)
