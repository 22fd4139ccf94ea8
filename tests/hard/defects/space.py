"""Defects of the hard cases in space: angles by arc cosines, turns by traces, single precision."""

from math import acos, pi
from types import SimpleNamespace
from typing import Any

import numpy as np

from app.core.arrays import FloatArray, unit
from app.core.rotation import closest_rotation, rotation_exp, rotation_log, skew
from app.core.transform import RigidTransform
from app.planning.measurements import Angle
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from tests.hard.defects import Defect


def angle_by_acos(a: Any, b: Any) -> float:
    return acos(float(np.clip(unit(a) @ unit(b), -1.0, 1.0)))


def log_by_trace(r: Any) -> FloatArray:
    """Angle by the trace, axis by the antisymmetric part: wrong near zero and half a turn."""
    r = np.asarray(r)
    angle = acos(float(np.clip((np.trace(r) - 1.0) / 2.0, -1.0, 1.0)))
    aside = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    sine = 2.0 * np.sin(angle)
    return np.asarray(angle / sine * aside if sine > 1e-12 else np.zeros(3))


def half_forgotten(v: Any) -> FloatArray:
    angle = float(np.linalg.norm(v))
    k = skew(np.asarray(v) / angle)
    return np.eye(3) + np.sin(angle) * k + 0.5 * (1.0 - np.cos(angle)) * (k @ k)


def naive(u: Any, v: Any) -> FloatArray:
    w = skew(np.cross(u, v))
    return np.asarray(np.eye(3) + w + w @ w / max(1.0 + float(u @ v), 1e-300))


def by_pythagoras(p_tip: Any, axis: Any, placed: Any, p_target: Any) -> Any:
    beyond = p_tip - placed.p_entry
    along = beyond @ placed.axis
    return SimpleNamespace(lateral=np.sqrt(max(beyond @ beyond - along * along, 0.0)))


def drawn_by_acos(item: Angle, _: Any) -> Any:
    a, v, b = (np.array(p) for p in item.points)
    value = np.degrees(angle_by_acos(a - v, b - v))
    return SimpleNamespace(quantities=[SimpleNamespace(value=value)])


def without_centroids(x: Any, y: Any) -> Any:
    rotation, _ = closest_rotation(x.T @ y)
    transform = RigidTransform(rotation, y.mean(axis=0) - rotation @ x.mean(axis=0))
    return SimpleNamespace(T_measured_reference=transform)


def along_y(u: Any, v: Any) -> FloatArray:
    return np.array([0.0, pi, 0.0])


def single(plan: Any, placement: Any, fulcrum: Any) -> Any:
    rounded = Plan(*(np.float64(np.float32(mm)) for mm in (plan.entry_mm, plan.target_mm)))
    return PlacedPlan.of(rounded, placement, fulcrum)


def cone_by_acos(axis: Any, angle: float) -> Any:
    aside = np.sqrt(max(1.0 - np.cos(angle) ** 2, 0.0))
    return [axis, np.array([aside, 0.0, -np.cos(angle)])]


def by_superior(tip: Any, axis: Any) -> Any:
    """Roll by the superior direction alone, which a needle along the body has none of."""
    y = np.array([0.0, 0.0, 1.0]) - axis[2] * axis
    length = max(float(np.linalg.norm(y)), 1e-6)
    y = y / length
    return SimpleNamespace(axis=axis, x=np.cross(axis, y), y=y)


DEFECTS = {
    "rotations": {
        "rotation matrix of a turn by 1e-9 short of half a turn": Defect(
            "half of 1 - cos forgotten", half_forgotten
        ),
        **dict.fromkeys(
            (
                f"rotation matrix of a turn by {angle} rad, its antisymmetric part"
                for angle in ("1e-8", "1e-160")
            ),
            Defect("no turn at all where cos is 1", lambda v: np.eye(3)),
        ),
        **dict.fromkeys(
            (
                "rotation vector of a turn by 1e-9 short of half a turn",
                "rotation vector of a turn by 1e-10 rad",
            ),
            Defect("angle by the trace, axis by the antisymmetric part", log_by_trace),
        ),
        "rotation vector of a turn by 3 rad": Defect(
            "half the angle", lambda r: 0.5 * rotation_log(r)
        ),
        "turn of a direction onto one 2e-9 rad short of its opposite": Defect(
            "1 + cos in the denominator", naive
        ),
        "shift of a screw of 2e-4 rad, just beyond where the series ends": Defect(
            "the shift as it is", lambda xi: RigidTransform(rotation_exp(xi[3:]), xi[:3])
        ),
        "screw of a transform 1e-7 rad short of half a turn": Defect(
            "rotation vector by the trace",
            lambda t: np.concatenate([t.log()[:3], log_by_trace(t.rotation)]),
        ),
        **dict.fromkeys(
            (
                f"angle between directions {apart}"
                for apart in ("1e-9 apart", "1e-150 apart", "1e-9 short of opposite")
            ),
            Defect("acos of the dot product", angle_by_acos),
        ),
    },
    "distances": {
        "a tip 1 nm off a path of 80 mm, at its end": Defect(
            "Pythagoras with the way along the path", by_pythagoras
        ),
        "angle of a needle 1e-9 rad from its path": Defect(
            "acos of the dot product", angle_by_acos
        ),
        "an angle drawn 1e-9 rad short of a straight line": Defect(
            "acos of the dot product", drawn_by_acos
        ),
        **dict.fromkeys(
            (
                "registration of three points turned by half a turn",
                "registration of points 9 m from the origin",
                "registration of points within 3 mm of one line",
            ),
            Defect("the centroids not taken off", without_centroids),
        ),
    },
    "planning": {
        "smallest turn of a path 2e-7 rad short of straight up": Defect(
            "always about the world's y", along_y
        ),
        "remedy of a path that leads straight up, but for 1e-9": Defect(
            "half a turn, as the words would have it",
            lambda *_: SimpleNamespace(remedy=SimpleNamespace(angle=pi)),
        ),
        "a patient 10 km from the scanner's origin": Defect("points in single precision", single),
        "direction of the shortest path that may be planned, 1 km off": Defect(
            "difference of unit vectors from the origin",
            lambda p: unit(unit(p.target_mm) - unit(p.entry_mm)),
        ),
        "directions on a cone of 1e-9 rad about the vertical": Defect(
            "sine by √(1 - cos²)", cone_by_acos
        ),
        "the needle's planes along the body, 2e-9 rad off": Defect(
            "roll by the superior direction alone", by_superior
        ),
    },
}
