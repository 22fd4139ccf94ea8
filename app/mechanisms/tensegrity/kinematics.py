"""Kinematics of the tensegrity needle holder for one pose at a time, and how far it reaches."""

from dataclasses import dataclass
from enum import StrEnum
from itertools import combinations
from math import atan2, cos, degrees, pi, sin, sqrt
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, angle_between, cross, frozen, unit
from app.core.messages import sentence
from app.mechanisms.errors import DegenerateError, MechanismError, UnreachableError
from app.mechanisms.status import NOT_FINITE, OK, Status, check
from app.mechanisms.tensegrity import kernels
from app.mechanisms.tensegrity.geometry import TensegrityGeometry

ENCODER_LINES: Final = 500
"""Lines per turn of the paper's encoders on A1 and A2: 500 counts, or 2000 with all four edges."""

EDGES_PER_LINE: Final = 4


class GuideSingularity(StrEnum):
    """Kind of a singular pose.

    `EXTENDED_*` (β = 0): that pantograph is stretched, the edge of its reach. `FOLDED_*` (β = π):
    the guide stands on that base joint, T on A. Both (type 1) cost the guide a direction. `FLAT`
    (type 2): t lies in the plane of both base axes, t·(a1 × a2) = 0; the two assemblies meet, and
    the guide moves with both joints held.
    """

    EXTENDED_FIRST = "extended_first"
    FOLDED_FIRST = "folded_first"
    EXTENDED_SECOND = "extended_second"
    FOLDED_SECOND = "folded_second"
    FLAT = "flat"


@dataclass(frozen=True, slots=True)
class GuideConditioning:
    """How far a pose is from singular.

    Attributes:
        extended: sin(β/2) of both pantographs; 0 where stretched.
        folded: cos(β/2) of both; 0 where T stands on A.
        flat: t·(a1 × a2).
        dexterity: smaller over larger singular value of dt/dβ; 0 where singular.
        gain: larger singular value [1/rad]: how fast the guide turns with the joints; infinite
            where flat.
        kinds: the singularities within the tolerance asked for; empty for a regular pose.
    """

    extended: tuple[float, float]
    folded: tuple[float, float]
    flat: float
    dexterity: float
    gain: float
    kinds: tuple[GuideSingularity, ...]


def numbers(values: ArrayLike, count: int, name: str) -> list[Any]:
    """Return `count` plain numbers of an array of shape (count,).

    Raises:
        MechanismError: if the shape is another one.
    """
    array = np.asarray(values, dtype=np.float64)
    if array.shape != (count,):
        raise MechanismError(
            sentence(
                "{name} has shape {array_shape}; ({count},) is needed",
                name=name,
                array_shape=array.shape,
                count=count,
            )
        )
    return array.tolist()


def forward(geometry: TensegrityGeometry, beta: ArrayLike, assembly: int = 1) -> FloatArray:
    """Return the unit vector t from O to T, shape (3,), of the joint variables β [rad], shape (2,).

    Args:
        geometry: lengths of the mechanism.
        beta: angle between the bars at A1 and at A2, each in [0, π].
        assembly: sign of t·(a1 × a2); +1 as built.

    Raises:
        UnreachableError: if the cones about the base axes do not meet, or β is outside [0, π].
        NotFiniteError: if an angle is NaN or infinite.
    """
    b1, b2 = numbers(beta, 2, "beta")
    status, *t = kernels.forward_kernel(b1, b2, *geometry.bars, float(assembly))
    if status != OK:
        check(status, f"joint variables β = ({b1}, {b2}) rad")
    return np.array(t)


def inverse(geometry: TensegrityGeometry, t: ArrayLike, assembly: int = 1) -> FloatArray:
    """Joint variables β [rad], shape (2,), of a direction t of any length, shape (3,).

    Raises:
        UnreachableError: if a pantograph is too short, or t lies on the other side of the plane of
            both base axes; the message offers the nearest direction that is reached.
        DegenerateError: if t is zero.
        NotFiniteError: if a component is NaN or infinite.
    """
    x, y, z = numbers(t, 3, "t")
    status, b1, b2 = kernels.inverse_kernel(x, y, z, *geometry.bars, float(assembly))
    if status == Status.UNREACHABLE and assembly == 1:
        near = nearest(geometry, (x, y, z))
        away = degrees(angle_between((x, y, z), near))
        raise UnreachableError(
            sentence(
                "unreachable: direction t = ({x}, {y}, {z}); the nearest within reach is"
                " {near}, {away:.3g}° away",
                x=x,
                y=y,
                z=z,
                near=near.tolist(),
                away=away,
            )
        )
    check(status, f"direction t = ({x}, {y}, {z})")
    return np.array([b1, b2])


