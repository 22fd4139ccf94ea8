"""The scene in MuJoCo, opened: stepped, driven, looked at, and asked whether a posture is free.

The arm is driven by computed torque: its joints follow postures, one per step, with gravity and the
weight of a held tool compensated. Each finger has one motor, which cannot be driven back; its two
joints stand against it on springs, by the gears of `arm.hand.driven`, breakaway included.
The force law is that of `arm.hand.firm`, its force the sum of the finger's contacts.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.arm.hand import (
    FingerTouch,
    FirmGrasp,
    HandFinger,
    Lever,
    SoftContact,
    ToolShaft,
    close_hand,
    driven,
)
from app.arm.hand.firm import moved_kernel
from app.arm.scene.layout import ArmScene
from app.arm.scene.mjcf import finger_joint, write_scene
from app.core.arrays import FloatArray, frozen, read_only
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.simulation.errors import SimulationError
from app.simulation.mjcf import import_mujoco

JOINTS: Final = 7
_SETTLE: Final = 0.6  # time in which the tool comes to rest on the rails [s]
_QUICK: Final = 40.0  # natural frequency of the arm's control [rad/s]; critically damped
_BEFORE: Final = 0.004  # gap at which a finger changes from its top speed to the force law [m]
_SHARES: Final = read_only(np.array([0.5, 0.5, 1.0]))
"""Of the grasp's force, for the fingers one, two, three."""

_NEAR: Final = 0.1  # share of the goal within which a force has come
_STAYS: Final = 0.1  # time for which it must stay [s]
_PATIENCE: Final = 8.0  # longest time of a grasp [s]
_FARTHEST: Final = 1.0  # beyond it no distance is told apart [m]


@dataclass(frozen=True, slots=True, eq=False)
class ArmSceneState:
    """The scene at one moment.

    Attributes:
        time: since it was opened [s].
        q, speed: joints of the arm [rad], [rad/s], shape (7,).
        fingers: φ2 and φ3 of the fingers one, two, three [rad], shape (3, 2).
        forces: normal force of each finger on the tool [N], shape (3,).
        let_go: whether joint 2 of each finger has let go of its motor.
        T_world_hand: the hand's frame.
        T_world_tool: the tool's, its origin at the handle's end, z to the tip.
        touching: names of what touches, pair by pair.
    """

    time: float
    q: FloatArray
    speed: FloatArray
    fingers: FloatArray
    forces: FloatArray
    let_go: tuple[bool, bool, bool]
    T_world_hand: RigidTransform
    T_world_tool: RigidTransform
    touching: tuple[tuple[str, str], ...]

    @property
    def T_hand_tool(self) -> RigidTransform:
        """Tool in the hand."""
        return self.T_world_hand.inverse() @ self.T_world_tool


@dataclass(slots=True)
class _Motor:
    """One finger's motor: angle [rad], speed [rad/s], where joint 2 let go, where it shall be."""

    angle: float = 0.0
    speed: float = 0.0
    broken_at: float | None = None
    target: float = 0.0


