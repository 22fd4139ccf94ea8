"""Slices of a tilted gantry on a right-angled grid."""

from typing import Any

from app.core.progress import Progress
from app.imaging.series import Recipe, Series
from app.imaging.volume import Volume

DECLARATION: dict[str, Any] = {
    "title": "Open straightened",
    "help": "Interpolates onto a right-angled grid. Opened as it is, the tilt is kept exactly.",
    "against": "gantry tilt",
    "rank": 2,
}


def offers(series: Series) -> bool:
    """Return whether a series can be read as it is, and its gantry was tilted."""
    return series.usable and series.tilt_deg > 0.0


def read(series: Series, recipe: Recipe, progress: Progress) -> Volume:
    """Interpolate between the slices."""
    from app.imaging.resampling import resampled  # scipy: only for who asks

    return resampled(series, recipe, progress)
