"""Statics of the tensegrity needle holder: what four cables must pull, how stiff they make it.

Four cables pull on two joints. The two that are left over are pretension: one per pantograph, it
moves nothing and shifts the stiffness. A load on the needle is two torques on β (virtual work), a
stiffness is that of β with the winches held.
"""

from dataclasses import dataclass
from enum import StrEnum
from math import isfinite
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen, unit
from app.core.messages import sentence
from app.mechanisms.errors import DegenerateError, MechanismError, NotFiniteError, SingularError
from app.mechanisms.status import SINGULAR, UNREACHABLE, check
from app.mechanisms.tensegrity import cable_kernels, kernels
from app.mechanisms.tensegrity.geometry import Cables, TensegrityGeometry
from app.mechanisms.tensegrity.kinematics import forward, inverse, numbers


class TensionVerdict(StrEnum):
    """What became of a request to one pantograph.

    `TORQUE_SHORT`: the load is beyond what the limits allow; the tensions stand at the limits and
    the shortfall says what is missing. `STIFFNESS_LIMITED`: the torque is held, the stiffness is
    the nearest one that the limits allow. `SINGULAR`: β = 0 or π, one cable has no lever and there
    is no pretension.
    """

    MET = "met"
    TORQUE_SHORT = "torque_short"
    STIFFNESS_LIMITED = "stiffness_limited"
    SINGULAR = "singular"


@dataclass(frozen=True, slots=True, eq=False)
class CableTensions:
    """Answer to a load and, if asked, a stiffness.

    Attributes:
        tensions: in the order B1D1, C1A1, B2D2, C2A2 [N], shape (4,), always within the limits.
        shortfall: torque asked for less torque held [N·m], shape (2,); zero where feasible.
        stiffness: of the joints, at held winches [N·m/rad], shape (2,).
        stiffness_range: smallest and largest that pretension reaches under this load, shape
            (2, 2), one row per joint; equal where nothing is left to choose.
        verdicts: one per pantograph.
    """

    tensions: FloatArray
    shortfall: FloatArray
    stiffness: FloatArray
    stiffness_range: FloatArray
    verdicts: tuple[TensionVerdict, TensionVerdict]


CABLE_NAMES: Final = ("B1D1", "C1A1", "B2D2", "C2A2")
"""Names of the cables, in the order of every array of four."""

_MET: Final = 1e-3  # a request counts as met within this share of the stiffness


def lengths(geometry: TensegrityGeometry, beta: ArrayLike) -> FloatArray:
    """Lengths of the four cables between their joints [m], shape (4,), at β [rad], shape (2,)."""
    b = numbers(beta, 2, "beta")
    return np.array(cable_kernels.lengths_kernel(*b, *geometry.radii, *geometry.bars))


def length_jacobian(geometry: TensegrityGeometry, beta: ArrayLike) -> FloatArray:
    """dl/dβ [m/rad], shape (4, 2): each pantograph's joint moves its own two cables."""
    return _by_joint(geometry, beta, 2)


def length_curvature(geometry: TensegrityGeometry, beta: ArrayLike) -> FloatArray:
    """d²l/dβ² [m/rad²], shape (4, 2), zero for the other pantograph's joint; never positive."""
    return _by_joint(geometry, beta, 4)


