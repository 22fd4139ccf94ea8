"""One finger of the hand: lengths, limits, forward, inverse, and one motor for two joints.

The finger's frame stands where its spread axis passes the height of joint 2: z away from the palm,
x towards the finger at spread 0. With ρ the distance from the spread axis in the finger's plane,

    ρ = L1 + L2 cos φ2 + L3 cos(φ2 + φ3 + φ30)      z = L2 sin φ2 + L3 sin(φ2 + φ3 + φ30)

and the point is (ρ cos φ1, ρ sin φ1, z). The paper's 3.2.1 to 3.2.3 leave L1 out, so that they hold
only for a frame at joint 2 (errata D8), and know nothing of ρ < 0, a finger curled over its own
spread axis (D9).

- `forward_kernel(φ1, φ2, φ3, L1, L2, L3, φ30) -> (x, y, z)`
- `inverse_kernel(ρ, z, L1, L2, L3, φ30) -> (status, φ2, φ3)`
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, StrEnum
from math import atan2, cos, hypot, inf, isfinite, pi, sin, sqrt
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.compiled import njit
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.mechanisms.errors import MechanismError, UnreachableError
from app.mechanisms.status import NOT_FINITE, OK, UNREACHABLE, check

_RELATIVE = 1e-12
"""Relative room for rounding: within it a stretched finger is stretched, not out of reach."""

_ROUNDING: Final = 1e-7
"""Room at a joint's limit [rad]; a stretched finger knows its angles no better than √ε."""

_ON_AXIS: Final = 1e-12
"""So near the spread axis the plane of the finger is not told by the point [m]."""

_IN_PLANE: Final = 1e-9
"""So far beside its plane a point may lie for the finger that has no spread [m]."""


@dataclass(frozen=True, slots=True)
class HandGeometry:
    """Lengths, limits and gears of a hand of the Barrett kind.

    Attributes:
        knuckle: spread axis to joint 2, L1 [m].
        proximal: joint 2 to joint 3, L2 [m].
        distal: joint 3 to the grasp point, L3 [m].
        bend: angle from the line of L2 to that of L3 at φ3 = 0, φ30 [rad].
        pad: radius of the fingers' links and of their round tips, which end at L3 [m].
        half_base: half the distance of the spread axes of fingers 1 and 2 [m].
        joint_height: joint 2 above the palm's surface [m].
        palm_radius: of the palm about the hand's axis [m].
        most_proximal, most_distal: upper limits of φ2 and φ3 [rad]; the lower ones are 0.
        most_spread: upper limit of the spread [rad].
        proximal_gear: turns of the motor per turn of joint 2 in free motion.
        distal_gear: turns of the motor per turn of the distal link once joint 2 stands still.
        breakaway: torque at joint 2 at which it lets go of the motor [N·m].

    Raises:
        MechanismError: if a length is not positive, an angle not within a turn, or the gears would
            not close the distal joint in free motion.
    """

    knuckle: float
    proximal: float
    distal: float
    bend: float
    pad: float
    half_base: float
    joint_height: float
    palm_radius: float
    most_proximal: float
    most_distal: float
    most_spread: float
    proximal_gear: float
    distal_gear: float
    breakaway: float

    def __post_init__(self) -> None:
        for name in ("knuckle", "proximal", "distal", "half_base", "joint_height", "palm_radius"):
            if not 0.0 < (value := getattr(self, name)) < inf:
                raise MechanismError(
                    sentence(
                        "hand: {name} is {length} m; a positive length is needed",
                        name=name,
                        length=value,
                    )
                )
        for name in ("most_proximal", "most_distal", "most_spread"):
            if not 0.0 < (value := getattr(self, name)) <= pi:
                raise MechanismError(
                    sentence(
                        "hand: {name} is {angle} rad; give more than 0, at most π",
                        name=name,
                        angle=value,
                    )
                )
        if not 0.0 <= self.pad < self.distal:
            raise MechanismError(
                sentence(
                    "hand: pad is {pad} m; give 0 or more, less than distal, {distal} m",
                    pad=self.pad,
                    distal=self.distal,
                )
            )
        if not 0.0 <= self.bend < pi:
            raise MechanismError(
                sentence("hand: bend is {bend} rad; give 0 or more, less than π", bend=self.bend)
            )
        if not 0.0 < self.distal_gear < self.proximal_gear < inf:
            raise MechanismError(
                sentence(
                    "hand: gears {proximal_gear} (proximal) and {distal_gear} (distal); the "
                    "distal one must be positive and the smaller, or the tip would open in "
                    "closing",
                    proximal_gear=self.proximal_gear,
                    distal_gear=self.distal_gear,
                )
            )
        if not 0.0 < self.breakaway < inf:
            raise MechanismError(
                sentence(
                    "hand: breakaway is {breakaway} N·m; a positive torque is needed",
                    breakaway=self.breakaway,
                )
            )

    @property
    def links(self) -> tuple[float, float, float, float]:
        """Return (L1, L2, L3, φ30) [m, m, m, rad]: what the kernels take."""
        return self.knuckle, self.proximal, self.distal, self.bend

    @property
    def coupling(self) -> float:
        """φ3 per φ2 in free motion: 125/93.75 - 1 = 1/3 for the BH8-282 (errata D12)."""
        return self.proximal_gear / self.distal_gear - 1.0


