"""Friction of each joint: torque at breakaway, and torque at constant speed."""

from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.device.commissioning.pulses import (
    LARGEST,
    LET_GO_AND_CONFIRM,
    SIDES,
    PulseRoutine,
    index,
    torque_slot,
)
from app.device.commissioning.results import Friction, JointFriction, RoutineName, Side
from app.device.commissioning.routine import Part, Script
from app.device.errors import CommissioningError

_RAMPS: Final = 3
_RAMP_RATE: Final = 0.005  # [N·m/s], slow against the loop
_RAMP_WAY: Final = 0.005  # [rad], and four counts at least
_RAMP_WINDOW: Final = 0.08  # [s] over which the acceleration is taken
_SPEEDS: Final = (0.1, 0.2, 0.35, 0.5)  # [rad/s]: at most about 6 cm/s at the hub
_TRAVEL: Final = 0.12  # [rad] to either side of the starting pose
_COUNTED: Final = 0.4  # share of a sweep, in its middle, that counts
_BANDWIDTH: Final = 20.0  # [1/s] of the speed control: far below the steps' 100 Hz
_PATIENCE: Final = 4.0  # [s] for one sweep
_STEPS: Final = 28


class FrictionRoutine(PulseRoutine):
    """Sweeps at constant speed, forth and back, then slow ramps until the joint moves.

    The sweeps hold the speed by a slow proportional-integral control of the test torque; what the
    change of speed takes is fitted and taken out.
    """

    NAME: ClassVar[RoutineName] = RoutineName.FRICTION
    TITLE: ClassVar[str] = "Friction"

    def _script(self) -> Script:
        self._disarm()
        yield from self._ask(LET_GO_AND_CONFIRM)
        yield from self._arm(1.0, 1.0)
        pose = self._loop.latest().q.copy()
        found = []
        for side in SIDES:
            inertia = self._inertia(index(side))
            moving = fit((yield from self._sweeps(side, pose)), inertia)
            ramps = yield from self._ramps(side, pose, inertia)
            found.append(joint_friction(moving, ramps))
        return Friction(left=found[0], right=found[1])

    def _ramps(self, side: Side, pose: FloatArray, inertia: float) -> Part:
        """Torques at breakaway [N·m], both directions, signless."""
        own, torques = index(side), []
        enough = max(_RAMP_WAY, 4.0 * self._count)
        for _ in range(_RAMPS):
            for sign in (1.0, -1.0):
                message = f"slow ramp on the {side} joint"
                moved, rows = yield from self._ramp(
                    side, sign, _RAMP_RATE, enough, message, own_only=True
                )
                if not moved.any():
                    raise CommissioningError(
                        sentence(
                            "{title}: the {side} joint does not move up to {largest:g} N·m; let"
                            " go of the needle, or look for what rubs",
                            title=self.TITLE,
                            side=side,
                            largest=LARGEST,
                        )
                    )
                q, torque = rows[:, sv.Q_LEFT + own], rows[:, torque_slot(side)]
                torques.append(breakaway(rows[:, sv.TIME], sign * q, sign * torque, inertia))
                self._progress += 1.0 / _STEPS
                yield from self._go_back(pose, "going back")
        return np.array(torques)

    def _sweeps(self, side: Side, pose: FloatArray) -> Part:
        """Mean (speed, acceleration, torque) of each sweep, shape (n, 3)."""
        found = []
        yield from self._sweep(side, -_SPEEDS[0], pose)  # to one end, before anything counts
        for speed in _SPEEDS:
            for sign in (1.0, -1.0):
                found.append((yield from self._sweep(side, sign * speed, pose)))
                self._progress += 1.0 / _STEPS
        yield from self._go_back(pose, "going back")
        return np.array(found)

    def _sweep(self, side: Side, speed: float, pose: FloatArray) -> Part:
        """Drive one joint at a speed [rad/s] to the end of its travel, the other held in place."""
        own, centre = index(side), float(pose[index(side)])
        inertia = self._inertia(own)
        goal = centre + np.sign(speed) * _TRAVEL
        begin, tick, error_sum, last = self._now, self._loop.latest().tick, 0.0, self._now
        q = float(self._loop.latest().q[own])
        while (goal - q) * speed > 0.0:
            error = speed - self._speed(own)
            error_sum += error * (self._now - last)
            last = self._now
            torque = inertia * _BANDWIDTH * (error + 0.25 * _BANDWIDTH * error_sum)
            torques = [self._holding(k, float(pose[k])) for k in range(2)]
            torques[own] = float(np.clip(torque, -LARGEST, LARGEST))
            self._torque(*torques)
            state = yield from self._say(f"{side} joint at {abs(speed):g} rad/s")
            q = float(state.q[own])
            if self._now - begin > _PATIENCE + 2.0 * _TRAVEL / abs(speed):
                raise CommissioningError(
                    sentence(
                        "{title}: the {side} joint does not keep {speed:g} rad/s with"
                        " {largest:g} N·m; take the needle out, or look for what rubs",
                        title=self.TITLE,
                        side=side,
                        speed=abs(speed),
                        largest=LARGEST,
                    )
                )
        return self._mean(side, tick, centre)

    def _mean(self, side: Side, since: int, centre: float) -> tuple[float, float, float]:
        """Mean (speed, acceleration, torque) of the middle of a sweep.

        It is the same stretch forth and back, so that gravity cancels.
        """
        rows = self._loop.rows(since)
        q = rows[:, sv.Q_LEFT + index(side)]
        used = np.abs(q - centre) <= _COUNTED * _TRAVEL
        return steady(rows[used, sv.TIME], q[used], rows[used, torque_slot(side)])


