"""Rules that a picture of a window must keep: contrast, cut and lying texts, names, focus, keys.

Contrast is measured on the pixels as they are seen, by the formula of WCAG 2.2 (W3C, success
criterion 1.4.3 and "relative luminance"), whatever palette or style sheet they come from. Texts on
pictures of patients are left out: their ground is the CT, they have a dark rim instead.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtGui import QAccessible, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractScrollArea,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QCheckBox,
    QComboBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QPushButton,
    QRadioButton,
    QScrollBar,
    QStyle,
    QStyleOptionButton,
    QTabBar,
    QTextEdit,
    QWidget,
)

from app.views.shell.message_bar import MessageBar
from app.views.shell.tour import TourVeil
from app.views.shell.window import MainWindow
from app.views.slices.words import Overlay
from tests.careless.texts import cut_texts

CONTRAST: Final = 4.5
"""Of text against its ground at least; what cannot be used now is exempt, as in WCAG."""

BY_KEY: Final = {
    "FeedButton": "Page Up and Page Down, which the bull's-eye keeps",
    "SkillPlace": "the arrow keys, from the one place of the map that Tab comes to",
    "KeyDialog": "it takes the next key that is pressed, and Escape cancels",
}
"""Controls that Tab may leave out, and the keys that do the same."""

SMALLEST: Final = QSize(1366, 768)
"""Screen that every window fits."""

SLACK_PX: Final = 1
FEW_PX: Final = 3
"""As many pixels of a letter's colour make it count."""

TYPE_SIZES: Final = 4
IN_ATTEMPT: Final = 3
"""Sizes of type in a window at most; while an attempt has it."""

CONTROLS: Final = (
    QAbstractButton,
    QComboBox,
    QLineEdit,
    QAbstractSpinBox,
    QAbstractSlider,
    QAbstractItemView,
    QTabBar,
    QPlainTextEdit,
    QTextEdit,
)
"""What somebody does something with."""

_INNER: Final = (QScrollBar, QHeaderView)
"""Parts of others, which have the keys."""


@dataclass(frozen=True, slots=True)
class Fault:
    """A rule that a picture breaks.

    Attributes:
        rule: its name: contrast, cut, overlap, outside, size, type, name, focus, tab.
        where: widget, by class and words.
        words: what is wrong.
    """

    rule: str
    where: str
    words: str

    def __str__(self) -> str:
        """Return it as one line."""
        return f"{self.rule}: {self.where}: {self.words}"


def judged(window: QWidget, shot: QImage | None = None) -> list[Fault]:
    """Return what a window breaks of the rules that hold in every language and size.

    Args:
        window: shown.
        shot: picture of it, one pixel for each of the window's; grabbed where it is not given.
    """
    image = shot if shot is not None else window.grab().toImage()
    seen = _uncovered(list(_seen(window)))
    return [
        *_contrast(window, pixels(image), seen),
        *(Fault("cut", *words.split(" ", 1)) for words in cut_texts(window)),
        *_cut(seen),
        *_overlaps(window, seen),
        *_outside(seen),
        *_size(window),
        *_type(window, seen),
    ]


def judged_by_keys(window: QWidget) -> list[Fault]:
    """Return what a window breaks of the rules for keyboard and screen reader; slow."""
    window.activateWindow()
    QApplication.processEvents()
    controls = [widget for widget in _uncovered(list(_seen(window))) if is_control(widget)]
    return [*_names(controls), *_focus(controls), *_tab(window, controls)]


# --- what is seen -----------------------------------------------------------------------------
def _seen(window: QWidget) -> Iterator[QWidget]:
    """Yield what can be seen of a window's widgets, in the order of their making."""
    for widget in window.findChildren(QWidget):
        if (
            widget.window() is window
            and widget.isVisible()
            and not widget.visibleRegion().isEmpty()
        ):
            yield widget


def _uncovered(seen: list[QWidget]) -> list[QWidget]:
    """Leave out what lies under a tour's veil, which dims it and takes its keys."""
    veil = next((widget for widget in seen if isinstance(widget, TourVeil)), None)
    return seen if veil is None else [widget for widget in seen if veil.isAncestorOf(widget)]


def is_control(widget: QWidget) -> bool:
    """Return whether somebody does something with a widget itself, and may do so now."""
    parent = widget.parentWidget()
    inner = isinstance(widget, _INNER) or (
        isinstance(parent, QAbstractSpinBox | QComboBox | QTabBar | QLineEdit)
        or widget.objectName().startswith("qt_")
        or (isinstance(widget, QAbstractSlider) and isinstance(parent, QAbstractScrollArea))
    )
    return isinstance(widget, CONTROLS) and widget.isEnabled() and not inner


