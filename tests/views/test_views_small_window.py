"""A window of 900 x 560 has room for every page, and no word in it is cut."""

import pytest
from PySide6.QtWidgets import QApplication, QLabel

from app.views.exercise.attempt_rail import GRID, AttemptRail, RailFigures, rail_width
from app.views.kit.access import ACCESS
from app.views.kit.language import use_language
from app.views.kit.parts import FittingButton, with_short_key
from app.views.kit.roles import Role
from app.views.kit.text import tr
from app.views.shell.remembered import SMALLEST

WIDTH, HEIGHT = 900, 560
PAUSE = (
    "The attempt is paused: the pictures of the cameras come too late for this computer; close "
    "other programs, and it goes on by itself as soon as they come in time again"
)


@pytest.fixture(autouse=True)
def the_role_of_before():
    yield
    ACCESS.take_role(Role.TECHNICIAN)


@pytest.fixture(params=["en", "de", "fr"])
def spoken(request, application):
    use_language(application, request.param)
    yield request.param
    use_language(application, "en")


def test_a_screen_of_900_by_560_has_room_for_the_window(window):
    assert SMALLEST <= (WIDTH, HEIGHT)
    window.show()
    window.resize(WIDTH, HEIGHT)
    for role in (Role.TECHNICIAN, Role.INSTRUCTOR, Role.STUDENT):
        window.roles.choose(role)
        QApplication.processEvents()
        for place in range(window.pages.count()):
            page = window.pages.widget(place)
            least = page.minimumSizeHint()
            assert least.width() <= WIDTH, type(page).__name__
    for place in range(window.pages.count()):
        page = window.pages.widget(place)
        window.pages.setCurrentWidget(page)
        QApplication.processEvents()
        least = page.minimumSizeHint()
        assert least.height() + window.menuBar().height() <= HEIGHT, type(page).__name__
    window.pages.setCurrentWidget(window.start_page)
    QApplication.processEvents()
    assert (window.width(), window.height()) == (WIDTH, HEIGHT)


def test_the_map_of_skills_is_whole_in_a_small_window(window):
    window.show()
    window.resize(WIDTH, HEIGHT)
    window.pages.setCurrentWidget(window.start_page)
    QApplication.processEvents()
    field = window.start_page.map
    assert field.verticalScrollBar().maximum() > 0
    for place in field.places.values():
        assert place.geometry().right() <= field.viewport().width()


def test_the_role_button_has_room_for_its_role(window):
    window.show()
    window.resize(WIDTH, HEIGHT)
    for role in (*Role, *reversed(Role)):
        window.roles.choose(role)
        QApplication.processEvents()
        button = window.roles.button
        assert button.width() >= button.sizeHint().width()
        assert button.geometry().right() < window.width()


@pytest.mark.parametrize("width", [WIDTH, 1024, 1366, 1920])
def test_the_longest_depth_is_not_cut_in_the_rail(application, width):
    figures = RailFigures()
    figures.suit_width(rail_width(width) - 2 * GRID - 14)
    for key, text in (("depth", "-117.8 mm"), ("to_target", "102.0 mm"), ("elapsed", "100:00")):
        figures._values[key].setText(text)
    figures.resize(rail_width(width) - 2 * GRID - 14, 200)
    figures.show()
    QApplication.processEvents()
    for label in figures.findChildren(QLabel):
        label.ensurePolished()
        assert label.fontMetrics().horizontalAdvance(label.text()) <= label.width()
    figures.hide()


@pytest.mark.parametrize("width", [WIDTH, 1180, 1366])
def test_the_longest_pause_is_not_cut_in_the_rail(application, width):
    rail = AttemptRail()
    rail.suit_window(width)
    usual = rail.order.height()
    rail.order.say(PAUSE)
    rail.resize(rail.width(), 900)
    rail.show()
    QApplication.processEvents()
    assert rail.order.heightForWidth(rail.order.width()) <= rail.order.height()
    rail.order.say("Insert")
    assert rail.order.height() == usual
    rail.hide()


def test_a_button_that_gives_way_keeps_its_key_as_long_as_it_can(spoken):
    text = tr("End attempt (Enter)")
    short = with_short_key(text)
    assert short == text.rpartition(" (")[0] + " (⏎)"
    button = FittingButton(text)
    button.show()
    button.resize(button.sizeHint())
    assert button.text() == text
    seen = [text]
    while "…" not in seen[-1]:
        button.resize(button.width() - 1, button.height())
        if button.text() != seen[-1]:
            seen.append(button.text())
    assert seen[:3] == [text, short, text.rpartition(" (")[0]]
    button.hide()


def test_the_key_of_a_button_is_shortened_to_the_key_alone():
    assert with_short_key("Abort (hold Esc)") == "Abort (Esc)"
    assert with_short_key("Control scan (S)") == "Control scan (S)"
    assert with_short_key("Practise: align only") == "Practise: align only"
    assert with_short_key("Save report (PDF)") == "Save report (PDF)"
