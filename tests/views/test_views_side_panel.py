"""The panels beside the panes: all names to be seen, one panel shown."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QComboBox,
    QDoubleSpinBox,
    QLabel,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from app.views.kit.side_panel import IN_A_ROW, SidePanel, scrolled
from app.views.kit.wheel import _WheelGuard, wheel_scrolls


@pytest.fixture
def side(application):
    panel = SidePanel()
    panel.setFixedWidth(376)
    for name in ("Plan", "Exercise", "Cameras", "Robot", "Structures", "Measure", "Paths"):
        panel.addTab(QLabel(name), name)
    panel.resize(376, 600)
    panel.show()
    QApplication.processEvents()
    yield panel
    panel.close()


def test_no_name_is_cut_or_hidden_however_many_there_are(side):
    for button in side._buttons.buttons():
        assert button.isVisible()
        assert button.fontMetrics().horizontalAdvance(button.text()) + 4 <= button.width()
    assert max(button.geometry().right() for button in side._buttons.buttons()) == 375
    rows = {button.y() for button in side._buttons.buttons()}
    assert len(rows) == -(-side.count() // IN_A_ROW)


def test_a_click_shows_its_panel_and_marks_one_name(side):
    shown = []
    side.changed.connect(shown.append)
    side._buttons.button(4).click()
    assert side.currentWidget().text() == "Structures"
    assert shown == [4]
    assert [button.text() for button in side._buttons.buttons() if button.isChecked()] == [
        "Structures"
    ]


def test_a_panel_chosen_by_the_program_marks_its_name_too(side):
    side.setCurrentIndex(2)
    assert side.currentIndex() == 2
    assert side._buttons.button(2).isChecked()
    assert side.names()[2] == "Cameras"


def turn(box, application):
    """Turn the wheel over a box; return whether it kept the event from what is round it."""
    where = QPointF(box.rect().center())
    wheel = QWheelEvent(
        where,
        QPointF(box.mapToGlobal(where.toPoint())),
        QPoint(0, 0),
        QPoint(0, -120),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    application.sendEvent(box, wheel)
    return wheel.isAccepted()


def test_the_wheel_over_a_closed_box_is_left_to_the_panel_and_changes_nothing(application):
    inside = QWidget()
    column = QVBoxLayout(inside)
    boxes = [QComboBox(), QSpinBox(), QDoubleSpinBox()]
    boxes[0].addItems(["a", "b", "c"])
    for box in boxes:
        column.addWidget(box)
    area = scrolled(inside)
    area.resize(300, 300)
    area.show()
    area.setFocus()
    QApplication.processEvents()
    for box in boxes:
        assert not turn(box, application)
        assert not box.hasFocus()
        assert box.focusPolicy() is Qt.FocusPolicy.StrongFocus
    assert boxes[0].currentIndex() == 0
    assert [box.value() for box in boxes[1:]] == [0, 0]
    area.activateWindow()
    boxes[0].setFocus()
    QApplication.processEvents()
    assert boxes[0].hasFocus()
    assert turn(boxes[0], application)
    assert boxes[0].currentIndex() == 1
    area.close()


def test_a_box_that_comes_later_is_guarded_by_a_call_of_its_own_once(application):
    box = QComboBox()
    for _ in range(2):
        wheel_scrolls(box)
    box.addItems(["a", "b"])
    turn(box, application)
    assert box.currentIndex() == 0
    assert len(box.findChildren(_WheelGuard)) == 1


def test_a_click_on_a_name_leaves_the_keys_where_they_are(side):
    field = QSpinBox(side)
    field.show()
    side.activateWindow()
    field.setFocus()
    QApplication.processEvents()
    assert field.hasFocus()
    QTest.mouseClick(side._buttons.button(3), Qt.MouseButton.LeftButton)
    assert field.hasFocus()
    assert side.currentIndex() == 3
