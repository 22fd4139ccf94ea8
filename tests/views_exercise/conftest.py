"""One Qt application without a display for all tests of the exercise and debrief views."""

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
sys.path.insert(0, str(Path(__file__).parent))

import pytest
from modal_dialogs import forbid
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication
from views_exercise_fakes import FakeTrainer, run

from app.core.clock import VirtualClock
from app.views.exercise.axial_gauge import AxialGauge
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.controller import ExerciseController, ExerciseViews
from app.views.exercise.panel import ExercisePanel
from app.views.exercise.status import MessageList, StatusStrip
from app.views.exercise.tracker_panel import TrackerPanel


@pytest.fixture(autouse=True)
def nothing_waits_for_a_person(monkeypatch: pytest.MonkeyPatch) -> None:
    """A dialog that nobody answers fails the test."""
    forbid(monkeypatch)


@pytest.fixture(scope="session")
def qt() -> QApplication:
    """The one application of the process."""
    application = QApplication.instance() or QApplication([])
    assert isinstance(application, QApplication)
    return application


@pytest.fixture(autouse=True)
def widgets_go_with_their_test(qt: QApplication) -> Iterator[None]:
    """Let Qt destroy what was put off with `deleteLater`, while Python still holds what is in it.

    Without an event loop Qt never does; the garbage collector then takes the pages, some test
    later, in an order of its own: pyqtgraph's items before the scenes that hold them.
    """
    yield
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


@pytest.fixture
def desk(qt: QApplication) -> Iterator[SimpleNamespace]:
    """A controller with its views and a fake trainer, in virtual time, read at by hand."""
    views = ExerciseViews(
        Bullseye(), ExercisePanel(), StatusStrip(), TrackerPanel(), MessageList(), AxialGauge()
    )  # fmt: skip
    controller = ExerciseController(views, VirtualClock(10.0))
    trainer = FakeTrainer()
    controller.attach(run(trainer))
    controller._timer.stop()  # read at by hand
    yield SimpleNamespace(controller=controller, views=views, trainer=trainer)
    controller.detach()
    for name in ExerciseViews.__slots__:
        getattr(views, name).deleteLater()
