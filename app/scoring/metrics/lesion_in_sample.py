"""Length of lesion in the best sample: its volume over the core's cross-section."""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Lesion in the best sample",
    "unit": "mm",
    "higher_is_better": True,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the length [mm].

    Raises:
        MetricUnavailableError: if no sample was taken.
    """
    samples = trajectory.steps().samples
    if not samples:
        raise MetricUnavailableError(sentence("no sample was taken"))
    return max(sample.lesion_mm for sample in samples)
