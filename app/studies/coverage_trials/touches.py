"""One registration: a plate touched somewhere, and how far off the target then is.

Errors of touches are as large in every direction or not, stated with the points or not, and some
share what no residual shows. What is estimated is told no more than the plate's profile says.
"""

from typing import Final

import numpy as np

from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.planning.registration.check import check_points
from app.planning.registration.plate import load_plate
from app.planning.registration.points import NamedPoints
from app.studies.coverage_trials.deviation import Deviation

KINDS: Final = {
    "as large in every direction, not stated": ((0.3, 0.3, 0.3), False, 0.0),
    "five times larger in one, not stated": ((0.1, 0.1, 0.5), False, 0.0),
    "as large in every direction, stated": ((0.3, 0.3, 0.3), True, 0.0),
    "five times larger in one, stated": ((0.1, 0.1, 0.5), True, 0.0),
    "all share 0.3 mm, the plate says so": ((0.1, 0.1, 0.1), True, 0.3),
}
"""Standard deviations per axis [mm], whether they come with the points, and what all share [mm]."""

_TARGET: Final = np.array([0.0, 0.01, 0.0])
"""In the plate's frame [m], below its points."""


def touched(kind: str, seed: int) -> dict[str, tuple[Deviation, ...]]:
    """Touch the shipped plate once; the target's deviation."""
    sds, stated, shared = KINDS[kind]
    plate, rng = load_plate("stepped-plate"), np.random.default_rng([seed, len(kind)])
    T = RigidTransform.exp(np.r_[0.1 * rng.normal(size=3), 0.3 * rng.normal(size=3)])
    sd = np.array(sds) * MILLIMETRE
    noise = sd * rng.normal(size=plate.touch.shape) + shared * MILLIMETRE * rng.normal(size=3)
    spread = np.diag(sd**2) if stated else np.zeros((3, 3))
    points = NamedPoints(plate.names, T @ plate.touch + noise, np.tile(spread, (len(noise), 1, 1)))
    check = check_points(plate, plate.touch, points, (shared * MILLIMETRE) ** 2)
    error = check.fit.T_measured_reference @ _TARGET - T @ _TARGET
    names = ("x", "y", "z")
    return {"target": (Deviation.of(error, check.bounded(T @ _TARGET), names, point=True),)}
