"""An ablation as scoring sees it."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from app.core.messages import sentence
from app.scoring.errors import TrajectoryError


@dataclass(frozen=True, slots=True)
class AblationMark:
    """What was ablated by the electrodes as they lay.

    Attributes:
        least_margin_mm: least distance from the lesion's surface to what was left of the organ,
            negative where the lesion itself was not covered.
        planned_margin_mm: the same of the planned electrodes.
        share: of the lesion that was covered, 0 to 1.
        vessels: great vessels within 3 mm of the zone, by name.
        reached: what else the zone reached, by name.
        spacing_error_mm: largest error of a distance between two electrodes' tips.

    Raises:
        TrajectoryError: if a number is not finite, or the share none.
    """

    least_margin_mm: float
    planned_margin_mm: float
    share: float
    vessels: tuple[str, ...] = ()
    reached: tuple[str, ...] = ()
    spacing_error_mm: float = 0.0

    def __post_init__(self) -> None:
        numbers = self.least_margin_mm, self.planned_margin_mm, self.share, self.spacing_error_mm
        if not all(map(isfinite, numbers)) or not 0.0 <= self.share <= 1.0:
            raise TrajectoryError(
                sentence("an ablation of the record is none: {numbers}", numbers=numbers)
            )
