"""A research study that has begun: its folder, enrolment, leaving, and the lock of its data.

The folder `research/<id>` in the user's data folder holds the design and the arms' exercises as
they were when it began, the sealed list and the ledger. An allocation is opened in the transaction
that writes the enrolment, so that nobody sees one without its student.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, date, datetime
from functools import cached_property
from pathlib import Path
from typing import Any, Final

from app.core import paths
from app.core.files import read_at_most
from app.core.messages import sentence
from app.exercises.library import read_exercise
from app.exercises.schema import Exercise
from app.research.allocation_list import open_hidden, open_place
from app.research.design import (
    NAME,
    ResearchDesign,
    read_design,
)
from app.research.errors import ResearchError
from app.research.ledger import (
    ANSWERED,
    ENROLLED,
    LEFT,
    LOCKED,
    Ledger,
    Participant,
    digest_of_person,
    locked_at,
    new_code,
    participants_of,
)
from app.research.questionnaires import Questionnaire
from app.session.people import People, Person
from app.session.roster import RosterLine
from app.session.station import StationKey

DESIGN: Final = "design.yaml"
SEALED: Final = "allocation.json"
EXERCISE: Final = "exercise-{number}.yaml"
_LARGEST_LIST: Final = 1 << 27

Clock = Callable[[], datetime]
_Place = tuple[str, str, str]
"""Code, visit and questionnaire of an answer."""


def now_utc() -> datetime:
    """Return the time of the wall's clock."""
    return datetime.now(UTC)


@dataclass(frozen=True, slots=True)
class AnsweredRow:
    """Answers of a student to a questionnaire.

    Attributes:
        student: pseudonym.
        visit: name.
        answers: by item.
    """

    student: str
    visit: str
    answers: Mapping[str, float]


