"""What the arm did in its scene, moment by moment, and as a needle over the training bench sees it.

A performance is made once, in MuJoCo, faster than real time; whoever shows it needs neither MuJoCo
nor a planner: it is looked up by its time, forwards, backwards or standing still.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.arm.scene.carrying import CarryFailure, CarryPhase
from app.arm.scene.layout import ArmScene
from app.core.arrays import FloatArray, angle_between, frozen, unit
from app.core.messages import sentence
from app.core.rotation import rotation_exp, rotation_log
from app.core.transform import RigidTransform
from app.simulation.errors import SimulationError


@dataclass(frozen=True, slots=True, eq=False)
class ArmMoment:
    """Arm, hand and tool at one time.

    Attributes:
        q: joints of the arm [rad], shape (7,).
        fingers: φ2 and φ3 of the fingers one, two, three [rad], shape (3, 2).
        T_scene_tool: the tool, its origin at the handle's end, z to the tip.
        held: whether the hand has it.
        phase: name of the phase.
    """

    q: FloatArray
    fingers: FloatArray
    T_scene_tool: RigidTransform
    held: bool
    phase: str


@dataclass(frozen=True, slots=True, eq=False)
class ArmTimeline:
    """Arm, hand and tool over n moments, in the world of their scene.

    Attributes:
        time: since the begin [s], rising, shape (n,), n > 1.
        q: joints of the arm [rad], shape (n, 7).
        fingers: as of `ArmMoment`, shape (n, 3, 2).
        p_tool: end of the tool's handle [m], shape (n, 3).
        R_tool: its rotation, z to the tip, shape (n, 3, 3).
        held: whether the hand has it, shape (n,).
        phase: index into `names`, shape (n,), never falling.
        names: the phases in their order.

    Raises:
        SimulationError: if shapes do not fit, a number is not finite, or time does not rise.
    """

    time: FloatArray
    q: FloatArray
    fingers: FloatArray
    p_tool: FloatArray
    R_tool: FloatArray
    held: NDArray[np.bool_]
    phase: NDArray[np.intp]
    names: tuple[str, ...]

    def __post_init__(self) -> None:
        count = len(self.time)
        shapes = {"time": (), "q": (7,), "fingers": (3, 2), "p_tool": (3,), "R_tool": (3, 3)}
        for name, shape in shapes.items():
            values = np.array(getattr(self, name), dtype=np.float64)
            if values.shape != (count, *shape) or not np.isfinite(values).all():
                raise SimulationError(
                    sentence(
                        "timeline of the arm: {name} has shape {values_shape} or is not finite;"
                        " {count} finite numbers are needed",
                        name=name,
                        values_shape=values.shape,
                        count=(count, *shape),
                    )
                )
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        if count < 2 or not (np.diff(self.time) > 0.0).all():
            raise SimulationError(
                sentence("timeline of the arm: its time must rise, over two moments or more")
            )
        phase = np.asarray(self.phase)
        if phase.shape != (count,) or np.asarray(self.held).shape != (count,):
            raise SimulationError(
                sentence("timeline of the arm: phase and held need one entry a moment")
            )
        if not (0 <= phase.min() and phase.max() < len(self.names) and (np.diff(phase) >= 0).all()):
            raise SimulationError(
                sentence(
                    "timeline of the arm: phases must go through {names} in order",
                    names=", ".join(self.names),
                )
            )

    @property
    def duration(self) -> float:
        """Time of the last moment [s]."""
        return float(self.time[-1])

    def begin(self, name: str) -> float:
        """Time at which a phase begins [s].

        Raises:
            SimulationError: if there is no such phase; names those that there are.
        """
        rows = np.flatnonzero(self.phase == (self.names.index(name) if name in self.names else -1))
        if not len(rows):
            there = ", ".join(self.names[k] for k in np.unique(self.phase))
            raise SimulationError(
                sentence("the arm has no phase {name!r}; there are {there}", name=name, there=there)
            )
        return float(self.time[rows[0]])

    def at(self, t: float) -> ArmMoment:
        """Return the moment at a time [s]; the first or last one beyond the ends."""
        after = int(np.clip(np.searchsorted(self.time, t), 1, len(self.time) - 1))
        before = after - 1
        span = self.time[after] - self.time[before]
        share = float(np.clip((t - self.time[before]) / span, 0.0, 1.0))
        row = after if share == 1.0 else before

        def between(values: FloatArray) -> FloatArray:
            return frozen(values[before] + share * (values[after] - values[before]))

        turn = rotation_log(self.R_tool[before].T @ self.R_tool[after])
        rotation = self.R_tool[before] @ rotation_exp(share * turn)
        return ArmMoment(
            between(self.q),
            between(self.fingers),
            RigidTransform(rotation, between(self.p_tool)),
            bool(self.held[row]),
            self.names[self.phase[row]],
        )


@dataclass(frozen=True, slots=True, eq=False)
class ArmPerformance:
    """The arm carrying out a plan over the training bench.

    Attributes:
        scene: what stood there; its trocar's centre is the entry.
        timeline: what happened.
        T_scene_world: the bench's world, in which the plan is placed, in the scene's.
        looked: errors of what the pictures said, name with unit -> value.
        phases: what was done, with its errors.
        seed: of the scene and of the pictures' noise.
    """

    scene: ArmScene
    timeline: ArmTimeline
    T_scene_world: RigidTransform
    looked: Mapping[str, float]
    phases: tuple[CarryPhase, ...]
    seed: int

    def needle(self, t: float) -> tuple[FloatArray, float]:
        """Direction of the shaft in the bench's world, handle to tip, and the tip's depth [m].

        The depth is that beyond the entry along the shaft, negative outside. Only in the phases in
        which the shaft stands over the entry does it pass through it; before, the depth is that of
        the point of the axis that is nearest to the entry.
        """
        place = self.timeline.at(t).T_scene_tool
        axis = place.rotate([0.0, 0.0, 1.0])
        tip = place @ [0.0, 0.0, self.scene.tool.length]
        depth = float((tip - self.scene.trocar.p_world) @ axis)
        return frozen(unit(self.T_scene_world.inverse().rotate(axis))), depth


@dataclass(frozen=True, slots=True, eq=False)
class ArmTrial:
    """What a trial came to.

    Attributes:
        seed: of the scene and of the pictures' noise.
        axis: wanted direction of the shaft, handle to tip, shape (3,).
        depth: wanted of the tip [m].
        looked: errors of what the pictures say.
        phases: those that were done.
        failure: the cause why not all were; None if the tool is inserted.
        message: the same in words.
        simulated: how long it took, in the simulation [s].
        planning, physics: processor's time of planner and simulation [s].
    """

    seed: int
    axis: FloatArray
    depth: float
    looked: Mapping[str, float]
    phases: tuple[CarryPhase, ...]
    failure: CarryFailure | None
    message: str
    simulated: float
    planning: float
    physics: float

    @property
    def real_time(self) -> float:
        """Simulated seconds per second of computing; 0 before the first step."""
        return self.simulated / self.physics if self.physics > 0.0 else 0.0

    @property
    def tilt(self) -> float:
        """Angle between what is wanted and straight down [rad]."""
        return angle_between(self.axis, [0.0, 0.0, -1.0])
