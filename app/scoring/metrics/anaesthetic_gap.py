"""How far short of the pleura or capsule the local anaesthetic ended: of the nearest deposit.

It is to reach that membrane, which is what hurts, and to leave it whole; one beyond it counts by
how far beyond.
"""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Anaesthetic to membrane",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the distance along the needle [mm].

    Raises:
        MetricUnavailableError: if none was given, or no membrane is known.
    """
    deposits = trajectory.steps().deposits
    gaps = [abs(one.gap_mm) for one in deposits if one.gap_mm is not None]
    if not deposits:
        raise MetricUnavailableError(sentence("no local anaesthetic was given"))
    if not gaps:
        raise MetricUnavailableError(sentence("no pleura or capsule is known on the needle's way"))
    return min(gaps)
