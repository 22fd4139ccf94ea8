"""An attempt at an exercise by somebody who wants its points, as numbers and as a script.

Every gene lies in 0 ... 1, and 0.5 is what an honest hand does. A gene whose honest value is its
least (nothing covered, no detour) does nothing below 0.5.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from math import ceil
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.units import DEGREE, MILLIMETRE
from app.simulation.trainee import (
    ABOVE_SKIN,
    TREMOR_ROWS,
    WAITING,
    Move,
    ScriptPhase,
    TraineeScript,
    rows_of,
    tangent_basis,
)

Aim = tuple[float, float, float]
"""A place for the tip: turned off the path (e1, e2) [rad], depth [m]."""

QUICKEST: Final = 0.1
"""No movement takes less [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Attack:
    """What is tried; the defaults are what an honest hand does.

    Attributes:
        entry_1_mm, entry_2_mm: how far the entry is moved along the skin, where the student plans.
        tilt_1_deg, tilt_2_deg: the needle off its path, at the end.
        speed_mm_s: of every way in and out.
        end_mm: where the tip is left, beyond the target.
        past_mm: how far it goes beyond that first.
        hover_s, align_s, dwell_s: time before the skin, to turn there, and at the end.
        detours: ways in another direction before the last one, each drawn back from; rounded up.
        detour_1_deg, detour_2_deg, detour_mm: direction and depth of these.
        back_mm: depth to which it is drawn back; below 0 out of the body.
        leaves: above 0 the needle is drawn out before the end.
        dial: the robot's help, where it may be turned.
        views_hidden: above 0 the student hides all views, where he may.
        covered_from, covered_share: when both cameras are covered, in shares of the attempt.
        covered_astray: above 0 they are covered on all detours.
    """

    entry_1_mm: float = 0.0
    entry_2_mm: float = 0.0
    tilt_1_deg: float = 0.0
    tilt_2_deg: float = 0.0
    speed_mm_s: float = 12.0
    end_mm: float = 0.0
    past_mm: float = 0.0
    hover_s: float = 1.0
    align_s: float = 3.0
    dwell_s: float = 3.0
    detours: float = 0.0
    detour_1_deg: float = 0.0
    detour_2_deg: float = 0.0
    detour_mm: float = 50.0
    back_mm: float = 5.0
    leaves: float = 0.0
    dial: float = 0.5
    views_hidden: float = 0.0
    covered_from: float = 0.3
    covered_share: float = 0.0
    covered_astray: float = 0.0

    @classmethod
    def of(cls, genes: Sequence[float]) -> Attack:
        """Return what genes mean, one for each of `GENES`, each 0 ... 1."""
        values = {}
        for (name, (low, high)), gene in zip(RANGES.items(), genes, strict=True):
            honest, bent = HONEST[name], (2.0 * gene - 1.0) ** (3 if name in FINE else 1)
            values[name] = honest + bent * (high - honest if bent > 0.0 else honest - low)
        return cls(**values)

    def words(self) -> str:
        """Name what is not as an honest hand does it."""
        changed = [
            f"{name} {getattr(self, name):.3g}"
            for name in GENES
            if abs(getattr(self, name) - HONEST[name]) > 0.02 * (RANGES[name][1] - RANGES[name][0])
        ]
        return ", ".join(changed) or "nothing out of the ordinary"

    def covered(self, script: TraineeScript) -> tuple[tuple[float, float], ...]:
        """Return when the cameras are covered while a script is played: (from, to) [s]."""
        windows = []
        if self.covered_share > 0.0:
            begin = self.covered_from * script.duration
            windows.append((begin, begin + self.covered_share * script.duration))
        turns = np.flatnonzero(script.rows[:, 3] == ScriptPhase.REDIRECT)
        if self.covered_astray > 0.0 and len(turns):
            windows.append((float(turns[0]) * script.row, float(turns[-1]) * script.row))
        return tuple(windows)

    def script(self, axis: FloatArray, aims: Sequence[Aim], deepest: float) -> TraineeScript:
        """Script it.

        Args:
            axis: direction of the path, hub to tip, shape (3,).
            aims: what is to be reached one after the other: the target of a needle, or targets.
            deepest: depth that the machine reaches [m].
        """
        rows = rows_of(self._moves(aims, deepest))
        still = np.zeros((TREMOR_ROWS, 3))
        return TraineeScript(read_only(rows), read_only(still), read_only(tangent_basis(axis)))

    def _moves(self, aims: Sequence[Aim], deepest: float) -> list[Move]:
        off = np.array([self.tilt_1_deg, self.tilt_2_deg]) * DEGREE
        beside = np.array([self.detour_1_deg, self.detour_2_deg]) * DEGREE
        back = min(self.back_mm * MILLIMETRE, deepest)
        turned = _pair(np.array(aims[0][:2]) + off)
        moves = [
            Move(ScriptPhase.HOVER, max(QUICKEST, self.hover_s), turned, ABOVE_SKIN),
            Move(ScriptPhase.ALIGN, max(QUICKEST, self.align_s), turned, ABOVE_SKIN),
        ]
        for _ in range(ceil(self.detours)):
            astray = _pair(np.array(turned) + beside)
            partway = float(np.clip(self.detour_mm * MILLIMETRE, back, deepest))
            moves.append(self._way(ScriptPhase.REDIRECT, moves[-1], astray, moves[-1].depth))
            moves.append(self._way(ScriptPhase.INSERT, moves[-1], astray, partway))
            moves.append(self._way(ScriptPhase.WITHDRAW, moves[-1], astray, back))
            moves.append(self._way(ScriptPhase.REDIRECT, moves[-1], turned, back))
        for e1, e2, depth in aims:
            there = _pair(np.array([e1, e2]) + off)
            left = float(np.clip(depth + self.end_mm * MILLIMETRE, ABOVE_SKIN, deepest))
            past = min(left + self.past_mm * MILLIMETRE, deepest)
            moves.append(self._way(ScriptPhase.INSERT, moves[-1], there, past))
            if past > left:
                moves.append(self._way(ScriptPhase.CORRECT, moves[-1], there, left))
            moves.append(Move(ScriptPhase.HOLD, max(QUICKEST, self.dwell_s), there, left))
        last = moves[-1]
        if self.leaves > 0.0:
            moves.append(self._way(ScriptPhase.WITHDRAW, last, last.error, ABOVE_SKIN))
        moves.append(Move(ScriptPhase.WAIT, WAITING, moves[-1].error, moves[-1].depth))
        return moves

    def _way(
        self, phase: ScriptPhase, last: Move, error: tuple[float, float], depth: float
    ) -> Move:
        """Go from where the last move ended, as fast as this attack moves; turning is way."""
        turn = float(np.hypot(error[0] - last.error[0], error[1] - last.error[1]))
        way = abs(depth - last.depth) + turn * max(abs(last.depth), abs(ABOVE_SKIN))
        speed = max(self.speed_mm_s, 0.5) * MILLIMETRE
        return Move(phase, max(QUICKEST, way / speed), error, depth)


RANGES: Final[Mapping[str, tuple[float, float]]] = {
    "entry_1_mm": (-40.0, 40.0),
    "entry_2_mm": (-40.0, 40.0),
    "tilt_1_deg": (-12.0, 12.0),
    "tilt_2_deg": (-12.0, 12.0),
    "speed_mm_s": (1.0, 250.0),
    "end_mm": (-130.0, 30.0),
    "past_mm": (0.0, 50.0),
    "hover_s": (0.2, 15.0),
    "align_s": (0.2, 15.0),
    "dwell_s": (0.2, 30.0),
    "detours": (0.0, 3.0),
    "detour_1_deg": (-30.0, 30.0),
    "detour_2_deg": (-30.0, 30.0),
    "detour_mm": (2.0, 130.0),
    "back_mm": (-15.0, 60.0),
    "leaves": (0.0, 1.0),
    "dial": (-1.0, 1.0),
    "views_hidden": (0.0, 1.0),
    "covered_from": (0.0, 1.0),
    "covered_share": (0.0, 1.0),
    "covered_astray": (0.0, 1.0),
}
"""Gene -> least and most of what it stands for."""

GENES: Final = tuple(RANGES)

FINE: Final = frozenset(
    ("entry_1_mm", "entry_2_mm", "tilt_1_deg", "tilt_2_deg", "speed_mm_s", "end_mm", "past_mm")
)
"""Genes whose cube counts: small changes are tried as often as large ones."""

GROUPS: Final = (
    ("entry_1_mm", "entry_2_mm"),
    ("tilt_1_deg", "tilt_2_deg"),
    ("speed_mm_s", "hover_s", "align_s", "dwell_s"),
    ("end_mm", "past_mm", "leaves"),
    ("detours", "detour_1_deg", "detour_2_deg", "detour_mm", "back_mm"),
    ("dial",),
    ("views_hidden",),
    ("covered_from", "covered_share", "covered_astray"),
)
"""Tricks: genes that do something together."""

_HONEST_ATTACK: Final = Attack()
HONEST: Final[Mapping[str, float]] = {name: getattr(_HONEST_ATTACK, name) for name in GENES}


def honest_genes() -> FloatArray:
    """Return the genes of an honest attempt, shape (number of genes,)."""
    return np.full(len(GENES), 0.5)


def open_tricks(shut: Collection[str]) -> tuple[tuple[int, ...], ...]:
    """Numbers of the genes that an exercise leaves open, trick by trick."""
    numbers = (tuple(GENES.index(name) for name in one if name not in shut) for one in GROUPS)
    return tuple(one for one in numbers if one)


def _pair(values: FloatArray) -> tuple[float, float]:
    return float(values[0]), float(values[1])
