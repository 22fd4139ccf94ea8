"""Targets that were to be touched one after the other, as scoring sees them."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from app.core.messages import sentence
from app.scoring.errors import TrajectoryError


@dataclass(frozen=True, slots=True)
class Touches:
    """How far an attempt came with its targets.

    Attributes:
        of: how many targets there were.
        times: when each was touched, in their order [s]; shorter where some were not.

    Raises:
        TrajectoryError: if there are no targets, more touches than targets, or times that do not
            rise.
    """

    of: int
    times: tuple[float, ...]

    def __post_init__(self) -> None:
        rise = all(a < b for a, b in zip(self.times, self.times[1:], strict=False))
        if not (0 <= len(self.times) <= self.of and self.of > 0 and rise):
            raise TrajectoryError(
                sentence(
                    "{touches} touches of {targets} targets at {times} s; they must be no more "
                    "than the targets, of which one at least is needed, one after the other",
                    touches=len(self.times),
                    targets=self.of,
                    times=self.times,
                )
            )
        if not all(isfinite(time) for time in self.times):
            raise TrajectoryError(
                sentence("a touch at {times} s: times must be finite", times=self.times)
            )
