"""The accounts of the passivity guard: what left the motors' port, and how much still may.

Places in the guard's parameters, and what is booked on them; `passivity` acts on them.
"""

from math import isfinite
from typing import Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.parameters import numbered


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
def start(p: FloatArray) -> None:
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
def hold(state: FloatArray, p: FloatArray) -> None:
    """Note the torques that were held over the last tick."""
    p[AT.ticks] += 1.0
    p[AT.held_left] = max(p[AT.held_left], abs(state[sv.SENT_LEFT]))
    p[AT.held_right] = max(p[AT.held_right], abs(state[sv.SENT_RIGHT]))


@njit
def reach(state: FloatArray, p: FloatArray, ticks: float) -> float:
    """Furthest that a joint can be seen to turn in some ticks [rad]."""
    return p[AT.fastest] * max(state[sv.DT], p[AT.period]) * ticks + p[AT.one_count]


@njit
def lose_track(state: FloatArray, p: FloatArray) -> None:
    """Charge the most that the held torques can have done, where no motion is known."""
    most = (p[AT.held_left] + p[AT.held_right]) * reach(state, p, p[AT.ticks] + p[AT.old])
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
def observe(state: FloatArray, p: FloatArray) -> None:
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
        lose_track(state, p)
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
