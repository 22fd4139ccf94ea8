"""Largest force along the needle while its tip stood on bone.

Only where a hand felt the patient's tissue: a simulated one, or one at a device that can push along
the needle. Bone that the shaft alone touched is left out.
"""

from typing import Any, Final

from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueKind
from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Force on bone",
    "unit": "N",
    "higher_is_better": False,
    "reads": ("axial_force",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the largest [N].

    Raises:
        MetricNotAskedError: if no bone was touched by the tip, or nobody felt it.
    """
    felt = [
        one.force_n
        for one in trajectory.tissues_met()
        if one.kind == TissueKind.BONE and one.counts and one.force_n is not None
    ]
    if not felt:
        raise MetricNotAskedError(sentence("no bone was felt along the needle"))
    return max(felt)