def jacobian(geometry: TensegrityGeometry, beta: ArrayLike, assembly: int = 1) -> FloatArray:
    """dt/dβ [1/rad], shape (3, 2); its columns are perpendicular to t.

    Raises:
        SingularError: if the pose is flat.
        MechanismError: as `forward`.
    """
    pose = _pose(geometry, beta, assembly)
    status, *entries = kernels.jacobian_kernel(*pose, *geometry.bars)
    check(status, f"Jacobian at β = {pose[:2]} rad")
    return np.array(entries).reshape(3, 2)


def joint_rates(geometry: TensegrityGeometry, beta: ArrayLike, assembly: int = 1) -> FloatArray:
    """dβ/dt [rad], shape (2, 3): joint rates of a velocity of t; blind to the part along t.

    Raises:
        SingularError: if a pantograph is stretched or folded.
        MechanismError: as `forward`.
    """
    pose = _pose(geometry, beta, assembly)
    status, *entries = kernels.joint_rates_kernel(*pose, *geometry.bars)
    check(status, f"inverse Jacobian at β = {pose[:2]} rad")
    return np.array(entries).reshape(2, 3)


def jacobian_rate(
    geometry: TensegrityGeometry, beta: ArrayLike, rates: ArrayLike, assembly: int = 1
) -> FloatArray:
    """Time derivative of dt/dβ at joint rates [rad/s], shape (2,): shape (3, 2).

    Raises:
        SingularError: if the pose is flat.
        MechanismError: as `forward`.
    """
    b1, b2, *t = _pose(geometry, beta, assembly)
    v1, v2 = numbers(rates, 2, "rates")
    status, *entries = kernels.jacobian_rate_kernel(b1, b2, v1, v2, *t, *geometry.bars)
    what = "joint rates" if status == NOT_FINITE else "Jacobian's rate"
    check(status, f"{what} at β = ({b1}, {b2}) rad, β̇ = ({v1}, {v2}) rad/s")
    return np.array(entries).reshape(3, 2)


def conditioning(
    geometry: TensegrityGeometry, beta: ArrayLike, assembly: int = 1, tolerance: float = 1e-6
) -> GuideConditioning:
    """Return how far from singular a pose is; kinds are named within `tolerance`.

    Raises:
        MechanismError: as `forward`.
    """
    pose = _pose(geometry, beta, assembly)
    far1, near1, far2, near2, flat = kernels.singularity_kernel(*pose, *geometry.bars)
    measures = {
        GuideSingularity.EXTENDED_FIRST: far1,
        GuideSingularity.FOLDED_FIRST: near1,
        GuideSingularity.EXTENDED_SECOND: far2,
        GuideSingularity.FOLDED_SECOND: near2,
        GuideSingularity.FLAT: flat,
    }
    kinds = tuple(kind for kind, value in measures.items() if abs(value) <= tolerance)
    status, *entries = kernels.jacobian_kernel(*pose, *geometry.bars)
    dexterity, gain = kernels.dexterity_kernel(*entries) if status == OK else (0.0, float("inf"))
    return GuideConditioning((far1, far2), (near1, near2), flat, dexterity, gain, kinds)


def nearest(geometry: TensegrityGeometry, t: ArrayLike, margin: float = 0.0) -> FloatArray:
    """Direction nearest to t, shape (3,), that the machine reaches: unit vector, shape (3,).

    The workspace is what three caps of the sphere have in common: θ1 and θ2 up to their largest,
    and the half on which t·(a1 × a2) > 0. So the nearest direction is t itself, its foot on one of
    the three rims, or a corner where two rims meet. `margin` [rad] moves all rims inwards, away
    from the singular poses that they are.

    Raises:
        DegenerateError: if t has no direction.
        UnreachableError: if the margin leaves nothing of the workspace.
    """
    array = np.asarray(t, dtype=np.float64)
    if array.shape != (3,) or not np.isfinite(array).all() or not np.abs(array).max() > 1e-150:
        raise DegenerateError(
            sentence("degenerate: t = {array} has no direction", array=array.tolist())
        )
    wanted = unit(array)
    caps = _caps(geometry, margin)
    found = [wanted]
    for centre, angle in caps:
        found += _foot(wanted, centre, angle)
    for (a, first), (b, second) in combinations(caps, 2):
        found += _corners(a, first, b, second)
    reached = [v for v in found if all(_depth(v, *cap) >= -1e-13 for cap in caps)]
    if not reached:
        raise UnreachableError(
            sentence(
                "unreachable: a margin of {degrees:.4g}° leaves nothing of the workspace;"
                " ask for less",
                degrees=degrees(margin),
            )
        )
    return frozen(min(reached, key=lambda v: angle_between(v, wanted)))


