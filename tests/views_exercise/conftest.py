"""One Qt application without a display for all tests of the exercise and debrief views."""

import os
import sys
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
sys.path.insert(0, str(Path(__file__).parent))

import pytest
from modal_dialogs import forbid
from PySide6.QtWidgets import QApplication


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
