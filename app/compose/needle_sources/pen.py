"""A pen with printed markers before a webcam, as a needle source."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from app.compose.pen import Pen, pen_settings, pen_table
from app.exercises.schema import Exercise
from app.mechanisms.profile import DeviceProfile
from app.planning.placement import PlacedPlan

if TYPE_CHECKING:
    from app.compose.live_pen import LivePen
    from app.device.control import Table
    from app.tracking.pen.settings import PenSettings

DECLARATION: Final[dict[str, Any]] = {
    "title": "A pen with printed markers before a webcam",
    "noun": "a pen",
}


def source(pictures: str) -> Callable[[DeviceProfile], Pen]:
    """Return what builds the pen that is remembered, before a webcam of these pictures.

    Raises:
        CameraError: if the source of pictures cannot be read.
        ConfigurationError: if the settings file cannot be used.
    """
    settings = pen_settings(pictures)
    return lambda profile: Pen.of(settings, profile)


def replay_table(
    exercise: Exercise,
    placed: PlacedPlan,
    profile: DeviceProfile,
    skill: str | None,
    seed: int,
    simulated: bool,
) -> Table:
    """Return the table of a tick whose joint angles come from a record."""
    return pen_table(exercise, placed, profile, [], skill, seed, simulated)


def preview(settings: PenSettings) -> LivePen:
    """Open pen and webcam for the page in the window.

    Raises:
        AcusError: if webcam, pen or lens cannot be used.
    """
    from app.compose.live_pen import open_live_pen

    return open_live_pen(settings)
