"""The slices of a past control scan, made again, with needle and plan drawn where they were."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QDialog, QVBoxLayout

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.volume import Volume
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.session.control_scan import ControlScan
from app.views.debrief.page import DebriefPage
from app.views.exercise.conductor import Conductor
from app.views.exercise.scan_view import ScanView, caption
from app.views.kit.background import Indicator, run_in_background
from app.views.kit.text import tr


class ScanPictures(QObject):
    """Opens a scan of the debrief, if the CT that it was taken of is open."""

    def __init__(self, page: DebriefPage, conductor: Conductor, indicator: Indicator) -> None:
        super().__init__(page)
        self._page, self._conductor, self._indicator = page, conductor, indicator
        self.dialog: QDialog | None = None
        page.scans.scan_wanted.connect(self.open)

    def open(self, scan: ControlScan) -> None:
        """Make the picture beside the window, then show it."""
        patient, review = self._conductor.patient, self._page.review
        if review is None:
            return
        pseudonym = review.ct.pseudonym
        known = patient is not None and pseudonym in ("", patient.volume.series.pseudonym)
        if patient is None or not known:
            self._conductor.failed.emit(
                tr("The slices are made of the CT that was scanned, {ct}: open it first",
                   ct=pseudonym or tr("which is not open"))
            )  # fmt: skip
            return
        volume, recipe = patient.volume, review.ct.recipe

        def make(progress: Progress) -> Volume:
            with ONE_AT_A_TIME:  # compiled parts: beside the window
                from app.imaging.resampling import read_again
                from app.imaging.scanned import scan_image
            ct = volume
            if recipe is not None and recipe != volume.recipe:  # the scan was of a mended one
                ct = read_again(volume.series, recipe, progress)
            return scan_image(ct, scan.order, scan.needle, bool(scan.streak), scan.shift_mm)

        run_in_background(
            self, make, lambda picture: self._show(picture, scan), self._conductor.failed.emit,
            title=tr("Making the slices again"), indicator=self._indicator,
        )  # fmt: skip

    def _show(self, picture: Volume, scan: ControlScan) -> None:
        review = self._page.review
        if review is None:
            return
        self.dialog = dialog = QDialog(self._page)
        dialog.setWindowTitle(caption(scan, review.origin))
        dialog.resize(900, 700)
        view = ScanView(self._conductor.planning, dialog)
        view.show_scan(picture, scan, review.origin)
        view.viewing.set_draft(DraftPlan.of(review.placed.plan))
        needle = scan.needle
        view.viewing.set_needle(
            NeedleOverlay(needle.hub_mm, needle.tip_mm, curve_mm=needle.corners_mm)
        )
        column = QVBoxLayout(dialog)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(view)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()
