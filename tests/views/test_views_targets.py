"""Targets that are touched one after the other, on slices and in 3D, and the author's form."""

from types import SimpleNamespace

import numpy as np
from PySide6.QtGui import QColor, QImage, QPainter

from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.writing import exercise_document
from app.planning.draft import DraftPlan
from app.session.shown_views import Shown
from app.session.touching import TargetMarks, TouchState
from app.views.author.editing import ExerciseEditor
from app.views.kit import theme
from app.views.scene.display import Display
from app.views.scene.orbit import Orbit
from app.views.scene.words import NUMBER_PX, PRESENT_PX, draw_targets


def marks_at_centre(patient, touched=1):
    middle = np.asarray(patient.volume.lps_mm(0.5 * (np.array(patient.volume.size) - 1.0)))
    return TargetMarks(middle + [[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [0.0, 0.0, 16.0]], touched)


def test_slices_show_the_targets_that_lie_in_them(window, patient, settle):
    viewing = window.workspace.viewing
    window.conductor.set_patient(patient)
    viewing.set_tolerances((4.0,))
    marks = marks_at_centre(patient)
    viewing.set_cursor(marks.points_mm[0])
    layers = window.workspace.panes[0].canvas.layers
    changed = []
    viewing.plan_changed.connect(lambda: changed.append(True))
    viewing.set_targets(marks)
    viewing.set_targets(TargetMarks(marks.points_mm.copy(), 1))
    assert len(changed) == 1  # what is alike is not drawn anew

    def shown():
        layers.targets.place(window.workspace.panes[0].canvas.plane,
                             window.workspace.panes[0].canvas.index)  # fmt: skip
        return [item._words() for item in layers.targets.marks if item.isVisible()]

    settle(lambda: window.workspace.panes[0].canvas.plane is not None)
    assert shown() == ["✔ 1"]  # 2 is the present one, which the plan's mark is; 3 lies above
    viewing.set_targets(TargetMarks(marks.points_mm, 0))
    assert shown() == ["2"]
    viewing.set_cursor(marks.points_mm[2])
    assert shown() == ["3"]
    viewing.set_targets(None)
    assert shown() == []


def test_the_present_target_stands_out_in_3d_by_shape_not_by_colour_alone():
    marks = TargetMarks(np.zeros((3, 3)), 1)
    image = QImage(300, 100, QImage.Format.Format_RGB32)
    image.fill(QColor("black"))
    places = np.array([[50.0, 50.0], [150.0, 50.0], [250.0, 50.0]])
    with QPainter(image) as painter:
        before = painter.font()
        draw_targets(painter, places, marks, Display())
        assert painter.font() == before  # what is written after them is as large as it was

    def inked(x, radius):
        ring = [image.pixelColor(int(x + radius * c), int(50 + radius * s)).value()
                for c, s in ((0.7, 0.7), (-0.7, 0.7), (0.7, -0.7), (-0.7, -0.7))]  # fmt: skip
        return np.mean(ring)

    assert inked(150, 0.95 * NUMBER_PX) > 150  # full
    assert inked(250, 0.75 * NUMBER_PX) < 100  # hollow
    assert PRESENT_PX > NUMBER_PX
    assert theme.TARGET.symbol is not theme.TARGET_TOUCHED.symbol


def test_places_of_points_and_lines_of_sight_belong_together():
    orbit = Orbit.from_side("R", np.array([10.0, -20.0, 30.0]), 60.0).turned(30.0, -20.0)
    points = np.array([[0.0, 0.0, 0.0], [40.0, -35.0, 22.0]])
    for point, (x, y) in zip(points, orbit.pixels(points, (400, 300)), strict=True):
        start, way = orbit.ray(x, y, (400, 300))
        assert np.linalg.norm(np.cross(point - start, way)) < 1e-9


def test_the_authors_form_keeps_the_targets_and_says_what_is_wrong_with_them():
    editor = ExerciseEditor(lambda exercise: ({}, ()))
    editor.begin(exercise_document(load_exercise("laparoscopic-tool")))
    assert editor.exercise is not None
    assert editor.exercise.touch == load_exercise("laparoscopic-tool").touch
    editor.put("title", value="Another")
    assert editor.exercise.touch is not None
    editor.put("touch", "radius_mm", value=0.0)
    assert editor.problems_at("touch")
    editor.put("touch", value=None)
    assert editor.exercise.touch is None


def test_the_present_target_is_that_of_slices_and_3d_and_stays_so_when_the_plan_is_shown_anew(
    window, patient
):
    exercise = load_exercise("laparoscopic-tool")
    placed = placed_plan_of(exercise, device_of(exercise))
    task = exercise.touch_task(placed)
    window.conductor.set_patient(patient)
    workspace, motion = window.workspace, window.conductor._motion
    run = SimpleNamespace(shown=Shown(), placed=placed)

    def show(touched):
        touch = TouchState(task, touched)
        motion.show(
            run, SimpleNamespace(touch=touch, p_target=touch.aim.p_target, target_marks=touch.marks)
        )
        return touch.aim.plan.target_mm

    for touched in (0, 0, 1):
        target = show(touched)
        np.testing.assert_allclose(workspace.scene._draft.target_mm, target, atol=1e-9)
        np.testing.assert_allclose(workspace.viewing.shown_draft.target_mm, target, atol=1e-9)
        workspace.viewing.set_draft(DraftPlan.of(placed.plan))  # as at every begin
        workspace.scene.set_plan(DraftPlan.of(placed.plan))
        show(touched)
        np.testing.assert_allclose(workspace.scene._draft.target_mm, target, atol=1e-9)
        assert workspace.viewing.targets.touched == touched
    motion.hide()
    assert workspace.viewing.targets is None
    assert workspace.scene._targets is None
