"""Who is at this window, and as what: every part that hides or records asks (`session.access`)."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from app.session.access import Known, Visitor
from app.session.audit import ACCOUNT, INSTRUCTOR, act_as
from app.session.header import ANONYMOUS
from app.session.people import Person
from app.session.roster import looks_like_a_key
from app.views.kit.roles import Role
from app.views.kit.text import tr


class Access(QObject):
    """Who is signed in, and in which role somebody sits here.

    Signals:
        changed(): somebody signed in or out, more is known of people, or the role is another.
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._visitor = Visitor()
        self._role = Role.TECHNICIAN
        self._taking = False
        self._up_to, self._who = Role.TECHNICIAN, ""

    @property
    def role(self) -> Role:
        """Return the role; without a window that chooses one, the one that has everything."""
        return self._role

    def take_role(self, role: Role) -> None:
        """Somebody sits here in another role.

        Who hears of it and insists on another is not heard: a window that goes while the next one
        stands already would contradict it without end.
        """
        if role is self._role or self._taking:
            return
        self._role, self._taking = role, True
        try:
            self.changed.emit()
        finally:
            self._taking = False

    @property
    def student(self) -> Person | None:
        """Return the student who is signed in."""
        return self._visitor.student

    @property
    def instructor(self) -> bool:
        """Return whether the instructor is signed in."""
        return self._visitor.instructor

    @property
    def signed_in(self) -> tuple[Person | None, bool, Role, str]:
        """Return what `sign_in` takes to let in who is here once more."""
        return self.student, self.instructor, self._up_to, self._who

    def opens(self, role: Role) -> bool:
        """Return whether who is signed in as the instructor may sit here in a role."""
        return self.instructor and role.rank <= self._up_to.rank

    @property
    def guarded(self) -> bool:
        """Return whether an instructor's password is set."""
        return self._visitor.known.guarded

    @property
    def has_students(self) -> bool:
        """Return whether somebody can sign in as a student."""
        return bool(self._visitor.known.pseudonyms)

    @property
    def may_manage(self) -> bool:
        """Return whether people, courses, all results, deleting and exports are open to who is
        here.
        """
        return self._visitor.may_manage and self._role is not Role.STUDENT

    @property
    def why_not_manage(self) -> str:
        """Say that what changes these needs the instructor; empty for who may."""
        return (
            ""
            if self.may_manage
            else tr("Only the instructor does that: change the role at the top right.")
        )

    def sign_in(
        self,
        student: Person | None,
        instructor: bool = False,
        up_to: Role = Role.TECHNICIAN,
        who: str = "",
    ) -> None:
        """Somebody has signed in, nobody is where neither is given.

        Args:
            student: who it is.
            instructor: whether the instructor is here, or somebody in his place.
            up_to: the most that the instructor may sit here as; the password opens every role.
            who: key of the person in the instructor's place; without one it is the password's.
        """
        self._visitor = replace(self._visitor, student=student, instructor=instructor)
        self._up_to, self._who = up_to, who
        named = who or INSTRUCTOR
        act_as(named if instructor else ACCOUNT if student is None else student.key)
        self.changed.emit()

    def learn(self, known: Known) -> None:
        """Take what is known of people now."""
        if known != self._visitor.known:
            self._visitor = replace(self._visitor, known=known)
            self.changed.emit()

    def shown(self, recorded: str) -> str:
        """Return what to show for whom a record names: the pseudonym, or the text as it is."""
        pseudonyms = self._visitor.known.pseudonyms
        found = pseudonyms.get(recorded)
        if found is None and recorded == ANONYMOUS:
            return tr("anonymous")
        if found is None and looks_like_a_key(recorded):
            return tr("(erased)") if pseudonyms else recorded
        return found or recorded

    def recorded_as(self, typed: str) -> str:
        """Return what a record names: the key of who is signed in, else what was typed."""
        return self.student.key if self.student is not None else typed

    def owner(self, recorded: str) -> str:
        """Return the key of the student whom a record names; empty where nobody is known."""
        return self._visitor.owner(recorded)

    def may_see(self, recorded: str) -> bool:
        """Return whether attempts of whom a record names are open to who is here."""
        if self._role is Role.STUDENT and self.student is None:
            return not self.owner(recorded)
        return self._visitor.may_see(recorded)

    def refusal(self, exercise: str) -> str:
        """Say why who is here may not begin an exercise; empty if nothing speaks against it."""
        if self.student is not None:
            return self._visitor.known.refused.get(exercise, "")
        course = self._visitor.assessment(exercise)
        if not course:
            return ""
        return tr(
            "it is an assessment of the course {course}. Sign in as a student who takes it "
            "(Sessions ▸ Sign in as a student…), or as the instructor (role, at the top right)",
            course=course,
        )

    def drill_refusal(self, exercise: str) -> str:
        """Say why who is here may not begin a drill of an exercise; empty if nothing speaks
        against it.
        """
        course = self._visitor.examined_by(exercise)
        if course:
            return tr(
                "it is an assessment of the course {course}: nobody rehearses it", course=course
            )
        return self.refusal(exercise)


ACCESS = Access()
"""The one answer of the window."""
