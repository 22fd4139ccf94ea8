"""Who uses a window: the roles decide which of its features exist (`shell.roles`)."""

from __future__ import annotations

import os
from enum import StrEnum
from typing import Final

from app.views.kit.text import tr


class Role(StrEnum):
    """What somebody comes for; each has all that the one before has, and more."""

    STUDENT = "student"  # practise, progress, help
    INSTRUCTOR = "instructor"  # also author, course, results, patients
    TECHNICIAN = "technician"  # also robot, cameras, checks, effects, cost of accuracy

    @property
    def rank(self) -> int:
        """Return its place, from 0."""
        return list(Role).index(self)


EVERYBODY: Final = frozenset(Role)
STAFF: Final = frozenset({Role.INSTRUCTOR, Role.TECHNICIAN})
TECHNICIANS: Final = frozenset({Role.TECHNICIAN})

EVERYBODYS: Final = "everybodys"
"""Property of a dialog that stays open when somebody sits here in another role."""


def role_named(text: object, otherwise: Role) -> Role:
    """Return the role that a text names, or another where it names none."""
    return Role(str(text)) if str(text) in set(Role) else otherwise


def first_role() -> Role:
    """Return the role of a window that remembers none: `ACUS_ROLE`, else a student's."""
    return role_named(os.environ.get("ACUS_ROLE"), Role.STUDENT)


def role_title(role: Role) -> str:
    """Return the name of a role for people."""
    return {
        Role.STUDENT: tr("Student"),
        Role.INSTRUCTOR: tr("Instructor"),
        Role.TECHNICIAN: tr("Technician"),
    }[role]


def role_words(role: Role) -> str:
    """Say what a role has."""
    return {
        Role.STUDENT: tr("practise, progress, help"),
        Role.INSTRUCTOR: tr("also patients, exercises, courses and results"),
        Role.TECHNICIAN: tr("also robot, cameras, checks, effects and cost of accuracy"),
    }[role]
