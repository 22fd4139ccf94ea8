"""Defects of the force path's hard cases: unlimited, unguarded, by cancelling formulas."""

from math import acos, sin, sqrt
from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.device.control.governor import SpeedGovernor
from app.device.control.law_kernels import hill_kernel
from app.device.control.passivity import PassivityGuard
from app.device.control.speed_bounds import stoppable
from tests.hard.defects import Defect


def by_projection(dx: float, dy: float, dz: float, px: float, py: float, pz: float) -> Any:
    d, p = np.array([dx, dy, dz]), np.array([px, py, pz])
    p = p / np.linalg.norm(p)
    along = float(p @ d)
    return *(p - along * d), acos(min(along, 1.0))


def endless(angle: float, stiffness: float, limit: float) -> tuple[float, float]:
    # The spring as if it were not limited.
    return stiffness, 0.5 * stiffness * angle * angle * (1.0 + 1e-12)


def after_noon(angle: float, stiffness: float, limit: float) -> tuple[float, float]:
    """Work of the limit, not of the limit times the sine, beyond 90°."""
    bend = limit / stiffness
    return limit, limit * (angle - 0.5 * bend)


def expanded(angle: float, reach: float, slope: float) -> tuple[float, float]:
    # The integral multiplied out: its terms cancel towards the end.
    x = angle / reach
    whole = x**2 / 2.0 - x**3 + 0.75 * x**4 - 0.2 * x**5
    force = slope * (1.0 - 3.0 * x + 3.0 * x**2 - x**3) * angle / sin(angle)
    return force, slope * reach**2 * (0.05 - whole)


def hill_without_factor(angle: float, reach: float, slope: float) -> tuple[float, float]:
    force, _ = hill_kernel(angle, reach, slope)
    return force, 0.25 * slope * reach**2 * (1.0 - angle / reach) ** 4


def subtracting(*v: float) -> float:
    f, b, limit = np.array(v[:3]), np.array(v[3:6]), v[6]
    square, along = float(b @ b), float(f @ b)
    room = limit * limit - float(f @ f)
    return room / (along + sqrt(along * along + square * room))


def plain_norm(x: float, y: float, z: float) -> float:
    return sqrt(x * x + y * y + z * z)


def unsnapped(governor: SpeedGovernor) -> Any:
    stage = governor.stage()

    def step(state: FloatArray, parameters: FloatArray) -> None:
        stage.function(state, parameters)
        parameters[-1] = 1e-310

    return stage._replace(function=step)


def open_gate(guard: PassivityGuard | SpeedGovernor) -> Any:
    return guard.stage()._replace(function=lambda state, parameters: None)


DEFECTS = {
    "force laws": {
        "direction and angle from a needle to a path 2e-9 rad beside it": Defect(
            "projection and acos of the dot product", by_projection
        ),
        "energy that the attraction stores at 1e-9 rad": Defect(
            "saturated from the start", lambda a, k, f: (f, f * a)
        ),
        "energy that the attraction stores at 90°": Defect("never saturated", endless),
        "energy that the attraction stores at 1e-9 rad short of 180°": Defect(
            "no fading beyond 90°", after_noon
        ),
        "an attraction of up to 1e300 N/rad gives no more than its limit": Defect(
            "stiffness times angle", lambda a, k, f: (k * a / max(sin(a), 1e-300), 0.0)
        ),
        "force and energy of the repulsion, 1e-6 of its reach from its end": Defect(
            "multiplied out", expanded
        ),
        "force and energy of the repulsion, half its reach from its end": Defect(
            "energy of a quartic without its factor", hill_without_factor
        ),
        "share of a damper of 1e6 N against a force 1e-7 N below the limit": Defect(
            "the form of the root that subtracts like numbers", subtracting
        ),
    },
    "governor": {
        **dict.fromkeys(
            (
                "acceleration that can be stopped in plenty of room for speed",
                "acceleration that can be stopped in hardly any room for speed",
            ),
            Defect("the tick alone, without the encoder's doubt", lambda r, d, t: r / t),
        ),
        "the speed after noticing stays within the room, from 0 to 1000 rad/s": Defect(
            "one count of doubt instead of two", lambda r, d, t: stoppable(r, 0.25 * d, t)
        ),
        "travel that counts does not jump where motion turns against the force": Defect(
            "its size as soon as it goes along", lambda a, s: s if a > 0.0 else a
        ),
        "no torque where the needle's direction is no number": Defect(
            "what cannot be bounded is let through", open_gate
        ),
        "length of a force of 1e201 N": Defect("root of the sum of squares", plain_norm),
        "a force of 1e200 N is brought to 5 N": Defect(
            "limit over the root of the sum of squares",
            lambda x, y, z, f: f / plain_norm(x, y, z),
        ),
        "two and a half minutes after a push no subnormal number is left of it": Defect(
            "a memory that is not snapped to zero", unsnapped
        ),
    },
    "guard": {
        **dict.fromkeys(
            (
                "a hand that draws energy out for 3 s gets no more than was declared",
                "a joint found 3 rad away after 0.3 s without a reading stops the force",
            ),
            Defect("no guard", open_gate),
        ),
        "damping that takes out a debt of 2 pJ at 1 mrad/s": Defect(
            "debt over speed", lambda d, s, t, m: min(d / sqrt(s) / t, m)
        ),
    },
}
