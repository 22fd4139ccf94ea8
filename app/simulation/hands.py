"""Scripted hands as people have them: as slow, as uneven and as far off as was measured.

The quick scripts of `skills` take 12 to 25 s, never falter, and their expert leaves 0.24°: no human
does. They stay for demonstrations, for tools through a trocar and for the records that were made
with them. These hands are named after them (`expert-hand`) and are what trials are made with.

**Time.** Published are 204 s with a laser and 277 s without (Weigel 2023, 1.58 and 3.28
corrections), 5 to 9 min (Gruber-Rouh 2015), 405 to 900 s: whole procedures, with scans that Acus
has not. Without any scan a puncture of 70 to 113 mm takes 37 ± 20 s (18 radiologists, Cardiovasc
Intervent Radiol 2024;47:1786); with half of that for each correction hands work a third of 204 s.
Two to three scans and ways to the control room of 25 s (estimated; none measured was found) would
leave them two thirds. Half is taken: 102 s for who is guided, 139 s for who is not.

| phase, 80 mm deep | expert | novice | stands on |
|---|---|---|---|
| hover | 10 s | 12 s | estimated |
| align, insert | 57 s | 62 s | 37 ± 20 s |
| corrections on the way | 1 of 12 s | 2 of 20 s | half of that; 1.58 and 3.28 with the last |
| depth, hold | 24 s | 26 s | estimated |

**Errors.** Mean angle and distance of guided hands 1.3 ± 0.9° and 3.6 to 5.0 mm, freehand 3.4 ±
3.1° and 6.3 ± 3.6 mm (Gruber-Rouh 2015): proficient and novice, the others between them; the
expert is the best that was published, 0.4 to 1.5° and from 1.2 mm on. What the distance has beyond
the angle at 85 mm and the entry's 0.8 mm is depth. One hand varies less than the many that were
measured: ranges are a little wider than half a standard deviation to both sides.

**Unevenness.** Slow movements consist of others that take half a second and follow each other two
to three times a second (Celik 2009): minimum-jerk pieces, each begun before the last has ended;
the less they overlap, the more of the speed's power lies between 1 and 7 Hz. Tremor of 8 to 12 Hz
is that of `skills`: 40 to 160 µm RMS at the hub of 15 to 254 µm measured (PMC3032442).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only, unit
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.simulation import skills
from app.simulation.errors import SimulationError
from app.simulation.skills import Skill
from app.simulation.trainee import (
    WAITING,
    Move,
    ScriptPhase,
    TraineeScript,
    drift,
    first_moves,
    polar,
    tangent_basis,
    tremor,
)

ROW: Final = 0.02
"""Time between two rows of such a script [s]: a movement of 7 Hz has seven."""

SUFFIX: Final = "-hand"
"""Names of these hands end so, after their skill's."""

WITHIN_HOLD: Final = 16.0
"""What is done while the patient holds the breath is done in this time [s]; he can for 20."""

UNEVEN: Final = 0.3
"""Standard deviation of one piece's size and of its time from the last, in their means."""


@dataclass(frozen=True, slots=True)
class Hand:
    """A hand's own pace, beside the errors of its skill.

    Attributes:
        skill: errors, drift and tremor, number of corrections; `speed` of insertion.
        pieces: that begin in a second while it moves [Hz].
        overlap: how long a piece takes, in the time from one to the next: 1 stops after each.
        back: share of the depth at which it stays when it corrects on the way.
        turning: time to turn onto another aim there [s].
        settling: time for the depth at the target [s].
    """

    skill: Skill
    pieces: float
    overlap: float
    back: float
    turning: float
    settling: float

    @property
    def name(self) -> str:
        """Return the name that records have."""
        return self.skill.name + SUFFIX


