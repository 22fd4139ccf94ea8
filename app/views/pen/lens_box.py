"""Where the webcam's lens is known from."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QFileDialog, QWidget

from app.tracking.pen.settings import PenSettings
from app.views.kit.text import tr

_ASK = "ask"
_GUESS = "guess"

Lens = tuple[Path | None, str]
"""File of a calibration, None to guess; name of the camera in a calibration of two."""


class LensBox(QComboBox):
    """Guessed, or a calibration's file.

    Signals:
        changed(): another lens was chosen.
    """

    changed = Signal()

    def __init__(self, settings: PenSettings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._camera = settings.camera
        self.addItem(tr("guessed from the pictures' size"), _GUESS)
        self.addItem(tr("a calibration's file…"), _ASK)
        self._last = 0
        if settings.calibration is not None:
            self._add(settings.calibration, settings.camera)
        self.setToolTip(tr(
            "A guess is good for trying out. `acus calibrate mono --images FOLDER --out lens.yaml` "
            "measures the lens; of a calibrated pair of cameras either may be taken"
        ))  # fmt: skip
        self.activated.connect(self._chosen)

    def chosen(self) -> Lens:
        """Return file and camera; None for a guess."""
        data = self.itemData(self._last)
        if data in (_GUESS, _ASK):
            return None, self._camera
        file, camera = str(data).rsplit("|", 1)
        return Path(file), camera

    def take(self, file: Path) -> None:
        """Use a calibration's file; of a pair its first camera, the others can be chosen."""
        names = _cameras(file)
        for name in names or (self._camera,):
            self._add(file, name, many=len(names) > 1)
        self._last = self.count() - max(1, len(names))
        self.setCurrentIndex(self._last)
        self.changed.emit()

    def _add(self, file: Path, camera: str, many: bool = False) -> None:
        title = f"{file.name}, {camera}" if many else file.name
        self.addItem(title, f"{file}|{camera}")
        self._last = self.count() - 1
        self.setCurrentIndex(self._last)

    def _chosen(self, index: int) -> None:
        if self.itemData(index) != _ASK:
            if index != self._last:
                self._last = index
                self.changed.emit()
            return
        self.setCurrentIndex(self._last)
        answer, _ = QFileDialog.getOpenFileName(
            self, tr("Calibration of the webcam"), "", tr("Calibrations (*.yaml *.yml)")
        )
        if answer:
            self.take(Path(answer))


def _cameras(file: Path) -> tuple[str, ...]:
    """Names of the cameras of a pair; empty for one camera or what is no calibration."""
    from app.core.configuration import read_yaml
    from app.core.errors import AcusError

    try:
        document = read_yaml(file)
    except AcusError:
        return ()  # said when it is used
    found = document.get("cameras") if isinstance(document, dict) else None
    if not isinstance(found, list):
        return ()
    return tuple(str(one["name"]) for one in found if isinstance(one, dict) and "name" in one)
