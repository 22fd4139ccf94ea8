"""From tray into trocar: what was thought, what was planned, and what became of it.

What the eyes say of tool and trocar is all that this knows of them; the truth only measures. The
ways are those of `arm.motion.pick_place`, planned in a scene as it is thought to be, and carried
out one posture per step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Final

import numpy as np

from app.arm.hand import HandFinger, ToolShaft, approach, close_hand
from app.arm.laparoscopy import TrocarRing
from app.arm.mechanics import ArmProfile, forward
from app.arm.motion.errors import FulcrumError
from app.arm.motion.pick_place import (
    ArmPhase,
    Hindrance,
    NotPlacedError,
    PhaseName,
    PickPlace,
    PickPlaceTask,
    can_place,
    pick_and_place,
)
from app.arm.motion.pivot import HeldTool, Pivot
from app.arm.motion.searching import Budget, Collisions
from app.arm.scene.layout import ArmScene
from app.arm.scene.mjcf import ARM_RADIUS
from app.arm.scene.running import RunningScene, SceneClearance
from app.core.arrays import FloatArray, angle_between, frozen, read_only, unit
from app.core.messages import sentence, sentence_of
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.mechanisms.errors import MechanismError
from app.simulation.errors import SimulationError

SLIP: Final = 1.0 * MILLIMETRE
"""Distance by which the tool may move in the hand on its way [m]."""

SLIP_TURN: Final = np.radians(3.0)
"""Angle by which it may turn there [rad]."""

PRESSED: Final = 2.0
"""Force with which the shaft may press the trocar's ring [N]: less than half of what slips."""

ROOM: Final = 0.8 * MILLIMETRE
"""Least gap between shaft and ring for which an insertion is begun [m]."""

_UP: Final = read_only(np.array([0.0, 0.0, 1.0]))
_MARGIN: Final = 0.002  # distance kept from everything [m]
_CAREFUL: Final = 0.2  # share of the joints' speeds with a tool in the hand
_TESTS: Final = 3000  # of a search
_REST: Final = 0.3  # after each phase, and before the hand closes [s]
_AT_THE_TROCAR: Final = (PhaseName.ALIGN, PhaseName.PIVOT, PhaseName.INSERT)


class CarryFailure(StrEnum):
    """Why the tool was not inserted."""

    NOT_SEEN = "not_seen"  # no tool or no trocar in the pictures, or no telling its tip
    UNREACHABLE = "unreachable"  # no posture within the limits for a pose on the way
    COLLIDES = "collides"  # something stands where arm, hand or tool must go
    NO_WAY = "no_way"  # the planner found none within its budget
    CANNOT_CLOSE = "cannot_close"  # the fingers do not meet on a tool there
    NOT_HELD = "not_held"  # the forces did not come
    SLIPPED = "slipped"  # it moved in the hand
    DROPPED = "dropped"  # no finger touches it any more
    TOUCHED = "touched"  # the shaft pressed the trocar's ring
    MISSED = "missed"  # it is not in the trocar


class CarryError(SimulationError):
    """The tool was not inserted; the message says why and what to do.

    Attributes:
        failure: the cause.
        could_stand_deg: turn of the arm's place about the vertical through the entry from which it
            could be [°]; None if none is known.
    """

    def __init__(
        self, failure: CarryFailure, message: str, could_stand_deg: float | None = None
    ) -> None:
        super().__init__(message)
        self.failure = failure
        self.could_stand_deg = could_stand_deg


@dataclass(frozen=True, slots=True, eq=False)
class SeenTool:
    """Where the tool is thought to lie.

    Attributes:
        p_grip: where it is to be taken, on its axis [m], shape (3,).
        axis_world: unit vector from the handle to the tip, shape (3,).
    """

    p_grip: FloatArray
    axis_world: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "p_grip", frozen(self.p_grip, (3,), "p_grip"))
        axis = frozen(unit(self.axis_world), (3,), "axis_world")
        object.__setattr__(self, "axis_world", axis)


