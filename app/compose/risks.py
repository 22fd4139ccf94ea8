"""The structures that an exercise's needle has to keep away from, with their distances."""

from app.core.progress import Progress
from app.exercises.errors import ExerciseError
from app.exercises.schema import Exercise
from app.imaging.volume import Volume
from app.session.risks import Risk


def load_risks(
    exercise: Exercise, volume: Volume | None, progress: Progress | None = None
) -> tuple[Risk, ...]:
    """Read an exercise's files of structures onto its CT; seconds for large structures.

    Raises:
        ExerciseError: if there is no CT to place them on.
        AcusError: if a file cannot be read, does not belong to the CT, or lacks a structure named.
        Cancelled: if `progress` was cancelled.
    """
    parts = [part for part in exercise.structures if part.risks]
    if not parts:
        return ()
    if volume is None:
        raise ExerciseError(
            f"exercise {exercise.id} has structures of risk, and no CT to place them on: open it"
        )
    from app.imaging.structures.distance import SignedDistance  # scipy
    from app.imaging.structures.files import read_structures

    progress, risks = progress or Progress(), []
    for number, part in enumerate(parts):
        step = progress.part(number / len(parts), (number + 1) / len(parts))
        found = read_structures(part.file, volume, step.part(0.0, 0.5))
        for name, limit in part.risks.items():
            field = SignedDistance.of(found.find(name), step.part(0.5, 1.0))
            risks.append(Risk(name, limit, field))
    return tuple(risks)
