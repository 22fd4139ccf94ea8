"""One application for all tests of the views, small volumes, and what tests leave behind."""

import os
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
sys.path.insert(0, str(Path(__file__).parent))
sys.path.insert(0, str(Path(__file__).parents[1] / "views_exercise"))

from modal_dialogs import forbid
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication, QWidget
from window_rig import FakeServices, RealRuns, plan

from app.imaging.body import find_body
from app.imaging.series import Series
from app.imaging.volume import Volume
from app.planning.patient import Patient
from app.planning.plan import Plan
from app.views.exercise.feature import ExerciseFeature
from app.views.kit.theme import apply_theme
from app.views.shell.window import MainWindow

Settle = Callable[..., bool]

PATIENCE_S = 60.0
"""A busy machine takes its time; only a test that fails waits for so long."""
PAUSE_S = 0.05


@pytest.fixture(scope="session")
def application() -> QApplication:
    existing = QApplication.instance()
    app = existing if isinstance(existing, QApplication) else QApplication([])
    apply_theme(app)
    return app


@pytest.fixture(autouse=True)
def nothing_waits_for_a_person(monkeypatch: pytest.MonkeyPatch) -> None:
    forbid(monkeypatch)


@pytest.fixture(autouse=True)
def no_window_is_left_open(application: QApplication) -> Iterator[None]:
    before = set(application.topLevelWidgets())
    yield
    for widget in set(application.topLevelWidgets()) - before:
        widget.close()
        widget.deleteLater()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    application.processEvents()
    left = [w for w in set(application.topLevelWidgets()) - before if w.isVisible()]
    assert not left, f"windows left open: {left}"


@pytest.fixture
def settle(application: QApplication) -> Settle:
    def process(until: Callable[[], bool] | None = None, timeout: float | None = None) -> bool:
        """Let the window live until something is so, or for a moment; returns whether it is so."""
        patience = timeout or (PAUSE_S if until is None else PATIENCE_S)
        end = time.monotonic() + patience
        while not (until and until()) and time.monotonic() < end:
            application.processEvents()
            time.sleep(0.002)
        return until is not None and until()

    return process


@pytest.fixture
def destroy() -> Iterator[Callable[[QWidget], None]]:
    """Register a widget to be destroyed while Python still holds all that belongs to it.

    pyqtgraph's items crash Qt when the garbage collector takes their wrappers first.
    """
    kept: list[QWidget] = []
    yield kept.append
    for widget in kept:
        if isinstance(widget, MainWindow):
            widget.feature(ExerciseFeature).may_quit = lambda: True
        widget.close()
        widget.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def series_of(hu: NDArray[np.generic]) -> Series:
    depth, height, width = hu.shape
    return Series(
        uid="1.2.3", modality="CT", label="test", size=(width, height, depth),
        spacing_mm=None, origin_mm=None, direction=None, usable=True, reason="", slices=(),
        pseudonym="CT-TEST", frame_of_reference="1.2", windows=((300.0, 30.0),),
    )  # fmt: skip


def box_volume(shape: tuple[int, int, int] = (40, 60, 64)) -> Volume:
    """Air with a block of tissue and a rod of bone; 0.8 × 1.0 × 2.0 mm, supine, head first."""
    hu = np.full(shape, -1000, np.int16)
    hu[2:-2, 12:-12, 10:-10] = 40
    hu[4:-4, 28:34, 28:36] = 700
    affine = np.diag([0.8, 1.0, 2.0, 1.0])
    affine[:3, 3] = (-20.0, -30.0, 100.0)
    return Volume(hu, affine, series_of(hu))


@pytest.fixture
def volume() -> Volume:
    return box_volume()


@pytest.fixture
def services(tmp_path):
    return FakeServices(tmp_path)


@pytest.fixture
def window(application, services, destroy):
    window = MainWindow(services)
    destroy(window)
    window.show()
    yield window
    window.editor.saved(Path("kept"))


@pytest.fixture
def patient(volume):
    return Patient(volume, find_body(volume), "CT-TEST")


@pytest.fixture
def real(application, tmp_path, destroy, patient, settle):
    """A window with the real trainer, loop and simulated cameras, and a run on a plan."""
    window = MainWindow(RealRuns(tmp_path / "sessions"))
    destroy(window)
    window.show()
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.workspace.exercise_panel.set_student("S1")
    yield window
    window.editor.saved(None)


@pytest.fixture
def beginning(window, patient, monkeypatch, settle):
    """What leads to the attempt; every phantom comes at once, as the tests' own patient."""
    window.resize(1366, 768)
    window.show()
    window.activateWindow()
    settle(window.isActiveWindow)

    def opened(seed=1):
        window.show_patient(replace(patient, phantom_seed=seed))

    monkeypatch.setattr(window.open_ct, "open_phantom", opened)
    given = Plan((5.0, -18.0, 140.0), (5.0, 5.0, 140.0), "phantom")
    monkeypatch.setattr("app.exercises.scene.plan_of", lambda _: given)
    return window.feature(ExerciseFeature).beginning
