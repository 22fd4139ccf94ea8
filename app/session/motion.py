"""Where the needle was in the patient at every moment of an attempt, and beside which others.

The debrief replays it in slices, 3D and bull's-eye. Beside it stands a ghost: the ideal path, or
another attempt that may be compared, at the same time or at the same depth.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from app.core import paths
from app.core.arrays import FloatArray, read_only
from app.core.bend import Bend, needle_curve
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.transform import rotation_between
from app.core.units import MILLIMETRE
from app.planning.needle_overlay import NeedleOverlay
from app.planning.off_path import Offset, offset, path_to
from app.planning.placement import PlacedPlan
from app.scoring.conditions import Conditions, comparable
from app.session.errors import SessionError
from app.session.machine import State
from app.session.needle import FROM_CAMERAS
from app.session.samples import Samples

if TYPE_CHECKING:
    from app.session.index import Indexed
    from app.session.recording import Recording
    from app.simulation.trainee import TraineeScript

NEEDLE_LENGTH: Final = 0.15
"""Length of the drawn shaft [m] where the record's profile does not tell it."""

SHOWN_EVERY: Final = 0.02
"""Time between the samples that are kept of an attempt to be shown [s]."""

_SHOWN: Final = ("time", "axis", "depth", "path")

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
        """Return how far from the target, as it was then, the needle ended; None if nobody measured
        it.
        """
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


@dataclass(frozen=True, slots=True, eq=False)
class ShownMotion:
    """How the needle was led in the attempt that an instructor chose to be shown.

    It is the demonstration of its exercise, in place of the scripted expert. Nothing of the record
    but the movement is kept: no name, no score; the attempt may be erased and the movement stay.

    Attributes:
        exercise: id.
        version: of the exercise; another one is shown by the expert.
        time: of the samples [s], shape (n,).
        axis: needle directions in world, shape (n, 3).
        depth: of the tip [m], shape (n,).
        path: direction of the path then, shape (3,).
    """

    exercise: str
    version: int
    time: FloatArray
    axis: FloatArray
    depth: FloatArray
    path: FloatArray

    @classmethod
    def of(cls, motion: NeedleMotion, exercise: str, version: int) -> ShownMotion:
        """Take the part of an attempt in which the cameras saw the needle, at `SHOWN_EVERY`.

        Raises:
            SessionError: if the needle was seen for less than a second.
        """
        rows = np.flatnonzero(motion.measured & np.isfinite(motion.axis).all(axis=1))
        rows = rows[rows >= motion.begin]
        kept: list[int] = []
        for row in rows.tolist():
            if not kept or motion.time[row] - motion.time[kept[-1]] >= SHOWN_EVERY - 1e-9:
                kept.append(row)
        if not kept or motion.time[kept[-1]] - motion.time[kept[0]] < 1.0:
            raise SessionError(
                sentence("the cameras saw the needle for less than a second of this attempt")
            )
        path = motion.placed.axis
        return cls(
            exercise, version, motion.time[kept], motion.axis[kept], motion.depth[kept], path
        )

    @classmethod
    def kept(cls, exercise: str, version: int) -> ShownMotion | None:
        """Return what was chosen for an exercise; None for the scripted expert.

        Another version's movement is none, and so is a file that cannot be used: the expert shows
        the exercise then.
        """
        try:
            said = json.loads(_shown_file(exercise).read_bytes())
            arrays = [np.array(said[key], dtype=np.float64) for key in _SHOWN]
            if said["format"] != 1 or said["exercise"] != exercise or said["version"] != version:
                return None
        except (OSError, SessionError, KeyError, TypeError, ValueError, RecursionError):
            return None
        time, axis, depth, path = arrays
        shapes = axis.shape == (*time.shape, 3) and depth.shape == time.shape == (len(time),)
        usable = shapes and path.shape == (3,) and all(np.isfinite(one).all() for one in arrays)
        if not usable or len(time) < 2 or not (np.diff(time) > 0.0).all():
            return None
        return cls(exercise, version, time, axis, depth, path)

    def save(self) -> None:
        """Keep it as the demonstration of its exercise; replaces one that was chosen before.

        Raises:
            OSError: if it cannot be written.
            SessionError: if the record names no identifier of an exercise.
        """
        document = {"format": 1, "exercise": self.exercise, "version": self.version} | {
            key: np.round(getattr(self, key), 7).tolist() for key in _SHOWN
        }
        write_atomically(_shown_file(self.exercise), json.dumps(document).encode())

    def script(self, placed: PlacedPlan) -> TraineeScript:
        """Script the movement about a plan: turned with the path, should that lie otherwise now."""
        from app.simulation.trainee import traced_script  # compiled: for who shows it

        turn = rotation_between(self.path, placed.axis)
        return traced_script(self.time, self.axis @ turn.T, self.depth, placed.axis)


def show_expert(exercise: str) -> None:
    """Let the scripted expert show an exercise again.

    Raises:
        OSError: if the file cannot be removed.
        SessionError: if that is no identifier of an exercise.
    """
    _shown_file(exercise).unlink(missing_ok=True)


def _shown_file(exercise: str) -> Path:
    if not re.fullmatch(r"[a-z0-9][a-z0-9-]{0,63}", exercise):
        raise SessionError(
            sentence("{exercise!r} is no identifier of an exercise", exercise=exercise)
        )
    return paths.data() / "demonstrations" / f"{exercise}.json"


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

    Those that `scoring.conditions.comparable` lets meet, scored and vouched for by this station.

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
        and one.stands
        and one.verdict != "altered"
        and not comparable(under, one.conditions)
        and open_to(one)
    ]
    return tuple(sorted(found, key=lambda one: (not whose(one.student), -(one.total or 0.0))))


def _scored(under: Conditions, attempts: Sequence[Indexed]) -> Conditions:
    """Let an attempt without a score meet those of the newest rules: its path may be looked at."""
    newest = max((one.conditions.scoring_version for one in attempts), default=0)
    return replace(under, scoring_version=newest)
