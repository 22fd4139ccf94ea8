"""Pictures of a demonstration: one of each moment, written when it is over, with the report."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import QWidget

from app.core.errors import AcusError
from app.session.result import AttemptResult
from app.session.review import review_of_result
from app.views.debrief.report import write_report
from app.views.slices.canvas import SliceCanvas


class PictureError(AcusError, OSError):
    """A picture cannot be written."""


class StillPictures:
    """Takes a picture of each name once; without a folder none.

    Args:
        window: is pictured where nothing smaller is named.
        folder: where they are written.
    """

    def __init__(self, window: QWidget, folder: Path | None) -> None:
        self._window, self._folder = window, folder
        self._taken: dict[str, QPixmap] = {}

    def __contains__(self, name: str) -> bool:
        """Tell whether a picture was taken."""
        return name in self._taken

    def take(self, name: str, widget: QWidget | None = None) -> None:
        """Picture the window or a part of it, unless that moment has its picture."""
        if self._folder is not None and name not in self._taken:
            widget = widget or self._window
            _draw_what_is_due(widget)
            self._taken[name] = widget.grab()

    def write(self, result: AttemptResult | None) -> None:
        """Write all, and the report; at the end: compressing them would disturb the cameras.

        Raises:
            PictureError: if one cannot be written.
        """
        if self._folder is None:
            return
        self._folder.mkdir(parents=True, exist_ok=True)
        for name, picture in self._taken.items():
            file = self._folder / f"{name}.png"
            if not picture.save(str(file)):
                raise PictureError(f"cannot write {file}; is there room on the disk?")
        if result is not None:
            write_report(review_of_result(result), self._folder / "report.pdf")


def _draw_what_is_due(widget: QWidget) -> None:
    """Let slices and words catch up with the numbers: a picture is taken between two drawings."""
    for canvas in widget.findChildren(SliceCanvas):
        if canvas.isVisible():
            canvas.flush()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest)
