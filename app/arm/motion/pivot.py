"""Pivoting about the fulcrum: a tool in the arm's hand whose shaft passes the trocar.

As everywhere, the needle's frame has its origin at the tip and +z out of it along the shaft, d is
the direction from the handle to the tip, and tip = fulcrum + depth·d. Of a tip's velocity v the
part along d moves the gripped point alike; the part across turns the shaft about the fulcrum,

    ḋ = v⊥ / depth,    grip velocity = (v·d) d - (outside / depth) v⊥,

outside = what of the shaft is between fulcrum and grip: motion is inverted, and scaled by depth.
With the tip at the fulcrum the scale does not exist; through it a tool only slides, at a direction
that is given (`pose`, not `tip_pose`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.arm.mechanics import (
    ArmProfile,
    ArmSolution,
    arm_singularity,
    forward,
    jacobian,
    solve,
)
from app.arm.mechanics.kinematics import seven
from app.arm.motion.errors import FulcrumError
from app.arm.motion.path import Bends, JointPath
from app.core.arrays import FloatArray, angle_between, cross, frozen, unit
from app.core.messages import sentence
from app.core.rotation import rotation_exp, rotation_log
from app.core.transform import RigidTransform, rotation_between
from app.core.units import DEGREE, MILLIMETRE
from app.mechanisms.errors import MechanismError, NoGripError, SingularError

SHAFT_OFF: Final = 0.1 * MILLIMETRE
"""How far the shaft's line may pass from the fulcrum [m]."""

LEAST_DEPTH: Final = 1.0 * MILLIMETRE
"""Depth of the tip below which it does not aim the shaft [m]: `SHAFT_OFF` would be 0.1 rad."""

LEAST_DEXTERITY: Final = 1e-3
"""Of a posture from which rates of the joints are given (see `SingularDistance`)."""

ROLLS: Final = 12
"""Rolls of the tool that are tried where it may have any."""


@dataclass(frozen=True, slots=True, eq=False)
class HeldTool:
    """A tool with a straight shaft in the arm's hand.

    Attributes:
        length: whole, end of the handle to the tip [m].
        grip: gripped point to the tip [m]; the arm's tool frame has its origin there.
        axis_tool: direction of the shaft, handle to tip, in the arm's tool frame, shape (3,).

    Raises:
        NoGripError: if the gripped point is not on the tool.
    """

    length: float
    grip: float
    axis_tool: FloatArray

    def __post_init__(self) -> None:
        if not 0.0 < self.grip <= self.length < float("inf"):
            raise NoGripError(
                sentence(
                    "the tool of {length} m is gripped {grip} m from its tip; grip it on its"
                    " length",
                    length=self.length,
                    grip=self.grip,
                )
            )
        object.__setattr__(self, "axis_tool", frozen(unit(self.axis_tool, "axis_tool"), (3,)))

    @property
    def T_tool_needle(self) -> RigidTransform:
        """The tip's frame in the arm's tool frame."""
        turn = rotation_between([0.0, 0.0, 1.0], self.axis_tool)
        return RigidTransform(turn, self.grip * self.axis_tool)

    def wrist_pose(self, arm: ArmProfile, T_world_needle: RigidTransform) -> RigidTransform:
        """Return ⁰T₇ for a pose of the tip's frame in the world."""
        return arm.wrist_pose(T_world_needle @ self.T_tool_needle.inverse())

    def needle_pose(self, arm: ArmProfile, q: ArrayLike) -> RigidTransform:
        """Pose of the tip's frame in the world at joint angles q [rad], shape (7,)."""
        return arm.tool_pose(forward(arm, q)) @ self.T_tool_needle


@dataclass(frozen=True, slots=True, eq=False)
class PivotState:
    """Where a tool stands in the trocar.

    Attributes:
        axis_world: d, shape (3,).
        depth: of the tip beyond the foot of the fulcrum on the shaft's line [m]; negative outside.
        roll: about d, from the frame that the smallest turn brings from the trocar's axis [rad].
        off: distance of the shaft's line from the fulcrum [m].
    """

    axis_world: FloatArray
    depth: float
    roll: float
    off: float


@dataclass(frozen=True, slots=True, eq=False)
class PivotRates:
    """What the gripped point does for a motion of the tip.

    Attributes:
        velocity: of the gripped point in the world [m/s], shape (3,).
        turning: angular velocity of the tool in the world [rad/s], shape (3,).
        scale: velocity of the gripped point across the shaft over that of the tip: -outside/depth.
    """

    velocity: FloatArray
    turning: FloatArray
    scale: float


