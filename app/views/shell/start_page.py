"""The first page: what this is, the exercises with how far one has come, and other ways to begin.

It stands before anything heavy is loaded. Pictures that are kept and what has been done so far are
read beside the window, by `StartFacts`, once it is shown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import (
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QRect,
    QRectF,
    QRegularExpression,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetrics,
    QKeySequence,
    QPainter,
    QRegularExpressionValidator,
    QShortcut,
)
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from app.core.progress import Progress
from app.exercises.portrait import Portrait, kept_portrait
from app.exercises.schema import Exercise
from app.views.exercise.briefing import level_words, paint_portrait
from app.views.exercise.panel import PSEUDONYM
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel
from app.views.kit.roles import Role
from app.views.kit.text import declared, literal, tr
from app.views.shell.shortcuts import disclaimer_label

if TYPE_CHECKING:
    from app.session.board import Standing
    from app.views.shell.services import Services

OWN_WIDTH: Final = 330
ROW: Final = 68
PICTURE: Final = 88
COLUMNS: Final = (("level", 120), ("done", 84), ("best", 62))
"""Columns at the right of a row, with their width."""

AnyIndex = QModelIndex | QPersistentModelIndex
_EXERCISE, _PORTRAIT, _STANDING, _NEXT = (Qt.ItemDataRole.UserRole + n for n in range(1, 5))


def standing_words(standing: Standing | None) -> tuple[str, str]:
    """Say how often something was done and how well at best; dashes where it never was."""
    if standing is None or not standing.attempts:
        return "–", "–"
    sign = "✔ " if standing.passed else ""
    best = "–" if standing.best is None else f"{standing.best:.0f}"
    return f"{sign}{standing.attempts}", best


class ExerciseRow(QStyledItemDelegate):
    """Draws an exercise: patient, title and what it is about, then columns that stand aligned."""

    def sizeHint(self, option: QStyleOptionViewItem, index: AnyIndex) -> QSize:
        """Return the same height for every row."""
        return QSize(200, theme.px(ROW))

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: AnyIndex) -> None:
        """Draw a row."""
        exercise = index.data(_EXERCISE)
        box: QRect = option.rect
        state = option.state
        chosen = bool(state & QStyle.StateFlag.State_Selected)
        ink = QColor(theme.now(theme.BACKGROUND if chosen else theme.TEXT))
        dim = ink if chosen else QColor(theme.now(theme.TEXT_DIM))
        painter.save()
        if chosen:
            painter.fillRect(box, QColor(theme.now(theme.ACCENT)))
        picture = QRectF(box.left() + 4, box.top() + 3, theme.px(PICTURE), box.height() - 6)
        painter.fillRect(picture, QColor(theme.IMAGE_BACKGROUND))
        portrait = index.data(_PORTRAIT)
        if portrait is not None:
            paint_portrait(painter, picture, portrait, "axial")
        left, right = round(picture.right()) + theme.SPACING, box.right() - theme.SPACING
        done, best = standing_words(index.data(_STANDING))
        columns = {"level": "●" * min(exercise.level, 9), "done": done, "best": best}
        painter.setFont(_font(painter, theme.FONT_PX))
        for name, width in reversed(COLUMNS):
            width = theme.px(width)
            place = QRect(right - width, box.top(), width, box.height())
            side = Qt.AlignmentFlag.AlignLeft if name == "level" else Qt.AlignmentFlag.AlignRight
            painter.setPen(ink)
            painter.drawText(place, side | Qt.AlignmentFlag.AlignVCenter, columns[name])
            right -= width
        words = QRect(left, box.top() + 4, right - left - theme.SPACING, box.height() - 8)
        self._words(painter, words, exercise, bool(index.data(_NEXT)), ink, dim)
        painter.restore()

    def _words(
        self,
        painter: QPainter,
        box: QRect,
        exercise: Exercise,
        comes: bool,
        ink: QColor,
        dim: QColor,
    ) -> None:
        top = Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft
        painter.setFont(_font(painter, theme.FONT_PX, True))
        title = declared(exercise.title) + ("   ▸ " + tr("next") if comes else "")
        metrics = QFontMetrics(painter.font())
        painter.setPen(ink)
        painter.drawText(
            box, top, metrics.elidedText(title, Qt.TextElideMode.ElideRight, box.width())
        )
        painter.setFont(_font(painter, theme.SMALL_PX))
        painter.setPen(dim)
        below = box.adjusted(0, metrics.height() + 1, 0, 0)
        small = QFontMetrics(painter.font())
        lines = max(1, below.height() // (small.lineSpacing() + 1))
        text = _fitting(declared(exercise.description), small, below.width(), lines)
        painter.drawText(below, top | Qt.TextFlag.TextWordWrap, text)


def _font(painter: QPainter, pixels: int, bold: bool = False) -> QFont:
    font = QFont(painter.font())
    font.setPixelSize(theme.px(pixels))
    font.setBold(bold)
    return font


def _fitting(text: str, metrics: QFontMetrics, width: int, lines: int) -> str:
    """Return as many whole words as stand on so many lines, with dots where some are left out."""
    words, kept = text.split(), ""
    box, flags = QRect(0, 0, width, 10_000), int(Qt.TextFlag.TextWordWrap)
    room = lines * (metrics.lineSpacing() + 1)  # Qt rounds each line up
    for number, word in enumerate(words):
        longer = f"{kept} {word}".strip()
        last = number == len(words) - 1
        tried = longer if last else f"{longer} …"
        if metrics.boundingRect(box, flags, tried).height() > room:
            return f"{kept} …"
        kept = longer
    return kept


class StartPage(QWidget):
    """Exercises, own CTs, past sessions.

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
        self.exercises, self.recents = QListWidget(self), QListWidget(self)
        self.recents.setAccessibleName(tr("Your own CT"))
        self.recents.setWordWrap(True)
        self.recents.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.search, self.hint = QLineEdit(self), PlainLabel(self)
        self.search.setPlaceholderText(tr("Search exercises"))
        self.search.setAccessibleName(tr("Search exercises"))
        self.search.setClearButtonEnabled(True)
        self.hint.setWordWrap(True)
        self.hint.setProperty("role", "dim")
        self.whose = PlainLabel(self)
        self.whose.setProperty("role", "dim")
        self.begin = QPushButton(tr("Begin exercise"), self)
        self.begin.setProperty("role", "primary")
        self.who = NameLine(self)
        self.exercises.setItemDelegate(ExerciseRow(self.exercises))
        self.exercises.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.exercises.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOn)
        self.exercises.setVerticalScrollMode(QListWidget.ScrollMode.ScrollPerPixel)
        self.exercises.setUniformItemSizes(True)
        self.exercises.setAccessibleName(tr("Exercises"))
        self.offer = QWidget(self)
        self.tour = QPushButton(tr("Three-minute tour"), self.offer)
        self.no_tour = QPushButton(tr("Not now"), self.offer)
        self.offer.hide()
        self._lay_out()
        self.tour.clicked.connect(lambda: self._answer(True))
        self.no_tour.clicked.connect(lambda: self._answer(False))
        self.setTabOrder(self.exercises, self.search)  # arrows and Enter choose from the start
        self.begin.clicked.connect(self._begin)
        self.search.textChanged.connect(self._find)
        self.search.returnPressed.connect(self._begin)
        self.exercises.itemActivated.connect(self._begin)
        start = QShortcut(QKeySequence(Qt.Key.Key_F5), self)
        start.activated.connect(self._begin)
        self.who.line.editingFinished.connect(lambda: self.named.emit(self.who.line.text()))
        self.recents.itemActivated.connect(
            lambda item: self.recent_chosen.emit(item.data(Qt.ItemDataRole.UserRole))
        )

    def set_exercises(self, exercises: Sequence[Exercise]) -> None:
        """List the exercises, easiest first; what is known of them stays."""
        chosen, known = self._chosen(), self._known()
        self.exercises.clear()
        for exercise in exercises:
            item = QListWidgetItem(declared(exercise.title))
            item.setToolTip(literal(declared(exercise.description)))
            item.setData(Qt.ItemDataRole.UserRole, exercise.id)
            item.setData(_EXERCISE, exercise)
            for role, value in known.get(exercise.id, {}).items():
                item.setData(role, value)
            self.exercises.addItem(item)
            self._say(item)
        place = next((n for n, one in enumerate(exercises) if one.id == chosen), 0)
        self.exercises.setCurrentRow(place)
        self._find()

    def set_portrait(self, identifier: str, portrait: Portrait) -> None:
        """Show the patient of an exercise."""
        for item in self._items():
            if item.data(Qt.ItemDataRole.UserRole) == identifier:
                item.setData(_PORTRAIT, portrait)

    def set_standings(self, standings: Mapping[str, Standing], comes: str, whose: str) -> None:
        """Show how far somebody has come.

        Args:
            standings: by identifier of the exercise; those that are not in it were never done.
            comes: identifier of the exercise that comes next; empty for none.
            whose: says whose these are.
        """
        self.whose.setText(whose)
        for item in self._items():
            name = item.data(Qt.ItemDataRole.UserRole)
            item.setData(_STANDING, standings.get(name))
            item.setData(_NEXT, name == comes)
            self._say(item)

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

    # --- inside -------------------------------------------------------------------------------
    def _answer(self, wanted: bool) -> None:
        self.offer_tour(False)
        self.tour_wanted.emit(wanted)

    def _items(self) -> list[QListWidgetItem]:
        return [self.exercises.item(row) for row in range(self.exercises.count())]

    def _chosen(self) -> str:
        item = self.exercises.currentItem()
        return "" if item is None else str(item.data(Qt.ItemDataRole.UserRole))

    def _known(self) -> dict[str, dict[int, object]]:
        roles = (_PORTRAIT, _STANDING, _NEXT)
        return {
            item.data(Qt.ItemDataRole.UserRole): {role: item.data(role) for role in roles}
            for item in self._items()
        }

    def _say(self, item: QListWidgetItem) -> None:
        """Tell in words what the row draws, for those who hear it."""
        exercise = item.data(_EXERCISE)
        done, best = standing_words(item.data(_STANDING))
        parts = [declared(exercise.title), level_words(exercise.level)]
        if done != "–":
            parts += [tr("done {n}", n=done), tr("best {points}", points=best)]
        if item.data(_NEXT):
            parts.append(tr("next"))
        item.setData(Qt.ItemDataRole.AccessibleTextRole, ", ".join(parts))

    def _find(self) -> None:
        """Show the exercises whose title or description holds every word that is searched."""
        words = self.search.text().casefold().split()
        found: list[QListWidgetItem] = []
        for item in self._items():
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
        first = QHBoxLayout(self.offer)
        first.setContentsMargins(0, 0, 0, 0)
        first.addWidget(PlainLabel(tr("First time here?"), self.offer))
        first.addWidget(self.tour)
        first.addWidget(self.no_tour)
        head.addWidget(self.offer, 0, Qt.AlignmentFlag.AlignBottom)
        row = QHBoxLayout()
        row.setSpacing(2 * theme.MARGIN)
        row.addWidget(
            _card(
                tr("Exercises"),
                (
                    self.search,
                    ColumnTitles(self),
                    self.exercises,
                    self.hint,
                    self.who,
                    self.whose,
                    self.begin,
                ),
            ),
            1,
        )
        self.own = _card(tr("Your own CT"), (self.recents,))
        self.own.setFixedWidth(OWN_WIDTH)
        row.addWidget(self.own)
        page = QVBoxLayout(self)
        page.setContentsMargins(3 * theme.MARGIN, theme.MARGIN, 3 * theme.MARGIN, 0)
        page.setSpacing(theme.SPACING)
        page.addLayout(head)
        page.addLayout(row, 1)
        page.addWidget(disclaimer_label(self))


