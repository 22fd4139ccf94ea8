"""The speed governor: a needle that is let go gets neither fast nor energetic.

The profile says how far (`limits.let_go`): the program's forces may give the free mechanism at most
so much kinetic energy and its hub at most such a speed, for inertias that are 0.7 to 1.3 times the
profile's and for every depth that is possible. In the needle's turning |ḋ| (`speed_bounds` has the
mechanics) both are one limit at each pose,

    w_limit = 0.94 min(speed / L_out, √(2 energy / (1.3 Θ))),

L_out the longest possible, Θ the greatest inertia against the turning that these torques cause. The
6 % are room for what changes within a tick and along the way: pose, direction of the force,
Coriolis terms, gravity.

A robot as light as this one passes the limit within milliseconds of being let go, sooner than its
encoders tell. So the governor does not wait for a speed: it bounds the one that the needle *can*
have. Over a window of t s that ends now, the encoders have seen a turning Δ, true to one count δ,
and the torques sent in it can have added a(t'); then the turning rate now is at most

    w <= [|Δ| + δ + ∫ a(t') (t' - t_start) dt'] / t      for every t,

and the torque is scaled so that even one more tick of acceleration stays below the limit. |Δ|
counts where it goes with the force, along any constraint; motion against the force counts as what
it is, negative. For a needle at rest that is let go under a constant force the bound is √(2 δ a):
the rate at the end of a count, which nothing that reads this encoder can know better.

A hand at rest, or moving at up to `hand`, must not make the force flicker: with 2 δ for a travel
of one count more than there was, the bound stays below the limit as long as

    hand + 2 √(δ a) + a T <= w_limit,

T the tick and the age of the reading. The force is capped, by pose, to the acceleration that
satisfies this with equality: more could not be told in time, less would waste what can.

The energy given until letting go is noticed needs no second watch: from rest it is all kinetic, so
it is under its limit as long as w is, whenever that is. (|Δ| - δ) / t is the lowest rate that the
encoders prove. Above `run_away`, or 0.6 of the limit, for some milliseconds, along a force that
could have caused it, means that nobody holds the needle: LET_GO. See docs/decisions/0014.
"""

from dataclasses import dataclass
from math import isfinite, pi, sqrt
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.device.control.depth_interval import longest_lever, shortest_lever
from app.device.control.kinematics import MODEL
from app.device.control.speed_bounds import (
    BODY,
    HEAVIEST,
    LIGHTEST,
    Turning,
    speed_bounds,
    stoppable,
    turning,
)
from app.device.control.vectors import snapped
from app.device.state import Limiter
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.status import OK

# Compiled code takes plain integers as constants.
_BY_HAND, _BY_TORQUE = int(Limiter.HAND), int(Limiter.TORQUE)
_BY_LETTING_GO, _BY_DEPTH = int(Limiter.LETTING_GO), int(Limiter.DEPTH)

_SHORTEST = 1e-4  # [s] of a tick
_BEYOND = 1.2  # times the speed that the force can have caused: a hand
_HAND_STAYS = 0.2  # [s] for which a hand that was seen is taken to hold on
_JUMP = 0.5  # [rad] between two readings: no motion, a fresh start
_PEAK_LASTS = 0.1  # [s] over which the largest push of late is forgotten
_NOTHING = 1e-100  # [rad/s²] far below all that counts, far above subnormal numbers
_WINDOW = 24


class _GovernorPlaces(NamedTuple):
    """What the governor is told, see `SpeedGovernor`, and what it remembers."""

    resolution: int
    speed: int
    energy: int
    margin: int
    hand: int
    run_away: int
    patience: int
    cause: int
    hand_force: int
    joint_torque: int
    governed: int = 0
    acceleration: int = 0
    caused: int = 0
    running: int = 0
    hand_seen: int = 0
    samples: int = 0
    head: int = 0
    peak: int = 0


_AT: Final = numbered(_GovernorPlaces, len(BODY))
_RING = len(BODY) + len(_AT)  # rows of (q_left, q_right, time, largest acceleration sent after it)
_SLOWEST_HAND = 3.0  # the speed left for a hand is at most a third of the limit
_SURELY_RUNS = 0.6  # of the limit: what the encoders must prove at most before LET_GO


@njit
def _age(state: FloatArray) -> float:
    """Age of the newest reading [s]: on a wire about a tick."""
    return max(state[sv.TIME] - state[sv.Q_TIME], 0.0)


