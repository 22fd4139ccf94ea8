"""Bands of a hand from attempts of experienced people, who are a group of the list of people.

A person's newest attempts stand for him, as many of everybody, so that nobody who practises much
sets the bands alone. Only attempts that count are taken: scored, of a person, in no drill, not
declared void, at one version of one exercise, with one hand.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from app.core.messages import counted, sentence
from app.exercises.hand_bands import OF_HANDS, BandsSource, HandBands
from app.exercises.locks import HandName
from app.exercises.schema import Exercise
from app.scoring.contrasting import contrasted
from app.scoring.rows import REACHING
from app.session.course import not_void
from app.session.errors import SessionError
from app.session.index import Indexed
from app.session.people import Person, Remarks

LEAST_PEOPLE: Final = 3
"""Of each group: fewer say more of themselves than of experience."""

EACH: Final = 5
"""So many attempts of a person are taken, the newest."""


@dataclass(frozen=True, slots=True)
class GroupAttempts:
    """What one group did.

    Attributes:
        name: of the group, for people.
        people: how many they are.
        scores: of their attempts, as documents.
        points: of each person's attempts.
    """

    name: str
    people: int
    scores: tuple[Mapping[str, Any], ...]
    points: tuple[tuple[float, ...], ...] = ()

    def values(self, metric: str) -> list[float]:
        """Return the values of a metric, without its sign; of those that have one."""
        rows = (row for score in self.scores for row in score.get("rows", ()))
        return [
            abs(float(row["value"]))
            for row in rows
            if row.get("name") == metric and row.get("value") is not None
        ]


@dataclass(frozen=True, slots=True)
class PeopleBands:
    """Bands that were fitted to people.

    Attributes:
        hand: whose bands they are.
        experienced: the ones.
        others: the others.
        bands: of the metrics that part them.
        alike: metrics that do not: their tolerance stays.
    """

    hand: HandName
    experienced: GroupAttempts
    others: GroupAttempts
    bands: HandBands
    alike: tuple[str, ...]


def attempts_of(
    name: str,
    group: Iterable[Person],
    exercise: Exercise,
    hand: HandName,
    attempts: Sequence[Indexed],
    remarks: Mapping[str, Remarks],
) -> GroupAttempts:
    """Return the attempts of a group at an exercise that bands may be fitted to.

    Args:
        name: of the group, for people.
        group: its people.
        exercise: with its version.
        hand: that moved the needle.
        attempts: everybody's, oldest first.
        remarks: of the instructor, by id of the attempt.

    Raises:
        SessionError: if fewer than `LEAST_PEOPLE` of them have such attempts.
    """
    of_it = [
        one
        for one in not_void(attempts, remarks)
        if one.counts
        and one.total is not None
        and (one.exercise, one.version) == (exercise.id, exercise.version)
        and OF_HANDS.get(one.conditions.hand) is hand
    ]
    theirs = [[one for one in of_it if one.student == person.key][-EACH:] for person in group]
    some = [own for own in theirs if own]
    if len(some) < LEAST_PEOPLE:
        raise SessionError(
            sentence(
                "{people} of {group} have attempts at {exercise}, version {version}, by {hand} "
                "that count: {least} at least are needed",
                people=counted("{n} person", "{n} people", len(some)),
                group=name,
                exercise=exercise.id,
                version=exercise.version,
                hand=hand.value,
                least=LEAST_PEOPLE,
            )
        )
    scores = tuple(one.summary.score or {} for own in some for one in own)
    points = tuple(tuple(one.total or 0.0 for one in own) for own in some)
    return GroupAttempts(name, len(some), scores, points)


def fit(
    exercise: Exercise, hand: HandName, experienced: GroupAttempts, others: GroupAttempts
) -> PeopleBands:
    """Fit bands of all metrics that count and of which less is better, but for where it ended.

    Raises:
        SessionError: if no metric parts the two groups.
    """
    metrics, alike = {}, []
    for name, limits in exercise.tolerances.items():
        if name in REACHING or limits.higher_is_better or not limits.weight:
            continue
        values = [group.values(name) for group in (experienced, others)]
        bands = contrasted(*values) if all(values) else None
        if bands is None:
            alike.append(name)
        else:
            metrics[name] = bands
    if not metrics:
        raise SessionError(
            sentence(
                "nothing parts {experienced} from {others} in {exercise}: of no metric that says "
                "how the needle went are the others worse; its tolerances stay",
                experienced=experienced.name,
                others=others.name,
                exercise=exercise.id,
            )
        )
    bands_of = HandBands(source=BandsSource.PEOPLE, metrics=metrics)
    return PeopleBands(hand, experienced, others, bands_of, tuple(alike))
