"""A place in the map of skills: an exercise as a round face with a ring of how far one has come.

Ring, badge and words say the same, so that none of them depends on a colour: an open dashed ring
was never tried, an arc is the best points of 100, a closed ring with ✔ is mastered.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetrics, QKeyEvent, QPainter, QPaintEvent, QPen, QPixmap
from PySide6.QtWidgets import QAbstractButton, QWidget

from app.exercises.portrait import Portrait
from app.exercises.schema import Exercise
from app.views.exercise.briefing import level_words
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import declared, literal, tr
from app.views.shell.skill_portrait import face

if TYPE_CHECKING:
    from app.session.board import Standing

RING: Final = 5
"""Width of a ring [px]."""

PAD: Final = 6
EDGE: Final = 3
FULL: Final = 100.0
"""Points of a full ring."""


@dataclass(frozen=True, slots=True)
class Advance:
    """How far somebody has come, as it is drawn and told.

    Attributes:
        attempts: that count.
        best: points; None without.
        passes: of the newest attempts in a row, two at most.
        masters: persons who master it.
        of_one: whether it is one person's, not everybody's at this station.
    """

    attempts: int = 0
    best: float | None = None
    passes: int = 0
    masters: int = 0
    of_one: bool = True

    @classmethod
    def of(cls, standing: Standing | None, of_one: bool) -> Advance:
        """Return it from a standing; nothing was done where there is none."""
        if standing is None:
            return cls(of_one=of_one)
        return cls(standing.attempts, standing.best, standing.in_a_row, standing.masters, of_one)

    @property
    def is_mastered(self) -> bool:
        """Return whether one person masters it."""
        return self.of_one and self.masters > 0

    @property
    def share(self) -> float:
        """Return how much of the ring is drawn; only what is mastered closes it."""
        if self.is_mastered:
            return 1.0
        return min(0.96, max(0.0, (self.best or 0.0) / FULL))

    @property
    def badge(self) -> str:
        """Return what stands on the ring; empty for nothing."""
        if self.is_mastered:
            return "✔"
        if not self.of_one:
            return f"✔ {self.masters}" if self.masters else ""
        return "1/2" if self.passes else ""

    def short(self) -> str:
        """Say it in a few words; empty where nothing was done."""
        if not self.attempts:
            return ""
        if not self.of_one:
            return tr("mastered by {n}", n=self.masters) if self.masters else self._best()
        if self.is_mastered:
            return tr("mastered")
        return self._best()

    def whole(self) -> str:
        """Say all of it."""
        if not self.attempts:
            return tr("not begun")
        parts = [tr("done {n}", n=self.attempts)]
        if self.best is not None:
            parts.append(tr("best {points} of 100", points=f"{self.best:.0f}"))
        if not self.of_one:
            parts.append(tr("mastered by {n}", n=self.masters))
        elif self.is_mastered:
            parts.append(tr("mastered: passed twice in a row"))
        elif self.passes:
            parts.append(tr("passed once: one more pass in a row masters it"))
        return ", ".join(parts)

    def _best(self) -> str:
        return "" if self.best is None else tr("best {points}", points=f"{self.best:.0f}")


class SkillPlace(QAbstractButton):
    """An exercise in the map; a click, Enter or the space bar begins it.

    Signals:
        moved(int, int): an arrow key asks for the place to the right or left, below or above.
    """

    moved = Signal(int, int)

    def __init__(self, exercise: Exercise, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.exercise = exercise
        self.progress, self.is_next, self.number = Advance(), False, 0
        self.portrait: Portrait | None = None
        self._face: tuple[tuple[object, ...], QPixmap] | None = None
        self._disc, self._line = 0, ""
        self.title, self.words = PlainLabel(self), PlainLabel(self)
        centre = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop
        for label in (self.title, self.words):
            label.setAlignment(centre)
            label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.title.setWordWrap(True)
        self.title.setProperty("role", "heading")
        self.words.setProperty("role", "dim")
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)
        self.tell()

    @property
    def disc(self) -> QRectF:
        """Return where the face stands, within the ring."""
        left = 0.5 * (self.width() - self._disc)
        return QRectF(left, theme.px(PAD + RING + 3), self._disc, self._disc)

    @property
    def ring(self) -> QRectF:
        """Return the middle line of the ring."""
        off = 0.5 * theme.px(RING) + 3.0
        return self.disc.adjusted(-off, -off, off, off)

    def show_portrait(self, portrait: Portrait | None) -> None:
        """Show the patient; the face is made when it is painted."""
        self.portrait, self._face = portrait, None
        self.update()

    def tell(self, progress: Advance | None = None, is_next: bool = False, number: int = 0) -> None:
        """Show and say how far somebody has come.

        Args:
            progress: how far; nothing was done where there is none.
            is_next: whether the big button begins this one.
            number: its place in the course that is followed; 0 outside.
        """
        self.progress, self.is_next, self.number = progress or Advance(), is_next, number
        exercise, done = self.exercise, self.progress
        first = (
            tr("No. {n} of the course", n=number) if number else tr("Level {n}", n=exercise.level)
        )
        self._line = "  ·  ".join(filter(None, (first, done.short())))
        parts = [declared(exercise.title), level_words(exercise.level), done.whole()]
        if is_next:
            parts.insert(1, tr("next"))
        self.setAccessibleName(", ".join(parts))
        self.setAccessibleDescription(declared(exercise.description))
        tip = (declared(exercise.title), ", ".join(parts[1:]), declared(exercise.description))
        self.setToolTip(literal("\n\n".join(tip)))
        self._fit()
        self.update()

    # --- sizes --------------------------------------------------------------------------------
    @staticmethod
    def below() -> int:
        """Return the height that title and words take below the ring [px]."""
        bold, small = _heights()
        return theme.px(RING + 3 + 4) + 2 * bold + small + theme.px(PAD)

    @staticmethod
    def above() -> int:
        """Return the height above the face [px]."""
        return theme.px(PAD + RING + 3)

    def set_disc(self, side: int) -> None:
        """Give the face a size [px]."""
        self._disc = side
        self._fit()
        self.update()

    def sizeHint(self) -> QSize:
        """Return what it takes with the present face."""
        return QSize(self._disc + 2 * self.above(), self.above() + self._disc + self.below())

    def _fit(self) -> None:
        """Place title and words; a title of more than two lines ends with dots."""
        bold, small = _heights()
        width = self.width() - 2 * EDGE
        if width <= 0 or not self._disc:
            return
        metrics = QFontMetrics(theme.font_of(theme.FONT_PX, True))
        title = fitting(declared(self.exercise.title), metrics, width, 2)
        self.title.setText(title)
        self.title.setToolTip(literal(declared(self.exercise.title)) if "…" in title else "")
        top = round(self.disc.bottom()) + theme.px(RING + 3 + 4)
        flags = int(Qt.TextFlag.TextWordWrap)
        box = metrics.boundingRect(0, 0, width, 1000, flags, title)
        lines = 2 if box.height() > bold + 4 else 1
        self.title.setGeometry(EDGE, top, width, lines * bold)
        side = Qt.TextElideMode.ElideRight
        metrics = QFontMetrics(theme.font_of(theme.SMALL_PX))
        self.words.setText(metrics.elidedText(self._line, side, width))
        self.words.setToolTip(literal(self._line) if self.words.text() != self._line else "")
        self.words.setGeometry(EDGE, top + lines * bold, width, small)

    # --- events -------------------------------------------------------------------------------
    def resizeEvent(self, event: QEvent) -> None:
        """Place the words anew."""
        self._fit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Begin by Enter; arrows lead to other places."""
        ways = {
            Qt.Key.Key_Left: (-1, 0),
            Qt.Key.Key_Right: (1, 0),
            Qt.Key.Key_Up: (0, -1),
            Qt.Key.Key_Down: (0, 1),
        }
        way = ways.get(Qt.Key(event.key()))
        if way is not None:
            self.moved.emit(*way)
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and not event.isAutoRepeat():
            self.click()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw ground, face, ring, and what stands on them."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self.hasFocus() or self.underMouse():
            painter.setBrush(QColor(theme.now(theme.RAISED)))
            edge = QPen(QColor(theme.now(theme.ACCENT)), 2.0)
            painter.setPen(edge if self.hasFocus() else Qt.PenStyle.NoPen)
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 8, 8)
        self._paint_face(painter)
        self._paint_ring(painter)
        if self.is_next:
            self._pill(painter, tr("next"), theme.ACCENT, QPointF(0.5, 0.0))
        if badge := self.progress.badge:
            colour = theme.GOOD if self.progress.is_mastered else theme.TEXT
            self._pill(painter, badge, colour, QPointF(0.86, 0.86))

    def _paint_face(self, painter: QPainter) -> None:
        disc, ratio = self.disc, self.devicePixelRatioF()
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.IMAGE_BACKGROUND))
        painter.drawEllipse(disc)
        if self.portrait is None:
            return
        key = (self._disc, ratio)
        if self._face is None or self._face[0] != key:
            self._face = key, face(self.exercise, self.portrait, self._disc, ratio)
        painter.drawPixmap(disc.topLeft(), self._face[1])

    def _paint_ring(self, painter: QPainter) -> None:
        ring, width, done = self.ring, float(theme.px(RING)), self.progress
        painter.setBrush(Qt.BrushStyle.NoBrush)
        track = QPen(QColor(theme.now(theme.BORDER)), width)
        if not done.attempts:
            track = QPen(QColor(theme.now(theme.TEXT_DIM)), 1.5)
            track.setDashPattern([3.0, 4.0])
        painter.setPen(track)
        painter.drawEllipse(ring)
        if done.share > 0.0:
            colour = theme.GOOD if done.is_mastered else theme.ACCENT
            arc = QPen(QColor(theme.now(colour)), width)
            arc.setCapStyle(Qt.PenCapStyle.FlatCap)
            painter.setPen(arc)
            painter.drawArc(ring, 90 * 16, -round(done.share * 360 * 16))

    def _pill(self, painter: QPainter, words: str, colour: str, at: QPointF) -> None:
        """Draw words on a ground of a colour, on the ring at a place of its square."""
        font = theme.font_of(theme.SMALL_PX, True)
        painter.setFont(font)
        metrics, ring = QFontMetrics(font), self.ring
        high = metrics.height() + 2.0
        wide = max(high, metrics.horizontalAdvance(words) + 0.9 * high)
        box = QRectF(0.0, 0.0, wide, high)
        box.moveCenter(
            QPointF(ring.left() + at.x() * ring.width(), ring.top() + at.y() * ring.height())
        )
        box.moveTop(max(1.0, box.top()))
        painter.setPen(QPen(QColor(theme.now(theme.BACKGROUND)), 2.0))
        painter.setBrush(QColor(theme.now(colour)))
        painter.drawRoundedRect(box, 0.5 * high, 0.5 * high)
        painter.setPen(QColor(theme.present().on_accent))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, words)


def _heights() -> tuple[int, int]:
    """Return the heights of a line of a title and of one of words [px]."""
    bold = QFontMetrics(theme.font_of(theme.FONT_PX, True))
    small = QFontMetrics(theme.font_of(theme.SMALL_PX))
    return bold.lineSpacing() + 1, small.lineSpacing() + 2


def fitting(text: str, metrics: QFontMetrics, width: int, lines: int) -> str:
    """Return as many words as stand on so many lines, with dots where some are left out.

    A word that is wider than a line ends with dots itself.
    """
    taken, flags = "", int(Qt.TextFlag.TextWordWrap)
    words = [metrics.elidedText(w, Qt.TextElideMode.ElideRight, width) for w in text.split()]
    room = lines * (metrics.lineSpacing() + 1)  # Qt rounds each line up
    for number, word in enumerate(words):
        longer = f"{taken} {word}".strip()
        tried = longer if number == len(words) - 1 else f"{longer} …"
        if metrics.boundingRect(0, 0, width, 10_000, flags, tried).height() > room:
            return f"{taken} …"
        taken = longer
    return taken
