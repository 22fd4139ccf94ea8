"""An attempt in the frame of its path: how deep, how far off and to which side, moment by moment.

Only what was recorded and measured is in it: a moment that no camera vouches for has no place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.units import DEGREE, MILLIMETRE
from app.planning.off_path import angles, path_to, split
from app.planning.placement import PlacedPlan
from app.session.machine import COUNTING, IN_BODY, State
from app.session.needle import FROM_CAMERAS
from app.session.samples import Samples

BODY: Final = tuple(state.value for state in IN_BODY)
RUNS: Final = tuple(state.value for state in COUNTING)

GAP_S: Final = 0.5
"""What nobody measured for longer than this [s] parts what was before from what was after."""

AT_SKIN_MM: Final = 10.0
"""A stay in the body whose first measured depth is larger tells nothing of the skin [mm]; nor does
one of which nobody measured the beginning."""

Rows = NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class AlongPath:
    """n samples of an attempt, read-only; NaN where nobody measured.

    Attributes:
        time: since the first sample [s], shape (n,).
        state: of the attempt, shape (n,), text.
        depth_mm: of the tip, shape (n,).
        across_mm: from the path to the tip, in the patient (LPS), shape (n, 3).
        off_mm: its length, shape (n,).
        remaining_mm: way to the target along the path, negative once too deep, shape (n,).
        tilt_deg: between needle and path, shape (n,).
        lean: where the needle's direction leans to from the path, in the patient (LPS), shape
            (n, 3), its length the sine of the tilt.
        shift_mm: of the target from its place in the CT, shape (n,); 0 for one at rest.
        force_n: at the hub point, shape (n,).
    """

    time: FloatArray
    state: NDArray[np.str_]
    depth_mm: FloatArray
    across_mm: FloatArray
    off_mm: FloatArray
    remaining_mm: FloatArray
    tilt_deg: FloatArray
    lean: FloatArray
    shift_mm: FloatArray
    force_n: FloatArray

    @classmethod
    def of(cls, samples: Samples, placed: PlacedPlan) -> AlongPath:
        """Turn samples with their plan into the frame of the path as it was at each of them."""
        n = len(samples.time)
        target = np.where(np.isfinite(samples.target), samples.target, placed.p_target)
        target = target.reshape(n, 3)
        path = np.broadcast_to(path_to(placed, target), (n, 3))
        seen = samples.valid & np.isin(samples.depth_source, FROM_CAMERAS)
        seen &= np.isfinite(samples.depth) & np.isfinite(samples.tip).all(axis=1)
        across, remaining = split(samples.tip - target, path)
        to_patient = placed.T_world_patient.rotation  # rows times this are turned back
        lean = samples.axis - path * np.sum(samples.axis * path, axis=1, keepdims=True)
        with np.errstate(over="ignore"):  # a number that is too large is none
            across_mm = np.where(seen[:, None], across @ to_patient / MILLIMETRE, np.nan)
            force = np.linalg.norm(samples.felt, axis=1)
        return cls(
            time=read_only(samples.time - (samples.time[0] if n else 0.0)),
            state=samples.state,
            depth_mm=read_only(np.where(seen, samples.depth / MILLIMETRE, np.nan)),
            across_mm=read_only(across_mm),
            off_mm=read_only(np.linalg.norm(across_mm, axis=1)),
            remaining_mm=read_only(np.where(seen, remaining / MILLIMETRE, np.nan)),
            tilt_deg=read_only(angles(samples.axis, path) / DEGREE),
            lean=read_only(lean @ to_patient),
            shift_mm=read_only(np.linalg.norm(target - placed.p_target, axis=1) / MILLIMETRE),
            force_n=read_only(np.where(np.isfinite(force), force, np.nan)),
        )

    @property
    def seen(self) -> NDArray[np.bool_]:
        """Return which samples have a measured place, shape (n,)."""
        return np.isfinite(self.depth_mm) & np.isfinite(self.off_mm)

    def stay(self) -> Rows:
        """Return the samples of the last stay in the body; a pause ends none; empty without one."""
        out = np.flatnonzero(self.state == State.ALIGNING.value)
        body = np.flatnonzero(np.isin(self.state, BODY))
        before = out[out < body[-1]] if len(body) else out
        return body[body > before[-1]] if len(body) and len(before) else body

    def measured_stay(self) -> Rows:
        """Return those of the last stay whose place is known."""
        stay = self.stay()
        return stay[self.seen[stay]]

    def measured_to_end(self) -> Rows:
        """Return those of the last stay and of its pauses whose place is known.

        A needle may be pushed while the attempt waits; where it ended is the last of these.
        """
        stay = self.stay()
        if not len(stay):
            return stay
        states = self.state[stay[0] :]
        rows = stay[0] + np.flatnonzero(np.isin(states, (*BODY, State.PAUSED.value)))
        return rows[self.seen[rows]]

    def at_skin(self) -> int | None:
        """Return the sample at which the last stay began; None where nobody saw it begin.

        A stay that begins with the end of a pause began somewhere within it.
        """
        stay = self.stay()
        if not len(stay):
            return None
        first = int(stay[0])
        if first and self.state[first - 1] == State.PAUSED.value:
            return None
        seen = stay[self.seen[stay]][:1]
        soon = len(seen) and self.time[seen[0]] - self.time[first] <= GAP_S
        begins = soon and self.depth_mm[seen[0]] <= AT_SKIN_MM
        return first if begins and np.isfinite(self.tilt_deg[first]) else None

    def worst_stretch(self, limit_mm: float) -> Rows:
        """Return the samples in a row that were farther off the line than a limit, of the last
        stay.

        Of several stretches that in which the needle was farthest off; empty where there is none.
        """
        rows = self.measured_stay()
        beyond = self.off_mm[rows] > limit_mm
        parted = np.diff(self.time[rows], prepend=self.time[rows][:1]) > GAP_S
        number = np.cumsum(parted | (np.diff(beyond, prepend=beyond[:1]) != 0))
        if not beyond.any():
            return rows[:0]
        peak = int(np.argmax(np.where(beyond, self.off_mm[rows], -np.inf)))
        return rows[number == number[peak]]

    def pushed(self) -> tuple[FloatArray, FloatArray]:
        """Return each measured step deeper in the body [mm], and the target's shift then [mm].

        The rule is that of the metric `breath_offset`: between two measured places of one stay in
        the body the needle was pushed as far as they lie apart, whatever lay between.

        Both have the same shape, (m,).
        """
        rows = np.flatnonzero(np.isin(self.state, BODY) & self.seen)
        stays = np.cumsum(self.state == State.ALIGNING.value)[rows]  # of another, another number
        steps = np.diff(self.depth_mm[rows])
        deeper = (steps > 0.0) & (np.diff(stays) == 0)
        return steps[deeper], self.shift_mm[rows[1:]][deeper]

    def lasted(self) -> dict[str, float]:
        """Return the time spent in each state of an attempt that runs [s]."""
        spans = np.diff(self.time, append=self.time[-1:])
        spans = np.where(np.isfinite(spans) & (spans > 0.0), spans, 0.0)
        return {state: float(spans[self.state == state].sum()) for state in RUNS}