class NameLine(QWidget):
    """Asks under which name somebody practises who does not sign in.

    Attributes:
        line: where it is typed.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.line = QLineEdit(self)
        self.line.setPlaceholderText(tr("any name: your progress is kept under it"))
        self.line.setAccessibleName(tr("Your name"))
        self.line.setMaximumWidth(theme.px(OWN_WIDTH))
        self.line.setValidator(
            QRegularExpressionValidator(QRegularExpression(f"^{PSEUDONYM}$"), self.line)
        )
        self.line.setToolTip(
            tr("A pseudonym, never a name: it goes into every record. Letters, digits, . _ -")
        )
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(PlainLabel(tr("You practise as"), self))
        row.addWidget(self.line, 1)
        row.addStretch(1)


class ColumnTitles(QWidget):
    """Names of the columns, over them."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        titles = {"level": tr("Difficulty"), "done": tr("Done"), "best": tr("Best")}
        row = QHBoxLayout(self)
        bar = self.style().pixelMetric(QStyle.PixelMetric.PM_ScrollBarExtent)
        row.setContentsMargins(theme.SPACING, 0, theme.SPACING + bar, 0)
        row.setSpacing(0)
        row.addStretch(1)
        for name, width in COLUMNS:
            title = PlainLabel(titles[name], self)
            title.setProperty("role", "dim")
            title.setFixedWidth(theme.px(width))
            side = Qt.AlignmentFlag.AlignLeft if name == "level" else Qt.AlignmentFlag.AlignRight
            title.setAlignment(side | Qt.AlignmentFlag.AlignVCenter)
            title.setContentsMargins(0, 0, 0, 0)
            row.addWidget(title)