def steady(time: FloatArray, q: FloatArray, torque: FloatArray) -> tuple[float, float, float]:
    """Mean speed [rad/s], acceleration [rad/s²] and torque [N·m] of a stretch.

    Args:
        time: [s], shape (n,).
        q: angle [rad], shape (n,).
        torque: sent [N·m], shape (n,).
    """
    if len(time) < 10:
        raise CommissioningError(
            sentence("too few readings while the joint moved; is the link slow?")
        )
    bend, speed, _ = np.polyfit(time - time.mean(), q, 2)
    return float(speed), float(2.0 * bend), float(torque.mean())


def breakaway(time: FloatArray, q: FloatArray, torque: FloatArray, inertia: float) -> float:
    """Largest friction during a ramp [N·m]: torque less inertia times acceleration.

    Args:
        time: [s], shape (n,).
        q: angle in the direction of the torque [rad], shape (n,).
        torque: sent, rising [N·m], shape (n,).
        inertia: [kg·m²].

    Raises:
        CommissioningError: if the ramp is shorter than one window.
    """
    found = []
    for start in np.arange(time[0], time[-1] - _RAMP_WINDOW, 0.25 * _RAMP_WINDOW):
        part = (time >= start) & (time <= start + _RAMP_WINDOW)
        if part.sum() >= 5:
            bend = np.polyfit(time[part] - time[part].mean(), q[part], 2)[0]
            found.append(float(torque[part].mean() - inertia * 2.0 * bend))
    if not found:
        raise CommissioningError(
            sentence(
                "Friction: the joint moved at once, without a ramp; is the torque factor far too "
                "large?"
            )
        )
    return max(found)


@dataclass(frozen=True, slots=True)
class Fit:
    """Torque at constant speed: Coulomb [N·m], viscous [N·m·s/rad], residual [N·m]."""

    coulomb: float
    viscous: float
    residual: float


def fit(sweeps: FloatArray, inertia: float) -> Fit:
    """Fit torque - inertia · acceleration = Coulomb · sign + viscous · speed + bias.

    The bias is what pulls to one side (gravity).

    Args:
        sweeps: (speed, acceleration, torque) of each, both directions, shape (n, 3).
        inertia: of the joint [kg·m²]; the sweeps are nearly steady, so its error counts little.
    """
    speed, acceleration, torque = sweeps.T
    terms = np.column_stack([np.sign(speed), speed, np.ones_like(speed)])
    solution, *_ = np.linalg.lstsq(terms, torque - inertia * acceleration, rcond=None)
    left = torque - inertia * acceleration - terms @ solution
    return Fit(float(solution[0]), float(solution[1]), float(np.sqrt(np.mean(left**2))))


def joint_friction(moving: Fit, ramps: FloatArray) -> JointFriction:
    """Friction of a joint from its sweeps and its ramps (forth and back in turns) [N·m]."""
    spread = np.hypot(ramps[::2].std(), ramps[1::2].std()) / np.sqrt(2.0)
    return JointFriction(
        breakaway=float(ramps.mean()),
        breakaway_spread=float(spread),
        coulomb=moving.coulomb,
        viscous=moving.viscous,
        residual=moving.residual,
    )
