"""Bent needles through a patient who breathes, and what they feel along themselves, tick by tick.

A needle advances by `STEP_MM` a tick on a path that is given, at 10 mm/s. What lies at its tip is
looked up by the loop's own stage in a field of tissue (`in_field`), or is told from elsewhere
(`by_codes`); membranes, cutting, pressing and friction then follow by the same effects, so that two
ways differ by what they say lies where. All tissue counts as fresh: whether the tip was there
before is the same rule in both, and no label. Coordinates are the patient's, in metres.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.core.rotation import rotation_exp
from app.core.units import MILLIMETRE
from app.simulation.bound_field import BoundField
from app.simulation.clearing import clear
from app.simulation.effects import declaration, load, parameters_of
from app.simulation.scene import Binding, Scene, TissueLayer
from app.simulation.tissues import MODELS, PUBLISHED
from app.studies.insertions import ALONG

STEP_MM: Final = 0.05
LONG_MM: Final = 100.0
BEFORE_MM: Final = 4.0
"""A path begins so far outside of the skin."""

MOST_TILT: Final = np.radians(10.0)
MOST_BENT: Final = 3.0
"""Largest curvature of a path [1/m]; 22 G goes with 2.8 (Rand 2016)."""

MOST_BREATH_MM: Final = 12.0
_ASIDE_MM: Final = 8.0
_SPEED: Final = 0.01  # [m/s]
_PERIOD: Final = 4.0  # [s]
_TICK: Final = STEP_MM * MILLIMETRE / _SPEED

Codes = NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class NeedlePath:
    """The way of a tip: places [m] and directions, shape (n, 3), and breathing then [m]."""

    points: FloatArray
    ways: FloatArray
    breath: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class NeedleFeel:
    """What a needle met and felt, arrays of length n.

    Attributes:
        codes: of the tissue at the tip.
        force: of everything along the needle [N].
        membrane: of the membrane in front alone [N].
        punctures: how many have given way.
    """

    codes: Codes
    force: FloatArray
    membrane: FloatArray
    punctures: FloatArray


def straight_paths(
    entry_mm: FloatArray, target_mm: FloatArray, count: int, seed: int
) -> tuple[NeedlePath, ...]:
    """Return straight paths tilted from the plan, which is the first, without breathing."""
    rng, way = np.random.default_rng(seed), unit(target_mm - entry_mm, "plan")
    paths = [_path(entry_mm, way, np.zeros(3), np.zeros(3), 0.0)]
    while len(paths) < count:
        tilted = rotation_exp(rng.uniform(0.0, MOST_TILT) * _across(rng, way)) @ way
        paths.append(_path(entry_mm, tilted, np.zeros(3), np.zeros(3), 0.0))
    return tuple(paths)


def random_paths(
    entry_mm: FloatArray, target_mm: FloatArray, count: int, seed: int
) -> tuple[NeedlePath, ...]:
    """Return paths from beside the entry, tilted and bent to any side, with breathing."""
    rng, plan = np.random.default_rng([seed, 27]), unit(target_mm - entry_mm, "plan")
    paths = []
    for _ in range(count):
        way = rotation_exp(rng.uniform(0.0, MOST_TILT) * _across(rng, plan)) @ plan
        begin = entry_mm + rng.uniform(0.0, _ASIDE_MM) * _across(rng, plan)
        turn = rng.uniform(0.0, MOST_BENT) * _across(rng, way)
        breath = rng.uniform(0.0, MOST_BREATH_MM) * np.array([0.0, -0.3, -1.0]) / np.hypot(1.0, 0.3)
        paths.append(_path(begin, way, turn, breath * MILLIMETRE, rng.uniform(0.0, _PERIOD)))
    return tuple(paths)


def _across(rng: np.random.Generator, way: FloatArray) -> FloatArray:
    turn = rng.normal(size=3)
    return unit(turn - (turn @ way) * way, "turn")


def _path(
    begin_mm: FloatArray, way: FloatArray, bent: FloatArray, breath: FloatArray, phase: float
) -> NeedlePath:
    """Return an arc that leaves `way` towards `bent`, whose length is its curvature [1/m]."""
    along = (np.arange(round(LONG_MM / STEP_MM)) + 0.5) * STEP_MM * MILLIMETRE
    curvature = float(np.linalg.norm(bent))
    side = bent / curvature if curvature > 0.0 else np.zeros(3)
    angle = curvature * along
    ahead = np.sin(angle) / curvature if curvature > 0.0 else along
    beside = (1.0 - np.cos(angle)) / curvature if curvature > 0.0 else 0.0 * along
    start = begin_mm * MILLIMETRE - BEFORE_MM * MILLIMETRE * way
    points = start + ahead[:, None] * way + beside[:, None] * side
    ways = np.cos(angle)[:, None] * way + np.sin(angle)[:, None] * side
    share = 0.5 - 0.5 * np.cos(2.0 * np.pi * (along / _SPEED + phase) / _PERIOD)
    return NeedlePath(points, ways, share[:, None] * breath)


class PushingHand:
    """Pushes needles along paths through tissues of given values.

    Args:
        values: of the field's tissues, by code.
        bound: field that `in_field` looks into.
    """

    def __init__(self, values: Sequence[TissueLayer], bound: BoundField) -> None:
        self._scene = Scene(tissues=tuple(values), field=bound)

    def _stages(self, names: Sequence[str]) -> list[tuple[Any, FloatArray]]:
        stages = []
        for name in names:
            declared = declaration(name)
            model = declared.model(MODELS[PUBLISHED].get(name, ""))
            binding = Binding(self._scene, sv.PLANT_DEPTH, model)
            array = parameters_of(name, declared.checked({}), binding)
            stages.append((load(declared).step, array))
        return stages

    def in_field(self, path: NeedlePath) -> NeedleFeel:
        """Push through the field."""
        return self._pushed(path, None, path.breath)

    def by_codes(self, path: NeedlePath, codes: Codes, carried: FloatArray) -> NeedleFeel:
        """Push through what is told: the code at every tick, and how far that was carried [m]."""
        return self._pushed(path, codes, carried)

    def _pushed(self, path: NeedlePath, codes: Codes | None, carried: FloatArray) -> NeedleFeel:
        (look, field), *along = self._stages(("tissue_field", *ALONG))
        state, none, count = sv.empty_state(), np.zeros(1), len(path.points)
        state[sv.DT], state[sv.DEPTH_SOURCE] = _TICK, 1.0
        met, forces = np.empty(count, np.intp), np.empty((count, 3))
        depths = (np.arange(count) + 0.5) * STEP_MM * MILLIMETRE
        before = -1 if codes is None else int(codes[0])
        for k in range(count):
            clear(state, none)
            state[sv.AXIS], state[sv.TIP] = path.ways[k], path.points[k]
            state[sv.PLANT_DEPTH] = state[sv.DEPTH] = depths[k]
            if codes is None:
                state[sv.BREATH] = carried[k]
                look(state, field)
                state[sv.CHANNEL] = 0.0
            else:
                code = int(codes[k])
                state[sv.TISSUE] = state[sv.TISSUE_AHEAD] = code
                state[sv.WALL] = 1.0 if code == before else -0.5 * STEP_MM * MILLIMETRE
                state[sv.CARRIED], before = carried[k], code
            for number, (step, array) in enumerate(along):
                step(state, array)
                if number == 0:
                    forces[k, 1] = state[sv.AXIAL_FORCE]
            met[k] = state[sv.TISSUE]
            forces[k, 0], forces[k, 2] = state[sv.AXIAL_FORCE], state[sv.PUNCTURES]
        return NeedleFeel(met, forces[:, 0], forces[:, 1], forces[:, 2])
