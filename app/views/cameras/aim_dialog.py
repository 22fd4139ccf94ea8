"""Aiming: both live pictures with the needle's cone drawn in, and the share that both see."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QDialog, QDialogButtonBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from app.core.progress import Progress
from app.tracking.cameras.settings import SIDES, CameraSettings
from app.views.cameras.live import AimPort, LiveCamera, LivePreview
from app.views.kit import theme
from app.views.kit.background import run_in_background
from app.views.kit.progress_strip import ProgressStrip
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.views.shell.services import Services

ENOUGH = 0.995


class AimDialog(QDialog):
    """Shows where the needle's marker can be in both pictures.

    Args:
        settings: the cameras.
        device: name of the device profile: where the fulcrum is.
        services: opens cameras, computes the cone.
        free: waits, in another thread, until nobody else has the cameras.
        parent: the window.
    """

    def __init__(
        self,
        settings: CameraSettings,
        device: str,
        services: Services,
        free: Callable[[], object],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Aim the cameras"))
        self.previews = tuple(LivePreview(self) for _ in SIDES)
        self.share, self.losses = QLabel(self), QLabel(self)
        self.waiting = ProgressStrip(self)
        self.titles = tuple(QLabel(title, self) for title in (tr("Left"), tr("Right")))
        self._lay_out()
        for side, preview in zip(SIDES, self.previews, strict=True):
            preview.open(_opener(services, settings, side, free))
        run_in_background(
            self, lambda progress: services.aim(settings, device, progress), self._show, self._fail,
            self.reject, title=tr("Computing the cone"), indicator=self.waiting,
        )  # fmt: skip

    def closed(self) -> Callable[[], object]:
        """Return what waits until the cameras are closed; for other threads."""
        waits = [preview.closed() for preview in self.previews]
        return lambda: [wait() for wait in waits]

    def done(self, result: int) -> None:
        """Let go of the cameras."""
        for preview in self.previews:
            preview.stop()
        super().done(result)

    def _show(self, aim: AimPort) -> None:
        cone = aim.cone
        for preview, outline in zip(self.previews, cone.outlines, strict=True):
            preview.picture.set_outline(outline, aim.image_size)
        good = cone.share >= ENOUGH and not aim.assumed
        colour, symbol = theme.VERDICTS["good" if good else "warning"]
        self.share.setStyleSheet(f"color: {colour}; font-size: {theme.TITLE_PX}px;")
        words = (
            tr("{symbol} Standing as designed, both cameras would see {share:.0f} % of the cone")
            if aim.assumed
            else tr("{symbol} Both cameras see {share:.0f} % of the needle's cone")
        )
        self.share.setText(words.format(symbol=symbol, share=100.0 * cone.share))
        names = (tr("Left"), tr("Right"))
        for title, name, share in zip(self.titles, names, cone.shares, strict=True):
            sees = (
                tr("{name}: would see {share:.0f} %")
                if aim.assumed
                else tr("{name}: sees {share:.0f} %")
            )
            title.setText(sees.format(name=name, share=100.0 * share))
        lines = [tr("Cone of: {basis}.", basis=aim.basis), *cone.losses()]
        self.losses.setText("\n".join(lines))

    def _fail(self, error: Exception) -> None:
        colour, symbol = theme.VERDICTS["bad"]
        self.share.setStyleSheet(f"color: {colour};")
        self.share.setText(f"{symbol} {error}")

    def _lay_out(self) -> None:
        words = QLabel(tr(
            "The green line surrounds every place the marker can be at. It should lie within both "
            "pictures. The line follows from the calibration, not from the picture: after moving a "
            "camera, calibrate again."
        ))  # fmt: skip
        for label in (words, self.losses, self.share):
            label.setWordWrap(True)
        self.losses.setStyleSheet(f"color: {theme.TEXT_DIM};")
        pair = QHBoxLayout()
        pair.setSpacing(theme.MARGIN)
        for title, preview in zip(self.titles, self.previews, strict=True):
            side = QVBoxLayout()
            side.addWidget(title)
            side.addWidget(preview, 1)
            pair.addLayout(side, 1)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close, parent=self)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        column.addWidget(self.waiting)
        column.addWidget(self.share)
        column.addLayout(pair, 1)
        column.addWidget(self.losses)
        column.addWidget(words)
        column.addWidget(buttons)
        self.resize(1060, 620)


def _opener(
    services: Services, settings: CameraSettings, side: str, free: Callable[[], object]
) -> Callable[[Progress], LiveCamera]:
    def operation(progress: Progress) -> LiveCamera:
        free()
        return services.open_camera(settings, side, progress)

    return operation
