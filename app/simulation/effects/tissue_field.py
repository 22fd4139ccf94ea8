"""What lies about the needle's tip, looked up in the patient's field of tissue in every tick.

Where the tip is. TIP is the straight needle's at the depth that is measured; the tip that is looked
up is at the depth that effects along the needle take, and beside the straight line by TIP_OFFSET of
the tick before (a stage behind the effects keeps it, `keep_bend`): the bend of this tick is
computed from what is met here. A tick moves a bent tip by hundredths of a millimetre beside the
line.

The way of the tip since the tick before is walked through the field (`tissue_walk`), in steps that
no boundary lies within, or of a quarter of a voxel. It begins where the tissue that the tip was in
has gone since with breathing: a wall that moves cannot hold the walk up. At the first wall it ends:
TISSUE is what lies behind it, WALL negative: how far back it was met; what is left of the way is
walked in the next tick. So no wall is jumped over, and several in one tick are told one a tick.
Going back tells none: what was pierced stays pierced. Where the tissue moves past a tip that
stands, the tip walks the other way in it: a wall on that way is told likewise, unless what the tip
was in is neither where it was nor where it went with the breath: the walk begins in the new tissue.

Otherwise WALL is the way to the first wall ahead, 1 for none within `ahead`. In what is rigid it is
the surface behind the tip, as far as distances reach.

CHANNEL. Where the tip cut fresh tissue it leaves points three quarters of `channel` needle
diameters apart, in the place that the tissue has at rest, and one at the very end; what it only
dimples is not cut (INDENTATION of the tick before is taken off). The tip is in a channel where a
point lies less than `channel` diameters from it, and ahead of it or beside: not on the way that led
here (so 0.93 of that is sure, the points being apart). The last 2048 are
remembered (1.1 m of cutting with 22 G), found by a hash of their places; they are forgotten when
forces are armed while the tip is outside: a new attempt.

CARRIED is the displacement by breathing of the tissue at the tip, CARRIED_SHARE its share of
BREATH.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import numbered, packed
from app.simulation.bound_field import BoundField, holding
from app.simulation.errors import SimulationError
from app.simulation.scene import Binding
from app.simulation.tissue_walk import (
    FIELD,
    ROW,
    distances_of,
    first_wall,
    labels_of,
    tissue_at,
)

DECLARATION: Final[dict[str, Any]] = {
    "title": "Tissue at the tip, from the patient's field",
    "reads": ("axis", "tip", "depth", "plant_depth", "kinematics", "enabled", "breath"),
    "writes": (
        "tissue",
        "tissue_ahead",
        "wall",
        "wall_normal",
        "channel",
        "carried",
        "carried_share",
    ),
    "consumers": ("the other effects", "views", "score"),
    "needs": ("field", "tissues"),
    "models": {"walk": "the tip's way walked through the field; no wall is jumped over"},
    "energy": ("dissipative", "it says what lies where and has no force of its own"),
    "cost_class": "B",
    "parameters": {
        "ahead": (0.003, "m", 0.0, 0.02, "in front of the tip that a wall is looked for"),
        "channel": (1.0, "-", 0.1, 4.0, "needle diameters from a cut that are cut already"),
    },
}

POINTS: Final = 2048
"""Points of earlier cuts that are remembered."""

_BUCKETS: Final = 1024
_SPACED: Final = 0.75
_BEYOND: Final = 0.1  # of the radius: what lies less far ahead is where the tip is
_BESIDE: Final = 0.3  # of the radius: what lies so far beside is not the way that led here
_LIMIT: Final = 0.1  # [m] of breathing; further is no displacement
_NEAR: Final = 0.003  # [m]
_FARTHEST: Final = 0.3  # [m]
_SIDEWAYS: Final = -0.5  # cosine between way and needle below which the tip goes back


class _MemoryPlaces(NamedTuple):
    """Constants; the place walked to, its tissue and share, the bend, the end of the cut; points.

    `breath_*` is BREATH when the place was walked to; `ready` is 1 once there is one, `enabled`
    what ENABLED was; `points` were made so far.
    """

    ahead: int
    radius: int
    x: int = 0
    y: int = 0
    z: int = 0
    code: int = 0
    share: int = 0
    breath_x: int = 0
    breath_y: int = 0
    breath_z: int = 0
    ready: int = 0
    enabled: int = 0
    bent_x: int = 0
    bent_y: int = 0
    bent_z: int = 0
    dimple: int = 0
    end_x: int = 0
    end_y: int = 0
    end_z: int = 0
    has_end: int = 0
    points: int = 0


_AT: Final = numbered(_MemoryPlaces, len(FIELD))
_POINTS: Final = len(FIELD) + len(_AT)
_NEXT: Final = _POINTS + 3 * POINTS
_HEADS: Final = _NEXT + POINTS
TABLE: Final = _HEADS + _BUCKETS
"""Where the table of tissues begins."""


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: needle not yet seen, nothing cut.

    It holds where the field's arrays lie, and they are kept as long as it is.

    Raises:
        SimulationError: if the scene's field is not bound.
    """
    bound, scene = binding.scene.field, binding.scene
    if not isinstance(bound, BoundField):
        raise SimulationError(
            sentence(
                "the scene's field is a {type_name}; bind it first",
                type_name=type(bound).__name__,
            )
        )
    rows = bound.rows(scene.tissues)
    head = packed(FIELD, slot=binding.depth_slot, codes=len(rows), table=TABLE, **bound.head())
    memory = packed(
        _AT, ahead=values["ahead"], radius=values["channel"] * scene.needle.outer_diameter
    )
    points, after = np.zeros(3 * POINTS), np.zeros(POINTS + _BUCKETS)
    return holding(np.concatenate([head, memory, points, after, rows.ravel()]), bound)


