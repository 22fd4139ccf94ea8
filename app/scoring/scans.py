"""A control scan as scoring sees it."""

from dataclasses import dataclass
from math import isfinite

from app.core.messages import sentence
from app.scoring.errors import TrajectoryError


@dataclass(frozen=True, slots=True)
class ScanMark:
    """One control scan.

    Attributes:
        time: monotonic time [s].
        dose: notional dose-length product [mGy·cm]: a teaching estimate.
        hand_usv: dose of the operator's hand [µSv], likewise; None where nobody asks.

    Raises:
        TrajectoryError: if a number is not finite, or the dose is negative.
    """

    time: float
    dose: float = 0.0
    hand_usv: float | None = None

    def __post_init__(self) -> None:
        if not (isfinite(self.time) and isfinite(self.dose) and self.dose >= 0.0):
            raise TrajectoryError(
                sentence(
                    "a control scan at {time} s of dose {dose} mGy·cm: both must be finite "
                    "numbers, the dose not negative",
                    time=self.time,
                    dose=self.dose,
                )
            )
        if self.hand_usv is not None and not (isfinite(self.hand_usv) and self.hand_usv >= 0.0):
            raise TrajectoryError(
                sentence(
                    "a dose of the hand of {dose} µSv: it must be a number, not negative",
                    dose=self.hand_usv,
                )
            )
