"""The scripted trainee as a stage of the tick: plays a script into HAND_* and TRAINEE_PHASE.

It runs on TIME since the attempt was armed, so a run is the same on every machine and at every
rate; it begins afresh with every attempt, from where the hand is: what the script's beginning lies
off it is taken out along a minimum-jerk curve while the script hovers.

Where the target breathes, it pushes in the rest between two breaths: while the tissue is away its
time nearly stands still, and so it does at its last moment until the target rests. With `holds` it
tells the patient to hold the breath before it inserts, waits until the target rests, aims where the
target rests then, and lets breathe while it draws back.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, read_only, unit
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import Stage, numbered, packed
from app.mechanisms.hand_motion import grip_direction
from app.simulation.errors import SimulationError
from app.simulation.skills import Skill, find_skill

STEP: Final = 0.005  # [s] between rows of the script
TREMOR_STEP: Final = 0.004  # [s] between rows of the tremor tile
TREMOR_ROWS: Final = 1000  # the tile lasts 4 s and repeats without a seam
ABOVE_SKIN: Final = -0.015  # [m] depth at which the hand hovers
WAITING: Final = 0.4  # [s] at the end of the script, that last up to 80 s where the target moves
_WAITED: Final = 0.995  # of the time that passes then while the target is away
_CREPT: Final = 0.98  # of the time that passes so while it pushes
_INSERT, _CORRECT, _WAIT = 3.0, 6.0, 8.0  # `ScriptPhase`, as compiled code compares them
_AT_REST: Final = 3e-4  # [m] from its place at the end of a breath
_NEAR: Final = 2e-3  # [m] from it, where it still pushes: 44 % of the time with the default breath
_STILL: Final = 0.2  # [s] without any motion: the breath is held
_AIMS: Final = 0.2  # [s] time constant with which the held target is aimed at


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
    WAIT = 8
    DONE = 9


@dataclass(frozen=True, slots=True, eq=False)
class TraineeScript:
    """An attempt at speed one.

    Attributes:
        rows: e1, e2 [rad], depth [m], phase every `row` seconds, shape (n, 4), read-only.
        tremor: e1, e2 [rad], depth [m] every `TREMOR_STEP` seconds, shape (TREMOR_ROWS, 3).
        basis: two world directions that span the tangent plane of the path, shape (2, 3).
        row: time between two rows [s].
    """

    rows: FloatArray
    tremor: FloatArray
    basis: FloatArray
    row: float = STEP

    @property
    def duration(self) -> float:
        """Until the phase `DONE` [s]."""
        return (len(self.rows) - 1) * self.row


@dataclass(frozen=True, slots=True)
class Move:
    """Minimum-jerk movement to an error (e1, e2) [rad] and depth [m] within `duration` [s]."""

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
        raise SimulationError(
            sentence("the target lies at depth {depth} m; it must be above 0", depth=depth)
        )
    random = np.random.default_rng([seed, 1])
    basis = tangent_basis(unit(axis, "axis"))
    moves = _moves(unit(axis, "axis"), basis, depth, skill, random)
    rows = rows_of(moves)
    rows[:, :2] += drift(rows, skill, random)
    return TraineeScript(read_only(rows), read_only(tremor(skill, random)), read_only(basis))


def tangent_basis(axis: FloatArray) -> FloatArray:
    """Two unit vectors perpendicular to `axis` and each other, shape (2, 3)."""
    first = unit(np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))]))
    return np.stack([first, np.cross(axis, first)])


def _moves(
    axis: FloatArray, basis: FloatArray, depth: float, skill: Skill, random: np.random.Generator
) -> list[Move]:
    moves, around = first_moves(axis, basis, skill, random)
    for _ in range(skill.redirects):
        aim = polar(random.uniform(*skill.final_error), around + random.normal(0.0, 0.5))
        moves += _redirect(moves[-1], aim, depth, skill, random)
    final = polar(random.uniform(*skill.final_error), around)
    past = depth + float(random.uniform(*skill.overshoot))
    left = depth + float(random.choice([-1.0, 1.0]) * random.uniform(*skill.depth_error))
    moves.append(_insert(moves[-1], final, past, skill))
    moves.append(replace(moves[-1], phase=ScriptPhase.CORRECT, duration=0.6))
    moves.append(Move(ScriptPhase.CORRECT, 1.0, final, left))
    moves.append(Move(ScriptPhase.HOLD, skill.hold - WAITING, final, left))
    moves.append(Move(ScriptPhase.WAIT, WAITING, final, left))
    return moves


def first_moves(
    axis: FloatArray, basis: FloatArray, skill: Skill, random: np.random.Generator
) -> tuple[list[Move], float]:
    """Return hovering and aligning, and in which direction the aim is off [rad]."""
    start = polar(random.uniform(*skill.start_error), _towards_vertical(axis, basis, random))
    around = float(random.uniform(0.0, 2.0 * np.pi))
    aim = polar(random.uniform(*skill.aim_error), around)
    hover = Move(ScriptPhase.HOVER, skill.hover, start, ABOVE_SKIN)
    return [hover, Move(ScriptPhase.ALIGN, skill.align, aim, ABOVE_SKIN)], around


def _redirect(
    last: Move, aim: tuple[float, float], depth: float, skill: Skill, random: np.random.Generator
) -> list[Move]:
    """Insert part of the way, see the error, withdraw most of it, turn."""
    partway = float(random.uniform(0.40, 0.55)) * depth
    back = 0.3 * partway
    return [
        _insert(last, last.error, partway, skill),
        Move(ScriptPhase.INSERT, 0.8, last.error, partway),
        Move(ScriptPhase.WITHDRAW, (partway - back) / skill.speed, last.error, back),
        Move(ScriptPhase.REDIRECT, 2.0, aim, back),
    ]


def _insert(last: Move, error: tuple[float, float], depth: float, skill: Skill) -> Move:
    return Move(ScriptPhase.INSERT, max(0.2, (depth - last.depth) / skill.speed), error, depth)


def rows_of(moves: Sequence[Move]) -> FloatArray:
    """Rows of a script for its moves, from where the first one begins, shape (n, 4)."""
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


def drift(
    rows: FloatArray, skill: Skill, random: np.random.Generator, row: float = STEP
) -> FloatArray:
    """Slow wander of the direction that grows in as the needle enters, shape (n, 2)."""
    time = np.arange(len(rows)) * row
    frequencies = random.uniform(0.05, 0.3, (3, 2))
    phases = random.uniform(0.0, 2.0 * np.pi, (3, 2))
    waves = np.sin(2.0 * np.pi * frequencies * time[:, None, None] + phases).mean(axis=1)
    inside = np.clip(rows[:, 2] / 0.03, 0.0, 1.0)
    return skill.drift * (inside**2 * (3.0 - 2.0 * inside))[:, None] * waves


def tremor(skill: Skill, random: np.random.Generator) -> FloatArray:
    """Tile of the tremor, shape (TREMOR_ROWS, 3).

    A band of 8-12 Hz with whole periods in the tile, unit variance before scaling.
    """
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


def polar(radius: float, angle: float) -> tuple[float, float]:
    """Return an error (e1, e2) [rad] of a size, in a direction of the tangent plane [rad]."""
    return float(radius * np.cos(angle)), float(radius * np.sin(angle))


class _TraineePlaces(NamedTuple):
    """Beginning, path axis, tangent basis, where the hand was; tremor tile and script follow."""

    start: int
    speed: int
    rows: int
    axis_x: int
    axis_y: int
    axis_z: int
    first_x: int
    first_y: int
    first_z: int
    second_x: int
    second_y: int
    second_z: int
    from_1: int
    from_2: int
    from_depth: int
    hover: int


class _HoldsPlaces(NamedTuple):
    """Behind the script, where breath-holds are commanded: depth of the target [m], and memory.

    `ready` once the breath is held, `still` since when the target rests [s], `was_*` where it was
    [m], `aim_*` how far the script is turned and pushed towards it [rad, rad, m].
    """

    depth: int
    ready: int = 0
    still: int = 0
    was_x: int = 0
    was_y: int = 0
    was_z: int = 0
    aim_1: int = 0
    aim_2: int = 0
    aim_depth: int = 0


_AT: Final = numbered(_TraineePlaces)
_HOLDS: Final = numbered(_HoldsPlaces)
_TREMOR: Final = len(_AT)
_SCRIPT: Final = _TREMOR + 3 * TREMOR_ROWS
_TREMOR_PERIOD: Final = TREMOR_ROWS * TREMOR_STEP


def trainee_stage(
    axis: FloatArray,
    depth: float,
    skill: str | Skill = "expert",
    seed: int = 0,
    speed: float = 1.0,
    holds: bool = False,
) -> Stage:
    """Build the stage that inserts to `depth` [m] along `axis` (hub to tip, shape (3,)).

    Args:
        axis: wanted needle direction in world.
        depth: of the target beyond the fulcrum [m].
        skill: the name of one of `skills.SKILLS`, or a `Skill`.
        seed: another seed is another attempt of the same skill.
        speed: 2 plays the script twice as fast; the tremor keeps its frequency.
        holds: whether the patient holds the breath on command, and is told to.

    Raises:
        SimulationError: for an unknown skill, a depth not above 0 or a speed outside 0.05-20.
    """
    if not 0.05 <= speed <= 20.0:
        raise SimulationError(sentence("speed factor is {speed}; give 0.05 to 20", speed=speed))
    script = write_script(axis, depth, find_skill(skill), seed)
    told = packed(_HOLDS, depth=depth) if holds else np.zeros(0)
    return Stage("trainee", step, _parameters(script, unit(axis, "axis"), speed, told))


def script_stage(
    script: TraineeScript, axis: FloatArray, speed: float = 1.0, holds_at: float | None = None
) -> Stage:
    """Build the stage that plays a script about the path along `axis` (hub to tip, shape (3,)).

    With `holds_at`, depth of the target [m], the patient is told to hold the breath.
    """
    told = np.zeros(0) if holds_at is None else packed(_HOLDS, depth=holds_at)
    return Stage("trainee", step, _parameters(script, unit(axis, "axis"), speed, told))


def traced_script(
    time: FloatArray, axes: FloatArray, depth: FloatArray, axis: FloatArray
) -> TraineeScript:
    """Script a movement that was made before, for a hand that leads the needle along it again.

    Args:
        time: of its samples [s], rising, shape (n,), n > 1.
        axes: directions of the needle, unit vectors, shape (n, 3).
        depth: of the tip [m], shape (n,).
        axis: direction of the path, shape (3,).

    Raises:
        SimulationError: if a number is not finite, or there are less than two samples.
    """
    numbers = np.column_stack([time, axes, depth])
    if len(numbers) < 2 or not np.isfinite(numbers).all():
        raise SimulationError(sentence("a movement to be shown needs two finite samples at least"))
    basis = tangent_basis(unit(axis, "axis"))
    e1, e2 = tangents(axes, unit(axis, "axis"), basis)
    hover = round(1.0 / STEP)  # the hand comes to where the movement begins
    at = time[0] + np.arange(int((time[-1] - time[0]) / STEP) + 1) * STEP
    rows = np.column_stack([*(np.interp(at, time, one) for one in (e1, e2, depth)), 0.0 * at])
    rows[:, 3] = float(ScriptPhase.INSERT)
    rows = np.vstack([np.tile(rows[0], (hover, 1)), rows])
    rows[:hover, 3], rows[-1, 3] = float(ScriptPhase.HOVER), float(ScriptPhase.DONE)
    return TraineeScript(read_only(rows), read_only(np.zeros((TREMOR_ROWS, 3))), read_only(basis))


def tangents(
    axes: FloatArray, axis: FloatArray, basis: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Angles e1, e2 [rad] by which directions, (n, 3), are turned from the path, shapes (n,).

    The inverse of `directions`.
    """
    along, a, b = axes @ axis, axes @ basis[0], axes @ basis[1]
    sine = np.hypot(a, b)
    turn = np.divide(np.arctan2(sine, along), sine, out=np.ones_like(sine), where=sine > 1e-9)
    return turn * a, turn * b