class RunningScene:
    """A scene in MuJoCo. `open()` it, or use it in a `with`.

    Args:
        scene: what stands there.
        watch: called with the state at the begin and each `every` while it runs; what it raises
            ends the run.
        every: of the simulation [s].
    """

    def __init__(
        self,
        scene: ArmScene,
        watch: Callable[[ArmSceneState], object] | None = None,
        every: float = 0.02,
    ) -> None:
        self.scene = scene
        self._watch, self._every, self._due = watch, every, np.inf
        self._pressed = 0.0
        self._mujoco: Any = None
        self._model: Any = None
        self._data: Any = None
        self._renderer: Any = None
        self._motors = {finger: _Motor() for finger in HandFinger}
        self._law: FirmGrasp | None = None
        self._forces = np.zeros(3)
        self._holding = False
        self._busy = 0.0

    def open(self) -> None:
        """Make the model, stand the arm at its home and let the tool come to rest.

        Raises:
            SimulationError: if MuJoCo is not installed or refuses the model.
        """
        self.close()
        self._mujoco, self._model, self._data = _opened(self.scene)
        model = self._model
        self._arm = _addresses(model, [f"joint_{k + 1}" for k in range(JOINTS)])
        self._arm_dofs = np.array([int(model.joint(k).dofadr[0]) for k in self._arm_names])
        names = [finger_joint(finger, k) for finger in HandFinger for k in (2, 3)]
        self._fingers = _addresses(model, names)
        self._mass = np.zeros((model.nv, model.nv))
        self._finger_of = np.full(model.ngeom, -1)
        for k, finger in enumerate(HandFinger):
            for joint in (2, 3):
                self._finger_of[model.geom(finger_joint(finger, joint)).id] = k
        self._tool_geoms = model.geom_bodyid == model.body("tool").id
        tool = model.joint("tool")
        self._tool_place = slice(int(tool.qposadr[0]), int(tool.qposadr[0]) + 3)
        self._tool_dofs = slice(int(tool.dofadr[0]), int(tool.dofadr[0]) + 3)
        self._ring_geoms = np.array([_named(model, k) == "trocar" for k in range(model.ngeom)])
        self._motors = {finger: _Motor() for finger in HandFinger}
        self._law, self._holding = None, False
        self._data.qpos[self._arm] = self.scene.home
        self._busy, self._pressed, self._due = 0.0, 0.0, np.inf
        self.stay(_SETTLE)
        self._data.time, self._busy = 0.0, 0.0
        if self._watch is not None:
            self._watch(self.state)
            self._due = self._every

    def close(self) -> None:
        """Let go of the model and of the renderer."""
        if self._renderer is not None:
            self._renderer.close()
        self._renderer = self._model = self._data = None

    def __enter__(self) -> RunningScene:
        self.open()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def busy(self) -> float:
        """Processor's time that its steps took so far [s]."""
        return self._busy

    @property
    def state(self) -> ArmSceneState:
        """Return what is so now.

        Raises:
            SimulationError: if the scene is not open.
        """
        data = self._of()
        forces, touching = self._contacts()
        return ArmSceneState(
            float(data.time),
            frozen(data.qpos[self._arm]),
            frozen(data.qvel[self._arm_dofs]),
            frozen(data.qpos[self._fingers].reshape(3, 2)),
            read_only(forces),
            tuple(motor.broken_at is not None for motor in self._motors.values()),  # type: ignore[arg-type]
            _site(data, "hand"),
            _body(data, "tool"),
            touching,
        )

    def follow(self, postures: ArrayLike) -> None:
        """Drive the arm through postures [rad], shape (n, 7), one per step of the scene.

        Raises:
            SimulationError: if the scene is not open, or a posture is beyond the joint limits.
        """
        self._of()
        path = np.asarray(postures, dtype=np.float64).reshape(-1, JOINTS)
        beyond = self.scene.arm.beyond(path)
        if beyond.max(initial=0.0) > 1e-9:
            k = int(np.argmax(beyond.max(axis=0)))
            raise SimulationError(
                sentence(
                    "the path takes joint {k} {beyond_max_deg:.3g}° beyond its limits",
                    k=k + 1,
                    beyond_max_deg=np.degrees(beyond[:, k].max()),
                )
            )
        step = self.scene.step
        before = np.vstack([path[:1], path[:-1]])
        after = np.vstack([path[1:], path[-1:]])
        speeds = (after - before) / (2.0 * step)
        turns = (after - 2.0 * path + before) / step**2
        for q, speed, turn in zip(path, speeds, turns, strict=True):
            self._step(q, speed, turn)

    def stay(self, duration: float) -> None:
        """Let time pass [s]; the arm holds its posture."""
        q, zero = self.reference.copy(), np.zeros(JOINTS)
        for _ in range(round(duration / self.scene.step)):
            self._step(q, zero, zero)

    @property
    def reference(self) -> FloatArray:
        """Posture that the arm was last told to have [rad], shape (7,)."""
        return self._told if self._data.time > 0.0 else np.array(self._data.qpos[self._arm])

    def grasp(self, tool_hand: ToolShaft, force: float = 5.0) -> tuple[FingerTouch, ...]:
        """Close the hand on a tool that is thought to lie so in the hand's frame.

        Finger three presses with `force` [N], the two on the other side with half of it each. They
        come at their top speed to 4 mm before where they are expected to touch, then by the law,
        all motors alike, so that the tool comes to the hand's middle: its force is the mean of what
        the fingers have, each as a share of its goal. Then the motors stand; their worms hold.

        Returns:
            Where the fingers were expected to touch.

        Raises:
            GraspError: if the hand cannot close on a tool there; says which finger and why.
            SimulationError: if the forces do not come; names them.
        """
        hand = self.scene.hand
        touches = close_hand(hand.hand, tool_hand).touches
        first: dict[HandFinger, FingerTouch] = {}
        for touch in touches:
            first.setdefault(touch.finger, touch)
        laws = {finger: self._law_of(touch, 0.5 * force) for finger, touch in first.items()}
        for finger, motor in self._motors.items():
            gap = _BEFORE / laws[finger].lever.free
            motor.target = float(first[finger].joints[1]) * hand.drive.proximal_gear - gap
        while any(abs(m.target - m.angle) > 0.5 for m in self._motors.values()):
            self.stay(0.02)
        self._forces = np.zeros(3)
        self._law = min(laws.values(), key=lambda law: law.used_gain)
        begin, since = float(self._data.time), None
        while since is None or self._data.time - since < _STAYS:
            self.stay(self.scene.step)
            forces, _ = self._contacts()
            come = forces.all() and abs(self._felt(forces) / self._law.goal - 1.0) < _NEAR
            since = (since or float(self._data.time)) if come else None
            if self._data.time - begin > _PATIENCE:
                have = ", ".join(
                    f"{finger.name.lower()} {one:.2f} of {share * force:.2f} N"
                    for finger, one, share in zip(HandFinger, forces, _SHARES, strict=True)
                )
                raise SimulationError(
                    sentence(
                        "the hand does not hold the tool after {patience:g} s: {have}",
                        patience=_PATIENCE,
                        have=have,
                    )
                )
        self._law = None
        for motor in self._motors.values():
            motor.target = motor.angle
        self._holding = True
        return touches

    def release(self) -> None:
        """Open the hand."""
        self._holding = False
        for motor in self._motors.values():
            motor.target = 0.0
        while any(motor.angle > 0.5 for motor in self._motors.values()):
            self.stay(0.02)

    @property
    def holding(self) -> bool:
        """Return whether the hand has closed on the tool and was not opened since."""
        return self._holding

    def pressed(self) -> float:
        """Largest force of the trocar's ring on the held tool since this was last asked [N]."""
        most, self._pressed = self._pressed, 0.0
        return most

    def clearance(
        self,
        T_world_tool: RigidTransform | None = None,
        T_hand_tool: RigidTransform | None = None,
    ) -> SceneClearance:
        """Return the test for planners, with the fingers as they are now.

        Args:
            T_world_tool: where the tool is thought to lie, an obstacle; None: where it is.
            T_hand_tool: how the hand is thought to hold it, with which it then moves.
        """
        data = self._of()
        lying = T_world_tool or _body(data, "tool")
        return SceneClearance(self.scene, np.array(data.qpos[self._fingers]), lying, T_hand_tool)

    def picture(
        self, size: tuple[int, int] = (960, 720), looks_at: ArrayLike = (0.0, 0.2, 0.15)
    ) -> NDArray[np.uint8]:
        """Picture of the scene for people, blue, green, red, shape (height, width, 3).

        Drawn by MuJoCo off the screen; no picture of it goes through the eyes.

        Raises:
            SimulationError: if it cannot draw on this computer.
        """
        data, mujoco = self._of(), self._mujoco
        try:
            if self._renderer is None:
                _drawing(mujoco)
                self._renderer = mujoco.Renderer(self._model, size[1], size[0])
            camera = mujoco.MjvCamera()
            camera.lookat[:] = np.asarray(looks_at)
            camera.distance, camera.azimuth, camera.elevation = 1.9, 125.0, -25.0
            mujoco.mj_forward(self._model, data)
            self._renderer.update_scene(data, camera)
            return np.ascontiguousarray(self._renderer.render()[:, :, ::-1])
        except Exception as error:  # what a missing driver raises differs from one to another
            raise SimulationError(
                sentence(
                    "MuJoCo cannot draw without a display here ({error}); install EGL (libegl1), "
                    "or set MUJOCO_GL=osmesa",
                    error=error,
                )
            ) from error

    def _of(self) -> Any:
        if self._data is None:
            raise SimulationError(sentence("the scene of the arm is not open; call open() first"))
        return self._data

    @property
    def _arm_names(self) -> list[str]:
        return [f"joint_{k + 1}" for k in range(JOINTS)]

    def _law_of(self, touch: FingerTouch, goal: float) -> FirmGrasp:
        """Return the force law of a finger about to touch: as stiff as its own springs are."""
        profile = self.scene.hand
        hand, drive = profile.hand, profile.drive
        T_finger_hand = touch.finger.placed(hand).inverse()
        lever = Lever.of(
            hand, touch.joints, T_finger_hand.rotate(touch.normal), T_finger_hand @ touch.point
        )
        by3 = lever.alone * drive.distal_gear
        # In series: both joints give way, and what they press, and the fingers beyond, only more.
        contact = SoftContact(self.scene.finger_stiffness / (lever.arm**2 + by3**2))
        return FirmGrasp(goal, lever, contact, drive.lag, self.scene.step, drive.top_speed)

    def _felt(self, forces: FloatArray) -> float:
        """Force by which the law goes [N]: that of one of the two fingers, if all share alike."""
        return float((0.5 * forces / _SHARES).mean())

    def _step(self, q: FloatArray, speed: FloatArray, turn: FloatArray) -> None:
        """One step towards a posture, its speed and its acceleration."""
        begin = time.thread_time()
        mujoco, model, data = self._mujoco, self._model, self._data
        mujoco.mj_step1(model, data)
        dofs = self._arm_dofs
        wanted = (
            turn + 2.0 * _QUICK * (speed - data.qvel[dofs]) + _QUICK**2 * (q - data.qpos[self._arm])
        )
        mujoco.mj_fullM(model, data, self._mass)
        torque = self._mass[np.ix_(dofs, dofs)] @ wanted + data.qfrc_bias[dofs]
        if self._holding:
            torque += self._weight()[dofs]
        data.qfrc_applied[dofs] = torque
        self._drive()
        before = data.qvel[self._tool_dofs].copy()
        mujoco.mj_step2(model, data)
        if self._holding:
            # Contacts hold the tool to the hand as both stood when the step began; the hand goes on
            # round its joints, the tool straight ahead: out of each curve by a dt²/2 a step.
            data.qpos[self._tool_place] += (
                0.5 * self.scene.step * (data.qvel[self._tool_dofs] - before)
            )
        if self._law is not None:
            self._forces = self._contacts()[0]  # of this step: the next one makes contacts anew
        if self._holding:
            self._pressed = max(self._pressed, self._ring_force())
        self._told = q
        self._busy += time.thread_time() - begin
        if self._watch is not None and data.time >= self._due - 0.5 * self.scene.step:
            self._due += self._every
            self._watch(self.state)

    def _ring_force(self) -> float:
        """Sum of the normal forces of the trocar's ring on the tool [N]."""
        data = self._data
        geoms = data.contact.geom[: data.ncon]
        if not len(geoms) or not (rings := self._ring_geoms[geoms].any(axis=1)).any():
            return 0.0
        wrench, total = np.zeros(6), 0.0
        for k in np.flatnonzero(rings & self._tool_geoms[geoms].any(axis=1)).tolist():
            self._mujoco.mj_contactForce(self._model, data, k, wrench)
            total += float(wrench[0])
        return total

    def _weight(self) -> FloatArray:
        """Joint torques that carry the held tool, shape (nv,)."""
        model, data = self._model, self._data
        by_point = np.zeros((3, model.nv))
        tool = model.body("tool").id
        self._mujoco.mj_jac(
            model, data, by_point, None, data.xipos[tool], int(model.body("hand").id)
        )
        return np.asarray(-self.scene.tool.mass * model.opt.gravity @ by_point)

    def _drive(self) -> None:
        """Move the motors by a period and set the fingers' springs."""
        profile, step = self.scene.hand, self.scene.step
        drive, hand = profile.drive, profile.hand
        law, top = self._law, drive.top_speed
        most = hand.most_proximal * drive.proximal_gear
        common = 0.0
        if law is not None:
            common = law.used_gain * (law.goal - self._felt(self._forces))
        for k, motor in enumerate(self._motors.values()):
            back = (motor.target - motor.angle) / (4.0 * drive.lag)
            command = min(max(back if law is None else common, -top), top)
            motor.angle, motor.speed = moved_kernel(
                motor.angle, motor.speed, command, drive.lag, step
            )
            motor.angle = min(max(motor.angle, 0.0), most)
            if motor.broken_at is None:
                if law is not None and self._data.actuator_force[2 * k] >= drive.breakaway:
                    motor.broken_at = motor.angle
            elif motor.angle <= motor.broken_at:
                motor.broken_at = None  # opened so far, the joint is taken along again
            self._data.ctrl[2 * k : 2 * k + 2] = driven(hand, motor.angle, motor.broken_at)

    def _contacts(self) -> tuple[FloatArray, tuple[tuple[str, str], ...]]:
        """Return the fingers' normal forces on the tool [N], shape (3,), and what touches."""
        model, data = self._model, self._data
        forces, wrench = np.zeros(3), np.zeros(6)
        names = set()
        for k, (first, second) in enumerate(data.contact.geom[: data.ncon].tolist()):
            finger, other = self._finger_of[first], second
            if finger < 0:
                finger, other = self._finger_of[second], first
            if finger >= 0 and self._tool_geoms[other]:
                self._mujoco.mj_contactForce(model, data, k, wrench)
                forces[finger] += wrench[0]
            names.add((_named(model, first), _named(model, second)))
        return forces, tuple(sorted(names))


