"""Words under a moving needle: written at once, then only as often as they can be read."""

import numpy as np
import pytest
from PySide6.QtCore import QObject

from app.planning.needle_overlay import NeedleOverlay
from app.views.slices import pace
from app.views.slices.pace import Unhurried
from app.views.slices.pane import SlicePane
from app.views.slices.panes import PaneId
from app.views.slices.presets import default_window
from app.views.slices.viewing import Viewing


@pytest.fixture
def clock(monkeypatch):
    now = [10.0]
    monkeypatch.setattr(pace, "monotonic", lambda: now[0])
    return now


def test_the_first_time_is_at_once_and_the_last_one_is_never_left_out(application, clock, settle):
    parent, done = QObject(), []
    words = Unhurried(lambda: done.append(clock[0]), parent)
    words.ask()
    assert done == [10.0]
    words.ask()
    assert done == [10.0]
    assert words.is_waiting
    assert settle(lambda: len(done) == 2)
    assert not words.is_waiting


def test_asked_without_end_it_is_done_within_the_asks_and_no_more_often(application, clock):
    parent, done = QObject(), []
    words = Unhurried(lambda: done.append(clock[0]), parent)
    for _ in range(100):
        words.ask()
        clock[0] += 0.025
    assert len(done) == 25
    assert np.diff(done).min() >= 0.1


def test_read_outs_of_a_following_slice_rest_a_moment_and_are_right_in_the_end(
    application, volume, destroy, settle, clock
):
    viewing = Viewing(default_window())
    pane = SlicePane(viewing, PaneId.AXIAL)
    destroy(pane)
    pane.resize(260, 220)
    pane.show()
    viewing.set_volume(volume)
    viewing.set_follows_tip(True)
    pane.canvas.flush()
    middle = viewing.cursor_mm.copy()
    shown = []
    for step in range(3):
        tip = middle + [0.0, 0.0, 4.0 * step]
        viewing.set_needle(NeedleOverlay(tip - [0.0, 60.0, 0.0], tip))
        application.processEvents()
        shown.append(pane.readouts.slice.text())
    assert shown[1] == shown[2]
    assert settle(lambda: pane.canvas.is_settled)
    assert pane.readouts.slice.text() != shown[2]
    viewing.set_cursor(middle)  # by hand: with its picture
    assert settle(lambda: not pane.canvas.feed.is_waiting and pane.canvas.is_settled)
    assert pane.readouts.slice.text() == shown[0]
    viewing.pictures.close()
