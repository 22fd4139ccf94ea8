"""Changes gathered until the event loop comes round draw the same as changes drawn one by one."""

from dataclasses import replace

import numpy as np
import pytest

from app.core.errors import NumericalError
from app.imaging.window import WindowLevel
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.views.slices.items import MarkItem
from app.views.slices.needle_source import NeedlePlanes
from app.views.slices.pane import SlicePane
from app.views.slices.panes import MPR_PANES, NEEDLE_PANES, PaneId
from app.views.slices.pictures import Picture
from app.views.slices.presentation import Slab
from app.views.slices.presets import default_window
from app.views.slices.viewing import Viewing

SHOWN = (*MPR_PANES, *NEEDLE_PANES)


class Room:
    """All six panes of one viewing."""

    def __init__(self, volume, destroy):
        self.viewing = Viewing(default_window())
        self.planes = NeedlePlanes(self.viewing)
        self.panes = [SlicePane(self.viewing, pane) for pane in SHOWN]
        for pane in self.panes:
            destroy(pane)
            pane.resize(260, 220)
            pane.show()
        self.planes.set_watched(True)
        self.viewing.set_volume(volume)
        self.viewing.set_tolerances((6.0, 12.0))

    def flush(self):
        for pane in self.panes:
            pane.canvas.flush()

    def arrive(self, settle):
        self.flush()
        assert settle(lambda: all(not pane.canvas.feed.is_waiting for pane in self.panes))
        self.flush()


@pytest.fixture
def room(application, volume, destroy):
    rooms = []

    def make():
        rooms.append(Room(volume, destroy))
        return rooms[-1]

    yield make
    for one in rooms:
        one.viewing.pictures.close()


def random_needle(rng, middle):
    axis = rng.normal(size=3)
    tip = middle + rng.uniform(-12.0, 12.0, 3)
    return NeedleOverlay(tip - 80.0 * axis / np.linalg.norm(axis), tip, bool(rng.random() < 0.8))


def change(room, rng):
    """Do one of the things that a user or a needle does."""
    viewing, panes = room.viewing, room.panes
    middle = viewing.volume.lps_mm((np.array(viewing.volume.size) - 1) / 2)
    pane = panes[rng.integers(len(panes))]
    what = rng.integers(10)
    if what <= 2:
        viewing.set_needle(random_needle(rng, middle))
    elif what == 3:
        viewing.set_needle(None)
    elif what == 4:
        entry, target = middle + rng.uniform(-15.0, 15.0, (2, 3))
        viewing.set_draft(DraftPlan(tuple(entry), tuple(target)))
    elif what == 5:
        viewing.show_slice(pane.pane, float(rng.integers(0, 8)))
    elif what == 6:
        viewing.set_window(WindowLevel(float(rng.integers(100, 900)), 40.0))
    elif what == 7:
        presentation = viewing.presentation(pane.pane)
        thick = Slab("mean", float(rng.integers(0, 6)))
        viewing.set_presentation(
            pane.pane, replace(presentation, turn=presentation.turn.turned(1), slab=thick)
        )
    elif what == 8:
        viewing.set_follows_tip(bool(rng.random() < 0.5))
    else:
        pane.canvas.set_camera(pane.canvas.camera.zoomed(float(rng.uniform(0.7, 1.5)), 0.0, 0.0))


def item_state(item):
    """What is drawn; a label's side also depends on where it stood before and is left out."""
    shown = item.isVisible()
    if not shown:
        return type(item).__name__, False
    rect = None if isinstance(item, MarkItem) else item.boundingRect().getRect()
    at = (item.x(), item.y(), *(rect or ()))
    words = item._label if isinstance(item, MarkItem) else ""
    return type(item).__name__, True, tuple((np.round(at, 6) + 0.0).tolist()), words  # no -0.0


def state(pane):
    """Everything that a pane shows."""
    canvas, readouts = pane.canvas, pane.readouts
    if canvas.plane is None:
        assert not any(item.isVisible() and not item.boundingRect().isEmpty()
                       for item in canvas.drawing.shapes)  # fmt: skip
        return readouts.title.text(), readouts.slice.text()
    items = sorted(map(repr, map(item_state, canvas.drawing.shapes)))
    texts = [one.text() for one in (readouts.title, readouts.window, readouts.slice,
                                    *readouts.letters)]  # fmt: skip
    where = tuple(np.round(canvas._to_pixels.m11(), 9).reshape(1).tolist())
    picture = canvas.feed.picture  # none where no part of the volume is seen
    return items, texts, where, None if picture is None else picture.image.copy()


