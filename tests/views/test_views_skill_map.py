"""The map of skills on the start page: places, rings, what comes next, keys and search."""

import pytest

pytest.importorskip("PySide6")

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible, QImage
from PySide6.QtTest import QTest

from app.exercises.library import library
from app.exercises.portrait import kept_portrait
from app.exercises.practised_skill import PractisedSkill, practised_skill
from app.session.board import Standing
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.roles import Role
from app.views.shell import skill_place
from app.views.shell.skill_place import Advance, fitting
from app.views.shell.skill_portrait import face
from app.views.shell.start_facts import asker
from app.views.shell.start_page import StartPage

EXERCISES = tuple(library())
LESSONS = [one for one in EXERCISES if practised_skill(one) is not PractisedSkill.MACHINE]


@pytest.fixture
def page(application, settle):
    """Start page with the shipped exercises, at the smallest size that is kept."""
    page = StartPage()
    page.set_exercises(EXERCISES)
    chosen = []
    page.exercise_chosen.connect(chosen.append)
    page.resize(1366, 720)
    page.show()
    page.activateWindow()
    settle(page.isActiveWindow)
    yield page, chosen
    page.deleteLater()


def shown(page):
    """Identifiers of the exercises that are not hidden."""
    return {name for name, place in page.map.places.items() if not place.isHidden()}


def heard(place):
    """What a screen reader calls a place."""
    return QAccessible.queryAccessibleInterface(place).text(QAccessible.Text.Name)


def test_each_skill_is_a_line_from_left_to_right_in_the_order_of_its_levels(page):
    places = page[0].map.places
    assert set(places) == {one.id for one in EXERCISES}
    for skill in PractisedSkill:
        if skill is PractisedSkill.MACHINE:
            continue
        line = [places[one.id] for one in EXERCISES if practised_skill(one) is skill]
        assert len({place.y() for place in line}) == 1, skill
        assert [place.x() for place in line] == sorted(place.x() for place in line)
        levels = [place.exercise.level for place in line]
        assert levels == sorted(levels)


def test_research_machines_stand_on_a_shelf_of_their_own_at_the_end(page):
    places = page[0].map.places
    shelf = [places["tensegrity-liver"], places["laparoscopic-tool"]]
    end = max(places[one.id].geometry().right() for one in LESSONS)
    assert all(place.x() > end for place in shelf)


def test_no_name_of_a_skill_is_cut_on_a_laptop(page):
    """Seen: "Research m…" over the shelf."""
    headings = {group.skill: group.heading for group in page[0].map._groups if group.places}
    assert PractisedSkill.MACHINE in headings
    for heading in headings.values():
        assert "…" not in heading.text()
    shelf = headings[PractisedSkill.MACHINE]
    assert shelf.text() == "Research"
    assert shelf.toolTip() == "Research machines"


def test_all_of_it_is_seen_at_once_and_no_place_lies_on_another(page):
    start, _ = page
    boxes = [place.geometry() for place in start.map.places.values()]
    room = start.map.viewport().rect()
    assert all(room.contains(box) for box in boxes)
    assert not any(a.intersects(b) for n, a in enumerate(boxes) for b in boxes[:n])


def test_a_narrow_page_and_a_long_list_scroll_downwards_only(page, settle):
    start, _ = page
    more = [one.model_copy(update={"id": f"own-{n}"}) for n in range(9) for one in LESSONS[:1]]
    start.set_exercises((*EXERCISES, *more))
    start.resize(900, 600)
    settle(timeout=0.1)
    places = start.map.places.values()
    right = start.map.viewport().width()
    assert all(place.geometry().right() <= right for place in places)
    assert start.map.verticalScrollBar().maximum() > 0
    boxes = [place.geometry() for place in places]
    assert not any(a.intersects(b) for n, a in enumerate(boxes) for b in boxes[:n])


def test_the_place_marked_next_is_the_one_that_continue_names_and_begins(page):
    start, chosen = page
    stood = {"first-insertion": Standing(4, 92.0, True, 2, 1)}
    start.set_standings(stood, "thick-tissue", "")
    marked = [name for name, place in start.map.places.items() if place.is_next]
    assert marked == ["thick-tissue"]
    assert (start.begin.verb.text(), start.begin.name.text()) == ("Continue", "Thick tissue")
    start.map.places["kidney"].setFocus()
    start.begin.click()
    QTest.keyClick(start, Qt.Key.Key_F5)
    assert chosen == ["thick-tissue", "thick-tissue"]


def test_enter_continues_before_anything_is_clicked(page):
    start, chosen = page
    assert start.begin.hasFocus()
    QTest.keyClick(start.begin, Qt.Key.Key_Return)
    assert chosen == ["first-insertion"]


