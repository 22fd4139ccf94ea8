"""Other entries for the same target, as the map of entries has them, with their reports."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.imaging.body import find_body
from app.imaging.field import TissueField
from app.imaging.skin import skin_points
from app.imaging.volume import Volume
from app.planning.limits import ReachLimits
from app.planning.lung_path.values import LungPathReport
from app.planning.paths import best, score_paths
from app.planning.placement import Placement

if TYPE_CHECKING:
    from app.planning.lung_path.reporting import LungPaths

_DEPTH: Final = 0.12  # [m]
_MOST: Final = 8


def alternatives_of(
    paths: LungPaths,
    field: TissueField,
    volume: Volume,
    target_mm: FloatArray,
    count: int,
    progress: Progress,
) -> list[tuple[float, LungPathReport]]:
    """Return planner's points and report of the best entries, whatever a device could reach.

    Args:
        paths: reports.
        field: of the patient.
        volume: the CT.
        target_mm: LPS, shape (3,).
        count: how many at most.
        progress: reports, and may be cancelled.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    body = find_body(volume, progress.part(0.0, 0.3))
    skin = skin_points(body, progress=progress.part(0.3, 0.5))
    free = ReachLimits(np.zeros(3), np.pi, _DEPTH, lambda x, y: True)
    scores = score_paths(
        target_mm, skin, body, (), Placement(), free, progress=progress.part(0.5, 1.0),
        tissues=field,
    )  # fmt: skip
    found: list[tuple[float, LungPathReport]] = []
    for number in best(scores, _MOST):
        report = paths.report_or_none(scores.entries_mm[number], target_mm)
        if report is not None and len(found) < count:
            found.append((float(scores.score[number]), report))
    return found
