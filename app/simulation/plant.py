"""The simulated robot and the hand that holds its needle, as one stage at the end of the tick.

How they move is `mechanisms.needle_motion`, with the machine's own stage; here is what a profile
does not say: the hand, the seal, the stops, and where all of it begins.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import unit
from app.core.messages import sentence
from app.core.parameters import Stage, packed
from app.mechanisms import hand_motion
from app.mechanisms.errors import MechanismError
from app.mechanisms.needle_motion import AT
from app.mechanisms.profile import DeviceProfile
from app.simulation.errors import SimulationError


@dataclass(frozen=True, slots=True)
class SimulatedHand:
    """The simulated hand: spring-dampers across and along the needle.

    Attributes:
        stiffness, damping: across the needle at the hub point [N/m, N·s/m] (300 and 3 are common
            for a relaxed grip).
        axial_stiffness, axial_damping: along the needle [N/m, N·s/m].
        strongest: largest spring force in either direction [N].
        speed, acceleration: of the hand across the needle, at the hub [m/s, m/s²].
        axial_speed, axial_acceleration: of the hand along the needle.
    """

    stiffness: float = 300.0
    damping: float = 3.0
    axial_stiffness: float = 2000.0
    axial_damping: float = 20.0
    strongest: float = 30.0
    speed: float = hand_motion.FASTEST
    acceleration: float = hand_motion.STRONGEST
    axial_speed: float = hand_motion.FASTEST_ALONG
    axial_acceleration: float = hand_motion.STRONGEST

    def __post_init__(self) -> None:
        for name in self.__slots__:
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise SimulationError(
                    sentence(
                        "hand {name} is {setting}; give a finite value of 0 or more",
                        name=name,
                        setting=getattr(self, name),
                    )
                )


@dataclass(frozen=True, slots=True)
class PlantSurroundings:
    """What the profile does not say about the rig. All values are estimates.

    Attributes:
        moving_mass: needle, hub and what of the grip slides along [kg].
        seal_friction, seal_viscous: silicone at the fulcrum along the needle [N, N·s/m].
        stop_stiffness, stop_damping: of the tilt stop, at the tool point [N/m, N·s/m].
    """

    moving_mass: float = 0.05
    seal_friction: float = 0.3
    seal_viscous: float = 1.0
    stop_stiffness: float = 20e3
    stop_damping: float = 250.0


def initial_plant(profile: DeviceProfile, axis: ArrayLike, depth: float) -> dict[str, float]:
    """Return starting values of the PLANT_* slots, by slot name in lower case, at rest.

    Args:
        profile: the device.
        axis: needle direction, hub to tip, in world, shape (3,).
        depth: of the tip beyond the fulcrum [m].

    Raises:
        SimulationError: if the needle does not point down, or the robot cannot reach the pose.
    """
    direction, machine = unit(axis, "axis"), profile.machine
    if direction[2] >= 0.0:
        raise SimulationError(
            sentence(
                "needle direction {direction} does not point down", direction=direction.tolist()
            )
        )
    try:
        left, right = machine.usable(direction).tolist()
    except MechanismError as error:
        raise SimulationError(
            sentence(
                "device {profile_name} cannot hold the needle along {direction}; "
                "its tilt limit is {profile_tilt_limit_deg:g} degrees",
                profile_name=profile.name,
                direction=direction.tolist(),
                profile_tilt_limit_deg=profile.tilt_limit_deg,
            )
        ) from error
    low, high = profile.depth_range
    return {
        "plant_q_left": left,
        "plant_q_right": right,
        "plant_qd_left": 0.0,
        "plant_qd_right": 0.0,
        "plant_depth": float(np.clip(depth, low, high)),
        "plant_depth_rate": 0.0,
    }


def plant_stage(
    profile: DeviceProfile,
    axis: ArrayLike = (0.0, 0.0, -1.0),
    depth: float = -0.015,
    hand: SimulatedHand | None = None,
    surroundings: PlantSurroundings | None = None,
) -> Stage:
    """Build the stage that moves the simulated robot; it belongs at the end of the tick.

    It reads TORQUE_*, AXIAL_FORCE and HAND_*, and writes GRIP_*, PLANT_*, PULL_* and PUSH. `axis`
    and `depth` are the starting pose (as in `initial_plant`).

    Raises:
        SimulationError: if the starting pose is out of reach.
    """
    hand, rig = hand or SimulatedHand(), surroundings or PlantSurroundings()
    start = initial_plant(profile, axis, depth)
    machine, fulcrum = profile.machine.stages(), profile.geometry.fulcrum
    radius = fulcrum[2] * np.tan(profile.tilt_limit)
    depth_min, depth_max = profile.depth_range
    own = packed(
        AT,
        length=profile.needle_length,
        radius=radius,
        stop_k=rig.stop_stiffness,
        stop_b=rig.stop_damping,
        depth_min=depth_min,
        depth_max=depth_max,
        mass=rig.moving_mass,
        seal=rig.seal_friction,
        seal_viscous=rig.seal_viscous,
        hand_k=hand.stiffness,
        hand_b=hand.damping,
        hand_axial_k=hand.axial_stiffness,
        hand_axial_b=hand.axial_damping,
        hand_most=hand.strongest,
        start_left=start["plant_q_left"],
        start_right=start["plant_q_right"],
        start_depth=start["plant_depth"],
        fx=fulcrum[0],
        fy=fulcrum[1],
        fz=fulcrum[2],
        coulomb=profile.friction.coulomb,
        viscous=profile.friction.viscous,
        gx=profile.mounting.gravity[0],
        gy=profile.mounting.gravity[1],
        gz=profile.mounting.gravity[2],
        needle_mass=profile.inertia.needle_mass,
        needle_offset=profile.inertia.needle_centre - profile.needle_length,
    )
    motion = packed(
        hand_motion.AT,
        speed=hand.speed,
        acceleration=hand.acceleration,
        axial_speed=hand.axial_speed,
        axial_acceleration=hand.axial_acceleration,
    )
    return Stage("plant", machine.plant, np.concatenate([own, motion, machine.plant_values]))
