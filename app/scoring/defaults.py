"""Tolerances where an exercise gives none, and those that a new exercise begins with.

Sources: largest error that 153 respondents of a survey, 125 of them radiologists, would allow:
2.7 mm (de Jong 2018), a wish and nobody's measured hand (`scoring.pass_line`); free-hand CT
guidance 6.3 ± 3.6 mm and 3.4 ± 3.1° against 4.0 mm and 1.3 ± 0.9° with guidance (Gruber-Rouh
2015), 204 ... 277 s (Weigel 2023).
"""

from types import MappingProxyType
from typing import Final

from app.scoring.tolerance import Tolerance


def _tolerance(expert: float, good: float, passing: float, **options: object) -> Tolerance:
    limits = {"expert": expert, "good": good, "pass": passing}
    return Tolerance.model_validate(limits | options)


DEFAULT_TOLERANCES: Final = MappingProxyType(
    {
        "lateral_error": _tolerance(2.0, 3.0, 5.0, weight=3.0, required=True),
        "depth_error": _tolerance(2.0, 3.0, 5.0, weight=2.0, required=True),
        "angle_error": _tolerance(1.0, 2.0, 3.0, weight=2.0),
        "path_ratio": _tolerance(1.1, 1.3, 1.6, weight=1.0),
        "total_time": _tolerance(120.0, 200.0, 300.0, weight=1.0),
    }
)
"""Metric name -> tolerance, where an exercise gives none: engineering defaults, and wide.

They stay as they are: attempts at exercises that give none are compared under them.
"""

PUBLISHED_TOLERANCES: Final = MappingProxyType(
    {
        "lateral_error": _tolerance(0.6, 1.9, 2.7, weight=3.0, required=True),
        "depth_error": _tolerance(0.6, 1.9, 2.7, weight=2.0, required=True),
        "angle_error": _tolerance(0.4, 1.3, 2.2, weight=2.0),
        "path_ratio": DEFAULT_TOLERANCES["path_ratio"],
        "total_time": DEFAULT_TOLERANCES["total_time"],
    }
)
"""Metric name -> tolerance of a new exercise, by published errors, so that novices fail and experts
pass: 2.7 mm passes across and along the path; angles are mean - SD, mean and mean + SD of guided
insertions; 0.6 and 1.9 mm are what 0.4° and 1.3° leave across the path at 85 mm."""
