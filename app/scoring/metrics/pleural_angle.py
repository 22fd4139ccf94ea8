"""Angle between the needle and the pleura's normal where it was entered, at the flattest.

0° is straight in; flat ones are followed by pneumothorax more often (Ko 2001; Saji 2002).
"""

from typing import Any, Final

from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueKind
from app.scoring.errors import MetricNotAskedError
from app.scoring.met import BY_TIP
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
    met = trajectory.tissues_met()
    entered = [
        one.angle_deg
        for one in met
        if one.kind == TissueKind.LUNG and one.before != "" and one.by == BY_TIP and one.counts
    ]
    if not entered:
        raise MetricNotAskedError(sentence("the lung was not entered"))
    return max(entered)
