"""A bevelled tip cuts a curved path: an exact arc, or one that drifts; the roll says which way.

The tip's frame goes with the needle's axis; its motion is the unicycle of Webster et al. 2006 (IJRR
25:509), g' = g (V1 + noise) per length of path, V1 = (e3; κ a) with the bending axis a = (-sin ρ,
cos ρ, 0) for the roll ρ: the path turns towards (cos ρ, sin ρ). For a constant twist ω the motion
over a length l is its exponential, with θ = |ω| l

    p <- p + R (l 1 + (1 - cos θ)/|ω|² [ω] + (θ - sin θ)/|ω|³ [ω]²) e3,   R <- R exp([ω] l),

exact for any step, so there is no accuracy to be traded for time. `TIP_OFFSET` is p less the
straight path (its shortfall along the axis too), `TIP_SLOPE` the tip's direction less the axis.

`drifting` adds the three noise rates of Park et al. 2010 (Robotica 28:1035, PMC3107577), about both
transverse axes and of roll, as white noise over length: a variance of λ² per metre. It is drawn for
every bin of 1 mm and constant within, so the path of a seed is the same for any step. Assumed is
0.08 rad/√m for each, which is 1.5 mm beside the arc after 100 mm; Park fitted flexible needles.

κ of these two: 0.3e-3 /mm for 17 and 18 G, 1.1e-3 /mm for 20 G and thinner: what 153 respondents,
125 of them radiologists, call the most bending they met, 5.3 mm (de Jong 2018, doi
10.2147/MDER.S160444), is 1.06e-3 /mm over 100 mm; a biopsy robot measured 1.28e-3 /mm ex vivo and
1.97e-3 /mm in a hard phantom (Tavakol).

`gel` and `organ` are arcs as measured, by gauge. In ballistic gel 22 G needles are 9.96 (short
bevel), 8.89 (Quincke) and 7.71 mm (Chiba) beside their line after 80 mm, and 25 G more (Rand 2016,
Anesth Pain Med 6:e36607): their mean is 2.77 /m. Tavakol's tracks are of 18 G needles: 1.97 /m in a
hard phantom, 1.28 /m ex vivo. Between and beyond both, κ goes with a power of the needle's bending
stiffness, which these two gauges give as -0.15 (an estimate: two gels, two bevels); thicker bends
less, as in styrofoam (doi 10.4097/kjae.2000.39.6.876). In an organ κ is 0.65 of that in gel:
Tavakol's ratio, of one needle. That excludes the 0.3 /m of `arc` for 18 G; what is measured is
taken, and the respondents' 5.3 mm are a wish of the worst, no measurement.

Pulling back leads the tip back along its own channel; what lay deeper is forgotten, and pushing
again cuts anew, with the roll of then: so a needle is steered. Turning it at rest moves nothing.

With `lateral_tissue` both bends add: the bow is taken as the needle's own shape, at rest in the
channel that it cuts, so it pushes neither tissue nor hub. Neglected are what the shaft's stiffness
takes back of it, that it turns with a needle that is tilted later (0.3 mm for 5 mm and 3°), and
that a curvature rises with a tissue's stiffness. The drawn shaft has the tip's place and direction;
`core.bend` lets its curvature end at the tip, so between it is off by up to 0.04 κ depth² (0.3 mm
for 20 G at 85 mm, 0.1 mm for 18 G).

No force, no energy: its axial cost is the cutting's.
"""

