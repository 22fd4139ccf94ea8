"""What is said when cameras and robot disagree, by cause."""

from typing import Final

import numpy as np

from app.core.units import MILLIMETRE

BUMPED: Final = (
    "the two pictures, or pictures and robot, no longer fit each other: a camera was moved; run "
    "the morning check, then calibrate"
)
"""Said of a camera that was moved."""

SWAPPED: Final = (
    "the pictures fit with left and right exchanged: the cameras are swapped; put both cables "
    "back, or exchange left and right in the settings"
)
"""Said of swapped cameras."""


def bent(size: float) -> str:
    """Speak of a needle that bends by so much at the deepest [m]."""
    return f"the needle bends: up to {size / MILLIMETRE:.1f} mm off its line at the band"


def lean(turn: float) -> str:
    """Speak of an axis by the cameras that is turned from the robot's [rad]."""
    return (
        f"the cameras see the needle turned by {np.degrees(turn):.1f}° from the robot's direction: "
        "home the robot again, then run the morning check"
    )


def unclear(rms: float) -> str:
    """Speak of a distance beside the line [m] without a cause."""
    return (
        f"the cameras see the needle {rms / MILLIMETRE:.1f} mm beside the robot's line: move it "
        "through its whole depth to tell a bent needle from a camera that was moved"
    )


def slipped(slip: float) -> str:
    """Speak of a marker that is off along the needle [m]."""
    where = "towards the tip" if slip > 0.0 else "towards the hub"
    return (
        f"the tip touches known places {abs(slip) / MILLIMETRE:.1f} mm from where the cameras see "
        f"it: the marker has slipped {where}; set it back to its mark"
    )
