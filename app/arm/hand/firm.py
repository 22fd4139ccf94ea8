"""Firm grasp: a finger closes on something soft or stiff until it pushes with the force asked for.

The motor follows a commanded speed with a lag, and its worms cannot be driven back, so that the
contact does not slow it. The law is one line, in the air as in contact, once per period:

    speed = K (goal - force), within the motor's top speed

In the air the force is 0 and the finger comes at K goal; in contact the force is the integral of
the speed times stiffness and gear. K follows from the stiffest and most damped contact to be
expected: a double real pole of the sampled loop, so that the force does not overshoot, and softer
contacts only come more slowly. When joint 2 has let go of the motor (its torque reached the
breakaway's) the grasp point goes on with joint 3 alone, at another speed: K is for the faster.

The paper has this as its figure 5, which its text lacks.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, exp, inf, sin, sqrt
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.arm.hand.errors import GraspError
from app.arm.hand.finger import HandGeometry, forward
from app.core.arrays import FloatArray, cross, frozen, read_only, unit
from app.core.compiled import njit
from app.core.messages import sentence

FINE: Final = 10
"""Parts of a period at which the force is looked at."""

OVERSHOOT: Final = 0.01
"""Largest share of the goal by which the force passes it, with K as designed."""

_DAMPED: Final = 0.5  # share of the goal with which the most damped contact may begin
_HALVINGS: Final = 60
_BIG: Final = 1e300


@dataclass(frozen=True, slots=True)
class Lever:
    """How a motor moves a grasp point, and what the point's force does to joint 2.

    Attributes:
        free: travel of the point into the tool per angle of the motor, both joints turning [m/rad].
        alone: the same with joint 2 held and the distal link going on [m/rad].
        arm: torque at joint 2 per force [m].
        breakaway: torque at joint 2 that lets it go [N·m].

    Raises:
        GraspError: if closing would move the point away from the tool, or not at all.
    """

    free: float
    alone: float
    arm: float
    breakaway: float

    def __post_init__(self) -> None:
        if not (0.0 < self.free < inf and 0.0 < self.alone < inf):
            raise GraspError(
                sentence(
                    "closing moves the grasp point by {free:.4g} m/rad, with joint 2 held by"
                    " {alone:.4g} m/rad; both must be into the tool: choose another posture",
                    free=self.free,
                    alone=self.alone,
                )
            )

    @classmethod
    def of(
        cls,
        geometry: HandGeometry,
        joints: ArrayLike,
        normal_finger: ArrayLike,
        p_finger: ArrayLike | None = None,
    ) -> Lever:
        """Lever of a posture on a surface, for the millimetres of a press.

        Args:
            geometry: the hand.
            joints: (φ1, φ2, φ3) [rad], shape (3,).
            normal_finger: inward normal of the surface, in the finger's frame, shape (3,).
            p_finger: where the distal link touches [m], shape (3,); its grasp point if left out.

        Raises:
            GraspError: as above.
            NumericalError: if a number is not finite, or the normal has no direction.
        """
        phi1, phi2, phi3 = frozen(joints, (3,), "joints").tolist()
        along = np.array([cos(phi1), sin(phi1), 0.0])
        axis = np.array([sin(phi1), -cos(phi1), 0.0])  # of joints 2 and 3: bends away from the palm
        joint_2 = geometry.knuckle * along
        joint_3 = joint_2 + geometry.proximal * (
            cos(phi2) * along + np.array([0.0, 0.0, sin(phi2)])
        )
        touch = forward(geometry, (phi1, phi2, phi3)) if p_finger is None else p_finger
        point, normal = frozen(touch, (3,), "p_finger"), unit(frozen(normal_finger, (3,)))
        by2, by3 = (float(normal @ cross(axis, point - joint)) for joint in (joint_2, joint_3))
        free = (by2 + geometry.coupling * by3) / geometry.proximal_gear
        return cls(free, by3 / geometry.distal_gear, by2, geometry.breakaway)


@dataclass(frozen=True, slots=True)
class SoftContact:
    """A spring with a damper that only pushes: F = max(0, k s + b ds/dt) for s > 0.

    Attributes:
        stiffness: k [N/m].
        damping: b [N·s/m].
        gap: travel of the grasp point before it touches [m].

    Raises:
        GraspError: if the stiffness is not positive, or another value negative.
    """

    stiffness: float
    damping: float = 0.0
    gap: float = 0.0

    def __post_init__(self) -> None:
        for name, unit_name in (("stiffness", "N/m"), ("damping", "N·s/m"), ("gap", "m")):
            value = getattr(self, name)
            if not (0.0 <= value < inf and (value > 0.0 or name != "stiffness")):
                least = "more than 0" if name == "stiffness" else "0 or more"
                raise GraspError(
                    sentence(
                        "contact: {name} is {setting} {unit_name}; give {least}",
                        name=name,
                        setting=value,
                        unit_name=unit_name,
                        least=least,
                    )
                )


@dataclass(frozen=True, slots=True)
class FirmGrasp:
    """The force law of one finger.

    Attributes:
        goal: normal force [N].
        lever: of the posture.
        contact: the stiffest and most damped contact that K must suit.
        lag: of the motor's speed behind its command [s].
        period: of the law [s].
        top_speed: of the motor [rad/s].
        gain: K [rad/s per N]; None for the designed one.

    Raises:
        GraspError: if a value is not positive, or with this gain the contact oscillates ever more;
            names the largest gain that does not.
    """

    goal: float
    lever: Lever
    contact: SoftContact
    lag: float
    period: float
    top_speed: float
    gain: float | None = None

    def __post_init__(self) -> None:
        for name in ("goal", "lag", "period", "top_speed"):
            if not 0.0 < (value := getattr(self, name)) < inf:
                raise GraspError(
                    sentence(
                        "firm grasp: {name} is {setting}; give more than 0",
                        name=name,
                        setting=value,
                    )
                )
        if self.gain is not None and not 0.0 < self.gain < inf:
            raise GraspError(
                sentence("firm grasp: gain is {gain} rad/s per N; give more than 0", gain=self.gain)
            )
        self.check(self.contact)

    @property
    def used_gain(self) -> float:
        """K [rad/s per N]: the given one, or the designed."""
        return self.designed_gain if self.gain is None else self.gain

    @property
    def designed_gain(self) -> float:
        """K at which both poles of the sampled loop are one real pole; less for a damped contact.

        With K k g = κ the poles are those of z² - (1 + a - κ B) z + a + κ c; a = exp(-T/τ). What
        the damper adds within a period counts beside it: 1/K is the sum of both demands.
        """
        travel = max(self.lever.free, self.lever.alone)
        a, first, second = _held(self.period, self.lag)
        middle = 2.0 * (1.0 + a) * first + 4.0 * second
        root = sqrt(max(middle * middle - 4.0 * (first * (1.0 - a)) ** 2, 0.0))
        kappa = 2.0 * (1.0 - a) ** 2 / (middle + root)
        return 1.0 / (travel * (self.contact.stiffness / kappa + self.contact.damping / _DAMPED))

    def check(self, contact: SoftContact) -> None:
        """Refuse a contact with which the force would oscillate ever more.

        Raises:
            GraspError: names the largest gain that is stable.
        """
        travel = max(self.lever.free, self.lever.alone)
        most = stable_gain(contact, travel, self.lag, self.period)
        if not self.used_gain < most:
            raise GraspError(
                sentence(
                    "a gain of {used_gain:.4g} rad/s per N makes a contact of "
                    "{contact_stiffness:.4g} N/m and {contact_damping:.4g} N·s/m oscillate ever "
                    "more; give less than {most:.4g}, or leave it out",
                    used_gain=self.used_gain,
                    contact_stiffness=contact.stiffness,
                    contact_damping=contact.damping,
                    most=most,
                )
            )


@dataclass(frozen=True, slots=True, eq=False)
class Press:
    """What came of it, `FINE` rows per period.

    Attributes:
        times: [s], shape (n,).
        force: [N], shape (n,).
        travel: of the grasp point, from where it began [m], shape (n,).
        broken_at: when joint 2 let go [s]; None if it did not.
    """

    times: FloatArray
    force: FloatArray
    travel: FloatArray
    broken_at: float | None

    def overshoot(self, goal: float) -> float:
        """Largest force beyond the goal, as a share of it; 0 if it was never passed."""
        return max(float(self.force.max()) / goal - 1.0, 0.0)

    def settled(self, goal: float, share: float = 0.02) -> float:
        """Return when the force came within a share of the goal to stay [s].

        Raises:
            GraspError: if it had not at the end.
        """
        off = np.flatnonzero(np.abs(self.force - goal) > share * goal)
        if len(off) and off[-1] == len(self.force) - 1:
            raise GraspError(
                sentence(
                    "after {seconds:.3g} s the force is {force:.4g} N, not {goal:.4g}"
                    " N; give it more time, or a gain for a softer contact",
                    seconds=self.times[-1],
                    force=self.force[-1],
                    goal=goal,
                )
            )
        return float(self.times[off[-1] + 1]) if len(off) else float(self.times[0])


def press(law: FirmGrasp, contact: SoftContact, duration: float) -> Press:
    """Close on a contact for so long [s], from rest, the grasp point a gap away.

    Motor and point move exactly between two commands (the commanded speed is held), whatever the
    stiffness; the moment in which joint 2 lets go is found to rounding.

    Raises:
        GraspError: for a duration without one period or beyond 10⁶, or if the contact is too stiff
            for the law.
    """
    count = duration / law.period
    if not 1.0 <= count <= 1e6:
        raise GraspError(
            sentence(
                "a press of {duration} s has {count:.4g} periods of {law_period} s; give 1 to 1e6",
                duration=duration,
                count=count,
                law_period=law.period,
            )
        )
    law.check(contact)
    out = np.empty((round(count) * FINE, 3))
    lever = law.lever
    broken = press_kernel(
        (law.goal, law.used_gain, law.lag, law.period, law.top_speed),
        (lever.free, lever.alone, lever.arm, lever.breakaway),
        (contact.stiffness, contact.damping, contact.gap),
        out,
    )
    times, force, travel = (read_only(np.ascontiguousarray(column)) for column in out.T)
    return Press(times, force, travel, None if broken < 0.0 else broken)


def stable_gain(contact: SoftContact, travel: float, lag: float, period: float) -> float:
    """Gain [rad/s per N] at which the sampled loop begins to oscillate without end.

    By Jury's conditions for its two poles; `travel` is of the grasp point per angle [m/rad].
    """
    a, first, second = _held(period, lag)
    k, b = contact.stiffness * travel, contact.damping * travel
    # z² + (-(1 + a) + K (k B + b (1-a))) z + a + K (k c - b (1-a)); its limits in K, one by one.
    linear, constant = k * first + b * (1.0 - a), k * second - b * (1.0 - a)
    limits = [inf]
    if constant > 0.0:
        limits.append((1.0 - a) / constant)
    elif constant < 0.0:
        limits.append((1.0 + a) / -constant)
    if linear > constant:
        limits.append(2.0 * (1.0 + a) / (linear - constant))
    return min(limits)


@njit
def force_kernel(depth: float, speed: float, stiffness: float, damping: float) -> float:
    """Force of a contact that is pressed in so deep [m], at this speed [m/s]."""
    if depth <= 0.0:
        return 0.0
    return max(stiffness * depth + damping * speed, 0.0)


@njit
def moved_kernel(
    angle: float, speed: float, command: float, lag: float, t: float
) -> tuple[float, float]:
    """Motor after a time under a held command: (angle, speed)."""
    fade = exp(-t / lag)
    return angle + command * t + (speed - command) * lag * (1.0 - fade), command + fade * (
        speed - command
    )


@njit
def press_kernel(
    law: tuple[float, float, float, float, float],
    lever: tuple[float, float, float, float],
    contact: tuple[float, float, float],
    out: FloatArray,
) -> float:
    """Fill rows (time, force, travel) of `out`; return when joint 2 let go [s], or -1.

    Args:
        law: goal, gain, lag, period, top speed.
        lever: travel per angle free and alone, arm, breakaway torque.
        contact: stiffness, damping, gap.
        out: shape (n, 3).
    """
    goal, gain, lag, period, top = law
    free, alone, arm, breakaway = lever
    stiffness, damping, gap = contact
    limit = breakaway / arm if arm > 0.0 else _BIG  # force at which joint 2 lets go
    step = period / FINE
    angle, speed, travel, gear, broken = 0.0, 0.0, 0.0, free, -1.0
    command = 0.0
    for i in range(len(out)):
        if i % FINE == 0:
            force = force_kernel(travel - gap, gear * speed, stiffness, damping)
            command = min(max(gain * (goal - force), -top), top)
        on, fast = moved_kernel(angle, speed, command, lag, step)
        far = travel + gear * (on - angle)
        if broken < 0.0 and force_kernel(far - gap, gear * fast, stiffness, damping) >= limit:
            low, high = 0.0, step
            for _ in range(_HALVINGS):
                t = 0.5 * (low + high)
                here, now = moved_kernel(angle, speed, command, lag, t)
                depth = travel + gear * (here - angle) - gap
                if force_kernel(depth, gear * now, stiffness, damping) >= limit:
                    high = t
                else:
                    low = t
            broken = i * step + high
            here, now = moved_kernel(angle, speed, command, lag, high)
            far = travel + free * (here - angle) + alone * (on - here)
            gear = alone
        angle, speed, travel = on, fast, far
        out[i, 0] = (i + 1) * step
        out[i, 1] = force_kernel(travel - gap, gear * speed, stiffness, damping)
        out[i, 2] = travel
    return broken


def _held(period: float, lag: float) -> tuple[float, float, float]:
    """Coefficients of the sampled motor: a, B = T - τ (1 - a), and c = τ (1 - a)² - a B."""
    a = exp(-period / lag)
    first = period - lag * (1.0 - a)
    return a, first, lag * (1.0 - a) ** 2 - a * first
