"""The CT of an exercise as it is used, read in its way, with structures of risk and tissue."""

from __future__ import annotations

from app.core.messages import sentence
from app.core.progress import Progress
from app.exercises.errors import ExerciseError
from app.exercises.schema import Exercise
from app.imaging.field import TissueField
from app.imaging.volume import Volume
from app.planning.plan import Plan
from app.session.risks import Risk


def read_ct(exercise: Exercise, progress: Progress | None = None) -> Volume:
    """Read the CT of an exercise in its way.

    Raises:
        AcusError: if it cannot be read; says why.
        Cancelled: if `progress` was cancelled.
    """
    from app.imaging.phantom.series import phantom_series
    from app.imaging.reading import choose, load_ct, read_with
    from app.imaging.scanning import scan_folder

    progress, ct = progress or Progress(), exercise.ct
    if ct.folder is None:
        return load_ct(phantom_series(ct.phantom.seed if ct.phantom else 1, progress))
    listing = scan_folder(ct.folder, progress.part(0.0, 0.3))
    return read_with(choose(listing, ct.series, ct.remedy), ct.remedy, progress.part(0.3, 1.0))


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
            sentence(
                "exercise {exercise_id} has structures of risk, and no CT to place them on: open "
                "it",
                exercise_id=exercise.id,
            )
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


ENTRY_STEP_MM = 20.0
"""Plans whose entries round to one place in these steps share a tissue field."""


def load_field(
    exercise: Exercise, volume: Volume | None, plan: Plan, progress: Progress | None = None
) -> TissueField | None:
    """Return the tissue field of an exercise's CT; None without a CT in Hounsfield units.

    It is made once, in up to ten seconds, and kept in the cache. Where the student chooses the
    entry it covers all of the CT, else what a needle reaches from about the plan's entry.

    Raises:
        AcusError: if a file of structures cannot be read, or the field does not fit the memory.
        Cancelled: if `progress` was cancelled.
    """
    if volume is None or volume.unit != "HU":
        return None
    import numpy as np

    from app.imaging.field.making import REACH_MM, field_of  # scipy, compiled code
    from app.imaging.structures.files import read_structures

    progress = progress or Progress()
    structures = []
    for number, part in enumerate(exercise.structures):
        step = progress.part(0.2 * number / len(exercise.structures), 0.2)
        structures += list(read_structures(part.file, volume, step))
    entry = np.rint(plan.entry_mm / ENTRY_STEP_MM) * ENTRY_STEP_MM
    whole = exercise.is_own_plan or not volume.contains(entry)
    reach = REACH_MM + ENTRY_STEP_MM
    return field_of(
        volume, structures, None if whole else entry, reach, progress=progress.part(0.2, 1.0)
    )
