"""The words of a slice pane: none covers another in a pane of any size."""

from itertools import combinations

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, QRectF
from PySide6.QtGui import QColor, QHelpEvent, QImage, QPainter
from PySide6.QtWidgets import QToolTip

from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.views.kit import theme
from app.views.slices.items import MarkItem
from app.views.slices.labels import PlacedLabel
from app.views.slices.pane import SlicePane
from app.views.slices.panes import PaneId, pane_name
from app.views.slices.presentation import Presentation, Slab, Turn
from app.views.slices.presets import default_window
from app.views.slices.viewing import Viewing
from app.views.slices.words import Worth

SIZES = [(w, h) for w in (76, 110, 140, 177, 205, 236, 270, 330, 520) for h in (76, 120, 190, 400)]


@pytest.fixture(params=[1.0, theme.LARGE], ids=["usual", "large"])
def text_size(application, request):
    theme.apply_theme(application, size=request.param)
    yield request.param
    theme.apply_theme(application)


@pytest.fixture
def viewing(application, volume):
    viewing = Viewing(default_window())
    viewing.set_volume(volume)
    yield viewing
    viewing.pictures.close()


@pytest.fixture
def pane(viewing, destroy):
    pane = SlicePane(viewing, PaneId.SAGITTAL)
    destroy(pane)
    pane.resize(600, 400)
    pane.show()
    return pane


def say_much(viewing, pane):
    """A path beside the slice, a needle that is not tracked, and all that a reader must know."""
    middle = viewing.cursor_mm
    viewing.set_draft(DraftPlan(tuple(middle - [4.0, 15.0, 0.0]), tuple(middle + [5.0, 5.0, 3.0])))
    viewing.set_needle(NeedleOverlay(middle - [6.0, 100.0, 0.0], middle - [6.0, 1.0, 0.0], False))
    viewing.set_presentation(pane.pane, Presentation(Slab("mip", 6.0), Turn(1, True)))
    viewing.greys.set_inverted(True)
    pane.readouts.set_note("of the last control scan")
    pane.readouts.show_cursor(middle)


def shown(pane):
    """Rectangles of all that is written over a pane, by what it says."""
    found = {one.text(): QRectF(one.geometry()) for one in pane.canvas.written if not one.is_empty}
    layers, plane = pane.canvas.layers, pane.canvas.plane
    for mark in (layers.plan.target, layers.plan.entry, layers.needle.tip):
        if mark.isVisible() and mark.label_rect is not None:
            at = pane.canvas.pixel_at(mark.x(), mark.y())
            found[f"mark {id(mark)}"] = mark.label_rect.translated(at)
    assert plane is not None
    return found


def covering(pane):
    return [
        (one, other)
        for (one, a), (other, b) in combinations(shown(pane).items(), 2)
        if a.intersects(b) and (not one.startswith("mark") or not other.startswith("mark"))
    ]


def test_no_word_covers_another_and_none_is_cut_in_a_pane_of_any_size(viewing, pane, text_size):
    say_much(viewing, pane)
    for width, height in SIZES:
        pane.resize(width, height)
        pane.canvas.flush()
        assert covering(pane) == [], (width, height)
        for words, place in shown(pane).items():
            assert QRectF(pane.canvas.rect()).contains(place), (width, height, words)
        assert pane_name(pane.pane) in pane.readouts.title.text()


def test_words_that_come_and_go_with_the_mouse_find_names_of_marks_out_of_their_way(viewing, pane):
    say_much(viewing, pane)
    pane.resize(300, 260)
    for x in np.linspace(-1e3, 1e3, 9):  # the longer the number, the wider the words
        pane.readouts.show_cursor(viewing.cursor_mm + [x, 0.0, 0.0])
        pane.canvas.flush()
        assert covering(pane) == []
    pane.readouts.clear_cursor()
    pane.canvas.flush()
    assert covering(pane) == []


def test_a_narrow_pane_says_the_place_of_its_slice_and_leaves_its_number_to_the_tooltip(pane):
    for width, counted in ((600, True), (300, False), (600, True)):
        pane.resize(width, 400)
        pane.canvas.flush()
        assert ("Slice" in pane.readouts.slice.text()) is counted
        assert " mm" in pane.readouts.slice.text()
        assert "Slice" in pane.readouts.whole_text()


def test_the_name_of_a_mark_stands_on_a_dark_plate_on_the_brightest_tissue(application):
    mark, picture = MarkItem(theme.TARGET, 1.0), QImage(200, 100, QImage.Format.Format_RGB32)
    picture.fill(QColor("white"))
    mark.place(20.0, 50.0, lambda: "Target", near=True)
    wanted = mark.wanted(QPointF(20.0, 50.0))
    place = (60.0, 40.0, wanted.width, wanted.height)
    mark.place_label(QPointF(20.0, 50.0), PlacedLabel(place, 0))
    with QPainter(picture) as painter:
        mark.paint(painter)
    above = [picture.pixelColor(x, 41) for x in range(60, 60 + round(wanted.width))]  # no letter
    # 60 % black over white leaves 102 of 255
    assert max(colour.lightness() for colour in above) <= 104


def test_the_least_important_line_goes_first_and_comes_back_where_there_is_room(viewing, pane):
    def worths():
        words = pane.readouts
        corners = (words.title, words.window, words.cursor, words.slice, *words.letters)
        return {line[1] for one in corners for line in one.lines if line not in one.left_out}

    pane.resize(600, 400)
    pane.canvas.flush()
    everything = worths()
    assert Worth.ZOOM in everything
    assert pane.readouts.ruler.isVisible()
    before, went = everything, []
    for width in range(600, 74, -6):
        pane.resize(width, 400)
        pane.canvas.flush()
        went += sorted(before - worths())
        before = worths()
    assert went.index(Worth.ZOOM) < went.index(Worth.WINDOW)
    assert went.index(Worth.NAME) < went.index(Worth.WINDOW)
    assert {Worth.TITLE, Worth.LETTER, Worth.POSITION} <= before
    pane.resize(600, 400)
    pane.canvas.flush()
    assert worths() == everything


def test_where_words_are_cut_the_tooltip_says_all_of_them(viewing, pane):
    def rest(at):
        event = QHelpEvent(QHelpEvent.Type.ToolTip, at, pane.canvas.mapToGlobal(at))
        return QToolTip.text() if pane.eventFilter(pane.canvas, event) else ""

    on_title = QPoint(12, 12)
    pane.canvas.flush()
    assert rest(on_title) == ""
    pane.resize(120, 160)
    pane.canvas.flush()
    assert "Zoom" not in pane.readouts.window.text()
    words = rest(on_title)
    for part in ("Sagittal", "W 400", "Zoom", "slices", "Slice"):
        assert part in words
    assert rest(pane.canvas.rect().center()) == ""  # over the picture nothing comes in the way
    QToolTip.hideText()


def test_words_of_another_size_are_whole_even_if_they_were_painted_before_they_were_placed(
    viewing, pane, monkeypatch
):
    title = pane.readouts.title
    pane.canvas.flush()
    pane.grab()
    monkeypatch.setattr(theme, "SMALL_PX", 22)
    pane.grab()
    title.place()
    pane.grab()
    assert title._picture.deviceIndependentSize().toSize() == title.geometry().size()
