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
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import Stage, numbered, packed
from app.device.control.law_kernels import STOP_GIVES, longest_lever
from app.device.control.vectors import snapped
from app.device.errors import DeviceError
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.status import OK


class Places(NamedTuple):
    """Constants of `PassivityGuard`, and the accounts."""

    bound: int
    fastest: int
    one_count: int
    period: int
    credit: int
    fade_from: int
    fade_to: int
    forget: int
    damping: int
    coulomb: int
    viscous: int
    left: int = 0  # the newest reading, and whether there is one
    right: int = 0
    time: int = 0
    known: int = 0
    held_left: int = 0  # largest torques sent since, and for how long
    held_right: int = 0
    ticks: int = 0
    stored: int = 0  # potential then; share of the laws' force that was let through
    share: int = 0
    asked_left: int = 0
    asked_right: int = 0
    brake_left: int = 0
    brake_right: int = 0
    cut_left: int = 0
    cut_right: int = 0
    tank: int = 0  # balance: of the observer's account
    balance: int = 0
    out: int = 0
    loss: int = 0
    friction: int = 0  # let out in the newest tick for the joints' friction to take
    old: int = 0  # ticks by which the newest reading is older than its tick: about one on a wire
    before_left: int = 0  # torques sent in the tick before the last
    before_right: int = 0


AT: Final = numbered(Places)


def carry_accounts(old: FloatArray, new: FloatArray) -> None:
    """Keep readings and accounts in a guard of another bound; its tank holds no more than that."""
    for name in Places._field_defaults:
        place = getattr(AT, name)
        new[place] = old[place]
    new[AT.tank] = min(new[AT.tank], new[AT.bound])


_KEEPS = 0.98  # of the largest torque, per reading that is many ticks old
_JUMP = 0.5  # [rad] between two readings: no motion
_A_TICK = 1.5  # ticks: an ordinary age on a wire


@njit
def port_work(
    p: FloatArray, left: float, right: float, sent_left: float, sent_right: float
) -> float:
    """Work that left the port since the newest reading [J], for readings (left, right) now.

    Exact when there was one tick since, and the reading is of now. One that came over a wire was
    taken about a tick ago, under this torque or the one before: each joint's work is the larger of
    the two. Over more ticks, with readings missing or late, no more is known than the largest
    torques: the work is taken as the most it can have been.
    """
    turn_left, turn_right = left - p[AT.left], right - p[AT.right]
    if p[AT.ticks] <= 1.0 and p[AT.old] == 0.0:
        return sent_left * turn_left + sent_right * turn_right
    if p[AT.ticks] <= 1.0 and p[AT.old] <= _A_TICK:
        before = max(sent_left * turn_left, p[AT.before_left] * turn_left)
        return before + max(sent_right * turn_right, p[AT.before_right] * turn_right)
    return p[AT.held_left] * abs(turn_left) + p[AT.held_right] * abs(turn_right)


@njit
def _start(p: FloatArray) -> None:
    """Begin anew with a full tank, at zero force."""
    p[AT.tank], p[AT.balance], p[AT.out], p[AT.loss] = p[AT.bound], 0.0, 0.0, 0.0


@njit
def friction_takes(p: FloatArray, turn_left: float, turn_right: float, step: float) -> float:
    """Energy that the joints' own friction takes [J] over turns of `step` s, by the profile."""
    square = turn_left * turn_left + turn_right * turn_right
    return p[AT.coulomb] * (abs(turn_left) + abs(turn_right)) + p[AT.viscous] * square / step


@njit
def _charge(state: FloatArray, p: FloatArray, work: float, share: float, taken: float) -> None:
    """Pay `work` from the tank, and what of it no potential explains from the account.

    Not what was let out for the joints' friction, of which they can have `taken` so much.
    """
    p[AT.out] += work
    work -= min(max(work, 0.0), max(min(share * p[AT.share] * p[AT.friction], taken), 0.0))
    p[AT.tank] = min(p[AT.bound], p[AT.tank] - work)
    released = p[AT.stored] - (state[sv.POTENTIAL] - state[sv.GAIN_WORK])
    made = work - share * p[AT.share] * released
    if isfinite(made):
        p[AT.balance] = min(p[AT.credit], max(p[AT.balance] - made, -p[AT.fade_to]))


@njit
def _hold(state: FloatArray, p: FloatArray) -> None:
    """Note the torques that were held over the last tick."""
    p[AT.ticks] += 1.0
    p[AT.held_left] = max(p[AT.held_left], abs(state[sv.SENT_LEFT]))
    p[AT.held_right] = max(p[AT.held_right], abs(state[sv.SENT_RIGHT]))


@njit
def _reach(state: FloatArray, p: FloatArray, ticks: float) -> float:
    """Furthest that a joint can be seen to turn in some ticks [rad]."""
    return p[AT.fastest] * max(state[sv.DT], p[AT.period]) * ticks + p[AT.one_count]


