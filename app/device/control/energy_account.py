"""The accounts of the passivity guard: what left the motors' port, and how much still may.

Slots of the guard's parameters, and what is booked on them; `passivity` acts on them.
"""

from math import isfinite

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit

BOUND, FASTEST, COUNT, PERIOD, CREDIT, FADE_FROM, FADE_TO, FORGET, DAMPING = range(9)
LEFT, RIGHT, TIME, KNOWN = range(9, 13)  # the newest reading, and whether there is one
HELD_LEFT, HELD_RIGHT, TICKS = range(13, 16)  # largest torques sent since, and for how long
STORED, SHARE = range(16, 18)  # potential then; share of the laws' force that was let through
ASKED_LEFT, ASKED_RIGHT, BRAKE_LEFT, BRAKE_RIGHT = range(18, 22)
CUT_LEFT, CUT_RIGHT = range(22, 24)
TANK, BALANCE, OUT, LOSS = range(24, 28)  # BALANCE: of the observer's account
FRICTION = 28  # let out in the newest tick for the joints' friction to take
COULOMB, VISCOUS = range(29, 31)
OLD = 31  # ticks by which the newest reading is older than its tick: about one on a wire
BEFORE_LEFT, BEFORE_RIGHT, SIZE = range(32, 35)  # torques sent in the tick before the last
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
    turn_left, turn_right = left - p[LEFT], right - p[RIGHT]
    if p[TICKS] <= 1.0 and p[OLD] == 0.0:
        return sent_left * turn_left + sent_right * turn_right
    if p[TICKS] <= 1.0 and p[OLD] <= _A_TICK:
        before = max(sent_left * turn_left, p[BEFORE_LEFT] * turn_left)
        return before + max(sent_right * turn_right, p[BEFORE_RIGHT] * turn_right)
    return p[HELD_LEFT] * abs(turn_left) + p[HELD_RIGHT] * abs(turn_right)


@njit
def start(p: FloatArray) -> None:
    """Begin anew with a full tank, at zero force."""
    p[TANK], p[BALANCE], p[OUT], p[LOSS] = p[BOUND], 0.0, 0.0, 0.0


@njit
def friction_takes(p: FloatArray, turn_left: float, turn_right: float, step: float) -> float:
    """Energy that the joints' own friction takes [J] over turns of `step` s, by the profile."""
    square = turn_left * turn_left + turn_right * turn_right
    return p[COULOMB] * (abs(turn_left) + abs(turn_right)) + p[VISCOUS] * square / step


@njit
def _charge(state: FloatArray, p: FloatArray, work: float, share: float, taken: float) -> None:
    """Pay `work` from the tank, and what of it no potential explains from the account.

    Not what was let out for the joints' friction, of which they can have `taken` so much.
    """
    p[OUT] += work
    work -= min(max(work, 0.0), max(min(share * p[SHARE] * p[FRICTION], taken), 0.0))
    p[TANK] = min(p[BOUND], p[TANK] - work)
    released = p[STORED] - (state[sv.POTENTIAL] - state[sv.GAIN_WORK])
    made = work - share * p[SHARE] * released
    if isfinite(made):
        p[BALANCE] = min(p[CREDIT], max(p[BALANCE] - made, -p[FADE_TO]))


@njit
def hold(state: FloatArray, p: FloatArray) -> None:
    """Note the torques that were held over the last tick."""
    p[TICKS] += 1.0
    p[HELD_LEFT] = max(p[HELD_LEFT], abs(state[sv.SENT_LEFT]))
    p[HELD_RIGHT] = max(p[HELD_RIGHT], abs(state[sv.SENT_RIGHT]))


@njit
def reach(state: FloatArray, p: FloatArray, ticks: float) -> float:
    """Furthest that a joint can be seen to turn in some ticks [rad]."""
    return p[FASTEST] * max(state[sv.DT], p[PERIOD]) * ticks + p[COUNT]


@njit
def lose_track(state: FloatArray, p: FloatArray) -> None:
    """Charge the most that the held torques can have done, where no motion is known."""
    most = (p[HELD_LEFT] + p[HELD_RIGHT]) * reach(state, p, p[TICKS] + p[OLD])
    p[OUT] += most
    p[TANK] -= most
    p[HELD_LEFT] = p[HELD_RIGHT] = p[TICKS] = p[KNOWN] = 0.0


@njit
def _hold_on(state: FloatArray, p: FloatArray) -> None:
    """After a reading: what was sent since it was taken has done work that nobody has seen yet."""
    p[TICKS] = 0.0
    keeps = _KEEPS if p[OLD] > _A_TICK else 0.0
    unseen = 1.0 if p[OLD] > 0.0 else 0.0
    p[HELD_LEFT] = max(unseen * abs(state[sv.SENT_LEFT]), keeps * p[HELD_LEFT])
    p[HELD_RIGHT] = max(unseen * abs(state[sv.SENT_RIGHT]), keeps * p[HELD_RIGHT])


@njit
def observe(state: FloatArray, p: FloatArray) -> None:
    """Account for what the torques have done since the newest reading."""
    left, right = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    if p[KNOWN] != 0.0 and state[sv.Q_TIME] == p[TIME]:
        return
    turn_left, turn_right = left - p[LEFT], right - p[RIGHT]
    age = (state[sv.TIME] - state[sv.Q_TIME]) / max(state[sv.DT], p[PERIOD])
    p[OLD] = max(p[OLD], age) if age > 0.5 else p[OLD]
    if p[KNOWN] != 0.0 and abs(turn_left) < _JUMP and abs(turn_right) < _JUMP:
        sent_left, sent_right = state[sv.SENT_LEFT], state[sv.SENT_RIGHT]
        share = _sent_share(p, sent_left, sent_right)
        taken = friction_takes(p, turn_left, turn_right, max(state[sv.DT], p[PERIOD]))
        _charge(state, p, port_work(p, left, right, sent_left, sent_right), share, taken)
        p[LOSS] -= share * (p[BRAKE_LEFT] * turn_left + p[BRAKE_RIGHT] * turn_right)
        p[LOSS] += max(p[CUT_LEFT] * turn_left + p[CUT_RIGHT] * turn_right, 0.0)
    else:
        lose_track(state, p)
    p[STORED] = state[sv.POTENTIAL]
    given = state[sv.FRICTION_WORK]
    p[FRICTION] = given if given > 0.0 and isfinite(given) else 0.0
    p[LEFT], p[RIGHT], p[TIME], p[KNOWN] = left, right, state[sv.Q_TIME], 1.0
    p[OLD] = age if age > 0.5 else 0.0
    _hold_on(state, p)


@njit
def _sent_share(p: FloatArray, sent_left: float, sent_right: float) -> float:
    """Share of the torques asked of safety that it let through, 0...1."""
    asked = p[ASKED_LEFT] * p[ASKED_LEFT] + p[ASKED_RIGHT] * p[ASKED_RIGHT]
    if not asked > 0.0:
        return 0.0
    along = sent_left * p[ASKED_LEFT] + sent_right * p[ASKED_RIGHT]
    return min(max(along / asked, 0.0), 1.0)
