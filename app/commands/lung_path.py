"""`acus ct path --lung`: the path report of a lung biopsy, and that of other entries."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

from app.commands.answer import Answer
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.core.arrays import FloatArray
    from app.core.progress import Progress
    from app.imaging.structures.structure import Structure
    from app.imaging.volume import Volume
    from app.planning.lung_path.values import LungPathReport

ABOUT_MM: Final = 125.0
"""The tissue field reaches so far about the target: no path that is scored is longer."""


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
            from app.planning.lung_path.alternatives import alternatives_of

            others = alternatives_of(
                paths, field, volume, ends[1], alternatives, progress.part(share, 1.0)
            )
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