def called(widget: QWidget) -> str:
    """Return class and words of a widget, with those that it lies in."""
    words = text_of(widget) or widget.accessibleName() or widget.objectName()
    around = widget.parentWidget()
    while around is not None and type(around).__module__.startswith("PySide6"):
        around = around.parentWidget()
    inside = f" in {type(around).__name__}" if around is not None else ""
    return f"{type(widget).__name__} {' '.join(words.split())[:50]!r}{inside}"


def text_of(widget: QWidget) -> str:
    """Return the text that a widget shows, without the mark of its key; empty for none."""
    if isinstance(widget, QLabel):
        return widget.text() if widget.pixmap().isNull() else ""
    if isinstance(widget, QAbstractButton):
        return re.sub(r"&(.)", r"\1", widget.text())
    if isinstance(widget, QComboBox):
        return widget.currentText()
    if isinstance(widget, QLineEdit):
        return widget.text() or widget.placeholderText()
    return ""


def _place(window: QWidget, widget: QWidget) -> QRect:
    """Return the part of a widget that is seen, in the window."""
    return widget.visibleRegion().boundingRect().translated(widget.mapTo(window, QPoint()))


# --- contrast ---------------------------------------------------------------------------------
def pixels(image: QImage) -> NDArray[np.uint8]:
    """Return a picture as (height, width, 3) RGB."""
    image = image.convertToFormat(QImage.Format.Format_RGB888)
    raw = np.frombuffer(image.constBits(), np.uint8)
    rows = raw.reshape(image.height(), image.bytesPerLine())[:, : 3 * image.width()]
    return rows.reshape(image.height(), image.width(), 3).copy()


