"""Where the needle was in the patient at every moment of an attempt, and beside which others.

The debrief replays it in slices, 3D and bull's-eye. Beside it stands a ghost: the ideal path, or
another attempt that may be compared, at the same time or at the same depth.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.bend import Bend, needle_curve
from app.core.units import MILLIMETRE
from app.planning.needle_overlay import NeedleOverlay
from app.planning.off_path import Offset, offset, path_to
from app.planning.placement import PlacedPlan
from app.scoring.conditions import Conditions, comparable
from app.session.machine import State
from app.session.needle import FROM_CAMERAS
from app.session.samples import Samples

if TYPE_CHECKING:
    from app.session.index import Indexed
    from app.session.recording import Recording

NEEDLE_LENGTH: Final = 0.15
"""Length of the drawn shaft [m] where the record's profile does not tell it."""

_BEFORE: Final = (State.READY.value, State.WITHDRAWING.value)

Rows = NDArray[np.intp]


class Alignment(StrEnum):
    """By what an attempt and its ghost are brought together."""

    TIME = "time"
    DEPTH = "depth"


@dataclass(frozen=True, slots=True, eq=False)
class NeedleMotion:
    """The needle over n samples of an attempt; SI, world, read-only.

    Attributes:
        time: since the first sample [s], shape (n,).
        measured: whether the cameras vouch for the depth, shape (n,).
        depth: of the tip [m], shape (n,); NaN where the pose was not valid.
        tip: bent or not [m], shape (n, 3), likewise.
        axis: direction at the fulcrum, hub to tip, shape (n, 3), likewise.
        target: with its motion [m], shape (n, 3).
        felt: force at the hub point [N], shape (n, 3).
        bend: numbers of `core.bend.Bend`, shape (n, 10); None where the needle is always straight.
        placed: the plan.
        length: of the needle [m].
        begin: first row of the attempt itself; before it the needle was only taken out.
        last: row at which the needle's depth was measured last in the attempt; where it ended.
    """

    time: FloatArray
    measured: NDArray[np.bool_]
    depth: FloatArray
    tip: FloatArray
    axis: FloatArray
    target: FloatArray
    felt: FloatArray
    bend: FloatArray | None
    placed: PlacedPlan
    length: float
    begin: int
    last: int

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.time)

    @property
    def end(self) -> float:
        """Time of the last sample [s]."""
        return float(self.time[-1]) if len(self) else 0.0

    def row(self, time: float) -> int:
        """Return the sample nearest to a time [s]; the first or last one beyond the ends."""
        if not len(self):
            return 0
        after = int(np.searchsorted(self.time, time))
        if after == 0 or after == len(self):
            return min(after, len(self) - 1)
        return after - int(time - self.time[after - 1] <= self.time[after] - time)

    def needle(self, row: int) -> NeedleOverlay | None:
        """Return the needle in the patient at a sample, bent where tissue bent it.

        Where nobody measured the depth only the line is known: it ends at the entry and is not
        valid. None where not even that is known.
        """
        axis = self.axis[row]
        if not np.isfinite(axis).all():
            return None
        T = self.placed.T_world_patient
        tip = self.tip[row]
        if not self.measured[row] or not np.isfinite(tip).all():
            return NeedleOverlay.of_world(self.placed.p_entry, axis, self.length, T, valid=False)
        bent = self._bend(row)
        curve = None
        if bent is not None and self.depth[row] > 0.0:
            curve = needle_curve(tip, axis, float(self.depth[row]), bent)
        return NeedleOverlay.of_world(tip, axis, self.length, T, curve=curve)

    def ideal(self, row: int) -> NeedleOverlay | None:
        """Return the straight needle on the path to the target, as deep as the own one."""
        depth = float(self.depth[row])
        if not self.measured[row] or not np.isfinite(depth):
            return None
        path = path_to(self.placed, self.target[row])
        tip = self.placed.p_entry + depth * path
        return NeedleOverlay.of_world(tip, path, self.length, self.placed.T_world_patient)

    def ending(self) -> Offset | None:
        """How far from the target, as it was then, the needle ended; None if nobody measured it."""
        if not len(self) or not self.measured[self.last]:
            return None
        row = self.last
        return offset(self.tip[row], self.axis[row], self.placed, self.target[row])

    def target_mm(self, row: int) -> FloatArray | None:
        """Return the target as it was at a sample, LPS [mm]; None while it is at rest."""
        there = self.target[row]
        if not np.isfinite(there).all() or np.array_equal(there, self.placed.p_target):
            return None
        found: FloatArray = (self.placed.T_world_patient.inverse() @ there) / MILLIMETRE
        return found

    def _bend(self, row: int) -> Bend | None:
        return None if self.bend is None else Bend.of_numbers(self.bend[row])