@dataclass(frozen=True)
class ResearchStudy:
    """A study that has begun.

    Attributes:
        folder: of the study.
        design: as it was begun.
        clock: time of the wall.
    """

    folder: Path
    design: ResearchDesign
    clock: Clock = now_utc

    @cached_property
    def ledger(self) -> Ledger:
        """Return the ledger."""
        return Ledger(self.folder)

    @cached_property
    def sealed(self) -> Mapping[str, Any]:
        """Return the sealed list.

        Raises:
            ResearchError: if it cannot be read, or is of another design.
        """
        path = self.folder / SEALED
        try:
            document = json.loads(read_at_most(path, _LARGEST_LIST))
            design = document["design"]
        except (OSError, ValueError, LookupError, TypeError) as error:
            raise ResearchError(
                sentence("{path} cannot be read: bring it back from a backup", path=path)
            ) from error
        if design != self.design.digest:
            raise ResearchError(
                sentence(
                    "the design of {study} was changed after the study began: put it back as it "
                    "was, or begin another study",
                    study=self.design.id,
                )
            )
        return dict(document)

    def exercise(self, arm: str) -> Exercise:
        """Return the exercise of an arm as it was when the study began.

        Raises:
            ConfigurationError: if its file cannot be used.
        """
        number = [one.name for one in self.design.arms].index(arm) + 1
        return read_exercise(self.folder / EXERCISE.format(number=number))

    def participants(self) -> list[Participant]:
        """Return everybody who was enrolled, by code."""
        return participants_of(self.ledger.entries())

    def salt(self, people: People) -> bytes:
        """Return the salt of the digests of students."""
        return open_hidden(self.sealed, StationKey.of(people.folder)).salt

    def enrol(
        self, person: Person, stratum: Mapping[str, str], consent_by: str, people: People
    ) -> Participant:
        """Enrol a student who has consented, and open the next place of the list.

        Args:
            person: the student.
            stratum: level of each factor.
            consent_by: who took the consent.
            people: of this station.

        Raises:
            ResearchError: if that is not possible; says why.
        """
        label = self._label(stratum)
        if not consent_by.strip():
            raise ResearchError(sentence("who took the consent? give --consent-by"))
        key = StationKey.of(people.folder)
        digest = digest_of_person(open_hidden(self.sealed, key).salt, person.key)
        with self.ledger.adding() as (there, new):
            known = participants_of(there)
            self._check_open(known, locked_at(there))
            if any(one.person == digest for one in known):
                raise ResearchError(
                    sentence("{pseudonym} is enrolled already", pseudonym=person.pseudonym)
                )
            slot = sum(one.stratum == label for one in known)
            place = open_place(self.sealed, label, slot, key)
            if place is None:
                raise ResearchError(sentence("the list {label} is used up", label=label))
            moment = self.clock().isoformat(timespec="seconds")
            entry = {
                "kind": ENROLLED,
                "time": moment,
                "code": new_code([one.code for one in known]),
                "person": digest,
                "arm": self.design.arms[place].name,
                "stratum": label,
                "slot": slot,
                "consent": {
                    "version": self.design.consent.version,
                    "digest": self.design.consent.digest,
                    "time": moment,
                    "by": consent_by.strip(),
                },
            }
            new.append(entry)
        group = group_of(self.design, str(entry["arm"]))
        people.take_roster([RosterLine(person.pseudonym, groups=(*person.groups, group))])
        return participants_of([entry])[0]

    def leave(self, person: Person, reason: str, withdrawn: bool, people: People) -> Participant:
        """Write that a student leaves the study.

        Args:
            person: the student.
            reason: why.
            withdrawn: whether the data may not be used either.
            people: of this station.

        Raises:
            ResearchError: if the student is not in the study, or has left.
        """
        digest = digest_of_person(self.salt(people), person.key)
        with self.ledger.adding() as (there, new):
            found = next((p for p in participants_of(there) if p.person == digest), None)
            if found is None or (found.left and not (withdrawn and not found.withdrawn)):
                raise ResearchError(
                    sentence(
                        "{pseudonym} is not in {study}, or has left it",
                        pseudonym=person.pseudonym,
                        study=self.design.id,
                    )
                )
            moment = self.clock().isoformat(timespec="seconds")
            new.append(
                {
                    "kind": LEFT,
                    "time": moment,
                    "code": found.code,
                    "reason": reason.strip() or "not given",
                    "withdrawn": withdrawn,
                }
            )
        return next(one for one in self.participants() if one.code == found.code)

    def answer(
        self, rows: Sequence[AnsweredRow], questionnaire: Questionnaire, people: People
    ) -> list[dict[str, float]]:
        """Write the answers of students to a questionnaire, all or none; return the scores.

        Args:
            rows: who answered at which visit, and what.
            questionnaire: that was answered.
            people: of this station.

        Raises:
            ResearchError: naming the first row that cannot be.
            PeopleError: if somebody is no student here.
        """
        scores = list[dict[str, float]]()
        with self.ledger.adding() as (there, new):
            self._check_unlocked(locked_at(there))
            codes, known = _codes(there), _answered(there)
            for row in rows:
                place = self._place(row.student, row.visit, questionnaire, people, codes, known)
                known.add(place)
                scores.append(questionnaire.scored(row.answers))
                head = dict(zip(("code", "visit", "questionnaire"), place, strict=True))
                new.append(
                    head
                    | {
                        "kind": ANSWERED,
                        "time": self.clock().isoformat(timespec="seconds"),
                        "version": questionnaire.version,
                        "values": dict(row.answers) | scores[-1],
                    }
                )
        return scores

    def check_answerable(
        self, student: str, visit: str, questionnaire: Questionnaire, people: People
    ) -> None:
        """Refuse whoever cannot answer a questionnaire before he begins with it.

        Raises:
            ResearchError: if the data are locked, he takes no part, or has answered it.
            PeopleError: if he is no student here.
        """
        there = self.ledger.entries()
        self._check_unlocked(locked_at(there))
        self._place(student, visit, questionnaire, people, _codes(there), _answered(there))

    def _place(
        self,
        student: str,
        visit: str,
        questionnaire: Questionnaire,
        people: People,
        codes: Mapping[str, str],
        known: Collection[_Place],
    ) -> _Place:
        """Return where an answer stands, which nobody has given yet."""
        visits = [one.name for one in self.design.visits]
        code = codes.get(digest_of_person(self.salt(people), people.find(student).key))
        if code is None or visit not in visits:
            raise ResearchError(
                sentence(
                    "{pseudonym} at {visit!r}: not enrolled, withdrawn, or no visit of "
                    "{study}; its visits are {visits}",
                    pseudonym=student,
                    visit=visit,
                    study=self.design.id,
                    visits=", ".join(visits),
                )
            )
        place = (code, visit, questionnaire.id)
        if place in known:
            raise ResearchError(
                sentence(
                    "{pseudonym} has answered {questionnaire} at {visit} already",
                    pseudonym=student,
                    questionnaire=questionnaire.id,
                    visit=visit,
                )
            )
        return place

    def lock(self, by: str) -> str:
        """Lock the data: nobody is enrolled any more, and arms are shown; return when.

        Raises:
            ResearchError: if they are locked, or nobody says who does it.
        """
        if not by.strip():
            raise ResearchError(sentence("who locks the data? give --by"))
        with self.ledger.adding() as (there, new):
            if moment := locked_at(there):
                raise ResearchError(
                    sentence("the data were locked on {moment}", moment=moment[:10])
                )
            moment = self.clock().isoformat(timespec="seconds")
            new.append({"kind": LOCKED, "time": moment, "by": by.strip()})
        return moment

    def blind(self) -> bool:
        """Return whether arms are hidden: the assessor is blind and the data are not locked."""
        return self.design.blind_assessor and not locked_at(self.ledger.entries())

    def _check_unlocked(self, locked: str) -> None:
        if locked:
            raise ResearchError(
                sentence("the data were locked on {moment}: nothing is added", moment=locked[:10])
            )

    def _check_open(self, known: list[Participant], locked: str) -> None:
        self._check_unlocked(locked)
        if len(known) >= self.design.participants:
            raise ResearchError(
                sentence(
                    "all {n} participants of the design are enrolled", n=self.design.participants
                )
            )
        until = self.design.stopping.until
        if until and self.clock().date() > until:
            raise ResearchError(sentence("enrolment ended on {until}", until=until))

    def _label(self, stratum: Mapping[str, str]) -> str:
        wanted = self.design.randomisation.strata
        for factor, levels in wanted.items():
            if stratum.get(factor) not in levels:
                raise ResearchError(
                    sentence(
                        "give --stratum {factor}=…, one of {levels}",
                        factor=factor,
                        levels=", ".join(levels),
                    )
                )
        unknown = [factor for factor in stratum if factor not in wanted]
        if unknown:
            raise ResearchError(
                sentence(
                    "{factor} is no stratum of {study}; it has {strata}",
                    factor=unknown[0],
                    study=self.design.id,
                    strata=", ".join(wanted) or "none",
                )
            )
        return ",".join(f"{factor}={stratum[factor]}" for factor in wanted) or "all"