@njit
def _bucket(x: float, y: float, z: float) -> int:
    """Bucket of a cell of the hash, by its whole numbers."""
    mixed = (np.int64(x) * 73856093) ^ (np.int64(y) * 19349663) ^ (np.int64(z) * 83492791)
    return int(mixed & (_BUCKETS - 1))


@njit
def _lies_ahead(p: FloatArray, at: int, x: float, y: float, z: float, way: Any) -> bool:
    """Return whether a remembered point is within the radius, and not of the way that led here."""
    dx, dy, dz, radius = p[at] - x, p[at + 1] - y, p[at + 2] - z, p[_AT.radius]
    square = dx * dx + dy * dy + dz * dz
    if not square < radius * radius:
        return False
    along = dx * way[0] + dy * way[1] + dz * way[2]
    beside = square - along * along
    return along > _BEYOND * radius or beside > _BESIDE * _BESIDE * radius * radius


@njit
def in_channel(p: FloatArray, x: float, y: float, z: float, way: Any) -> bool:
    """Return whether a place at rest [m], gone through along `way`, was cut before."""
    if p[_AT.has_end] > 0.0 and _lies_ahead(p, _AT.end_x, x, y, z, way):
        return True
    radius = p[_AT.radius]
    cell = 2.0 * radius
    for a in range(2):
        cx = np.floor((x - radius + cell * a) / cell)
        if cx * cell > x + radius:
            continue
        for b in range(2):
            cy = np.floor((y - radius + cell * b) / cell)
            if cy * cell > y + radius:
                continue
            for c in range(2):
                cz = np.floor((z - radius + cell * c) / cell)
                if cz * cell > z + radius:
                    continue
                point = int(p[_HEADS + _bucket(cx, cy, cz)])
                while point > 0:
                    if _lies_ahead(p, _POINTS + 3 * (point - 1), x, y, z, way):
                        return True
                    point = int(p[_NEXT + point - 1])
    return False


@njit
def _bucket_of(p: FloatArray, point: int) -> int:
    at, cell = _POINTS + 3 * point, 2.0 * p[_AT.radius]
    return _bucket(np.floor(p[at] / cell), np.floor(p[at + 1] / cell), np.floor(p[at + 2] / cell))


@njit
def _forget_point(p: FloatArray, point: int) -> None:
    """Take a point out of its bucket."""
    link = _HEADS + _bucket_of(p, point)
    while p[link] > 0.0:
        other = int(p[link]) - 1
        if other == point:
            p[link] = p[_NEXT + other]
            return
        link = _NEXT + other


@njit
def _remember(p: FloatArray, x: float, y: float, z: float) -> None:
    """Let the cut end at a place at rest [m], and leave a point where the last is far enough."""
    p[_AT.end_x], p[_AT.end_y], p[_AT.end_z], p[_AT.has_end] = x, y, z, 1.0
    count = int(p[_AT.points])
    if count > 0:
        at = _POINTS + 3 * ((count - 1) % POINTS)
        dx, dy, dz = p[at] - x, p[at + 1] - y, p[at + 2] - z
        far = _SPACED * p[_AT.radius]
        if dx * dx + dy * dy + dz * dz < far * far:
            return
    point = count % POINTS
    if count >= POINTS:
        _forget_point(p, point)
    at = _POINTS + 3 * point
    p[at], p[at + 1], p[at + 2] = x, y, z
    head = _HEADS + _bucket_of(p, point)
    p[_NEXT + point] = p[head]
    p[head] = point + 1.0
    p[_AT.points] = count + 1.0