def _hand(
    skill: Skill,
    angle: tuple[float, float],
    depth_mm: tuple[float, float],
    pace: tuple[float, float, float],
    corrections: int,
    uneven: tuple[float, float],
    correcting: tuple[float, float, float],
) -> Hand:
    """Make a hand of a skill: errors [°], [mm]; hover, align [s] and speed [mm/s]."""
    low, high = (float(np.deg2rad(one)) for one in angle)
    near, far = (one * MILLIMETRE for one in depth_mm)
    own = replace(
        skill,
        hover=pace[0],
        align=pace[1],
        speed=pace[2] * MILLIMETRE,
        aim_error=(low, high + float(np.deg2rad(0.3))),
        final_error=(low, high),
        depth_error=(near, far),
        redirects=corrections,
        hold=16.0,
    )
    return Hand(own, *uneven, *correcting)


NOVICE: Final = _hand(
    skills.NOVICE, (2.1, 4.7), (2.2, 5.0), (12.0, 28.0, 2.8), 2, (2.2, 1.2), (0.5, 5.0, 10.0)
)
BEGINNER: Final = _hand(
    skills.BEGINNER, (1.6, 3.8), (2.1, 4.8), (11.5, 27.0, 2.8), 2, (2.3, 1.4), (0.6, 4.5, 9.5)
)
COMPETENT: Final = _hand(
    skills.COMPETENT, (1.1, 2.9), (2.0, 4.6), (11.0, 26.0, 2.9), 1, (2.4, 1.55), (0.6, 4.0, 9.0)
)
PROFICIENT: Final = _hand(
    skills.PROFICIENT, (0.6, 2.0), (1.9, 4.4), (10.5, 26.0, 2.9), 1, (2.5, 1.7), (0.7, 3.5, 8.5)
)
EXPERT: Final = _hand(
    skills.EXPERT, (0.4, 1.4), (0.3, 1.5), (10.0, 25.0, 3.0), 1, (2.6, 1.85), (0.75, 3.0, 8.0)
)

HANDS: Final = {hand.name: hand for hand in (NOVICE, BEGINNER, COMPETENT, PROFICIENT, EXPERT)}
"""All by the name that records have, the least skilled first."""


class Script(StrEnum):
    """How a scripted hand behaves: in a hurry and without a slip, or as people do."""

    QUICK = "quick"
    HAND = "hand"


def named(skill: str, script: Script) -> str:
    """Return the name that records have of a skill that plays such a script."""
    return skill if script is Script.QUICK else skill + SUFFIX


def write_hand_script(
    axis: FloatArray, depth: float, hand: Hand, seed: int, holds: bool = False
) -> TraineeScript:
    """Script an attempt of a hand on a target `depth` [m] beyond the fulcrum along `axis`, (3,).

    Args:
        axis: direction of the path, hub to tip.
        depth: of the target.
        hand: whose.
        seed: another seed is another attempt; the same errors are drawn for every hand of a seed.
        holds: whether the patient holds the breath, and what is done meanwhile has to be quick.

    Raises:
        SimulationError: if the depth is not a finite length above zero.
    """
    if not (np.isfinite(depth) and depth > 0.0):
        raise SimulationError(
            sentence("the target lies at depth {depth} m; it must be above 0", depth=depth)
        )
    axis = unit(axis, "axis")
    random, pieces, slow = (np.random.default_rng([seed, of]) for of in (3, 4, 5))
    basis = tangent_basis(axis)
    moves = _moves(axis, basis, depth, hand, random)
    if holds:
        moves = _hastened(moves)
    rows = _rows(moves, hand, pieces)
    rows[:, :2] += drift(rows, hand.skill, slow, ROW)
    shaking = read_only(tremor(hand.skill, slow))
    return TraineeScript(read_only(rows), shaking, read_only(basis), ROW)


