"""A tour of three minutes: points at the real parts of the window and says what each is for.

It is offered on the start page until somebody takes it or declines, and stands in the menu Help.
Where no patient is open it opens that of the first exercise, beside what it tells; it starts no
attempt.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from PySide6.QtCore import QEvent, QObject, QRect, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPainterPath, QPaintEvent, QPen
from PySide6.QtWidgets import QFrame, QHBoxLayout, QStackedWidget, QVBoxLayout, QWidget

from app.views.kit import theme
from app.views.kit.menu_entries import add_entries
from app.views.kit.parts import button, label
from app.views.kit.text import tr
from app.views.reading.workspace import WorkspacePage
from app.views.shell.feature import Context
from app.views.shell.message_bar import ATTEMPT_RUNS
from app.views.shell.start_page import StartPage

SEEN: Final = "tour/seen"
WIDTH: Final = 400
VEIL: Final = 170
"""How dark everything else is while one part is pointed at, of 255."""


@dataclass(frozen=True, slots=True)
class TourStop:
    """One part of the window.

    Attributes:
        title: its name.
        words: what it is for.
        page: that it stands on.
        part: finds it there.
    """

    title: str
    words: str
    page: QWidget
    part: Callable[[], QWidget]


class TourVeil(QWidget):
    """Darkens all but one part, and tells of it in a bubble beside it.

    Signals:
        moved(int): one stop on, or back.
        left(): the tour is over, or was left.
    """

    moved = Signal(int)
    left = Signal()

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._shown = QRect()
        self.bubble = QFrame(self)
        self.bubble.setProperty("role", "panel")
        self.title, self.words, self.count = label("", "heading"), label(), label("", "dim")
        self.count.setWordWrap(False)
        self.on, self.back = button(tr("Next (Enter)"), "primary"), button(tr("Back"))
        self.leave = button(tr("Leave (Esc)"))
        row = QHBoxLayout()
        row.addWidget(self.count)
        row.addStretch(1)
        for widget in (self.leave, self.back, self.on):
            row.addWidget(widget)
        self._column = column = QVBoxLayout(self.bubble)
        column.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
        for words in (self.title, self.words):
            column.addWidget(words)
        column.addLayout(row)
        self.on.clicked.connect(lambda: self.moved.emit(1))
        self.back.clicked.connect(lambda: self.moved.emit(-1))
        self.leave.clicked.connect(self.left)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.hide()

    def point_at(self, stop: TourStop, number: int, most: int) -> None:
        """Show a stop."""
        self.title.setText(stop.title)
        self.words.setText(stop.words)
        self.count.setText(f"{number + 1} / {most}")
        self.back.setEnabled(number > 0)
        self.on.setText(tr("Done (Enter)") if number == most - 1 else tr("Next (Enter)"))
        around = self.parentWidget()
        if around is None:
            return
        self.setGeometry(around.rect())
        part = stop.part()
        if part.isVisible():
            corner = part.mapTo(around, part.rect().topLeft())
            self._shown = QRect(corner, part.size()).intersected(self.rect())
        else:
            self._shown = QRect()
        self._place_bubble()
        self.setAccessibleName(f"{stop.title}: {stop.words}")
        self.show()
        self.raise_()
        self.setFocus()
        self.update()

    def _place_bubble(self) -> None:
        """Stand beside the part where there is room, else in its lower middle."""
        gap = theme.MARGIN
        width = max(theme.px(WIDTH), self.bubble.minimumSizeHint().width())  # whole buttons
        height = self._column.heightForWidth(width)
        size = QSize(width, max(height, self.bubble.sizeHint().height()))
        part, room = self._shown, self.rect().adjusted(gap, gap, -gap, -gap)
        places = [
            (part.right() + gap, part.center().y() - size.height() // 2),
            (part.left() - gap - size.width(), part.center().y() - size.height() // 2),
            (part.center().x() - size.width() // 2, part.bottom() + gap),
            (part.center().x() - size.width() // 2, part.top() - gap - size.height()),
        ]
        for x, y in places:
            kept = QRect(x, min(max(y, room.top()), room.bottom() - size.height()), *size.toTuple())
            kept.moveLeft(x)
            if room.contains(kept) and not kept.intersects(part):
                self.bubble.setGeometry(kept)
                return
        inside = QRect(0, 0, *size.toTuple())
        inside.moveCenter(self.rect().center() if part.isEmpty() else part.center())
        inside.moveBottom(min(room.bottom(), (part if not part.isEmpty() else room).bottom() - gap))
        self.bubble.setGeometry(inside)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Darken what is not meant."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        veil, hole = QPainterPath(), QPainterPath()
        veil.addRect(self.rect())
        hole.addRoundedRect(self._shown, 6, 6)
        painter.fillPath(veil - hole, QColor(0, 0, 0, VEIL))
        painter.setPen(QPen(QColor(theme.now(theme.ACCENT)), 3.0))
        painter.drawPath(hole)

    def event(self, event: QEvent) -> bool:
        """Keep every key from the window behind."""
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go on, back, or leave."""
        key = event.key()
        if event.isAutoRepeat():
            return
        if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Right, Qt.Key.Key_Space):
            self.moved.emit(1)
        elif key in (Qt.Key.Key_Left, Qt.Key.Key_Backspace) and self.back.isEnabled():
            self.moved.emit(-1)
        elif key == Qt.Key.Key_Escape:
            self.left.emit()


