"""Windows in processes of their own, scaled: click on what is seen and tell where that arrived.

`scaled_window.py [[FACTOR, WIDTH, HEIGHT], …]`, run by `test_views_scaling`: Qt takes its factor
once in a process, so that each window has one, forked when everything is loaded.
"""

import json
import os
import sys
import tempfile
import traceback
from pathlib import Path
from time import monotonic

os.environ["QT_QPA_PLATFORM"] = "offscreen"
sys.path.insert(0, str(Path(__file__).parents[1] / "views_exercise"))
sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from conftest import series_of
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from window_rig import FakeServices

from app.imaging.body import find_body
from app.imaging.volume import Volume
from app.imaging.window import WindowLevel
from app.planning.draft import DraftPlan
from app.planning.patient import Patient
from app.views.kit.theme import apply_theme
from app.views.shell.window import MainWindow
from app.views.slices.presentation import Presentation, Turn
from app.views.slices.viewing import Tool

BEAD = np.array([41, 25, 17])


def patient():
    """A block of tissue with one bright bead of 3 voxels."""
    hu = np.full((40, 60, 64), -1000, np.int16)
    hu[2:-2, 8:-8, 8:-8] = 40
    i, j, k = BEAD
    hu[k - 1 : k + 2, j - 1 : j + 2, i - 1 : i + 2] = 3000
    affine = np.diag([0.8, 1.0, 2.0, 1.0])
    affine[:3, 3] = (-20.0, -30.0, 100.0)
    volume = Volume(hu, affine, series_of(hu))
    return Patient(volume, find_body(volume), "CT-TEST")


def seen_bead(pane):
    """Where the bead is seen in the pane [px of the window's own scale]."""
    shot = pane.canvas.grab().toImage().convertToFormat(QImage.Format.Format_RGB32)
    raw = np.frombuffer(shot.constBits(), np.uint8).reshape(shot.height(), shot.width(), 4)
    rows, columns = np.nonzero((raw[..., :3] >= 254).all(axis=2))
    return QPoint(*(round(at / shot.devicePixelRatio()) for at in (columns.mean(), rows.mean())))


def click(window, pane, target):
    """Place the target with a click through the window system; how far off the bead it is [mm]."""
    placed = []
    viewing = window.workspace.viewing
    viewing.set_draft(DraftPlan())  # the mark of the last click covers the bead
    viewing.set_cursor(target)
    end = monotonic() + 10.0
    while not pane.canvas.is_settled and monotonic() < end:
        QTest.qWait(30)
    at = pane.canvas.mapTo(window, seen_bead(pane))
    viewing.set_tool(Tool.TARGET)
    take = lambda tool, point, _: placed.append(point)  # noqa: E731
    viewing.point_placed.connect(take)
    QTest.mouseClick(window.windowHandle(), Qt.MouseButton.LeftButton, pos=at)
    QTest.qWait(10)
    viewing.point_placed.disconnect(take)
    viewing.set_tool(Tool.NAVIGATE)
    return float(np.linalg.norm(np.subtract(placed[0], target))) if placed else 1e9


def outside(window):
    """Widgets that are seen and stick out of the window."""
    rect = window.rect()
    return [
        type(child).__name__
        for child in (*window.workspace.panes, window.workspace.side, window.workspace.status)
        if isinstance(child, QWidget) and child.isVisible()
        and not rect.contains(child.rect().translated(child.mapTo(window, QPoint())))
    ]  # fmt: skip


def main(width, height):
    """Print what was found as JSON."""
    application = QApplication([])
    apply_theme(application)
    with tempfile.TemporaryDirectory() as folder:
        os.environ["ACUS_SETTINGS"] = folder
        window = MainWindow(FakeServices(Path(folder)))
        window.resize(width, height)
        window.show()
        shown = patient()
        target = shown.volume.lps_mm(BEAD)
        window.show_patient(shown)
        viewing = window.workspace.viewing
        viewing.set_window(WindowLevel(100, 2500))
        QTest.qWait(50)
        found = {"ratio": window.devicePixelRatioF(), "size": window.size().toTuple(),
                 "outside": outside(window), "off_mm": []}  # fmt: skip
        for turn in (Turn(), Turn(1, True)):
            for pane in window.workspace.panes:
                viewing.set_presentation(pane.pane, Presentation(turn=turn))
                found["off_mm"].append(click(window, pane, target))
        print(json.dumps(found), flush=True)
    os._exit(0)


def each(screens):
    """Show one after the other, each in a child; ends with the code of the last that fails."""
    code = 0
    for factor, width, height in screens:
        child = os.fork()
        if child == 0:
            os.environ["QT_SCALE_FACTOR"] = str(factor)
            try:
                main(width, height)
            finally:  # it ends itself where all is well
                traceback.print_exc()
                os._exit(1)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) or code
    return code


if __name__ == "__main__":
    sys.exit(each(json.loads(sys.argv[1])))
