"""The speed governor: a needle that is let go never gets faster than a hand moves it.

A robot as light as this one passes 0.25 m/s within a few milliseconds of being let go, sooner than
its encoders tell. So the governor does not wait for a speed: it bounds the one that the hub can
have. Over a window of w s that ends now, the encoders have seen a travel Δx, true to one count δ,
and the torques sent in it can have added a(t); then the speed now is at most

    v <= [|Δx| + δ + ∫ a(t) (t - t_start) dt] / w      for every w,

and the torque is scaled so that even one more tick of acceleration stays below the limit. |Δx|
counts where it goes with the force, along any constraint; motion against the force counts as what
it is, negative. a is the free acceleration, G J M(q)⁻¹ τ with the profile's inertias.

A hand at rest, or moving at up to `hand`, must not make the force flicker: with 2 δ for a travel
of one count more than there was, the bound stays below the limit as long as

    hand + 2 √(δ a) + a T <= limit,

so the force is capped, by pose, to an acceleration that satisfies this: the largest force whose
run-away these encoders can tell in time. Only a light lever meets the cap (docs/decisions/0008).

(|Δx| - δ) / w is the lowest speed that the encoders prove. Above `run_away` for some milliseconds,
along a force that could have caused it, means that nobody holds the needle: LET_GO.
"""

from dataclasses import dataclass
from math import isfinite, pi, sqrt
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.device.control.speed_bounds import OWN, free_acceleration, speed_bounds, stoppable
from app.device.control.vectors import snapped
from app.mechanisms.pantograph.status import OK
from app.mechanisms.profile import DeviceProfile

_COUNT, _LIMIT, _HAND, _RUN_AWAY, _PATIENCE, _CAUSE = range(OWN, 13)  # before: free_acceleration
_GOVERNED, _ACCELERATION, _CAUSED, _RUNNING, _HAND_SEEN, _SAMPLES, _HEAD, _PEAK = range(13, 21)
_RING = 21  # rows of (q_left, q_right, time, largest acceleration sent after it)
_WINDOW = 24
_SIZE = _RING + 4 * _WINDOW
_SHORTEST = 1e-4  # [s] of a tick
_BEYOND = 1.2  # times the speed that the force can have caused: a hand
_HAND_STAYS = 0.2  # [s] for which a hand that was seen is taken to hold on
_JUMP = 0.5  # [rad] between two readings: no motion, a fresh start
_PEAK_LASTS = 0.1  # [s] over which the largest push of late is forgotten


@njit
def _age(state: FloatArray) -> float:
    """Age of the newest reading [s]: on a wire about a tick."""
    return max(state[sv.TIME] - state[sv.Q_TIME], 0.0)


@njit
def _remember(state: FloatArray, p: FloatArray) -> None:
    """Note what was sent since the newest reading, and the reading if there is a newer one."""
    head = int(p[_HEAD])
    sent = max(abs(state[sv.SENT_LEFT]), abs(state[sv.SENT_RIGHT]))
    pushed = sent / p[_GOVERNED] * p[_ACCELERATION] if p[_GOVERNED] > 0.0 else 0.0
    p[_CAUSED] = snapped(p[_CAUSED] + (pushed - p[_CAUSED] / p[_CAUSE]) * state[sv.DT])
    p[_PEAK] = max(pushed, p[_PEAK] * (1.0 - min(state[sv.DT] / _PEAK_LASTS, 1.0)))
    row = _RING + 4 * head
    p[row + 3] = max(p[row + 3], pushed)
    if p[_SAMPLES] > 0.0:
        if state[sv.Q_TIME] == p[row + 2]:
            return
        left, right = abs(state[sv.Q_LEFT] - p[row]), abs(state[sv.Q_RIGHT] - p[row + 1])
        if not (left < _JUMP and right < _JUMP and state[sv.Q_TIME] > p[row + 2]):
            p[_SAMPLES] = 0.0
        head = (head + 1) % _WINDOW
        row = _RING + 4 * head
    p[_HEAD] = head
    p[_SAMPLES] = min(p[_SAMPLES] + 1.0, _WINDOW)
    p[row], p[row + 1] = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    # What was sent before it came acts after it, if it was read before now.
    p[row + 2], p[row + 3] = state[sv.Q_TIME], p[_PEAK] if _age(state) > 0.0 else 0.0