def directions(e1: FloatArray, e2: FloatArray, axis: FloatArray, basis: FloatArray) -> FloatArray:
    """Directions turned from the path by angles e1, e2 [rad], shapes (n,): shape (n, 3).

    The exponential map that the script is played by.
    """
    angle = np.hypot(e1, e2)[:, None]
    sinc = np.divide(np.sin(angle), angle, out=np.ones_like(angle), where=angle > 1e-9)
    aside = e1[:, None] * basis[0] + e2[:, None] * basis[1]
    turned: FloatArray = np.cos(angle) * axis + sinc * aside
    return turned


def _parameters(
    script: TraineeScript, axis: FloatArray, speed: float, answer: FloatArray
) -> FloatArray:
    vectors = {"axis": axis, "first": script.basis[0], "second": script.basis[1]}
    return packed(
        _AT,
        script.tremor.ravel(),
        script.rows.ravel(),
        answer,
        start=np.nan,
        speed=speed * (STEP / script.row),
        rows=len(script.rows),
        from_1=0.0,
        from_2=0.0,
        from_depth=0.0,
        hover=np.count_nonzero(script.rows[:, 3] == ScriptPhase.HOVER) * STEP,
        **{
            f"{name}_{letter}": float(value)
            for name, vector in vectors.items()
            for letter, value in zip("xyz", vector, strict=True)
        },
    )


