"""The patient of an exercise: his tissue in layers or a field, and how the record holds a field."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Final

import numpy as np

from app.compose.exercise_ct import load_field, read_ct
from app.core.messages import sentence
from app.core.progress import Progress
from app.exercises.errors import ExerciseError
from app.exercises.parts import LayersFrom, OwnPlan, TissueSource
from app.exercises.scene import device_of, draft_of, placed_plan_of, plan_of
from app.exercises.schema import Exercise
from app.exercises.tissue import with_layers_met, with_tissue
from app.exercises.tissue_choice import Needles, choose
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.session.context import RunContext
from app.session.errors import ReplayError
from app.session.header import FIELD_FACTS, TISSUE_FILE, Attachment
from app.session.recording import Recording

if TYPE_CHECKING:
    from app.imaging.field import TissueField
    from app.imaging.volume import Volume
    from app.simulation.bound_field import BoundField

FIELD: Final = FIELD_FACTS
"""Metadata record that says which field it is."""

MEDIA_TYPE: Final = "application/x-acus-tissue-field"

_HAS_LAYERS: Final = sentence("layers: the exercise has them")


def trial_plan(exercise: Exercise) -> Plan:
    """Return the plan that trials follow; where the student plans, the trials' or phantom's entry.

    Raises:
        ExerciseError: if the student plans on a CT that is no phantom.
    """
    own = exercise.plan
    if isinstance(own, OwnPlan) and own.trial_entry_mm is not None:
        return Plan(np.array(own.trial_entry_mm), np.array(own.target_mm), exercise.id)
    if exercise.is_own_plan and exercise.ct.phantom is not None:
        return plan_of(exercise.model_copy(update={"plan": "phantom_default"}))
    return plan_of(exercise)


def tissues_of(
    exercise: Exercise, plan: Plan, progress: Progress | None = None
) -> TissueField | None:
    """Make the tissue field of an exercise that looks into it; None where it does not.

    It does where it forbids something or judges a plan, or does not say that its tissue lies in
    layers.

    Raises:
        AcusError: if the CT or a file of structures cannot be read.
        Cancelled: if `progress` was cancelled.
    """
    if not exercise.needs_field:
        return None
    progress = progress or Progress()
    volume = read_ct(exercise, progress.part(0.0, 0.4))
    return load_field(exercise, volume, plan, progress.part(0.4, 1.0))


def resolve_tissue(
    exercise: Exercise,
    placed: PlacedPlan,
    tissues: TissueField | None,
    needles: Needles | None = None,
) -> tuple[Exercise, str]:
    """Return an exercise that says layers or field in place of `auto`, and why in a sentence.

    Layers that `auto` takes are those that the needle along the path meets in the field.

    Args:
        exercise: the exercise.
        placed: its plan in the robot's frame.
        tissues: the field of its CT; None where there is none.
        needles: in that field, where they have been followed already.

    Raises:
        ExerciseError: if it asks for the field, and there is none.
    """
    if exercise.tissue is TissueSource.LAYERS:
        return exercise, _HAS_LAYERS
    if exercise.tissue is TissueSource.FIELD and tissues is not None:
        return exercise, sentence("the field: the exercise asks for it")
    if exercise.tissue is TissueSource.FIELD:
        raise ExerciseError(
            sentence(
                "exercise {exercise_id} has tissue: field, and its CT is not open, or its values "
                "are no Hounsfield values: open its CT, or set tissue: layers",
                exercise_id=exercise.id,
            )
        )
    if tissues is None:
        layered = exercise.model_copy(update={"tissue": TissueSource.LAYERS})
        return layered, sentence("layers: there is no CT in Hounsfield values")
    needles = needles or Needles(tissues, placed, device_of(exercise))
    choice = choose(exercise, needles)
    if choice.source is TissueSource.LAYERS:
        return with_layers_met(exercise, tissues, needles.planned), choice.reason
    return exercise.model_copy(update={"tissue": choice.source}), choice.reason


class ExercisePatient:
    """The patient of an exercise as who explains it looks at him: CT and field are read once.

    Args:
        exercise: the exercise.
        progress: of reading and making, which begin when they are first asked for.

    Attributes:
        profile: of its device.
        placed: its plan in the robot's frame; where the student chooses the entry, the phantom's
            own or, of any other CT, one of any entry to the target.

    Raises:
        AcusError: if device or plan cannot be used.
    """

    def __init__(self, exercise: Exercise, progress: Progress | None = None) -> None:
        self._exercise, self._progress = exercise, progress or Progress()
        self.profile = device_of(exercise)
        self.placed = placed_plan_of(exercise, self.profile, _any_plan(exercise))

    @cached_property
    def volume(self) -> Volume:
        """Return his CT."""
        return read_ct(self._exercise, self._progress.part(0.0, 0.4))

    @cached_property
    def field(self) -> TissueField | None:
        """Return his field; None without a CT in Hounsfield units."""
        rest = self._progress.part(0.4, 1.0)
        return load_field(self._exercise, self.volume, self.placed.plan, rest)

    @cached_property
    def needles(self) -> Needles | None:
        """Return the needles that the device can hold, in his field."""
        return None if self.field is None else Needles(self.field, self.placed, self.profile)

    def within(self, exercise: Exercise) -> tuple[Exercise, BoundField | None, str]:
        """Return an exercise with his layers, or his field bound to the robot's frame; and why.

        Raises:
            AcusError: if the CT cannot be read, or the path does not begin in it.
        """
        from_ct = (
            exercise.layers_from is LayersFrom.CT and exercise.tissue is not TissueSource.FIELD
        )
        if from_ct and not exercise.is_own_plan:  # nobody's own plan has any
            exercise = with_tissue(exercise, self.volume, self.placed.plan)
        if exercise.tissue is TissueSource.LAYERS:
            return exercise, None, _HAS_LAYERS
        exercise, why = resolve_tissue(exercise, self.placed, self.field, self.needles)
        if self.field is None or exercise.tissue is TissueSource.LAYERS:
            return exercise, None, why
        from app.simulation.bound_field import BoundField

        bound = BoundField(self.field, self.placed.T_world_patient, self.placed.p_target)
        return exercise, bound, why


def _any_plan(exercise: Exercise) -> Plan:
    if not exercise.is_own_plan or exercise.ct.phantom is not None:
        return trial_plan(exercise)
    target = np.array(draft_of(exercise).target_mm)
    return Plan(target - (0.0, 100.0, 0.0), target, exercise.id)


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
