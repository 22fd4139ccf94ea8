"""The script of one attempt: what the trainee's hand wants over time, made once from a seed.

Every movement is minimum-jerk from where the last one ended to where it wants to be (Flash and
Hogan 1985); a slow drift and a physiological tremor tile come on top. Directions are written as an
error (e1, e2) [rad] in the tangent plane of the path, so that the path itself is zero.
"""

from dataclasses import dataclass, replace
from enum import IntEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only, unit
from app.simulation.errors import SimulationError
from app.simulation.skill import Skill

STEP: Final = 0.005  # [s] between rows of the script
TREMOR_STEP: Final = 0.004  # [s] between rows of the tremor tile
TREMOR_ROWS: Final = 1000  # the tile lasts 4 s and repeats without a seam
ABOVE_SKIN: Final = -0.015  # [m] depth at which the hand hovers


class ScriptPhase(IntEnum):
    """What the trainee is doing, as in the slot TRAINEE_PHASE."""

    NONE = 0
    HOVER = 1
    ALIGN = 2
    INSERT = 3
    WITHDRAW = 4
    REDIRECT = 5
    CORRECT = 6
    HOLD = 7
    DONE = 9


@dataclass(frozen=True, slots=True, eq=False)
class TraineeScript:
    """An attempt at speed one.

    Attributes:
        rows: e1, e2 [rad], depth [m], phase every `STEP` seconds, shape (n, 4), read-only.
        tremor: e1, e2 [rad], depth [m] every `TREMOR_STEP` seconds, shape (TREMOR_ROWS, 3).
        basis: two world directions that span the tangent plane of the path, shape (2, 3).
    """

    rows: FloatArray
    tremor: FloatArray
    basis: FloatArray

    @property
    def duration(self) -> float:
        """Until the phase `DONE` [s]."""
        return (len(self.rows) - 1) * STEP


@dataclass(frozen=True, slots=True)
class _Move:
    """Minimum-jerk movement to an error and depth within `duration`."""

    phase: ScriptPhase
    duration: float
    error: tuple[float, float]
    depth: float


def write_script(axis: FloatArray, depth: float, skill: Skill, seed: int) -> TraineeScript:
    """Script an attempt on a target `depth` [m] beyond the fulcrum along `axis`, shape (3,).

    Raises:
        SimulationError: if the depth is not a finite length above zero.
    """
    if not (np.isfinite(depth) and depth > 0.0):
        raise SimulationError(f"the target lies at depth {depth} m; it must be above 0")
    random = np.random.default_rng([seed, 1])
    basis = tangent_basis(unit(axis, "axis"))
    moves = _moves(unit(axis, "axis"), basis, depth, skill, random)
    rows = _rows(moves)
    rows[:, :2] += _drift(rows, skill, random)
    return TraineeScript(read_only(rows), read_only(_tremor(skill, random)), read_only(basis))


def tangent_basis(axis: FloatArray) -> FloatArray:
    """Two unit vectors perpendicular to `axis` and each other, shape (2, 3)."""
    first = unit(np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))]))
    return np.stack([first, np.cross(axis, first)])


def _moves(
    axis: FloatArray, basis: FloatArray, depth: float, skill: Skill, random: np.random.Generator
) -> list[_Move]:
    start = _polar(random.uniform(*skill.start_error), _towards_vertical(axis, basis, random))
    around = float(random.uniform(0.0, 2.0 * np.pi))
    aim = _polar(random.uniform(*skill.aim_error), around)
    moves = [
        _Move(ScriptPhase.HOVER, skill.hover, start, ABOVE_SKIN),
        _Move(ScriptPhase.ALIGN, skill.align, aim, ABOVE_SKIN),
    ]
    for _ in range(skill.redirects):
        aim = _polar(random.uniform(*skill.final_error), around + random.normal(0.0, 0.5))
        moves += _redirect(moves[-1], aim, depth, skill, random)
    final = _polar(random.uniform(*skill.final_error), around)
    past = depth + float(random.uniform(*skill.overshoot))
    left = depth + float(random.choice([-1.0, 1.0]) * random.uniform(*skill.depth_error))
    moves.append(_insert(moves[-1], final, past, skill))
    moves.append(replace(moves[-1], phase=ScriptPhase.CORRECT, duration=0.6))
    moves.append(_Move(ScriptPhase.CORRECT, 1.0, final, left))
    moves.append(_Move(ScriptPhase.HOLD, skill.hold, final, left))
    return moves


