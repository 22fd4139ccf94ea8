"""The passivity guard: no more energy leaves the motors' port than was declared to be stored.

The port is the joints as the encoders see them: torques are held over a tick, so the work that left
in it is exactly w = τ_sent · Δq. Two accounts of it:

- The *tank*, a guarantee. It starts at the declared bound when forces are armed, pays w, never
  holds more than the bound, and torques are scaled so that even the fastest motion of the next tick
  cannot overdraw it. So in any interval while armed at most the bound leaves the port, whatever
  laws, effects, dial, delays and hand do. A change of gain can only spend what is in the tank.
- The *account* of the observer. Law and effects say what they store (POTENTIAL) and what changes of
  gain added to it (GAIN_WORK). What leaves beyond the drop of the potential at unchanged gain, in
  the share in which the force was sent, was made by sampling, delay or an active effect, and is
  charged; what the laws dissipate is credited, up to a small `credit`, so that old credit never
  pays for late action. Overdrawn, the controller adds damping to get it back, of at most the
  profile's joint inertia over a few ticks, which is itself stable when sampled; beyond `fade_from`
  it fades the force as well. A debt is forgotten over `forget`.

What a law lets out for the joints' own friction to take (FRICTION_WORK) is charged to neither: it
never reaches the hand. No more of it, though, than the profile's friction takes over the motion.

Time-domain passivity: Hannaford and Ryu 2002; energy tanks: Franken et al. 2011.
"""

from dataclasses import dataclass
from math import isfinite, pi
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import packed
from app.device.control import energy_account as account
from app.device.control.energy_account import AT
from app.device.control.law_kernels import STOP_GIVES, longest_lever
from app.device.control.vectors import snapped
from app.device.errors import DeviceError
from app.mechanisms.pantograph.status import OK
from app.mechanisms.profile import DeviceProfile


@njit
def damping_for(debt: float, speed2: float, step: float, most: float) -> float:
    """Damping [N·m·s/rad] that takes `debt` [J] out within a tick of `step` [s], at most `most`.

    Args:
        debt: energy to get back; none for 0 or less.
        speed2: square of the joint speeds [rad²/s²].
        step: length of the tick.
        most: largest damping.
    """
    if not debt > 0.0:
        return 0.0
    takes = speed2 * step
    return min(debt / takes, most) if takes * most > debt else most


@njit
def _brake(state: FloatArray, p: FloatArray) -> None:
    """Set the controller's damping torques for the debt of the account."""
    v1, v2 = state[sv.QD_LEFT], state[sv.QD_RIGHT]
    p[AT.brake_left] = p[AT.brake_right] = 0.0
    state[sv.GUARD_DAMPING] = 0.0
    if isfinite(v1 + v2):
        step = max(state[sv.DT], p[AT.period])
        b = damping_for(-p[AT.balance], v1 * v1 + v2 * v2, step, p[AT.damping])
        state[sv.GUARD_DAMPING] = b
        p[AT.brake_left], p[AT.brake_right] = snapped(-b * v1), snapped(-b * v2)


@njit
def _fade(state: FloatArray, p: FloatArray) -> float:
    """Factor on the force for a large debt; a debt is forgotten slowly."""
    if p[AT.balance] < 0.0:
        p[AT.balance] = snapped(p[AT.balance] * (1.0 - min(state[sv.DT] / p[AT.forget], 1.0)))
    debt = -p[AT.balance] - p[AT.fade_from]
    return 1.0 - min(max(debt / (p[AT.fade_to] - p[AT.fade_from]), 0.0), 1.0)


@njit
def _affordable(state: FloatArray, p: FloatArray, left: float, right: float) -> float:
    """Factor in [0, 1] with which the next tick cannot overdraw the tank."""
    reach = account.reach(state, p, p[AT.ticks] + p[AT.old] + 1.0)
    room = max(p[AT.tank] - (p[AT.held_left] + p[AT.held_right]) * reach, 0.0)
    most = (abs(left) + abs(right)) * reach
    return room / most if most > room else 1.0