@njit
def _lose_track(state: FloatArray, p: FloatArray) -> None:
    """Charge the most that the held torques can have done, where no motion is known."""
    most = (p[AT.held_left] + p[AT.held_right]) * _reach(state, p, p[AT.ticks] + p[AT.old])
    p[AT.out] += most
    p[AT.tank] -= most
    p[AT.held_left] = p[AT.held_right] = p[AT.ticks] = p[AT.known] = 0.0


@njit
def _hold_on(state: FloatArray, p: FloatArray) -> None:
    """After a reading: what was sent since it was taken has done work that nobody has seen yet."""
    p[AT.ticks] = 0.0
    keeps = _KEEPS if p[AT.old] > _A_TICK else 0.0
    unseen = 1.0 if p[AT.old] > 0.0 else 0.0
    p[AT.held_left] = max(unseen * abs(state[sv.SENT_LEFT]), keeps * p[AT.held_left])
    p[AT.held_right] = max(unseen * abs(state[sv.SENT_RIGHT]), keeps * p[AT.held_right])


@njit
def _observe(state: FloatArray, p: FloatArray) -> None:
    """Account for what the torques have done since the newest reading."""
    left, right = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    if p[AT.known] != 0.0 and state[sv.Q_TIME] == p[AT.time]:
        return
    turn_left, turn_right = left - p[AT.left], right - p[AT.right]
    age = (state[sv.TIME] - state[sv.Q_TIME]) / max(state[sv.DT], p[AT.period])
    p[AT.old] = max(p[AT.old], age) if age > 0.5 else p[AT.old]
    if p[AT.known] != 0.0 and abs(turn_left) < _JUMP and abs(turn_right) < _JUMP:
        sent_left, sent_right = state[sv.SENT_LEFT], state[sv.SENT_RIGHT]
        share = _sent_share(p, sent_left, sent_right)
        taken = friction_takes(p, turn_left, turn_right, max(state[sv.DT], p[AT.period]))
        _charge(state, p, port_work(p, left, right, sent_left, sent_right), share, taken)
        p[AT.loss] -= share * (p[AT.brake_left] * turn_left + p[AT.brake_right] * turn_right)
        p[AT.loss] += max(p[AT.cut_left] * turn_left + p[AT.cut_right] * turn_right, 0.0)
    else:
        _lose_track(state, p)
    p[AT.stored] = state[sv.POTENTIAL]
    given = state[sv.FRICTION_WORK]
    p[AT.friction] = given if given > 0.0 and isfinite(given) else 0.0
    p[AT.left], p[AT.right], p[AT.time], p[AT.known] = left, right, state[sv.Q_TIME], 1.0
    p[AT.old] = age if age > 0.5 else 0.0
    _hold_on(state, p)


@njit
def _sent_share(p: FloatArray, sent_left: float, sent_right: float) -> float:
    """Share of the torques asked of safety that it let through, 0...1."""
    asked = p[AT.asked_left] * p[AT.asked_left] + p[AT.asked_right] * p[AT.asked_right]
    if not asked > 0.0:
        return 0.0
    along = sent_left * p[AT.asked_left] + sent_right * p[AT.asked_right]
    return min(max(along / asked, 0.0), 1.0)


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
    reach = _reach(state, p, p[AT.ticks] + p[AT.old] + 1.0)
    room = max(p[AT.tank] - (p[AT.held_left] + p[AT.held_right]) * reach, 0.0)
    most = (abs(left) + abs(right)) * reach
    return room / most if most > room else 1.0


@stage
def guard_stage(state: FloatArray, p: FloatArray) -> None:
    """Account for the energy that left, and scale and damp TORQUE_* accordingly."""
    left, right = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    _hold(state, p)
    scale = 1.0
    if state[sv.KINEMATICS] == OK:
        _observe(state, p)
    else:
        _lose_track(state, p)
    p[AT.before_left], p[AT.before_right] = state[sv.SENT_LEFT], state[sv.SENT_RIGHT]
    if not state[sv.ENABLED] > 0.5:
        _start(p)
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
        workspace. The damping is a tenth of what stops a joint alone within a tick.
        """
        widest = 2.0 * (profile.tilt_limit + STOP_GIVES)
        most = profile.limits.hand_force * longest_lever(profile) * widest
        return cls(
            bound=min(energy_bound, most),
            fastest=20.0,
            count=2.0 * pi / profile.encoder.counts_per_turn,
            period=1.0 / profile.rate_hz,
            damping=0.1 * profile.joint_inertia * profile.rate_hz,
            friction=(profile.friction.coulomb, profile.friction.viscous),
        )

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own.

        Raises:
            DeviceError: if the bound is no finite number of 0 or more.
        """
        if not 0.0 <= self.bound < np.inf:
            raise DeviceError(
                sentence(
                    "the declared energy is {bound} J; give a finite number of 0 or more",
                    bound=self.bound,
                )
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
        return Stage("guard", guard_stage, parameters)
