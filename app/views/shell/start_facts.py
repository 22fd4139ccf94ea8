"""What the start page tells of patients and of what was done, read beside the window."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from app.core.progress import Progress
from app.exercises.portrait import Portrait, kept_portrait
from app.exercises.schema import Exercise
from app.session.header import pseudonym
from app.views.kit.access import ACCESS
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.names import NAMES
from app.views.kit.roles import Role
from app.views.kit.text import tr
from app.views.shell.start_page import StartPage

if TYPE_CHECKING:
    from app.session.board import Standing
    from app.views.shell.services import Services


class StartFacts(QObject):
    """Reads beside the window what the start page tells of patients and of what was done.

    One thing at a time, and nothing while somebody opens a patient or has an attempt.
    """

    def __init__(self, page: StartPage, services: Services, parent: QObject) -> None:
        super().__init__(parent)
        self._page, self._services = page, services
        self._standings: BackgroundTask | None = None
        self._picture: BackgroundTask | None = None
        self._pictured: set[str] = set()
        self._may_picture = False
        ACCESS.changed.connect(self._follow)

    @property
    def pictured(self) -> int:
        """Exercises whose patient was looked for."""
        return len(self._pictured)

    def begin(self) -> None:
        """Show what is kept, and read the rest: the window stands."""
        self.show_kept()
        self.refresh()

    def refresh(self) -> None:
        """Read what was done so far; pictures that are missing follow."""
        exercises, folder = self._exercises(), self._services.sessions()
        asked = asker(self._page.who.line.text())
        student, refusal = ACCESS.student, ACCESS.refusal
        if self._standings is not None:
            self._standings.drop()

        def read(_: Progress) -> tuple[dict[str, Standing], str, list[str]]:
            from app.session.board import standings  # SQLAlchemy: beside the window
            from app.session.next_exercise import comes_next, course_of

            stood = standings(folder, exercises, student, asked.may_count)
            course = course_of(student)
            order = [] if course is None else [item.exercise for item in course.items]
            return stood, comes_next(stood, exercises, student, refusal), order

        def show(result: tuple[dict[str, Standing], str, list[str]]) -> None:
            stood, comes, order = result
            self._page.set_standings(stood, comes, asked.words, asked.of_one, order)
            self._done()

        self._standings = run_in_background(self, read, show, lambda _: self._done())

    def let_picture(self, may: bool) -> None:
        """Let pictures be made that are missing, or have that wait."""
        self._may_picture = may
        if not may and self._picture is not None:
            self._picture.drop()
            self._picture = None
        elif may:
            self._next_picture()

    def show_kept(self) -> None:
        """Show the pictures that are kept already: files of some ten kilobytes."""
        for exercise in self._exercises():
            portrait = kept_portrait(exercise) if exercise.id not in self._pictured else None
            if portrait is not None:
                self._pictured.add(exercise.id)
                self._page.set_portrait(exercise.id, portrait)

    def close(self) -> None:
        """End what runs; idempotent."""
        for task in (self._standings, self._picture):
            if task is not None:
                task.close()
        self._standings = self._picture = None
        self._may_picture = False

    def _exercises(self) -> list[Exercise]:
        """Return what the page shows: reading the library again takes as long as the rest."""
        return [place.exercise for place in self._page.map.places.values()]

    def _follow(self) -> None:
        if self._page.isVisible():
            self.refresh()

    def _done(self) -> None:
        self._standings = None
        self._next_picture()

    def _next_picture(self) -> None:
        missing = [one for one in self._exercises() if one.id not in self._pictured]
        if self._picture is not None or not self._may_picture or not missing:
            return
        exercise, services = missing[0], self._services

        def show(portrait: Portrait | None) -> None:
            self._picture = None
            self._pictured.add(exercise.id)
            if portrait is not None:
                self._page.set_portrait(exercise.id, portrait)
            self._next_picture()

        self._picture = run_in_background(
            self,
            lambda progress: services.portrait(exercise, None, progress),
            show,
            lambda _: show(None),
        )


@dataclass(frozen=True, slots=True)
class Asker:
    """Whose attempts are shown.

    Attributes:
        may_count: whether attempts of whom a record names count, where nobody is signed in.
        words: says whose they are.
        of_one: whether they are one person's.
    """

    may_count: Callable[[str], bool]
    words: str
    of_one: bool


def asker(name: str) -> Asker:
    """Return whose attempts who is here is shown.

    Args:
        name: under which somebody practises who does not sign in.
    """
    student = ACCESS.student
    if student is not None:
        return Asker(ACCESS.may_see, _of(NAMES.shown(student.pseudonym)), True)
    if ACCESS.role is not Role.STUDENT:
        return Asker(ACCESS.may_see, tr("Rings: everybody's best here."), False)
    recorded = pseudonym(name)

    def is_own(student: str) -> bool:
        return student == recorded and ACCESS.may_see(student)

    if name:
        return Asker(is_own, _of(NAMES.shown(name)), True)
    if ACCESS.has_students:
        words = tr("Sign in as a student to see what you have done.")
    else:
        words = tr("Rings: best points without a name.\n✔: passed twice in a row.")
    return Asker(is_own, words, True)


def _of(name: str) -> str:
    return tr("Rings: best points of {name}.\n✔: passed twice in a row.", name=name)
