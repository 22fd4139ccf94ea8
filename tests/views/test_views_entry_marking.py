"""The entry is marked by table position and grid line; what the panes show of grid and laser."""

import numpy as np
import pytest
from window_rig import plan

from app.exercises.procedure import GridPart, ProcedurePart
from app.imaging.skin_grid import GridPlace
from app.planning.entry_mark import needle_angles
from app.views.exercise.feature import ExerciseFeature
from app.views.slices.slab import as_point
from app.views.slices.viewing import Tool


@pytest.fixture
def gridded(window, patient, settle):
    """A window with an exercise that asks for a grid, and a plan."""
    exercise = next(iter(window.feature(ExerciseFeature).exercises.values()))
    procedure = ProcedurePart(grid=GridPart(lines=5, length_mm=60.0))
    window.conductor.set_exercise(exercise.model_copy(update={"procedure": procedure}))
    window.show_patient(patient)
    plan(window)
    window.workspace.show_exercise()
    assert settle(lambda: window.conductor.marking._planned is not None)
    return window


@pytest.mark.long("journey")
def test_an_exercise_without_a_grid_asks_for_no_mark(window, patient, settle) -> None:
    window.conductor.set_exercise(next(iter(window.feature(ExerciseFeature).exercises.values())))
    window.show_patient(patient)
    plan(window)
    window.workspace.show_exercise()
    settle(timeout=0.2)
    assert not window.workspace.exercise_panel.entry.isVisible()
    assert all(layer.dots == () for layer in window.conductor.marking.layers)


@pytest.mark.long("journey")
def test_what_is_marked_becomes_the_entry_and_is_compared_with_the_planned_one(gridded) -> None:
    window = gridded
    panel, marking = window.workspace.exercise_panel.entry, window.conductor.marking
    assert panel.isVisible()
    planned = marking._planned.entry_mm
    found = marking._grid.place(planned)
    panel.table.setValue(found.table_mm + 4.0)
    panel.line.setValue(found.line)
    panel.offset.setValue(found.offset_mm)
    panel.mark.click()
    mark = marking.mark
    assert mark is not None
    assert mark.error_mm == pytest.approx(4.0, abs=1.0)
    np.testing.assert_allclose(mark.planned_mm, planned)
    entry = window.editors.plan.edit.draft.entry_mm
    np.testing.assert_allclose(entry, mark.marked_mm, atol=1.5)
    assert "Marked at table" in panel.words.text()
    assert "Needle:" in panel.words.text()
    path = needle_angles(window.editors.plan.edit.draft.plan(), marking._grid.spec.up, 0.0)
    assert f"{path.cranio_caudal_deg:+.1f}° out" in panel.words.text()  # of the path that is flown
    was = needle_angles(marking._planned, marking._grid.spec.up, 0.0)
    assert abs(was.cranio_caudal_deg - path.cranio_caudal_deg) > 1.0
    again = marking._planned.entry_mm
    np.testing.assert_allclose(again, planned)  # the mark is no new plan


@pytest.mark.long("journey")
def test_an_attempt_is_told_of_the_mark(gridded, settle) -> None:
    window = gridded
    panel = window.workspace.exercise_panel.entry
    panel.mark.click()
    assert settle(lambda: window.conductor.controller.run is not None)
    window.conductor.controller.beginning.emit()
    mark = window.conductor.controller.run.trainer.marked
    assert mark is window.conductor.marking.mark is not None


@pytest.mark.long("journey")
def test_a_plan_that_is_changed_afterwards_takes_the_mark_away(gridded, settle) -> None:
    window, marking = gridded, gridded.conductor.marking
    window.workspace.exercise_panel.entry.mark.click()
    assert marking.mark is not None
    aside = marking._grid.point(GridPlace(marking.mark.place.table_mm + 6.0, 3))
    window.editors.plan.place(Tool.ENTRY, as_point(aside), True)
    settle(timeout=0.1)
    assert marking.mark is None


@pytest.mark.long("journey")
def test_the_dots_lie_on_the_axial_slice_and_the_laser_on_the_others(gridded, settle) -> None:
    window, marking = gridded, gridded.conductor.marking
    axial, sagittal, _ = marking.layers
    x, y, z = marking._grid.spec.centre_mm
    window.workspace.viewing.set_cursor((x, y, z))
    settle(timeout=0.2)
    assert "3" in [number for _, number in axial.dots]  # others may lie beside this narrow patient
    assert sagittal.dots == ()
    assert sagittal._item.laser is not None
    before = sagittal._item.laser[0].y()
    window.workspace.exercise_panel.entry.table.stepBy(5)
    settle(timeout=0.2)
    assert before - sagittal._item.laser[0].y() == pytest.approx(5.0)


@pytest.mark.long("journey")
def test_a_place_beyond_the_grid_is_refused_in_words(gridded) -> None:
    window, failures = gridded, []
    window.conductor.failed.connect(failures.append)
    window.workspace.exercise_panel.entry.table.setValue(9000.0)
    window.workspace.exercise_panel.entry.mark.click()
    assert "skin" in str(failures)
    assert window.conductor.marking.mark is None
    with pytest.raises(Exception, match="1 to 5"):
        window.conductor.marking._grid.point(GridPlace(0.0, 6))


@pytest.mark.long("journey")
def test_the_needle_points_as_it_is_dialled(gridded, settle) -> None:
    window = gridded
    assert settle(lambda: window.conductor.controller.run is not None)
    controller, panel = window.conductor.controller, window.workspace.exercise_panel.entry
    assert panel.dial.isHidden()
    assert not panel.mark.isHidden()
    controller.begin("s")
    controller.poll()
    panel.set_locked(True)
    assert not panel.dial.isHidden()
    assert panel.mark.isHidden()
    panel.plane.setValue(8.0)
    panel.head.setValue(-3.0)
    before = window.workspace.bullseye.hand
    assert before is not None
    window.conductor._dial()
    after = window.workspace.bullseye.hand
    patient = controller.run.placed.T_world_patient.inverse().rotate(after.direction)
    assert np.degrees(np.arctan2(patient[0], patient[1])) == pytest.approx(8.0, abs=0.1)
    assert np.degrees(np.arcsin(patient[2])) == pytest.approx(-3.0, abs=0.1)
    assert after.depth == before.depth
