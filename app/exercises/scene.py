"""From an exercise to what the other rooms work with: plan, placed plan, device, scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Final

import numpy as np

from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.exercises.errors import ExerciseError
from app.exercises.guidance import GuidanceMode
from app.exercises.parts import OwnPlan, PlanPoints
from app.exercises.schema import Exercise
from app.mechanisms.profile import DeviceProfile, load_profile
from app.planning.draft import DraftPlan
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.scoring import metrics
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.plan import TISSUE_FIELD, SimulationPlan
from app.simulation.plan import compile as compile_scene
from app.simulation.scene import DEFAULT_LAYERS, EffectRequest, Needle, Scene
from app.simulation.tissues import MODELS, PUBLISHED, tissue_values

if TYPE_CHECKING:
    from app.imaging.phantom.anatomy import Anatomy
    from app.simulation.bound_field import BoundField


CONTROL_SCAN: Final = "control_scan"
"""Name of the view that shows the control scans, where they guide."""


def plan_of(exercise: Exercise) -> Plan:
    """Entry and target of an exercise; for `phantom_default`, those of its phantom.

    Raises:
        ExerciseError: if the exercise leaves the entry to the student.
    """
    if isinstance(exercise.plan, PlanPoints):
        return exercise.plan.plan()
    if isinstance(exercise.plan, OwnPlan):
        raise ExerciseError(
            sentence(
                "exercise {exercise_id} has no plan of its own: the student places the entry in "
                "the window; nothing is chosen for him",
                exercise_id=exercise.id,
            )
        )
    patient = _phantom_of(exercise)
    return Plan(np.array(patient.entry_mm), np.array(patient.lesion_mm), exercise.id)


def draft_of(exercise: Exercise) -> DraftPlan:
    """Return what an exercise gives of its plan: both points, or the target alone."""
    if not isinstance(exercise.plan, OwnPlan):
        return DraftPlan.of(plan_of(exercise))
    target = exercise.plan.target_mm or _phantom_of(exercise).lesion_mm
    return DraftPlan(None, target, exercise.id)


def _phantom_of(exercise: Exercise) -> Anatomy:
    from app.imaging.phantom.anatomy import (
        anatomy,  # only for this plan: placing the lesion takes a second
    )

    return anatomy(exercise.ct.phantom.seed if exercise.ct.phantom else 1)


def device_of(exercise: Exercise) -> DeviceProfile:
    """Return the exercise's device profile with the ball joint and needle that it asks for.

    Raises:
        ConfigurationError: if profile or joint do not exist, or the device cannot hold the needle;
            names what is valid.
    """
    profile = load_profile(exercise.device)
    if exercise.joint:
        profile = profile.with_joint(exercise.joint)
    length_mm = exercise.needle.length_mm
    return profile if length_mm is None else profile.with_needle(length_mm * MILLIMETRE)


def placed_plan_of(
    exercise: Exercise, profile: DeviceProfile, plan: Plan | None = None
) -> PlacedPlan:
    """Return the exercise's plan, or another one for its patient, in the robot's frame."""
    chosen = plan_of(exercise) if plan is None else plan
    return PlacedPlan.of(chosen, exercise.placement.placement(), profile.fulcrum)


IN_FIELD: Final[Mapping[str, str]] = {
    "lateral_tissue": "field",
    "bone_contact": "field",
    **MODELS[PUBLISHED],
}
"""Effect -> model that it has in a field of tissue where the exercise names none."""


def _requests(exercise: Exercise, in_field: bool) -> tuple[EffectRequest, ...]:
    """List what is asked for; in a field with what looks into it, and bone that turns aside."""
    models = IN_FIELD if in_field else {}
    asked = tuple(
        EffectRequest(name, part.parameters, part.model or models.get(name, ""), part.organ)
        for name, part in exercise.effects.items()
    )
    if not in_field:
        return asked
    slides = (EffectRequest("bone_slide"),) if "bone_contact" in exercise.effects else ()
    named = exercise.effects.keys()
    more = (EffectRequest(TISSUE_FIELD), *slides)
    return (*asked, *(request for request in more if request.name not in named))


def scene_of(exercise: Exercise, profile: DeviceProfile, bound: BoundField | None = None) -> Scene:
    """Return what the simulation has to know about an exercise.

    Args:
        exercise: the exercise.
        profile: its device.
        bound: the patient's tissue in the robot's frame; None: tissue lies in layers.
    """
    return Scene(
        effects=_requests(exercise, bound is not None),
        layers=tuple(part.layer() for part in exercise.layers) or DEFAULT_LAYERS,
        needle=Needle(profile.needle_length, OUTER_DIAMETER[exercise.needle.gauge]),
        R_world_patient=exercise.placement.placement().rotation,
        target_organ=exercise.target_organ,
        joint=profile.workspace.joint,
        tissues=() if bound is None else tissue_values(bound.tissue.tissues),
        field=bound,
    )


def delivered_scene_of(
    exercise: Exercise, profile: DeviceProfile, bound: BoundField | None = None
) -> Scene:
    """Return the same where cameras are simulated: with what the rig's own do to their pictures.

    An effect that the exercise asks for itself is as it asks for it.

    Raises:
        RigError: if there is no such rig.
    """
    from app.tracking.optics.rig import load_rig  # only for the cameras: it takes OpenCV along

    scene = scene_of(exercise, profile, bound)
    usual = load_rig(exercise.rig).pictures
    more = (
        EffectRequest(name, part.parameters, part.model)
        for name, part in usual.items()
        if name not in exercise.effects
    )
    return replace(scene, effects=(*scene.effects, *more))


def metric_consumers(exercise: Exercise) -> tuple[Consumer, ...]:
    """Return the metrics that the exercise scores, with the slots that they read."""
    found = [metrics.find(name) for name in exercise.tolerances]
    return tuple(Consumer(f"“{metric.title}” scores it", metric.reads) for metric in found)


def compile_exercise(
    exercise: Exercise,
    profile: DeviceProfile,
    views: Mapping[str, Consumer],
    simulated: bool = True,
    pictures: bool | None = None,
    bound: BoundField | None = None,
) -> SimulationPlan:
    """Decide what an exercise simulates on a device, and why: what `acus explain` prints.

    Args:
        exercise: the exercise.
        profile: its device.
        views: what every view reads, by its name (`compose.declared_views.declared_views`).
        simulated: whether robot and hand are simulated too.
        pictures: whether cameras are simulated; None: as the robot.
        bound: the patient's tissue in the robot's frame; None: tissue lies in layers.

    Raises:
        SimulationError: for an unknown effect, model or parameter; names what is valid.
        RigError: if cameras are simulated and there is no such rig.
        ExerciseError: if the exercise shows a view that `views` does not have.
    """
    renders = frozenset(axis.value for axis in profile.renders)
    port = DevicePort(profile.name, renders, simulated, pictures)
    return compile_scene(
        (delivered_scene_of if port.takes_pictures else scene_of)(exercise, profile, bound),
        port,
        _watching(exercise, views),
        metric_consumers(exercise),
    )


def _watching(exercise: Exercise, views: Mapping[str, Consumer]) -> list[Consumer]:
    """List the views that show something, the control scans among them where they guide."""
    names = [view.value for view in exercise.shown_views]
    if exercise.guidance_mode is GuidanceMode.CONTROL_CT:
        names.append(CONTROL_SCAN)
    if missing := [name for name in names if name not in views]:
        raise ExerciseError(
            sentence(
                "exercise {exercise_id}: nothing declares the view {view_name!r}; declared "
                "are {views}; see 'How to add a view'",
                exercise_id=exercise.id,
                view_name=missing[0],
                views=", ".join(sorted(views)) or "none",
            )
        )
    return [views[name] for name in names]


def law_requests(exercise: Exercise) -> dict[str, dict[str, float]]:
    """Return the force laws of an exercise with their parameters, as `device.control.laws` takes
    them.
    """
    return {name: dict(part.parameters) for name, part in exercise.laws.items()}