def test_a_click_on_a_place_begins_it(page):
    start, chosen = page
    QTest.mouseClick(start.map.places["kidney"], Qt.MouseButton.LeftButton)
    assert chosen == ["kidney"]


def test_nothing_that_may_be_begun_leaves_nothing_to_continue(page):
    start, chosen = page
    start.set_standings({}, "", "")
    assert not start.begin.isEnabled()
    start._begin()
    assert chosen == []


# --- keys -------------------------------------------------------------------------------------
def test_tab_comes_to_one_place_and_arrows_to_every_other(page):
    start, chosen = page
    places = start.map.places
    by_tab = [one for one in places.values() if one.focusPolicy() & Qt.FocusPolicy.TabFocus]
    assert by_tab == [start.map.current] == [places["first-insertion"]]
    by_tab[0].setFocus()
    reached = {by_tab[0]}
    for _ in range(len(places)):
        QTest.keyClick(start.map.current, Qt.Key.Key_Right)
        reached.add(start.map.current)
        assert start.map.current.hasFocus()
    assert reached == set(places.values())
    while start.map.current is not places["first-insertion"]:
        before = start.map.current
        QTest.keyClick(before, Qt.Key.Key_Left)
        assert start.map.current is not before
    QTest.keyClick(start.map.current, Qt.Key.Key_Down)
    assert start.map.current is places["breathing-liver"]
    QTest.keyClick(start.map.current, Qt.Key.Key_Up)
    assert start.map.current is places["first-insertion"]
    QTest.keyClick(start.map.current, Qt.Key.Key_Down)
    QTest.keyClick(start.map.current, Qt.Key.Key_Return)
    assert chosen == ["breathing-liver"]


def test_what_is_next_has_tab_unless_somebody_stands_elsewhere(page):
    start, _ = page
    start.set_standings({}, "thick-tissue", "")
    assert start.map.current is start.map.places["thick-tissue"]
    start.map.current.setFocus()
    QTest.keyClick(start.map.current, Qt.Key.Key_Right)
    here = start.map.current
    start.set_standings({}, "first-insertion", "")
    assert start.map.current is here


# --- rings ------------------------------------------------------------------------------------
def test_ring_badge_and_words_say_how_far_one_has_come():
    fresh = Advance()
    tried = Advance.of(Standing(2, 41.4, False, 0, 0), True)
    once = Advance.of(Standing(3, 100.0, True, 1, 0), True)
    over = Advance.of(Standing(4, 72.0, True, 2, 1), True)
    group = Advance.of(Standing(30, 95.0, True, 2, 7), False)
    assert [one.badge for one in (fresh, tried, once, over, group)] == ["", "", "1/2", "✔", "✔ 7"]
    assert (fresh.share, tried.share, over.share) == (0.0, pytest.approx(0.414), 1.0)
    assert once.share < 1.0, "only what is mastered closes the ring"
    assert group.share < 1.0
    assert fresh.whole() == "not begun"
    assert tried.whole() == "done 2, best 41 of 100"
    assert once.whole().endswith("passed once: one more pass in a row masters it")
    assert over.whole().endswith("mastered: passed twice in a row")
    assert (over.short(), once.short()) == ("mastered", "best 100")
    assert group.short() == "mastered by 7"


def test_a_screen_reader_hears_title_level_and_how_far_one_has_come(page):
    start, _ = page
    places = start.map.places
    start.set_standings({"kidney": Standing(3, 81.6, True, 1, 0)}, "thick-tissue", "Whose")
    assert heard(places["kidney"]) == (
        "Kidney from behind, level 3 of 9, done 3, best 82 of 100, passed once: one more "
        "pass in a row masters it"
    )
    assert heard(places["thick-tissue"]) == "Thick tissue, next, level 2 of 9, not begun"
    assert heard(start.begin) == "Continue: Thick tissue"
    assert "passed once" in places["kidney"].toolTip()
    assert start.whose.text() == "Whose"
    start.set_exercises(EXERCISES)  # one was added, or changed
    assert "best 82 of 100" in heard(places := start.map.places["kidney"]), places


def test_rings_differ_without_colour(page):
    start, _ = page
    place, seen = start.map.places["kidney"], []
    steps = (None, Standing(1, 60.0, True, 1, 0), Standing(2, 60.0, True, 2, 1))
    for standing in (*steps, Standing(2, 60.0, False, 0, 0)):
        start.set_standings({} if standing is None else {"kidney": standing}, "", "")
        grey = place.grab().toImage().convertToFormat(QImage.Format.Format_Grayscale8)
        seen.append(bytes(grey.constBits()))
    assert len(set(seen)) == len(seen)


