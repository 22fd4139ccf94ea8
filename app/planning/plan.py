"""The plan: the two points that a student has to connect, in the patient's own coordinates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import hypot

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, unit
from app.core.messages import sentence
from app.planning.errors import PlanError

SHORTEST_MM = 1.0
"""Entry and target closer than this have no direction worth following [mm]."""

LARGEST_MM = 1e7
"""No coordinate of a patient lies beyond this [mm]; up to it, rounding stays below 2e-9 mm."""


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """A straight path into the body: entry on the skin, target inside. DICOM LPS, millimetres.

    Attributes:
        entry_mm: where the needle enters, shape (3,), read-only.
        target_mm: where its tip shall end, shape (3,), read-only.
        name: for lists and files.

    Raises:
        PlanError: if a coordinate is not finite or beyond 1e7 mm, or the points are closer than
            1 mm.
    """

    entry_mm: FloatArray
    target_mm: FloatArray
    name: str = "plan"

    def __post_init__(self) -> None:
        object.__setattr__(self, "entry_mm", checked_point(self.entry_mm, "entry_mm"))
        object.__setattr__(self, "target_mm", checked_point(self.target_mm, "target_mm"))
        if self.length_mm < SHORTEST_MM * (1.0 - 1e-9):
            raise PlanError(
                sentence(
                    "entry {entry} and target {target} are "
                    "{length_mm:.3g} mm apart; a path needs at least {shortest_mm:g} mm: "
                    "move one of the two points",
                    entry=_text(self.entry_mm),
                    target=_text(self.target_mm),
                    length_mm=self.length_mm,
                    shortest_mm=SHORTEST_MM,
                )
            )

    @property
    def length_mm(self) -> float:
        """Distance from entry to target [mm]."""
        return hypot(*(self.target_mm - self.entry_mm))

    @property
    def direction(self) -> FloatArray:
        """Unit vector from entry to target, LPS, shape (3,)."""
        return unit(self.target_mm - self.entry_mm, "path")

    def with_entry(self, entry_mm: ArrayLike) -> Plan:
        """Return the plan with another entry [mm]."""
        return replace(self, entry_mm=np.asarray(entry_mm))

    def with_target(self, target_mm: ArrayLike) -> Plan:
        """Return the plan with another target [mm]."""
        return replace(self, target_mm=np.asarray(target_mm))

    def require_inside(self, is_inside: Callable[[FloatArray], bool]) -> None:
        """Refuse a plan whose target lies outside the body.

        Args:
            is_inside: tells whether an LPS point [mm] lies in the body (from `imaging.body`).

        Raises:
            PlanError: naming the point that is outside.
        """
        if not is_inside(self.target_mm):
            raise PlanError(
                sentence(
                    "target {target} lies outside the body: click inside the patient",
                    target=_text(self.target_mm),
                )
            )

    def __eq__(self, other: object) -> bool:
        """Equal when name and both points are equal to the last bit."""
        return isinstance(other, Plan) and self._key() == other._key()

    def __hash__(self) -> int:
        """Hash by value."""
        return hash(self._key())

    def _key(self) -> tuple[object, ...]:
        return (self.name, *self.entry_mm.tolist(), *self.target_mm.tolist())


def checked_point(point: ArrayLike, name: str) -> FloatArray:
    """Return a read-only copy of a point [mm], shape (3,).

    Raises:
        PlanError: if it has not three finite coordinates within ±1e7 mm.
    """
    try:
        array = np.array(point, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise PlanError(
            sentence("{name} {point!r} is not a point of three numbers", name=name, point=point)
        ) from error
    if array.shape != (3,):
        raise PlanError(
            sentence(
                "{name} has shape {array_shape}; three coordinates (3,) are needed",
                name=name,
                array_shape=array.shape,
            )
        )
    if not np.isfinite(array).all() or np.abs(array).max() > LARGEST_MM:
        raise PlanError(
            sentence(
                "{name} {array} must be finite and within ±{largest_mm:g} mm",
                name=name,
                array=array.tolist(),
                largest_mm=LARGEST_MM,
            )
        )
    array.setflags(write=False)
    return array


def _text(point_mm: FloatArray) -> str:
    return "(" + ", ".join(f"{value:.1f}" for value in point_mm) + ") mm"
