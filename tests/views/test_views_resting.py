"""Layers that are too slow for a live needle: gone while the plane moves, back at rest."""

import pytest
from PySide6.QtCore import QObject

from app.views.slices.pace import REST_MS, RestingLayer

FIRST, SECOND = object(), object()
"""Two planes."""


class Recorder:
    def __init__(self):
        self.shown, self.count = None, 0

    def place(self, plane, index, scale):
        self.shown, self.count = (plane, index, scale), self.count + 1

    def hide(self):
        self.shown = None


@pytest.fixture
def resting(application):
    parent, layer = QObject(), Recorder()
    yield RestingLayer(layer, parent), layer
    parent.deleteLater()


def test_a_plane_that_moves_shows_nothing_and_one_that_rests_everything(resting, settle):
    slow, layer = resting
    for plane in (FIRST, SECOND, FIRST, SECOND):
        slow.place(plane, 0.0, 1.0)
        assert layer.shown is None
    assert layer.count == 0
    assert settle(lambda: layer.shown == (SECOND, 0.0, 1.0))
    assert layer.count == 1


def test_a_zoom_at_rest_is_followed_at_once_and_a_scroll_is_not(resting, settle):
    slow, layer = resting
    slow.place(FIRST, 0.0, 1.0)
    slow.place(FIRST, 0.0, 2.0)
    assert settle(lambda: layer.shown == (FIRST, 0.0, 2.0))
    slow.place(FIRST, 0.0, 3.0)
    assert layer.shown == (FIRST, 0.0, 3.0)
    slow.place(FIRST, 1.0, 3.0)
    assert layer.shown is None


def test_a_pane_that_lost_its_plane_stays_empty(resting, settle):
    slow, layer = resting
    slow.place(FIRST, 0.0, 1.0)
    slow.hide()
    settle(timeout=2e-3 * REST_MS)
    assert layer.shown is None
    assert layer.count == 0
    slow.place(FIRST, 0.0, 1.0)  # the same plane again: it has to rest anew
    assert layer.shown is None
    assert settle(lambda: layer.shown is not None)
