"""How often the tip passed the capsule of an organ that has a name, inwards."""

from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.scoring.met import BY_TIP
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Passes through a capsule",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often the tip passed one inwards."""
    met = trajectory.tissues_met()
    return float(
        sum(
            one.kind == TissueKind.ORGAN
            and one.name != ""
            and one.before not in ("", TissueKind.ORGAN)
            for one in met
            if one.by == BY_TIP and one.counts
        )
    )


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