@dataclass(frozen=True, slots=True, eq=False)
class Insertion:
    """All that is known and wanted of an insertion.

    Attributes:
        tool: where the tool is thought to lie.
        fulcrum: thought centre of the trocar [m], shape (3,).
        normal: thought direction out of the trocar, shape (3,).
        axis: wanted direction of the shaft, handle to tip, shape (3,).
        depth: wanted of the tip beyond the fulcrum [m].
    """

    tool: SeenTool
    fulcrum: FloatArray
    normal: FloatArray
    axis: FloatArray
    depth: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "fulcrum", frozen(self.fulcrum, (3,), "fulcrum"))
        for name in ("normal", "axis"):
            object.__setattr__(self, name, frozen(unit(getattr(self, name), name), (3,), name))
        if not 0.0 < self.depth < float("inf"):
            raise SimulationError(
                sentence("insertion: depth is {depth} m; give more than 0", depth=self.depth)
            )

    @classmethod
    def known(
        cls,
        scene: ArmScene,
        axis: FloatArray,
        depth: float,
        T_world_tool: RigidTransform | None = None,
    ) -> Insertion:
        """Return that of perfect eyes: the tool where it is, by default where it is laid."""
        lies = T_world_tool or scene.T_world_tool
        tool = SeenTool(lies @ [0.0, 0.0, scene.tool.grip], lies.rotate(_UP))
        return cls(tool, scene.trocar.p_world, scene.trocar.normal_world, axis, depth)


@dataclass(frozen=True, slots=True)
class CarryPhase:
    """One phase that is done.

    Attributes:
        name: one of `PhaseName`.
        time: of the simulation at its end [s].
        errors: name with unit -> value, measured against the truth.
    """

    name: str
    time: float
    errors: dict[str, float]


def plan(
    scene: ArmScene,
    wanted: Insertion,
    start: FloatArray | None = None,
    check: Callable[[], object] = lambda: None,
) -> PickPlace:
    """Plan an insertion in the scene as it is thought to be.

    Args:
        scene: what stands there; tool and trocar count where `wanted` says.
        wanted: the insertion.
        start: joint angles at the begin [rad], shape (7,); None: home.
        check: called with every test of a posture; what it raises ends the planning.

    Raises:
        CarryError: if the arm cannot; names the cause.
        SimulationError, PlannerMissingError: if a package is missing; names the extra.
    """
    q = scene.home if start is None else start
    pivot, task, empty, holding, inside = _job(scene, wanted, check)
    _has_room(scene, wanted)
    try:
        budget = Budget(seconds=60.0, tests=_TESTS)  # tests end it: the same on any computer
        return pick_and_place(pivot, task, q, empty, holding, budget, inside)
    except NotPlacedError as error:
        raise _in_words(error) from error
    except FulcrumError as error:
        raise CarryError(CarryFailure.UNREACHABLE, sentence_of(error)) from error


def could_carry(
    scene: ArmScene, axis: FloatArray, depth: float, check: Callable[[], object] = lambda: None
) -> bool:
    """Return whether the arm could insert the tool, by kinematics and collisions; no way is
    searched.

    Args:
        scene: what would stand there.
        axis: direction of the shaft, handle to tip, shape (3,).
        depth: of the tip [m].
        check: as of `plan`.
    """
    wanted = Insertion.known(scene, axis, depth)
    pivot, task, empty, holding, inside = _job(scene, wanted, check)
    try:
        _has_room(scene, wanted)
        return can_place(pivot, task, scene.home, empty, holding, inside)
    except (FulcrumError, CarryError):
        return False


def carry(
    running: RunningScene,
    wanted: Insertion,
    planned: PickPlace,
    force: float = 5.0,
) -> Iterator[CarryPhase]:
    """Fetch the tool and insert it, one phase per answer.

    Args:
        running: an open scene, the arm where the plan begins.
        wanted: the insertion.
        planned: its `plan`.
        force: of the grasp [N], as `RunningScene.grasp`.

    Raises:
        CarryError: names the cause.
    """
    held: RigidTransform | None = None
    begin = running.state.T_world_tool
    phases = {one.name: one for one in planned.phases}
    for name in PhaseName:
        if name in phases:
            _move(running, phases[name])
        running.stay(_REST)
        errors: dict[str, float] = {}
        if name is PhaseName.GRASP:
            errors = _grasp(running, wanted, force)
            running.stay(_REST)
            held = running.state.T_hand_tool
        state = running.state
        hand = running.scene.arm.tool_pose(forward(running.scene.arm, running.reference))
        errors["hand_mm"] = _millimetres(state.T_world_hand.translation - hand.translation)
        if name in _AT_THE_TROCAR:
            errors["ring_N"] = _pressed(running)
        if held is not None and name is not PhaseName.GRASP:
            errors |= _slipped(running, held)
        if name is PhaseName.LIFT:
            grip = [0.0, 0.0, running.scene.tool.grip]
            raised = state.T_world_tool @ grip - begin @ grip
            errors["height_mm"] = float(raised[2]) / MILLIMETRE
        if name in _AT_THE_TROCAR:
            errors |= _at_the_trocar(running, wanted, planned, name)
        yield CarryPhase(name.value, state.time, errors)


