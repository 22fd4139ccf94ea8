"""The field of tissue of an exercise: made from its CT or taken from the cache, and in the record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from app.core.progress import Progress
from app.exercises.parts import TissueSource
from app.exercises.scene import device_of
from app.exercises.schema import Exercise
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
