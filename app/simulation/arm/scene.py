"""What stands before the arm: table, tray with a tool, trocar on a fake skin, hand; in simulation.

The description is plain numbers and needs no MuJoCo: `mjcf` writes the model from it, `running`
opens it. The world is that of the cameras: the table's middle below the origin, z up, the skin's
surface at z = 0. The arm stands at the far edge of the table and works towards the cameras, so that
nothing of it is before them while it stands aside.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, angle_between, cross, frozen, read_only, unit
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.core.units import DEGREE
from app.mechanisms.arm import ArmProfile, PublishedArm, load_arm, published_arm
from app.mechanisms.hand import HandProfile, load_hand
from app.simulation.errors import SimulationError

Corner = tuple[float, float, float]

LEAN: Final = 15.0 * DEGREE
"""How far a shaft may lean in its trocar before the ring is laid aslant for it [rad]."""

RING_HALF: Final = 0.001
"""Half the ring's height [m]."""

FLATTEST: Final = 60.0 * DEGREE
"""Largest angle of a path from straight down [rad]: a flatter one grazes the skin."""

_UP: Final = read_only(np.array([0.0, 0.0, 1.0]))
_AROUND: Final = 0.004  # least gap between a shaft and the hole it goes through in a box [m]

_TABLE: Final = -0.02  # height of the table's surface
_TRAY: Final = -0.012
_RAIL: Final = 0.018  # height of the tray's rails; below them the fingers close
_RAILS: Final = (-0.27, -0.13)
"""Where the rails cross x; between them the hand takes the tool."""


@dataclass(frozen=True, slots=True)
class SceneBox:
    """An axis-aligned box of the world that nothing moves.

    Attributes:
        name: in messages.
        low, high: corners [m].
        colour: blue, green, red, 0 to 255.
        hole: half the width of a square hole through it, below the trocar [m]; 0 for none.
    """

    name: str
    low: Corner
    high: Corner
    colour: tuple[float, float, float]
    hole: float = 0.0


SURROUNDINGS: Final = (
    SceneBox("table", (-0.6, -0.5, -0.04), (0.6, 0.5, _TABLE), (150.0, 152.0, 156.0), hole=0.06),
    SceneBox("stand", (-0.12, 0.56, -0.60), (0.12, 0.80, 0.0), (120.0, 122.0, 126.0)),
    SceneBox("tray", (-0.34, -0.22, _TABLE), (-0.06, 0.22, _TRAY), (176.0, 178.0, 182.0)),
    *(
        SceneBox(
            f"{side} rail",
            (x - 0.005, -0.11, _TRAY),
            (x + 0.005, 0.11, _RAIL),
            (120.0, 122.0, 126.0),
        )
        for side, x in zip(("left", "right"), _RAILS, strict=True)
    ),
    SceneBox("skin", (0.02, -0.16, -0.004), (0.30, 0.16, 0.0), (168.0, 186.0, 214.0), hole=0.012),
    *(
        SceneBox("skin's frame", low, high, (168.0, 186.0, 214.0))
        for low, high in (
            ((0.02, -0.16, _TABLE), (0.03, 0.16, -0.004)),
            ((0.29, -0.16, _TABLE), (0.30, 0.16, -0.004)),
            ((0.03, -0.16, _TABLE), (0.29, -0.15, -0.004)),
            ((0.03, 0.15, _TABLE), (0.29, 0.16, -0.004)),
        )
    ),
)
"""Table, the arm's stand, tray with two rails, and a skin over a hollow body."""


CLEAR_OF_SKIN: Final = 0.070
"""From the trocar to where the hand has the tool, at the least [m]."""

_HALF_A_HAND: Final = 0.050


@dataclass(frozen=True, slots=True)
class ToolBody:
    """The tool: a handle, a shaft that tapers to the tip; its axis z from the handle's end to it.

    Attributes:
        length: from the handle's end to the tip [m].
        shaft_diameter, point_length: of the shaft, and over which it tapers [m].
        handle_length, handle_diameter: of the handle [m].
        mass: [kg], spread over its volume.
    """

    length: float = 0.240
    shaft_diameter: float = 0.010
    point_length: float = 0.010
    handle_length: float = 0.070
    handle_diameter: float = 0.018
    mass: float = 0.12

    @property
    def grip(self) -> float:
        """Where it is taken, from the handle's end [m]: on the shaft, a hand's half from it."""
        return self.handle_length + _HALF_A_HAND

    def reaching(self, depth: float) -> ToolBody:
        """Return it with a shaft long enough that the hand stays clear of the skin.

        Args:
            depth: of the tip in the body [m]; up to 50 mm it is long enough as it is.
        """
        length = max(self.length, self.grip + depth + CLEAR_OF_SKIN)
        return replace(self, length=length, mass=self.mass * self._volume(length) / self._volume())

    def _volume(self, length: float | None = None) -> float:
        """Of handle and shaft, over π / 4 [m³]."""
        shaft = (length or self.length) - self.point_length - self.handle_length
        return self.handle_diameter**2 * self.handle_length + self.shaft_diameter**2 * shaft