def _redirect(
    last: _Move, aim: tuple[float, float], depth: float, skill: Skill, random: np.random.Generator
) -> list[_Move]:
    """Insert part of the way, see the error, withdraw most of it, turn."""
    partway = float(random.uniform(0.40, 0.55)) * depth
    back = 0.3 * partway
    return [
        _insert(last, last.error, partway, skill),
        _Move(ScriptPhase.INSERT, 0.8, last.error, partway),
        _Move(ScriptPhase.WITHDRAW, (partway - back) / skill.speed, last.error, back),
        _Move(ScriptPhase.REDIRECT, 2.0, aim, back),
    ]


def _insert(last: _Move, error: tuple[float, float], depth: float, skill: Skill) -> _Move:
    return _Move(ScriptPhase.INSERT, max(0.2, (depth - last.depth) / skill.speed), error, depth)


def _rows(moves: list[_Move]) -> FloatArray:
    here = np.array([*moves[0].error, moves[0].depth])
    parts = []
    for move in moves:
        s = np.arange(max(1, round(move.duration / STEP))) * STEP / move.duration
        there = np.array([*move.error, move.depth])
        ratio = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
        path = here + ratio[:, None] * (there - here)
        parts.append(np.column_stack([path, np.full(len(s), float(move.phase))]))
        here = there
    return np.vstack([*parts, [*here, float(ScriptPhase.DONE)]])


def _drift(rows: FloatArray, skill: Skill, random: np.random.Generator) -> FloatArray:
    """Slow wander of the direction that grows in as the needle enters, shape (n, 2)."""
    time = np.arange(len(rows)) * STEP
    frequencies = random.uniform(0.05, 0.3, (3, 2))
    phases = random.uniform(0.0, 2.0 * np.pi, (3, 2))
    waves = np.sin(2.0 * np.pi * frequencies * time[:, None, None] + phases).mean(axis=1)
    inside = np.clip(rows[:, 2] / 0.03, 0.0, 1.0)
    return skill.drift * (inside**2 * (3.0 - 2.0 * inside))[:, None] * waves


def _tremor(skill: Skill, random: np.random.Generator) -> FloatArray:
    """Band of 8-12 Hz with whole periods in the tile, unit variance before scaling."""
    period = TREMOR_ROWS * TREMOR_STEP
    cycles = np.arange(int(8.0 * period), int(12.0 * period) + 1)
    time = np.arange(TREMOR_ROWS) / TREMOR_ROWS
    angles = 2.0 * np.pi * cycles[:, None] * time
    waves = [
        np.sin(angles + random.uniform(0.0, 2.0 * np.pi, (len(cycles), 1))).sum(axis=0)
        for _ in range(3)
    ]
    scale = np.array([skill.tremor, skill.tremor, skill.tremor_depth])
    return np.stack(waves, axis=1) * np.sqrt(2.0 / len(cycles)) * scale


def _towards_vertical(axis: FloatArray, basis: FloatArray, random: np.random.Generator) -> float:
    """Angle in the tangent plane that leans the needle up rather than beyond the tilt limit."""
    down = basis @ np.array([0.0, 0.0, -1.0])
    if np.hypot(*down) < 0.05:  # nearly vertical: any way is inside the workspace
        return float(random.uniform(0.0, 2.0 * np.pi))
    return float(np.arctan2(down[1], down[0]) + random.uniform(-1.0, 1.0))


def _polar(radius: float, angle: float) -> tuple[float, float]:
    return float(radius * np.cos(angle)), float(radius * np.sin(angle))
