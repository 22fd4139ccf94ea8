"""What stands at the head of every record: who (a pseudonym), what, on which device."""

import re
import secrets
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from types import MappingProxyType
from typing import Final

from app import __version__
from app.core.disclaimer import DISCLAIMER
from app.core.messages import sentence
from app.session.errors import SessionError

ID_PATTERN: Final = re.compile(r"[0-9A-Za-z][0-9A-Za-z._-]{0,63}")
"""A session id is also a file name, so nothing else may stand in it."""

TRASH: Final = ".trash"
"""Folder inside that of the records that holds what was deleted, until somebody empties it."""

ANONYMOUS: Final = "anonymous"
"""Stands in a record for a student who gave no pseudonym."""

LONGEST_PSEUDONYM: Final = 64
"""Characters."""


TISSUE_FILE: Final = "tissue-field.bin"
"""Attachment with the patient's tissue field, of an attempt that looked into it; patient data."""


FIELD_FACTS: Final = "tissue_field"
"""Metadata of such an attempt: the field's digest."""


@dataclass(frozen=True, slots=True)
class Attachment:
    """A file inside the record.

    Attributes:
        name: file name.
        media_type: MIME type.
        data: content.
    """

    name: str
    media_type: str
    data: bytes


@dataclass(frozen=True, slots=True)
class SessionHeader:
    """Head of a record; holds pseudonyms only, nothing about a patient.

    Attributes:
        id: session id, also the file's name.
        started: wall-clock time of the beginning (the only wall-clock time in a record).
        origin: monotonic time that `started` stands for [s].
        student: pseudonym of the student.
        exercise_id: exercise.
        exercise_title: its title.
        exercise_version: its version.
        seed: seed of every random number of the run.
        metadata: further records by name (`device`, `cameras`, `placement`, ...).
        attachments: plan, exercise, profiles.

    Raises:
        SessionError: if the id is not usable as a file name.
    """

    id: str
    started: datetime
    origin: float
    student: str
    exercise_id: str
    exercise_title: str = ""
    exercise_version: int = 1
    seed: int = 0
    metadata: Mapping[str, Mapping[str, str]] = field(default_factory=lambda: MappingProxyType({}))
    attachments: tuple[Attachment, ...] = ()

    def __post_init__(self) -> None:
        checked_id(self.id)
        object.__setattr__(self, "student", pseudonym(self.student))

    def records(self) -> dict[str, dict[str, str]]:
        """All metadata records, values as text."""
        return {
            "session": {
                "id": self.id,
                "started": self.started.astimezone(UTC).isoformat(timespec="milliseconds"),
                "origin_s": repr(self.origin),
                "student": self.student,
                "seed": str(self.seed),
                "note": DISCLAIMER,
            },
            "exercise": {
                "id": self.exercise_id,
                "title": self.exercise_title,
                "version": str(self.exercise_version),
            },
            "software": {"name": "acus", "version": __version__},
            **{name: dict(values) for name, values in self.metadata.items()},
        }

    def nanoseconds(self, time: float) -> int:
        """Log time of monotonic `time` [s]: nanoseconds since 1970, never negative."""
        start = round(self.started.timestamp() * 1e3) * 1_000_000
        return max(0, start + round((time - self.origin) * 1e9))


def new_id(started: datetime) -> str:
    """Return a new session id: UTC date and time, and 40 random bits as hexadecimal digits."""
    return f"{started.astimezone(UTC):%Y%m%d-%H%M%S}-{secrets.token_hex(5)}"


def checked_id(session_id: str) -> str:
    """Return the id.

    Raises:
        SessionError: if it could not be a file name (empty, a path, over 64 characters).
    """
    if not ID_PATTERN.fullmatch(session_id):
        raise SessionError(
            sentence(
                "session id {session_id!r} is not usable: letters, digits, '.', '_' and '-', "
                "at most 64, beginning with a letter or digit",
                session_id=session_id,
            )
        )
    return session_id


def pseudonym(student: str) -> str:
    """Return the student's pseudonym on one line, `anonymous` if empty, at most 64 characters."""
    text = " ".join("".join(c if c.isprintable() else " " for c in student).split())
    return text[:LONGEST_PSEUDONYM] or ANONYMOUS
