"""The arm in the table of machines: what it is asked there, and two tables of its own.

The fulcrum is the middle of the scene's skin, the shaft is gripped where three fingers meet on it,
which is the hub, and the trocar lets it lean by 60°. Nothing is in the way; forces are those of the
joints' torques. The base stands as in the scene; how its distance matters is a table.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Final

import numpy as np

from app.arm.hand import ToolShaft, approach
from app.arm.laparoscopy import TrocarRing
from app.arm.mechanics import (
    ArmSolution,
    arm_singularity,
    forward_kernel,
    jacobian,
    jacobian_kernel,
)
from app.arm.motion import FulcrumError, HeldTool, Pivot
from app.arm.scene import ArmScene
from app.core.arrays import FloatArray, cross, unit
from app.core.compiled import njit
from app.core.messages import sentence_of
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.mechanisms.errors import MechanismError, UnreachableError
from app.studies.findings import Cell, Sheet
from app.studies.machines import (
    DEPTH,
    L_OUT,
    TILTS_DEG,
    ComparedMachine,
    ComparedPlugin,
    across,
    ring,
)

STIFFEST: Final = 5000.0
"""Largest stiffness that the arm's own controller takes for its tool [N/m], as published."""

STANDS: Final = (0.45, 0.6, 0.8, 0.9)
"""Distances of the arm's base from the remote centre, on the floor [m]."""

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
            raise UnreachableError(sentence_of(error)) from error

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


@njit
def _arm_often(q: FloatArray, lengths: Any, at: Any, force: FloatArray, out: FloatArray) -> None:
    rotation, position, moved = np.empty((3, 3)), np.empty(3), np.empty((6, 7))
    for k in range(len(q)):
        forward_kernel(q[k], lengths, rotation, position)
        jacobian_kernel(q[k], lengths, at, moved)
        for j in range(7):
            out[k, j] = moved[0, j] * force[0] + moved[1, j] * force[1] + moved[2, j] * force[2]


def _arm() -> ComparedMachine:
    held = ArmInTrocar.standing(L_OUT, DEPTH)
    arm = held.pivot.arm
    found: dict[bytes, ArmSolution | MechanismError] = {}

    def posture(d: FloatArray) -> FloatArray:
        key = d.tobytes()  # all quantities of a direction ask for it, and it takes milliseconds
        if key not in found:
            try:
                found[key] = held.posture(d)
            except MechanismError as error:
                found[key] = error
        known = found[key]
        if isinstance(known, MechanismError):
            raise known
        return known.q

    def efforts(d: FloatArray, force: FloatArray) -> FloatArray:
        return np.asarray(held.hub_jacobian(posture(d)).T @ force)

    def most(d: FloatArray) -> float:
        q = posture(d)
        return held.sideways(q, held.hub_jacobian(q), across(d))[0]

    def stiffness(d: FloatArray) -> float:
        posture(d)
        return STIFFEST

    def tick() -> tuple[Callable[[], object], int]:
        poses = np.concatenate([ring(np.deg2rad(tilt)) for tilt in TILTS_DEG])
        q = np.tile([posture(d) for d in poses], (50, 1))
        at = tuple(arm.T_wrist_tool.translation.tolist())
        out, force = np.empty((len(q), 7)), np.array([1.0, -0.5, 0.2])
        return partial(_arm_often, q, arm.lengths, at, force, out), len(q)

    return ComparedMachine(
        "arm through a trocar (iiwa14)",
        "lengths, limits, torques, masses published; encoders assumed; trocar to 60°; nothing in"
        " the way; what the fingers hold by friction is far less",
        lambda d: held.turning(posture(d)),
        lambda d: held.pivot.tip_jacobian(posture(d)),
        float(np.sqrt(12.0) * arm.resolution),  # a step whose rounding spreads so
        efforts,
        "N·m",
        most,
        stiffness,
        "the arm's controller at its stiffest; how far its joints give way is not published",
        tick,
    )


def arm_stands(away: tuple[float, ...] = STANDS) -> Sheet:
    """Return what the arm holds by how far its base stands from the remote centre."""
    rows: list[tuple[Cell, ...]] = []
    scenes = ArmInTrocar.standing(L_OUT, DEPTH).away
    for distance in sorted((scenes, *away)):
        held = ArmInTrocar.standing(L_OUT, DEPTH, distance)
        least_margin, least_dexterity, reached = np.inf, np.inf, []
        for d in np.concatenate([ring(np.deg2rad(tilt)) for tilt in TILTS_DEG]):
            try:
                posture = held.posture(d)
            except MechanismError:
                reached.append(False)
                continue
            reached.append(True)
            least_margin = min(least_margin, posture.margin)
            dexterity = arm_singularity(held.pivot.arm, posture.q).dexterity
            least_dexterity = min(least_dexterity, dexterity)
        some = any(reached)
        rows.append(
            (
                f"{distance:.2f}" + (", the scene's" if distance == scenes else ""),
                100.0 * float(np.mean(reached)),
                float(np.rad2deg(least_margin)) if some else "-",
                float(least_dexterity) if some else "-",
            )
        )
    return Sheet(
        "stands",
        f"The arm by how far its base stands from the remote centre; tilts to {TILTS_DEG[-1]:g}°",
        ("distance on the floor [m]", "directions held [%]", "least margin [°]", "dexterity"),
        tuple(rows),
    )


def arm_by_tilt() -> Sheet:
    """Return what is asked of the arm alone: what it repeats, forces by its torque limits."""
    held = ArmInTrocar.standing(L_OUT, DEPTH)
    rows: list[tuple[Cell, ...]] = []
    for tilt_deg in TILTS_DEG:
        found = []
        for d in ring(np.deg2rad(tilt_deg)):
            q = held.posture(d).q
            hub, joint = held.sideways(q, held.hub_jacobian(q), across(d))
            tip, _ = held.sideways(q, held.pivot.tip_jacobian(q), across(d))
            weight = float((np.abs(held.weight(q)) / held.pivot.arm.torque).max())
            found.append((held.repeated(q), hub, tip, weight, joint))
        worst = min(found, key=lambda row: row[1])
        rows.append(
            (
                tilt_deg,
                max(row[0] for row in found) / MILLIMETRE,
                worst[1],
                worst[4] + 1,
                min(row[2] for row in found),
                100.0 * max(row[3] for row in found),
            )
        )
    return Sheet(
        "arm",
        "The arm through a trocar: repeatability as published, forces by published torques",
        (
            "tilt [°]",
            "repeatability at the tip [mm]",
            "force at the gripped point [N]",
            "ended by joint",
            "force at the tip [N]",
            "torque for its own weight [%]",
        ),
        tuple(rows),
    )


def _more() -> tuple[tuple[Sheet, ...], tuple[str, ...]]:
    stands, arm = arm_stands(), arm_by_tilt()
    line = (
        f"The arm, upright: its tip repeats to {float(arm.rows[0][1]):.2f} mm by the data sheet's"
        f" repeatability; {float(arm.rows[0][4]):.0f} N sideways at the tip, its own weight borne."
    )
    return (arm, stands), (line,)


COMPARISON: Final = ComparedPlugin("the arm", _arm, _more)