def alike(one, other):
    for a, b in zip(one, other, strict=True):
        assert a == b


@pytest.mark.long("journey")
@pytest.mark.parametrize("seed", range(8))
def test_gathered_changes_show_what_the_same_changes_one_by_one_show(room, settle, seed):
    gathered, single = room(), room()
    for one in (gathered, single):
        one.arrive(settle)
    rng_a, rng_b = (np.random.default_rng(seed) for _ in range(2))
    for _ in range(25):
        change(gathered, rng_a)
        change(single, rng_b)
        single.flush()
    for one in (gathered, single):
        one.arrive(settle)
    for a, b in zip(gathered.panes, single.panes, strict=True):
        alike(state(a), state(b))


def test_however_much_changes_each_layer_is_placed_once(room, settle, monkeypatch):
    one = room()
    one.arrive(settle)
    settle()
    pane, placed = one.panes[0], []
    place = pane.canvas.layers.place
    monkeypatch.setattr(
        pane.canvas.layers, "place", lambda *given: (placed.append(given[0]), place(*given))
    )
    one.viewing.set_follows_tip(True)
    rng = np.random.default_rng(1)
    for _ in range(6):
        one.viewing.set_needle(random_needle(rng, one.viewing.cursor_mm))
    assert not placed
    assert settle(lambda: pane.canvas.is_settled)
    assert len(placed) == 1


def test_what_lies_over_a_picture_that_is_still_to_come_comes_with_it(room, settle):
    one = room()
    one.viewing.set_needle(NeedleOverlay([0.0, -80.0, 0.0], [0.0, 0.0, 0.0]))
    one.arrive(settle)
    pane = one.panes[SHOWN.index(PaneId.IN_PLANE)]
    before = [item_state(item) for item in pane.canvas.drawing.shapes]
    one.viewing.set_needle(NeedleOverlay([9.0, -80.0, 0.0], [4.0, 5.0, 3.0]))
    pane.canvas._draw_together()  # the event loop has come round
    assert pane.canvas.feed.is_waiting
    assert [item_state(item) for item in pane.canvas.drawing.shapes] == before
    assert settle(lambda: pane.canvas.is_settled)
    assert [item_state(item) for item in pane.canvas.drawing.shapes] != before


def test_a_pane_that_nobody_sees_does_nothing_and_catches_up(room, settle, monkeypatch):
    one, other = room(), room()
    rng_a, rng_b = (np.random.default_rng(5) for _ in range(2))
    for pane in one.panes:
        pane.hide()
        monkeypatch.setattr(pane.canvas.layers, "place", lambda *_: pytest.fail("drawn unseen"))
    for _ in range(15):
        change(one, rng_a)
        change(other, rng_b)
        settle(timeout=0.005)
    monkeypatch.undo()
    for pane in one.panes:
        pane.show()
    for each in (one, other):
        each.arrive(settle)
    for a, b in zip(one.panes, other.panes, strict=True):
        alike(state(a), state(b))


def test_a_needle_that_is_no_number_is_refused_and_nothing_moves(room, settle):
    one = room()
    one.viewing.set_needle(NeedleOverlay([0.0, -80.0, 0.0], [0.0, 0.0, 0.0]))
    one.arrive(settle)
    before = [state(pane) for pane in one.panes]
    for bad in (np.nan, np.inf):
        with pytest.raises(NumericalError):
            one.viewing.set_needle(NeedleOverlay([0.0, -80.0, bad], [0.0, 0.0, 0.0]))
    one.flush()
    for pane, known in zip(one.panes, before, strict=True):
        alike(state(pane), known)


def test_a_needle_shown_again_never_brings_back_the_picture_of_the_last_one(room, settle):
    one = room()
    one.viewing.set_needle(NeedleOverlay([0.0, -80.0, 0.0], [0.0, 0.0, 0.0]))
    one.arrive(settle)
    pane = one.panes[SHOWN.index(PaneId.IN_PLANE)]
    assert pane.canvas.feed.picture is not None
    pane.hide()
    assert pane.canvas.feed.picture is None
    one.viewing.set_needle(None)
    pane.show()
    settle()
    assert pane.canvas.feed.picture is None