@stage
def guard_stage(state: FloatArray, p: FloatArray) -> None:
    """Account for the energy that left, and scale and damp TORQUE_* accordingly."""
    left, right = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    account.hold(state, p)
    scale = 1.0
    if state[sv.KINEMATICS] == OK:
        account.observe(state, p)
    else:
        account.lose_track(state, p)
    p[AT.before_left], p[AT.before_right] = state[sv.SENT_LEFT], state[sv.SENT_RIGHT]
    if not state[sv.ENABLED] > 0.5:
        account.start(p)
    if state[sv.KINEMATICS] == OK and isfinite(left + right):  # else safety holds it at zero
        _brake(state, p)
        fade = _fade(state, p)
        braked_left, braked_right = (
            fade * left + p[AT.brake_left],
            fade * right + p[AT.brake_right],
        )
        afford = _affordable(state, p, braked_left, braked_right)
        scale = fade * afford
        p[AT.brake_left], p[AT.brake_right] = (
            afford * p[AT.brake_left],
            afford * p[AT.brake_right],
        )
        p[AT.cut_left], p[AT.cut_right] = (1.0 - scale) * left, (1.0 - scale) * right
        left, right = afford * braked_left, afford * braked_right
        p[AT.asked_left], p[AT.asked_right] = left, right
        state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = left, right
    p[AT.share] = state[sv.LIMIT_SCALE] * state[sv.LET_GO_SCALE] * scale
    state[sv.GUARD_SCALE] = scale
    state[sv.ENERGY_OUT], state[sv.ENERGY_TANK] = p[AT.out], p[AT.tank]
    state[sv.ENERGY_BOUND], state[sv.GUARD_LOSS] = p[AT.bound], p[AT.loss]


@dataclass(frozen=True, slots=True)
class PassivityGuard:
    """Bounds the energy that leaves the motors' port; see the module.

    Attributes:
        bound: declared stored energy of all laws and effects, the tank's size [J].
        fastest: joint speed that the guarantee holds up to [rad/s].
        count: one encoder count at the joint [rad].
        period: of the loop [s]; a tick is never taken for shorter.
        damping: most that the controller adds [N·m·s/rad].
        friction: Coulomb and viscous, of each joint [N·m, N·m·s/rad].
        credit: largest credit of the account [J].
        fade_from, fade_to: debt over which the force fades to zero [J].
        forget: time over which a debt is forgotten [s].
    """

    bound: float
    fastest: float
    count: float
    period: float
    damping: float
    friction: tuple[float, float] = (0.0, 0.0)
    credit: float = 5e-4
    fade_from: float = 5e-3
    fade_to: float = 20e-3
    forget: float = 1.0

    @classmethod
    def of(cls, profile: DeviceProfile, energy_bound: float) -> "PassivityGuard":
        """Guard of a device for what laws and effects declare to store together [J].

        No more can be in it than the largest force at the hand times the longest way across the
        workspace. The damping is a tenth of what stops the driven link within a tick.
        """
        widest = 2.0 * (profile.tilt_limit + STOP_GIVES)
        most = profile.limits.hand_force * longest_lever(profile) * widest
        return cls(
            bound=min(energy_bound, most),
            fastest=20.0,
            count=2.0 * pi / profile.encoder.counts_per_turn,
            period=1.0 / profile.rate_hz,
            damping=0.1 * profile.lumped_inertia.driven * profile.rate_hz,
            friction=(profile.friction.coulomb, profile.friction.viscous),
        )

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table, with memory of its own.

        Raises:
            DeviceError: if the bound is no finite number of 0 or more.
        """
        if not 0.0 <= self.bound < np.inf:
            raise DeviceError(
                f"the declared energy is {self.bound} J; give a finite number of 0 or more"
            )
        coulomb, viscous = self.friction
        parameters = packed(
            AT,
            bound=self.bound,
            fastest=self.fastest,
            one_count=self.count,
            period=self.period,
            credit=self.credit,
            fade_from=self.fade_from,
            fade_to=self.fade_to,
            forget=self.forget,
            damping=self.damping,
            tank=self.bound,
            coulomb=coulomb,
            viscous=viscous,
        )
        return "guard", guard_stage, parameters
