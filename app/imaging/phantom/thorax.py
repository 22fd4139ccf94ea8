"""Tubes of the chest of patients who have lobes: lung vessels, bronchi, emphysema, intercostals.

Within the lobes nothing crosses a fissure, and nothing comes near the nodule but vessels. Bronchi
are balls of their outer radius; the lumen is what their wall leaves of it.

An intercostal artery runs in the costal groove from where it has reached it: inside the rib, above
its lower border. Nearer to the spine it runs in the middle of the space. Where it reaches the
groove differs: the rib shields 17 % of arteries 3 cm off the spine and 97 % at 6 cm (Helm et al.
2013, doi 10.1378/chest.12-1285, CT angiography).
"""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, unit
from app.imaging.phantom import organs
from app.imaging.phantom.lobes import (
    LEFT_LOWER,
    LEFT_UPPER,
    RIGHT_LOWER,
    RIGHT_MIDDLE,
    RIGHT_UPPER,
    fissures,
    lobes,
)
from app.imaging.phantom.patient import MODEL_TOP, Patient, Point
from app.imaging.phantom.shapes import smoothstep
from app.imaging.phantom.skeleton import RIBS
from app.imaging.phantom.trunk import cavity_radius
from app.imaging.phantom.tubes import Tubes, joined, tube

WALL_SHARE: Final = 0.3
"""Thickness of a bronchus' wall as a share of its radius."""

LEAST_BRONCHUS_MM: Final = 1.5
"""Radius at which bronchi end [mm]."""

_ROOTS: Final[dict[str, tuple[Point, int, int]]] = {
    # where its tubes come from, its vessels, its bronchi
    RIGHT_LOWER: ((-40.0, 14.0, 332.0), 55, 9),
    RIGHT_MIDDLE: ((-48.0, -62.0, 277.0), 26, 5),
    RIGHT_UPPER: ((-44.0, -30.0, 330.0), 26, 4),
    LEFT_LOWER: ((40.0, 14.0, 332.0), 55, 9),
    LEFT_UPPER: ((48.0, -34.0, 325.0), 40, 6),
}
_TRIES: Final = 60
_BULLAE: Final = 14  # of each lung
_CLEAR_OF_NODULE_MM: Final = 6.0

ARTERY_MM, VEIN_MM = 1.0, 1.2
"""Radii."""

_REACHED_MM, _SPREAD_MM = 43.3, 10.6
"""Mean and deviation of where the groove is reached, sideways from the midline: of a normal
distribution with 17 % below 30 mm and 97 % below 60 mm (mean 40.1 mm), and 3.2 mm more: the artery
lies above the border 1.9 mm before, and 1.3 mm nearer to the midline than the rib's middle."""

_RISES_MM: Final = 14.0  # over which it climbs from the middle of the space
_IN_SPACE: Final = (-3.2, -13.0)  # off the rib cage's middle, and below the rib's
_IN_GROOVE: Final = (-4.2, -5.0)
_VEIN_OFF: Final = (-0.8, 2.6)  # from the artery
_RIB_AT: Final = 5.0  # of the rib cage's middle from the wall's inner surface [mm]


@lru_cache(maxsize=4)
def lung_tubes(patient: Patient) -> tuple[Tubes, Tubes]:
    """Return vessels and bronchi of a patient who has lobes, the latter by their outer radius."""
    rng = patient.generator(11)
    vessels, bronchi = [], []
    for lobe, (root, count, airways) in _ROOTS.items():
        some, others = [], []
        for number in range(count):
            end = _end(patient, rng, lobe)
            start = float(rng.uniform(0.9, 2.6))
            bend = rng.normal(0.0, 6.0, 3)
            way = np.array([root, 0.5 * (np.array(root) + end) + bend, end])
            some.append(tube(way, [start, 0.7 * start, 0.5]))
            if number < airways:
                wide = float(rng.uniform(2.3, 3.4))
                beside = unit(np.cross(end - np.array(root), rng.standard_normal(3)))
                shift = (start + wide + 0.5) * beside
                tip = way[1] + 0.6 * (end - way[1])
                knots = np.array([way[0] + shift, way[1] + 0.9 * shift, tip + 0.7 * shift])
                thin = max(LEAST_BRONCHUS_MM, 0.55 * wide)
                others.append(tube(knots, [wide, 0.8 * wide, thin]))
        vessels.append(_within(patient, joined(some), lobe))
        bronchi.append(_within(patient, joined(others), lobe, clear_of_nodule=True))
    return joined(vessels), joined(bronchi)