def luminance(rgb: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Return the relative luminance in [0, 1] of sRGB colours, shape (…, 3) -> (…)."""
    c = rgb.astype(np.float64) / 255.0
    linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    light: NDArray[np.float64] = linear @ np.array([0.2126, 0.7152, 0.0722])
    return light


def contrast(ground: float, text: float) -> float:
    """Return the ratio of two relative luminances, 1 to 21."""
    light, dark = max(ground, text), min(ground, text)
    return (light + 0.05) / (dark + 0.05)


def text_contrast(area: NDArray[np.uint8]) -> float:
    """Return the contrast of an area's text against its ground; 1 where there is none.

    The ground is the commonest colour; the text's colour is the one farthest from it that at least
    `FEW_PX` pixels have: edges of letters are lighter than their stems.
    """
    packed = area.reshape(-1, 3).astype(np.uint32) @ np.array([65536, 256, 1], np.uint32)
    values, counts = np.unique(packed, return_counts=True)  # of rows it takes ten times as long
    light = luminance(
        np.stack([values >> 16, values >> 8 & 255, values & 255], -1).astype(np.uint8)
    )
    ground = float(light[counts.argmax()])
    ratios = np.array([contrast(ground, float(one)) for one in light])
    order = np.argsort(-ratios)
    enough = np.cumsum(counts[order]) >= FEW_PX
    return float(ratios[order][enough][0]) if enough.any() else 1.0


def _contrast(window: QWidget, shot: NDArray[np.uint8], seen: list[QWidget]) -> Iterator[Fault]:
    for widget in seen:
        if not text_of(widget).strip() or not widget.isEnabled() or _on_picture(widget):
            continue
        rect = _place(window, widget).adjusted(2, 2, -2, -2)  # without the frame
        area = shot[max(rect.top(), 0) : rect.bottom() + 1, max(rect.left(), 0) : rect.right() + 1]
        if min(area.shape[:2]) < 8:
            continue
        ratio = text_contrast(area)
        if ratio < CONTRAST:
            yield Fault("contrast", called(widget), f"{ratio:.1f}, at least {CONTRAST:g}")


def _on_picture(widget: QWidget) -> bool:
    """Return whether a text stands on a CT or another picture."""
    return isinstance(widget, Overlay) or isinstance(widget.parentWidget(), QAbstractScrollArea)


# --- places -----------------------------------------------------------------------------------
def _cut(seen: list[QWidget]) -> Iterator[Fault]:
    """Yield buttons whose text is wider than the place that their style leaves, and tabs."""
    for widget in seen:
        if isinstance(widget, QTabBar):
            for tab in range(widget.count()):
                need = widget.fontMetrics().horizontalAdvance(
                    re.sub(r"&(.)", r"\1", widget.tabText(tab))
                )
                if need > widget.tabRect(tab).width() + SLACK_PX:
                    yield Fault("cut", called(widget), f"tab {widget.tabText(tab)!r}")
        elif isinstance(widget, QPushButton | QCheckBox | QRadioButton):
            need, room = _needed(widget), _room(widget)
            if need > room + SLACK_PX:
                yield Fault("cut", called(widget), f"needs {need} px, has {room}")


def _needed(button: QAbstractButton) -> int:
    metrics = button.fontMetrics()
    lines = text_of(button).split("\n")
    icon = 0 if button.icon().isNull() else button.iconSize().width() + 4
    return icon + max(metrics.horizontalAdvance(line) for line in lines)


def _room(button: QAbstractButton) -> int:
    option, element = QStyleOptionButton(), QStyle.SubElement.SE_PushButtonContents
    if isinstance(button, QCheckBox):
        element = QStyle.SubElement.SE_CheckBoxContents
    elif isinstance(button, QRadioButton):
        element = QStyle.SubElement.SE_RadioButtonContents
    option.initFrom(button)
    if isinstance(button, QPushButton | QCheckBox | QRadioButton):
        button.initStyleOption(option)
    return button.style().subElementRect(element, option, button).width()


def _overlaps(window: QWidget, seen: list[QWidget]) -> Iterator[Fault]:
    """Yield pairs of texts that lie on each other."""
    texts = [
        (widget, _ink(window, widget))
        for widget in seen
        if isinstance(widget, QLabel | QAbstractButton | QComboBox | QLineEdit)
        and text_of(widget).strip()
    ]
    for number, (widget, rect) in enumerate(texts):
        for other, place in texts[:number]:
            both = rect.intersected(place)
            apart = both.width() <= 2 or both.height() <= 2
            if apart or widget.isAncestorOf(other) or other.isAncestorOf(widget):
                continue
            if _floats(widget) != _floats(other):  # a notice lies on the page until it is closed
                continue
            yield Fault("overlap", called(widget), f"lies on {called(other)}")


def _floats(widget: QWidget) -> bool:
    parent = widget.parentWidget()
    return parent is not None and (isinstance(parent, MessageBar) or _floats(parent))


def _ink(window: QWidget, widget: QWidget) -> QRect:
    """Return where a widget's text is seen in the window: of a label the text's own rectangle."""
    place = _place(window, widget)
    if not isinstance(widget, QLabel) or widget.wordWrap():
        return place
    room = widget.contentsRect()
    size = widget.fontMetrics().size(0, widget.text())
    rect = QStyle.alignedRect(
        widget.layoutDirection(), widget.alignment(), size.boundedTo(room.size()), room
    )
    return rect.translated(widget.mapTo(window, QPoint())).intersected(place)


def _outside(seen: list[QWidget]) -> Iterator[Fault]:
    """Yield texts and controls that stick out of what they lie in, where nothing scrolls."""
    for widget in seen:
        if not text_of(widget).strip() and not is_control(widget):
            continue
        around, place = widget.parentWidget(), widget.geometry()
        while around is not None:
            scrolls = isinstance(around.parentWidget(), QAbstractScrollArea)
            if scrolls:
                place = place.intersected(QRect(place.x(), 0, place.width(), around.height()))
            room = around.rect().adjusted(-SLACK_PX, -SLACK_PX, SLACK_PX, SLACK_PX)
            if not room.contains(place) and not place.isEmpty():
                yield Fault(
                    "outside", called(widget), f"{_box(place)} beyond {called(around)} {_box(room)}"
                )
                break
            if scrolls or around.isWindow():
                break
            place = place.translated(around.pos())
            around = around.parentWidget()


def _box(rect: QRect) -> str:
    return f"{rect.width()}x{rect.height()} at {rect.x()},{rect.y()}"


def _size(window: QWidget) -> Iterator[Fault]:
    least = window.minimumSizeHint().expandedTo(window.minimumSize())
    if least.width() > SMALLEST.width() or least.height() > SMALLEST.height():
        yield Fault(
            "size", type(window).__name__, f"needs {least.width()}x{least.height()} at least"
        )


def _type(window: QWidget, seen: list[QWidget]) -> Iterator[Fault]:
    """Yield the sizes of type where there are more than three."""
    sizes: dict[int, str] = {}
    for widget in seen:
        if text_of(widget).strip() and not _on_picture(widget):
            sizes.setdefault(widget.fontInfo().pixelSize(), called(widget))
    room = window.workspace.room if isinstance(window, MainWindow) else None
    most = IN_ATTEMPT if room is not None and room.is_on and not room.is_open else TYPE_SIZES
    if len(sizes) > most:
        words = ", ".join(f"{size} px ({sizes[size]})" for size in sorted(sizes))
        yield Fault("type", type(window).__name__, words)


# --- keyboard and screen reader ---------------------------------------------------------------
def _names(controls: list[QWidget]) -> Iterator[Fault]:
    for widget in controls:
        if not spoken(widget).strip():
            yield Fault("name", called(widget), "a screen reader has no name for it")


def spoken(widget: QWidget) -> str:
    """Return what a screen reader calls a widget, as Qt's accessibility tells it."""
    node = QAccessible.queryAccessibleInterface(widget)
    return node.text(QAccessible.Text.Name) if node is not None else ""


def _focus(controls: list[QWidget]) -> Iterator[Fault]:
    """Yield controls that look the same with the keyboard's focus and without it."""
    before = QApplication.focusWidget()
    for widget in controls:
        if not widget.focusPolicy() & Qt.FocusPolicy.TabFocus:
            continue
        holder = widget.focusProxy() or widget
        holder.clearFocus()
        QApplication.processEvents()
        without = pixels(widget.grab().toImage())
        holder.setFocus(Qt.FocusReason.TabFocusReason)
        QApplication.processEvents()
        if not holder.hasFocus():
            continue
        if np.array_equal(without, pixels(widget.grab().toImage())):
            yield Fault("focus", called(widget), "looks the same with the focus as without")
    if before is not None:
        before.setFocus()


def _tab(window: QWidget, controls: list[QWidget]) -> Iterator[Fault]:
    """Yield controls that the Tab key does not come to, pressed until it comes round."""
    wanted = {
        widget
        for widget in controls
        if not _of_group(widget) and not {type(widget).__name__, type(window).__name__} & {*BY_KEY}
    }
    reached: set[QWidget] = set()
    for _ in range(2 * len(list(_seen(window)))):
        now = QApplication.focusWidget()
        if now is None:
            now = window
        known = now in reached
        reached.add(now)
        if known and len(reached) > 1 and wanted <= reached:
            break
        QTest.keyClick(now, Qt.Key.Key_Tab)
        if QApplication.focusWidget() is now:  # it keeps the key to itself, as a text does
            QTest.keyClick(now, Qt.Key.Key_Tab, Qt.KeyboardModifier.ControlModifier)
        # A date has three parts, each a step: only another control that was there is once round.
        after = QApplication.focusWidget()
        if known and after is not now and after in reached:
            break
    for widget in controls:
        holder = widget.focusProxy() or widget
        # Of one choice of many Qt has Tab come to the one that was reached last.
        group = widget.group() if isinstance(widget, QAbstractButton) else None
        alike = {holder, *(group.buttons() if group is not None else ())}
        if widget in wanted and not alike & reached:
            why = "" if holder.focusPolicy() & Qt.FocusPolicy.TabFocus else " (takes no focus)"
            yield Fault("tab", called(widget), f"the Tab key does not reach it{why}")


def _of_group(widget: QWidget) -> bool:
    """Return whether the arrows lead to it from a neighbour: unchecked, one choice of many."""
    if not isinstance(widget, QAbstractButton) or widget.isChecked():
        return False
    return isinstance(widget, QRadioButton) or widget.group() is not None


# --- an attempt -------------------------------------------------------------------------------
SHARES: Final = {"ct": 0.60, "rail": 0.18, "bullseye": 0.20}
"""Of the window: at least of its area; at most of its width; at most of its width."""


def judged_in_attempt(window: MainWindow) -> list[Fault]:
    """Return what the window breaks of an attempt's rules: shares of pictures, rail, bull's-eye."""
    workspace = window.workspace
    if workspace.room.is_open or workspace.room.shows_scan:
        return []
    panes = [_place(window, pane) for pane in workspace.slices if pane.isVisible()]
    share = sum(rect.width() * rect.height() for rect in panes) / (window.width() * window.height())
    rail, cell = _place(window, workspace.rail), _place(window, workspace.needle_cell)
    wrong = {
        f"the CT has {share:.3f} of the window": share < SHARES["ct"],
        f"the rail has {rail.width()} px": rail.width() > SHARES["rail"] * window.width(),
        f"the bull's-eye has {cell.width()} px": cell.width() > SHARES["bullseye"] * window.width(),
    }
    return [Fault("share", "AttemptRoom", words) for words, is_wrong in wrong.items() if is_wrong]
