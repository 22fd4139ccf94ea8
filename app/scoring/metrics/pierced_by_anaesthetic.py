"""How often the needle for local anaesthetic went through the pleura or the capsule."""

from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.scoring.met import BY_TIP
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Pierced by the anaesthetic",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often it came into lung, or into what holds the target."""
    met = trajectory.steps().met_before
    inside = [one for one in met if one.by == BY_TIP and one.counts]
    return float(sum(one.kind == TissueKind.LUNG or one.holds_target for one in inside))


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