@njit
def _forget_cuts(p: FloatArray) -> None:
    p[_AT.points] = p[_AT.has_end] = 0.0
    for k in range(_BUCKETS):
        p[_HEADS + k] = 0.0


@njit
def _breath_of(state: FloatArray) -> Any:
    """Displacement of what breathes fully [m]; zero for what is none."""
    x, y, z = state[sv.BREATH_X], state[sv.BREATH_Y], state[sv.BREATH_Z]
    if not x * x + y * y + z * z < _LIMIT * _LIMIT:
        return 0.0, 0.0, 0.0
    return x, y, z


@njit
def _tell(state: FloatArray, ahead: int, wall: float, x: float, y: float, z: float) -> None:
    state[sv.TISSUE_AHEAD] = ahead
    state[sv.WALL], state[sv.WALL_X], state[sv.WALL_Y], state[sv.WALL_Z] = wall, x, y, z


@njit
def _tell_met(state: FloatArray, seen: Any, back: float, way: Any) -> None:
    """Tell the wall that was just crossed, `back` behind the tip [m]; normal as the tip goes on."""
    x, y, z = -seen[3], -seen[4], -seen[5]  # out of what lies behind it is into what it is in
    if x == 0.0 and y == 0.0 and z == 0.0:
        x, y, z = way
    _tell(state, seen[0], -max(back, 1e-9), x, y, z)


@njit
def _tell_ahead(
    state: FloatArray, p: FloatArray, labels: Any, distance: Any, tip: Any, seen: Any, breath: Any
) -> None:
    """Tell the wall ahead; in what is rigid its surface."""
    way = (state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z])
    code, inside = seen[0], seen[2]
    if p[int(p[FIELD.table]) + len(ROW) * code + ROW.rigid] > 0.0:
        against = -(seen[3] * way[0] + seen[4] * way[1] + seen[5] * way[2])
        if inside < _NEAR and against > 0.1:
            _tell(state, code, -max(inside / against, 1e-9), -seen[3], -seen[4], -seen[5])
            return
    most = p[_AT.ahead]
    if inside - 0.5 * p[FIELD.spacing] < most:
        at, beyond = first_wall(
            p, labels, distance, tip, way, most, code, inside, breath, p[_AT.share]
        )
        if at >= 0.0:
            x, y, z = tip[0] + at * way[0], tip[1] + at * way[1], tip[2] + at * way[2]
            there = tissue_at(p, labels, distance, x, y, z, breath, p[_AT.share])
            nx, ny, nz = -there[3], -there[4], -there[5]
            if nx == 0.0 and ny == 0.0 and nz == 0.0:
                nx, ny, nz = way
            _tell(state, beyond, at, nx, ny, nz)
            return
    _tell(state, code, 1.0, 0.0, 0.0, 0.0)


@njit
def _is_far(p: FloatArray, tip: Any) -> bool:
    """Return whether the tip is where no way can have led within a tick: it is begun anew there."""
    square = (tip[0] - p[_AT.x]) ** 2 + (tip[1] - p[_AT.y]) ** 2 + (tip[2] - p[_AT.z]) ** 2
    return not square < _FARTHEST * _FARTHEST


@njit
def _begin(p: FloatArray, labels: Any, distance: Any, breath: Any) -> Any:
    """Return where the walk begins: the place walked to, gone on with its tissue; what lies there.

    Where that is another tissue, as along a wall that stays, it begins at the place as it was.
    """
    near, code = p[_AT.share], p[_AT.code]
    x, y, z = p[_AT.x], p[_AT.y], p[_AT.z]
    dx, dy, dz = (
        breath[0] - p[_AT.breath_x],
        breath[1] - p[_AT.breath_y],
        breath[2] - p[_AT.breath_z],
    )
    if near != 0.0 and (dx != 0.0 or dy != 0.0 or dz != 0.0):
        mx, my, mz = x + near * dx, y + near * dy, z + near * dz
        moved = tissue_at(p, labels, distance, mx, my, mz, breath, near)
        if moved[0] == code:
            return mx, my, mz, moved
        seen = tissue_at(p, labels, distance, x, y, z, breath, near)
        if seen[0] != code:
            return mx, my, mz, moved
        return x, y, z, seen
    return x, y, z, tissue_at(p, labels, distance, x, y, z, breath, near)


