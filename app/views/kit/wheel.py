"""The wheel over a closed box scrolls the page; a box takes it only once it has the keyboard."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QAbstractSpinBox, QComboBox, QSlider, QWidget

_BOXES = (QComboBox, QAbstractSpinBox, QSlider)


class _WheelGuard(QObject):
    """Hands the wheel over a box without the keyboard on to what is round it."""

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Leave the box as it is; an event that is ignored goes to the widget round it."""
        if (
            event.type() is QEvent.Type.Wheel
            and isinstance(watched, QWidget)
            and not watched.hasFocus()
        ):
            event.ignore()
            return True
        return False


def wheel_scrolls(page: QWidget) -> None:
    """Let the wheel scroll a page, whatever box of it is under the mouse; it would change values.

    Args:
        page: a box, or what has boxes in it now; those that come later need a call of their own.
    """
    if isinstance(page, QAbstractSpinBox | QComboBox | QSlider):
        boxes: list[QWidget] = [page]
    else:
        boxes = [one for one in page.findChildren(QWidget) if isinstance(one, _BOXES)]
    for box in boxes:
        if box.focusPolicy() is Qt.FocusPolicy.WheelFocus:
            box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)  # the wheel gives it no keyboard either
        if box.findChild(_WheelGuard, options=Qt.FindChildOption.FindDirectChildrenOnly) is None:
            box.installEventFilter(_WheelGuard(box))
