"""Study: the angles of the rings for a direction of the needle, in closed form and by iteration."""

from collections.abc import Callable
from math import atan2, cos, hypot, sin
from typing import Any, Final

import numpy as np

from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Angles of the rings",
    "question": "Does the gimbal's closed form do?",
    "reference": "the angles that the direction was made of",
}


def direction(q1: float, q2: float) -> tuple[float, float, float]:
    """Return the needle's direction, hub to tip."""
    return -sin(q2), sin(q1) * cos(q2), -cos(q1) * cos(q2)


def _case(setting: Setting) -> Case:
    q = setting.values["q1"], setting.values["q2"]
    return Case(
        data=direction(*q),
        error=lambda found: float(np.abs(np.subtract(found, q)).max()),
        perception=1e-4,
    )


def _closed(case: Case) -> Prepared:
    x, y, z = case.data
    return Prepared(lambda: (atan2(y, -z), atan2(-x, hypot(y, z))))


def _newton(steps: int) -> Callable[[Case], Prepared]:
    def run(x: float, y: float) -> tuple[float, float]:
        q1, q2 = 0.0, 0.0
        for _ in range(steps):
            dx, dy, _ = direction(q1, q2)
            q2 += (dx - x) / cos(q2)
            q1 += (y - dy) / (cos(q1) * cos(q2))
        return q1, q2

    return lambda case: Prepared(lambda: run(*case.data[:2]))


STUDY: Final = Study(
    error_label="error of a ring [rad]",
    ways=(
        Way("closed form", "closed", _closed),
        *(Way(f"{n} steps", "newton", _newton(n)) for n in (1, 3)),
    ),
    settings=(
        Setting("nearly upright", {"q1": 0.05, "q2": -0.03}),
        Setting("leaning by 30°", {"q1": 0.4, "q2": 0.35}),
    ),
    case=_case,
    deadline=Limit(1e-3, "1 ms"),
    perception=Limit(1e-4, "0.1 mrad"),
    default="closed form",
    because="exact, and the cheapest",
)
