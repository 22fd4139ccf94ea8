"""Widgets by a name that another run of the window finds again, and what is on the screen now."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QApplication,
    QComboBox,
    QFileDialog,
    QLineEdit,
    QMenu,
    QSlider,
    QTabBar,
    QWidget,
)

from app.views.exercise.pad_canvas import PadCanvas
from app.views.scene.view import SceneView
from app.views.slices.canvas import SliceCanvas

CONTROLS = (QAbstractButton, QComboBox, QLineEdit, QSlider, QTabBar, QAbstractItemView)
PICTURES = (PadCanvas, SliceCanvas, SceneView)
SMALLEST_PX = 6


@dataclass(frozen=True, slots=True)
class Target:
    """Something to point at.

    Attributes:
        path: where it hangs in the tree of widgets, from its window down.
        words: what it says, for whoever reads the list of actions.
        box: its rectangle on the screen (x, y, width, height) [px].
    """

    path: str
    words: str
    box: tuple[int, int, int, int]


def top() -> QWidget | None:
    """Return the window that takes the mouse now: a pop-up, a modal dialog, or the active one."""
    popup = QApplication.activePopupWidget() or QApplication.activeModalWidget()
    if popup is not None:
        return popup
    active = QApplication.activeWindow()
    if active is not None:
        return active
    shown = [widget for widget in QApplication.topLevelWidgets() if widget.isVisible()]
    return shown[-1] if shown else None


def targets(window: QWidget, kinds: tuple[type, ...]) -> list[Target]:
    """Return all enabled widgets of these kinds that can be seen in the window."""
    found = []
    for widget in (window, *window.findChildren(QWidget)):
        if isinstance(widget, kinds) and widget.isEnabled() and widget.isVisible():
            box = seen_box(widget)
            if box is not None:
                found.append(Target(path_of(widget), words_of(widget), box))
    return found


def seen_box(widget: QWidget) -> tuple[int, int, int, int] | None:
    """Return the part of a widget that can be seen, on the screen; None if there is none."""
    seen = widget.visibleRegion().boundingRect()
    if seen.width() < SMALLEST_PX or seen.height() < SMALLEST_PX:
        return None
    corner = widget.mapToGlobal(seen.topLeft())
    return corner.x(), corner.y(), seen.width(), seen.height()


def path_of(widget: QWidget) -> str:
    """Return class and number among its siblings of that class, from the window down."""
    parts = []
    while widget is not None:
        parent = widget.parentWidget() if not widget.isWindow() else None
        kind = type(widget).__name__
        siblings = _children(parent, kind) if parent is not None else [widget]
        parts.append(f"{kind}{siblings.index(widget) if widget in siblings else 0}")
        widget = parent
    return "/".join(reversed(parts))


def find(path: str) -> QWidget | None:
    """Return the widget of such a path in a window that is shown; None if there is none."""
    first, *rest = path.split("/")
    for window in reversed(QApplication.topLevelWidgets()):
        if window.isVisible() and f"{type(window).__name__}0" == first:
            widget: QWidget | None = window
            for part in rest:
                widget = _child(widget, part) if widget is not None else None
            if widget is not None and widget.isVisible():
                return widget
    return None


def words_of(widget: QWidget) -> str:
    """Return what a widget says, or what it is called."""
    for name in ("text", "currentText", "title", "accessibleName", "toolTip"):
        method = getattr(widget, name, None)
        words = method() if callable(method) else ""
        if isinstance(words, str) and words.strip():
            return " ".join(words.split())[:40]
    return type(widget).__name__


def menu_items(menu: QMenu) -> list[Target]:
    """Return the enabled entries of an open menu; never the one that quits."""
    found = []
    for action in menu.actions():
        words = action.text().replace("&", "")
        if action.isSeparator() or not action.isEnabled() or words.startswith("Quit"):
            continue
        box = menu.actionGeometry(action)
        corner = menu.mapToGlobal(box.topLeft())
        found.append(Target("", words, (corner.x(), corner.y(), box.width(), box.height())))
    return found


def menu_titles(window: QWidget) -> list[Target]:
    """Return the titles of the menu bar."""
    bar = getattr(window, "menuBar", lambda: None)()
    if bar is None:
        return []
    found = []
    for action in bar.actions():
        box: QRect = bar.actionGeometry(action)
        corner: QPoint = bar.mapToGlobal(box.topLeft())
        found.append(
            Target(
                "",
                action.text().replace("&", ""),
                (corner.x(), corner.y(), box.width(), box.height()),
            )
        )
    return found


def is_file_dialog(window: QWidget | None) -> bool:
    """Whether a dialog of files is in front, in which nobody may type at random."""
    while window is not None:
        if isinstance(window, QFileDialog):
            return True
        window = window.parentWidget()
    return False


def _children(parent: QWidget, kind: str) -> list[QWidget]:
    return [
        child
        for child in parent.children()
        if isinstance(child, QWidget) and not child.isWindow() and type(child).__name__ == kind
    ]


def _child(parent: QWidget, part: str) -> QWidget | None:
    kind = part.rstrip("0123456789")
    number = int(part[len(kind) :] or 0)
    same = _children(parent, kind)
    return same[number] if number < len(same) else None