def reaches(geometry: TensegrityGeometry, t: ArrayLike) -> bool:
    """Return whether the machine as built takes the direction t, shape (3,), of any length."""
    x, y, z = numbers(t, 3, "t")
    return bool(kernels.inverse_kernel(x, y, z, *geometry.bars, 1.0)[0] == OK)


def guide_angles(t: ArrayLike) -> tuple[float, float]:
    """Return the paper's end-effector angles (η, μ) [rad] of a direction (equation 5), for display.

    η = atan2(ty, tz), a turn about -x0; μ = atan2(tz, tx), π/2 where upright (errata C6). η does
    not exist along x0, μ not along y0: there atan2 gives 0.
    """
    x, y, z = numbers(t, 3, "t")
    return atan2(y, z), atan2(z, x)


def guide_direction(eta: float, mu: float) -> FloatArray:
    """Return the upper direction t, shape (3,), of the angles η in (-π/2, π/2) and μ in (0, π).

    t ~ (cot μ, tan η, 1).

    Raises:
        DegenerateError: if an angle is at or beyond the end of its range.
    """
    if not (abs(eta) < pi / 2.0 and 0.0 < mu < pi):
        raise DegenerateError(
            sentence(
                "degenerate: (η, μ) = ({eta}, {mu}) rad; η within ±π/2 and μ between 0 and π "
                "point up",
                eta=eta,
                mu=mu,
            )
        )
    return unit((cos(mu) * cos(eta), sin(mu) * sin(eta), sin(mu) * cos(eta)))


def encoder_error(
    geometry: TensegrityGeometry, beta: ArrayLike, steps: int = ENCODER_LINES * EDGES_PER_LINE
) -> tuple[float, float]:
    """Error of the direction from encoders of `steps` per turn: (largest, rms) [rad].

    A joint is known to within half a step 2π/steps; the largest error is that of the worse
    combination of both ends, the rms that of evenly spread angles (step/√12 each), to first order.

    Raises:
        SingularError: if the pose is flat.
        MechanismError: as `forward`; if `steps` is not positive.
    """
    if steps <= 0:
        raise MechanismError(
            sentence("encoder: {steps} steps per turn; a positive number is needed", steps=steps)
        )
    step = 2.0 * pi / steps
    by_joints = jacobian(geometry, beta)
    ends = by_joints @ np.array([[1.0, 1.0], [1.0, -1.0]]) * (0.5 * step)
    largest = float(np.linalg.norm(ends, axis=0).max())
    return largest, float(np.linalg.norm(by_joints)) * step / sqrt(12.0)


def _pose(
    geometry: TensegrityGeometry, beta: ArrayLike, assembly: int
) -> tuple[float, float, float, float, float]:
    b1, b2 = numbers(beta, 2, "beta")
    x, y, z = forward(geometry, beta, assembly).tolist()
    return b1, b2, x, y, z


def _caps(geometry: TensegrityGeometry, margin: float) -> tuple[tuple[FloatArray, float], ...]:
    first, second = geometry.bases
    largest1, largest2 = geometry.largest
    normal = unit(cross(first, second))
    return (
        (first, largest1 - margin),
        (second, largest2 - margin),
        (normal, pi / 2.0 - margin),
    )


def _depth(v: FloatArray, centre: FloatArray, angle: float) -> float:
    return angle - angle_between(v, centre)


def _foot(v: FloatArray, centre: FloatArray, angle: float) -> list[FloatArray]:
    aside = v - np.dot(v, centre) * centre
    size = float(np.linalg.norm(aside))
    if size < 1e-12:  # opposite the middle: all of the rim is equally far, its corners are tried
        return []
    return [cos(angle) * centre + sin(angle) / size * aside]


def _corners(a: FloatArray, first: float, b: FloatArray, second: float) -> list[FloatArray]:
    g, k1, k2 = float(np.dot(a, b)), cos(first), cos(second)
    normal = cross(a, b)
    sine2 = float(np.dot(normal, normal))
    if sine2 < 1e-24:
        return []
    left = sine2 - k1 * k1 - k2 * k2 + 2.0 * g * k1 * k2
    if left < 0.0:
        return []
    middle = ((k1 - g * k2) * a + (k2 - g * k1) * b) / sine2
    return [unit(middle + side * sqrt(left) / sine2 * normal) for side in (1.0, -1.0)]
