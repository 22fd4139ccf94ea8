"""What a score was made under, and whether two of them may be compared."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from enum import StrEnum
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence

DIAL_TOLERANCE: Final = 0.05
"""Dials of assistance that differ by no more than this count as the same: a twentieth of the way
from no guidance to all of it."""

PROGRAMS: Final = ("script", "arm")
"""Hands that are nobody's: the scripted trainee, and the simulated arm that carries out a plan."""


class DeviceKind(StrEnum):
    """What stood behind the needle."""

    REAL = "real"
    EMULATED = "emulated"
    SIMULATED = "simulated"
    PEN = "pen"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Assistance:
    """The dial over an attempt, -1 repels fully, 0 does nothing, 1 guides fully.

    Attributes:
        start: what the exercise sets; None where it is not known.
        least, most: over the attempt.
        mean: over the attempt, weighted by time.
    """

    start: float | None
    least: float
    most: float
    mean: float

    @property
    def moved(self) -> bool:
        """Return whether it was turned during the attempt."""
        return self.most - self.least > DIAL_TOLERANCE


@dataclass(frozen=True, slots=True)
class Conditions:
    """Everything that a score depends on besides the hand's skill; an empty value is not known.

    Attributes:
        exercise: id.
        version: of the exercise; 0 unknown.
        level: difficulty; 0 unknown.
        content: digest of what the exercise says; another one is another exercise.
        assistance: the dial; None where nothing was recorded of it.
        views: what was shown, sorted; None unknown.
        hand: what held the needle, one of `session.conditions.HANDS`.
        scripted: skill of the scripted trainee; empty for a person.
        kind: real, emulated or simulated robot, or a pen.
        device: name of its profile.
        ct: pseudonym of the CT.
        seed: of everything random.
        software: version that recorded it.
        calibration: id of the cameras' calibration; empty for simulated or uncalibrated ones.
        agreement_mm: distance within which screen and needle agreed at the target with 95 % when
            the attempt began; None where nobody had checked.
        scoring_version: of the rules that the score follows; 0 without a score.
        models: `effect: model`, each that was chosen while the attempt ran, sorted.
        taken_over: what held the needle from some moment on, after the arm; empty where nobody took
            it over.
        computer: how the computer was too slow, and what came of it; empty where it was not.
        drill: what alone was practised (`exercises.drill.DrillKind`); empty for a whole exercise.
        bands: hand by whose own bands it was judged; empty for the exercise's tolerances.
        bands_source: where these come from (`exercises.hand_bands.BandsSource`).
    """

    exercise: str
    version: int = 0
    level: int = 0
    content: str = ""
    assistance: Assistance | None = None
    views: tuple[str, ...] | None = None
    hand: str = ""
    scripted: str = ""
    kind: DeviceKind = DeviceKind.UNKNOWN
    device: str = ""
    ct: str = ""
    seed: int | None = None
    software: str = ""
    calibration: str = ""
    agreement_mm: float | None = None
    scoring_version: int = field(default=0)
    models: tuple[str, ...] = ()
    taken_over: str = ""
    computer: str = ""
    drill: str = ""
    bands: str = ""
    bands_source: str = ""

    @property
    def by_person(self) -> bool:
        """Return whether a person had the needle from begin to end: else the attempt is nobody's.

        Wherever attempts count for somebody (learning curves, boards, attempts that a course
        allows, assistance that fades, what comes next) this alone says whose they are. A drill is a
        person's, and counts for none of it: it is another exercise, see `drill`.
        """
        return not self.scripted and self.hand not in PROGRAMS

    @property
    def hands(self) -> str:
        """Return what held the needle, one after the other; empty where it is not known."""
        return f"{self.hand} then {self.taken_over}" if self.taken_over else self.hand

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        document = asdict(self)
        document["kind"] = self.kind.value
        document["views"] = None if self.views is None else list(self.views)
        document["models"] = list(self.models)
        for name in ("drill", "bands", "bands_source"):
            if not document[name]:
                del document[name]
        return document

    @classmethod
    def of(cls, document: Mapping[str, Any]) -> Conditions:
        """Read what `document` wrote; names that are not known are left out.

        Raises:
            ValueError, TypeError, KeyError: if it is no such document.
        """
        known = {f.name: document[f.name] for f in fields(cls) if f.name in document}
        dial, views = known.get("assistance"), known.get("views")
        known["exercise"] = str(document["exercise"])
        known["kind"] = DeviceKind(known.get("kind", DeviceKind.UNKNOWN))
        known["assistance"] = None if dial is None else _assistance(dial)
        known["views"] = None if views is None else tuple(str(view) for view in views)
        known["models"] = tuple(str(model) for model in known.get("models", ()))
        for name in ("version", "level", "scoring_version"):
            known[name] = int(known.get(name, 0))
        for name in _TEXTS:
            known[name] = str(known.get(name, ""))
        for name, kind in (("seed", int), ("agreement_mm", _number)):
            value = known.get(name)
            known[name] = None if value is None else kind(value)
        return cls(**known)


_TEXTS: Final = (
    *("content", "hand", "scripted", "device", "ct", "software", "calibration"),
    *("taken_over", "computer", "drill", "bands", "bands_source"),
)


