"""The arm of the scene holding its tool through a trocar: what the table of machines asks of it.

The fulcrum is the middle of the scene's skin, the shaft is gripped where three fingers meet on it,
the trocar lets it lean by 60°. Nothing is in the way; forces are those of the joints' torques.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, cross, unit
from app.core.transform import RigidTransform
from app.mechanisms.arm import ArmSolution, jacobian
from app.mechanisms.errors import UnreachableError
from app.mechanisms.hand import ToolShaft, approach
from app.mechanisms.laparoscopy import TrocarRing
from app.planning.arm.pivot import HeldTool, Pivot
from app.planning.errors import FulcrumError
from app.simulation.arm.scene import ArmScene

_GRAVITY: Final = (0.0, 0.0, -9.80665)


@dataclass(frozen=True, slots=True, eq=False)
class ArmInTrocar:
    """The arm of the scene, its tool through a trocar in the middle of the skin.

    Attributes:
        scene: what stands where.
        pivot: arm, tool and trocar; the tool's frame has its origin at the gripped point.
        depth: of the tip [m].
    """

    scene: ArmScene
    pivot: Pivot
    depth: float

    @classmethod
    def standing(cls, out: float, depth: float, away: float | None = None) -> ArmInTrocar:
        """Make it.

        Args:
            out: from the remote centre to the gripped point [m].
            depth: of the tip [m].
            away: distance of the base from the remote centre, on the floor [m]; None for the
                scene's, where the arm stands behind the middle of the table.
        """
        centre = np.array([0.16, 0.0, 0.002])
        scene = ArmScene(
            trocar=TrocarRing(centre, np.array([0.0, 0.0, 1.0])),
            T_world_tool=RigidTransform.identity(),
        )
        shaft = ToolShaft(np.zeros(3), np.array([1.0, 0.0, 0.0]), scene.tool.shaft_diameter)
        in_hand = approach(scene.hand.hand, shaft, (0.0, 0.0, -1.0)).inverse().translation
        base = scene.arm.T_world_base
        if away is not None:
            foot = np.array([*centre[:2], base.translation[2]])
            base = RigidTransform(
                base.rotation, foot + away * unit(base.translation - foot, "standing")
            )
        arm = replace(
            scene.arm,
            T_world_base=base,
            T_flange_tool=scene.arm.T_flange_tool @ RigidTransform.from_translation(in_hand),
        )
        tool = HeldTool(scene.tool.length, out + depth, np.array([1.0, 0.0, 0.0]))
        return cls(scene, Pivot(arm, tool, centre, np.array([0.0, 0.0, -1.0])), depth)

    @property
    def away(self) -> float:
        """Distance of the base from the remote centre, on the floor [m]."""
        apart = self.pivot.arm.T_world_base.translation - self.pivot.p_world
        return float(np.hypot(apart[0], apart[1]))

    def posture(self, d: FloatArray) -> ArmSolution:
        """Posture that holds the shaft in a direction d, shape (3,) (see `Pivot.held`).

        Raises:
            MechanismError: if there is none.
        """
        try:
            return self.pivot.held(d, self.depth)
        except FulcrumError as error:
            raise UnreachableError(str(error)) from error

    def turning(self, q: FloatArray) -> FloatArray:
        """Return dd/dq, shape (3, 7), of motions that keep the shaft in the fulcrum."""
        axis = self.pivot.state(q).axis_world
        first = unit(cross(axis, np.array((0.8, 0.6, 0.0))))
        ways = np.stack([first, cross(axis, first)])
        rates = [self.pivot.joint_rates(q, self.depth * way) for way in ways]
        return np.asarray(ways.T @ np.linalg.pinv(np.stack(rates, axis=1)))

    def hub_jacobian(self, q: FloatArray) -> FloatArray:
        """Velocity of the gripped point in the world per rate of each joint, shape (3, 7)."""
        arm = self.pivot.arm
        moved = jacobian(arm, q, arm.T_wrist_tool.translation)
        return np.asarray(arm.T_world_base.rotation @ moved[:3])

    def weight(self, q: FloatArray) -> FloatArray:
        """Torques that hold up arm, hand and tool [N·m], shape (7,)."""
        arm, scene = self.pivot.arm, self.scene
        carried = scene.hand_mass + scene.tool.mass
        # the hand's own centre is not published: all of it counts at the gripped point
        return scene.published.weight_torques(
            q,
            arm.T_world_base.rotation.T @ _GRAVITY,
            carried,
            arm.T_flange_tool.translation,
        )

    def sideways(self, q: FloatArray, by_joints: FloatArray, ways: FloatArray) -> tuple[float, int]:
        """Largest force that a point can give in all of some directions [N].

        The torque limits bear the arm's weight as well; τ = Jᵀ f.

        Args:
            q: joint angles [rad], shape (7,).
            by_joints: velocity of the point per rate of each joint [m/rad], shape (3, 7).
            ways: unit vectors, as those across the shaft, shape (n, 3).

        Returns:
            The force in its worst direction, and which joint, from 0, ends it.
        """
        each = ways @ by_joints
        room = self.pivot.arm.torque - np.sign(each) * self.weight(q)
        with np.errstate(divide="ignore"):
            force = room / np.abs(each)
        return float(force.min()), int(force.min(axis=0).argmin())

    def repeated(self, q: FloatArray) -> float:
        """Repeatability of the tip [m]: that of the flange, carried there through the Jacobian.

        All joints count as equally uncertain, by as much as the flange's place then is.
        """
        arm = self.pivot.arm
        flange = jacobian(arm, q, (0.0, 0.0, arm.flange))[:3]
        share = np.linalg.norm(self.pivot.tip_jacobian(q)) / np.linalg.norm(flange)
        return float(arm.repeatability * share)
