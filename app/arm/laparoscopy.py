"""Tool, trocar and table of the laparoscopic manipulator: their measures, for scene and pictures.

The world is that of the cameras: the table's middle below the origin, z up, the skin's surface at
z = 0. Every number is this project's own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, angle_between, cross, frozen, read_only, unit
from app.core.messages import sentence
from app.core.rotation import rotation_exp
from app.core.units import DEGREE
from app.mechanisms.errors import MechanismError

Corner = tuple[float, float, float]

TOOL_GREEN: Final = (70.0, 190.0, 60.0)
"""Colour of the tool: blue, green, red, 0 to 255."""

TROCAR_BLUE: Final = (205.0, 95.0, 30.0)
"""Colour of the trocar's ring."""

LEAN: Final = 20.0 * DEGREE
"""How far a shaft may lean in its trocar before the ring is laid aslant for it [rad]."""

RING_HALF: Final = 0.001
"""Half the ring's height [m]."""

FLATTEST: Final = 60.0 * DEGREE
"""Largest angle of a path from straight down [rad]: a flatter one grazes the skin."""

_UP: Final = read_only(np.array([0.0, 0.0, 1.0]))
_AROUND: Final = 0.004  # least gap between a shaft and the hole it goes through in a box [m]

TABLE_TOP: Final = -0.02
"""Height of the table's surface [m]; the skin's is 0."""

RAIL_TOP: Final = 0.018
"""Height of the tray's rails [m]; below it the fingers close."""

RAILS: Final = (-0.27, -0.13)
"""Where the rails cross x [m]; between them the hand takes the tool."""

_TRAY: Final = -0.012


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

    def open_for(self, p_world: FloatArray, axis: FloatArray, radius: float) -> SceneBox:
        """Return it with its hole, if it has one, wide enough for a shaft.

        Args:
            p_world: middle of the hole, seen from above, and a point of the shaft [m], shape (3,).
            axis: direction of the shaft into the body, of length one, shape (3,).
            radius: of the shaft [m].

        Raises:
            MechanismError: if the shaft is flatter than `FLATTEST`.
        """
        if not self.hole:
            return self
        down = -float(axis[2])
        if down < np.cos(FLATTEST) - 1e-12:
            lean = np.degrees(np.arccos(np.clip(down, -1.0, 1.0)))
            raise MechanismError(
                sentence(
                    "the path leans {lean:.0f}° from straight down; a tool goes through the skin "
                    "up to {flattest_deg:.0f}°",
                    lean=lean,
                    flattest_deg=FLATTEST / DEGREE,
                )
            )
        aside = (float(p_world[2]) - self.low[2]) * float(np.hypot(axis[0], axis[1])) / down
        return replace(self, hole=max(self.hole, aside + radius / down + _AROUND))


SURROUNDINGS: Final = (
    SceneBox("table", (-0.6, -0.5, -0.04), (0.6, 0.5, TABLE_TOP), (150.0, 152.0, 156.0), hole=0.06),
    SceneBox("stand", (-0.12, 0.56, -0.60), (0.12, 0.80, 0.0), (120.0, 122.0, 126.0)),
    SceneBox("tray", (-0.34, -0.22, TABLE_TOP), (-0.06, 0.22, _TRAY), (176.0, 178.0, 182.0)),
    *(
        SceneBox(
            f"{side} rail",
            (x - 0.005, -0.11, _TRAY),
            (x + 0.005, 0.11, RAIL_TOP),
            (120.0, 122.0, 126.0),
        )
        for side, x in zip(("left", "right"), RAILS, strict=True)
    ),
    SceneBox("skin", (0.02, -0.16, -0.004), (0.30, 0.16, 0.0), (168.0, 186.0, 214.0), hole=0.012),
    *(
        SceneBox("skin's frame", low, high, (168.0, 186.0, 214.0))
        for low, high in (
            ((0.02, -0.16, TABLE_TOP), (0.03, 0.16, -0.004)),
            ((0.29, -0.16, TABLE_TOP), (0.30, 0.16, -0.004)),
            ((0.03, -0.16, TABLE_TOP), (0.29, -0.15, -0.004)),
            ((0.03, 0.15, TABLE_TOP), (0.29, 0.16, -0.004)),
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
        """Return where it is taken, from the handle's end [m]: on the shaft, a hand's half from
        it.
        """
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
