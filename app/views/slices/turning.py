"""Oblique planes: the three patient views turned about the crosshair, and straight again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, unit
from app.core.rotation import rotation_exp
from app.imaging.reformat import Frame
from app.views.slices.panes import MPR_PANES, PaneId
from app.views.slices.viewing import Viewing

SNAP_RAD = 0.012
"""A turn that ends nearer than this to where it began goes back there exactly."""


@dataclass(frozen=True, slots=True, eq=False)
class StartingPlanes:
    """Planes as they were when a turn began: turned from here, small steps do not add up errors.

    Attributes:
        frames: of the panes that turn, and the directions in which their slices count up.
        straight: whether each of them was the volume's own.
    """

    frames: dict[PaneId, tuple[Frame, FloatArray]]
    straight: dict[PaneId, bool]

    @classmethod
    def of(cls, viewing: Viewing, panes: Sequence[PaneId]) -> StartingPlanes:
        """Remember the planes of these panes."""
        own = {pane: viewing.own(pane) for pane in panes}
        known = {pane: plane for pane, plane in own.items() if plane is not None}
        return cls(
            {pane: (plane.frame(0.0), plane.ahead) for pane, plane in known.items()},
            {pane: not viewing.is_oblique(pane) for pane in known},
        )


def turn_planes(viewing: Viewing, start: StartingPlanes, axis: ArrayLike, angle: float) -> None:
    """Turn planes about the crosshair, away from where they were.

    Args:
        viewing: whose planes.
        start: as they were.
        axis: in LPS, shape (3,).
        angle: by the right-hand rule [rad].
    """
    turn = rotation_exp(angle * unit(axis, "axis"))
    back = abs(np.arctan2(np.sin(angle), np.cos(angle))) < SNAP_RAD
    for pane, (frame, ahead) in start.frames.items():
        if back and start.straight[pane]:
            viewing.set_frame(pane, None)
        else:
            turned = frame.turned(axis, angle, viewing.cursor_mm)
            viewing.set_frame(pane, turned, turn @ ahead)


def is_turned(viewing: Viewing) -> bool:
    """Whether any of the three patient views is oblique."""
    return any(viewing.is_oblique(pane) for pane in MPR_PANES)


def straighten(viewing: Viewing) -> None:
    """Go back to the volume's own slices in all three views; the crosshair stays."""
    for pane in MPR_PANES:
        if viewing.is_oblique(pane):
            viewing.set_frame(pane, None)
