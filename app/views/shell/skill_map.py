"""The map of skills: every exercise a place, by skill and level, research machines on a shelf.

Skills run from left to right and below one another, each with its exercises in the order of their
levels and a line from one to the next; what has room stands side by side, as large as it can be.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QEvent, QPoint, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QSizePolicy, QWidget

from app.exercises.portrait import Portrait
from app.exercises.practised_skill import PractisedSkill, practised_skill
from app.exercises.schema import Exercise
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import declared, literal, tr
from app.views.shell.skill_place import Advance, SkillPlace

if TYPE_CHECKING:
    from app.session.board import Standing

NARROWEST: Final = 132
"""Width of a place at least [px]."""

FACES: Final = (72, 220)
"""Least and largest width of a face [px]."""

MOST_COLUMNS: Final = 6
GAP: Final = 10


def skill_title(skill: PractisedSkill) -> str:
    """Name a skill for people."""
    return {
        PractisedSkill.HAND: tr("Hand and tissue"),
        PractisedSkill.BREATH: tr("With the breath"),
        PractisedSkill.CLEARANCE: tr("Past what must not be met"),
        PractisedSkill.PLAN: tr("Plan and control"),
        PractisedSkill.PROCEDURE: tr("Whole procedures"),
        PractisedSkill.MACHINE: tr("Research machines"),
    }[skill]


@dataclass(slots=True)
class _SkillGroup:
    """A skill with its heading and its places."""

    skill: PractisedSkill
    heading: PlainLabel
    places: list[SkillPlace] = field(default_factory=list)

    @property
    def shown(self) -> list[SkillPlace]:
        return [place for place in self.places if not place.isHidden()]


@dataclass(frozen=True, slots=True)
class _SkillGrid:
    """How places stand: columns of lessons, sizes [px], whether the shelf stands beside them."""

    columns: int
    width: int
    face: int
    beside: bool


class SkillMap(QScrollArea):
    """All exercises; one of them is reached by Tab, the others by arrows.

    Attributes:
        places: by id of the exercise, in the order of their levels.

    Signals:
        chosen(str): identifier of the exercise to begin.
    """

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.places: dict[str, SkillPlace] = {}
        self._groups: list[_SkillGroup] = []
        self._current: SkillPlace | None = None
        self._field = _Field(self)
        self.setWidget(self._field)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    @property
    def current(self) -> SkillPlace | None:
        """Return the place that Tab leads to."""
        return self._current

    def minimumSizeHint(self) -> QSize:
        """Return what two columns take."""
        return QSize(2 * theme.px(NARROWEST) + 2 * GAP, theme.px(2 * NARROWEST))

    def set_exercises(self, exercises: Sequence[Exercise]) -> None:
        """Show exercises, easiest first; what is known of them stays."""
        before, self.places = self.places, {}
        for group in self._groups:
            group.heading.deleteLater()
        groups = {skill: _SkillGroup(skill, self._heading(skill)) for skill in PractisedSkill}
        for exercise in exercises:
            place = SkillPlace(exercise, self._field)
            known = before.get(exercise.id)
            if known is not None:
                place.show_portrait(known.portrait)
                place.tell(known.progress, known.is_next, known.number)
            place.clicked.connect(lambda _=False, name=exercise.id: self.chosen.emit(name))
            place.moved.connect(self._move)
            place.show()
            groups[practised_skill(exercise)].places.append(place)
            self.places[exercise.id] = place
        for old in before.values():
            old.hide()
            old.deleteLater()
        self._groups = list(groups.values())
        self._enter(next(iter(self.places.values()), None))
        self._arrange()

    def show_portrait(self, identifier: str, portrait: Portrait) -> None:
        """Show the patient of an exercise."""
        if identifier in self.places:
            self.places[identifier].show_portrait(portrait)

    def set_standings(
        self, standings: Mapping[str, Standing], comes: str, of_one: bool, course: Sequence[str]
    ) -> None:
        """Show how far somebody has come, what comes next, and the order of a course.

        Args:
            standings: by identifier of the exercise; those that are not in it were never done.
            comes: identifier of the exercise that comes next; empty for none.
            of_one: whether they are one person's.
            course: identifiers in the order of the course that is followed; empty for none.
        """
        order = {name: number for number, name in enumerate(course, 1)}
        for name, place in self.places.items():
            progress = Advance.of(standings.get(name), of_one)
            place.tell(progress, name == comes, order.get(name, 0))
        focused = any(place.hasFocus() for place in self.places.values())
        if comes in self.places and not focused:
            self._enter(self.places[comes])
        for group in self._groups:
            group.places.sort(key=lambda one: (one.number == 0, one.number, one.exercise.level))
        self._arrange()

    def narrow(self, words: Sequence[str]) -> list[str]:
        """Show the exercises alone whose title or description holds every word; return their ids.

        Args:
            words: in small letters; none shows all.
        """
        found = []
        for name, place in self.places.items():
            exercise = place.exercise
            text = f"{declared(exercise.title)} {declared(exercise.description)}".casefold()
            holds = all(word in text for word in words)
            place.setHidden(not holds)
            if holds:
                found.append(name)
        if found and (self._current is None or self._current.isHidden()):
            self._enter(self.places[found[0]])
        self._arrange()
        return found

    # --- focus --------------------------------------------------------------------------------
    def _enter(self, place: SkillPlace | None) -> None:
        """Let Tab lead to a place, and to no other."""
        for one in self.places.values():
            tab = Qt.FocusPolicy.StrongFocus if one is place else Qt.FocusPolicy.ClickFocus
            one.setFocusPolicy(tab)
        self._current = place

    def _move(self, right: int, down: int) -> None:
        """Go on or back in the order of skills and levels, or to the nearest place in a column."""
        here = self.sender()
        order = [place for group in self._groups for place in group.shown]
        if not isinstance(here, SkillPlace) or here not in order:
            return
        if right:
            number = order.index(here) + right
            there = order[number] if 0 <= number < len(order) else None
        else:
            there = _nearest(here, order, down)
        if there is not None:
            self._enter(there)
            there.setFocus(Qt.FocusReason.OtherFocusReason)
            self.ensureWidgetVisible(there, 0, GAP)

    # --- places -------------------------------------------------------------------------------
    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place everything anew."""
        super().resizeEvent(event)
        self._arrange()

    def changeEvent(self, event: QEvent) -> None:
        """Place everything anew where the size of the text changed."""
        super().changeEvent(event)
        if event.type() is QEvent.Type.StyleChange:
            self._arrange()

    def _heading(self, skill: PractisedSkill) -> PlainLabel:
        made = PlainLabel(skill_title(skill), self._field)
        made.setProperty("role", "heading")
        made.show()
        return made

    def _packed(
        self, columns: int, shelf: bool, every: bool = False
    ) -> list[list[tuple[_SkillGroup, int, int]]]:
        """Return rows of parts of groups: group, its first place, its first column.

        Args:
            columns: of lessons.
            shelf: whether research machines stand beside them.
            every: count places that a search hides as well.
        """
        rows: list[list[tuple[_SkillGroup, int, int]]] = []
        free: list[int] = []
        for group in self._groups:
            if group.skill is PractisedSkill.MACHINE and shelf:
                continue
            count = len(group.places if every else group.shown)
            for first in range(0, count, columns):
                part = min(columns, count - first)
                split = count > columns or group.skill is PractisedSkill.MACHINE
                row = next((n for n, room in enumerate(free) if room >= part and not split), None)
                if row is None:
                    rows.append([])
                    free.append(columns)
                    row = len(rows) - 1
                rows[row].append((group, first, columns - free[row]))
                free[row] = 0 if split else free[row] - part
        return rows

    def _grid(self, room: int) -> _SkillGrid:
        """Return the division of a width [px] that has the largest faces, with fewest columns.

        All places count: what a search leaves keeps its size.
        """
        height = self.height()
        heading, fixed = self._head(), SkillPlace.above() + SkillPlace.below()
        machines = any(g.places for g in self._groups if g.skill is PractisedSkill.MACHINE)
        best: tuple[int, _SkillGrid] | None = None
        for columns in range(2, MOST_COLUMNS + 1):
            for beside in (True, False):
                shelf = beside and machines
                width = (room - (3 * GAP if shelf else 0)) // (columns + shelf)
                if width < theme.px(NARROWEST):
                    continue
                rows = max(1, len(self._packed(columns, shelf, every=True)))
                tall = height // rows - heading - fixed
                face = min(width - 4 * SkillPlace.above(), tall, FACES[1])
                if best is None or face > best[0]:
                    best = face, _SkillGrid(columns, width, max(theme.px(FACES[0]), face), shelf)
        return best[1] if best else _SkillGrid(2, room // 2, theme.px(FACES[0]), False)

    def _head(self) -> int:
        return self._field.fontMetrics().height() + theme.SPACING

    def _arrange(self) -> None:
        """Give every place and heading its rectangle; a bar to scroll takes its own width."""
        if self._placed(self.width()) > self.height():
            self._placed(self.width() - self.verticalScrollBar().sizeHint().width())

    def _placed(self, room: int) -> int:
        """Place everything in a width [px]; return the height that it takes."""
        grid, head = self._grid(room), self._head()
        tall = SkillPlace.above() + grid.face + SkillPlace.below()
        lines: list[tuple[SkillPlace, SkillPlace]] = []
        top = 0
        for group in self._groups:
            group.heading.setVisible(bool(group.shown))
        shelf: QRect | None = None
        for row in self._packed(grid.columns, grid.beside):
            for group, first, column in row:
                some = group.shown[first : first + grid.columns - column]
                left = column * grid.width
                if first == 0:
                    span = len(some) * grid.width - GAP
                    _write(group, QRect(left + GAP, top, span - GAP, head))
                for n, place in enumerate(some):
                    place.setGeometry(left + n * grid.width, top + head, grid.width, tall)
                    place.set_disc(grid.face)
                if group.skill is PractisedSkill.MACHINE:
                    row_box = QRect(0, top, len(some) * grid.width, head + tall)
                    shelf = row_box if shelf is None else shelf.united(row_box)
                else:
                    lines += pairwise(some)
            top += head + tall
        if grid.beside and any(g.shown for g in self._groups if g.skill is PractisedSkill.MACHINE):
            shelf = self._shelve(grid, room, head, tall)
            top = max(top, shelf.bottom() + 1)
        self._field.draw(lines, shelf)
        self._field.setFixedSize(room, max(top, 1))
        return top

    def _shelve(self, grid: _SkillGrid, room: int, head: int, tall: int) -> QRect:
        """Stand the research machines one below the other, at the right of the lessons."""
        group = next(one for one in self._groups if one.skill is PractisedSkill.MACHINE)
        left = room - grid.width
        _write(group, QRect(left + GAP, 0, grid.width - 2 * GAP, head))
        for n, place in enumerate(group.shown):
            place.setGeometry(left, head + n * tall, grid.width, tall)
            place.set_disc(grid.face)
        return QRect(left, 0, grid.width, head + len(group.shown) * tall)


def _nearest(here: SkillPlace, others: Sequence[SkillPlace], down: int) -> SkillPlace | None:
    """Return the nearest place below (1) or above (-1) one; None where there is none."""
    at = here.geometry().center()
    offs = [(one.geometry().center() - at, one) for one in others]
    costs = [
        (abs(off.y()) + 2 * abs(off.x()), one)
        for off, one in offs
        if down * off.y() >= here.height() // 2
    ]
    return min(costs, key=lambda pair: pair[0])[1] if costs else None


def _write(group: _SkillGroup, box: QRect) -> None:
    """Write a skill's name into a box; a tip has all of it where that is too narrow."""
    title, heading = skill_title(group.skill), group.heading
    side = Qt.TextElideMode.ElideRight
    metrics = heading.fontMetrics()
    machines = group.skill is PractisedSkill.MACHINE
    fits = metrics.horizontalAdvance(title) <= box.width()
    words = tr("Research") if machines and not fits else title  # a shelf is one place wide
    heading.setText(metrics.elidedText(words, side, box.width()))
    heading.setToolTip("" if heading.text() == title else literal(title))
    heading.setGeometry(box)


class _Field(QWidget):
    """What the places stand on: lines between them, and the shelf."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._lines: list[tuple[SkillPlace, SkillPlace]] = []
        self._shelf: QRect | None = None

    def draw(self, lines: list[tuple[SkillPlace, SkillPlace]], shelf: QRect | None) -> None:
        """Draw lines from place to place, and a shelf."""
        self._lines, self._shelf = lines, shelf
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw them."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        edge = QColor(theme.now(theme.BORDER))
        if self._shelf is not None:
            painter.setPen(QPen(edge, 1.0))
            painter.setBrush(QColor(theme.now(theme.SURFACE)))
            painter.drawRoundedRect(QRectF(self._shelf).adjusted(0.5, 0.5, -0.5, -0.5), 8, 8)
        painter.setPen(QPen(edge, 3.0))
        for one, other in self._lines:
            a = one.mapToParent(QPoint(round(one.ring.right()), round(one.ring.center().y())))
            b = other.mapToParent(QPoint(round(other.ring.left()), round(other.ring.center().y())))
            painter.drawLine(a + QPoint(8, 0), b - QPoint(8, 0))
