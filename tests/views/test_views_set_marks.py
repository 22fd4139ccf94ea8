"""Pass marks that people set, in the window: the board's cells, and the form that changes one."""

from datetime import timedelta

import pytest

from app.exercises.library import load_exercise
from app.exercises.writing import exercise_document
from app.scoring.pass_mark import MarkMethod, SetMark
from app.session.board import BoardCell
from app.session.people_marks import with_mark
from app.views.author.editing import ExerciseEditor
from app.views.people.board import cell_details, cell_words

MARK = SetMark(method=MarkMethod.ANGOFF, points=66.0, standard_error=3.5, people=3, score_error=5.0)


@pytest.mark.parametrize("near", [True, False])
def test_a_cell_of_the_board_says_that_the_best_is_near_the_mark(near):
    cell = BoardCell(3, 68.0, 60.0, since=timedelta(days=2), passed=True, near_mark=near)
    assert ("near the mark" in cell_words(cell)) is near
    assert ("within the error of measurement of the mark" in cell_details(cell)) is near


def test_who_types_another_pass_mark_in_the_form_takes_away_how_people_set_it(application):
    editor = ExerciseEditor(lambda exercise: ({}, ()))
    editor.begin(exercise_document(with_mark(load_exercise("first-insertion"), MARK)))
    assert editor.exercise.rules.mark == MARK
    editor.put("rules", "minimum_tracking", value=50.0)
    assert editor.exercise.rules.mark == MARK
    editor.put("rules", "pass_mark", value=80.0)
    assert (editor.exercise.rules.pass_mark, editor.exercise.rules.mark) == (80.0, None)
    editor.undo()
    assert editor.exercise.rules.mark == MARK