from collections.abc import Mapping
from math import log
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "A bevelled tip cuts a curved path",
    "reads": ("axis", "depth", "depth_source", "kinematics", "needle_roll"),
    "writes": ("tip_offset", "tip_slope", "root_curvature", "bent_length"),
    "consumers": ("views and score of the tip",),
    "needs": ("needle",),
    "models": {
        "arc": "constant curvature towards the roll; exact at any step",
        "drifting": "the same with three noises per length, drawn by a seed",
        "organ": "an arc as measured ex vivo, by gauge",
        "gel": "an arc as measured in gels, by gauge",
    },
    "energy": ("dissipative", "gives no force; what the tip's way costs is the cutting's"),
    "cost_class": "A",
    "parameters": {
        "curvature_thick": (0.3, "1/m", 0.0, 10.0, "of the path of 17 and 18 G needles"),
        "curvature_thin": (1.1, "1/m", 0.0, 10.0, "of the path of 20 G needles and thinner"),
        "first_roll": (0.0, "rad", -6.2832, 6.2832, "where the bevel cuts to before it is turned"),
        "bending_noise": (0.08, "rad/m^½", 0.0, 5.0, "in the plane of the bevel (drifting)"),
        "side_noise": (0.08, "rad/m^½", 0.0, 5.0, "across that plane (drifting)"),
        "roll_noise": (0.08, "rad/m^½", 0.0, 5.0, "of the tip's roll (drifting)"),
        "draws": (1.0, "-", 0.0, 1e6, "seed of the noise (drifting)"),
        "bend_scale": (1.0, "-", 0.0, 4.0, "factor on the measured curvature (gel, organ)"),
        "organ_share": (0.65, "-", 0.0, 1.0, "of gel's curvature in an organ (organ)"),
    },
    "published": {
        "curvature_thick": (
            0.1,
            1.97,
            "0.3 by stiffness against thin needles; 1.28 ex vivo to 1.97 in a phantom, Tavakol",
            (1.28, 1.97),
        ),
        "curvature_thin": (
            1.06,
            3.13,
            "5.3 mm over 100 mm, de Jong 2018; 7.71 to 9.96 mm over 80 mm of gel, Rand 2016",
            (1.06, 2.41, 2.78, 3.12),
        ),
        "bend_scale": (
            0.87,
            1.13,
            "7.71 to 9.96 mm about the mean of 8.85 mm, Rand 2016",
            (0.87, 1.0, 1.126),
        ),
        "organ_share": (
            0.64,
            0.66,
            "1.28 ex vivo over 1.97 /m in a hard phantom, Tavakol",
            (0.65,),
        ),
    },
}

BIN: Final = 2.0**-10  # [m] between remembered poses; a power of two, so that edges are exact
_THIN: Final = 1.0e-3  # [m] outer diameter below which a needle is thin
_SHORT: Final = 1e-4  # [rad] turns below which the exponential is taken by its series
_DEEPER: Final = 0.05  # [m] beyond the needle's length that a depth may be measured


class _BevelPlaces(NamedTuple):
    """Constants; roll [rad] with which it went in, depth, place [m] and frame (quaternion) of the
    tip.
    """

    curvature: int
    roll: int
    bins: int
    first: int
    depth: int = 0
    p_x: int = 0
    p_y: int = 0
    p_z: int = 0
    q_w: int = 0
    q_x: int = 0
    q_y: int = 0
    q_z: int = 0


class _PosePlaces(NamedTuple):
    """Of a bin: place and frame of the tip at its upper edge, and the noise rates within."""

    p_x: int
    p_y: int
    p_z: int
    q_w: int
    q_x: int
    q_y: int
    q_z: int
    bending: int
    side: int
    twist: int


_AT: Final = numbered(_BevelPlaces)
_POSE: Final = numbered(_PosePlaces)
_SIZE: Final = 7  # of a pose


IN_GEL: Final = ((18, 1.97), (22, 2.77))
"""Gauge, curvature in gel [1/m]: Tavakol's hard phantom, the mean of Rand's three bevels."""


def measured_curvature(diameter: float) -> float:
    """Return the curvature in gel of a needle's path [1/m], by its outer diameter [m].

    A power of the bending stiffness of a solid rod through both measurements.
    """
    (thick, low), (thin, high) = IN_GEL
    power = log(low / high) / log(OUTER_DIAMETER[thick] / OUTER_DIAMETER[thin])
    return float(low * (diameter / OUTER_DIAMETER[thick]) ** power)