def _card(heading: str, widgets: Sequence[QWidget]) -> QFrame:
    card = QFrame()
    card.setProperty("role", "panel")
    column = QVBoxLayout(card)
    column.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
    column.setSpacing(theme.SPACING)
    label = PlainLabel(heading)
    label.setProperty("role", "heading")
    column.addWidget(label)
    for widget in widgets:
        column.addWidget(widget)
    return card


class StartFacts(QObject):
    """Reads beside the window what the start page tells of patients and of what was done.

    One thing at a time, and nothing while somebody opens a patient or has an attempt.
    """

    def __init__(self, page: StartPage, services: Services, parent: QObject) -> None:
        super().__init__(parent)
        self._page, self._services = page, services
        self._standings: BackgroundTask | None = None
        self._picture: BackgroundTask | None = None
        self._pictured: set[str] = set()
        self._may_picture = False
        ACCESS.changed.connect(self._follow)

    @property
    def pictured(self) -> int:
        """Exercises whose patient was looked for."""
        return len(self._pictured)

    def begin(self) -> None:
        """Show what is kept, and read the rest: the window stands."""
        self.show_kept()
        self.refresh()

    def refresh(self) -> None:
        """Read what was done so far; pictures that are missing follow."""
        exercises, folder = self._services.exercises(), self._services.sessions()
        student, manages = ACCESS.student, ACCESS.may_manage
        own = ACCESS.role is Role.STUDENT and student is None
        name = self._page.who.line.text() if own else ""
        if self._standings is not None:
            self._standings.drop()

        def read(_: Progress) -> tuple[dict[str, Standing], str]:
            from app.session.board import standings  # SQLAlchemy: beside the window
            from app.session.next_exercise import comes_next

            found = standings(
                folder, exercises, student, (lambda one: one == name) if name else ACCESS.may_see
            )
            passed = {name for name, standing in found.items() if standing.passed}
            return found, comes_next(passed, exercises, student, ACCESS.refusal)

        def show(result: tuple[dict[str, Standing], str]) -> None:
            whose = (
                tr("Done and best: everybody at this station. Sign in to see your own.")
                if student is None
                else tr("Done and best: {name}.", name=NAMES.shown(student.pseudonym))
            )
            if name:
                whose = tr("Done and best: {name}.", name=NAMES.shown(name))
            elif own and not ACCESS.guarded:
                whose = tr("Done and best: everybody at this station.")
            elif student is None and not manages:
                whose = tr("Sign in as a student to see what you have done.")
            self._page.set_standings(*result, whose)
            self._done()

        self._standings = run_in_background(self, read, show, lambda _: self._done())

    def let_picture(self, may: bool) -> None:
        """Let pictures be made that are missing, or have that wait."""
        self._may_picture = may
        if not may and self._picture is not None:
            self._picture.drop()
            self._picture = None
        elif may:
            self._next_picture()

    def show_kept(self) -> None:
        """Show the pictures that are kept already: files of some ten kilobytes."""
        for exercise in self._services.exercises():
            portrait = kept_portrait(exercise) if exercise.id not in self._pictured else None
            if portrait is not None:
                self._pictured.add(exercise.id)
                self._page.set_portrait(exercise.id, portrait)

    def close(self) -> None:
        """End what runs; idempotent."""
        for task in (self._standings, self._picture):
            if task is not None:
                task.close()
        self._standings = self._picture = None
        self._may_picture = False

    def _follow(self) -> None:
        if self._page.isVisible():
            self.refresh()

    def _done(self) -> None:
        self._standings = None
        self._next_picture()

    def _next_picture(self) -> None:
        missing = [one for one in self._services.exercises() if one.id not in self._pictured]
        if self._picture is not None or not self._may_picture or not missing:
            return
        exercise, services = missing[0], self._services

        def show(portrait: Portrait | None) -> None:
            self._picture = None
            self._pictured.add(exercise.id)
            if portrait is not None:
                self._page.set_portrait(exercise.id, portrait)
            self._next_picture()

        self._picture = run_in_background(
            self,
            lambda progress: services.portrait(exercise, None, progress),
            show,
            lambda _: show(None),
        )