def _end(patient: Patient, rng: np.random.Generator, lobe: str) -> FloatArray:
    """Draw where a vessel of a lobe ends."""
    sign = -1.0 if lobe.startswith("right") else 1.0
    point = np.zeros(3)
    for _ in range(_TRIES):
        angle, reach = rng.uniform(0.0, 2.0 * np.pi), np.sqrt(rng.uniform(0.05, 1.0))
        x, y = 76.0 * sign + 58.0 * reach * np.cos(angle), 84.0 * reach * np.sin(angle)
        point = np.array([x, y, rng.uniform(205.0, MODEL_TOP + 8.0)])
        if lobes(patient, _place(patient, point[None]))[lobe][0] < -3.0:
            break
    return point


def _place(patient: Patient, points: FloatArray) -> organs.Place:
    x, y, z = points.T
    return organs.place_of(patient, x, y, z)


def _within(patient: Patient, tubes: Tubes, lobe: str, clear_of_nodule: bool = False) -> Tubes:
    """Keep what runs in a lobe."""
    balls = tubes.balls
    depth = lobes(patient, _place(patient, balls[:, :3]))[lobe]
    keep = depth < -balls[:, 3] - 0.6
    if clear_of_nodule:
        keep &= _off_nodule(patient, balls) > 2.0
    return Tubes(balls[keep])


def _off_nodule(patient: Patient, balls: FloatArray) -> FloatArray:
    """Room between balls and the nodule [mm]."""
    centre, radius = patient.own_nodule
    gap: FloatArray = np.linalg.norm(balls[:, :3] - centre, axis=1) - balls[:, 3] - radius
    return gap


@lru_cache(maxsize=4)
def emphysema(patient: Patient) -> Tubes:
    """Return balls of destroyed lung: near its surface, more of them and larger further up.

    Clear of pleura, fissures and nodule; in what the scan shows.
    """
    rng = patient.generator(12)
    found: list[FloatArray] = []
    for sign in (-1.0, 1.0):
        side: list[FloatArray] = []
        for _ in range(60 * _BULLAE):
            up = float(np.sqrt(rng.uniform()))
            x, y = rng.uniform((20.0, -95.0), (150.0, 80.0))
            z, radius = 252.0 + 46.0 * up, rng.uniform(3.0, 6.0 + 5.0 * up)
            ball = np.array([sign * x, y, z, radius])
            at = _place(patient, ball[None, :3])
            depth = -float(organs.lungs(patient, at)[0])
            clear = float(fissures(patient).away(at)[0]) > radius + 2.0
            gaps = [np.linalg.norm(ball[:3] - one[:3]) - 0.7 * (radius + one[3]) for one in side]
            apart = min(gaps, default=1.0) > 0.0
            off = float(_off_nodule(patient, ball[None])[0]) > _CLEAR_OF_NODULE_MM
            if radius + 1.5 < depth < radius + 14.0 and clear and apart and off:
                side.append(ball)
            if len(side) == _BULLAE:
                break
        found += side
    return Tubes(np.array(found).reshape(-1, 4))


def intercostals(patient: Patient) -> tuple[Tubes, Tubes]:
    """Return arteries and veins."""
    rng = patient.generator(13)
    arteries, veins = [], []
    for rib in RIBS:
        for sign in (-1.0, 1.0):
            reached = float(rng.normal(_REACHED_MM, _SPREAD_MM))
            p = np.arange(0.055, rib.end, 0.0011)
            theta = np.arctan2(np.cos(p * np.pi), sign * np.sin(p * np.pi))
            below = rib.z(p)
            for _ in range(2):  # how far aside a place is depends on the wall there
                rho = cavity_radius(patient, theta, below) + _RIB_AT
                aside = rho * np.sin(p * np.pi) * patient.scale[0]
                share = smoothstep((aside - reached + _RISES_MM) / _RISES_MM)
                off, drop = (
                    a + (b - a) * share for a, b in zip(_IN_SPACE, _IN_GROOVE, strict=True)
                )
                below = rib.z(p) + drop
            arteries.append(_balls(patient, theta, below, off, ARTERY_MM))
            out, up = _VEIN_OFF
            veins.append(_balls(patient, theta, below + up, off + out, VEIN_MM))
    return Tubes(np.vstack(arteries)), Tubes(np.vstack(veins))


def _balls(
    patient: Patient, theta: FloatArray, z: FloatArray, off: FloatArray, radius: float
) -> FloatArray:
    rho = cavity_radius(patient, theta, z) + _RIB_AT + off
    width = np.full_like(z, radius)
    return np.column_stack([rho * np.cos(theta), rho * np.sin(theta), z, width])
