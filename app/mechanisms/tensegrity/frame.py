"""Stiffness of the remote centre itself: what its bars give under a force, *assumed* bars.

The paper names the vertical stiffness as the prototype's weakness and gives no bars. Here every
bar is a slender beam along a great circle. All joint axes run through O, so a chain A, B, T passes
on nothing but a force F through O, and whatever the pose a section at r carries the moment r × F:
torsion R F·n and bending R F·τ (n the normal of the bar's plane, τ its tangent), no moment about
its joint axis. So each bar has, by Castigliano, the compliance

    C = R³ (φ n nᵀ/(G J) + ∫ τ τᵀ dφ/(E I)) + R ∫ τ τᵀ dφ/(E A),

bars of a chain add their compliances, the chains A B T and A D T of a rhombus and the two
pantographs their stiffnesses. Joints, shear and the base count as rigid. Two rhombi of the scissor
reading count as one behind the other: the bars that cross in C are taken as joined there.
"""

from math import atan2, cos, sin

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, cross, unit
from app.mechanisms.tensegrity.geometry import CurvedBars, TensegrityGeometry
from app.mechanisms.tensegrity.points import MachinePoints, machine_points

_TORSION = 0.1406
"""J/w⁴ of a square section of width w (Saint-Venant)."""


def remote_centre_stiffness(
    geometry: TensegrityGeometry, bars: CurvedBars, t: ArrayLike
) -> FloatArray:
    """Force through the remote centre by its displacement [N/m], shape (3, 3), machine axes.

    Of the guide in the direction t, shape (3,). Its inverse, the compliance, says how far O moves
    under a force: zᵀ C z under a vertical one, tᵀ C t under the thrust of an insertion.

    Raises:
        MechanismError: as `machine_points`.
    """
    shown = machine_points(geometry, t)
    total = np.zeros((3, 3))
    for number, radius in zip("12", geometry.radii, strict=True):
        stops = "ACT" if geometry.rhombi == 2 else "AT"
        sides = ("BD", "EF")[: geometry.rhombi]
        give = np.zeros((3, 3))
        for near, far, pair in zip(stops, stops[1:], sides, strict=False):
            held = np.zeros((3, 3))
            for joint in pair:
                chain = _bar(shown, near + number, joint + number, radius, bars)
                chain = chain + _bar(shown, joint + number, far + number, radius, bars)
                held += np.linalg.inv(chain)
            give += np.linalg.inv(held)
        total += np.linalg.inv(give)
    return np.asarray(0.5 * (total + total.T))


def _bar(shown: MachinePoints, near: str, far: str, radius: float, bars: CurvedBars) -> FloatArray:
    start, end = unit(shown.points[near]), unit(shown.points[far])
    normal = cross(start, end)
    angle = atan2(float(np.linalg.norm(normal)), float(start @ end))
    normal = unit(normal)
    ahead = cross(normal, start)
    # ∫ τ τᵀ with τ = -sin φ start + cos φ ahead
    double = 0.25 * sin(2.0 * angle)
    mixed = 0.25 * (1.0 - cos(2.0 * angle))
    along = (
        (0.5 * angle - double) * np.outer(start, start)
        + (0.5 * angle + double) * np.outer(ahead, ahead)
        - mixed * (np.outer(start, ahead) + np.outer(ahead, start))
    )
    width2 = bars.width**2
    bending = radius**3 / (bars.modulus * width2 * width2 / 12.0)
    twisting = radius**3 / (bars.shear_modulus * _TORSION * width2 * width2)
    stretching = radius / (bars.modulus * width2)
    return np.asarray(twisting * angle * np.outer(normal, normal) + (bending + stretching) * along)
