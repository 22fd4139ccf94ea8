"""The briefing: what an exercise is about, what counts, helps and is locked, on one page."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QImage, QKeyEvent, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app.exercises.guidance import FadingKind, GuidanceMode, Purpose
from app.exercises.locks import HandName, Lock
from app.exercises.portrait import Portrait
from app.exercises.schema import Exercise
from app.exercises.taught import taught_words
from app.imaging.field.tissue_words import tissue_words
from app.scoring.metrics import available
from app.scoring.tolerance import Tolerance
from app.scoring.unit_words import unit_words
from app.views.exercise.offer import BriefingOffer
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.page_keys import PageKeys
from app.views.kit.parts import BulletLabel, FittingButton, PlainLabel, button, label
from app.views.kit.roles import Role
from app.views.kit.text import declared, listing, literal, number, tr, tr_n, translated
from app.views.reading.lock_words import view_title, views_for
from app.views.shell.shortcuts import disclaimer_label

HARDEST = 9


# --- words ------------------------------------------------------------------------------------
def level_words(level: int) -> str:
    """Say a level in words, for those who do not see the discs."""
    return tr("level {n} of {most}", n=level, most=HARDEST)


def kind_words(exercise: Exercise) -> str:
    """Say in a line what kind of exercise it is."""
    kind = tr("Assessment") if exercise.purpose is Purpose.ASSESSMENT else tr("Practice")
    return "  ·  ".join((kind, level_words(exercise.level)))


def scored_words(exercise: Exercise) -> list[str]:
    """Say what is scored with its limits, what weighs most first; then what passes."""
    known = available()
    counting = [
        (name, limits)
        for name, limits in exercise.tolerances.items()
        if (limits.weight > 0.0 or limits.required) and name in known
    ]
    counting.sort(key=lambda one: -one[1].weight)
    said = [
        _limit_words(declared(known[name].title), known[name].unit, limits)
        for name, limits in counting
    ]
    said += _hands_words(exercise)
    for part in exercise.structures:
        for name, limit in part.risks.items():
            said.append(tr("{name}: stay {mm:g} mm away", name=tissue_words(name), mm=limit))
    said.append(tr("{mark:g} of 100 points pass.", mark=exercise.rules.pass_mark))
    return said


def _hands_words(exercise: Exercise) -> list[str]:
    """Say the limits of hands that have their own."""
    known = available()
    hands = {
        HandName.MOUSE: tr("With the mouse"),
        HandName.TABLET: tr("With the tablet"),
        HandName.GAMEPAD: tr("With the gamepad"),
    }
    said = []
    for hand, own in exercise.bands.items():
        for name, limits in exercise.tolerances_for(hand.value).items():
            if name in own.metrics and name in known:
                words = _limit_words(declared(known[name].title), known[name].unit, limits)
                said.append(tr("{hand}: {limits}", hand=hands[hand], limits=words))
    return said


def _limit_words(title: str, unit: str, limits: Tolerance) -> str:
    values = {
        "title": title,
        "best": _value(limits.expert, unit),
        "passes": _value(limits.pass_, unit),
    }
    words = (
        tr("{title}: best from {best}, passes from {passes}", **values)
        if limits.higher_is_better
        else tr("{title}: best up to {best}, passes up to {passes}", **values)
    )
    return words + (tr("; must be kept") if limits.required else "")


def _value(value: float, unit: str) -> str:
    if unit == "s" and value >= 100.0:
        minutes, seconds = divmod(round(value), 60)
        return tr("{m}:{s:02d} min", m=minutes, s=seconds)
    gap = "" if unit in ("°", "") else " "
    return number(value, "g") + gap + translated(unit_words(unit))


def locked_words(exercise: Exercise) -> list[str]:
    """Say what the student cannot change."""
    names = {
        Lock.ASSISTANCE: tr("the robot's help"),
        Lock.VIEWS: tr("what is shown"),
        Lock.READING: tr("window, slab and layout"),
        Lock.HAND: tr("what moves the hand"),
        Lock.MODELS: tr("the way effects are computed"),
    }
    locked = [words for lock, words in names.items() if lock in exercise.locked]
    if not locked:
        return [tr("Nothing: you may change help, views and layout.")]
    words = listing(locked)
    return [tr("Stays as it is: {what}.", what=words)]


def aid_words(exercise: Exercise, role: Role) -> list[str]:
    """Say what helps: the robot, and what somebody in this role sees of the needle."""
    share = exercise.assistance
    if exercise.fading is not None:
        robot = (
            tr("The robot helps less from attempt to attempt.")
            if exercise.fading.kind is FadingKind.SCHEDULE
            else tr("The robot helps less the better you do.")
        )
        if exercise.fading.probe_every:
            robot += " " + tr(
                "Every {n}th attempt is without any help.", n=exercise.fading.probe_every
            )
    elif share > 0.0:
        robot = tr("The robot guides with {share:.0f} %.", share=100.0 * share)
    elif share < 0.0:
        robot = tr("The robot pushes off the path with {share:.0f} %.", share=-100.0 * share)
    else:
        robot = tr("The robot does not help.")
    said = [robot]
    if exercise.touch is not None:
        said.append(tr("The hand moves the tool's handle: the tip goes the other way."))
    if exercise.guidance_mode is GuidanceMode.CONTROL_CT:
        said.append(
            tr(
                "The needle is seen on control scans alone (S): {n} slices of {mm:g} mm.",
                n=exercise.guidance.slices,
                mm=exercise.guidance.slice_mm,
            )
        )
    shown = [view_title(view) for view in views_for(role) if view in exercise.shown_views]
    if shown:
        said.append(tr("Shown: {views}.", views=listing(shown)))
    return said


@dataclass(frozen=True, slots=True)
class AttemptsLeft:
    """How many attempts somebody has.

    Attributes:
        allowed: by the course; None for any number.
        used: of them; None where nobody is signed in.
        course: title of the course that says so; empty without one.
        refusal: why none may be begun now; empty if nothing speaks against it.
    """

    allowed: int | None = None
    used: int | None = None
    course: str = ""
    refusal: str = ""

    def words(self) -> str:
        """Say it."""
        if self.allowed is None:
            said = "" if self.refusal else tr("Any number of attempts.")
        elif self.used is None:
            said = tr_n("{n} attempt is allowed.", "{n} attempts are allowed.", self.allowed)
        else:
            left = max(0, self.allowed - self.used)
            if self.allowed == 1:
                said = tr("The one attempt is left.") if left else tr("The one attempt is used.")
            else:
                said = tr("{left} of {n} attempts are left.", left=left, n=self.allowed)
        if self.course:
            said += " " + tr("Course: {title}.", title=self.course)
        if self.refusal:
            said += "\n" + tr("Not now: {why}.", why=self.refusal)
        return said.strip()


# --- pictures ---------------------------------------------------------------------------------
def portrait_image(portrait: Portrait, name: str) -> QImage:
    """Return a slice of a portrait as a picture of its own memory."""
    grey = portrait.slices[name]
    height, width = grey.shape
    made = QImage(grey.tobytes(), width, height, width, QImage.Format.Format_Grayscale8)
    return made.copy()


def paint_portrait(painter: QPainter, box: QRectF, portrait: Portrait, name: str) -> QRectF:
    """Draw a slice with the plan on it into a box, as large as it fits; return where it stands."""
    image = portrait_image(portrait, name)
    scale = min(box.width() / image.width(), box.height() / image.height())
    size = QSize(round(scale * image.width()), round(scale * image.height()))
    at = QRectF(0.0, 0.0, size.width(), size.height())
    at.moveCenter(box.center())
    painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.drawImage(at, image)

    def place(point: tuple[float, ...]) -> QPointF:
        x, y = portrait.place(name, point)
        return QPointF(at.left() + x * at.width(), at.top() + y * at.height())

    target, radius = place(portrait.target_mm), max(2.5, 0.014 * at.width())
    if portrait.entry_mm is not None:
        entry = place(portrait.entry_mm)
        painter.setPen(theme.PATH.pen(max(1.2, 0.35 * radius)))
        painter.drawLine(entry, target)
        painter.setPen(theme.ENTRY.pen(max(1.2, 0.35 * radius)))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(entry, radius, radius)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.TARGET.qcolor())
    painter.drawEllipse(target, radius, radius)
    return at


class PortraitView(QWidget):
    """One slice of a patient, with the plan, named below."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.name = name
        self._portrait: Portrait | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(120, 110)

    @property
    def title(self) -> str:
        """Name of the slice for people."""
        return {
            "axial": tr("Axial"),
            "coronal": tr("Coronal"),
            "sagittal": tr("Sagittal"),
        }[self.name]

    def show_portrait(self, portrait: Portrait | None) -> None:
        """Show another patient; None says that the picture is being made."""
        self._portrait = portrait
        known = tr("being made") if portrait is None else tr("with the plan")
        self.setAccessibleName(f"{self.title}: {known}")
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw."""
        painter, box = QPainter(self), QRectF(self.rect())
        painter.fillRect(box, QColor(theme.IMAGE_BACKGROUND))
        if self._portrait is not None:
            paint_portrait(painter, box.adjusted(4, 4, -4, -4), self._portrait, self.name)
        font = QFont(painter.font())
        font.setPixelSize(theme.px(theme.SMALL_PX))
        painter.setFont(font)
        painter.setPen(QColor(theme.IMAGE_DIM))
        words = self.title if self._portrait is not None else tr("The picture is being made …")
        corner = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop
        room = box.adjusted(8, 5, -8, -5)
        ground = QColor(theme.IMAGE_BACKGROUND)
        ground.setAlphaF(0.75)  # bone may lie under the words
        painter.fillRect(painter.boundingRect(room, corner, words).adjusted(-4, -1, 4, 1), ground)
        painter.drawText(room, corner, words)


# --- page -------------------------------------------------------------------------------------
BEGIN_WIDTH = 128
WORDS_WIDTH, WORDS_SHARE = 500, 0.46
"""Of the words beside the pictures: the most [px], and of the page's width."""


