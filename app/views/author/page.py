"""A page of the form that an exercise is made with: its fields, and below each what is wrong."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from app.core.configuration import FieldProblem
from app.core.documents import Where
from app.exercises.schema import Exercise
from app.views.author.editing import ExerciseEditor
from app.views.kit.form import Form


class FormPage(Form):
    """Fields of the exercise, each bound to its place in the document; loaded while it is shown.

    Attributes:
        covers: fields whose problems belong to this page.
    """

    follows_typing = False

    def __init__(self, editor: ExerciseEditor, title: str, covers: Sequence[str]) -> None:
        super().__init__(Exercise, title=title, page=True)
        self.editor, self.covers = editor, tuple(covers)
        self.edited.connect(self.put)

    def load(self) -> None:
        """Show what the document says, and what is wrong with it."""
        self.show_values(self.editor.document)
        self.tell(self.editor.problems)

    def put(self, where: Where, value: Any, typed: bool) -> None:
        """Put what was entered into the document."""
        self.editor.put(*where, value=value, typed=typed)

    @property
    def problems(self) -> list[FieldProblem]:
        """Return what is wrong with the fields of this page."""
        return [one for one in self.editor.problems if one.field and one.field[0] in self.covers]


def number_of(text: str) -> float | str | None:
    """Return the number that a text is, with a decimal comma too; the text itself if it is none.

    The reader says what is wrong with it. Of nothing it is None.
    """
    try:
        return float(text.replace(",", ".")) if text.strip() else None
    except ValueError:
        return text


def plain(value: object) -> str:
    """Return a number as short as it is, or a text; nothing of None."""
    return f"{value:g}" if isinstance(value, int | float) else str(value or "")
