"""Uneven slices on an even, right-angled grid."""

from typing import Any

from app.core.progress import Progress
from app.imaging.series import Recipe, Refusal, Series
from app.imaging.volume import Volume

DECLARATION: dict[str, Any] = {
    "title": "Open resampled",
    "help": "Interpolates between the slices onto an even grid; missing slices stay empty.",
    "against": "uneven slices",
    "rank": 1,
}


def offers(series: Series) -> bool:
    """Return whether nothing but the places of its slices keeps a series from being read."""
    return series.refusal is Refusal.UNEVEN


def read(series: Series, recipe: Recipe, progress: Progress) -> Volume:
    """Interpolate between the slices."""
    from app.imaging.resampling import resampled  # scipy: only for who asks

    return resampled(series, recipe, progress)
