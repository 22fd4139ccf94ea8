"""Hard cases of the tip in a field of tissue: walls closer than a tick, and places off the grid."""

from collections.abc import Callable
from functools import cache
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.imaging.field import NOBODYS, FieldTissue, TissueField, TissueKind
from app.simulation.bound_field import BoundField
from app.simulation.effects import declaration, tissue_field
from app.simulation.scene import Binding, Scene
from app.simulation.tissues import tissue_values
from app.studies.hard_cases.case import HardCase, analytic, answers

_Way = Callable[..., Any]
_ENDS_MM: Final = (0.0, 2.0, 3.3, 4.2, 5.6, 6.7)
"""Depths of the walls of slabs, the thinnest 0.9 mm."""


@cache
def _slabs() -> TissueField:
    """Slabs across z on voxels of 0.5 mm, air above z = 0, 12 mm of tissue below."""
    heights = np.arange(-12.0, 6.01, 0.5)
    codes = 1 + np.searchsorted(_ENDS_MM, -heights, side="left")
    off = np.abs(-heights[:, None] - np.array(_ENDS_MM)).min(axis=1)
    steps = np.minimum(np.rint(40.0 * off), 127)
    labels = np.broadcast_to(codes[:, None, None], (len(heights), 8, 8))
    distance = np.broadcast_to(steps[:, None, None], labels.shape)
    affine = np.diag([0.5, 0.5, 0.5, 1.0])
    affine[:3, 3] = (-2.0, -2.0, -12.0)
    kinds = (
        *(TissueKind.AIR, TissueKind.SKIN, TissueKind.FAT, TissueKind.MUSCLE),
        *(TissueKind.ORGAN, TissueKind.VESSEL, TissueKind.GUT),
    )
    table = (NOBODYS, *(FieldTissue(n, kind) for n, kind in enumerate(kinds, start=1)))
    return TissueField(labels.astype(np.uint8), distance.astype(np.int8), affine, table)


@cache
def _bound() -> Binding:
    field = BoundField(_slabs(), RigidTransform(np.eye(3), np.zeros(3)), np.zeros(3))
    scene = Scene(tissues=tissue_values(_slabs().tissues), field=field)
    return Binding(scene, sv.PLANT_DEPTH)


def _ticks(way: _Way, tips: FloatArray) -> list[FloatArray]:
    """Hold the tip of an upright needle at points [m], one a tick; the states after each."""
    memory = tissue_field.parameters(declaration("tissue_field").checked({}), _bound())
    rows = []
    for tip in tips:
        state = sv.empty_state()
        state[sv.AXIS_Z], state[sv.TIP] = -1.0, tip
        state[sv.DEPTH] = state[sv.PLANT_DEPTH] = -tip[2]
        way(state, memory)
        rows.append(state)
    return rows


def _down(step: float) -> FloatArray:
    depths = np.arange(-0.002, 0.0105, step)
    return np.column_stack([np.zeros((len(depths), 2)), -depths])


def _walls_of(way: _Way) -> FloatArray:
    """Depths of the walls that a tip of 1 m/s is told [mm], in their order."""
    rows = _ticks(way, _down(1e-3))
    met = [1e3 * (row[sv.DEPTH] + row[sv.WALL]) for row in rows if row[sv.WALL] < 0.0]
    return np.array(met[: len(_ENDS_MM)] + [np.inf] * (len(_ENDS_MM) - len(met)))


def _backwards() -> bool:
    rows = _ticks(tissue_field.step, _down(1e-3)[::-1])
    return all(row[sv.WALL] > 0.0 for row in rows)


def _thin() -> HardCase:
    return HardCase(
        subsystem="effects",
        case="walls of slabs thinner than a tick's way are all told, at their places",
        given="six walls 0.9 to 2 mm apart, voxels of 0.5 mm, a tip of 1 m/s",
        way=tissue_field.step,
        found=_walls_of,
        reference=analytic("where the slabs end", _ENDS_MM),
        unit="mm",
        bound=0.025,  # a step of a distance
        beyond=answers("going back tells no wall", _backwards),
    )


def _off_grid() -> HardCase:
    places = np.array(
        [
            *([0.0, 0.0, 0.005], [0.0019, 0.0019, -0.012], [0.002, 0.002, 0.006]),
            *([5.0, 0.0, -0.003], [1e300, -1e300, 1e300], [np.nan, 0.0, 0.0]),
            *([np.inf, 0.0, 0.0], [0.0, 0.0, -0.003], [0.0, 0.0, -0.5]),
        ]
    )

    def wrong(way: _Way) -> int:
        rows = np.array(_ticks(way, places))[:, [sv.TISSUE, sv.TISSUE_AHEAD, sv.WALL, sv.CHANNEL]]
        known = (rows[:, 0] >= 0.0) & (rows[:, 0] < len(_slabs().tissues))
        return int(np.count_nonzero(~np.isfinite(rows))) + int(np.count_nonzero(~known))

    def unknown() -> bool:
        return _ticks(tissue_field.step, places[3:4])[0][sv.TISSUE] == 0.0

    return HardCase(
        subsystem="effects",
        case="a tip at the grid's border, far off it, or nowhere, is in a tissue of the table",
        given="nine places, two of them no numbers",
        way=tissue_field.step,
        found=wrong,
        reference=analytic("no answer that is none", 0.0),
        unit="1",
        bound=0.0,
        beyond=answers("what is off the grid is unknown", unknown),
    )


CASES: Final = (_thin(), _off_grid())
"""The tip in a field."""