def tensions(
    geometry: TensegrityGeometry,
    cables: Cables,
    beta: ArrayLike,
    torques: ArrayLike,
    stiffness: ArrayLike | None = None,
) -> CableTensions:
    """Tensions that hold two torques on β [N·m], shape (2,), within the limits of the cables.

    Without `stiffness` the tensions of least norm; with it [N·m/rad], shape (2,), the pretension
    that comes nearest. What cannot be had is named and bounded, never refused.

    Raises:
        MechanismError: if a stiffness is not positive (nothing holds a joint of none).
        NotFiniteError: if an input is NaN or infinite.
    """
    b, asked = numbers(beta, 2, "beta"), numbers(torques, 2, "torques")
    wanted = [0.0, 0.0] if stiffness is None else numbers(stiffness, 2, "stiffness")
    if not all(map(isfinite, (*b, *asked, *wanted))):
        raise NotFiniteError(
            sentence(
                "not finite: β = {b} rad, τ = {asked} N·m, stiffness {wanted}",
                b=b,
                asked=asked,
                wanted=wanted,
            )
        )
    if stiffness is not None and min(wanted) <= 0.0:
        raise MechanismError(
            sentence(
                "stiffness is {wanted} N·m/rad; ask for more than 0, or for none", wanted=wanted
            )
        )
    found: list[float] = []
    short: list[float] = []
    spread: list[tuple[float, float]] = []
    statuses: list[int] = []
    for i, (radius, gain) in enumerate(zip(geometry.radii, geometry.bars[:2], strict=True)):
        _, _, p, q, bend1, bend2 = cable_kernels.cable_kernel(b[i], radius, gain, geometry.bars[2])
        status, t1, t2, missing, soft, hard = cable_kernels.pair_kernel(
            p, -q, bend1, bend2, asked[i], wanted[i], *cables.law, radius
        )
        statuses.append(status)
        found += [t1, t2]
        short.append(missing)
        spread.append((min(soft, hard), max(soft, hard)))
    had = joint_stiffness(geometry, cables, b, found)
    verdicts = [_verdict(s, k, w) for s, k, w in zip(statuses, had, wanted, strict=True)]
    return CableTensions(
        frozen(found), frozen(short), had, frozen(spread), (verdicts[0], verdicts[1])
    )


def _verdict(status: int, had: float, wanted: float) -> TensionVerdict:
    if status == SINGULAR:
        return TensionVerdict.SINGULAR
    if status == UNREACHABLE:
        return TensionVerdict.TORQUE_SHORT
    if wanted > 0.0 and abs(had - wanted) > _MET * wanted:
        return TensionVerdict.STIFFNESS_LIMITED
    return TensionVerdict.MET


def torques(geometry: TensegrityGeometry, beta: ArrayLike, pulled: ArrayLike) -> FloatArray:
    """Torques on β [N·m], shape (2,), of four tensions [N], shape (4,): τ = -(dl/dβ)ᵀ t."""
    b, t = numbers(beta, 2, "beta"), numbers(pulled, 4, "tensions")
    return np.array(cable_kernels.torques_kernel(*t, *b, *geometry.radii, *geometry.bars))


def torque_limits(geometry: TensegrityGeometry, cables: Cables, beta: ArrayLike) -> FloatArray:
    """Smallest and largest torque on each joint [N·m], shape (2, 2): rows joints, (low, high)."""
    jacobian = length_jacobian(geometry, beta)
    rows = [(jacobian[2 * i, i], -jacobian[2 * i + 1, i]) for i in range(2)]
    return np.array(
        [(q * cables.least - p * cables.most, q * cables.most - p * cables.least) for p, q in rows]
    )


def joint_stiffness(
    geometry: TensegrityGeometry, cables: Cables, beta: ArrayLike, pulled: ArrayLike
) -> FloatArray:
    """Stiffness of both joints at held winches [N·m/rad], shape (2,): Σ k l'² + Σ t l''."""
    b, t = numbers(beta, 2, "beta"), numbers(pulled, 4, "tensions")
    return frozen(
        cable_kernels.joint_stiffness_kernel(*t, *b, *cables.law, *geometry.radii, *geometry.bars)
    )


def slack(pulled: ArrayLike) -> tuple[str, ...]:
    """Names of the cables that carry no tension, of four [N], shape (4,): B1D1, C1A1, ..."""
    return tuple(
        name
        for name, tension in zip(CABLE_NAMES, numbers(pulled, 4, "tensions"), strict=True)
        if not tension > 0.0
    )


def hub_torques(jacobian: ArrayLike, force: ArrayLike, l_out: float) -> FloatArray:
    """Torques on β [N·m], shape (2,), that make the hand feel `force` [N], shape (3,).

    Args:
        jacobian: dt/dβ, shape (3, 2).
        force: at the hub; its part along the needle cannot be delivered and drops out.
        l_out: from the remote centre to the hub [m].
    """
    entries = np.asarray(jacobian, dtype=np.float64).ravel()
    f = numbers(force, 3, "force")
    return np.array(cable_kernels.hub_torque_kernel(*f, l_out, *_six(entries)))


