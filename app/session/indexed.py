"""Attempts of the index: one of them, and all of them as columns.

A list of attempts is kept as columns, so that a board of 100 000 of them makes no object for each.
What only one attempt is asked for (its document, its conditions to the last figure) is read when it
is asked for.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from functools import cached_property, lru_cache
from typing import Any, Final, overload

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.scoring.conditions import Conditions
from app.scoring.rows import ScoreRules
from app.session.summary import Summary

IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]

PARTS_NO_SCORE: Final = (
    "assistance",
    "seed",
    "software",
    "calibration",
    "agreement_mm",
    "computer",
)
"""Of the conditions what differs from attempt to attempt at the same task: the dial stands in
columns of its own, the others part no scores."""


@dataclass(frozen=True)
class Indexed:
    """One attempt in the index.

    Attributes:
        id: of the attempt.
        started: ISO 8601, UTC.
        student: as the record names who did it.
        exercise: id.
        version: of the exercise.
        state: `ended`, `aborted`, `unfinished` or `broken`.
        duration: [s].
        total: points; None where it was not scored, is void or was altered after it was signed.
        passed: whether the score passes; None without one.
        verdict: of the signature.
        counts: whether it counts for a person: scored, by a person, not emulated, no
            drill, and it `stands`.
        under: what the score was made under, as text; empty where nothing is known.
        document: the summary as `Summary.document` gives it, as text.
        stands: whether this station vouches for it: verified, admitted by the instructor, or not
            altered where no station seals. What does not stand neither passes nor counts.
    """

    id: str
    started: str
    student: str
    exercise: str
    version: int
    state: str
    duration: float
    total: float | None
    passed: bool | None
    verdict: str
    counts: bool
    under: str
    document: str
    stands: bool = field(default=True, compare=False)

    @cached_property
    def summary(self) -> Summary:
        """The attempt as lists show it."""
        summary = Summary.of(json.loads(self.document), self.id)
        return replace(summary, signature=self.verdict)

    @cached_property
    def conditions(self) -> Conditions:
        """Return what the score was made under."""
        return conditions_of(self.under, self.exercise)

    @property
    def pass_mark(self) -> float | None:
        """Return the points that it had to reach; None without a score."""
        rules = (json.loads(self.document).get("score") or {}).get("rules")
        return None if rules is None else float(rules.get("pass_mark", ScoreRules().pass_mark))

    @property
    def time(self) -> datetime:
        """Return when it began, as `time_of` says."""
        return time_of(self.started)

    @property
    def has_error(self) -> bool:
        """Return whether its pass mark says an error of measurement."""
        return HAS_ERROR in self.document


def time_of(started: str) -> datetime:
    """Return when an attempt began; the beginning of 1970 where the record does not say."""
    try:
        found = datetime.fromisoformat(started)
    except ValueError:
        return datetime.fromtimestamp(0.0, UTC)
    return found if found.tzinfo else found.replace(tzinfo=UTC)


HAS_ERROR: Final = '"score_error"'
"""Stands in the document of an attempt whose pass mark says an error of measurement."""

Texts = Callable[[int], tuple[str, str]]
"""Gives the texts `under` and `document` of an attempt by its place in a list."""


@lru_cache(maxsize=4096)
def conditions_of(under: str, exercise: str) -> Conditions:
    """Read conditions from their text; most attempts of a group were made under the same.

    Where the text is none of them, nothing is known but the exercise.
    """
    document = _document(under)
    return Conditions.of(document) if document else Conditions(exercise)


@lru_cache(maxsize=4096)
def split(under: str) -> tuple[str, tuple[float, ...]]:
    """Return the task of conditions as text, and the dial: mean, least, most, start.

    A dial of which nothing is known is none (all NaN); so is a start that is not told.
    """
    document = _document(under)
    if not document:
        return "", (np.nan,) * 4
    dial = document.get("assistance")
    known = {name: value for name, value in document.items() if name not in PARTS_NO_SCORE}
    task = json.dumps(known, sort_keys=True, ensure_ascii=False)
    if not isinstance(dial, Mapping):
        return task, (np.nan,) * 4
    start = dial["start"]
    values = (dial["mean"], dial["least"], dial["most"], np.nan if start is None else start)
    return task, tuple(float(value) for value in values)


def _document(under: str) -> dict[str, Any]:
    """Return the conditions of a text; empty where somebody else has written there."""
    try:
        document = json.loads(under or "{}")
    except ValueError:
        return {}
    return document if isinstance(document, dict) else {}


@dataclass(frozen=True)
class Coded:
    """A column of texts of which many are the same: the texts, and which one each row has."""

    texts: tuple[str, ...]
    codes: IntArray

    @classmethod
    def of(cls, values: Sequence[str]) -> Coded:
        """Return texts as a coded column."""
        known: dict[str, int] = {}
        codes = [known.setdefault(value, len(known)) for value in values]
        return cls(tuple(known), np.array(codes, dtype=np.int64))

    @classmethod
    def joined(cls, parts: Sequence[Coded]) -> Coded:
        """Return one column of several, one after the other."""
        known: dict[str, int] = {}
        codes = [np.empty(0, np.int64)]
        for part in parts:
            own = [known.setdefault(text, len(known)) for text in part.texts]
            codes.append(np.array(own, dtype=np.int64)[part.codes])
        return cls(tuple(known), np.concatenate(codes))

    def __getitem__(self, place: int) -> str:
        return self.texts[self.codes[place]]

    def taken(self, places: IntArray) -> Coded:
        """Return the column of some rows."""
        return Coded(self.texts, self.codes[places])

    def within(self, wanted: Mapping[str, int]) -> IntArray:
        """Return for each row the number that its text has there, -1 where it has none."""
        numbers = np.array([wanted.get(text, -1) for text in self.texts] or [-1], dtype=np.int64)
        return numbers[self.codes]


@dataclass(frozen=True)
class Attempts(Sequence[Indexed]):
    """Attempts as columns, oldest first; one of them is made when it is asked for.

    Attributes:
        ids, started: a text each.
        student, exercise, state, verdict, task: coded texts; the task is what `split` gives.
        version: of the exercise.
        duration: [s].
        total: points; NaN without a score.
        passed: 1, 0 or -1 where that is not known.
        counts, stands, has_error: as of `Indexed`.
        dial: mean, least, most, start; shape (n, 4), NaN where they are not known.
        texts: gives `under` and `document` by an attempt's place in the list that was read.
        places: there.
    """

    ids: tuple[str, ...]
    started: tuple[str, ...]
    student: Coded
    exercise: Coded
    state: Coded
    verdict: Coded
    task: Coded
    version: IntArray
    duration: FloatArray
    total: FloatArray
    passed: IntArray
    counts: BoolArray
    stands: BoolArray
    has_error: BoolArray
    dial: FloatArray
    texts: Texts
    places: IntArray

    @classmethod
    def of(cls, some: Sequence[Indexed]) -> Attempts:
        """Return attempts as columns; columns are taken as they are."""
        if isinstance(some, cls):
            return some
        known = list(some)
        parts = [split(one.under) for one in known]
        return cls(
            ids=tuple(one.id for one in known),
            started=tuple(one.started for one in known),
            student=Coded.of([one.student for one in known]),
            exercise=Coded.of([one.exercise for one in known]),
            state=Coded.of([one.state for one in known]),
            verdict=Coded.of([one.verdict for one in known]),
            task=Coded.of([task for task, _ in parts]),
            version=np.array([one.version for one in known], np.int64),
            duration=np.array([one.duration for one in known], float),
            total=np.array([np.nan if one.total is None else one.total for one in known], float),
            passed=np.array([-1 if one.passed is None else one.passed for one in known], np.int64),
            counts=np.array([one.counts for one in known], bool),
            stands=np.array([one.stands for one in known], bool),
            has_error=np.array([one.has_error for one in known], bool),
            dial=np.array([dial for _, dial in parts], float).reshape(-1, 4),
            texts=lambda place: (known[place].under, known[place].document),
            places=np.arange(len(known)),
        )

    def taken(self, places: IntArray) -> Attempts:
        """Return some of them, in the order of their places here."""
        chosen: dict[str, Any] = {
            name: value.taken(places) if isinstance(value, Coded) else value[places]
            for name, value in vars(self).items()
            if isinstance(value, Coded | np.ndarray)
        }
        if len(places) == len(self) and (places == np.arange(len(self))).all():
            return self
        wanted = places.tolist()
        return replace(
            self,
            ids=tuple(map(self.ids.__getitem__, wanted)),
            started=tuple(map(self.started.__getitem__, wanted)),
            **chosen,
        )

    def of_students(self, students: Sequence[str]) -> Attempts:
        """Return those of some students alone."""
        wanted = dict.fromkeys(students, 1)
        return self.taken(np.flatnonzero(self.student.within(wanted) >= 0))

    def task_of(self, place: int) -> Conditions:
        """Return what one was made under, without what differs within a task."""
        return conditions_of(self.task[place], self.exercise[place])

    def __len__(self) -> int:
        return len(self.ids)

    @overload
    def __getitem__(self, place: int) -> Indexed: ...
    @overload
    def __getitem__(self, place: slice) -> Attempts: ...
    def __getitem__(self, place: int | slice) -> Indexed | Attempts:
        if isinstance(place, slice):
            return self.taken(np.arange(len(self))[place])
        total, passed = float(self.total[place]), int(self.passed[place])
        found = _Read.__new__(_Read)
        found.__dict__.update(
            id=self.ids[place],
            started=self.started[place],
            student=self.student[place],
            exercise=self.exercise[place],
            version=int(self.version[place]),
            state=self.state[place],
            duration=float(self.duration[place]),
            total=None if np.isnan(total) else total,
            passed=None if passed < 0 else bool(passed),
            verdict=self.verdict[place],
            counts=bool(self.counts[place]),
            stands=bool(self.stands[place]),
            _texts=self.texts,
            _place=int(self.places[place]),
        )
        return found

    def __iter__(self) -> Iterator[Indexed]:
        return (self[place] for place in range(len(self)))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and list(self) == list(other)

    __hash__ = None  # type: ignore[assignment]


class _Read(Indexed):
    """An attempt whose texts are read when they are asked for."""

    _texts: Texts
    _place: int

    @cached_property
    def under(self) -> str:
        """Return what the score was made under, as text."""
        return self._texts(self._place)[0]

    @cached_property
    def document(self) -> str:
        """Return the summary, as text."""
        return self._texts(self._place)[1]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Indexed) and _values(self) == _values(other)

    __hash__ = Indexed.__hash__


def _values(attempt: Indexed) -> tuple[Any, ...]:
    names = Indexed.__dataclass_fields__
    return tuple(getattr(attempt, name) for name, said in names.items() if said.compare)
