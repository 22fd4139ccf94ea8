"""What a study is, and what comes out of running one: frozen values.

A study compares ways to compute the same thing over several settings, each against a reference.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from app.core.messages import sentence
from app.studies.errors import StudyError
from app.studies.findings import Findings


@dataclass(frozen=True, slots=True)
class Setting:
    """One case of a study: a name for people and the values that make it."""

    name: str
    values: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Prepared:
    """A way made ready for a setting: nothing that need not be timed is left.

    Attributes:
        run: does the work `calls` times and returns the result of one.
        calls: how often `run` does the work, so that a call of nanoseconds can be timed.
    """

    run: Callable[[], Any]
    calls: int = 1


@dataclass(frozen=True, slots=True)
class Case:
    """A setting made ready.

    Attributes:
        data: what the ways work on.
        error: result of a way -> its error against the reference, in the study's unit.
        perception: error that a person notices in this setting, in the study's unit.
    """

    data: Any
    error: Callable[[Any], float]
    perception: float


@dataclass(frozen=True, slots=True)
class Way:
    """One way to compute it.

    Attributes:
        name: unique in the study.
        family: ways of one family differ by their resolution only, and share colour and marker.
        prepare: makes the way ready for a case.
        description: one line.
        used: what the program would call were this its way: a function, class or name, or a tuple
            of these and what it is set to; None for what only the study has.
    """

    name: str
    family: str
    prepare: Callable[[Case], Prepared]
    description: str = ""
    used: object = None


@dataclass(frozen=True, slots=True)
class Limit:
    """A line in the picture: its value (seconds, or the unit of the error) and what it means."""

    value: float
    label: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Study:
    """Ways against a reference.

    Attributes:
        name, title, question, reference: as the file's declaration says; the runner fills them in.
        error_label: of the axis, with unit.
        ways, settings: what is run; names are unique.
        case: makes a setting ready; of a study that borrows, `case(setting, *lent)`.
        deadline: time that the work may take [s].
        perception: error that a person notices.
        default: name of the way that the program uses.
        because: why, in a sentence.
        exception: why the default is not what `rule.sweet_spot` finds; empty where it is.
        in_use: finds what the program really calls, to be compared with the default's `used`; None
            for a study of the user's own. Of one that borrows, `in_use(*lent)`.
        borrows: what it needs from rooms above, which it may not import: `module:name` each.
            Whoever runs it lends them (`acus study` does).
        findings: further tables and pictures, made after the points; none if left out.
    """

    name: str = ""
    title: str = ""
    question: str = ""
    reference: str = ""
    error_label: str
    ways: tuple[Way, ...]
    settings: tuple[Setting, ...]
    case: Callable[..., Case]
    deadline: Limit
    perception: Limit
    default: str
    because: str = ""
    exception: str = ""
    in_use: Callable[..., object] | None = None
    borrows: tuple[str, ...] = ()
    findings: Callable[[], Findings] | None = None

    def __post_init__(self) -> None:
        for kind, items in (("way", self.ways), ("setting", self.settings)):
            names = [item.name for item in items]
            if not names or len(set(names)) != len(names):
                raise StudyError(
                    sentence(
                        "study {name}: each {kind} needs a name of its own: {names}",
                        name=self.name,
                        kind=kind,
                        names=names,
                    )
                )
        ways = [way.name for way in self.ways]
        if self.default not in ways:
            raise StudyError(
                sentence(
                    "study {name}: its default {default!r} is no way; there are {ways}",
                    name=self.name,
                    default=self.default,
                    ways=", ".join(ways),
                )
            )


@dataclass(frozen=True, slots=True)
class Point:
    """One way in one setting.

    Attributes:
        error: in the study's unit.
        seconds: median processor time of one call.
        noticed: the error from which on a person notices it in this setting.
    """

    way: str
    family: str
    setting: str
    error: float
    seconds: float
    within_perception: bool
    within_deadline: bool
    noticed: float = float("nan")


@dataclass(frozen=True, slots=True)
class Failure:
    """A way that gave no answer in a setting, and why."""

    way: str
    setting: str
    reason: str


@dataclass(frozen=True, slots=True)
class Result:
    """All points of a study; failures stand beside them, never left out. `findings` are further
    tables and pictures of studies that have some.
    """

    study: Study
    points: tuple[Point, ...]
    failures: tuple[Failure, ...] = field(default=())
    findings: Findings | None = None

    def summary(self) -> tuple[Point, ...]:
        """Return each way at its worst: largest error, longest time, limits kept everywhere."""
        return tuple(
            _worst([p for p in self.points if p.way == way.name])
            for way in self.study.ways
            if any(p.way == way.name for p in self.points)
        )

    def too_coarse(self) -> tuple[str, ...]:
        """Names of ways whose error is noticed in some setting."""
        return tuple(p.way for p in self.summary() if not p.within_perception)

    def too_slow(self) -> tuple[str, ...]:
        """Names of ways that miss the deadline in some setting."""
        return tuple(p.way for p in self.summary() if not p.within_deadline)


def _worst(points: list[Point]) -> Point:
    worst = max(points, key=lambda p: p.error)
    return Point(
        worst.way,
        worst.family,
        worst.setting,
        worst.error,
        max(p.seconds for p in points),
        all(p.within_perception for p in points),
        all(p.within_deadline for p in points),
        worst.noticed,
    )


def duration(seconds: float) -> str:
    """Write a time in the unit that suits it: `1.40 µs`."""
    for scale, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if seconds >= scale:
            return f"{seconds / scale:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"
