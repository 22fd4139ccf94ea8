"""Rocking a pen to every side: how it leans now, and which sides are still missing."""

from dataclasses import dataclass
from math import atan2, pi

import numpy as np

from app.core.arrays import unit
from app.core.units import DEGREE
from app.tracking.pen.calibrating import PoseCollector
from app.tracking.pen.pivot import FEWEST
from app.tracking.pen.pose import PoseStatus
from app.tracking.pen.step import PenObservation

SIDES = ("right", "away, right", "away", "away, left", "left", "near, left", "near", "near, right")
"""Where the pen's upper end points, as the webcam sees it: `near` is towards it."""

LEANT = 15.0 * DEGREE
"""Lean [rad] from which a position counts for its side."""


@dataclass(frozen=True, slots=True)
class Lean:
    """How the pen leans on its sheet, as the webcam sees it.

    Attributes:
        right, away: where its upper end points: parts of a unit vector, lengths the sine of lean.
    """

    right: float
    away: float

    @property
    def angle(self) -> float:
        """Lean against the upright [rad]."""
        return float(np.arcsin(min(1.0, (self.right**2 + self.away**2) ** 0.5)))

    @property
    def side(self) -> int | None:
        """Index into `SIDES`; None while it stands too upright."""
        if self.angle < LEANT:
            return None
        return round(atan2(self.away, self.right) / (2.0 * pi / len(SIDES))) % len(SIDES)


def lean_of(seen: PenObservation) -> Lean | None:
    """Lean of the pen in a picture; None where cube or sheet were not found."""
    if seen.body.status is not PoseStatus.FOUND or seen.base.status is not PoseStatus.FOUND:
        return None
    T_base_camera = seen.base.T_camera_board.inverse()
    # The body's z points to the tip, so that its upper end is at -z.
    up = -(T_base_camera.rotation @ seen.body.T_camera_board.rotation)[:, 2]
    right = T_base_camera.rotation[:, 0] * (1.0, 1.0, 0.0)
    if np.linalg.norm(right) < 1e-6:
        return None
    right = unit(right)
    away = np.array([-right[1], right[0], 0.0])
    return Lean(float(up @ right), float(up @ away))


class Rocking:
    """Collects what a guided calibration of the tip needs.

    `add` is called by the thread that looks at the pictures, all else by any other.
    """

    def __init__(self) -> None:
        self.collector = PoseCollector()
        self.leans: list[Lean] = []
        self.now: Lean | None = None

    def add(self, seen: PenObservation) -> None:
        """Take what one picture says."""
        self.now = lean_of(seen)
        if self.now is not None and self.collector.add(seen):
            self.leans.append(self.now)

    @property
    def covered(self) -> frozenset[int]:
        """Indices of the sides to which the pen has leant."""
        return frozenset(side for lean in list(self.leans) if (side := lean.side) is not None)

    @property
    def missing(self) -> tuple[str, ...]:
        """Names of the sides that are still missing."""
        covered = self.covered
        return tuple(name for i, name in enumerate(SIDES) if i not in covered)

    @property
    def progress(self) -> float:
        """How far it is, 0 to 1: positions and sides."""
        return min(self.collector.share, len(self.covered) / len(SIDES))

    @property
    def enough(self) -> bool:
        """Whether more would hardly help."""
        return self.progress >= 1.0

    @property
    def computable(self) -> bool:
        """Whether there are as many positions as are needed at least."""
        return len(self.collector.poses) >= FEWEST