@njit
def _remember(state: FloatArray, p: FloatArray) -> None:
    """Note what was sent since the newest reading, and the reading if there is a newer one."""
    head = int(p[_AT.head])
    sent = max(abs(state[sv.SENT_LEFT]), abs(state[sv.SENT_RIGHT]))
    pushed = sent / p[_AT.governed] * p[_AT.acceleration] if p[_AT.governed] > 0.0 else 0.0
    p[_AT.caused] = snapped(p[_AT.caused] + (pushed - p[_AT.caused] / p[_AT.cause]) * state[sv.DT])
    p[_AT.peak] = max(pushed, p[_AT.peak] * (1.0 - min(state[sv.DT] / _PEAK_LASTS, 1.0)))
    if p[_AT.peak] < _NOTHING:
        p[_AT.peak] = 0.0
    row = _RING + 4 * head
    p[row + 3] = max(p[row + 3], pushed)
    if p[_AT.samples] > 0.0:
        if state[sv.Q_TIME] == p[row + 2]:
            return
        left, right = abs(state[sv.Q_LEFT] - p[row]), abs(state[sv.Q_RIGHT] - p[row + 1])
        if not (left < _JUMP and right < _JUMP and state[sv.Q_TIME] > p[row + 2]):
            p[_AT.samples] = 0.0
        head = (head + 1) % _WINDOW
        row = _RING + 4 * head
    p[_AT.head] = head
    p[_AT.samples] = min(p[_AT.samples] + 1.0, _WINDOW)
    p[row], p[row + 1] = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    # What was sent before it came acts after it, if it was read before now.
    p[row + 2], p[row + 3] = state[sv.Q_TIME], p[_AT.peak] if _age(state) > 0.0 else 0.0


@njit
def _watch(state: FloatArray, p: FloatArray, rate: float, proof: float, hand: float) -> None:
    """Set LET_GO once the needle has run, as the force alone can have made it run, for long enough.

    A rate beyond what was pushed proves a hand that moves the needle, or a blow; one beyond `proof`
    that nobody holds it.
    """
    step = max(state[sv.DT], 0.0)
    p[_AT.hand_seen] = max(p[_AT.hand_seen] - step, 0.0)
    if rate > _BEYOND * p[_AT.caused] + hand:
        p[_AT.hand_seen] = _HAND_STAYS
    running = rate > proof and p[_AT.hand_seen] == 0.0
    p[_AT.running] = p[_AT.running] + step if running else 0.0
    if p[_AT.running] >= p[_AT.patience]:
        state[sv.LET_GO] = 1.0


@njit
def _let_nothing_pass(state: FloatArray, p: FloatArray) -> None:
    """Zero torque; a fresh start of the windows afterwards."""
    p[_AT.samples] = p[_AT.governed] = p[_AT.running] = 0.0
    state[sv.LET_GO_SCALE] = state[sv.TORQUE_LEFT] = state[sv.TORQUE_RIGHT] = 0.0


@njit
def _tell_the_limit(
    state: FloatArray, p: FloatArray, left: float, right: float, what: Turning, most: float
) -> None:
    """Write GUIDANCE_LIMIT along the force that is wanted, where there is none in the worst
    direction; `most`: largest acceleration of the turning that can be stopped [rad/s²].

    Where no depth is measured it is the force at the longest lever that the needle can have.
    """
    size, _, _, ll, lr, rr, least, _ = what
    l_out = longest_lever(state) if state[sv.DEPTH_SOURCE] == MODEL else state[sv.L_OUT]
    if size > 0.0:
        square = rr * left * left - 2.0 * lr * left * right + ll * right * right
        force = sqrt(max(square / (ll * rr - lr * lr), 0.0)) / l_out
        by_torque = p[_AT.joint_torque] / max(abs(left), abs(right)) * force
        by_letting_go = most / size * force
    else:
        by_torque = p[_AT.joint_torque] / (l_out * sqrt(max(ll, rr)))
        by_letting_go = most * least * LIGHTEST / l_out
    limit, by = p[_AT.hand_force], _BY_HAND
    by_depth = limit * shortest_lever(state) / l_out
    if by_depth < limit:
        limit, by = by_depth, _BY_DEPTH
    if by_torque < limit:
        limit, by = by_torque, _BY_TORQUE
    if by_letting_go < limit:
        limit, by = by_letting_go, _BY_LETTING_GO
    state[sv.GUIDANCE_LIMIT] = limit if isfinite(limit) else 0.0
    state[sv.GUIDANCE_LIMITED_BY] = by