def _job(
    scene: ArmScene, wanted: Insertion, check: Callable[[], object]
) -> tuple[
    Pivot,
    PickPlaceTask,
    Collisions,
    Callable[[HeldTool], Collisions],
    Callable[[HeldTool], Collisions],
]:
    """Return what `pick_and_place` asks for: the task, and what is free as it is thought to be."""
    body, tool, hand = scene.tool, wanted.tool, scene.hand.hand
    lying = _lying(scene, tool)
    thought = replace(scene, trocar=_ring(scene, wanted))
    try:
        pose = approach(hand, ToolShaft(tool.p_grip, tool.axis_world, body.shaft_diameter), -_UP)
    except MechanismError as error:
        raise CarryError(CarryFailure.CANNOT_CLOSE, sentence_of(error)) from error
    height = float((pose.inverse() @ tool.p_grip)[2])
    # what the planner moves is where the hand has the shaft
    grip = RigidTransform.from_translation([0.0, 0.0, height])
    arm = replace(scene.arm, T_flange_tool=scene.arm.T_flange_tool @ grip)
    beyond = _beyond(scene, arm)

    def things(clearance: SceneClearance) -> Collisions:
        def free(q: FloatArray) -> bool:
            check()
            return clearance.free(q, _MARGIN)

        return Collisions(
            free,
            lambda q: clearance.distance(q) - _MARGIN,
            beyond,
            names=lambda q: clearance.blocked([q], _MARGIN),
        )

    def holding(held: HeldTool, in_trocar: bool = False) -> Collisions:
        shaft = ToolShaft(grip.translation, held.axis_tool, body.shaft_diameter)
        try:
            fingers = _closed_on(scene, shaft)
        except MechanismError as error:
            raise CarryError(CarryFailure.CANNOT_CLOSE, sentence_of(error)) from error
        in_hand = grip @ held.T_tool_needle @ RigidTransform.from_translation([0, 0, -body.length])
        return things(SceneClearance(thought, fingers, lying, in_hand, in_trocar))

    up = unit(_UP - tool.axis_world * float(_UP @ tool.axis_world))
    tip = RigidTransform.from_translation([0.0, 0.0, body.length])
    task = PickPlaceTask(lying @ tip, up, wanted.depth, wanted.axis, careful=_CAREFUL)
    held = HeldTool(body.length, body.length - body.grip, np.array([1.0, 0.0, 0.0]))
    pivot = Pivot(arm, held, wanted.fulcrum, -wanted.normal)
    empty = things(SceneClearance(thought, np.zeros(2 * len(HandFinger)), lying))
    return pivot, task, empty, holding, lambda one: holding(one, in_trocar=True)


def _beyond(scene: ArmScene, arm: ArmProfile) -> float:
    """Return how far anything beyond the flange reaches from it, and the links' thickness [m]."""
    hand, body = scene.hand.hand, scene.tool
    fingers = hand.half_base + hand.knuckle + hand.proximal + hand.distal
    along = max(body.grip, body.length - body.grip, fingers)
    return float(np.hypot(arm.T_flange_tool.translation[2], along)) + ARM_RADIUS


def _closed_on(scene: ArmScene, shaft: ToolShaft) -> FloatArray:
    """φ2, φ3 of the fingers one, two, three where they touch a shaft in the hand, shape (6,)."""
    joints: dict[HandFinger, FloatArray] = {}
    for touch in close_hand(scene.hand.hand, shaft).touches:
        joints.setdefault(touch.finger, touch.joints[1:])
    return np.array([joints[finger] for finger in HandFinger]).ravel()


