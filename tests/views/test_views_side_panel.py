"""The panels beside the panes: all names to be seen, one panel shown."""

import pytest
from PySide6.QtWidgets import QApplication, QLabel

from app.views.kit.side_panel import IN_A_ROW, SidePanel


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
