"""A structure that the needle had to keep away from, as scoring sees it."""

from dataclasses import dataclass
from math import isfinite

from app.core.messages import sentence
from app.scoring.errors import TrajectoryError


@dataclass(frozen=True, slots=True)
class RiskMark:
    """How near the needle came to one structure.

    Attributes:
        name: of the structure.
        limit_mm: it should have stayed at least this far off.
        closest_mm: smallest distance of the needle's part in the body; negative inside.
        time: monotonic time of that moment [s].
        depth_mm: of the tip then.
        inside_s: how long the needle was inside it [s]; None in records that do not say it.

    Raises:
        TrajectoryError: if a number is not finite, or the limit is negative.
    """

    name: str
    limit_mm: float
    closest_mm: float
    time: float = 0.0
    depth_mm: float = 0.0
    inside_s: float | None = None

    def __post_init__(self) -> None:
        numbers = (self.limit_mm, self.closest_mm, self.time, self.depth_mm, self.inside_s or 0.0)
        if not (all(map(isfinite, numbers)) and self.limit_mm >= 0.0 and numbers[-1] >= 0.0):
            raise TrajectoryError(
                sentence(
                    "{closest_mm} mm from {name}, limit {limit_mm} mm, at {time} "
                    "s, inside for {inside_s} s: all must be finite numbers, limit and time "
                    "inside not negative",
                    closest_mm=self.closest_mm,
                    name=self.name,
                    limit_mm=self.limit_mm,
                    time=self.time,
                    inside_s=self.inside_s,
                )
            )

    @property
    def breach_mm(self) -> float:
        """By how much it came nearer than allowed; 0 if it did not."""
        return max(0.0, self.limit_mm - self.closest_mm)
