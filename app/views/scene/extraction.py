"""Surfaces of a patient, extracted beside the window and shown when they are there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.planning.patient import Patient
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.text import tr
from app.views.scene.view import SceneView

if TYPE_CHECKING:
    from app.views.scene.surfaces import Surfaces


class SurfaceExtraction(QObject):
    """At most one at a time: another patient ends that of the last.

    Signals:
        failed(Exception): why there are none.
    """

    failed = Signal(object)

    def __init__(self, scene: SceneView, parent: QObject) -> None:
        super().__init__(parent)
        self._scene = scene
        self._task: BackgroundTask | None = None

    @property
    def is_running(self) -> bool:
        """Whether surfaces are still to come."""
        return self._task is not None

    def start(self, patient: Patient) -> None:
        """Extract a patient's surfaces."""
        if self._task is not None:
            self._task.drop()
        self._task = run_in_background(
            self,
            lambda progress: _surfaces(patient, progress),
            self._done,
            self._fail,
            lambda: self._done(None),
        )
        self._task.progressed.connect(
            lambda share, _: self._scene.set_note(
                tr("Surfaces {percent:.0f} %", percent=100 * share)
            )
        )

    def close(self) -> None:
        """End it; idempotent."""
        if self._task is not None:
            self._task.close()
            self._task = None

    def _done(self, surfaces: Surfaces | None) -> None:
        self._task = None
        self._scene.set_note("")
        if surfaces is not None:
            self._scene.set_surfaces(surfaces)

    def _fail(self, error: Exception) -> None:
        self._done(None)
        self.failed.emit(error)


def _surfaces(patient: Patient, progress: Progress) -> Surfaces:
    with ONE_AT_A_TIME:  # VTK and scipy: behind the window, not before it
        from app.views.scene.surfaces import extract_surfaces
    return extract_surfaces(patient.volume, patient.body, progress, patient.phantom_seed)