@dataclass(frozen=True, slots=True, eq=False)
class Pivot:
    """A trocar, and the arm with the tool that goes through it.

    Attributes:
        arm: the arm.
        tool: what it holds.
        p_world: the fulcrum, centre of the trocar [m], shape (3,).
        inward_world: unit vector of the trocar's axis into the body, shape (3,).
        tilt: largest angle between shaft and that axis [rad]; a flatter one grazes.
        clearance: least distance of the gripped point from the fulcrum [m].

    Raises:
        FulcrumError: if the tilt is not within (0°, 90°).
    """

    arm: ArmProfile
    tool: HeldTool
    p_world: FloatArray
    inward_world: FloatArray
    tilt: float = 60.0 * DEGREE
    clearance: float = 20.0 * MILLIMETRE

    def __post_init__(self) -> None:
        object.__setattr__(self, "p_world", frozen(self.p_world, (3,), "fulcrum"))
        inward = unit(self.inward_world, "inward_world")
        object.__setattr__(self, "inward_world", frozen(inward, (3,)))
        if not 0.0 < self.tilt < 0.5 * np.pi:
            raise FulcrumError(
                sentence(
                    "largest tilt of the shaft is {tilt_deg}°; it must be within (0°, 90°)",
                    tilt_deg=self.tilt / DEGREE,
                )
            )

    def aim(self, tip_world: ArrayLike) -> tuple[FloatArray, float]:
        """Direction and depth for a tip within the body [m], shape (3,).

        Raises:
            FulcrumError: if the tip is at the fulcrum, where it has no direction, or the shaft
                would be flatter than `tilt`.
            NoGripError: if the gripped point would be nearer to the fulcrum than `clearance`.
        """
        away = frozen(tip_world, (3,), "tip_world") - self.p_world
        depth = float(np.linalg.norm(away))
        if depth < LEAST_DEPTH:
            raise FulcrumError(
                sentence(
                    "the tip is {depth_mm:.3g} mm from the fulcrum: there it has no"
                    " direction, and its scale no value; from {least_depth_mm:g} mm on it"
                    " has, nearer the tool is slid along a given one",
                    depth_mm=depth / MILLIMETRE,
                    least_depth_mm=LEAST_DEPTH / MILLIMETRE,
                )
            )
        axis = away / depth
        self._allows(axis, depth)
        return axis, depth

    def _allows(self, axis: FloatArray, depth: float) -> None:
        tilt = angle_between(axis, self.inward_world)
        if tilt > self.tilt + 1e-12:
            raise FulcrumError(
                sentence(
                    "the shaft would lean {tilt_deg:.4g}° from the trocar's axis; it grazes"
                    " beyond {largest_tilt_deg:.4g}°",
                    tilt_deg=tilt / DEGREE,
                    largest_tilt_deg=self.tilt / DEGREE,
                )
            )
        outside = self.tool.grip - depth
        if outside < self.clearance:
            raise NoGripError(
                sentence(
                    "at a depth of {depth_mm:.4g} mm the grip would be"
                    " {outside_mm:.4g} mm from the fulcrum; at least"
                    " {clearance_mm:.4g} mm are needed: grip the tool further back",
                    depth_mm=depth / MILLIMETRE,
                    outside_mm=outside / MILLIMETRE,
                    clearance_mm=self.clearance / MILLIMETRE,
                )
            )

    def pose(self, axis_world: ArrayLike, depth: float, roll: float = 0.0) -> RigidTransform:
        """Pose of the tip's frame in the world with the shaft through the fulcrum.

        Args:
            axis_world: direction from handle to tip, shape (3,).
            depth: of the tip [m]; negative before it is in.
            roll: as in `PivotState` [rad].

        Raises:
            FulcrumError, NoGripError: as `aim`.
        """
        axis = unit(axis_world, "axis_world")
        self._allows(axis, depth)
        cosine, sine = np.cos(roll), np.sin(roll)
        turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        return RigidTransform(self._upright(axis) @ turn, self.p_world + depth * axis)

    def _upright(self, axis: FloatArray) -> FloatArray:
        from_axis = rotation_between([0.0, 0.0, 1.0], self.inward_world)
        return np.asarray(rotation_between(self.inward_world, axis) @ from_axis)

    def tip_pose(self, tip_world: ArrayLike, roll: float = 0.0) -> RigidTransform:
        """Pose of the tip's frame for a tip within the body [m], shape (3,).

        Raises:
            FulcrumError, NoGripError: as `aim`.
        """
        axis, depth = self.aim(tip_world)
        return self.pose(axis, depth, roll)

    def wrist_pose(self, T_world_needle: RigidTransform) -> RigidTransform:
        """Return ⁰T₇ for a pose of the tip's frame."""
        return self.tool.wrist_pose(self.arm, T_world_needle)

    def held(self, axis_world: ArrayLike, depth: float) -> ArmSolution:
        """Posture that holds the shaft in a direction, whatever the tool's roll.

        The one furthest from its joints' limits, of `ROLLS` rolls and all arm angles, whose
        dexterity is not below `LEAST_DEXTERITY`.

        Args:
            axis_world: direction from handle to tip, shape (3,).
            depth: of the tip [m].

        Raises:
            FulcrumError, NoGripError: as `aim`.
            MechanismError: if no roll can be held: what the last one met.
        """
        before = self.arm.T_world_base.inverse() @ self.pose(axis_world, depth)
        after = (self.arm.T_wrist_tool @ self.tool.T_tool_needle).inverse()
        best: ArmSolution | None = None
        troubles: list[MechanismError] = []
        for roll in np.linspace(0.0, 2.0 * np.pi, ROLLS, endpoint=False):
            turn = RigidTransform.from_rotation(rotation_exp([0.0, 0.0, roll]))
            try:
                found = solve(self.arm, before @ turn @ after)
            except MechanismError as error:
                troubles.append(error)
                continue
            if best is not None and found.margin <= best.margin:
                continue
            dexterity = arm_singularity(self.arm, found.q).dexterity
            if dexterity >= LEAST_DEXTERITY:
                best = found
            else:
                troubles.append(
                    SingularError(
                        sentence(
                            "the arm's dexterity is {dexterity:.2g} with the tool rolled by"
                            " {roll_deg:.0f}°; holding needs {least_dexterity:g}",
                            dexterity=dexterity,
                            roll_deg=roll / DEGREE,
                            least_dexterity=LEAST_DEXTERITY,
                        )
                    )
                )
        if best is None:
            raise troubles[-1]
        return best

    def tip_jacobian(self, q: ArrayLike) -> FloatArray:
        """Velocity of the tip in the world per rate of each joint [m/rad], shape (3, 7).

        Of the arm alone: nothing holds the shaft in the fulcrum.

        Raises:
            MechanismError: as `forward`.
        """
        at = (self.arm.T_wrist_tool @ self.tool.T_tool_needle).translation
        return np.asarray(self.arm.T_world_base.rotation @ jacobian(self.arm, q, at)[:3])

    def state(self, q: ArrayLike) -> PivotState:
        """Return where the tool stands at joint angles q [rad], shape (7,): the inverse of
        `pose`.
        """
        needle = self.tool.needle_pose(self.arm, q)
        axis = needle.rotation[:, 2]
        away = needle.translation - self.p_world
        depth = float(axis @ away)
        roll = rotation_log(self._upright(axis).T @ needle.rotation)[2]
        return PivotState(
            frozen(axis), depth, float(roll), float(np.linalg.norm(cross(axis, away)))
        )

    def rates(
        self, tip_world: ArrayLike, velocity: ArrayLike, roll_rate: float = 0.0
    ) -> PivotRates:
        """Velocities of the gripped point and the tool for one of the tip.

        Args:
            tip_world: the tip [m], shape (3,).
            velocity: of it [m/s], shape (3,).
            roll_rate: of the roll [rad/s].

        Raises:
            FulcrumError, NoGripError: as `aim`.
        """
        axis, depth = self.aim(tip_world)
        wanted = frozen(velocity, (3,), "velocity")
        along = float(axis @ wanted)
        across = wanted - along * axis
        turned = across / depth
        aside = cross(self.inward_world, axis)
        # the frame of the smallest turn itself rolls as the axis goes round
        carried = float(aside @ turned) / (1.0 + float(self.inward_world @ axis))
        scale = -(self.tool.grip - depth) / depth
        turning = cross(axis, turned) + (roll_rate - carried) * axis
        return PivotRates(frozen(along * axis + scale * across), frozen(turning), scale)

    def joint_rates(self, q: ArrayLike, velocity: ArrayLike, roll_rate: float = 0.0) -> FloatArray:
        """Smallest rates of the joints [rad/s], shape (7,), that move the tip at `velocity`.

        The shaft stays in the fulcrum. Arguments as of `rates`, at joint angles q [rad].

        Raises:
            FulcrumError, NoGripError: as `aim`.
            SingularError: if the dexterity of the posture is below `LEAST_DEXTERITY`.
        """
        angles = seven(q)
        seen = arm_singularity(self.arm, angles)
        if seen.dexterity < LEAST_DEXTERITY:
            names = ", ".join(arm_singularity(self.arm, angles, 0.02).kinds) or "aligned joints"
            raise SingularError(
                sentence(
                    "the arm's dexterity is {seen_dexterity:.2g} ({names}); rates need"
                    " {least_dexterity:g}: plan around it",
                    seen_dexterity=seen.dexterity,
                    names=names,
                    least_dexterity=LEAST_DEXTERITY,
                )
            )
        tip = self.tool.needle_pose(self.arm, angles).translation
        asked = self.rates(tip, velocity, roll_rate)
        back = self.arm.T_world_base.rotation.T
        by_joints = jacobian(self.arm, angles, self.arm.T_wrist_tool.translation)
        twist = np.concatenate([back @ asked.velocity, back @ asked.turning])
        return np.asarray(np.linalg.pinv(by_joints) @ twist)

    def off(self, path: JointPath) -> float:
        """Largest distance of the shaft's line from the fulcrum along a path, bounded [m].

        Holds between the places looked at as well (see `path`); never too small.
        """
        bends = Bends.of(self.arm, path)
        wrist_needle = self.arm.T_wrist_tool @ self.tool.T_tool_needle
        p_base = self.arm.T_world_base.inverse() @ self.p_world
        seen = np.einsum("nji,nj->ni", bends.rotation, p_base - bends.position)
        seen = (seen - wrist_needle.translation) @ wrist_needle.rotation
        aside = np.hypot(seen[:, 0], seen[:, 1])
        return float(bends.between(aside, bends.fixed_to_base(p_base)).max())