@njit
def _interpolate(
    p: FloatArray, base: int, width: int, row: int, next_row: int, share: float, i: int
) -> float:
    low = p[base + width * row + i]
    return low + share * (p[base + width * next_row + i] - low)


@njit
def _direction(p: FloatArray, e1: float, e2: float, i: int) -> float:
    """Component i of the path direction turned by the error (e1, e2) [rad]."""
    angle = np.sqrt(e1 * e1 + e2 * e2)
    sinc = np.sin(angle) / angle if angle > 1e-9 else 1.0
    return np.cos(angle) * p[_AT.axis_x + i] + sinc * (
        e1 * p[_AT.first_x + i] + e2 * p[_AT.second_x + i]
    )


@njit
def _begin_where_the_hand_is(state: FloatArray, p: FloatArray) -> None:
    """Note how far the hand is off the script's beginning: e1, e2 [rad], depth [m]."""
    gx, gy, gz = grip_direction(state)
    along = gx * p[_AT.axis_x] + gy * p[_AT.axis_y] + gz * p[_AT.axis_z]
    a = gx * p[_AT.first_x] + gy * p[_AT.first_y] + gz * p[_AT.first_z]
    b = gx * p[_AT.second_x] + gy * p[_AT.second_y] + gz * p[_AT.second_z]
    sine = np.sqrt(a * a + b * b)
    turned = np.arctan2(sine, along) / sine if sine > 1e-9 else 1.0
    p[_AT.from_1] = turned * a - p[_SCRIPT]
    p[_AT.from_2] = turned * b - p[_SCRIPT + 1]
    p[_AT.from_depth] = state[sv.GRIP_DEPTH] - p[_SCRIPT + 2]
    for i in range(3):
        if not np.isfinite(p[_AT.from_1 + i]):
            p[_AT.from_1 + i] = 0.0


