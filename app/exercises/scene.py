"""From an exercise to what the other rooms work with: plan, placed plan, device, scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.exercises.errors import ExerciseError
from app.exercises.guidance import GuidanceMode
from app.exercises.parts import OwnPlan, PlanPoints, View
from app.exercises.schema import Exercise
from app.mechanisms.profile import DeviceProfile, load_profile
from app.planning.draft import DraftPlan
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.scoring import metrics
from app.simulation.compiler import compile as compile_scene
from app.simulation.consumers import VIEW_READS, Consumer, DevicePort
from app.simulation.plan import SimulationPlan
from app.simulation.scene import DEFAULT_LAYERS, EffectRequest, Layer, Needle, Scene

if TYPE_CHECKING:
    from app.imaging.phantom.anatomy import Anatomy


def plan_of(exercise: Exercise) -> Plan:
    """Entry and target of an exercise; for `phantom_default`, those of its phantom.

    Raises:
        ExerciseError: if the exercise leaves the entry to the student.
    """
    if isinstance(exercise.plan, PlanPoints):
        return exercise.plan.plan()
    if isinstance(exercise.plan, OwnPlan):
        raise ExerciseError(
            f"exercise {exercise.id} has no plan of its own: the student places the entry in the "
            "window; nothing is chosen for him"
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
    from app.imaging.phantom import anatomy  # only for this plan: placing the lesion takes a second

    return anatomy(exercise.ct.phantom.seed if exercise.ct.phantom else 1)


def device_of(exercise: Exercise) -> DeviceProfile:
    """Return the exercise's device profile with the ball joint that it asks for.

    Raises:
        ConfigurationError: if profile or joint do not exist; lists the valid names.
    """
    profile = load_profile(exercise.device)
    return profile.with_joint(exercise.joint) if exercise.joint else profile


def placed_plan_of(
    exercise: Exercise, profile: DeviceProfile, plan: Plan | None = None
) -> PlacedPlan:
    """Return the exercise's plan, or another one for its patient, in the robot's frame."""
    chosen = plan_of(exercise) if plan is None else plan
    return PlacedPlan.of(chosen, exercise.placement.placement(), profile.pantograph.fulcrum)


def scene_of(exercise: Exercise, profile: DeviceProfile) -> Scene:
    """Return what the simulation has to know about an exercise."""
    layers = tuple(
        Layer(
            name=part.name,
            thickness=part.thickness,
            side_stiffness=part.side_stiffness,
            friction=part.friction,
            static_friction=part.static_friction,
            viscous_friction=part.viscous_friction,
        )
        for part in exercise.layers
    )
    return Scene(
        effects=tuple(
            EffectRequest(name, part.parameters, part.model, part.organ)
            for name, part in exercise.effects.items()
        ),
        layers=layers or DEFAULT_LAYERS,
        needle=Needle(length=profile.geometry.needle_length),
        R_world_patient=exercise.placement.placement().rotation,
        target_organ=exercise.target_organ,
    )


def metric_consumers(exercise: Exercise) -> tuple[Consumer, ...]:
    """Return the metrics that the exercise scores, with the slots that they read."""
    found = [metrics.find(name) for name in exercise.tolerances]
    return tuple(Consumer(f"metric {metric.name} scores it", metric.reads) for metric in found)


def compile_exercise(
    exercise: Exercise, profile: DeviceProfile, simulated: bool = True
) -> SimulationPlan:
    """Decide what an exercise simulates on a device, and why: what `acus explain` prints.

    Args:
        exercise: the exercise.
        profile: its device.
        simulated: whether robot and hand are simulated too.

    Raises:
        SimulationError: for an unknown effect, model or parameter; names what is valid.
    """
    renders = frozenset(axis.value for axis in profile.renders)
    return compile_scene(
        scene_of(exercise, profile),
        DevicePort(profile.name, renders, simulated),
        _watching(exercise),
        metric_consumers(exercise),
    )


def _watching(exercise: Exercise) -> list[str | Consumer]:
    """List the views that show something, and the control scans: these show the target too."""
    views: list[str | Consumer] = [view.value for view in exercise.shown_views]
    if exercise.guidance_mode is GuidanceMode.CONTROL_CT:
        views.append(Consumer("control scans show it", VIEW_READS[View.TARGET_MOTION.value]))
    return views


def law_requests(exercise: Exercise) -> dict[str, dict[str, float]]:
    """Return the force laws of an exercise with their parameters, as `device.control.laws` takes
    them.
    """
    return {name: dict(part.parameters) for name, part in exercise.laws.items()}
