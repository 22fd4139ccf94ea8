"""Steps of a procedure written into a scripted hand's way: stops for what is done at them.

A script brings the needle to its target; here its rows are made to stop short of the pleura, to go
in once before with the needle for local anaesthetic, and to stay for the samples. What is done at a
stop is done by whoever runs the attempt, which is told by the phase (`StopPhase`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import IntEnum

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.simulation.electrode_script import DRAWN
from app.simulation.errors import SimulationError
from app.simulation.trainee import ABOVE_SKIN, ScriptPhase, TraineeScript


class StopPhase(IntEnum):
    """What a script stands still for, beyond `ScriptPhase`, as in the slot TRAINEE_PHASE."""

    INJECT = 10
    """Local anaesthetic is given."""
    CHANGE = 11
    """Out of the body, another needle is taken."""
    SAMPLE = 12
    """Samples are taken."""
    TURN = 13
    """The needle is out, and the patient is turned."""


@dataclass(frozen=True, slots=True)
class Stops:
    """Where a script stops, and for how long.

    Attributes:
        anaesthetic: depth of the deposit [m]; None for none.
        before: depth at which it pauses before the membrane [m]; None for no pause.
        pause: for how long [s].
        sampling: how long it stays for samples [s]; 0 for none.
        speed: of the needle for local anaesthetic [m/s].
        turning: how long it stays with the needle out after the samples [s]; 0 leaves it in.

    Raises:
        SimulationError: if a number is not finite or negative.
    """

    anaesthetic: float | None = None
    before: float | None = None
    pause: float = 4.0
    sampling: float = 0.0
    speed: float = 0.012
    turning: float = 0.0

    def __post_init__(self) -> None:
        stays = (self.pause, self.sampling, self.turning)
        numbers = (self.anaesthetic or 0.0, self.before or 0.0, *stays)
        if not all(np.isfinite(number) and number >= 0.0 for number in (*numbers, self.speed)):
            raise SimulationError(sentence("a script cannot stop at {stops}", stops=str(self)))


def with_stops(script: TraineeScript, stops: Stops) -> TraineeScript:
    """Return a script that stops where it shall; what lies between stays as it is."""
    rows = script.rows
    if stops.before is not None:
        rows = _paused(rows, stops.before, round(stops.pause / script.row))
    if stops.sampling > 0.0:
        rows = _sampling(rows, round(stops.sampling / script.row))
    if stops.turning > 0.0:
        rows = withdrawn(rows, stops.turning, script.row, StopPhase.TURN)
    if stops.anaesthetic is not None:
        rows = _anaesthetic(rows, stops, script.row)
    return replace(script, rows=read_only(np.ascontiguousarray(rows)))


def _paused(rows: FloatArray, depth: float, count: int) -> FloatArray:
    """Stand still where the last way in first comes to a depth."""
    below = rows[:, 2] < depth
    reached = np.flatnonzero(below[:-1] & ~below[1:])
    if not len(reached):
        return rows
    at = int(reached[-1]) + 1
    return np.insert(rows, at, np.repeat(rows[at - 1 : at], count, axis=0), axis=0)


def _sampling(rows: FloatArray, count: int) -> FloatArray:
    """Stay at the end of the way, before the hand waits for the end of the attempt."""
    waits = np.flatnonzero(rows[:, 3] == ScriptPhase.WAIT)
    at = int(waits[0]) if len(waits) else len(rows) - 1
    stay = np.repeat(rows[at - 1 : at], count, axis=0)
    stay[:, 3] = float(StopPhase.SAMPLE)
    return np.insert(rows, at, stay, axis=0)


def withdrawn(rows: FloatArray, duration: float, row: float, phase: IntEnum) -> FloatArray:
    """Draw the needle out before the hand waits for the end, and stand still in a phase.

    Args:
        rows: of a script, shape (n, 4).
        duration: for which it stands still outside [s].
        row: time between two rows [s].
        phase: in which it does.
    """
    waits = np.flatnonzero(rows[:, 3] == ScriptPhase.WAIT)
    at = int(waits[0]) if len(waits) else len(rows) - 1
    last = rows[at - 1]
    way = max(0.5, (float(last[2]) - ABOVE_SKIN) / DRAWN)
    s = np.minimum((np.arange(max(1, round(way / row))) + 1.0) * row / way, 1.0)
    out = np.repeat(last[None], len(s), axis=0)
    out[:, 2] += s**3 * (10.0 - 15.0 * s + 6.0 * s**2) * (ABOVE_SKIN - last[2])
    out[:, 3] = float(ScriptPhase.WITHDRAW)
    stay = np.repeat(out[-1:], max(1, round(duration / row)), axis=0)
    stay[:, 3] = float(phase)
    rest = rows[at:].copy()
    rest[:, :3] = out[-1, :3]
    return np.vstack([rows[:at], out, stay, rest])


def _anaesthetic(rows: FloatArray, stops: Stops, row: float) -> FloatArray:
    """Go in to the deposit and out again once the needle is aligned."""
    inserts = np.flatnonzero(rows[:, 3] == ScriptPhase.INSERT)
    at = int(inserts[0]) if len(inserts) else len(rows) - 1
    aim, depth = rows[at - 1, :2], float(stops.anaesthetic or 0.0)
    way = max(0.5, (depth - ABOVE_SKIN) / stops.speed)
    parts: Sequence[tuple[float, float, float, float]] = (
        (rows[at - 1, 2], depth, way, float(ScriptPhase.INSERT)),
        (depth, depth, 3.0, float(StopPhase.INJECT)),
        (depth, ABOVE_SKIN, way, float(ScriptPhase.WITHDRAW)),
        (ABOVE_SKIN, ABOVE_SKIN, 3.0, float(StopPhase.CHANGE)),
        (ABOVE_SKIN, rows[at - 1, 2], 0.5, float(ScriptPhase.ALIGN)),
    )
    pieces = []
    for begin, end, duration, phase in parts:
        s = np.arange(max(1, round(duration / row))) * row / duration
        ratio = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
        depths = begin + ratio * (end - begin)
        pieces.append(np.column_stack([np.tile(aim, (len(s), 1)), depths, np.full(len(s), phase)]))
    return np.insert(rows, at, np.vstack(pieces), axis=0)