@dataclass(frozen=True, slots=True, eq=False)
class TrocarRing:
    """A ring on the skin round the hole that the tool goes through.

    Attributes:
        p_world: centre, the fulcrum [m], shape (3,).
        normal_world: unit vector out of the body, shape (3,).
        inner, outer: radii of the hole and of the ring [m].
    """

    p_world: FloatArray
    normal_world: FloatArray
    inner: float = 0.007
    outer: float = 0.016

    def __post_init__(self) -> None:
        object.__setattr__(self, "p_world", frozen(self.p_world, (3,), "trocar"))
        object.__setattr__(self, "normal_world", frozen(unit(self.normal_world), (3,), "normal"))

    @classmethod
    def guiding(cls, p_world: FloatArray, axis_world: FloatArray) -> TrocarRing:
        """Return a ring for a path: flat, or leaning by what the path leans beyond `LEAN`.

        Args:
            p_world: centre [m], shape (3,).
            axis_world: direction of the path into the body, shape (3,).
        """
        out = -unit(axis_world)
        angle = angle_between(out, _UP)
        about = cross(_UP, out)
        if angle <= LEAN or not about.any():
            return cls(p_world, _UP)
        return cls(p_world, rotation_exp((angle - LEAN) * unit(about)) @ _UP)

    def room(self, axis_world: FloatArray, diameter: float) -> float:
        """Gap all round between the hole and a shaft through its centre [m]; negative for none.

        Aslant by t the shaft is an ellipse in the ring's plane, r / cos t long, which at either
        face of the ring is h tan t further.

        Args:
            axis_world: direction of the shaft, shape (3,).
            diameter: of the shaft [m].
        """
        cosine = abs(float(unit(axis_world) @ self.normal_world))
        if cosine < 1e-9:
            return -float("inf")
        tangent = float(np.sqrt(max(1.0 - cosine**2, 0.0))) / cosine
        return self.inner - 0.5 * diameter / cosine - RING_HALF * tangent


def _standing() -> ArmProfile:
    """Return the arm at the far edge of the table; what it holds is the hand."""
    return replace(
        load_arm(),
        T_world_base=RigidTransform(
            rotation_exp(np.array([0.0, 0.0, -0.5 * np.pi])), np.array([0.0, 0.68, 0.0])
        ),
        T_flange_tool=RigidTransform.from_translation([0.0, 0.0, HAND_HEIGHT]),
    )


