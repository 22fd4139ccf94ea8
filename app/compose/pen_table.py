"""The loop's table where a pen stands in for the robot: angles from its direction, no force."""

from __future__ import annotations

from typing import Final

from app.compose.declared_views import declared_views
from app.compose.needle import UPRIGHT
from app.core.arrays import FloatArray
from app.core.parameters import Stage
from app.device.control import Table
from app.device.control.depth_interval import DepthInterval
from app.device.control.kinematics import Kinematics
from app.device.control.velocity import velocity_stage
from app.exercises.scene import compile_exercise
from app.exercises.schema import Exercise
from app.mechanisms.errors import MechanismError
from app.mechanisms.pantograph import inverse
from app.mechanisms.profile import DeviceProfile
from app.planning.placement import PlacedPlan
from app.simulation.plant import plant_stage
from app.simulation.trainee import trainee_stage

START_DEPTH: Final = -0.015
"""Where the needle of a simulated hand waits [m]."""


def without_force(profile: DeviceProfile) -> DeviceProfile:
    """Return the geometry of a device that pushes nobody."""
    return profile.model_copy(update={"loop": profile.loop.model_copy(update={"renders": ()})})


def joint_angles(profile: DeviceProfile, axis: FloatArray) -> FloatArray | None:
    """Joint angles [rad], shape (2,), of a robot whose needle points along `axis` (unit vector).

    None where no robot could: a needle that does not point down, or out of reach.
    """
    if not axis[2] < -0.1:
        return None
    fulcrum = profile.pantograph.fulcrum
    try:
        return inverse(profile.pantograph, (fulcrum - axis * fulcrum[2] / axis[2])[:2])
    except MechanismError:
        return None


def pen_table(
    exercise: Exercise,
    placed: PlacedPlan,
    profile: DeviceProfile,
    read: list[Stage],
    skill: str | None,
    seed: int,
    simulated: bool,
) -> Table:
    """Table of a tick without force.

    Args:
        exercise: whose effects are computed; its force laws are not.
        placed: the plan.
        profile: geometry that renders nothing.
        read: stages that give the joint angles; none in a replay, which is given them.
        skill: of the scripted trainee; None without one.
        seed: of the trainee.
        simulated: whether a simulated hand holds the pen.
    """
    placed_exercise = exercise.placed_as(placed.placement)
    effects = compile_exercise(placed_exercise, profile, declared_views(), simulated=False)
    plant = [plant_stage(profile, UPRIGHT, START_DEPTH)] if simulated else []
    trainee = (
        [trainee_stage(placed.axis, placed.length, skill, seed)] if simulated and skill else []
    )
    place = [DepthInterval.of(profile).stage(), Kinematics.of(profile).stage()]
    stages = [*trainee, *read, velocity_stage(profile), *place]
    return Table.of([*stages, *effects.stages()], plant)
