"""The design of a research study: arms, randomisation, visits, consent, stopping, as one YAML file.

Reporting follows CONSORT 2010 (Schulz et al., BMJ 340:c332): what it asks for stands in a field.
"""

from __future__ import annotations

import datetime
import hashlib
import json
from collections import Counter
from collections.abc import Iterator, Mapping
from enum import StrEnum
from itertools import pairwise, product
from pathlib import Path
from typing import Annotated, Any, Final

from pydantic import Field, model_validator

from app.core.configuration import Strict, load
from app.core.errors import AcusError
from app.core.messages import sentence
from app.exercises.library import load_exercise
from app.exercises.schema import Exercise

NAME: Final = r"^[a-z0-9]+(-[a-z0-9]+)*$"
"""A study's id is also the name of its folder."""

MOST_LISTS: Final = 64
"""Combinations of strata; each has a list of its own, and small lists balance nothing."""

Name = Annotated[str, Field(pattern=NAME, max_length=40)]


class Feedback(StrEnum):
    """When a student learns the result of an attempt."""

    AT_ONCE = "at_once"
    HELD = "held"


class Method(StrEnum):
    """How students are allocated to arms."""

    SIMPLE = "simple"
    BLOCKS = "blocks"


class Arm(Strict):
    """What one group of the students does.

    Attributes:
        name: of the arm.
        ratio: students of this arm for each of another one with ratio 1.
        exercise: id, or `id@version`.
        assistance: dial at the start, in place of the exercise's; None keeps it.
        without_effects: effects of the exercise that this arm does without.
        feedback: whether results are shown at once, or held until the instructor releases them.
    """

    name: Name
    ratio: Annotated[int, Field(ge=0, le=20)] = 1
    exercise: str
    assistance: Annotated[float, Field(ge=-1.0, le=1.0)] | None = None
    without_effects: tuple[str, ...] = ()
    feedback: Feedback = Feedback.AT_ONCE

    @property
    def changes_exercise(self) -> bool:
        """Return whether the arm has an exercise of its own."""
        return self.assistance is not None or bool(self.without_effects)


class Randomisation(Strict):
    """How the allocation list is made.

    Attributes:
        method: `simple`, each by itself; or `blocks`, permuted ones.
        block_sizes: of permuted blocks; where there are several each block's is drawn, so that
            nobody can tell when one ends.
        strata: factor -> its levels; each combination has a list of its own.
    """

    method: Method = Method.BLOCKS
    block_sizes: tuple[Annotated[int, Field(ge=2, le=100)], ...] = ()
    strata: Mapping[Name, tuple[Name, ...]] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _usable(self) -> Randomisation:
        if self.method is Method.SIMPLE and self.block_sizes:
            raise ValueError(
                sentence("block_sizes: simple randomisation has no blocks; leave them out")
            )
        for factor, levels in self.strata.items():
            if len(levels) < 2 or len(set(levels)) < len(levels):
                raise ValueError(
                    sentence("strata: {factor} needs two levels at least, each once", factor=factor)
                )
        if len(list(self.labels())) > MOST_LISTS:
            raise ValueError(
                sentence(
                    "strata: {count} combinations; at most {most} are allowed",
                    count=len(list(self.labels())),
                    most=MOST_LISTS,
                )
            )
        return self

    def labels(self) -> Iterator[str]:
        """Yield the name of each list: `level=first,year=2`; `all` without strata."""
        names = list(self.strata)
        for levels in product(*self.strata.values()):
            pairs = zip(names, levels, strict=True)
            yield ",".join(f"{name}={level}" for name, level in pairs) or "all"


class Visit(Strict):
    """When students come.

    Attributes:
        name: such as `pre`, `post`, `retention`.
        day: after enrolment, which is day 0.
        before: days that it may be earlier.
        after: days that it may be later.
        attempts: how many a student makes.
    """

    name: Name
    day: Annotated[int, Field(ge=0, le=3660)]
    before: Annotated[int, Field(ge=0, le=365)] = 0
    after: Annotated[int, Field(ge=0, le=365)] = 0
    attempts: Annotated[int, Field(ge=1, le=100)] = 1

    def holds(self, day: int) -> bool:
        """Return whether a day after enrolment lies in the window of this visit."""
        return self.day - self.before <= day <= self.day + self.after


class Consent(Strict):
    """What students consent to.

    Attributes:
        version: of the text.
        wording: the whole text.
    """

    version: Annotated[str, Field(min_length=1, max_length=40)]
    wording: Annotated[str, Field(min_length=1)]

    @property
    def digest(self) -> str:
        """Return the SHA-256 of the text, hexadecimal."""
        return hashlib.sha256(self.wording.encode()).hexdigest()


class Stopping(Strict):
    """When nobody is enrolled any more.

    Attributes:
        until: last day of enrolment; None without end.
        rule: in words, as the protocol has it.
    """

    until: datetime.date | None = None
    rule: str = ""


