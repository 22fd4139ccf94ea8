"""The field of tissue of an exercise: whether it is looked into, and how the record holds it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from app.core.messages import sentence
from app.exercises.errors import ExerciseError
from app.exercises.parts import TissueSource
from app.exercises.scene import device_of
from app.exercises.schema import Exercise
from app.exercises.tissue_choice import TissueChoice, choose
from app.planning.placement import PlacedPlan
from app.session.context import RunContext
from app.session.errors import ReplayError
from app.session.header import TISSUE_FILE, Attachment
from app.session.recording import Recording

if TYPE_CHECKING:
    from app.imaging.field import TissueField

FIELD: Final = "tissue_field"
"""Metadata record that says which field it is."""

MEDIA_TYPE: Final = "application/x-acus-tissue-field"


def resolve_tissue(
    exercise: Exercise, placed: PlacedPlan, tissues: TissueField | None
) -> tuple[Exercise, str]:
    """Return an exercise that says layers or field in place of `auto`, and why in a sentence.

    Args:
        exercise: the exercise.
        placed: its plan in the robot's frame.
        tissues: the field of its CT; None where there is none.

    Raises:
        ExerciseError: if it asks for the field, and there is none.
    """
    if exercise.tissue is TissueSource.LAYERS:
        return exercise, "layers: the exercise has them"
    if exercise.tissue is TissueSource.FIELD and tissues is not None:
        return exercise, "the field: the exercise asks for it"
    if exercise.tissue is TissueSource.FIELD:
        raise ExerciseError(
            sentence(
                "exercise {exercise_id} has tissue: field, and its CT is not open, or its values "
                "are no Hounsfield values: open its CT, or set tissue: layers",
                exercise_id=exercise.id,
            )
        )
    if tissues is None:
        choice = TissueChoice(TissueSource.LAYERS, "layers: there is no CT in Hounsfield values")
    else:
        choice = choose(exercise, placed, device_of(exercise), tissues)
    return exercise.model_copy(update={"tissue": choice.source}), choice.reason


def with_field(context: RunContext, field: TissueField) -> RunContext:
    """Return a context whose records hold the field, once, packed, and say its digest."""
    from app.imaging.field import to_bytes

    facts = {"digest": field.digest, "patient_data": "yes"}
    file = Attachment(TISSUE_FILE, MEDIA_TYPE, to_bytes(field))
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
    content = recording.attachments.get(TISSUE_FILE)
    said = recording.metadata.get(FIELD, {}).get("digest", "")
    if content is None:
        if said:
            raise ReplayError(
                sentence(
                    "this record cannot be replayed: it has no {tissue_file}",
                    tissue_file=TISSUE_FILE,
                )
            )
        return None
    from app.imaging.field import FieldError, from_bytes

    try:
        field = from_bytes(content)
    except FieldError as error:
        why = f"this record cannot be replayed: {TISSUE_FILE} is damaged: {error}"
        raise ReplayError(why) from error
    if field.digest != said:
        raise ReplayError(
            sentence(
                "this record cannot be replayed: {tissue_file} is {field_digest}, and it was made"
                " with {recorded_digest}",
                tissue_file=TISSUE_FILE,
                field_digest=field.digest[:12],
                recorded_digest=said[:12] or "none",
            )
        )
    return field
