"""Coordinates for people, and the grid of panes."""

import pytest
from PySide6.QtWidgets import QWidget

from app.views.coordinates import lps_words
from app.views.grid import FIVE, FOUR, ViewGrid


def test_letters_name_the_side_and_there_is_no_sign():
    assert lps_words((70.94, 109.4, -3.0)) == "L 70.9   P 109.4   I 3.0 mm"
    assert lps_words((-70.94, -109.4, 180.06)) == "R 70.9   A 109.4   S 180.1 mm"
    assert lps_words((0.0, -0.0, -0.01)) == "L 0.0   P 0.0   S 0.0 mm"


@pytest.mark.parametrize("cells", [FOUR, FIVE])
@pytest.mark.parametrize("number", range(4))
def test_a_maximised_pane_has_the_whole_room(application, destroy, cells, number):
    panes = [QWidget() for _ in range(5)]
    grid = ViewGrid(panes)
    destroy(grid)
    grid.resize(900, 700)
    grid.arrange(cells)
    grid.show()
    before = [pane.geometry() for pane in panes[: len(cells)]]
    grid.toggle(panes[number])
    application.processEvents()
    assert panes[number].size() == grid.size()
    grid.toggle(panes[number])
    application.processEvents()
    assert [pane.geometry() for pane in panes[: len(cells)]] == before
