"""Which panes there are: their identity, colour, name, and whose traces each of them shows."""

from __future__ import annotations

from enum import StrEnum

from app.views.kit import theme
from app.views.kit.text import tr
from app.views.kit.theme import Mark


class PaneId(StrEnum):
    """A slice pane: three along the patient's axes, three along the needle."""

    AXIAL = "axial"
    SAGITTAL = "sagittal"
    CORONAL = "coronal"
    IN_PLANE = "in_plane"
    IN_PLANE_90 = "in_plane_90"
    PROBE = "probe"

    @property
    def is_needle(self) -> bool:
        """Return whether its plane belongs to the needle, not to the crosshair."""
        return self in NEEDLE_PANES


MPR_PANES = (PaneId.AXIAL, PaneId.SAGITTAL, PaneId.CORONAL)
"""Panes that pass through the crosshair."""

NEEDLE_PANES = (PaneId.IN_PLANE, PaneId.IN_PLANE_90, PaneId.PROBE)
"""Panes that pass through the needle."""

PANE_MARKS: dict[PaneId, Mark] = {
    PaneId.AXIAL: theme.AXIAL,
    PaneId.SAGITTAL: theme.SAGITTAL,
    PaneId.CORONAL: theme.CORONAL,
    PaneId.IN_PLANE: theme.IN_PLANE,
    PaneId.IN_PLANE_90: theme.IN_PLANE_90,
    PaneId.PROBE: theme.PROBE,
}
"""Colour and dash of a pane's frame and of its trace in the others."""


def pane_name(pane: PaneId) -> str:
    """Name of a pane for people."""
    names = {
        PaneId.AXIAL: tr("Axial"),
        PaneId.SAGITTAL: tr("Sagittal"),
        PaneId.CORONAL: tr("Coronal"),
        PaneId.IN_PLANE: tr("In plane"),
        PaneId.IN_PLANE_90: tr("In plane 90°"),
        PaneId.PROBE: tr("Probe's eye"),
    }
    return names[pane]


def crossing_panes(pane: PaneId) -> tuple[PaneId, ...]:
    """Panes whose traces this one shows; two that share the needle would draw them over it."""
    if pane in (PaneId.IN_PLANE, PaneId.IN_PLANE_90):
        return (PaneId.PROBE,)
    return others(pane)


def others(pane: PaneId) -> tuple[PaneId, PaneId]:
    """Return the two other panes of the same family."""
    family = NEEDLE_PANES if pane.is_needle else MPR_PANES
    first, second = (other for other in family if other is not pane)
    return first, second