def _ring(scene: ArmScene, wanted: Insertion) -> TrocarRing:
    """Return the trocar where it is thought to be."""
    return TrocarRing(wanted.fulcrum, wanted.normal, scene.trocar.inner, scene.trocar.outer)


def _has_room(scene: ArmScene, wanted: Insertion) -> None:
    """Raise if the shaft, as it is wanted, would hardly go through the ring."""
    gap = _ring(scene, wanted).room(wanted.axis, scene.tool.shaft_diameter)
    if gap < ROOM:
        lean = np.degrees(angle_between(wanted.axis, -wanted.normal))
        raise CarryError(
            CarryFailure.TOUCHED,
            sentence(
                "the path leans {lean:.0f}° from the trocar's axis, which leaves a gap of"
                " {gap_mm:.1f} mm round the shaft; {room_mm:g} mm are needed: lay"
                " the trocar for this path",
                lean=lean,
                gap_mm=gap / MILLIMETRE,
                room_mm=ROOM / MILLIMETRE,
            ),
        )


_WHY: Final = {
    Hindrance.REACH: CarryFailure.UNREACHABLE,
    Hindrance.TOUCH: CarryFailure.COLLIDES,
    Hindrance.WAY: CarryFailure.NO_WAY,
}
_DOING: Final = {
    PhaseName.APPROACH: "come to the tool",
    PhaseName.GRASP: "come down on the tool",
    PhaseName.LIFT: "lift the tool",
    PhaseName.TRANSFER: "bring the tool to the entry",
    PhaseName.ALIGN: "set the tool upright over the entry",
    PhaseName.PIVOT: "turn the tool into the path's direction",
    PhaseName.INSERT: "insert the tool along the path",
}


def _in_words(error: NotPlacedError) -> CarryError:
    return CarryError(
        _WHY[error.hindrance],
        sentence(
            "the arm cannot {doing}: {error}; let it stand elsewhere round the entry"
            " or choose another path",
            doing=_DOING[error.phase],
            error=error.why,
        ),
    )


def _move(running: RunningScene, phase: ArmPhase) -> None:
    """Carry out the motions of a phase, one posture per step."""
    step = running.scene.step
    for motion in phase.motions:
        count = max(int(np.ceil(motion.duration / step)), 1)
        running.follow(motion.at(np.minimum(step * np.arange(1, count + 1), motion.duration))[0])


def _grasp(running: RunningScene, wanted: Insertion, force: float) -> dict[str, float]:
    """Close the hand on the tool where it is thought to lie."""
    scene, tool = running.scene, wanted.tool
    truth = Insertion.known(scene, wanted.axis, wanted.depth, running.state.T_world_tool).tool
    touched = _millimetres(truth.p_grip - _on(truth, tool))
    hand = scene.arm.tool_pose(forward(scene.arm, running.reference))
    shaft = ToolShaft(tool.p_grip, tool.axis_world, scene.tool.shaft_diameter)
    try:
        running.grasp(shaft.seen_from(hand.inverse()), force)
    except MechanismError as error:
        raise CarryError(CarryFailure.CANNOT_CLOSE, sentence_of(error)) from error
    except SimulationError as error:
        raise CarryError(CarryFailure.NOT_HELD, sentence_of(error)) from error
    state = running.state
    # The fingers put it between their tips: so it is thought to lie in the hand.
    thought = hand.inverse() @ _lying(scene, tool)
    return {
        "tool_touched_mm": touched,
        "force_N": float(state.forces[2]) - force,
        **_apart(state.T_hand_tool, thought, scene.tool.grip),
    }


