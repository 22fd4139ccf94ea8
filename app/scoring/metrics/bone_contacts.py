"""How often the needle touched bone: each time that it came forwards onto it."""

from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Bone contacts",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often; tip and shaft."""
    met = trajectory.tissues_met()
    return float(sum(one.kind == TissueKind.BONE and one.counts for one in met))


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
