"""Texts that are cut off: wider or higher than the place that their widget has for them."""

from __future__ import annotations

import re

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import Qt as GuiQt
from PySide6.QtGui import QTextDocument
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QComboBox,
    QFileDialog,
    QGroupBox,
    QLabel,
    QStyle,
    QStyleOptionComboBox,
    QToolButton,
    QWidget,
)

SLACK_PX = 1
ELIDED = "…"


def cut_texts(window: QWidget) -> list[str]:
    """Return what is cut off in a window, each with the widget's class, text and sizes [px].

    Text that ends in an ellipsis is not cut where the widget's tooltip has more of it.
    """
    found: list[str] = []
    if isinstance(window, QFileDialog):
        return found  # Qt's own, of its own sizes
    for widget in window.findChildren(QWidget):
        if widget.isVisible() and widget.width() > 0 and widget.window() is window:
            words = _cut(widget)
            if words:
                found.append(f"{type(widget).__name__} {words}")
    return found


def _cut(widget: QWidget) -> str:
    if isinstance(widget, QLabel):
        return _label(widget)
    if isinstance(widget, QComboBox):
        return _combo(widget)
    if isinstance(widget, QToolButton) and widget.text().startswith("qt_"):
        return ""
    if isinstance(widget, QAbstractButton):
        return _line(widget, widget.text(), widget.contentsRect().width())
    if isinstance(widget, QGroupBox):
        return _line(widget, widget.title(), widget.contentsRect().width())
    return ""


def _label(label: QLabel) -> str:
    text, room = label.text(), label.contentsRect()
    if label.buddy() is not None:
        text = re.sub(r"&(.)", r"\1", text)  # the letter of its key is only underlined
    margin = 2 * label.margin() + max(label.indent(), 0)
    if not text.strip() or label.pixmap().width() > 0:
        return ""
    if GuiQt.mightBeRichText(text) and label.textFormat() != Qt.TextFormat.PlainText:
        page = QTextDocument()
        page.setDefaultFont(label.font())
        page.setDocumentMargin(0)
        page.setHtml(text)
        page.setTextWidth(room.width() - margin if label.wordWrap() else -1)
        width, height = page.idealWidth(), page.size().height()
    else:
        flags = Qt.TextFlag.TextWordWrap if label.wordWrap() else Qt.TextFlag.TextExpandTabs
        around = QRect(0, 0, room.width() - margin if label.wordWrap() else 100000, 100000)
        box = label.fontMetrics().boundingRect(around, int(flags), text)
        width, height = box.width(), box.height()
    if ELIDED in text[-2:] and label.toolTip():
        return ""
    if width > room.width() - margin + SLACK_PX or height > room.height() + 2 * SLACK_PX:
        return _said(text, width, height, room.width(), room.height())
    return ""


def _line(widget: QWidget, text: str, room: int) -> str:
    text = re.sub(r"&(.)", r"\1", text)
    width = max(
        (widget.fontMetrics().horizontalAdvance(line) for line in text.split("\n")), default=0
    )
    if not text.strip() or width <= room + SLACK_PX or (text.endswith(ELIDED) and widget.toolTip()):
        return ""
    return _said(text, width, 0, room, widget.height())


def _combo(combo: QComboBox) -> str:
    option = QStyleOptionComboBox()
    combo.initStyleOption(option)
    room = combo.style().subControlRect(
        QStyle.ComplexControl.CC_ComboBox, option, QStyle.SubControl.SC_ComboBoxEditField, combo
    )
    if combo.toolTip() and combo.currentText() in combo.toolTip():
        return ""
    return _line(combo, combo.currentText(), room.width())


def _said(text: str, width: float, height: float, room: int, tall: int) -> str:
    return f"{' '.join(text.split())[:60]!r} needs {width:.0f}x{height:.0f} px, has {room}x{tall}"


def all_windows() -> list[QWidget]:
    """Return every window that is shown."""
    return [widget for widget in QApplication.topLevelWidgets() if widget.isVisible()]
