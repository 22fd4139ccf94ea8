"""Script of a trainee who touches targets one after the other with the tip of a long tool.

What tells the skills apart is taken from `skills`, at the trocar as everything there: a hand that
is not used to the fulcrum begins a movement the wrong way, by the angle that the skill leaves; it
arrives off the target by the angle that it has after aiming, and too deep or not deep enough;
then it corrects, each time by most of what is left, until the tip is well within the target.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only, unit
from app.core.messages import sentence
from app.simulation.errors import SimulationError
from app.simulation.skills import Skill, find_skill
from app.simulation.trainee import (
    ABOVE_SKIN,
    Move,
    ScriptPhase,
    TraineeScript,
    drift,
    polar,
    rows_of,
    tangent_basis,
    tangents,
    tremor,
)

INSIDE: Final = 0.5
"""Of the radius: a trainee whose tip is so near to the target waits for the touch."""

LEFT: Final = 0.5
"""Share of an error that a correction leaves."""

WRONG: Final = 2.5
"""A movement that begins the wrong way goes so by this many angles that the skill leaves."""

BESIDE: Final = 2.0
"""It arrives beside the target by this many angles that the skill has after aiming."""

QUIET: Final = 0.02
"""Movements that turn by less than this have no wrong way [rad]."""

MOST_CORRECTIONS: Final = 5
CORRECTING: Final = 0.9
"""Time of a correction [s]."""

QUICKEST: Final = 0.8
"""Least time of a movement [s]."""

SEEN: Final = 0.5
"""From the end of the dwell until the trainee has seen that the target was touched [s]: the
tracking is late by a tenth, and a picture may be missed."""


def write_touch_script(
    axis: FloatArray,
    ways: FloatArray,
    radius: float,
    dwell: float,
    skill: Skill | str = "expert",
    seed: int = 0,
) -> TraineeScript:
    """Script an attempt at targets.

    Args:
        axis: direction of the path that the script is played about, shape (3,).
        ways: from the fulcrum to each target, in their order [m], shape (n, 3).
        radius: within which the tip touches a target [m].
        dwell: time for which it has to stay there [s].
        skill: the name of one of `skills.SKILLS`, or a `Skill`.
        seed: another seed is another attempt of the same skill.

    Raises:
        SimulationError: for an unknown skill, no target, or one within its radius of the fulcrum.
    """
    skill, way = find_skill(skill), unit(axis, "axis")
    depths = np.linalg.norm(ways, axis=-1)
    if not len(ways) or not (depths > radius).all():
        raise SimulationError(
            sentence(
                "targets to be touched lie {depths} m deep; each must lie deeper than their"
                " radius of {radius} m",
                depths=depths.tolist(),
                radius=radius,
            )
        )
    random = np.random.default_rng([seed, 2])
    basis = tangent_basis(way)
    places = np.column_stack([*tangents(ways / depths[:, None], way, basis), depths])
    start = polar(random.uniform(*skill.start_error), random.uniform(0.0, 2.0 * np.pi))
    first = (float(places[0, 0]), float(places[0, 1]))
    moves = [
        Move(ScriptPhase.HOVER, skill.hover, start, ABOVE_SKIN),
        Move(ScriptPhase.ALIGN, skill.align, first, ABOVE_SKIN),
    ]
    for place in places:
        moves += _touch(moves[-1], place, radius, dwell, skill, random)
    rows = rows_of(moves)
    rows[:, :2] += drift(rows, skill, random)
    return TraineeScript(read_only(rows), read_only(tremor(skill, random)), read_only(basis))


def _touch(
    last: Move,
    place: FloatArray,
    radius: float,
    dwell: float,
    skill: Skill,
    random: np.random.Generator,
) -> Sequence[Move]:
    """Go to a target (e1, e2 [rad], depth [m]) from where the last move ended, and wait on it."""
    depth = float(place[2])
    off = BESIDE * np.array(
        polar(random.uniform(*skill.aim_error), random.uniform(0.0, 2.0 * np.pi))
    )
    deep = random.choice([-1.0, 1.0]) * random.uniform(*skill.overshoot)
    moves = []
    here = np.array([*last.error, last.depth])
    towards = place[:2] - here[:2]
    turn = float(np.hypot(*towards))
    wrong = WRONG * random.uniform(*skill.final_error)
    if turn > QUIET and last.depth > 0.0:
        back = here[:2] - wrong * towards / turn
        moves.append(Move(ScriptPhase.REDIRECT, 0.3 + skill.hover / 3.0, _pair(back), last.depth))
    way = float(np.hypot(turn * depth, depth - last.depth))
    duration = max(QUICKEST, way / skill.speed)
    moves.append(Move(ScriptPhase.INSERT, duration, _pair(place[:2] + off), depth + deep))
    for _ in range(MOST_CORRECTIONS):
        if np.hypot(np.hypot(*off) * depth, deep) <= INSIDE * radius:
            break
        off, deep = LEFT * off, LEFT * deep
        moves.append(
            Move(ScriptPhase.CORRECT, CORRECTING, _pair(place[:2] + off), float(depth + deep))
        )
    waits = dwell + SEEN + skill.hover / 3.0
    return [*moves, Move(ScriptPhase.HOLD, waits, moves[-1].error, moves[-1].depth)]


def _pair(values: FloatArray) -> tuple[float, float]:
    return float(values[0]), float(values[1])
