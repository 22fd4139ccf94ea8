"""The picture of a study: its words stand apart."""

from itertools import combinations

import pytest

from app.studies import plot

pytest.importorskip("matplotlib")


def test_words_at_points_that_lie_close_together_neither_cover_each_other_nor_a_point():
    figure = plot._empty((8.0, 6.0))
    axes = figure.add_axes((0.11, 0.24, 0.84, 0.68))
    axes.set_xscale("log")
    axes.set_yscale("log")
    notes = []
    for number in range(5):
        x, y = 1.0 + 0.05 * number, 1e-7 * (1.0 + 0.02 * number)
        axes.plot([x, 3.0 * x], [y, y], marker="o", markersize=6)
        notes.append(plot._note(axes, f"family {number}", (x, y), 7, "#222222", 9))
        notes += [plot._note(axes, f"way {number}", (3.0 * x, y), -11, "#222222", 6)]
    line = axes.axhline(2e-7)
    limit = axes.annotate("limit", (1.0, 2e-7))
    plot._set_apart(figure, axes, notes, [limit])
    renderer = figure.canvas.get_renderer()
    shown = [note for note in notes if note.get_visible()]
    places = [note.get_window_extent(renderer) for note in shown]
    assert not any(one.overlaps(other) for one, other in combinations(places, 2))
    names = [note.get_text() for note in shown]
    assert [name for name in names if name.startswith("family")] == [
        f"family {number}" for number in range(5)
    ]
    assert line.get_visible()
