"""Electrodes one after another in a scripted hand's way: in, left in place, out, and to the next.

Each way is a script of its own, about the same path; what the next electrode's path is turned from
it is added. What is done at a stop is done by whoever runs the attempt, who is told by the phase.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from enum import IntEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.simulation.trainee import ABOVE_SKIN, ScriptPhase, TraineeScript, tangents


class ElectrodePhase(IntEnum):
    """What a script stands still for, beyond `ScriptPhase` and `StopPhase`."""

    PLACE = 20
    """An electrode is left in place."""
    ABLATE = 21
    """The generator is started."""


PLACING: Final = 4.0
ABLATING: Final = 4.0
"""The hand stands still for so long, until its electrode holds, and until all is ablated [s]."""

DRAWN: Final = 0.02
"""Speed at which the robot's needle is drawn back [m/s]."""

TURNED: Final = 2.0
"""Time in which the hand turns to the next path [s]."""


def one_after_another(
    scripts: Sequence[TraineeScript], axes: FloatArray, axis: FloatArray
) -> TraineeScript:
    """Return a script that plays several, each to its own electrode.

    Args:
        scripts: of each electrode, all about `axis`, so that their bases are one.
        axes: path of each electrode, shape (n, 3).
        axis: that they are played about, shape (3,).
    """
    first = scripts[0]
    turned = np.column_stack(tangents(np.asarray(axes), axis, first.basis))
    pieces: list[FloatArray] = []
    for number, (script, turn) in enumerate(zip(scripts, turned, strict=True)):
        rows = script.rows.copy()
        rows[:, :2] += turn
        waits = np.flatnonzero(rows[:, 3] == ScriptPhase.WAIT)
        end = int(waits[0]) if len(waits) else len(rows) - 1
        if pieces:
            pieces.append(_moved(pieces[-1][-1], rows[0, :3], TURNED, ScriptPhase.ALIGN, first.row))
        pieces += [rows[:end], _still(rows[end - 1], PLACING, ElectrodePhase.PLACE, first.row)]
        out = np.array([*rows[end - 1, :2], ABOVE_SKIN])
        way = max(0.5, (rows[end - 1, 2] - ABOVE_SKIN) / DRAWN)
        pieces.append(_moved(rows[end - 1], out, way, ScriptPhase.WITHDRAW, first.row))
        if number == len(scripts) - 1:
            last = pieces[-1][-1]
            pieces.append(_still(last, ABLATING, ElectrodePhase.ABLATE, first.row))
            rest = rows[end:].copy()
            rest[:, :3] = last[:3]
            pieces.append(rest)
    return replace(first, rows=read_only(np.ascontiguousarray(np.vstack(pieces))))


def _still(row: FloatArray, duration: float, phase: IntEnum, step: float) -> FloatArray:
    stay = np.repeat(row[None], max(1, round(duration / step)), axis=0)
    stay[:, 3] = float(phase)
    return np.asarray(stay)


def _moved(
    begin: FloatArray, end: FloatArray, duration: float, phase: IntEnum, step: float
) -> FloatArray:
    s = (np.arange(max(1, round(duration / step))) + 1.0) * step / duration
    s = np.minimum(s, 1.0)
    ratio = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
    places = begin[:3] + ratio[:, None] * (end[:3] - begin[:3])
    return np.column_stack([places, np.full(len(s), float(phase))])