@njit
def _breathes_away(state: FloatArray, near: float) -> bool:
    """Return whether the target is further than `near` [m] from where it rests at the end of a
    breath.
    """
    x, y, z = state[sv.TARGET_SHIFT_X], state[sv.TARGET_SHIFT_Y], state[sv.TARGET_SHIFT_Z]
    return x * x + y * y + z * z > near * near


@njit
def _waits_for_hold(state: FloatArray, p: FloatArray, b: int, phase: float) -> bool:
    """Command the breath and aim at the target; whether the script has to wait for it.

    `b` is where the places of `_HoldsPlaces` begin. The target is seen as the tick before left it.
    """
    inserts = phase == _INSERT or phase >= _CORRECT
    state[sv.HOLD_BREATH] = 1.0 if inserts else 0.0
    if not inserts:
        p[b + _HOLDS.ready] = p[b + _HOLDS.still] = 0.0
        return False
    if p[b + _HOLDS.ready] > 0.0:
        return False
    dt = state[sv.DT]
    moved, along, first, second = False, 0.0, 0.0, 0.0
    for i in range(3):
        shift = state[sv.TARGET_SHIFT_X + i]
        moved = moved or shift != p[b + _HOLDS.was_x + i]
        p[b + _HOLDS.was_x + i] = shift
        along += shift * p[_AT.axis_x + i]
        first += shift * p[_AT.first_x + i]
        second += shift * p[_AT.second_x + i]
    p[b + _HOLDS.still] = 0.0 if moved else p[b + _HOLDS.still] + dt
    depth, share = p[b + _HOLDS.depth], 0.0 if moved else min(1.0, dt / _AIMS)
    p[b + _HOLDS.aim_1] += share * (first / depth - p[b + _HOLDS.aim_1])
    p[b + _HOLDS.aim_2] += share * (second / depth - p[b + _HOLDS.aim_2])
    p[b + _HOLDS.aim_depth] += share * (along - p[b + _HOLDS.aim_depth])
    if p[b + _HOLDS.still] >= _STILL + 5.0 * _AIMS:
        p[b + _HOLDS.ready] = 1.0
    return True


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Write the wanted direction and depth, that the hand holds, and the phase."""
    time = state[sv.TIME]
    if not np.isfinite(time):
        return
    if not state[sv.ENABLED] > 0.0:  # between attempts the hand stays as it is told
        parameters[_AT.start] = np.nan
        return
    if np.isnan(parameters[_AT.start]):
        parameters[_AT.start] = time
        _begin_where_the_hand_is(state, parameters)
    last = int(parameters[_AT.rows]) - 1
    elapsed = max(0.0, time - parameters[_AT.start])
    at = min(elapsed * parameters[_AT.speed] / STEP, float(last))
    phase = parameters[_SCRIPT + 4 * int(at) + 3]
    told = _SCRIPT + 4 * (last + 1)
    waited = 0.0
    if len(parameters) > told:
        waited = 1.0 if _waits_for_hold(state, parameters, told, phase) else 0.0
    elif phase == _INSERT or phase >= _CORRECT:
        if phase == _WAIT:
            waited = _WAITED if _breathes_away(state, _AT_REST) else 0.0
        else:
            waited = _CREPT if _breathes_away(state, _NEAR) else 0.0
    if waited > 0.0:
        parameters[_AT.start] += waited * state[sv.DT]
        elapsed = max(0.0, time - parameters[_AT.start])
        at = min(elapsed * parameters[_AT.speed] / STEP, float(last))
    row = int(at)
    next_row = min(row + 1, last)
    shaking = (elapsed - _TREMOR_PERIOD * np.floor(elapsed / _TREMOR_PERIOD)) / TREMOR_STEP
    shake = int(shaking) % TREMOR_ROWS
    next_shake = (shake + 1) % TREMOR_ROWS
    e1 = _interpolate(parameters, _SCRIPT, 4, row, next_row, at - row, 0)
    e2 = _interpolate(parameters, _SCRIPT, 4, row, next_row, at - row, 1)
    depth = _interpolate(parameters, _SCRIPT, 4, row, next_row, at - row, 2)
    if parameters[_AT.hover] > 0.0:
        s = min(elapsed * parameters[_AT.speed] / parameters[_AT.hover], 1.0)
        left = 1.0 - s * s * s * (10.0 - 15.0 * s + 6.0 * s * s)
        e1 += left * parameters[_AT.from_1]
        e2 += left * parameters[_AT.from_2]
        depth += left * parameters[_AT.from_depth]
    if len(parameters) > told:
        e1 += parameters[told + _HOLDS.aim_1]
        e2 += parameters[told + _HOLDS.aim_2]
        depth += parameters[told + _HOLDS.aim_depth]
    share = shaking - np.floor(shaking)
    e1 += _interpolate(parameters, _TREMOR, 3, shake, next_shake, share, 0)
    e2 += _interpolate(parameters, _TREMOR, 3, shake, next_shake, share, 1)
    depth += _interpolate(parameters, _TREMOR, 3, shake, next_shake, share, 2)
    state[sv.HAND_X] = _direction(parameters, e1, e2, 0)
    state[sv.HAND_Y] = _direction(parameters, e1, e2, 1)
    state[sv.HAND_DEPTH] = depth
    state[sv.HAND_HOLDS] = 1.0
    state[sv.TRAINEE_PHASE] = parameters[_SCRIPT + 4 * row + 3]
