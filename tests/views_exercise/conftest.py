"""One Qt application without a display for all tests of the exercise and debrief views."""

import os
import sys
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
sys.path.insert(0, str(Path(__file__).parent))

import pytest
from PySide6.QtWidgets import QApplication


@pytest.fixture(scope="session")
def qt() -> QApplication:
    """The one application of the process."""
    application = QApplication.instance() or QApplication([])
    assert isinstance(application, QApplication)
    return application
