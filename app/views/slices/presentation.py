"""How a pane presents its plane: as a slab, turned and mirrored, from where the operator stands."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.imaging.slab import Projection


from enum import StrEnum

from app.planning.placement import PatientOrientation
from app.views.slices.panes import PaneId

KINDS = ("mean", "mip", "minip")
"""Values of `imaging.slab.Projection`, which is compiled and loaded later."""

THINNEST_MM, THICKEST_MM = 1.0, 100.0
STEP_MM = 1.0


@dataclass(frozen=True, slots=True)
class Slab:
    """A thick slice.

    Attributes:
        kind: mean, mip or minip.
        thickness_mm: 0 for the slice as it is.
    """

    kind: str = "mean"
    thickness_mm: float = 0.0

    def __bool__(self) -> bool:
        """Return whether it is thicker than a slice."""
        return self.thickness_mm > 0.0

    @property
    def projection(self) -> Projection:
        """The way as imaging names it."""
        from app.imaging.slab import Projection  # compiled: loaded since there is a volume

        return Projection(self.kind)

    def thicker(self, steps: int) -> Slab:
        """Slab by so many millimetres thicker; below the thinnest it is a slice again."""
        thickness = self.thickness_mm + steps * STEP_MM
        if thickness < THINNEST_MM:
            thickness = 0.0
        return replace(self, thickness_mm=min(thickness, THICKEST_MM))

    def next_kind(self) -> Slab:
        """Slab of the next kind; a slice becomes 10 mm thick, so that something is seen."""
        kind = KINDS[(KINDS.index(self.kind) + 1) % len(KINDS)] if self else self.kind
        return Slab(kind, self.thickness_mm or 10.0)

    def words(self) -> str:
        """Kind and thickness for people; nothing for a slice."""
        if not self:
            return ""
        return tr("{kind} {thickness:g} mm", kind=kind_name(self.kind), thickness=self.thickness_mm)


@dataclass(frozen=True, slots=True)
class Turn:
    """How what is seen is turned.

    Attributes:
        quarters: clockwise, 0 to 3.
        mirrored: left and right are swapped before that.
    """

    quarters: int = 0
    mirrored: bool = False

    def __bool__(self) -> bool:
        """Return whether anything is turned."""
        return self.quarters != 0 or self.mirrored

    def turned(self, quarters: int) -> Turn:
        """Turn on, clockwise."""
        return replace(self, quarters=(self.quarters + quarters) % 4)

    def flipped(self, upright: bool = False) -> Turn:
        """Swap left and right as they are seen, or top and bottom."""
        # mirror after a turn = mirror before it, and the turn the other way
        quarters = (-self.quarters + (2 if upright else 0)) % 4
        return Turn(quarters, not self.mirrored)

    def words(self) -> str:
        """Say what was done, for people; nothing where nothing was."""
        parts = [tr("mirrored")] if self.mirrored else []
        parts += [tr("turned {angle}°", angle=90 * self.quarters)] if self.quarters else []
        return ", ".join(parts)


@dataclass(frozen=True, slots=True)
class Presentation:
    """Slab and turn of one pane."""

    slab: Slab = Slab()
    turn: Turn = Turn()


def kind_name(kind: str) -> str:
    """Name of a projection for people."""
    return {"mean": tr("Mean"), "mip": tr("MIP"), "minip": tr("MinIP")}[kind]


class OperatorSide(StrEnum):
    """Where the operator stands."""

    CONVENTION = "convention"
    """Nothing is turned: as radiologists read it, the patient on the back, seen from the feet."""
    FEET = "feet"
    HEAD = "head"
    RIGHT = "right"
    LEFT = "left"


_UP = {
    PatientOrientation.SUPINE: 0,
    PatientOrientation.PRONE: 2,
    PatientOrientation.LEFT_DOWN: 1,
    PatientOrientation.RIGHT_DOWN: 3,
}
"""Quarters that bring the side of an axial slice that is up on the table to the top."""

_COUCH = {OperatorSide.FEET: 0, OperatorSide.HEAD: 2, OperatorSide.RIGHT: 3, OperatorSide.LEFT: 1}
"""Quarters of the coronal slice that bring what is near the operator to the bottom."""


def turns(side: OperatorSide, lies: PatientOrientation) -> dict[PaneId, Turn]:
    """Return how the slices are turned.

    The axial slice has what is up on the table on top, and is seen from the feet, or from the head
    if the operator stands there. The coronal slice is seen from above, the operator's side at the
    bottom. On one side the patient's coronal slices stand upright on the table: they, and the
    sagittal ones, stay as they are.
    """
    if side is OperatorSide.CONVENTION:
        return {pane: Turn() for pane in (PaneId.AXIAL, PaneId.SAGITTAL, PaneId.CORONAL)}
    axial = Turn(_UP[lies])
    if side is OperatorSide.HEAD:
        axial = axial.flipped()
    coronal = Turn()
    if lies is PatientOrientation.SUPINE:
        coronal = Turn(_COUCH[side])
    elif lies is PatientOrientation.PRONE:  # seen from the back, right and left change places
        quarters = _COUCH[side]
        coronal = Turn(
            (4 - quarters) % 4 if side in (OperatorSide.RIGHT, OperatorSide.LEFT) else quarters,
            True,
        )
    return {PaneId.AXIAL: axial, PaneId.SAGITTAL: Turn(), PaneId.CORONAL: coronal}


def side_name(side: OperatorSide) -> str:
    """Name of a place for people."""
    names = {
        OperatorSide.CONVENTION: tr("As radiologists read it"),
        OperatorSide.FEET: tr("At the patient's feet"),
        OperatorSide.HEAD: tr("At the patient's head"),
        OperatorSide.RIGHT: tr("On the patient's right"),
        OperatorSide.LEFT: tr("On the patient's left"),
    }
    return names[side]