def _moves(
    axis: FloatArray, basis: FloatArray, depth: float, hand: Hand, random: np.random.Generator
) -> list[Move]:
    """Return all movements; what is drawn is drawn in an order that no hand's pace changes."""
    skill = hand.skill
    moves, around = first_moves(axis, basis, skill, random)
    final = polar(random.uniform(*skill.final_error), around)
    past = depth + float(random.uniform(*skill.overshoot))
    left = depth + float(random.choice([-1.0, 1.0]) * random.uniform(*skill.depth_error))
    for _ in range(skill.redirects):
        aim = polar(random.uniform(*skill.final_error), around + random.normal(0.0, 0.5))
        partway = float(random.uniform(0.40, 0.55)) * depth
        last, back = moves[-1], hand.back * partway
        moves += [
            _insert(last, last.error, partway, skill),
            Move(ScriptPhase.INSERT, 1.5, last.error, partway),
            Move(ScriptPhase.WITHDRAW, (partway - back) / skill.speed, last.error, back),
            Move(ScriptPhase.REDIRECT, hand.turning, aim, back),
        ]
    moves.append(_insert(moves[-1], final, past, skill))
    moves.append(Move(ScriptPhase.CORRECT, 0.5 * hand.settling, final, past))
    moves.append(Move(ScriptPhase.CORRECT, 0.5 * hand.settling, final, left))
    moves.append(Move(ScriptPhase.HOLD, skill.hold - WAITING, final, left))
    moves.append(Move(ScriptPhase.WAIT, WAITING, final, left))
    return moves


def _insert(last: Move, error: tuple[float, float], depth: float, skill: Skill) -> Move:
    return Move(ScriptPhase.INSERT, max(1.0, (depth - last.depth) / skill.speed), error, depth)


def _hastened(moves: Sequence[Move]) -> list[Move]:
    """Return the moves with what is done in one breath-hold done within it."""
    result: list[Move] = []
    held: list[Move] = []
    for move in [*moves, None]:
        if move is not None and _needs_hold(move.phase):
            held.append(move)
            continue
        scale = min(1.0, WITHIN_HOLD / max(sum(one.duration for one in held), 1e-9))
        result += [replace(one, duration=scale * one.duration) for one in held]
        held = []
        if move is not None:
            result.append(move)
    return result


def _needs_hold(phase: ScriptPhase) -> bool:
    return phase is ScriptPhase.INSERT or phase >= ScriptPhase.CORRECT


def _rows(moves: Sequence[Move], hand: Hand, random: np.random.Generator) -> FloatArray:
    """Rows of a script for its moves, from where the first one begins, shape (n, 4)."""
    here = np.array([*moves[0].error, moves[0].depth])
    parts = []
    for move in moves:
        there = np.array([*move.error, move.depth])
        count = max(1, round(move.duration / ROW))
        way = _way(count, hand, random) if (there != here).any() else np.zeros(count)
        path = here + way[:, None] * (there - here)
        parts.append(np.column_stack([path, np.full(count, float(move.phase))]))
        here = there
    return np.vstack([*parts, [*here, float(ScriptPhase.DONE)]])


def _way(count: int, hand: Hand, random: np.random.Generator) -> FloatArray:
    """Share of a movement that is done at each of `count` rows, in pieces, from 0 on."""
    duration, every = count * ROW, 1.0 / hand.pieces
    length = min(hand.overlap * every, duration)
    starts, sizes, at = [], [], 0.0
    while at <= duration - length:
        s = (at + 0.5 * length) / duration
        starts.append(at)
        swell = s**2 * (1.0 - s) ** 2  # it starts and ends slowly, as the whole movement would
        sizes.append((0.2 + 16.0 * swell) * max(0.2, random.normal(1.0, UNEVEN)))
        at += every * max(0.3, random.normal(1.0, UNEVEN))
    time = np.arange(count) * ROW
    s = np.clip((time[:, None] - np.array(starts)) / length, 0.0, 1.0)
    share = np.array(sizes) / np.sum(sizes)
    result: FloatArray = (s**3 * (10.0 - 15.0 * s + 6.0 * s**2)) @ share
    return result