HAND_HEIGHT: Final = 0.110
"""Flange to the hand's frame, at the height of its joints 2 [m]: an estimate of base and palm."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ArmScene:
    """The whole scene, frozen. `running.RunningScene(scene)` opens it.

    Attributes:
        arm: where it stands, its lengths and limits; its tool's frame is the hand's.
        published: masses and inertias of its links.
        hand: the hand.
        tool: the tool.
        trocar: the ring.
        T_world_tool: where the tool is laid; it settles on the rails when the scene is opened.
        boxes: all that stands still.
        home: posture in which the arm stands aside [rad], shape (7,).
        hand_mass: of hand and fingers [kg].
        finger_stiffness: of a finger's joint against its motor [N·m/rad], an estimate: worm and
            cable give way, the motor does not.
        friction: of the fingers on the tool.
        step: of the simulation, and the period of the hand's law [s]. Friction has no memory: a
            tool that is carried quickly drifts in the hand, the less the shorter the step.

    Raises:
        SimulationError: if a number is not positive, the arm does not allow its home, or the
            trocar is not on the skin.
    """

    arm: ArmProfile = field(default_factory=_standing)
    published: PublishedArm = field(default_factory=published_arm)
    hand: HandProfile = field(default_factory=load_hand)
    tool: ToolBody = field(default_factory=ToolBody)
    trocar: TrocarRing
    T_world_tool: RigidTransform
    boxes: tuple[SceneBox, ...] = SURROUNDINGS
    home: FloatArray = field(
        default_factory=lambda: frozen(np.radians([0.0, -20.0, 0.0, -110.0, 0.0, 90.0, 0.0]))
    )
    hand_mass: float = 0.98
    finger_stiffness: float = 60.0
    friction: float = 0.8
    step: float = 0.001

    def __post_init__(self) -> None:
        for name in ("hand_mass", "finger_stiffness", "friction", "step"):
            if not 0.0 < (value := getattr(self, name)) < float("inf"):
                raise SimulationError(f"scene of the arm: {name} is {value}; give more than 0")
        if not self.arm.allows(self.home):
            raise SimulationError(
                f"scene of the arm: home {np.degrees(self.home).round(1).tolist()}° is beyond the"
                f" joint limits ±{np.degrees(self.arm.upper).round(1).tolist()}°"
            )
        x, y, _ = self.trocar.p_world
        on = [box for box in self.boxes if box.name == "skin"]
        if not all(
            box.low[0] + self.trocar.outer < x < box.high[0] - self.trocar.outer
            and box.low[1] + self.trocar.outer < y < box.high[1] - self.trocar.outer
            for box in on
        ):
            raise SimulationError(
                f"scene of the arm: the trocar at ({1e3 * x:.0f}, {1e3 * y:.0f}) mm does not lie"
                f" on the skin, {on[0].low[:2]} to {on[0].high[:2]} m"
            )

    @classmethod
    def seeded(
        cls, seed: int, tool: ToolBody | None = None, axis_world: FloatArray | None = None
    ) -> ArmScene:
        """Return a scene with tool and trocar somewhere: the same for a seed everywhere.

        The tool lies across both rails, up to 15° askew, its tip to either side; the trocar is
        within 30 mm of the skin's middle.

        Args:
            seed: of where they are.
            tool: what is to be inserted; None for the default.
            axis_world: direction in which it will be, shape (3,), for which the ring is laid and
                the holes below it are wide enough; None: straight down.
        """
        rng = np.random.default_rng(seed)
        body = tool or ToolBody()
        middle = np.array([np.mean(_RAILS) + rng.uniform(-0.01, 0.01), rng.uniform(-0.06, 0.06)])
        heading = rng.uniform(-15.0, 15.0) * DEGREE + np.pi * float(rng.integers(2))
        axis = np.array([np.cos(heading), np.sin(heading)])
        # Handle and shaft are not as thick: it lies aslant, touching both rails.
        thick, thin = 0.5 * body.handle_diameter, 0.5 * body.shaft_diameter
        slope = (thick - thin) / (_RAILS[1] - _RAILS[0])
        direction = unit([*axis, -slope])
        clear = 0.001
        centre = np.array([*middle, _RAIL + 0.5 * (thick + thin) + clear])
        across = unit(np.cross(direction, [0.0, 0.0, 1.0]))
        rotation = np.column_stack([across, np.cross(direction, across), direction])
        trocar = np.array([0.16, 0.0, 0.002])
        trocar[:2] += rng.uniform(-0.03, 0.03, 2)
        path = -_UP if axis_world is None else unit(axis_world)
        return cls(
            tool=body,
            trocar=TrocarRing.guiding(trocar, path),
            T_world_tool=RigidTransform(rotation, centre - body.grip * direction),
            boxes=tuple(_open_for(box, trocar, path, thin) for box in SURROUNDINGS),
        )


def _open_for(box: SceneBox, p_world: FloatArray, axis: FloatArray, radius: float) -> SceneBox:
    """Return a box whose hole, if it has one, lets a shaft through along an axis.

    Raises:
        SimulationError: if the path does not go down.
    """
    if not box.hole:
        return box
    down = -float(axis[2])
    if down < np.cos(FLATTEST):
        raise SimulationError(
            f"the path leans {np.degrees(np.arccos(np.clip(down, -1.0, 1.0))):.0f}° from straight"
            f" down; up to {FLATTEST / DEGREE:.0f}° can be shown in the scene of the arm"
        )
    aside = (float(p_world[2]) - box.low[2]) * float(np.hypot(axis[0], axis[1])) / down
    return replace(box, hole=max(box.hole, aside + radius / down + _AROUND))
