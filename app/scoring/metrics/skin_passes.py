"""How often the tip passed the skin, from outside or from the entry on it."""

from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.scoring.met import BY_TIP
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Passes through the skin",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often the tip passed it inwards."""
    met = trajectory.tissues_met()
    return float(sum(one.kind == TissueKind.SKIN and one.by == BY_TIP for one in met))


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
