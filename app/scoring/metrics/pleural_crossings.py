"""How often the tip crossed the pleura: into the lung, and out of it into something else.

Vessels and airways within the lung are lung, as is a nodule in it that holds the target: going from
one into the other crosses no pleura.
"""

from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.scoring.met import BY_TIP
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Pleural crossings",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often, inwards and outwards."""
    met = trajectory.tissues_met()
    holding = {one.kind for one in met if one.holds_target}
    within = holding - {TissueKind.LUNG} if TissueKind.LUNG in holding else set()
    return float(
        sum(
            (side != "" and side not in within)
            for one in met
            if one.kind == TissueKind.LUNG and one.by == BY_TIP and one.counts
            for side in (one.before, one.after)
        )
    )


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