class HandFinger(Enum):
    """Fingers of the hand: where each stands, and how it turns with the spread.

    The hand's frame has its origin midway between the spread axes of fingers 1 and 2 at the height
    of joint 2, x from finger 1 to finger 2, z away from the palm. At spread 0 fingers 1 and 2 point
    to -y and finger 3, which has no spread, to +y; spread turns the two outwards, to its side.
    """

    ONE = (-1, -1, -pi / 2)
    TWO = (1, 1, -pi / 2)
    THREE = (0, 0, pi / 2)

    @property
    def turn(self) -> int:
        """φ1 per spread, about the finger's z: -1, +1, or 0 without spread."""
        return self.value[1]

    def placed(self, geometry: HandGeometry) -> RigidTransform:
        """Return T_hand_finger."""
        side, _, heading = self.value
        c, s = cos(heading), sin(heading)
        rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        return RigidTransform(rotation, np.array([side * geometry.half_base, 0.0, 0.0]))


class FingerSide(StrEnum):
    """Branch of the inverse: on which side of its spread axis the finger holds the point.

    `OUTWARD`: ρ ≥ 0. `OVER`: ρ < 0, curled over the palm; the spread is half a turn further.
    """

    OUTWARD = "outward"
    OVER = "over"


class Coupling(StrEnum):
    """How joints 2 and 3 come to stand so.

    `FREE`: on the curve of free motion. `BREAKAWAY`: only after joint 2 was held and let go of the
    motor. `NEVER`: the distal joint is less bent than free motion bends it.
    """

    FREE = "free"
    BREAKAWAY = "breakaway"
    NEVER = "never"


@dataclass(frozen=True, slots=True, eq=False)
class FingerPose:
    """One answer of the inverse.

    Attributes:
        joints: (φ1, φ2, φ3) [rad], shape (3,); zero without an answer.
        side: the branch.
        coupling: how it is reached.
        spread: the spread that it needs [rad], in (-π, π]; 0 for finger 3.
        beyond_spread: whether that spread is outside the hand's limits.
        any_spread: whether the point lies on the spread axis: every φ1 holds it.
        refused: why the branch has no answer; empty if it has.
    """

    joints: FloatArray
    side: FingerSide
    coupling: Coupling
    spread: float
    beyond_spread: bool
    any_spread: bool
    refused: str = ""


@njit
def forward_kernel(
    phi1: float, phi2: float, phi3: float, l1: float, l2: float, l3: float, bend: float
) -> tuple[float, float, float]:
    """Grasp point in the finger's frame [m]: (x, y, z)."""
    tip = phi2 + phi3 + bend
    rho = l1 + l2 * cos(phi2) + l3 * cos(tip)
    return rho * cos(phi1), rho * sin(phi1), l2 * sin(phi2) + l3 * sin(tip)


