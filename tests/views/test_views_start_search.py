"""Finding an exercise on the start page."""

import pytest

pytest.importorskip("PySide6")

from types import SimpleNamespace

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QFont, QFontMetrics
from PySide6.QtTest import QTest

from app.exercises.portrait import Portrait
from app.session.board import Standing
from app.views.kit import theme
from app.views.shell.start_page import COLUMNS, StartPage, _fitting, standing_words

EXERCISES = tuple(
    SimpleNamespace(id=name.lower(), title=name, description=what, level=level)
    for name, what, level in (
        ("Liver", "a lesion below the ribs", 1),
        ("Lung", "a nodule between ribs", 3),
        ("Bone", "an iliac crest", 2),
    )
)


@pytest.fixture
def page(application):
    """Start page with three exercises."""
    page = StartPage()
    page.set_exercises(EXERCISES)
    chosen = []
    page.exercise_chosen.connect(chosen.append)
    yield page, chosen
    page.deleteLater()


def shown(page):
    """Identifiers of the exercises that are not hidden."""
    items = [page.exercises.item(row) for row in range(page.exercises.count())]
    return [item.data(256) for item in items if not item.isHidden()]


def test_words_in_title_or_description_find_an_exercise_and_begin_takes_it(page):
    start, chosen = page
    start.search.setText("RIBS nodule")
    assert shown(start) == ["lung"]
    start.begin.click()
    assert chosen == ["lung"]


def test_words_that_nothing_holds_leave_a_hint_and_nothing_to_begin(page):
    start, chosen = page
    start.search.setText("spleen")
    assert shown(start) == []
    assert not start.hint.isHidden()
    assert "clear the search" in start.hint.text()
    assert not start.begin.isEnabled()
    start.search.returnPressed.emit()
    assert chosen == []
    start.search.clear()
    assert len(shown(start)) == 3
    assert start.hint.isHidden()
    assert start.begin.isEnabled()


def test_no_exercises_at_all_are_said(page):
    start, _ = page
    start.set_exercises(())
    assert not start.hint.isHidden()
    assert not start.begin.isEnabled()


def test_arrows_choose_an_exercise_before_anything_is_clicked(page):
    start, _ = page
    reached, widget = [], start
    while (widget := widget.nextInFocusChain()) is not start:
        reached.append(widget)
    assert reached.index(start.exercises) < reached.index(start.search)


def accessible(page, name):
    """What is heard of a row."""
    (item,) = (item for item in page._items() if item.data(256) == name)
    return item.data(Qt.ItemDataRole.AccessibleTextRole)


def test_a_row_tells_how_often_it_was_done_how_well_and_what_comes_next(page):
    start, _ = page
    start.set_standings({"liver": Standing(3, 81.6, True)}, "bone", "Done and best: p01.")
    assert accessible(start, "liver") == "Liver, level 1 of 9, done ✔ 3, best 82"
    assert accessible(start, "bone").endswith("next")
    assert accessible(start, "lung") == "Lung, level 3 of 9"
    assert start.whose.text() == "Done and best: p01."
    assert standing_words(None) == ("–", "–")
    start.set_exercises(EXERCISES)  # one was added, or changed
    assert accessible(start, "liver") == "Liver, level 1 of 9, done ✔ 3, best 82"


def test_rows_are_drawn_with_patient_words_and_columns_in_every_state(page, application):
    start, _ = page
    grey = np.arange(64, dtype=np.uint8).reshape(8, 8)
    slices = dict.fromkeys(("axial", "coronal", "sagittal"), grey)
    entry, low, high = (2.0, 2.0, 2.0), (0.0,) * 3, (8.0,) * 3
    before = start.grab().toImage()
    start.set_portrait("liver", Portrait(slices, low, high, (4.0,) * 3, entry))
    start.set_standings({"liver": Standing(3, 81.6, True)}, "bone", "")
    assert start.grab().toImage() != before


def test_a_description_that_is_too_long_ends_with_dots_after_a_whole_word(page):
    start, _ = page
    metrics = start.fontMetrics()
    text = "align the needle with the planned path and insert it to the lesion " * 4
    kept = _fitting(text, metrics, 300, 2)
    assert kept.endswith(" …")
    assert text.startswith(kept.removesuffix(" …"))
    assert _fitting("short", metrics, 300, 2) == "short"


def test_f5_begins_the_exercise_that_is_chosen(page, settle):
    start, chosen = page
    start.show()
    start.activateWindow()
    settle(start.isActiveWindow)
    QTest.keyClick(start, Qt.Key.Key_F5)
    assert chosen == ["liver"]


def test_the_hardest_level_has_room_for_all_of_its_discs(page):
    font = QFont(page[0].font())
    font.setPixelSize(theme.FONT_PX)
    assert QFontMetrics(font).horizontalAdvance("●" * 9) <= dict(COLUMNS)["level"]