class SceneClearance:
    """Whether the arm, its hand and what it holds are clear of everything, for planners.

    It has data of its own: asking moves nothing in the running scene. Joint limits count.

    Args:
        scene: what stands there.
        fingers: φ2, φ3 of the fingers one, two, three [rad], shape (6,).
        T_world_tool: where the tool lies.
        T_hand_tool: where the hand holds it, which then moves with it; None if it does not.
        in_trocar: whether the held tool is on its way through the trocar, so that its distance
            from ring and skin does not count (`TrocarRing.room` is what it has there).
    """

    def __init__(
        self,
        scene: ArmScene,
        fingers: FloatArray,
        T_world_tool: RigidTransform,
        T_hand_tool: RigidTransform | None = None,
        in_trocar: bool = False,
    ) -> None:
        self.scene = scene
        self._in_trocar = in_trocar
        self._mujoco, self._model, self._data = _opened(scene)
        model = self._model
        self._arm = _addresses(model, [f"joint_{k + 1}" for k in range(JOINTS)])
        names = [finger_joint(finger, k) for finger in HandFinger for k in (2, 3)]
        self._data.qpos[_addresses(model, names)] = fingers
        self._held = T_hand_tool
        self._lay(T_world_tool)
        self._pairs = np.array(list(self._may_touch()))
        self._bounds = model.geom_rbound[self._pairs].sum(axis=1)

    def free(self, q: ArrayLike, margin: float = 0.0) -> bool:
        """Return whether a posture [rad], shape (7,), is within limits and clear by more than a
        margin.
        """
        angles = np.asarray(q, dtype=np.float64)
        return self.scene.arm.allows(angles) and self._nearest(angles, margin)[0] > margin

    def distance(self, q: ArrayLike) -> float:
        """Least distance of two things that must not touch [m]; negative where they overlap."""
        return self._nearest(np.asarray(q, dtype=np.float64), _FARTHEST)[0]

    def nearest(self, q: ArrayLike) -> tuple[float, str, str]:
        """Return the least distance [m], and between what."""
        distance, pair = self._nearest(np.asarray(q, dtype=np.float64), _FARTHEST)
        first, second = (_named(self._model, geom) for geom in self._pairs[pair].tolist())
        return distance, first, second

    def blocked(self, postures: Iterable[ArrayLike], margin: float = 0.0) -> str | None:
        """Say what the first posture of a path that is not free touches; None if all are free."""
        for q in postures:
            if not self.free(q, margin):
                if not self.scene.arm.allows(np.asarray(q)):
                    return "a joint's limit"
                _, first, second = self.nearest(q)
                return f"{first} comes to {second}"
        return None

    def _nearest(self, q: FloatArray, most: float) -> tuple[float, int]:
        mujoco, model, data = self._mujoco, self._model, self._data
        data.qpos[self._arm] = q
        mujoco.mj_kinematics(model, data)
        if self._held is not None:
            self._lay(_site(data, "hand") @ self._held)
            mujoco.mj_kinematics(model, data)
        apart = data.geom_xpos[self._pairs[:, 0]] - data.geom_xpos[self._pairs[:, 1]]
        least = np.sqrt(np.einsum("ij,ij->i", apart, apart)) - self._bounds
        best, which = _FARTHEST if most >= _FARTHEST else np.inf, 0
        for k in np.argsort(least).tolist():
            if least[k] > min(best, most):
                break
            first, second = self._pairs[k].tolist()
            distance = mujoco.mj_geomDistance(model, data, first, second, most + 0.01, None)
            if distance < best:
                best, which = distance, k
        return float(best), which

    def _may_touch(self) -> Iterable[tuple[int, int]]:
        """Yield pairs of shapes that must stay apart."""
        model = self._model
        ours, theirs = model.geom_contype, model.geom_conaffinity
        body, parent, weld = model.geom_bodyid, model.body_parentid, model.body_weldid
        excluded = {(s >> 16, s & 0xFFFF) for s in model.exclude_signature.tolist()}
        tool, hand = model.body("tool").id, model.body("hand").id
        for i in range(model.ngeom):
            for j in range(i + 1, model.ngeom):
                a, b = sorted((int(body[i]), int(body[j])))
                if not (ours[i] & theirs[j] or ours[j] & theirs[i]) or weld[a] == weld[b]:
                    continue
                if (a and weld[parent[weld[b]]] == weld[a]) or (a, b) in excluded:
                    continue
                if hand <= a:
                    continue  # the hand's own
                if tool in (a, b):
                    other = b if a == tool else a
                    if self._held is None and other == 0:
                        continue  # it lies where it lies
                    if self._held is not None and other >= hand:
                        continue  # the hand holds it
                    thing = _named(model, i if int(body[i]) == other else j)
                    if self._in_trocar and thing in ("trocar", "skin"):
                        continue
                yield i, j

    def _lay(self, T_world_tool: RigidTransform) -> None:
        start = int(self._model.joint("tool").qposadr[0])
        quaternion = np.empty(4)
        self._mujoco.mju_mat2Quat(quaternion, T_world_tool.rotation.ravel())
        self._data.qpos[start : start + 3] = T_world_tool.translation
        self._data.qpos[start + 3 : start + 7] = quaternion


