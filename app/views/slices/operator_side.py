"""From where the operator looks at the patient, and how the slices are turned to it."""

from __future__ import annotations

from enum import StrEnum

from app.planning.placement import PatientOrientation
from app.views.kit.text import tr
from app.views.slices.looks import Turn
from app.views.slices.panes import PaneId


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
