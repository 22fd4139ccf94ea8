"""The tour of the window: offered, taken, left, repeated; never in the way."""

import threading
from dataclasses import replace

import pytest

pytest.importorskip("PySide6")

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.planning.plan import Plan
from app.views.debrief.page import DebriefPage
from app.views.reading.workspace import WorkspacePage
from app.views.shell.start_page import StartPage


@pytest.fixture
def tour(window, settle, patient, monkeypatch):
    """The tour of a window that is shown; the first exercise's patient comes when a test says."""
    come = threading.Event()

    def slow(seed, progress):
        while not come.wait(0.01):
            progress.report(0.5, "coming")
        return replace(patient, phantom_seed=seed)

    monkeypatch.setattr("app.views.series.open_ct.load_phantom", slow)
    plan = Plan((5.0, -18.0, 140.0), (5.0, 5.0, 140.0), "phantom")
    monkeypatch.setattr("app.exercises.scene.plan_of", lambda _: plan)
    window.patient_comes = come
    window.resize(1366, 768)
    window.show()
    window.activateWindow()
    settle(window.isActiveWindow)
    yield window.tour
    come.set()


@pytest.mark.long("journey")
def test_the_first_start_offers_the_tour_beside_everything_else(window, tour):
    assert window.start_page.offer.isVisible()
    assert not tour.veil.isVisible()  # nothing covers what a script or a hurried person presses
    window.start_page.no_tour.click()
    assert not window.start_page.offer.isVisible()
    assert not tour.is_wanted
    assert not tour.veil.isVisible()


@pytest.mark.long("journey")
def test_the_tour_points_at_real_parts_in_turn_and_returns_where_it_began(window, tour, settle):
    window.start_page.tour.click()
    seen, titles = [], []
    while tour.number is not None:
        settle()
        seen.append(type(window.pages.currentWidget()))
        titles.append(tour.veil.title.text())
        part = tour._stops[tour.number].part()
        assert part.isVisible(), titles[-1]
        assert tour.veil._shown.isValid(), titles[-1]
        assert tour.veil.rect().contains(tour.veil.bubble.geometry()), titles[-1]
        QTest.keyClick(tour.veil, Qt.Key.Key_Return)
    assert titles == [
        "The patient",
        "The slices",
        "The bull's-eye",
        "The hand",
        "The robot",
        "The debrief",
    ]
    assert seen == [StartPage, *4 * [WorkspacePage], DebriefPage]
    assert window.pages.currentWidget() is window.start_page
    assert not window.workspace.has_bullseye
    assert not tour.veil.isVisible()


@pytest.mark.long("journey")
def test_it_can_be_left_at_any_time_and_repeated(window, tour):
    tour.begin()
    QTest.keyClick(tour.veil, Qt.Key.Key_Right)
    QTest.keyClick(tour.veil, Qt.Key.Key_Right)
    QTest.keyClick(tour.veil, Qt.Key.Key_Left)
    assert tour.number == 1
    QTest.keyClick(tour.veil, Qt.Key.Key_Escape)
    assert tour.number is None
    assert window.pages.currentWidget() is window.start_page
    tour.begin()
    assert tour.number == 0
    tour.veil.leave.click()
    assert tour.number is None


@pytest.mark.long("journey")
def test_the_first_patient_comes_beside_it_and_it_stays_where_it_is(window, tour, settle):
    tour.begin()
    tour.move(1)
    assert window.conductor.patient is None
    window.patient_comes.set()
    assert settle(lambda: window.conductor.patient is not None)
    settle()
    assert tour.number == 1
    assert tour.veil.isVisible()
    assert window.pages.currentWidget() is window.workspace
    tour.move(-1)
    tour.end()
    assert window.pages.currentWidget() is window.start_page
    assert not window.conductor.controller.is_running


@pytest.mark.long("journey")
def test_who_leaves_early_is_not_taken_to_the_patient_later(window, tour, settle):
    tour.begin()
    QTest.keyClick(tour.veil, Qt.Key.Key_Escape)
    window.patient_comes.set()
    settle(lambda: False, 0.3)
    assert window.conductor.patient is None
    assert window.pages.currentWidget() is window.start_page


@pytest.mark.long("journey")
def test_a_patient_who_comes_meanwhile_ends_it(window, tour, patient):
    window.show_patient(patient)
    window.show_start()
    tour.begin()
    window.show_patient(patient)
    assert tour.number is None
    assert not tour.veil.isVisible()
    assert window.pages.currentWidget() is window.workspace