class ResearchDesign(Strict):
    """The design of a research study.

    Attributes:
        id: of the study.
        title: one line.
        question: what is asked.
        arms: two at least.
        participants: how many are enrolled at the most.
        randomisation: how students are allocated.
        blind_assessor: whether arms stay hidden from lists and tables until the data are locked.
        visits: in order of their days.
        consent: what students consent to.
        stopping: when nobody is enrolled any more.
        primary_outcome: metric by its name, or `score_total`.
        analysis_plan: in words, written before the data are seen.
    """

    id: Name
    title: Annotated[str, Field(min_length=1, max_length=120)]
    question: str = ""
    arms: tuple[Arm, ...]
    participants: Annotated[int, Field(ge=2, le=100_000)]
    randomisation: Randomisation = Randomisation()
    blind_assessor: bool = False
    visits: Annotated[tuple[Visit, ...], Field(min_length=1)]
    consent: Consent
    stopping: Stopping = Stopping()
    primary_outcome: str = "score_total"
    analysis_plan: str = ""

    @model_validator(mode="after")
    def _fits_together(self) -> ResearchDesign:
        _check_arms(self)
        _check_blocks(self)
        _check_visits(self.visits)
        return self

    @property
    def unit(self) -> int:
        """Return the sum of the arms' ratios: blocks are multiples of it."""
        return sum(arm.ratio for arm in self.arms)

    @property
    def block_sizes(self) -> tuple[int, ...]:
        """Return the sizes of blocks; without any given, twice and three times the ratios' sum."""
        return self.randomisation.block_sizes or (2 * self.unit, 3 * self.unit)

    def arm(self, name: str) -> Arm:
        """Return an arm by its name."""
        return next(arm for arm in self.arms if arm.name == name)

    def document(self) -> dict[str, Any]:
        """Return the design as a JSON-ready mapping."""
        return self.model_dump(mode="json")

    @property
    def digest(self) -> str:
        """Return the SHA-256 of what the design says, hexadecimal."""
        text = json.dumps(self.document(), sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(text.encode()).hexdigest()

    def visit_of(self, day: int) -> Visit | None:
        """Return the visit in whose window a day after enrolment lies; None in none."""
        return next((visit for visit in self.visits if visit.holds(day)), None)


def read_design(path: Path) -> ResearchDesign:
    """Read a design from its file.

    Raises:
        ConfigurationError: naming file, field, value and what would be valid.
    """
    return load(path, ResearchDesign)


def exercise_of(design: ResearchDesign, arm: Arm) -> Exercise:
    """Return the exercise that an arm does: that of the library, or one changed from it.

    A changed one is named after study and place of the arm, not after what the arm is.

    Raises:
        ExerciseError: if there is no such exercise.
        ValueError: if it cannot be changed so; says why.
    """
    exercise = load_exercise(arm.exercise)
    absent = [name for name in arm.without_effects if name not in exercise.effects]
    if absent:
        raise ValueError(
            sentence(
                "{exercise} has no effect {effect!r}; it has {effects}",
                exercise=exercise.id,
                effect=absent[0],
                effects=", ".join(exercise.effects) or "none",
            )
        )
    if not arm.changes_exercise:
        return exercise
    kept = dict(exercise.effects)
    reasons = dict(exercise.without)
    for name in arm.without_effects:
        kept.pop(name)
        reasons[name] = "the arm of a research study does without it"
    changes: dict[str, Any] = {
        "id": f"{design.id}-{design.arms.index(arm) + 1}",
        "version": 1,
        "effects": kept,
        "without": reasons,
    }
    if arm.assistance is not None:
        changes |= {"assistance": arm.assistance, "fading": None}
    return Exercise.model_validate(exercise.model_dump(by_alias=True) | changes)


def design_problems(design: ResearchDesign) -> list[str]:
    """Say which exercises of the arms cannot be done, one line each; none if all can."""
    found: list[str] = []
    for arm in design.arms:
        try:
            exercise_of(design, arm)
        except (AcusError, ValueError) as error:
            found.append(sentence("arm {arm}: {reason}", arm=arm.name, reason=error))
    return found


def _check_arms(design: ResearchDesign) -> None:
    counts = Counter(arm.name for arm in design.arms)
    twice = [name for name, count in counts.items() if count > 1]
    if twice:
        raise ValueError(
            sentence("arms: two are called {name!r}: give each a name of its own", name=twice[0])
        )
    if len(design.arms) < 2:
        raise ValueError(sentence("arms: a study compares two at least"))
    empty = [arm.name for arm in design.arms if arm.ratio == 0]
    if empty:
        raise ValueError(
            sentence(
                "arms: {name!r} has ratio 0, so no student would be in it: give it 1 or more, or "
                "leave it out",
                name=empty[0],
            )
        )
    if design.participants < design.unit:
        raise ValueError(
            sentence(
                "participants: {n} are fewer than the arms' ratios need: at least {least}",
                n=design.participants,
                least=design.unit,
            )
        )


def _check_blocks(design: ResearchDesign) -> None:
    for size in design.randomisation.block_sizes:
        if size % design.unit:
            ratios = ":".join(str(arm.ratio) for arm in design.arms)
            raise ValueError(
                sentence(
                    "block_sizes: {size} does not fit arms of {ratios}: take a multiple of {unit}",
                    size=size,
                    ratios=ratios,
                    unit=design.unit,
                )
            )


def _check_visits(visits: tuple[Visit, ...]) -> None:
    names = [visit.name for visit in visits]
    if len(set(names)) < len(names):
        raise ValueError(sentence("visits: two have one name"))
    for earlier, later in pairwise(visits):
        if earlier.day + earlier.after >= later.day - later.before:
            raise ValueError(
                sentence(
                    "visits: the windows of {earlier} and {later} overlap, or stand in the wrong "
                    "order",
                    earlier=earlier.name,
                    later=later.name,
                )
            )