def _drawing(mujoco: Any) -> None:
    """Refuse to draw where MuJoCo was loaded for a display that is not there."""
    window = mujoco.GLContext.__module__ == "mujoco.glfw"
    if window and sys.platform == "linux" and not os.environ.get("DISPLAY"):
        raise SimulationError(sentence("it was loaded for a display, and there is none"))


def _opened(scene: ArmScene) -> tuple[Any, Any, Any]:
    """Return mujoco, the model, and data of it."""
    mujoco = import_mujoco("arm")
    try:
        model = mujoco.MjModel.from_xml_string(write_scene(scene))
    except ValueError as error:
        raise SimulationError(
            sentence("MuJoCo refuses the scene of the arm: {error}", error=error)
        ) from error
    return mujoco, model, mujoco.MjData(model)


def _addresses(model: Any, joints: list[str]) -> NDArray[np.intp]:
    return np.array([int(model.joint(name).qposadr[0]) for name in joints])


def _site(data: Any, name: str) -> RigidTransform:
    site = data.site(name)
    return RigidTransform(site.xmat.reshape(3, 3), site.xpos)


def _body(data: Any, name: str) -> RigidTransform:
    body = data.body(name)
    return RigidTransform(body.xmat.reshape(3, 3), body.xpos)


def _named(model: Any, geom: int) -> str:
    """Name of a shape without the number of its piece."""
    return str(model.geom(geom).name).split(":")[0]
