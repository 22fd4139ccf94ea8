"""Length of the tip's way through aerated lung, on the longest of its ways."""

from math import hypot
from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.scoring.met import BY_TIP
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Aerated lung crossed",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the length [mm]: the sum of what lies on one way forwards, the longest of them."""
    met = trajectory.tissues_met()
    ways: dict[int, float] = {}
    way, depth = 0, 0.0
    for one in met:
        if one.by != BY_TIP:
            continue
        way += one.entered_mm < depth  # drawn back, and forwards anew
        depth = one.entered_mm
        if one.kind == TissueKind.LUNG:
            ways[way] = ways.get(way, 0.0) + one.length_mm
    return max(ways.values(), default=0.0)


def deviation(trajectory: Trajectory) -> float | None:
    """Return that of the ends [mm], as if they were independent; None if it is not known."""
    sds = [one.sd_mm for one in trajectory.tissues_met() if one.kind == TissueKind.LUNG]
    if any(sd is None for sd in sds):
        return None
    return hypot(*(sd for sd in sds if sd is not None for _ in range(2)))