def motion_of(recording: Recording) -> NeedleMotion:
    """Return the motion that a record holds.

    Raises:
        BrokenRecordingError: if the record holds no plan.
    """
    return motion(recording.samples, recording.placed_plan(), needle_length(recording))


def motion(samples: Samples, placed: PlacedPlan, length: float = NEEDLE_LENGTH) -> NeedleMotion:
    """Return the motion of samples with their plan, of a needle of a length [m]."""
    time = samples.time - samples.time[0] if len(samples.time) else samples.time
    measured = samples.valid & np.isin(samples.depth_source, FROM_CAMERAS)
    measured &= np.isfinite(samples.depth)
    begun = np.flatnonzero(~np.isin(samples.state, _BEFORE))
    seen = np.flatnonzero(measured)
    return NeedleMotion(
        time=read_only(time),
        measured=read_only(measured),
        depth=samples.depth,
        tip=samples.tip,
        axis=samples.axis,
        target=samples.target,
        felt=samples.felt,
        bend=samples.bend,
        placed=placed,
        length=length,
        begin=int(begun[0]) if len(begun) else 0,
        last=int(seen[-1]) if len(seen) else max(0, len(time) - 1),
    )


def needle_length(recording: Recording) -> float:
    """Length of the needle [m] by the recorded device profile."""
    try:
        said = json.loads(recording.attachments["device.json"])["geometry"]["needle_length"]
        length = float(said)
    except (KeyError, TypeError, ValueError, RecursionError):
        return NEEDLE_LENGTH
    return length if 0.0 < length < 10.0 else NEEDLE_LENGTH


def rows_beside(own: NeedleMotion, other: NeedleMotion, by: Alignment) -> Rows:
    """Return for each sample of an attempt the sample of another one that belongs beside it.

    By time both begin together. By depth it is the moment at which the other needle first came as
    deep: in the body only, as outside it nothing is deeper.

    Returns:
        Shape (n,); -1 where the other attempt was over, or never came as deep, or by depth outside.
    """
    if not len(own) or not len(other):
        return np.full(len(own), -1, dtype=np.intp)
    if by is Alignment.TIME:
        wanted = own.time - own.time[own.begin] + other.time[other.begin]
        rows = np.searchsorted(other.time, wanted - 0.5 * _step(other)).astype(np.intp)
        rows[rows >= len(other)] = -1
        return rows
    usable = other.measured.copy()
    usable[: other.begin] = False
    deepest = np.maximum.accumulate(np.where(usable, other.depth, -np.inf))
    wanted = np.where(own.measured, own.depth, np.nan)
    rows = np.searchsorted(deepest, np.nan_to_num(wanted, nan=np.inf)).astype(np.intp)
    rows[(rows >= len(other)) | ~own.measured | ~(wanted >= 0.0)] = -1
    return rows


def _step(motion: NeedleMotion) -> float:
    return float(np.median(np.diff(motion.time))) if len(motion) > 1 else 0.0


def beside(values: FloatArray, rows: Rows) -> FloatArray:
    """Return what another attempt's values were at the rows beside one's own; NaN without one."""
    found = np.full(len(rows), np.nan)
    there = rows >= 0
    found[there] = values[rows[there]]
    return found


def rivals(
    attempts: Sequence[Indexed],
    shown: str,
    under: Conditions,
    whose: Callable[[str], bool],
    open_to: Callable[[Indexed], bool],
) -> tuple[Indexed, ...]:
    """Return the attempts that may stand beside one: own best first, then the others, best first.

    Those that `scoring.conditions.comparable` lets meet, scored and not altered.

    Args:
        attempts: of the index.
        shown: id of the attempt that they are to stand beside.
        under: what that one was made under.
        whose: whether whom a record names is who made that one.
        open_to: whether an attempt may be shown to who is here.
    """
    if not under.scoring_version:
        under = _scored(under, attempts)
    found = [
        one
        for one in attempts
        if one.id != shown
        and one.total is not None
        and one.verdict != "altered"
        and not comparable(under, one.conditions)
        and open_to(one)
    ]
    return tuple(sorted(found, key=lambda one: (not whose(one.student), -(one.total or 0.0))))


def _scored(under: Conditions, attempts: Sequence[Indexed]) -> Conditions:
    """Let an attempt without a score meet those of the newest rules: its path may be looked at."""
    newest = max((one.conditions.scoring_version for one in attempts), default=0)
    return replace(under, scoring_version=newest)
