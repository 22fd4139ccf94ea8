"""How often the needle entered stomach, bowel, or gas in them."""

from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Gut touched",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often; tip and shaft."""
    met = trajectory.tissues_met()
    return float(sum(one.kind == TissueKind.GUT and one.counts for one in met))


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