def hub_force(rates: ArrayLike, torque: ArrayLike, l_out: float) -> FloatArray:
    """Force across the needle [N], shape (3,), that torques [N·m], shape (2,), make the hand feel.

    Args:
        rates: dβ/dt of `joint_rates`, shape (2, 3).
        torque: on β.
        l_out: from the remote centre to the hub [m], positive.

    Raises:
        DegenerateError: if `l_out` is not positive.
    """
    if not l_out > 0.0:
        raise DegenerateError(
            sentence("degenerate: L_out = {l_out} m; a hub stands outside the centre", l_out=l_out)
        )
    entries = np.asarray(rates, dtype=np.float64).ravel()
    tau = numbers(torque, 2, "torque")
    return np.array(cable_kernels.hub_force_kernel(*tau, l_out, *_six(entries)))


def guide_stiffness(
    geometry: TensegrityGeometry, cables: Cables, t: ArrayLike, pulled: ArrayLike
) -> FloatArray:
    """Stiffness of the needle's direction against turning about the remote centre [N·m/rad].

    Second derivative of the energy of the cables on the sphere of directions, winches held, as a
    symmetric (3, 3) with t in its kernel: Bᵀ diag(k) B with B = dβ/dt, and where the cables hold a
    load also -Σ τ Hess β, Hess β = -(k''/k'³) a⊥ a⊥ᵀ - (cos θ/k')(1 - t tᵀ), k = cos θ by β. A
    hand that holds a dead force F at the hub adds L_out (F·t)(1 - t tᵀ). Divided by L_out² it is
    the stiffness at the hub [N/m]. Where the pose is flat, one direction has none.

    Raises:
        SingularError: if a pantograph is stretched or folded: a joint that does not move turns
            its stiffness into no bound.
        MechanismError: as `inverse`.
    """
    beta, axis = inverse(geometry, t), unit(t)
    loads = torques(geometry, beta, pulled)
    joints = joint_stiffness(geometry, cables, beta, pulled)
    across = np.eye(3) - np.outer(axis, axis)
    total = np.zeros((3, 3))
    bars = geometry.bars
    for base, gain, b, load, joint in zip(
        geometry.bases, bars[:2], beta.tolist(), loads, joints, strict=True
    ):
        sine, cosine, rate, second = kernels.opening_kernel(b, gain, bars[2])
        slope = -sine * rate
        if abs(slope) <= 1e-12:
            raise SingularError(
                sentence("singular: stiffness of the guide at β = {beta} rad", beta=beta.tolist())
            )
        bend = -cosine * rate * rate - sine * second
        aside = across @ base
        lever = np.outer(aside, aside)
        total += joint / slope**2 * lever
        total += load * (bend / slope**3 * lever + cosine / slope * across)
    return total


def force_limit(
    geometry: TensegrityGeometry, cables: Cables, beta: ArrayLike, l_out: float
) -> float:
    """Largest force that the hand can be made to feel in its worst direction across the needle [N].

    Raises:
        SingularError: if the pose is flat: no force is held in one direction there.
        MechanismError: as `forward`.
    """
    b = numbers(beta, 2, "beta")
    status, *six = kernels.jacobian_kernel(*b, *forward(geometry, beta), *geometry.bars)
    check(status, f"force at the hub at β = {b} rad")
    gains = np.linalg.norm(np.reshape(six, (3, 2)), axis=0) * l_out
    limits = torque_limits(geometry, cables, beta)
    room = np.minimum(limits[:, 1], -limits[:, 0])
    moving = gains > 0.0
    return max(0.0, float((room[moving] / gains[moving]).min(initial=np.inf)))


def _by_joint(geometry: TensegrityGeometry, beta: ArrayLike, first: int) -> FloatArray:
    b = numbers(beta, 2, "beta")
    out = np.zeros((4, 2))
    for i, (radius, gain) in enumerate(zip(geometry.radii, geometry.bars[:2], strict=True)):
        found = cable_kernels.cable_kernel(b[i], radius, gain, geometry.bars[2])
        out[2 * i : 2 * i + 2, i] = found[first : first + 2]
    return out


def _six(entries: FloatArray) -> list[Any]:
    if entries.shape != (6,):
        raise MechanismError(
            sentence("Jacobian has {entries} entries; 6 are needed", entries=len(entries))
        )
    return entries.tolist()
