"""The field of tissue of an exercise: made from its CT or taken from the cache, and in the record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.exercises.parts import TissueSource
from app.exercises.scene import device_of
from app.exercises.schema import Exercise
from app.exercises.tissue_choice import choose
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.session.context import RunContext
from app.session.errors import ReplayError
from app.session.header import Attachment
from app.session.recording import Recording

if TYPE_CHECKING:
    from app.imaging.field import TissueField
    from app.imaging.structures.structure import Structure
    from app.imaging.volume import Volume

FIELD_FILE: Final = "tissue-field.bin"
"""Name of the attachment that holds the field; patient data."""

FIELD: Final = "tissue_field"
"""Metadata record that says which field it is."""

MEDIA_TYPE: Final = "application/x-acus-tissue-field"

SPACING_MM: Final = 1.0
"""Of the grid: `acus study tissue_field` compares others."""


def make_field(
    exercise: Exercise,
    plan: Plan,
    volume: Volume | None = None,
    structures: Sequence[Structure] = (),
    progress: Progress | None = None,
) -> TissueField:
    """Make the field of an exercise's CT about a plan's entry, or take it from the cache.

    Args:
        exercise: the exercise.
        plan: whose entry the needle goes through.
        volume: its CT, where it has been read; None reads it.
        structures: on it.
        progress: reports, and may be cancelled.

    Raises:
        AcusError: if the CT cannot be read, or no field can be made of it; says why.
        Cancelled: if `progress` was cancelled.
    """
    from app.compose.exercise_ct import read_ct
    from app.imaging.field.making import field_of

    progress = progress or Progress()
    volume = volume or read_ct(exercise, progress.part(0.0, 0.3))
    reach_mm = device_of(exercise).depth_range[1] / MILLIMETRE
    rest = progress.part(0.3, 1.0)
    return field_of(volume, structures, plan.entry_mm, reach_mm, SPACING_MM, rest)


def resolve_tissue(
    exercise: Exercise,
    placed: PlacedPlan,
    volume: Volume | None = None,
    structures: Sequence[Structure] = (),
    progress: Progress | None = None,
) -> tuple[Exercise, TissueField | None, str]:
    """Return an exercise that says layers or field, the field where it is one, and why.

    See `make_field`; an exercise of layers needs neither CT nor time, and says nothing.
    """
    if exercise.tissue is TissueSource.LAYERS:
        return exercise, None, ""
    field = make_field(exercise, placed.plan, volume, structures, progress)
    if exercise.tissue is TissueSource.FIELD:
        return exercise, field, "the field: the exercise asks for it"
    choice = choose(exercise, placed, device_of(exercise), field)
    chosen = exercise.model_copy(update={"tissue": choice.source})
    return chosen, field if choice.source is TissueSource.FIELD else None, choice.why


def with_field(context: RunContext, field: TissueField) -> RunContext:
    """Return a context whose records hold the field, once, packed, and say its digest."""
    from app.imaging.field import to_bytes

    facts = {"digest": field.digest, "patient_data": "yes"}
    file = Attachment(FIELD_FILE, MEDIA_TYPE, to_bytes(field))
    return replace(
        context,
        metadata={**context.metadata, FIELD: facts},
        attachments=(*context.attachments, file),
    )


def recorded_field(recording: Recording) -> TissueField | None:
    """Return the field that a record holds; None where its tissue lay in layers.

    Raises:
        ReplayError: if it is damaged, or another than the record says.
    """
    content = recording.attachments.get(FIELD_FILE)
    said = recording.metadata.get(FIELD, {}).get("digest", "")
    if content is None:
        if said:
            raise ReplayError(f"this record cannot be replayed: it has no {FIELD_FILE}")
        return None
    from app.imaging.field import FieldError, from_bytes

    try:
        field = from_bytes(content)
    except FieldError as error:
        why = f"this record cannot be replayed: {FIELD_FILE} is damaged: {error}"
        raise ReplayError(why) from error
    if field.digest != said:
        raise ReplayError(
            f"this record cannot be replayed: {FIELD_FILE} is {field.digest[:12]}, and it was made"
            f" with {said[:12] or 'none'}"
        )
    return field