@njit
def _watch(state: FloatArray, p: FloatArray, speed: float) -> None:
    """Set LET_GO once the hub has run, as the force alone can have made it run, for long enough.

    A speed beyond what was pushed proves a hand that moves the needle, or a blow.
    """
    step = max(state[sv.DT], 0.0)
    p[_HAND_SEEN] = max(p[_HAND_SEEN] - step, 0.0)
    if speed > _BEYOND * p[_CAUSED] + p[_HAND]:
        p[_HAND_SEEN] = _HAND_STAYS
    running = speed > p[_RUN_AWAY] and p[_HAND_SEEN] == 0.0
    p[_RUNNING] = p[_RUNNING] + step if running else 0.0
    if p[_RUNNING] >= p[_PATIENCE]:
        state[sv.LET_GO] = 1.0


@njit
def _let_nothing_pass(state: FloatArray, p: FloatArray) -> None:
    """Zero torque; a fresh start of the windows afterwards."""
    p[_SAMPLES] = p[_GOVERNED] = p[_RUNNING] = 0.0
    state[sv.LET_GO_SCALE] = state[sv.TORQUE_LEFT] = state[sv.TORQUE_RIGHT] = 0.0


@stage
def governor_stage(state: FloatArray, p: FloatArray) -> None:
    """Scale TORQUE_* so that a needle let go stays slow; write LET_GO_SCALE and LET_GO."""
    left, right = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    if not state[sv.ENABLED] > 0.5:
        state[sv.LET_GO] = 0.0
        p[_RUNNING] = p[_CAUSED] = 0.0
    state[sv.LET_GO_SCALE] = 1.0
    if state[sv.KINEMATICS] != OK or not isfinite(left + right + state[sv.Q_TIME]):
        p[_SAMPLES] = p[_GOVERNED] = 0.0  # safety lets nothing pass; a fresh start afterwards
        return
    _remember(state, p)
    size, along_left, along_right, ll, lr, rr = free_acceleration(state, p, left, right)
    if not isfinite(size):  # what cannot be bounded is not let through
        _let_nothing_pass(state, p)
        return
    scale = 1.0
    if size > 0.0:
        step, age = max(state[sv.DT], _SHORTEST), _age(state)
        doubt = p[_COUNT] * sqrt(ll + rr + 2.0 * abs(lr))  # both joints one count out
        cap = min(stoppable(p[_LIMIT] - p[_HAND], doubt, step + age) / size, 1.0)
        least, most = speed_bounds(
            p[_RING:],
            int(p[_HEAD]),
            int(p[_SAMPLES]),
            along_left,
            along_right,
            ll,
            lr,
            rr,
            p[_COUNT],
        )
        # A first reading bounds nothing: no force yet. Since the newest, the force went on.
        since = p[_RING + 4 * int(p[_HEAD]) + 3] * age
        room = (p[_LIMIT] - max(most + since, 0.0)) / step
        state[sv.LET_GO_SCALE] = min(max(room / (cap * size), 0.0), 1.0)
        state[sv.LIMIT_SCALE] *= cap
        scale = cap * state[sv.LET_GO_SCALE]
        _watch(state, p, least)
    p[_ACCELERATION] = scale * size
    p[_GOVERNED] = scale * max(abs(left), abs(right))
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = scale * left, scale * right


@dataclass(frozen=True, slots=True)
class SpeedGovernor:
    """Keeps a needle that is let go below a speed, and notices that it is.

    Attributes:
        links: proximal and distal length, distance of the motors [m].
        inertia: lumped inertias of the links [kg·m²], see `mechanisms.inertia.LumpedInertia`.
        count: one encoder count at the joint [rad].
        limit: speed of the hub that the governor plans for [m/s]; the promise is 0.25 m/s, the
            rest is room for what changes within a tick.
        hand: speed up to which a hand moves without being mistaken for a needle let go [m/s].
        run_away: speed that the encoders must prove before LET_GO [m/s].
        patience: time for which they must prove it [s].
        cause: time over which pushes add up to the speed that they can have caused [s]; a hand
            that moves faster than that has not let go.
    """

    links: tuple[float, float, float]
    inertia: tuple[float, float, float, float]
    count: float
    limit: float = 0.235
    hand: float = 0.08
    run_away: float = 0.14
    patience: float = 0.004
    cause: float = 0.3

    @classmethod
    def of(cls, profile: DeviceProfile) -> "SpeedGovernor":
        """Governor with the lengths, inertias and encoders of a device profile."""
        return cls(
            profile.pantograph.links,
            profile.lumped_inertia.values,
            2.0 * pi / profile.encoder.counts_per_turn,
        )

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = np.zeros(_SIZE)
        parameters[:_GOVERNED] = (
            *self.links,
            *self.inertia,
            self.count,
            self.limit,
            self.hand,
            self.run_away,
            self.patience,
            self.cause,
        )
        return "governor", governor_stage, parameters
