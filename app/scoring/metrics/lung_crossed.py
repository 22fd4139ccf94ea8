"""Length of the tip's way through aerated lung, on the longest of its ways."""

from math import hypot
from typing import Any, Final

from app.imaging.field.tissue_field import TissueKind
from app.scoring.pleura import aerated_mm
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Aerated lung crossed",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the length [mm]: the sum of what lies on one way forwards, the longest of them."""
    return aerated_mm(trajectory.tissues_met())


def deviation(trajectory: Trajectory) -> float | None:
    """Return that of the ends [mm], as if they were independent; None if it is not known."""
    sds = [one.sd_mm for one in trajectory.tissues_met() if one.kind == TissueKind.LUNG]
    if any(sd is None for sd in sds):
        return None
    return hypot(*(sd for sd in sds if sd is not None for _ in range(2)))