def test_a_course_numbers_its_places_and_stands_first_in_each_skill(page):
    start, _ = page
    start.set_standings({}, "kidney", "", True, ("hold-the-breath", "kidney"))
    places = start.map.places
    assert places["hold-the-breath"].words.text() == "No. 1 of the course"
    assert places["hold-the-breath"].x() < places["kidney"].x() < places["breathing-liver"].x()


# --- faces ------------------------------------------------------------------------------------
def test_every_shipped_exercise_has_a_face_that_ships_and_no_two_are_alike(application):
    found = {}
    for exercise in EXERCISES:
        portrait = kept_portrait(exercise)
        assert portrait is not None, exercise.id
        image = face(exercise, portrait, 96, 1.0).toImage()
        found[exercise.id] = np.frombuffer(image.constBits(), np.uint8).astype(int)
    names = list(found)
    for n, name in enumerate(names):
        for other in names[:n]:
            changed = (np.abs(found[name] - found[other]) > 40).mean()
            assert changed > 0.01, (name, other)


def test_a_face_is_made_when_its_place_is_painted_and_once(page, monkeypatch, settle):
    start, _ = page
    made = []
    real = skill_place.face
    monkeypatch.setattr(skill_place, "face", lambda *given: made.append(given) or real(*given))
    start.hide()
    for exercise in EXERCISES:
        start.set_portrait(exercise.id, kept_portrait(exercise))
    settle(timeout=0.1)
    assert made == []
    start.show()
    settle(lambda: len(made) == len(EXERCISES))
    start.map.viewport().repaint()
    start.grab()
    assert len(made) == len(EXERCISES)


# --- search -----------------------------------------------------------------------------------
def test_words_in_title_or_description_find_an_exercise_and_enter_begins_it(page):
    start, chosen = page
    start.search.setText("RIBS nodule")
    assert shown(start) == {"lung-between-ribs"}
    QTest.keyClick(start.search, Qt.Key.Key_Return)
    assert chosen == ["lung-between-ribs"]


def test_words_that_nothing_holds_leave_a_hint_and_nothing_to_begin(page):
    start, chosen = page
    start.search.setText("spleen")
    assert shown(start) == set()
    assert not start.hint.isHidden()
    assert "clear the search" in start.hint.text()
    QTest.keyClick(start.search, Qt.Key.Key_Return)
    assert chosen == []
    start.search.clear()
    assert len(shown(start)) == len(EXERCISES)
    assert start.hint.isHidden()
    QTest.keyClick(start.search, Qt.Key.Key_Return)
    assert chosen == [], "Enter in an empty search begins nothing"


def test_no_exercises_at_all_are_said(page):
    start, _ = page
    start.set_exercises(())
    assert not start.hint.isHidden()
    assert not start.begin.isEnabled()


# --- words ------------------------------------------------------------------------------------
def test_titles_take_two_lines_at_most_and_have_a_tip_where_they_are_longer(page):
    start, _ = page
    long = EXERCISES[0].model_copy(update={"id": "long", "title": "Needle insertion " * 6})
    start.set_exercises((*EXERCISES, long))
    place = start.map.places["long"]
    assert place.title.text().endswith(" …")
    assert place.title.toolTip().startswith("Needle insertion")


def test_a_text_that_is_too_long_ends_with_dots_after_a_whole_word(page):
    metrics = page[0].fontMetrics()
    text = "align the needle with the planned path and insert it to the lesion " * 4
    taken = fitting(text, metrics, 300, 2)
    assert taken.endswith(" …")
    assert text.startswith(taken.removesuffix(" …"))
    assert fitting("short", metrics, 300, 2) == "short"


def test_a_larger_text_gives_the_big_button_more_room(page, application, settle):
    start, _ = page
    before = start.begin.height()
    try:
        theme.apply_theme(application, size=1.3)
        assert settle(lambda: start.begin.height() > 1.2 * before)
    finally:
        theme.apply_theme(application)


# --- whose ------------------------------------------------------------------------------------
def test_a_student_sees_what_was_done_under_his_name_and_staff_what_everybody_did():
    ACCESS.take_role(Role.STUDENT)
    try:
        own, nobody = asker("Kestrel"), asker("")
        assert own.of_one
        assert (own.may_count("Kestrel"), own.may_count("anonymous")) == (True, False)
        assert (nobody.may_count("anonymous"), nobody.may_count("Kestrel")) == (True, False)
        ACCESS.take_role(Role.INSTRUCTOR)
        assert not asker("Kestrel").of_one
        assert asker("").may_count("anybody")
    finally:
        ACCESS.take_role(Role.TECHNICIAN)