def _curvature(values: Mapping[str, float], binding: Binding) -> float:
    diameter = binding.scene.needle.outer_diameter
    if binding.model in ("gel", "organ"):
        medium = values["organ_share"] if binding.model == "organ" else 1.0
        return values["bend_scale"] * medium * measured_curvature(diameter)
    thick, thin = values["curvature_thick"], values["curvature_thin"]
    return thin if diameter < _THIN else thick


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh parameters array: the tip at the skin, along the axis."""
    needle = binding.scene.needle
    bins = int(np.ceil((needle.length + _DEEPER) / BIN))
    poses = np.zeros((bins + 1, len(_POSE)))
    poses[:, _POSE.q_w] = 1.0
    if binding.model == "drifting":
        drawn = np.random.default_rng([int(values["draws"]), 14]).standard_normal((bins + 1, 3))
        scales = [values[name] for name in ("bending_noise", "side_noise", "roll_noise")]
        poses[:, _POSE.bending :] = drawn * scales / np.sqrt(BIN)
    return packed(
        _AT,
        poses.ravel(),
        curvature=_curvature(values, binding),
        roll=values["first_roll"],
        bins=bins,
        first=np.nan,
        q_w=1.0,
    )


@njit
def turned(q: Any, v: Any) -> tuple[float, float, float]:
    """Rotate the vector v by the unit quaternion q (w, x, y, z)."""
    w, x, y, z = q
    tx, ty, tz = (
        2.0 * (y * v[2] - z * v[1]),
        2.0 * (z * v[0] - x * v[2]),
        2.0 * (x * v[1] - y * v[0]),
    )
    return (
        v[0] + w * tx + y * tz - z * ty,
        v[1] + w * ty + z * tx - x * tz,
        v[2] + w * tz + x * ty - y * tx,
    )


@njit
def moved(p: Any, q: Any, twist: Any, length: float) -> Any:
    """Place [m] and frame after `length` [m] ahead under a constant twist [rad/m]; exact."""
    a, b, c = twist
    square = a * a + b * b + c * c
    rate = np.sqrt(square)
    turn = rate * length
    if turn < _SHORT:  # 1 - cos θ and θ - sin θ cancel; the series is good to 1e-17 here
        first = 0.5 * length * length
        second = length * length * length / 6.0
        half = 0.5 * length
    else:
        first, second = (1.0 - np.cos(turn)) / square, (turn - np.sin(turn)) / (square * rate)
        half = np.sin(0.5 * turn) / rate
    # [ω] e3 and [ω]² e3 for ω = (a, b, c)
    step = (
        first * b + second * a * c,
        -first * a + second * b * c,
        length - second * (a * a + b * b),
    )
    sx, sy, sz = turned(q, step)
    w, x, y, z = q
    d, e, f, g = np.cos(0.5 * turn), half * a, half * b, half * c
    n = (
        w * d - x * e - y * f - z * g,
        w * e + x * d + y * g - z * f,
        w * f - x * g + y * d + z * e,
        w * g + x * f - y * e + z * d,
    )
    norm = np.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] + n[3] * n[3])
    frame = (n[0] / norm, n[1] / norm, n[2] / norm, n[3] / norm)
    return (p[0] + sx, p[1] + sy, p[2] + sz), frame


@njit
def _pose(p: FloatArray, at: int) -> Any:
    return (p[at], p[at + 1], p[at + 2]), (p[at + 3], p[at + 4], p[at + 5], p[at + 6])


@njit
def _keep(p: FloatArray, at: int, place: Any, frame: Any) -> None:
    p[at], p[at + 1], p[at + 2] = place
    p[at + 3], p[at + 4], p[at + 5], p[at + 6] = frame


@njit
def _bin(j: int) -> int:
    return len(_AT) + len(_POSE) * j


@njit
def advance(p: FloatArray, depth: float, roll: float) -> None:
    """Cut on to `depth` [m] with the bevel at `roll` [rad]."""
    place, frame = _pose(p, _AT.p_x)
    old, k = p[_AT.depth], p[_AT.curvature]
    sine, cosine = np.sin(roll), np.cos(roll)
    for j in range(int(old / BIN), int(p[_AT.bins])):
        at, end = _bin(j), min(depth, (j + 1) * BIN)
        bend, side = k + p[at + _POSE.bending], p[at + _POSE.side]
        twist = (
            -bend * sine + side * cosine,
            bend * cosine + side * sine,
            p[at + _POSE.twist],
        )
        place, frame = moved(place, frame, twist, max(end - max(old, j * BIN), 0.0))
        if depth < (j + 1) * BIN:
            break
        _keep(p, _bin(j + 1), place, frame)
    _keep(p, _AT.p_x, place, frame)
    p[_AT.depth] = depth


@njit
def retreat(p: FloatArray, depth: float) -> None:
    """Go back along the channel to `depth` [m]."""
    old = p[_AT.depth]
    j = int(depth / BIN)
    place, frame = _pose(p, _bin(j))
    last = min(old, (j + 1) * BIN)
    end, there = _pose(p, _AT.p_x if last == old else _bin(j + 1))
    length = last - j * BIN
    if length > 0.0:
        # Within a bin the path is a cubic by places and directions of its ends: 1e-15 m off an arc.
        u = (depth - j * BIN) / length
        begins, ends = turned(frame, (0.0, 0.0, 1.0)), turned(there, (0.0, 0.0, 1.0))
        h = u * u * (3.0 - 2.0 * u)
        g0, g1 = length * u * (1.0 - u) * (1.0 - u), -length * u * u * (1.0 - u)
        place = (
            place[0] + h * (end[0] - place[0]) + g0 * begins[0] + g1 * ends[0],
            place[1] + h * (end[1] - place[1]) + g0 * begins[1] + g1 * ends[1],
            place[2] + h * (end[2] - place[2]) + g0 * begins[2] + g1 * ends[2],
        )
        mixed = (
            frame[0] + u * (there[0] - frame[0]),
            frame[1] + u * (there[1] - frame[1]),
            frame[2] + u * (there[2] - frame[2]),
            frame[3] + u * (there[3] - frame[3]),
        )
        norm = np.sqrt(mixed[0] ** 2 + mixed[1] ** 2 + mixed[2] ** 2 + mixed[3] ** 2)
        frame = (mixed[0] / norm, mixed[1] / norm, mixed[2] / norm, mixed[3] / norm)
    _keep(p, _AT.p_x, place, frame)
    p[_AT.depth] = depth


@njit
def in_world(x: float, y: float, z: float, v: Any) -> tuple[float, float, float]:
    """Turn v from the needle's frame into world, for the axis (x, y, z).

    The frame is world's x, y turned with the axis on the shortest way from straight down, so that
    no azimuth is needed; straight up, where there is no shortest way, it is turned about y.
    """
    # The quaternion from (0, 0, 1) first to straight down (about y), then on to the axis.
    w = 1.0 - z
    if w < 1e-12:
        return v
    fx, fy, fz = v[0], -v[1], -v[2]  # (x, y, z) of the frame straight down: e1 = x, e3 = -z
    norm = np.sqrt(w * w + x * x + y * y)
    return turned((w / norm, y / norm, -x / norm, 0.0), (fx, fy, fz))


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add how the tip's path is bent to TIP_OFFSET_*, TIP_SLOPE_* and ROOT_CURVATURE_*."""
    p, depth = parameters, state[sv.DEPTH]
    x, y, z = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    if state[sv.KINEMATICS] != 0.0 or not np.isfinite(depth + x + y + z):
        return
    if state[sv.DEPTH_SOURCE] == 0.0:  # a depth that nobody measured moves nothing
        depth = p[_AT.depth]
    depth = min(max(depth, 0.0), (p[_AT.bins] - 0.5) * BIN)
    roll = p[_AT.roll] + state[sv.NEEDLE_ROLL]
    if depth > p[_AT.depth] and np.isfinite(roll):
        advance(p, depth, roll)
        if p[_AT.first] != p[_AT.first]:
            p[_AT.first] = roll
    elif depth < p[_AT.depth]:
        retreat(p, depth)
    if not p[_AT.depth] > 0.0:
        p[_AT.first] = np.nan
        return
    place, frame = _pose(p, _AT.p_x)
    heading = turned(frame, (0.0, 0.0, 1.0))
    ox, oy, oz = in_world(x, y, z, (place[0], place[1], place[2] - p[_AT.depth]))
    state[sv.TIP_OFFSET_X] += ox
    state[sv.TIP_OFFSET_Y] += oy
    state[sv.TIP_OFFSET_Z] += oz
    sx, sy, sz = in_world(x, y, z, (heading[0], heading[1], heading[2] - 1.0))
    state[sv.TIP_SLOPE_X] += sx
    state[sv.TIP_SLOPE_Y] += sy
    state[sv.TIP_SLOPE_Z] += sz
    begin = p[_AT.first]
    cx, cy, cz = in_world(
        x, y, z, (p[_AT.curvature] * np.cos(begin), p[_AT.curvature] * np.sin(begin), 0.0)
    )
    state[sv.ROOT_CURVATURE_X] += cx
    state[sv.ROOT_CURVATURE_Y] += cy
    state[sv.ROOT_CURVATURE_Z] += cz
    state[sv.BENT_LENGTH] = max(state[sv.BENT_LENGTH], p[_AT.depth])


def energy_bound(parameters: FloatArray) -> float:
    """Return the energy that it can store behind the hand's forces: none."""
    return 0.0