def test_a_picture_that_is_late_is_not_waited_for(room, settle, monkeypatch):
    one = room()
    one.viewing.set_needle(NeedleOverlay([0.0, -80.0, 0.0], [0.0, 0.0, 0.0]))
    one.arrive(settle)
    pane = one.panes[SHOWN.index(PaneId.IN_PLANE)]
    ticks = pane.canvas.layers.ticks.item
    monkeypatch.setattr(one.viewing.pictures, "take", lambda _: None)
    monkeypatch.setattr(one.viewing.pictures, "waits", lambda _: True)
    before = ticks._state
    one.viewing.set_needle(NeedleOverlay([30.0, -80.0, 9.0], [4.0, 5.0, 3.0]))
    assert settle(lambda: ticks._state != before)
    assert pane.canvas.feed.is_waiting
    one.viewing.set_needle(None)


def test_a_picture_that_was_overtaken_or_dropped_never_comes_back(room, settle):
    one = room()
    one.viewing.set_needle(NeedleOverlay([0.0, -80.0, 0.0], [0.0, 0.0, 0.0]))
    one.arrive(settle)
    feed, maker = one.panes[0].canvas.feed, one.viewing.pictures
    maker.close()
    old, shown = feed.wish, feed.picture
    one.viewing.show_slice(one.panes[0].pane, 3.0)
    one.panes[0].canvas.flush()
    newest = feed.picture
    assert newest is not shown
    for drop in (False, True):
        if drop:
            feed.drop()
        feed.is_waiting = True
        maker._made[id(feed)] = Picture.of(old)
        feed.take()
        assert feed.picture is (None if drop else newest)


def test_a_thread_that_gets_no_turn_holds_up_nothing_that_is_quickly_made(
    room, settle, monkeypatch
):
    one = room()
    one.arrive(settle)
    monkeypatch.setattr(one.viewing.pictures, "request", lambda *_: None)
    monkeypatch.setattr(one.viewing.pictures, "waits", lambda _: True)
    one.viewing.set_window(WindowLevel(1234.0, 40.0))
    canvas = one.panes[0].canvas
    assert settle(lambda: canvas.feed.picture.wish.window.width == 1234.0)
    assert settle(lambda: canvas.is_settled)


def test_a_needle_that_moves_is_followed_as_soon_as_every_pane_has_drawn_the_last(room, settle):
    one = room()
    one.viewing.set_follows_tip(True)
    one.arrive(settle)
    rng = np.random.default_rng(3)
    first, second, third = (random_needle(rng, one.viewing.cursor_mm) for _ in range(3))
    one.viewing.follow_needle(first)
    assert one.viewing.needle is first
    for pane in one.panes:
        pane.canvas._draw_together()  # the event loop has come round
    assert one.viewing.pictures.is_awaited
    shown = []
    one.viewing.needle_changed.connect(lambda: shown.append(one.viewing.needle))
    one.viewing.follow_needle(second)
    one.viewing.follow_needle(third)
    assert one.viewing.needle is first
    assert settle(lambda: one.viewing.needle is third)
    assert shown == [third]
    assert all(pane.canvas.layers.needle.shown in (first, third) for pane in one.panes)
    assert settle(lambda: all(pane.canvas.is_drawn for pane in one.panes))
    assert all(pane.canvas.layers.needle.shown is third for pane in one.panes)


def test_a_needle_taken_away_stays_away_whatever_was_to_be_followed(room, settle):
    one = room()
    one.viewing.set_follows_tip(True)
    one.arrive(settle)
    rng = np.random.default_rng(4)
    one.viewing.follow_needle(random_needle(rng, one.viewing.cursor_mm))
    for pane in one.panes:
        pane.canvas._draw_together()
    one.viewing.follow_needle(random_needle(rng, one.viewing.cursor_mm))
    one.viewing.set_needle(None)
    assert settle(lambda: all(pane.canvas.is_drawn for pane in one.panes))
    settle(timeout=0.2)
    assert one.viewing.needle is None


@pytest.mark.long("journey")
def test_what_moves_by_less_than_can_be_seen_is_not_painted_anew(room, settle):
    one = room()
    tip = one.viewing.cursor_mm + [1.0, 2.0, 3.0]
    one.viewing.set_needle(NeedleOverlay(tip - [0.0, 80.0, 0.0], tip))
    one.arrive(settle)
    settle(timeout=0.3)
    painted = []
    for pane in one.panes:
        pane.canvas.painted.connect(lambda pane=pane: painted.append(pane.pane))
    for step in (1e-4, 2e-4, 3e-4):
        one.viewing.set_needle(NeedleOverlay(tip + step - [0.0, 80.0, 0.0], tip + step))
        settle(timeout=0.15)
    assert not painted
    one.viewing.set_needle(NeedleOverlay(tip + 1.0 - [0.0, 80.0, 0.0], tip + 1.0))
    assert settle(lambda: len(set(painted)) == len(one.panes))
