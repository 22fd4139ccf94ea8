"""Length of the needle's way through organs that have a name and do not hold the target."""

from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Other organs crossed",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the length [mm] over all of them."""
    met = trajectory.tissues_met()
    return sum(
        one.length_mm
        for one in met
        if one.kind == TissueKind.ORGAN and one.name and not one.holds_target and one.counts
    )