def comparable(a: Conditions, b: Conditions) -> tuple[str, ...]:
    """Say why two scores may not be compared, one reason each; empty if they may.

    This alone decides it, wherever attempts meet: lists, curves, exports. Seed, software and the
    calibration's id are told but part no scores: noise, and programs that score alike, are the same
    task. What one of two records does not say counts as different only where it would matter most:
    the device, and the dial.
    """
    return tuple(reason for reason in _reasons(a, b) if reason)


def comparison_groups(attempts: Sequence[Conditions | None]) -> list[int | None]:
    """Return each attempt's group, as `comparable` decides: that of the first one it fits.

    Groups count from 1 in the order of their first attempt; None has none.
    """
    known = [one for one in attempts if one is not None]
    tasks: dict[Conditions, int] = {}
    codes, dial = [], []
    for one in known:
        task = replace(
            one,
            assistance=None,
            seed=None,
            software="",
            calibration="",
            agreement_mm=None,
            computer="",
        )
        codes.append(tasks.setdefault(task, len(tasks)))
        set_to = one.assistance
        values = (
            (None,) * 4
            if set_to is None
            else (set_to.mean, set_to.least, set_to.most, set_to.start)
        )
        dial.append([math.nan if value is None else value for value in values])
    found = iter(groups_of_tasks(list(tasks), np.array(codes, int), np.array(dial).reshape(-1, 4)))
    return [None if one is None else int(next(found)) for one in attempts]


def groups_of_tasks(
    tasks: Sequence[Conditions], codes: NDArray[np.int64], dial: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Return each attempt's group: as `comparison_groups`, of attempts as columns.

    The first attempt that is in no group yet begins one, and all that fit it follow; so each is in
    the first group that it fits. Two that are alike are in one, whatever `comparable` says of them.

    Args:
        tasks: conditions without dial and what parts no scores.
        codes: which of them each attempt was made under, shape (n,).
        dial: mean, least, most and start of each; NaN where not known, shape (n, 4).
    """
    groups = np.zeros(len(codes), np.int64)
    left = np.arange(len(codes))
    told = ~np.isnan(dial[:, 0])
    alike = np.nan_to_num(dial, nan=math.inf)
    while len(left):
        first = left[0]
        task = tasks[codes[first]]
        fits = np.array([not comparable(task, other) for other in tasks])
        near = (np.abs(dial[left, :3] - dial[first, :3]) <= DIAL_TOLERANCE).all(axis=1)
        same = (codes[left] == codes[first]) & (alike[left] == alike[first]).all(axis=1)
        near = near if told[first] else ~told[left]
        joins = same | (fits[codes[left]] & near)
        groups[left[joins]] = groups.max() + 1
        left = left[~joins]
    return groups


def _reasons(a: Conditions, b: Conditions) -> tuple[str, ...]:
    return (
        sentence("one of them has no score")
        if not (a.scoring_version and b.scoring_version)
        else "",
        _differ("exercise", a.exercise, b.exercise),
        _differ("version of the exercise", a.version, b.version),
        _differ("level", a.level, b.level) if a.level and b.level else "",
        sentence("the exercise says something else under the same version")
        if a.content and b.content and a.content != b.content
        else "",
        _differ("scored by version", a.scoring_version, b.scoring_version)
        if a.scoring_version and b.scoring_version
        else "",
        _dials(a.assistance, b.assistance),
        _differ("views", ", ".join(a.views), ", ".join(b.views))
        if a.views is not None and b.views is not None
        else "",
        _differ("hand", a.hand, b.hand),
        _differ("scripted trainee", a.scripted, b.scripted),
        _differ("taken over by", a.taken_over, b.taken_over),
        _differ("bands", a.bands, b.bands),
        sentence("what robot it was is not known of one of them")
        if DeviceKind.UNKNOWN in (a.kind, b.kind)
        else _differ("robot", a.kind.value, b.kind.value),
        _differ("device", a.device, b.device),
        _differ("models chosen meanwhile", ", ".join(a.models), ", ".join(b.models)),
        "another CT" if a.ct and b.ct and a.ct != b.ct else "",
    )


def _differ(name: str, a: object, b: object) -> str:
    return "" if a == b else f"{name}: {a or 'none'} and {b or 'none'}"


def _dials(a: Assistance | None, b: Assistance | None) -> str:
    if a is None or b is None:
        return "" if a is b else sentence("what the assistance was is not known of one of them")
    for name, x, y in (
        ("assistance, over time", a.mean, b.mean),
        ("least assistance", a.least, b.least),
        ("most assistance", a.most, b.most),
    ):
        if abs(x - y) > DIAL_TOLERANCE:
            return f"{name}: {x:.2f} and {y:.2f}"
    return ""


def _assistance(document: Mapping[str, Any]) -> Assistance:
    start = document["start"]
    least, most, mean = (_number(document[name]) for name in ("least", "most", "mean"))
    return Assistance(None if start is None else _number(start), least, most, mean)


def _number(value: Any) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(sentence("{entry!r} is no number", entry=value))
    return number
