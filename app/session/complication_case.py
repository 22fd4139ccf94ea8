"""What complications stand on in all attempts at an exercise: the patient, the needle, the odds.

What is known of an attempt is what its needles did; a factor that nobody knows is left open.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING, Final

import numpy as np

from app.imaging.field.tissue_field import TissueField
from app.imaging.inside import LungShape, lung_shape
from app.planning.placement import PatientOrientation, PlacedPlan
from app.scoring.complications.factors import SMALL_MM, THICK_GAUGE, Facts, Lying
from app.scoring.complications.risk import calibrated
from app.scoring.odds import DEEP_MM
from app.session.lung_watch import LesionFacts, LungWatch, lesion_facts
from app.simulation.bound_field import BoundField

if TYPE_CHECKING:
    from app.exercises.procedure import ComplicationsPart
    from app.exercises.schema import Exercise

KIND: Final = "complication"
"""Kind of the events."""


@dataclass(frozen=True, slots=True, eq=False)
class ComplicationCase:
    """What is the same in all attempts at an exercise.

    Attributes:
        part: what can happen.
        placed: the plan.
        field: of the patient's tissue.
        bound: the same in world.
        seed: of the exercise.
        gauge: of the outer needle.
        samples: whether the exercise takes samples, which then make the lung bleed.
        shape: of the lung; None where there is none at the target.
        lying: how the biopsied lung lies.
        lesion: at the target; None where nobody labelled one.
    """

    part: ComplicationsPart
    placed: PlacedPlan
    field: TissueField
    bound: BoundField
    seed: int
    gauge: int
    samples: bool
    shape: LungShape | None
    lying: Lying | None
    lesion: LesionFacts | None

    @classmethod
    def of(
        cls, exercise: Exercise, placed: PlacedPlan, field: TissueField | None
    ) -> ComplicationCase | None:
        """Return that of an exercise; None where it asks for none, or there is no field.

        Takes a second the first time.
        """
        procedure = exercise.procedure
        if procedure is None or procedure.complications is None or field is None:
            return None
        down = placed.T_world_patient.inverse().rotate(np.array([0.0, 0.0, -1.0]))
        target = placed.plan.target_mm
        shape = lung_shape(field, target, down)
        calibrated()  # not while an attempt runs
        return cls(
            part=procedure.complications,
            placed=placed,
            field=field,
            bound=BoundField(field, placed.T_world_patient, placed.p_target),
            seed=exercise.seed,
            gauge=exercise.needle.gauge,
            samples=procedure.biopsy is not None,
            shape=shape,
            lying=None if shape is None else lying_of(placed.placement.orientation, shape.is_left),
            lesion=lesion_facts(field, target),
        )


def lying_of(orientation: PatientOrientation, is_left: bool) -> Lying:
    """Return how a lung lies by how the patient does."""
    if orientation is PatientOrientation.SUPINE:
        return Lying.SUPINE
    if orientation is PatientOrientation.PRONE:
        return Lying.PRONE
    down = (orientation is PatientOrientation.LEFT_DOWN) == is_left
    return Lying.DOWN if down else Lying.UP


def known_facts(case: ComplicationCase, watch: LungWatch, thick: bool) -> Facts | None:
    """Return what is known of an attempt by what its needles did; None without a puncture.

    `thick`: whether the outer needle has punctured the pleura, and is a thick one.
    """
    if not watch.punctures:
        return None
    known = {"again": watch.punctures > 1, "thick": thick}
    if case.part.emphysema is not None:
        known["emphysema"] = case.part.emphysema
    if watch.target_in_lung:
        known["deep"] = watch.aerated_mm >= DEEP_MM
    if case.lesion is not None and watch.target_in_lung:
        known["small"] = case.lesion.diameter_mm < SMALL_MM
        known["free"] = not case.lesion.touches
    if watch.knows_lobes:
        known["fissure"] = watch.fissures > 0
    if watch.knows_bullae:
        known["bulla"] = watch.bullae > 0
    return Facts(case.lying, known)


def along_the_plan(case: ComplicationCase) -> Facts | None:
    """Return what would be known of a needle that goes along the plan once, to its target."""
    plan = case.placed.plan
    watch = LungWatch(case.field, plan.target_mm)
    for share in np.linspace(0.001, 1.0, max(2, ceil(plan.length_mm))).tolist():
        way = plan.target_mm - plan.entry_mm
        watch.look(plan.entry_mm + share * way, share * plan.length_mm)
    return known_facts(case, watch, case.gauge <= THICK_GAUGE)
