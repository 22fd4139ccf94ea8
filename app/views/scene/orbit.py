"""The eye of the 3D view: where it looks from, turned by the mouse or by a letter."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, radians, sin

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen, unit
from app.core.rotation import rotation_exp

TURN_PER_PX = radians(0.5)
OPERATOR_PITCH = radians(40.0)
"""How steeply an operator who stands at the table looks down on the patient."""

SMALLEST_MM, LARGEST_MM = 5.0, 5000.0
STEEP = 0.6
"""Share of a direction across the line of sight below which another one says what is up."""

# Directions from which one looks, and what is up then (LPS).
_FROM = {
    "A": ((0, -1, 0), (0, 0, 1)),
    "P": ((0, 1, 0), (0, 0, 1)),
    "L": ((1, 0, 0), (0, 0, 1)),
    "R": ((-1, 0, 0), (0, 0, 1)),
    "S": ((0, 0, 1), (0, -1, 0)),
    "I": ((0, 0, -1), (0, -1, 0)),
}


@dataclass(frozen=True, slots=True, eq=False)
class Orbit:
    """An orthographic-like eye on a sphere around a focus.

    Attributes:
        focus_mm: what is in the middle, LPS, shape (3,).
        backwards: unit vector from the focus to the eye, shape (3,).
        up: unit vector that is up on the screen, perpendicular to `backwards`, shape (3,).
        half_mm: half of what the view shows along its shorter side, so that a tall and a wide pane
            both show the whole.
    """

    focus_mm: FloatArray
    backwards: FloatArray
    up: FloatArray
    half_mm: float

    @classmethod
    def from_side(cls, letter: str, focus_mm: FloatArray, half_mm: float) -> Orbit:
        """Look from the patient's A, P, L, R, S or I side."""
        backwards, up = _FROM[letter]
        return cls(frozen(focus_mm), frozen(backwards), frozen(up), half_mm)

    @classmethod
    def towards(
        cls, direction: ArrayLike, up: ArrayLike, focus_mm: FloatArray, half_mm: float
    ) -> Orbit:
        """Look along a direction, shape (3,); `up`, shape (3,), is up, as far as it can be seen.

        Where it can hardly be seen the front or the head is up, whichever is seen better.
        """
        backwards, hint = -unit(direction), np.asarray(up, np.float64)
        across = hint - (hint @ backwards) * backwards
        if np.linalg.norm(across) < STEEP * np.linalg.norm(hint):  # one looks along it
            others = [np.array(_FROM[side][1], np.float64) for side in ("S", "A")]
            hint = min(others, key=lambda other: abs(float(other @ backwards)))
            across = hint - (hint @ backwards) * backwards
        return cls(frozen(focus_mm), frozen(backwards), frozen(unit(across)), half_mm)

    @classmethod
    def from_operator(
        cls, R_world_patient: FloatArray, focus_mm: FloatArray, half_mm: float
    ) -> Orbit:
        """Look as the operator does: behind the motors, away from them (y), and down.

        Args:
            R_world_patient: rotation patient → world, shape (3, 3).
            focus_mm: what is in the middle, LPS, shape (3,).
            half_mm: half of what the view shows along its shorter side.
        """
        ahead = np.array([0.0, cos(OPERATOR_PITCH), -sin(OPERATOR_PITCH)])
        above = R_world_patient.T @ np.array([0.0, 0.0, 1.0])
        return cls.towards(R_world_patient.T @ ahead, above, focus_mm, half_mm)

    @property
    def right(self) -> FloatArray:
        """Unit vector to the right on the screen, shape (3,)."""
        return np.cross(self.up, self.backwards)

    def seen_from(self, letter: str) -> Orbit:
        """Keep focus and size, look from another side."""
        return Orbit.from_side(letter, self.focus_mm, self.half_mm)

    def turned(self, right_px: float, down_px: float) -> Orbit:
        """Turn the patient with the mouse as on a ball."""
        turn = rotation_exp(
            (-right_px * TURN_PER_PX) * np.asarray(self.up) + (-down_px * TURN_PER_PX) * self.right
        )
        backwards = unit(turn @ self.backwards)
        up = turn @ self.up
        up = unit(up - (up @ backwards) * backwards)
        return replace(self, backwards=frozen(backwards), up=frozen(up))

    def fitted(self, points_mm: ArrayLike, margin: float = 1.06) -> Orbit:
        """Look the same way, at the middle and from the distance that show all points, (n, 3)."""
        points = np.asarray(points_mm, dtype=np.float64)
        axes = np.array([self.right, self.up, self.backwards])
        seen = points @ axes.T
        low, high = seen.min(axis=0), seen.max(axis=0)
        half = 0.5 * margin * float((high - low)[:2].max())
        half = min(max(half, SMALLEST_MM), LARGEST_MM)
        return replace(self, focus_mm=frozen(0.5 * (low + high) @ axes), half_mm=half)

    def mm_per_px(self, size_px: tuple[int, int]) -> float:
        """Size of a pixel at the focus [mm] in a view of this width and height."""
        return 2.0 * self.half_mm / max(1, min(size_px))

    def panned(self, right_px: float, down_px: float, size_px: tuple[int, int]) -> Orbit:
        """Move the patient with the mouse."""
        mm = self.mm_per_px(size_px)
        shift = -right_px * mm * self.right + down_px * mm * np.asarray(self.up)
        return replace(self, focus_mm=frozen(self.focus_mm + shift))

    def zoomed(self, factor: float) -> Orbit:
        """Make everything `factor` times larger."""
        half = min(max(self.half_mm / factor, SMALLEST_MM), LARGEST_MM)
        return replace(self, half_mm=half)

    def pixels(self, points_mm: ArrayLike, size_px: tuple[int, int]) -> FloatArray:
        """Return where points are seen, (n, 3) -> (n, 2) [px], right and down from the upper
        left.
        """
        away = np.asarray(points_mm, dtype=np.float64) - self.focus_mm
        mm, (width, height) = self.mm_per_px(size_px), size_px
        return np.column_stack(
            [width / 2 + away @ self.right / mm, height / 2 - away @ np.asarray(self.up) / mm]
        )

    def ray(
        self, x_px: float, y_px: float, size_px: tuple[int, int]
    ) -> tuple[FloatArray, FloatArray]:
        """Line of sight through a pixel: a point on it at the focus' depth, and its direction."""
        width, height = size_px
        mm = self.mm_per_px(size_px)
        across = (x_px - width / 2) * mm * self.right
        return self.focus_mm + across - (y_px - height / 2) * mm * self.up, -self.backwards
