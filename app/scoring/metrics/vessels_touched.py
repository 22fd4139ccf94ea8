"""How often the needle entered a vessel of 2 mm radius and more, or one that somebody marked."""

from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.planning.tissues import SMALL_VESSELS
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Vessels touched",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often; tip and shaft."""
    met = trajectory.tissues_met()
    return float(
        sum(
            one.kind == TissueKind.VESSEL and one.counts and one.name not in SMALL_VESSELS
            for one in met
        )
    )


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
