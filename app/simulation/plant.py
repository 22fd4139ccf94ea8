"""The simulated robot and the hand that holds its needle, as one stage at the end of the tick.

Sideways, in the motor angles (mechanisms/pantograph/dynamics):

    M(q) q̈ + h(q, q̇) + g(q) + friction(q̇) = τ + Aᵀ F_hand + Jᵀ γ_stop,   A = G_perp J,

links, tool and needle, with the hand a spring-damper at the hub point, perpendicular to the needle,
towards where the hand is; it goes where it is wanted at a hand's speed (`hand_motion`). Along the
needle, one mass: hand spring-damper, the needle's weight and what its turning adds, the seal at the
fulcrum (Coulomb and viscous) and AXIAL_FORCE. Stops: a stiff spring-damper on the tool beyond the
tilt limit, an inelastic end of the depth range.

Springs, dampers and friction are integrated by linearly implicit Euler in substeps of at most half
a millisecond: stable for any stiffness and any step, and it takes energy, never adds any, where the
forces are passive. Coulomb friction of joints and seal is dry and solved exactly: it can hold.
Gravity and velocity terms are explicit. Motor torques are held over the tick, as a real amplifier
holds them, so the limits of a sampled controller show as they would on the device. A tissue force
that opposes the motion acts as the damper F / v: it can stop the needle but not turn it back.

What cannot be integrated (NaN in an input) is left out: a hand with NaN lets go, a torque or tissue
force with NaN is zero, a pose that the mechanism cannot have falls back to the starting pose.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import unit
from app.core.parameters import Stage, packed
from app.mechanisms.pantograph.kernels import inverse_kernel
from app.mechanisms.profile import DeviceProfile
from app.simulation import hand_motion
from app.simulation.errors import SimulationError
from app.simulation.plant_kernels import AT, step


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
                    f"hand {name} is {getattr(self, name)}; give a finite value of 0 or more"
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
    direction = unit(axis, "axis")
    fulcrum = profile.pantograph.fulcrum
    if direction[2] >= 0.0:
        raise SimulationError(f"needle direction {direction.tolist()} does not point down")
    x, y = (fulcrum - direction * fulcrum[2] / direction[2])[:2]
    status, left, right = inverse_kernel(x, y, *profile.pantograph.links, 1.0, -1.0)
    if status != 0:
        raise SimulationError(
            f"device {profile.name} cannot hold the needle along {direction.tolist()}; "
            f"its tilt limit is {profile.tilt_limit_deg:g} degrees"
        )
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
    geometry, fulcrum = profile.pantograph, profile.pantograph.fulcrum
    radius = fulcrum[2] * np.tan(profile.tilt_limit)
    depth_min, depth_max = profile.depth_range
    own = packed(
        AT,
        length=geometry.needle_length,
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
    )
    motion = packed(
        hand_motion.AT,
        speed=hand.speed,
        acceleration=hand.acceleration,
        axial_speed=hand.axial_speed,
        axial_acceleration=hand.axial_acceleration,
    )
    parameters = np.concatenate([profile.dynamic_model.values, own, motion])
    return Stage("plant", step, parameters)