class Tour(QObject):
    """The tour, in the menu Help and on the start page.

    Args:
        context: of every feature.
        start, workspace, debrief: the pages that it leads to.
        take: takes the first exercise and opens its patient.

    Attributes:
        veil: what is shown over the window.
        number: of the stop that is pointed at; None while there is no tour.
    """

    def __init__(
        self,
        context: Context,
        start: StartPage,
        workspace: WorkspacePage,
        debrief: QWidget,
        take: Callable[[], None],
    ) -> None:
        super().__init__(context.shell.dialog_parent)
        self.context = context
        self._start, self._workspace, self._debrief = start, workspace, debrief
        self._take, self._opens, self._stays = take, False, False
        self._window, self._settings = context.shell.dialog_parent, context.shell.settings
        self.veil = TourVeil(self._window)
        self.number: int | None = None
        self._stops: tuple[TourStop, ...] = ()
        self._page: QWidget | None = None
        self._had_pad = False
        self.veil.moved.connect(self.move)
        self.veil.left.connect(self.end)
        add_entries(context.shell.menu(tr("&Help")), [(tr("Three-minute tour"), "", self.begin)])
        context.shell.page_changed.connect(self._follow)
        context.patients.reading.connect(self._opened)
        self._window.installEventFilter(self)

    @property
    def is_wanted(self) -> bool:
        """Return whether nobody has taken or declined it here."""
        return str(self._settings.value(SEEN, "")) != "true"

    def decline(self) -> None:
        """Offer it no more; it stays in the menu."""
        self._settings.setValue(SEEN, "true")

    def begin(self) -> None:
        """Begin at the first stop; refused while an attempt runs."""
        if self.context.conductor.controller.is_running:
            self.context.shell.messages.show_until(
                ATTEMPT_RUNS, tr("An attempt is running: end it first.")
            )
            return
        self.decline()
        self._page, self._had_pad = self._current(), self._workspace.has_bullseye
        self._stops = self._all()
        self._go(0)
        if self.context.conductor.patient is None and not self.context.patients.is_reading:
            self._opens = True
            self._take()

    def move(self, by: int) -> None:
        """Go some stops on; after the last one the tour is over."""
        if self.number is not None:
            self._go(self.number + by)

    def end(self) -> None:
        """Leave the tour: everything is as it was before."""
        if self.number is None:
            return
        self.number = None
        self.veil.hide()
        if self._opens:  # whom nobody asked for need not come any more
            self._opens = False
            if self.context.patients.is_reading:
                self.context.patients.close()
                self.context.patients.given_up.emit()
        self._workspace.show_bullseye(self._had_pad)
        if self._page is not None:
            self.context.shell.show_page(self._page)
            self._page.setFocus()

    def close(self) -> None:
        """End it with the window."""
        self._window.removeEventFilter(self)
        self.number = None

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the size of the window."""
        if event.type() == QEvent.Type.Resize and self.number is not None:
            self._point()
        return False

    def _go(self, number: int) -> None:
        if not 0 <= number < len(self._stops):
            self.end()
            return
        self.number = number
        stop, workspace = self._stops[number], self._workspace
        self.context.shell.show_page(stop.page)
        if stop.page is workspace and not workspace.has_bullseye:
            workspace.show_bullseye(True)
        self._point()

    def _point(self) -> None:
        if self.number is None:
            return
        stop = self._stops[self.number]
        for inner in (stop.page.layout(), self._window.layout()):
            if inner is not None:
                inner.activate()
        self.veil.point_at(stop, self.number, len(self._stops))

    def _follow(self, _: int) -> None:
        """Leave where the window went elsewhere: another patient came, or a result."""
        if self.number is None or self._stays:
            return
        if self._stops[self.number].page is not self._current():
            self._page = None
            self.end()

    def _opened(self, reading: bool) -> None:
        """Stay at the stop that is shown when the patient comes whom the tour has opened."""
        if self._opens and not reading:
            self._stays = True
            QTimer.singleShot(0, self._stay)

    def _stay(self) -> None:
        self._stays = self._opens = False
        if self.number is not None:
            self._go(self.number)

    def _current(self) -> QWidget | None:
        pages = self._start.parentWidget()
        return pages.currentWidget() if isinstance(pages, QStackedWidget) else None

    def _all(self) -> tuple[TourStop, ...]:
        """Every stop, in the order of an attempt."""
        work, start, debrief = self._workspace, self._start, self._debrief
        return (
            TourStop(
                tr("The patient"),
                tr(
                    "Every exercise has its patient: a CT and, mostly, a planned path from the "
                    "entry on the skin to the target. Enter begins: first a briefing, then the "
                    "attempt. In each skill difficulty rises from left to right; a ring "
                    "shows how far you have come."
                ),
                start,
                lambda: start.map,
            ),
            TourStop(
                tr("The slices"),
                tr(
                    "The CT in axial, sagittal and coronal slices, with the plan and, where the "
                    "exercise shows it, the live needle. The wheel leafs through them, a click "
                    "moves the cross, the right button changes the window. The 3D view is below."
                ),
                work,
                lambda: work.grid,
            ),
            TourStop(
                tr("The bull's-eye"),
                tr(
                    "The main instrument: how the needle points against the path, and how deep it "
                    "is. Bring the mark into the middle, then push to the target. During an "
                    "attempt one line above always says the next step."
                ),
                work,
                lambda: work.bullseye,
            ),
            TourStop(
                tr("The hand"),
                tr(
                    "Without a robot the mouse is the hand: drag in the bull's-eye to tilt, turn "
                    "the wheel to push or pull. A tablet or a gamepad can take its place. With a "
                    "robot you hold the needle itself."
                ),
                work,
                lambda: work.bullseye.source,
            ),
            TourStop(
                tr("The robot"),
                tr(
                    "Whether robot, cameras and recording are well. As long as nothing here is "
                    "yellow or red you need not look; a click says more. Holding Esc takes all "
                    "force off at once, whenever you like."
                ),
                work,
                lambda: work.status,
            ),
            TourStop(
                tr("The debrief"),
                tr(
                    "When you end the attempt (Enter) it is scored at once: where the needle "
                    "ended, what cost points and what to do otherwise, everything to be replayed, "
                    "and which exercise comes next. All attempts stay in Past sessions (F7)."
                ),
                debrief,
                lambda: debrief,
            ),
        )
