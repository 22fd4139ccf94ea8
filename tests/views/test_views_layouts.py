"""Layouts: every pane has its place, none overlaps, and the window shows them."""

import pytest
from PySide6.QtWidgets import QWidget

from app.views.reading.layouts import (
    BULLSEYE,
    COLUMNS,
    FOUR,
    LAYOUTS,
    SCENE,
    ViewGrid,
    chosen,
    layout_title,
    possible,
)

ALL = sorted({pane for both in LAYOUTS.values() for layout in both for pane in layout.panes})
EVERY = [layout for both in LAYOUTS.values() for layout in both]


def fields(layout):
    return [
        (row + y, column + x)
        for _, (row, column, height, width) in layout.cells
        for y in range(height)
        for x in range(width)
    ]


@pytest.mark.parametrize("layout", [*EVERY, *(one.mirrored() for one in EVERY)], ids=str)
def test_the_cells_of_a_layout_fill_it_and_do_not_overlap(layout):
    taken = fields(layout)
    assert len(taken) == len(set(taken)) == layout.rows * COLUMNS


def test_every_layout_has_a_variant_with_the_bullseye_and_a_title():
    for name, (plain, guided) in LAYOUTS.items():
        assert BULLSEYE not in plain.panes
        assert BULLSEYE in guided.panes
        assert layout_title(name) != name


def test_mirroring_twice_changes_nothing():
    assert all(layout.mirrored().mirrored() == layout for layout in EVERY)


def test_a_layout_whose_panes_are_missing_is_not_offered():
    few = [*FOUR.panes, BULLSEYE]
    assert possible(few) == ("2x2", "1+3")
    assert chosen("6-up", False, False, few) is FOUR


@pytest.mark.parametrize("layout", EVERY, ids=str)
def test_a_maximised_pane_has_the_whole_room_and_gives_it_back(application, destroy, layout):
    panes = {name: QWidget() for name in ALL}
    grid = ViewGrid(panes)
    destroy(grid)
    grid.resize(900, 700)
    grid.arrange(layout)
    grid.show()
    application.processEvents()
    before = {name: panes[name].geometry() for name in layout.panes}
    for name in layout.panes:
        grid.toggle(panes[name])
        application.processEvents()
        assert panes[name].size() == grid.size()
        grid.toggle(panes[name])
        application.processEvents()
    assert {name: panes[name].geometry() for name in layout.panes} == before
    assert all(panes[name].isHidden() for name in ALL if name not in layout.panes)


@pytest.mark.long("journey")
def test_the_menu_and_the_keys_choose_layouts(window, patient):
    window.show_patient(patient)
    workspace, actions = window.workspace, window.view_menu.layouts
    actions["1+3"].trigger()
    assert workspace.grid.shown is LAYOUTS["1+3"][0]
    assert actions["1+3"].isChecked()
    window.view_menu.bullseye.trigger()
    assert workspace.grid.shown is LAYOUTS["1+3"][1]
    window.view_menu.bullseye.trigger()
    assert SCENE in workspace.grid.shown.panes
    assert actions["2x2"].shortcut().toString() == "Ctrl+1"


@pytest.mark.long("journey")
def test_a_left_handed_desk_has_the_panel_on_the_right(window, patient, settle):
    window.show_patient(patient)
    window.resize(1366, 768)
    workspace = window.workspace
    workspace.set_left_handed(True)
    settle(timeout=0.1)
    assert workspace.side.x() > workspace.grid.mapTo(workspace, workspace.grid.rect().center()).x()
    first, second = (workspace.grid.pane(name) for name in FOUR.panes[:2])
    assert first.x() > second.x()
    workspace.set_left_handed(False)
    settle(timeout=0.1)
    assert workspace.side.x() == 0


def test_double_clicking_a_pane_maximises_it_and_again_restores(window, patient):
    window.show_patient(patient)
    pane = window.workspace.panes[1]
    pane.canvas.double_clicked.emit()
    assert window.workspace.grid.maximised is pane
    pane.canvas.double_clicked.emit()
    assert window.workspace.grid.maximised is None


def test_a_plane_through_two_points_gets_a_pane_where_none_is_seen(window, volume, settle):
    workspace = window.workspace
    window.show_workspace()
    workspace.viewing.set_volume(volume)
    settle()
    middle = workspace.viewing.cursor_mm
    workspace.needle_planes.show_points(middle, middle + [9.0, 9.0, 0.0], (0.0, 0.0, 1.0))
    assert any(pane.isVisible() for pane in workspace.needle_panes)
