"""Finding an exercise on the start page."""

import pytest

pytest.importorskip("PySide6")

from types import SimpleNamespace

from app.views.shell.start_page import StartPage

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
