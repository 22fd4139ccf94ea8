"""`acus ct path --lung`: the path report of a lung biopsy, and that of other entries."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

from app.commands.answer import Answer
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.core.arrays import FloatArray
    from app.core.progress import Progress
    from app.imaging.field import TissueField
    from app.imaging.structures.structure import Structure
    from app.imaging.volume import Volume
    from app.planning.lung_path.reporting import LungPaths
    from app.planning.lung_path.values import LungPathReport

ABOUT_MM: Final = 125.0
"""The tissue field reaches so far about the target: no path that is scored is longer."""

DEPTH_M: Final = 0.12
"""So deep a needle is taken to come."""

MOST: Final = 8
"""So many entries of the map are looked at."""


def lung_answer(
    volume: Volume, structures: Sequence[Structure], ends: FloatArray, alternatives: int
) -> Answer:
    """Report a path, and the best other entries that the map of entries has.

    Args:
        volume: the CT.
        structures: on it.
        ends: entry and target, LPS [mm], shape (2, 3).
        alternatives: how many other entries; without a device's limits, the patient supine.

    Raises:
        PlanError: if the path does not go through the lung.
    """
    from app.commands.calibrate_parts import with_progress
    from app.imaging.field.making import field_of
    from app.planning.lung_path.reporting import LungPaths
    from app.planning.lung_path.sentences import lung_sentences

    def work(progress: Progress) -> tuple[str, LungPathReport, list[tuple[float, LungPathReport]]]:
        share = 0.4 if alternatives else 1.0
        field = field_of(volume, structures, ends[1], ABOUT_MM, progress=progress.part(0.0, share))
        paths = LungPaths(field, volume)
        report = paths.report(*ends)
        others = []
        if alternatives:
            rest = progress.part(share, 1.0)
            others = _alternatives(paths, field, volume, ends[1], alternatives, rest)
        return field.digest, report, others

    digest, report, others = with_progress(work)
    facts: dict[str, Any] = {
        "digest": digest,
        "lung": report.document(),
        "alternatives": [{"points": points, **other.document()} for points, other in others],
    }
    shown: list[str] = list(lung_sentences(report))
    for points, other in others:
        x, y, z = other.entry_mm
        shown.append("")
        shown.append(
            sentence(
                "entry {x:.1f},{y:.1f},{z:.1f}, {points:.0f} points of the planner",
                x=x,
                y=y,
                z=z,
                points=points,
            )
        )
        shown += [sentence("  {line}", line=line) for line in lung_sentences(other)]
    return Answer(facts, shown)


def _alternatives(
    paths: LungPaths,
    field: TissueField,
    volume: Volume,
    target_mm: FloatArray,
    count: int,
    progress: Progress,
) -> list[tuple[float, LungPathReport]]:
    """Return planner's points and report of the best entries, whatever a device could reach."""
    import numpy as np

    from app.imaging.body import find_body
    from app.imaging.skin import skin_points
    from app.planning.limits import ReachLimits
    from app.planning.paths import best, score_paths
    from app.planning.placement import Placement

    body = find_body(volume, progress.part(0.0, 0.3))
    skin = skin_points(body, progress=progress.part(0.3, 0.5))
    free = ReachLimits(np.zeros(3), np.pi, DEPTH_M, lambda x, y: True)
    rest = progress.part(0.5, 1.0)
    scores = score_paths(target_mm, skin, body, (), Placement(), free, progress=rest, tissues=field)
    found: list[tuple[float, LungPathReport]] = []
    for number in best(scores, MOST):
        report = paths.report_or_none(scores.entries_mm[number], target_mm)
        if report is not None and len(found) < count:
            found.append((float(scores.score[number]), report))
    return found