@njit
def _walk(state: FloatArray, p: FloatArray, tip: Any, depth: float) -> None:
    """Go from the place of the tick before towards the tip, and tell what is met and lies there."""
    labels, distance, breath = labels_of(p), distances_of(p), _breath_of(state)
    way = (state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z])
    near = p[_AT.share]
    if p[_AT.ready] == 0.0 or _is_far(p, tip):
        p[_AT.x], p[_AT.y], p[_AT.z] = tip
        p[_AT.code] = tissue_at(p, labels, distance, tip[0], tip[1], tip[2], breath, near)[0]
        p[_AT.ready] = 1.0
        p[_AT.breath_x], p[_AT.breath_y], p[_AT.breath_z] = breath
    x, y, z, seen = _begin(p, labels, distance, breath)
    dx, dy, dz = tip[0] - x, tip[1] - y, tip[2] - z
    length = np.sqrt(dx * dx + dy * dy + dz * dz)
    along = dx * way[0] + dy * way[1] + dz * way[2]
    met, code = False, int(p[_AT.code])
    goes_back = length > 0.0 and along < _SIDEWAYS * length
    if not goes_back:
        if seen[0] != code:  # it has moved past a tip that stood
            met = True
        elif length > 0.0:
            ways = (dx / length, dy / length, dz / length)
            at, _ = first_wall(
                p, labels, distance, (x, y, z), ways, length, code, seen[2], breath, near
            )
            if at >= 0.0:
                met = True
                x, y, z = x + at * ways[0], y + at * ways[1], z + at * ways[2]
    if not met:
        x, y, z = tip
    seen = tissue_at(p, labels, distance, x, y, z, breath, near)
    p[_AT.x], p[_AT.y], p[_AT.z], p[_AT.code], p[_AT.share] = x, y, z, seen[0], seen[6]
    p[_AT.breath_x], p[_AT.breath_y], p[_AT.breath_z] = breath
    share = seen[6]
    dimple = p[_AT.dimple]
    rx = x - share * breath[0] - dimple * way[0]
    ry = y - share * breath[1] - dimple * way[1]
    rz = z - share * breath[2] - dimple * way[2]
    if depth > 0.0 and p[int(p[FIELD.table]) + len(ROW) * seen[0] + ROW.empty] == 0.0:
        if in_channel(p, rx, ry, rz, way):
            state[sv.CHANNEL] = 1.0
        elif not goes_back:
            _remember(p, rx, ry, rz)
    state[sv.TISSUE] = seen[0]
    if met:
        back = (tip[0] - x) * way[0] + (tip[1] - y) * way[1] + (tip[2] - z) * way[2]
        _tell_met(state, seen, back, way)
    else:
        _tell_ahead(state, p, labels, distance, tip, seen, breath)
    state[sv.CARRIED_SHARE] = share
    for axis in range(3):
        state[sv.CARRIED_X + axis] = share * breath[axis]


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Write what lies about the tip; without valid kinematics, what lay there before."""
    p = parameters
    depth = state[int(p[FIELD.slot])]
    further = depth - state[sv.DEPTH]
    tip = (
        state[sv.TIP_X] + p[_AT.bent_x] + further * state[sv.AXIS_X],
        state[sv.TIP_Y] + p[_AT.bent_y] + further * state[sv.AXIS_Y],
        state[sv.TIP_Z] + p[_AT.bent_z] + further * state[sv.AXIS_Z],
    )
    size = state[sv.AXIS_X] ** 2 + state[sv.AXIS_Y] ** 2 + state[sv.AXIS_Z] ** 2
    state[sv.WALL] = 1.0
    if p[FIELD.labels] == 0.0 or p[FIELD.distance] == 0.0:
        return
    arms = state[sv.ENABLED] > 0.5 and p[_AT.enabled] < 0.5
    p[_AT.enabled] = 1.0 if state[sv.ENABLED] > 0.5 else 0.0
    if arms and depth <= 0.0:
        _forget_cuts(p)
    usable = np.isfinite(tip[0] + tip[1] + tip[2]) and abs(size - 1.0) < 1e-3
    if state[sv.KINEMATICS] != 0.0 or not usable:
        state[sv.TISSUE] = state[sv.TISSUE_AHEAD] = p[_AT.code]
        return
    _walk(state, p, tip, depth)


@stage
def keep_bend(state: FloatArray, parameters: FloatArray) -> None:
    """Keep for the next tick how far the tip is beside the line, and how far it dimples."""
    x, y, z = state[sv.TIP_OFFSET_X], state[sv.TIP_OFFSET_Y], state[sv.TIP_OFFSET_Z]
    if np.isfinite(x + y + z):
        parameters[_AT.bent_x], parameters[_AT.bent_y], parameters[_AT.bent_z] = x, y, z
    dimple = state[sv.INDENTATION]
    if np.isfinite(dimple):
        parameters[_AT.dimple] = max(dimple, 0.0)