@njit
def inverse_kernel(
    rho: float, z: float, l1: float, l2: float, l3: float, bend: float
) -> tuple[int, float, float]:
    """Joints 2 and 3 from a point of the finger's plane: (status, φ2, φ3), φ2 in (-π, π].

    The paper's 3.2.2 and 3.2.3 with the positive root: the other bends joint 3 backwards, further
    than any φ30 lets it. The sine comes as a product of differences: a cosine one unit in the last
    place above 1 is a stretched finger, not NaN. Beyond that, `UNREACHABLE`.
    """
    if not (isfinite(rho) and isfinite(z)):
        return NOT_FINITE, 0.0, 0.0
    away = rho - l1
    reach2 = away * away + z * z
    reach = sqrt(reach2)
    sine2 = ((l2 + l3) - reach) * ((l2 + l3) + reach) * (reach - (l2 - l3)) * (reach + (l2 - l3))
    if sine2 < -_RELATIVE * (2.0 * l2 * l3) ** 2:
        return UNREACHABLE, 0.0, 0.0
    sine = sqrt(max(sine2, 0.0))
    inner = atan2(sine, reach2 - l2 * l2 - l3 * l3)
    phi2 = atan2(z, away) - atan2(l3 * sin(inner), l2 + l3 * cos(inner))
    if phi2 <= -pi:
        phi2 += 2.0 * pi
    elif phi2 > pi:
        phi2 -= 2.0 * pi
    return OK, phi2, inner - bend


def forward(geometry: HandGeometry, joints: ArrayLike) -> FloatArray:
    """Grasp point in the finger's frame [m], shape (3,), of joints (φ1, φ2, φ3) [rad], shape (3,).

    Any angles are answered; `inverse` refuses those beyond the limits.

    Raises:
        NumericalError: if the shape is another one, or an angle is not finite.
    """
    return np.array(forward_kernel(*frozen(joints, (3,), "joints").tolist(), *geometry.links))


def jacobian(geometry: HandGeometry, joints: ArrayLike) -> FloatArray:
    """Jacobian dp/d(φ1, φ2, φ3) [m/rad] in the finger's frame, shape (3, 3).

    Regular but on the spread axis (ρ = 0), where φ1 moves nothing, and where the links are in line.

    Raises:
        NumericalError: as `forward`.
    """
    phi1, phi2, phi3 = frozen(joints, (3,), "joints").tolist()
    l1, l2, l3, bend = geometry.links
    tip = phi2 + phi3 + bend
    rho = l1 + l2 * cos(phi2) + l3 * cos(tip)
    rho3, z3 = -l3 * sin(tip), l3 * cos(tip)
    rho2, z2 = rho3 - l2 * sin(phi2), z3 + l2 * cos(phi2)
    c, s = cos(phi1), sin(phi1)
    return np.array(
        [[-rho * s, rho2 * c, rho3 * c], [rho * c, rho2 * s, rho3 * s], [0.0, z2, z3]],
    )


def inverse(
    geometry: HandGeometry,
    p_finger: ArrayLike,
    finger: HandFinger = HandFinger.ONE,
    phi1_now: float = 0.0,
) -> FingerPose:
    """Joints that bring the grasp point to `p_finger` [m], shape (3,), in the finger's frame.

    Of the two branches the first that answers, ρ ≥ 0 before ρ < 0.

    Args:
        geometry: lengths and limits.
        p_finger: the point.
        finger: which one; finger 3 has no spread, so that its point must lie in its plane.
        phi1_now: φ1 to keep where the point lies on the spread axis [rad].

    Raises:
        UnreachableError: if no branch answers; says of each why.
        NumericalError: if the shape is another one, or a coordinate is not finite.
    """
    found = branches(geometry, p_finger, finger, phi1_now)
    for pose in found:
        if not pose.refused:
            return pose
    x, y, z = (float(v) / MILLIMETRE for v in np.asarray(p_finger, np.float64))
    why = "; ".join(f"{pose.side}: {pose.refused}" for pose in found)
    raise UnreachableError(
        sentence(
            "finger {finger_name} does not reach ({x:.6g}, {y:.6g}, {z:.6g}) mm: {reason}",
            finger_name=finger.name.lower(),
            x=x,
            y=y,
            z=z,
            reason=why,
        )
    )


def branches(
    geometry: HandGeometry,
    p_finger: ArrayLike,
    finger: HandFinger = HandFinger.ONE,
    phi1_now: float = 0.0,
) -> tuple[FingerPose, FingerPose]:
    """Both branches of `inverse`, `OUTWARD` first, each with its answer or why it has none.

    Raises:
        NumericalError: as `inverse`.
    """
    x, y, z = frozen(p_finger, (3,), "p_finger").tolist()
    reach = hypot(x, y)
    return (
        _branch(geometry, (x, y, z), reach, FingerSide.OUTWARD, finger, phi1_now),
        _branch(geometry, (x, y, z), reach, FingerSide.OVER, finger, phi1_now),
    )


