"""Who is signed in at this window, and what they may reach: every part that hides or records asks.

It guards against curiosity, not against the owner of the disk. As long as no instructor's password
is set everybody may do everything.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from PySide6.QtCore import QObject, Signal

from app.session.people import Person
from app.session.roster import looks_like_a_key
from app.views.kit.text import tr


@dataclass(frozen=True, slots=True)
class Known:
    """What a look at the list of people gave.

    Attributes:
        guarded: whether an instructor's password is set.
        pseudonyms: by what records name.
        keys: of students, likewise.
        refused: why the student who is signed in may not begin an exercise, by its id.
        assessed: exercises that a course holds as assessments -> title of the course.
    """

    guarded: bool = False
    pseudonyms: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    keys: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    refused: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    assessed: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))


class Access(QObject):
    """Who is signed in.

    Signals:
        changed(): somebody signed in or out, or more is known of people.
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.student: Person | None = None
        self.instructor = False
        self._known = Known()

    @property
    def guarded(self) -> bool:
        """Whether an instructor's password is set."""
        return self._known.guarded

    @property
    def may_manage(self) -> bool:
        """Whether people, courses, all results, deleting and exports are open to who is here."""
        return self.instructor or (not self.guarded and self.student is None)

    @property
    def why_not_manage(self) -> str:
        """Say that what changes these needs the instructor; empty for who may."""
        return (
            ""
            if self.may_manage
            else tr("Only the instructor does that: Sessions ▸ Sign in as the instructor.")
        )

    def sign_in(self, student: Person | None, instructor: bool = False) -> None:
        """Somebody has signed in, nobody is where neither is given."""
        self.student, self.instructor = student, instructor
        self.changed.emit()

    def learn(self, known: Known) -> None:
        """Take what is known of people now."""
        if known != self._known:
            self._known = known
            self.changed.emit()

    def shown(self, recorded: str) -> str:
        """Return what to show for whom a record names: the pseudonym, or the text as it is."""
        found = self._known.pseudonyms.get(recorded)
        if found is None and looks_like_a_key(recorded):
            return tr("(erased)") if self._known.pseudonyms else recorded
        return found or recorded

    def recorded_as(self, typed: str) -> str:
        """Return what a record names: the key of who is signed in, else what was typed."""
        return self.student.key if self.student is not None else typed

    def owner(self, recorded: str) -> str:
        """Return the key of the student whom a record names; empty where nobody is known."""
        return self._known.keys.get(recorded, "")

    def may_see(self, recorded: str) -> bool:
        """Whether attempts of whom a record names are open to who is here."""
        if self.may_manage:
            return True
        owner = self.owner(recorded)
        return owner == self.student.key if self.student is not None else not owner

    def refusal(self, exercise: str) -> str:
        """Say why who is here may not begin an exercise; empty if nothing speaks against it."""
        if self.student is not None:
            return self._known.refused.get(exercise, "")
        course = self._known.assessed.get(exercise, "")
        if self.may_manage or not course:
            return ""
        return tr(
            "it is an assessment of the course {course}. Sign in as a student who takes it "
            "(Sessions ▸ Sign in as a student…), or as the instructor",
            course=course,
        )


ACCESS = Access()
"""The one answer of the window."""
