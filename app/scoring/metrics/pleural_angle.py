"""Angle between the needle and the pleura's normal where it was entered, at the flattest.

0° is straight in; flat ones are followed by pneumothorax more often (Ko 2001; Saji 2002).
"""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricNotAskedError
from app.scoring.pleura import flattest_deg
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Pleural angle",
    "unit": "°",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the largest [degrees].

    Raises:
        MetricNotAskedError: if the lung was not entered.
    """
    angle = flattest_deg(trajectory.tissues_met())
    if angle is None:
        raise MetricNotAskedError(sentence("the lung was not entered"))
    return angle
