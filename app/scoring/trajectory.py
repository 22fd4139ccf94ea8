"""The attempt as arrays over time: everything that metrics may look at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.planning.judged import JudgedPlan
from app.planning.off_path import Offset, offset
from app.planning.placement import PlacedPlan
from app.scoring.complications.marks import ComplicationMarks
from app.scoring.errors import MetricNotAskedError, MetricUnavailableError, TrajectoryError
from app.scoring.met import Met
from app.scoring.procedure import ProcedureMarks
from app.scoring.risks import RiskMark
from app.scoring.scans import ScanMark
from app.scoring.touches import Touches
from app.scoring.version import SCORING_VERSION

LAST_SEEN = 1.0
"""The tip counts as known at the end if the cameras saw it within this time before [s]."""

LARGEST = 1e9
"""No time [s], place [m] or force [N] of an attempt lies beyond this; squares stay finite."""


class Phase(IntEnum):
    """State of the attempt at a sample; the lower-case names are those of the state machine."""

    READY = 0
    ALIGNING = 1
    INSERTING = 2
    HOLDING = 3
    ENDED = 4
    ABORTED = 5
    PAUSED = 6


_CODES = {phase.name.lower(): phase.value for phase in Phase}


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Trajectory:
    """One attempt, n samples, all in `world`, SI; arrays are read-only copies.

    Attributes:
        placed: the plan in world.
        time: monotonic time, strictly rising [s], shape (n,).
        tip: needle tip [m], shape (n, 3).
        axis: needle direction, hub to tip, unit vectors, shape (n, 3).
        depth: tip beyond the fulcrum along the axis [m], shape (n,).
        felt: force at the hub point after all limits [N], shape (n, 3); None where nothing can
            push: a pen before a webcam.
        phase: state of the attempt, given as names (`aligning`, ...) or as `Phase`, shape (n,).
        depth_valid: whether the depth came from the cameras, at most 0.2 s ago, shape (n,).
        hub: hub point P_u, where the hand is [m], shape (n, 3); None if not recorded.
        guide: share of the virtual fixture in the force at the hub point [N], shape (n, 3); None if
            not recorded.
        target_shift: displacement of the target from its place at rest [m], shape (n, 3); None if
            it does not move.
        aborted: why the attempt was aborted; empty if it was not.
        scans: control scans, in order.
        risks: structures that the needle had to keep away from, and how near it came.
        excused: time of pauses that the program itself caused, which cost nothing [s].
        spread: standard deviations of the tip along the needle and across it [m] when its picture
            was taken, and age of the picture [s], shape (n, 3), NaN without one; None if not known.
        agreement: within this screen and needle agreed at the target with 95 % [m]; 0 where nobody
            had to check.
        clamped: whether the force was at the robot's limit, shape (n,); None if not known.
        touches: targets that were to be touched; None where there were none.
        met: what the needle met in the patient; None where nothing could tell.
        planned: what a planner says of the path that the student chose; None where it was given, or
            nothing could tell.
        procedure: steps of the intervention; None where the exercise has none.
        computer: time of pauses because the computer was too slow for its simulated cameras [s].
        scoring_version: of the rules that it is measured by (`scoring.version`).
        seen_from: from this depth of the tip on the cameras see the marker wherever the needle
            leans [m]; infinite where that is not known.

    Raises:
        TrajectoryError: naming the array and the first bad sample.
    """

    placed: PlacedPlan
    time: FloatArray
    tip: FloatArray
    axis: FloatArray
    depth: FloatArray
    felt: FloatArray | None
    phase: NDArray[np.int8]
    depth_valid: NDArray[np.bool_]
    hub: FloatArray | None = None
    guide: FloatArray | None = None
    target_shift: FloatArray | None = None
    aborted: str = ""
    scans: tuple[ScanMark, ...] = ()
    risks: tuple[RiskMark, ...] = ()
    excused: float = 0.0
    spread: FloatArray | None = None
    agreement: float = 0.0
    clamped: NDArray[np.bool_] | None = None
    touches: Touches | None = None
    met: tuple[Met, ...] | None = None
    planned: JudgedPlan | None = None
    procedure: ProcedureMarks | None = None
    computer: float = 0.0
    scoring_version: int = SCORING_VERSION
    seen_from: float = np.inf

    def __post_init__(self) -> None:
        time = _samples(self.time, "time", None, ())
        n = len(time)
        _check_time(time)
        values: dict[str, Any] = {"time": time, "depth": _samples(self.depth, "depth", n, ())}
        for name in ("tip", "axis", "felt", "hub", "guide", "target_shift"):
            if getattr(self, name) is not None:
                values[name] = _samples(getattr(self, name), name, n, (3,))
        _check_axis(values["axis"])
        values["phase"] = _phases(self.phase, n)
        values["depth_valid"] = _flags(self.depth_valid, n)
        if self.clamped is not None:
            values["clamped"] = _flags(self.clamped, n)
        if self.spread is not None:
            values["spread"] = _spread(self.spread, n)
        if not 0.0 <= self.agreement <= LARGEST:
            raise TrajectoryError(
                sentence(
                    "agreement is {agreement} m; it must be 0 or more", agreement=self.agreement
                )
            )
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.time)

    @property
    def running(self) -> NDArray[np.bool_]:
        """Samples between begin and end, shape (n,)."""
        return (self.phase >= Phase.ALIGNING) & (self.phase <= Phase.HOLDING)

    @property
    def inserted(self) -> NDArray[np.bool_]:
        """Samples with the needle in the body (inserting or holding), shape (n,)."""
        return (self.phase == Phase.INSERTING) | (self.phase == Phase.HOLDING)

    @property
    def paused(self) -> NDArray[np.bool_]:
        """Samples while the attempt waited, for the cameras or the window, shape (n,)."""
        return self.phase == Phase.PAUSED

    @property
    def waited(self) -> float:
        """Return how long it waited for the cameras [s]."""
        return max(0.0, self.duration(self.paused) - self.excused)

    @property
    def was_aborted(self) -> bool:
        """Return whether the attempt was broken off."""
        return bool(self.aborted) or bool((self.phase == Phase.ABORTED).any())

    def forces(self) -> FloatArray:
        """Return `felt`, shape (n, 3).

        Raises:
            MetricUnavailableError: if nothing can push.
        """
        if self.felt is None:
            raise MetricUnavailableError(sentence("no robot held the needle: there is no force"))
        return self.felt

    def pushed(self) -> NDArray[np.bool_]:
        """Find the samples whose force counts: all of the attempt, pauses included, shape (n,).

        Also where nobody knew how deep the needle was: the hand felt the force all the same.

        Raises:
            MetricUnavailableError: if the needle was never inserted.
        """
        self.insertions()
        return self.running | self.paused

    def insertions(self) -> list[slice]:
        """Stretches with the needle in the body and the attempt running, in order.

        A pause ends one: the force is off in it. Where the needle went is asked of `stays`.

        Raises:
            MetricUnavailableError: if there is none.
        """
        found = runs(self.inserted)
        if not found:
            raise MetricUnavailableError(sentence("the needle was never inserted"))
        return found

    def stays(self) -> list[NDArray[np.intp]]:
        """Find the samples of each stay in the body, in order.

        A pause ends none, as the needle stays where it is while the cameras are waited for; its own
        samples are left out.

        Raises:
            MetricUnavailableError: if there is none.
        """
        self.insertions()
        stays = [np.arange(stay.start, stay.stop) for stay in runs(self._in_body())]
        return [stay[~self.paused[stay]] for stay in stays]

    def measured_stays(self) -> list[NDArray[np.intp]]:
        """Find the samples with a measured depth in each stay in the body.

        A path is measured through these: between them, where the cameras did not see the marker,
        the tip is a guess and its jumps are not the student's.

        Raises:
            MetricUnavailableError: if there is none.
        """
        seen = [stay[self.depth_valid[stay]] for stay in self.stays()]
        found = [stay for stay in seen if len(stay)]
        if not found:
            raise MetricUnavailableError(
                sentence("the depth of the tip was not measured in the body")
            )
        return found

    def longest_part(self, stay: NDArray[np.intp]) -> NDArray[np.intp]:
        """Return the longest part of a stay that no pause broke: what has a pace."""
        pauses = np.cumsum(self.paused)[stay]
        parts = np.split(stay, np.flatnonzero(np.diff(pauses)) + 1)
        return max(parts, key=lambda part: float(self.time[part[-1]] - self.time[part[0]]))

    def tissues_met(self) -> tuple[Met, ...]:
        """Return what the needle met.

        Raises:
            MetricNotAskedError: if nothing could tell: there was no tissue field.
        """
        if self.met is None:
            raise MetricNotAskedError(sentence("no tissue field told what the needle met"))
        return self.met

    def steps(self) -> ProcedureMarks:
        """Return the steps of the intervention.

        Raises:
            MetricNotAskedError: if the exercise has none.
        """
        if self.procedure is None:
            raise MetricNotAskedError(sentence("the exercise asks for no steps of a procedure"))
        return self.procedure

    def complications(self) -> ComplicationMarks:
        """Return the complications of the intervention.

        Raises:
            MetricNotAskedError: if none can happen in the exercise.
        """
        if self.procedure is None or self.procedure.complications is None:
            raise MetricNotAskedError(sentence("no complication can happen in this exercise"))
        return self.procedure.complications

    def to_touch(self) -> Touches:
        """Return the targets that were to be touched.

        Raises:
            MetricNotAskedError: if there were none.
        """
        if self.touches is None:
            raise MetricNotAskedError(sentence("nothing was to be touched"))
        return self.touches

    def touching(self) -> NDArray[np.intp]:
        """Find the samples from the first entry into the body to the last touch, shape (n,).

        Raises:
            MetricNotAskedError: if nothing was to be touched.
            MetricUnavailableError: if nothing was touched.
        """
        times = self.to_touch().times
        if not times:
            raise MetricUnavailableError(sentence("no target was touched"))
        return np.arange(self.insertions()[0].start, self.at(times[-1]) + 1)

    def final(self) -> int:
        """Index of the sample that the result is read from: the last one with a measured depth.

        Where the patient is turned at the end, the needle is out by then: it is read from where
        the last sample was taken.

        Raises:
            MetricUnavailableError: if the needle was not in the body at the end, or not seen for
                more than `LAST_SEEN` before it.
        """
        self.insertions()
        body = self._in_body()
        end = int(np.flatnonzero(self.running | self.paused)[-1])
        turning = None if self.procedure is None else self.procedure.turning
        if turning is not None and turning.last is not None:
            end = min(end, self.at(turning.last))
            body = body & (np.arange(len(self)) <= end)
        if not body[end]:
            raise MetricUnavailableError(sentence("the needle was out of the body at the end"))
        seen = np.flatnonzero(self.depth_valid & body)
        if len(seen) == 0:
            raise MetricUnavailableError(sentence("the depth of the tip was never measured"))
        age = float(self.time[end] - self.time[seen[-1]])
        if age > LAST_SEEN:
            raise MetricUnavailableError(
                sentence("the tip was last seen {age:.1f} s before the end", age=age)
            )
        return int(seen[-1])

    def at(self, time: float) -> int:
        """Index of the sample at a moment [s], or the next one; the last if there is none."""
        return min(int(np.searchsorted(self.time, time)), len(self) - 1)

    def _in_body(self) -> NDArray[np.bool_]:
        """Find the samples in the body; a pause counts as what it interrupted."""
        last = np.maximum.accumulate(np.where(self.paused, -1, np.arange(len(self))))
        body: NDArray[np.bool_] = (last >= 0) & self.inserted[last]
        return body

    def target(self, index: int) -> FloatArray:
        """Return where the target is at a sample [m], shape (3,): at rest plus its displacement.

        Where a control scan showed it fallen back with the lung, the nearer to the tip of the two
        places: no lot costs anybody.
        """
        place = self.placed.p_target
        if self.target_shift is not None:
            place = place + self.target_shift[index]
        marks = None if self.procedure is None else self.procedure.complications
        fallen = None if marks is None else marks.fallen(float(self.time[index]))
        if fallen is None:
            return place
        tip = self.tip[index]
        other = np.asarray(place + fallen)
        return other if np.linalg.norm(tip - other) < np.linalg.norm(tip - place) else place

    def offset(self, index: int) -> Offset:
        """Return how far the needle of a sample is from the target and off the path, as they were
        then.
        """
        return offset(self.tip[index], self.axis[index], self.placed, self.target(index))

    def duration(self, mask: NDArray[np.bool_]) -> float:
        """Time [s] covered by the samples in `mask`: each counts until the next one."""
        return float(np.diff(self.time)[mask[:-1]].sum())


def runs(mask: NDArray[np.bool_]) -> list[slice]:
    """Stretches of True, in order."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(np.int8)))
    return [slice(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def _samples(values: ArrayLike, name: str, n: int | None, shape: tuple[int, ...]) -> FloatArray:
    array = np.array(values, dtype=np.float64)
    if array.size == 0:
        array = array.reshape(0, *shape)
    wanted = (len(array) if n is None and array.ndim else n, *shape)
    if array.shape != wanted:
        raise TrajectoryError(
            sentence(
                "{name} has shape {array_shape}; {wanted} is needed, as time has it",
                name=name,
                array_shape=array.shape,
                wanted=wanted,
            )
        )
    flat = array.reshape(len(array), int(np.prod(shape)))
    bad = ~(np.abs(flat) <= LARGEST).all(axis=1)  # NaN is not below anything
    if bad.any():
        first = int(np.argmax(bad))
        raise TrajectoryError(
            sentence(
                "{name} is not finite within ±{largest:g} in {bad} of {samples} samples, "
                "first at sample {first}: {array}; leave such samples out",
                name=name,
                largest=LARGEST,
                bad=bad.sum(),
                samples=len(array),
                first=first,
                array=array[first].tolist(),
            )
        )
    return read_only(array)


def _spread(values: ArrayLike, n: int) -> FloatArray:
    """Take deviations and ages; NaN where one of them is no such number."""
    array = np.array(values, dtype=np.float64)
    if array.shape != (n, 3):
        raise TrajectoryError(
            sentence(
                "spread has shape {array_shape}; ({n}, 3) is needed, as time has it",
                array_shape=array.shape,
                n=n,
            )
        )
    array[~((array >= 0.0) & (array <= LARGEST)).all(axis=1)] = np.nan
    return read_only(array)


def _check_time(time: FloatArray) -> None:
    steps = np.diff(time)
    if (steps <= 0.0).any():
        first = int(np.argmax(steps <= 0.0))
        what = "stands still" if steps[first] == 0.0 else "goes backwards"
        raise TrajectoryError(
            sentence(
                "time {fault} at sample {first}: {time} s after {previous_time} s",
                fault=what,
                first=first + 1,
                time=time[first + 1],
                previous_time=time[first],
            )
        )


def _check_axis(axis: FloatArray) -> None:
    off = np.abs(np.einsum("ij,ij->i", axis, axis) - 1.0)
    if (off > 1e-6).any():
        first = int(np.argmax(off > 1e-6))
        raise TrajectoryError(
            sentence(
                "axis {axis} at sample {first} is no unit vector",
                axis=axis[first].tolist(),
                first=first,
            )
        )


def _phases(values: Sequence[Any] | NDArray[Any], n: int) -> NDArray[np.int8]:
    given = np.asarray(values)
    if given.size == 0:
        codes = np.zeros(0, dtype=np.int8)
    elif given.dtype.kind in "US":
        names, index = np.unique(given.astype(str), return_inverse=True)
        unknown = [name for name in names if name not in _CODES]
        if unknown:
            raise TrajectoryError(
                sentence(
                    "unknown phase '{unknown_name}'; phases are {codes}",
                    unknown_name=unknown[0],
                    codes=", ".join(_CODES),
                )
            )
        codes = np.array([_CODES[name] for name in names], dtype=np.int8)[index]
    elif given.dtype.kind in "iu" and given.min() >= 0 and given.max() < len(_CODES):
        codes = given.astype(np.int8)
    else:
        raise TrajectoryError(
            sentence(
                "phase must be names or codes of Phase 0 ... {largest_code}",
                largest_code=len(_CODES) - 1,
            )
        )
    if codes.shape != (n,):
        raise TrajectoryError(
            sentence(
                "phase has shape {codes_shape}; ({n},) is needed, as time has it",
                codes_shape=codes.shape,
                n=n,
            )
        )
    return read_only(codes)


def _flags(values: ArrayLike, n: int) -> NDArray[np.bool_]:
    flags = np.array(values, dtype=np.bool_)
    if flags.size == 0:
        flags = flags.reshape(0)
    if flags.shape != (n,):
        raise TrajectoryError(
            sentence(
                "depth_valid has shape {flags_shape}; ({n},) is needed",
                flags_shape=flags.shape,
                n=n,
            )
        )
    return read_only(flags)