def _codes(entries: Sequence[dict[str, Any]]) -> dict[str, str]:
    """Return the codes of those who take part, by the digest of the person."""
    return {one.person: one.code for one in participants_of(entries) if not one.withdrawn}


def _answered(entries: Sequence[dict[str, Any]]) -> set[_Place]:
    answered = (one for one in entries if one["kind"] == ANSWERED)
    return {(one["code"], one["visit"], one["questionnaire"]) for one in answered}


def research_folder() -> Path:
    """Return the folder of the studies that have begun at this station."""
    return paths.data() / "research"


def group_of(design: ResearchDesign, arm: str) -> str:
    """Return the group that students of an arm are in; it has the place of the arm, not its name.

    The course of the arm has the same name.
    """
    return f"{design.id}-{[one.name for one in design.arms].index(arm) + 1}"


def studies_here(clock: Clock = now_utc) -> list[ResearchStudy]:
    """Return all studies that have begun here, by id.

    Raises:
        ConfigurationError: if the design of one cannot be read.
    """
    folders = sorted(path.parent for path in research_folder().glob(f"*/{SEALED}"))
    return [ResearchStudy(one, read_design(one / DESIGN), clock) for one in folders]


def find_study(name: str, clock: Clock = now_utc) -> ResearchStudy:
    """Return a study by its id.

    Raises:
        ResearchError: if there is none; names those that there are.
    """
    folder = research_folder() / name
    if re.fullmatch(NAME, name) and (folder / SEALED).is_file():
        return ResearchStudy(folder, read_design(folder / DESIGN), clock)
    known = ", ".join(path.parent.name for path in sorted(research_folder().glob(f"*/{SEALED}")))
    raise ResearchError(
        sentence(
            "no study {name!r} has begun here; there: {known}", name=name, known=known or "none"
        )
    )


def days_between(enrolled: str, moment: str) -> int:
    """Return how many days after the day of enrolment a moment lies; both ISO 8601, UTC."""
    first: date = datetime.fromisoformat(enrolled).date()
    return (datetime.fromisoformat(moment).date() - first).days