class BriefingPage(QWidget):
    """What is to be done, before it begins. Enter begins, D shows, L looks around, Esc goes back.

    Attributes:
        offers: other ways to watch it, by name, each with its button.

    Signals:
        begin_wanted(), show_wanted(), look_wanted(), back_wanted().
        offer_wanted(BriefingOffer): another way to watch it.
    """

    begin_wanted = Signal()
    show_wanted = Signal()
    offer_wanted = Signal(object)
    look_wanted = Signal()
    back_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.title, self.kind = label("", "title"), label("", "dim")
        self.description = label()
        self.attempts = label()
        self.taught, self.scored, self.locked, self.aids = (BulletLabel() for _ in range(4))
        self.views = tuple(PortraitView(name, self) for name in ("axial", "coronal", "sagittal"))
        self.begin = _key_button(tr("Begin (Enter)"), "primary")
        self.show_me = _key_button(tr("Show me (D)"))
        self.offers: dict[str, tuple[BriefingOffer, QPushButton]] = {}
        self.look = _key_button(tr("Look around first (L)"))
        self.back = _key_button(tr("Back (Esc)"))
        self.skip = QCheckBox(tr("Do not show this again for this exercise"), self)
        self.why_not = label("", "dim")
        self.why_not.setAlignment(Qt.AlignmentFlag.AlignRight)  # a layout would narrow and cut it
        self.begin.setToolTip(tr("The attempt starts as soon as robot and cameras are there"))
        self.show_me.setToolTip(tr("An expert does the exercise; nothing is recorded"))
        self.look.setToolTip(tr("Study the CT without the clock; F5 starts the attempt"))
        self._lay_out()
        self._connect()
        PageKeys(self, lambda event: self._pressed(event) is not None, self.keyPressEvent)

    def show_exercise(self, exercise: Exercise, portrait: Portrait | None) -> None:
        """Show what an exercise says."""
        self.title.setText(declared(exercise.title))
        self.kind.setText(kind_words(exercise))
        self.description.setText(
            declared(exercise.description) or tr("Insert the needle to the target.")
        )
        self.taught.show_items([translated(words) for words in taught_words(exercise)])
        self.scored.show_items(scored_words(exercise))
        self.locked.show_items(locked_words(exercise))
        self.aids.show_items(aid_words(exercise, ACCESS.role))
        self.show_portrait(portrait)
        self.set_allowance(AttemptsLeft())
        self.skip.setChecked(False)
        self.skip.setVisible(exercise.purpose is Purpose.PRACTICE)
        own = exercise.is_own_plan
        self.begin.setText(tr("Begin to plan (Enter)") if own else tr("Begin (Enter)"))
        self.look.setVisible(not own)
        self.show_me.setEnabled(not own)
        for offer, widget in self.offers.values():
            widget.setEnabled(not own)
            widget.setVisible(ACCESS.role in offer.roles and offer.suits(exercise))
        self.why_not.setText(
            tr("You choose the entry here, so there is nothing to show before you have.")
            if own
            else ""
        )
        self.why_not.setVisible(own)
        self.begin.setFocus()

    def show_portrait(self, portrait: Portrait | None) -> None:
        """Show the patient; None while the picture is being made."""
        for view in self.views:
            view.show_portrait(portrait)

    def set_allowance(self, allowance: AttemptsLeft) -> None:
        """Say how many attempts there are."""
        self.attempts.setText(allowance.words())
        self.begin.setEnabled(not allowance.refusal)

    def add_offer(self, offer: BriefingOffer) -> None:
        """Add a button for another way to watch an exercise."""
        widget = _key_button(offer.title)
        widget.setToolTip(literal(offer.tip))
        widget.clicked.connect(lambda: self.offer_wanted.emit(offer))
        self._buttons.insertWidget(self._buttons.indexOf(self.look), widget)
        before = [self.show_me, *(shown for _, shown in self.offers.values())]
        QWidget.setTabOrder(before[-1], widget)
        self._keys[offer.key] = widget
        self.offers[offer.name] = offer, widget

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Share the width between words and pictures."""
        super().resizeEvent(event)
        share = round(WORDS_SHARE * self.width())
        self._area.setFixedWidth(min(theme.px(WORDS_WIDTH), share))

    # --- inside -------------------------------------------------------------------------------
    def _lay_out(self) -> None:
        words = QWidget()
        column = QVBoxLayout(words)
        column.setContentsMargins(0, 0, theme.SPACING, 0)
        column.setSpacing(theme.SPACING // 2)
        column.addWidget(self.description)
        for heading, part in (
            (tr("Steps that it teaches"), self.taught),
            (tr("What is scored"), self.scored),
            (tr("What helps"), self.aids),
            (tr("What is locked"), self.locked),
            (tr("Attempts"), self.attempts),
        ):
            named = PlainLabel(heading)
            named.setProperty("role", "heading")
            column.addSpacing(theme.SPACING)
            column.addWidget(named)
            column.addWidget(part)
        column.addStretch(1)
        area = QScrollArea()
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setWidgetResizable(True)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        area.setWidget(words)
        self._area = area
        pictures = QGridLayout()
        pictures.setSpacing(3)
        axial, coronal, sagittal = self.views
        pictures.addWidget(axial, 0, 0, 1, 2)
        pictures.addWidget(coronal, 1, 0)
        pictures.addWidget(sagittal, 1, 1)
        for row in (0, 1):
            pictures.setRowStretch(row, 1)
        middle = QHBoxLayout()
        middle.setSpacing(2 * theme.MARGIN)
        middle.addLayout(pictures, 1)
        middle.addWidget(area)
        self._buttons = buttons = QHBoxLayout()
        buttons.setSpacing(theme.SPACING)
        for widget in (self.back, self.skip):
            buttons.addWidget(widget)
        buttons.addStretch(1)
        for widget in (self.show_me, self.look, self.begin):
            buttons.addWidget(widget)
        self.begin.setMinimumWidth(theme.px(BEGIN_WIDTH))
        page = QVBoxLayout(self)
        page.setContentsMargins(2 * theme.MARGIN, theme.MARGIN, 2 * theme.MARGIN, 0)
        page.setSpacing(theme.SPACING)
        page.addWidget(self.title)
        page.addWidget(self.kind)
        page.addLayout(middle, 1)
        page.addWidget(self.why_not)
        page.addLayout(buttons)
        page.addWidget(disclaimer_label(self))

    def _connect(self) -> None:
        key = Qt.Key
        self._keys = {
            key.Key_Return: self.begin,
            key.Key_Enter: self.begin,
            key.Key_F5: self.begin,
            key.Key_D: self.show_me,
            key.Key_L: self.look,
            key.Key_Escape: self.back,
        }
        self.begin.clicked.connect(self.begin_wanted)
        self.show_me.clicked.connect(self.show_wanted)
        self.look.clicked.connect(self.look_wanted)
        self.back.clicked.connect(self.back_wanted)

    def event(self, event: QEvent) -> bool:
        """Keep the page's keys from menus that use the same ones."""
        override = event.type() == QEvent.Type.ShortcutOverride
        if override and isinstance(event, QKeyEvent) and self._pressed(event) is not None:
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Press the button of a key."""
        pressed = self._pressed(event)
        if pressed is None:
            super().keyPressEvent(event)
        elif not event.isAutoRepeat():
            pressed.click()

    def _pressed(self, event: QKeyEvent) -> QPushButton | None:
        keypad = Qt.KeyboardModifier.KeypadModifier
        plain = event.modifiers() in (Qt.KeyboardModifier.NoModifier, keypad)
        found = self._keys.get(Qt.Key(event.key())) if plain else None
        return found if found is not None and found.isVisible() else None


def _key_button(text: str, role: str = "") -> QPushButton:
    made = button(text, role, FittingButton)
    made.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    return made
