"""Pictures of series, one after the other beside the window."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QObject, Signal

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.series import Series
from app.views.kit.background import BackgroundTask, run_in_background


class Thumbnails(QObject):
    """Makes the pictures in the order given.

    Signals:
        ready(int, object): number of the series, its picture or None.
    """

    ready = Signal(int, object)

    def __init__(self, series: Sequence[Series], size_px: int, parent: QObject) -> None:
        super().__init__(parent)
        self._series, self._size_px = tuple(series), size_px
        self._task: BackgroundTask | None = None

    @property
    def is_busy(self) -> bool:
        """Whether pictures are still to come."""
        return self._task is not None

    def open(self) -> None:
        """Begin with the first."""
        self._make(0)

    def close(self) -> None:
        """Stop; idempotent."""
        if self._task is not None:
            self._task.close(timeout=0.0)
            self._task = None

    def _make(self, number: int) -> None:
        if number >= len(self._series):
            self._task = None
            return

        def done(picture: object) -> None:
            self.ready.emit(number, picture)
            self._make(number + 1)

        series, size = self._series[number], self._size_px
        self._task = run_in_background(
            self, lambda progress: _picture(series, size, progress), done, lambda _: done(None)
        )


def _picture(series: Series, size_px: int, progress: Progress) -> Any:
    progress.report(0.0)
    with ONE_AT_A_TIME:  # pydicom: behind the window, not before it
        from app.imaging.thumbnails import try_thumbnail
    return try_thumbnail(series, size_px)
