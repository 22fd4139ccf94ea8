"""Measuring with the mouse: tools, handles, list, undo in order, and what is written."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from window_rig import plan

from app.planning.measurements import Angle, Distance, Probe, Region
from app.views.measure.editor import MeasureEditor, MeasureTool
from app.views.measure.feature import MeasureFeature
from app.views.reading.editors import UndoOrder
from app.views.slices.viewing import Tool


@pytest.fixture
def shown(window, patient):
    window.resize(1400, 900)
    window.show_patient(patient)
    window.workspace.viewing.set_cursor((5.0, 0.0, 140.0))
    return window


def pixel(pane, lps) -> QPointF:
    at = pane.canvas.plane.point(np.array(lps), pane.canvas.index)
    return pane.canvas.pixel_at(at.x, at.y)


def mouse(pane, kind, at, button=Qt.MouseButton.LeftButton):
    held = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseButtonRelease else button
    event = QMouseEvent(kind, at, pane.canvas.mapToGlobal(at), button, held,
                        Qt.KeyboardModifier.NoModifier)  # fmt: skip
    {
        QEvent.Type.MouseButtonPress: pane.canvas.mousePressEvent,
        QEvent.Type.MouseMove: pane.canvas.mouseMoveEvent,
        QEvent.Type.MouseButtonRelease: pane.canvas.mouseReleaseEvent,
    }[kind](event)


def drag(pane, *points):
    """Press at the first LPS point, move through the others, release at the last."""
    at = [pixel(pane, point) for point in points]
    mouse(pane, QEvent.Type.MouseButtonPress, at[0])
    for place in at[1:]:
        mouse(pane, QEvent.Type.MouseMove, place)
    mouse(pane, QEvent.Type.MouseButtonRelease, at[-1])


A, B, C = (0.0, -5.0, 140.0), (12.0, 4.0, 140.0), (12.0, -8.0, 140.0)


def test_a_drag_measures_a_distance_and_lays_the_tool_down(shown) -> None:
    pane, editor = shown.workspace.panes[0], shown.editors.measures
    editor.set_tool(MeasureTool.DISTANCE)
    drag(pane, A, (3.0, 0.0, 140.0), B)
    (item,) = editor.items
    assert isinstance(item, Distance)
    np.testing.assert_allclose(item.points, (A, B), atol=1e-6)
    assert editor.measured(item).text == "15.0 mm"
    assert editor.tool is MeasureTool.NONE
    assert shown.feature(MeasureFeature).panel.table.item(0, 1).text() == "15.0 mm"


@pytest.mark.long("journey")
def test_an_angle_is_two_drags_or_a_drag_and_a_click(shown) -> None:
    pane, editor = shown.workspace.panes[0], shown.editors.measures
    for second in ((C,), ((5.0, 5.0, 140.0), C)):
        editor.set_tool(MeasureTool.ANGLE)
        drag(pane, A, B)
        assert editor.draft is not None
        drag(pane, *second)
        item = editor.items[-1]
        assert isinstance(item, Angle)
        np.testing.assert_allclose(item.points, (A, B, C), atol=1e-6)
    expected = np.degrees(np.arctan2(12.0, 9.0))
    value = next(iter(editor.measured(editor.items[0]))).value
    assert value == pytest.approx(expected, abs=1e-6)


@pytest.mark.long("journey")
def test_a_click_probes_and_a_drag_makes_a_region(shown) -> None:
    pane, editor = shown.workspace.panes[0], shown.editors.measures
    editor.set_tool(MeasureTool.PROBE)
    drag(pane, A)
    assert isinstance(editor.items[0], Probe)
    assert editor.measured(editor.items[0]).text.endswith(" HU")
    editor.set_tool(MeasureTool.REGION)
    drag(pane, (-8.0, -10.0, 140.0), (-2.0, -4.0, 140.0))
    region = editor.items[1]
    assert isinstance(region, Region)
    np.testing.assert_allclose(region.centre_mm, (-5.0, -7.0, 140.0), atol=1e-6)
    text = editor.measured(region).text
    assert text.startswith("mean 40.0 HU  ± 0.0 HU")


@pytest.mark.long("journey")
def test_a_click_with_distance_or_region_measures_nothing(shown) -> None:
    pane, editor = shown.workspace.panes[0], shown.editors.measures
    for tool in (MeasureTool.DISTANCE, MeasureTool.REGION, MeasureTool.ANGLE):
        editor.set_tool(tool)
        drag(pane, A)
        assert editor.items == ()
        assert editor.draft is None


def test_a_handle_is_dragged_as_one_step_to_undo(shown) -> None:
    pane, editor = shown.workspace.panes[0], shown.editors.measures
    editor.add(Distance(A, B))
    drag(pane, B, (6.0, 0.0, 140.0), C)
    np.testing.assert_allclose(editor.items[0].points, (A, C), atol=1e-6)
    shown.undo.undo()
    np.testing.assert_allclose(editor.items[0].points, (A, B), atol=1e-6)


@pytest.mark.long("journey")
def test_a_measurement_is_drawn_in_its_slice_only(shown) -> None:
    editor, viewing = shown.editors.measures, shown.workspace.viewing
    pane = shown.workspace.panes[0]
    layer = next(one for one in pane.canvas.layers._added if hasattr(one, "drawn"))
    editor.add(Distance(A, B))
    pane.canvas.flush()
    assert [one.text for one in layer.drawn] == ["15.0 mm"]
    viewing.set_cursor((5.0, 0.0, 144.0))
    pane.canvas.flush()
    assert layer.drawn == ()
    viewing.set_cursor((5.0, 0.0, 140.0))
    editor.add(Distance(A, (0.0, -5.0, 160.0)))  # lies in no axial slice, but in a sagittal one
    editor.add(Distance(A, (6.0, 3.0, 160.0)))  # in none of the three
    pane.canvas.flush()
    assert [one.whole for one in layer.drawn] == [True, False]
    assert pane.grab().toImage().width() > 0


@pytest.mark.long("journey")
def test_undo_takes_back_the_last_step_whoever_made_it(shown) -> None:
    editor, planner = shown.editors.measures, shown.editor
    plan(shown)
    editor.add(Distance(A, B))
    planner.place(Tool.TARGET, (4.0, 4.0, 140.0), True)
    shown.undo.undo()
    assert planner.edit.draft.target_mm == (5.0, 5.0, 140.0)
    assert len(editor.items) == 1
    shown.undo.undo()
    assert editor.items == ()
    assert planner.edit.draft.complete
    shown.undo.redo()
    shown.undo.redo()
    assert len(editor.items) == 1
    assert planner.edit.draft.target_mm == (4.0, 4.0, 140.0)


@pytest.mark.long("journey")
def test_a_locked_plan_forbids_no_undo_of_a_measurement(shown) -> None:
    editor, planner = shown.editors.measures, shown.editor
    editor.add(Distance(A, B))
    plan(shown)
    planner.set_locked(True)
    shown.undo.undo()
    assert editor.items == ()
    assert planner.edit.draft.complete
    planner.set_locked(False)
    shown.undo.undo()
    assert not planner.edit.draft.complete


def test_a_new_step_forgets_what_the_same_editor_could_redo(application) -> None:
    editor = MeasureEditor()
    order = UndoOrder((editor,))
    editor.add(Distance(A, B))
    order.undo()
    assert order.can_redo
    editor.add(Distance(A, C))
    assert not order.can_redo
    order.undo()
    assert editor.items == ()


def test_esc_lays_the_tool_down_and_a_plan_tool_takes_its_place(shown) -> None:
    pane, editor = shown.workspace.panes[0], shown.editors.measures
    editor.set_tool(MeasureTool.ANGLE)
    drag(pane, A, B)
    QTest.keyClick(pane, Qt.Key.Key_Escape)
    assert editor.tool is MeasureTool.NONE
    assert editor.draft is None
    editor.set_tool(MeasureTool.REGION)
    shown.workspace.viewing.set_tool(Tool.ENTRY)
    assert editor.tool is MeasureTool.NONE
    editor.set_tool(MeasureTool.PROBE)
    assert shown.workspace.viewing.tool is Tool.NAVIGATE


@pytest.mark.long("journey")
def test_names_are_typed_in_the_list_and_rows_removed(shown) -> None:
    editor, panel = shown.editors.measures, shown.feature(MeasureFeature).panel
    editor.add(Distance(A, B))
    editor.add(Probe(A))
    panel.table.item(0, 0).setText("  lesion ")
    assert editor.items[0].name == "lesion"
    panel.table.setCurrentCell(1, 0)
    panel.remove.click()
    assert len(editor.items) == 1
    shown.workspace.viewing.set_cursor((0.0, 0.0, 120.0))
    panel.table.cellDoubleClicked.emit(0, 1)
    assert shown.workspace.viewing.cursor_mm[2] == pytest.approx(140.0)
    panel.clear.click()
    assert editor.items == ()
    assert not panel.export.isEnabled()


def test_another_ct_begins_an_empty_list(shown, patient) -> None:
    shown.editors.measures.add(Distance(A, B))
    shown.workspace.viewing.set_volume(patient.volume)
    assert shown.editors.measures.items == ()
    assert not shown.undo.can_undo


def test_the_list_is_written_as_table_or_markups_by_its_name(shown, tmp_path) -> None:
    shown.editors.measures.add(Distance(A, B))
    shown.feature(MeasureFeature).write(tmp_path / "m.csv")
    shown.feature(MeasureFeature).write(tmp_path / "m.mrk.json")
    assert "distance 1" in (tmp_path / "m.csv").read_text(encoding="utf-8")
    assert "Line" in (tmp_path / "m.mrk.json").read_text(encoding="utf-8")
    failures = []
    shown.feature(MeasureFeature).failed.connect(failures.append)
    shown.feature(MeasureFeature).write(tmp_path / "m.pdf")
    assert "csv" in str(failures[0])


def test_the_keys_of_the_tools_are_those_of_the_table(shown) -> None:
    menu = shown.feature(MeasureFeature).menu
    keys = {tool.value: action.shortcut().toString() for tool, action in menu.tools.items()}
    scheme = shown.workspace.viewing.scheme
    assert keys == {name: scheme.menu_keys[name] for name in keys}
    menu.tools[MeasureTool.REGION].trigger()
    assert shown.editors.measures.tool is MeasureTool.REGION
