"""What the instructor admits: attempts that this station did not sign, each with a reason, sealed.

An admission stands in the list of people under a seal of this station's key, over the attempt's id,
the digest of its record, the reason and the time. It holds for that very record and on this station
only, and does not sign the record: lists say `admitted`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

from app.core.messages import sentence
from app.session.errors import PeopleError
from app.session.people import PEOPLE, People
from app.session.sidecar import file_digest
from app.session.signature import Signed, judge_whole
from app.session.station import StationKey, seals_here, this_station

LONGEST_REASON: Final = 500
"""Characters."""


@dataclass(frozen=True, slots=True)
class Admission:
    """One attempt that was admitted.

    Attributes:
        attempt: its id.
        record: SHA-256 of its record, hexadecimal.
        why: the instructor's reason.
        time: when, ISO 8601, UTC.
    """

    attempt: str
    record: str
    why: str
    time: str

    def seal(self, key: StationKey) -> str:
        """Return its seal by a station's key."""
        return key.seal(self.document())

    def document(self) -> dict[str, str]:
        """Return what is sealed."""
        return {
            "what": "admission",
            "attempt": self.attempt,
            "record": self.record,
            "why": self.why,
            "time": self.time,
        }


def admissions(people: People | None = None) -> dict[str, Admission]:
    """Return what was admitted here, by id; what this station did not seal is left out.

    Raises:
        DatabaseError: if the list of people cannot be read.
    """
    people, key = people or People(), this_station()
    if key is None or not (people.folder / PEOPLE).exists():
        return {}
    found = {}
    for *values, seal in people.admitted():
        one = Admission(*values)
        if key.has_sealed(one.document(), seal):
            found[one.attempt] = one
    return found


def with_admission(verdict: str, record: str, admitted: Admission | None) -> str:
    """Return what is said of a record in the end: an unsigned one may have been admitted.

    Args:
        verdict: of its signature, as lists say it.
        record: its SHA-256.
        admitted: what was admitted of its id; None if nothing.
    """
    foreign = verdict.partition(" (")[0] in (Signed.UNSIGNED, Signed.REVOKED)
    if foreign and admitted is not None and admitted.record == record:
        return Signed.ADMITTED.value
    return verdict


def admit(records: Sequence[Path], reason: str, people: People | None = None) -> list[Admission]:
    """Admit attempts that this station did not sign: all of them or none.

    Args:
        records: their files.
        reason: the reason, one for all.
        people: of this station.

    Raises:
        PeopleError: without a reason, for an attempt that is signed here or was altered, or where
            nothing is sealed yet.
        BrokenRecordingError: for a file that is no record.
    """
    people, reason = people or People(), " ".join(reason.split())
    if not reason or len(reason) > LONGEST_REASON:
        raise PeopleError(
            sentence(
                "say why it is admitted, in 1 to {longest_reason} characters: the reason is "
                "sealed with it",
                longest_reason=LONGEST_REASON,
            )
        )
    if not seals_here():
        raise PeopleError(
            sentence("nothing is sealed at this station yet: every attempt counts as it is")
        )
    key, time, taken = StationKey.of(), datetime.now(UTC).isoformat(timespec="seconds"), []
    for path in records:
        found = judge_whole(path, key)
        if found.verdict not in (Signed.UNSIGNED, Signed.REVOKED):
            raise PeopleError(
                sentence(
                    "{path_stem} is {sentence}; only an unsigned attempt can be admitted",
                    path_stem=path.stem,
                    sentence=found.sentence(),
                )
            )
        taken.append(Admission(path.stem, file_digest(path), reason, time))
    people.admit([(one.attempt, one.record, one.why, one.time, one.seal(key)) for one in taken])
    return taken