def driven(
    geometry: HandGeometry, motor: float, broken_at: float | None = None
) -> tuple[float, float]:
    """Joints (φ2, φ3) [rad] of a motor's angle [rad], both gears being worms on one pinion.

    In free motion φ2 = motor/125 and φ3 = motor/375. Joint 2, once held at the motor's angle
    `broken_at`, stands still, and the motor goes on bending joint 3, four times as fast.

    Raises:
        MechanismError: if the angle is not finite or negative, or joint 2 broke away later than it.
    """
    held = motor if broken_at is None else broken_at
    if not 0.0 <= held <= motor < inf:
        raise MechanismError(
            sentence(
                "the motor stands at {motor} rad and joint 2 broke away at {broken_at} rad;"
                " give 0 ≤ broken_at ≤ motor",
                motor=motor,
                broken_at=broken_at,
            )
        )
    phi2 = held / geometry.proximal_gear
    return phi2, motor / geometry.distal_gear - phi2


def coupled(geometry: HandGeometry, phi2: float, phi3: float) -> Coupling:
    """Return how the joints come to stand at φ2 and φ3 [rad]."""
    over = phi3 - geometry.coupling * phi2
    if abs(over) <= _ROUNDING:
        return Coupling.FREE
    return Coupling.BREAKAWAY if over > 0.0 else Coupling.NEVER


def _branch(
    geometry: HandGeometry,
    p: tuple[float, float, float],
    reach: float,
    side: FingerSide,
    finger: HandFinger,
    phi1_now: float,
) -> FingerPose:
    x, y, z = p
    any_spread = reach <= _ON_AXIS
    phi1, rho, beside = 0.0, x, abs(y)
    if finger.turn:
        sign = 1.0 if side is FingerSide.OUTWARD else -1.0
        rho, beside = sign * reach, 0.0
        phi1 = phi1_now if any_spread else atan2(sign * y, sign * x)
    refused = ""
    if beside > _IN_PLANE:
        refused = f"it has no spread, and the point lies {beside / MILLIMETRE:.3g} mm off its plane"
    elif (rho < 0.0) is not (side is FingerSide.OVER) and not (any_spread and finger.turn):
        refused = "the point is on the other side of the spread axis"
    status, phi2, phi3 = inverse_kernel(rho, z, *geometry.links)
    if status == NOT_FINITE:
        check(status, f"point {p} m")
    if not refused:
        refused = _beyond(geometry, status, phi2, phi3, hypot(rho - geometry.knuckle, z))
    if refused:
        return FingerPose(frozen(np.zeros(3)), side, Coupling.NEVER, 0.0, False, False, refused)
    spread = finger.turn * phi1 + 0.0  # never -0
    limits = -_ROUNDING <= spread <= geometry.most_spread + _ROUNDING
    joints = frozen([phi1, phi2, phi3])
    coupling = coupled(geometry, phi2, phi3)
    return FingerPose(joints, side, coupling, spread, not limits, any_spread)


def _beyond(geometry: HandGeometry, status: int, phi2: float, phi3: float, reach: float) -> str:
    if status == UNREACHABLE:
        near = abs(geometry.proximal - geometry.distal) / MILLIMETRE
        far = (geometry.proximal + geometry.distal) / MILLIMETRE
        return sentence(
            "it is {reach_mm:.4g} mm from joint 2, the links reach from {near:.4g} to {far:.4g} mm",
            reach_mm=reach / MILLIMETRE,
            near=near,
            far=far,
        )
    for name, angle, most in (
        ("φ2", phi2, geometry.most_proximal),
        ("φ3", phi3, geometry.most_distal),
    ):
        if not -_ROUNDING <= angle <= most + _ROUNDING:
            return sentence(
                "{name} would be {angle_deg:.4g}°, its limits are 0 and {most_deg:.4g}°",
                name=name,
                angle_deg=angle / DEGREE,
                most_deg=most / DEGREE,
            )
    return ""