def _at_the_trocar(
    running: RunningScene, wanted: Insertion, planned: PickPlace, name: PhaseName
) -> dict[str, float]:
    """Measure the tool against the true trocar and what was wanted.

    Raises:
        CarryError: if the shaft is not in the ring where it should be.
    """
    scene, place = running.scene, running.state.T_world_tool
    ring, axis = scene.trocar, place.rotate(_UP)
    away = place @ [0.0, 0.0, scene.tool.length] - ring.p_world
    depth = float(away @ axis)
    aside = float(np.linalg.norm(away - depth * axis))
    upright = name is PhaseName.ALIGN
    direction = planned.pivot.inward_world if upright else wanted.axis
    deep = wanted.depth if name is PhaseName.INSERT else -planned.task.before
    errors = {
        "axis_from_fulcrum_mm": aside / MILLIMETRE,
        "tip_mm": _millimetres(away - deep * direction),
        "depth_mm": (depth - deep) / MILLIMETRE,
        "axis_deg": float(np.degrees(angle_between(axis, direction))),
    }
    if name is PhaseName.INSERT and (aside > ring.inner or depth < 0.5 * wanted.depth):
        raise CarryError(
            CarryFailure.MISSED,
            sentence(
                "the tool is not in the trocar: its axis passes {aside_mm:.1f} mm from the"
                " ring's centre, its tip is {depth_mm:.0f} mm beyond it; look again, and"
                " grasp the tool anew",
                aside_mm=aside / MILLIMETRE,
                depth_mm=depth / MILLIMETRE,
            ),
        )
    return errors


def _pressed(running: RunningScene) -> float:
    """Largest force of the ring on the shaft since this was last asked [N].

    Raises:
        CarryError: if it is more than allowed.
    """
    pressed = running.pressed()
    if pressed > PRESSED:
        raise CarryError(
            CarryFailure.TOUCHED,
            sentence(
                "the shaft pressed the trocar's ring with {pressed:.1f} N; up to {allowed:g} N "
                "are allowed: look again, or lay the trocar for this path",
                pressed=pressed,
                allowed=PRESSED,
            ),
        )
    return pressed


def _lying(scene: ArmScene, tool: SeenTool) -> RigidTransform:
    """T_world_tool of a tool as seen, turned about its axis in any way: it is round."""
    z = tool.axis_world
    x = unit(np.cross(z, np.eye(3)[int(np.argmin(np.abs(z)))]))
    rotation = np.column_stack([x, np.cross(z, x), z])
    return RigidTransform(rotation, tool.p_grip - scene.tool.grip * z)


def _apart(first: RigidTransform, second: RigidTransform, grip: float) -> dict[str, float]:
    """Return how far two poses of the tool are apart at its grip, and by their axes."""
    at = first @ [0.0, 0.0, grip] - second @ [0.0, 0.0, grip]
    turn = angle_between(first.rotation[:, 2], second.rotation[:, 2])
    return {"in_hand_mm": _millimetres(at), "in_hand_deg": float(np.degrees(turn))}


def _slipped(running: RunningScene, held: RigidTransform) -> dict[str, float]:
    """Return how far the tool has moved in the hand since it was taken.

    Raises:
        CarryError: if that is too much, or it is lost.
    """
    state = running.state
    if not state.forces.any():
        raise CarryError(
            CarryFailure.DROPPED,
            sentence("the tool has fallen: no finger touches it; grasp more firmly"),
        )
    now, grip = state.T_hand_tool, running.scene.tool.grip
    moved = float(np.linalg.norm((now @ [0.0, 0.0, grip]) - (held @ [0.0, 0.0, grip])))
    turned = angle_between(now.rotation[:, 2], held.rotation[:, 2])
    if moved > SLIP or turned > SLIP_TURN:
        raise CarryError(
            CarryFailure.SLIPPED,
            sentence(
                "the tool moved by {moved_mm:.2g} mm and {turned_deg:.2g}° in the"
                " hand; up to {slip_mm:g} mm and {slip_turn_deg:g}° are allowed:"
                " grasp more firmly",
                moved_mm=moved / MILLIMETRE,
                turned_deg=np.degrees(turned),
                slip_mm=SLIP / MILLIMETRE,
                slip_turn_deg=np.degrees(SLIP_TURN),
            ),
        )
    return {"slip_mm": moved / MILLIMETRE, "slip_deg": float(np.degrees(turned))}


def _on(truth: SeenTool, tool: SeenTool) -> FloatArray:
    """Point of the seen axis nearest to the true grip [m], shape (3,)."""
    along = (truth.p_grip - tool.p_grip) @ tool.axis_world
    return np.asarray(tool.p_grip + along * tool.axis_world)


def _millimetres(vector: FloatArray) -> float:
    return float(np.linalg.norm(vector)) / MILLIMETRE
