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

from app.arm.hand import HandProfile, load_hand
from app.arm.laparoscopy import (
    RAIL_TOP,
    RAILS,
    SURROUNDINGS,
    SceneBox,
    ToolBody,
    TrocarRing,
)
from app.arm.mechanics import ArmProfile, PublishedArm, load_arm, published_arm
from app.core.arrays import FloatArray, frozen, unit
from app.core.messages import sentence
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.core.units import DEGREE
from app.simulation.errors import SimulationError


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
                raise SimulationError(
                    sentence(
                        "scene of the arm: {name} is {length}; give more than 0",
                        name=name,
                        length=value,
                    )
                )
        if not self.arm.allows(self.home):
            raise SimulationError(
                sentence(
                    "scene of the arm: home {home_deg}° is beyond the joint limits ±{limits_deg}°",
                    home_deg=np.degrees(self.home).round(1).tolist(),
                    limits_deg=np.degrees(self.arm.upper).round(1).tolist(),
                )
            )
        x, y, _ = self.trocar.p_world
        on = [box for box in self.boxes if box.name == "skin"]
        if not all(
            box.low[0] + self.trocar.outer < x < box.high[0] - self.trocar.outer
            and box.low[1] + self.trocar.outer < y < box.high[1] - self.trocar.outer
            for box in on
        ):
            raise SimulationError(
                sentence(
                    "scene of the arm: the trocar at ({x:.0f}, {y:.0f}) mm does not lie"
                    " on the skin, {on_first_low} to {on_first_high} m",
                    x=1e3 * x,
                    y=1e3 * y,
                    on_first_low=on[0].low[:2],
                    on_first_high=on[0].high[:2],
                )
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
        middle = np.array([np.mean(RAILS) + rng.uniform(-0.01, 0.01), rng.uniform(-0.06, 0.06)])
        heading = rng.uniform(-15.0, 15.0) * DEGREE + np.pi * float(rng.integers(2))
        axis = np.array([np.cos(heading), np.sin(heading)])
        # Handle and shaft are not as thick: it lies aslant, touching both rails.
        thick, thin = 0.5 * body.handle_diameter, 0.5 * body.shaft_diameter
        slope = (thick - thin) / (RAILS[1] - RAILS[0])
        direction = unit([*axis, -slope])
        clear = 0.001
        centre = np.array([*middle, RAIL_TOP + 0.5 * (thick + thin) + clear])
        across = unit(np.cross(direction, [0.0, 0.0, 1.0]))
        rotation = np.column_stack([across, np.cross(direction, across), direction])
        trocar = np.array([0.16, 0.0, 0.002])
        trocar[:2] += rng.uniform(-0.03, 0.03, 2)
        path = np.array([0.0, 0.0, -1.0]) if axis_world is None else unit(axis_world)
        return cls(
            tool=body,
            trocar=TrocarRing.guiding(trocar, path),
            T_world_tool=RigidTransform(rotation, centre - body.grip * direction),
            boxes=tuple(box.open_for(trocar, path, thin) for box in SURROUNDINGS),
        )