@stage
def governor_stage(state: FloatArray, p: FloatArray) -> None:
    """Scale TORQUE_* so that a needle let go stays slow; write LET_GO_SCALE and LET_GO."""
    left, right = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    if not state[sv.ENABLED] > 0.5:
        state[sv.LET_GO] = 0.0
        p[_AT.running] = p[_AT.caused] = 0.0
    state[sv.LET_GO_SCALE] = 1.0
    if state[sv.KINEMATICS] != OK or not isfinite(left + right + state[sv.Q_TIME]):
        p[_AT.samples] = p[_AT.governed] = 0.0  # safety lets nothing pass; a fresh start afterwards
        return
    _remember(state, p)
    shallow, deep = state[sv.DEPTH_LEAST], state[sv.DEPTH_MOST]
    what = turning(state, p, left, right, shallow, deep)
    size, along_left, along_right, ll, lr, rr, _, inertia = what
    longest = longest_lever(state)
    limit = min(p[_AT.speed] / longest, sqrt(2.0 * p[_AT.energy] / (HEAVIEST * inertia)))
    limit *= p[_AT.margin]
    if not isfinite(size + limit + shallow + deep + state[sv.L_OUT]):
        # What cannot be bounded is not let through.
        _let_nothing_pass(state, p)
        return
    hand = min(p[_AT.hand] / longest, limit / _SLOWEST_HAND)
    doubt = p[_AT.resolution] * sqrt(ll + rr + 2.0 * abs(lr))  # both joints one count out
    step, age = max(state[sv.DT], _SHORTEST), _age(state)
    strongest = stoppable(limit - hand, doubt, step + age)
    _tell_the_limit(state, p, left, right, what, strongest)
    scale = 1.0
    if size > 0.0:
        cap = min(strongest / size, 1.0)
        least, most = speed_bounds(
            p[_RING:],
            int(p[_AT.head]),
            int(p[_AT.samples]),
            along_left,
            along_right,
            ll,
            lr,
            rr,
            p[_AT.resolution],
        )
        # A first reading bounds nothing: no force yet. Since the newest, the force went on.
        since = p[_RING + 4 * int(p[_AT.head]) + 3] * age
        room = (limit - max(most + since, 0.0)) / step
        state[sv.LET_GO_SCALE] = min(max(room / (cap * size), 0.0), 1.0)
        state[sv.LIMIT_SCALE] *= cap
        scale = cap * state[sv.LET_GO_SCALE]
        proof = min(p[_AT.run_away] / state[sv.L_OUT], _SURELY_RUNS * limit)
        _watch(state, p, least, proof, hand)
    p[_AT.acceleration] = scale * size
    p[_AT.governed] = scale * max(abs(left), abs(right))
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = scale * left, scale * right


@dataclass(frozen=True, slots=True)
class SpeedGovernor:
    """Keeps a needle that is let go below a speed and an energy, and notices that it is.

    Attributes:
        needle: its mass [kg], inertia about its centre of mass [kg·m²], that one's distance from
            the hub [m].
        needle_length: C, hub to tip [m].
        count: one encoder count at the joint [rad].
        speed: of the hub that is promised [m/s], see `profile.let_go`.
        energy: kinetic, of the free mechanism, that is promised [J].
        hand_force, joint_torque: limits that act beside it, for GUIDANCE_LIMIT [N], [N·m].
        margin: share of what is promised that the governor plans for.
        hand: speed up to which a hand moves without being mistaken for a needle let go [m/s].
        run_away: speed of the hub, at the depth that the loop takes for the likeliest, that the
            encoders must prove before LET_GO [m/s].
        patience: time for which they must prove it [s].
        cause: time over which pushes add up to the speed that they can have caused [s]; a hand
            that moves faster than that has not let go.
    """

    needle: tuple[float, float, float]
    needle_length: float
    count: float
    speed: float
    energy: float
    hand_force: float
    joint_torque: float
    margin: float = 0.94
    hand: float = 0.08
    run_away: float = 0.14
    patience: float = 0.004
    cause: float = 0.3

    @classmethod
    def of(cls, profile: DeviceProfile) -> "SpeedGovernor":
        """Governor with the needle, encoders and limits of a device profile."""
        part = profile.inertia
        return cls(
            needle=(part.needle_mass, part.needle_inertia, part.needle_centre),
            needle_length=profile.needle_length,
            count=2.0 * pi / profile.encoder.counts_per_turn,
            speed=profile.let_go.speed,
            energy=1e-3 * profile.let_go.energy_mj,
            hand_force=profile.limits.hand_force,
            joint_torque=profile.limits.joint_torque,
        )

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        mass, inertia, centre = self.needle
        own = packed(
            _AT,
            np.zeros(4 * _WINDOW),
            resolution=self.count,
            speed=self.speed,
            energy=self.energy,
            margin=self.margin,
            hand=self.hand,
            run_away=self.run_away,
            patience=self.patience,
            cause=self.cause,
            hand_force=self.hand_force,
            joint_torque=self.joint_torque,
        )
        parameters = packed(
            BODY,
            own,
            needle_mass=mass,
            needle_inertia=inertia,
            needle_centre=centre,
            needle_length=self.needle_length,
        )
        return Stage("governor", governor_stage, parameters)
