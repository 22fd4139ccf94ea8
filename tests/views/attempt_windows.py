"""An attempt in a whole window: what share of it the pictures have, and what is amiss.

`attempt_windows.py [[FACTOR, WIDTH, HEIGHT], …]` judges windows in processes of their own, scaled;
run by `test_views_attempt_room`.
"""

import json
import os
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

if __name__ == "__main__":
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    sys.path.insert(0, str(Path(__file__).parents[1] / "views_exercise"))
    sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from PySide6.QtCore import QPoint, QRect
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QPushButton, QScrollArea

from app.exercises.library import load_exercise
from app.session.curves import offset
from app.session.machine import State
from app.session.snapshot import BreathHold
from app.views.exercise.feature import ExerciseFeature
from app.views.kit import theme
from app.views.kit.parts import FittingButton
from app.views.slices.viewing import Tool

LEADING = 4
"""Between the lines of a text, above the first and below the last, nothing is drawn [px]."""

DEEP_M = 0.0888
DEPTH_TEXT = "88.8 mm"
LONG_ORDER = "The patient breathes freely (A releases, A asks again): "

SHARES = {"ct": 0.60, "rail": 0.18, "bullseye": 0.20}
"""Of the window: at least of its area; at most of its width; at most of its width."""


def begun(window, patient, start=True):
    """Open an exercise on a patient, and begin an attempt."""
    window.conductor.set_exercise(load_exercise("first-insertion"))
    window.show_patient(patient)
    window.show_workspace()
    low, high = patient.volume.lps_mm((0, 0, 0)), patient.volume.lps_mm(patient.volume.size)
    x, y, z = (low + high) / 2.0
    top = float(patient.volume.lps_mm((0, 8, 0))[1])
    window.editor.place(Tool.ENTRY, (x, top, z), True)
    window.editor.place(Tool.TARGET, (x, y, z), True)
    window.show()
    for _ in range(400):
        if window.runs.run is not None:
            break
        QTest.qWait(20)
    assert window.runs.run is not None
    if start:
        under_way(window)


def under_way(window):
    """Begin an attempt by its button, and let the needle be deep, aside, pushed against, and the
    breath not held: every number and the longest order are painted.
    """
    trainer, plain = window.runs.run.trainer, window.runs.run.trainer.snapshot

    def deep():
        made, placed = plain(), trainer.placed
        away = np.cross(placed.axis, [1.0, 0.0, 0.0])
        axis = placed.axis + 0.2 * away / np.linalg.norm(away)
        axis /= np.linalg.norm(axis)
        tip = placed.p_entry + DEEP_M * axis
        pose = replace(made.pose, p_tip=tip, axis=axis, depth=DEEP_M)
        made.device.felt[:] = (0.0, 3.0, 3.8)
        return replace(
            made, pose=pose, measured_pose=pose, offset=offset(pose, placed.p_target, placed),
            elapsed=754.0, scans=12, breath=BreathHold(asked=True, spent=True),
        )  # fmt: skip

    window.feature(ExerciseFeature).beginning.trust(window.conductor.exercise.id)
    window.workspace.exercise_panel.buttons.start.click()
    assert window.conductor.controller.is_running
    trainer.snapshot, trainer.state = deep, State.INSERTING
    rail = window.workspace.rail
    for _ in range(100):
        if LONG_ORDER in rail.order.text() and DEPTH_TEXT in texts(rail):
            break
        QTest.qWait(20)
    QTest.qWait(60)
    assert LONG_ORDER in rail.order.text()
    assert {DEPTH_TEXT, "12:34", "12"} <= set(texts(rail))
    assert rail.force.accessibleName() or rail.force.isVisible()


def texts(rail):
    """Return what is to be read on labels of the rail."""
    return [label.text() for label in rail.findChildren(QLabel) if label.isVisible()]


def place(window, widget):
    """Rectangle of a widget in the window, as far as it is seen there."""
    rect = QRect(widget.mapTo(window, QPoint()), widget.size())
    return rect.intersected(window.rect())


def judged(window, large=False):
    """Say what is wrong with an attempt in this window."""
    workspace, wrong = window.workspace, []
    seen = [pane for pane in workspace.slices if pane.isVisible()]
    rects = [place(window, pane) for pane in seen]
    area = sum(rect.width() * rect.height() for rect in rects)
    share = area / (window.width() * window.height())
    rail = place(window, workspace.rail)
    cell = place(window, workspace.needle_cell)
    if share < SHARES["ct"]:
        wrong.append(f"the CT has {share:.3f}")
    if rail.width() > SHARES["rail"] * window.width():
        wrong.append(f"the rail has {rail.width()}")
    if cell.width() > SHARES["bullseye"] * window.width() or not workspace.bullseye.isVisible():
        wrong.append(f"the bull's-eye has {cell.width()}")
    if not workspace.scene.isVisible():
        wrong.append("no 3D")
    if rail.width() % 8:
        wrong.append("the rail is off the grid")
    if place(window, workspace).bottom() > window.height():
        wrong.append("below the window")
    inner = workspace.rail.findChild(QScrollArea).widget()
    if inner.width() > workspace.rail.width():
        wrong.append(f"the rail's parts want {inner.width()}")
    everything = [*rects, rail, cell, place(window, workspace.scene)]
    for i, rect in enumerate(everything):
        wrong += ["panes overlap" for other in everything[:i] if rect.intersects(other)]
    sizes = {theme.SMALL_PX, theme.FONT_PX, theme.TITLE_PX}
    for label in workspace.rail.findChildren(QLabel):
        if label.isVisible() and label.text():
            if label.fontInfo().pixelSize() not in sizes:
                wrong.append(f"{label.text()!r} in {label.fontInfo().pixelSize()} px")
            if not label.wordWrap() and label.sizeHint().width() > label.width() + 1:
                wrong.append(f"{label.text()!r} is cut")
            if label.wordWrap() and label.heightForWidth(label.width()) > label.height() + LEADING:
                wrong.append(f"{label.text()!r} is cut below")
    for button in workspace.rail.findChildren(QPushButton):
        lost = button.sizeHint().width() > button.width() + 1
        if isinstance(button, FittingButton):  # its key in brackets may go, letters may not
            lost = "…" in button.text()
        if button.isVisible() and lost:
            wrong.append(f"{button.text()!r} is cut")
    return wrong


def main(factor, width, height):
    """Print what is wrong with a window as JSON."""
    os.environ["QT_SCALE_FACTOR"] = str(factor)
    from PySide6.QtWidgets import QApplication
    from scaled_window import patient
    from window_rig import FakeServices

    from app.views.shell.window import MainWindow

    application = QApplication([])
    theme.apply_theme(application)
    with tempfile.TemporaryDirectory() as folder:
        os.environ["ACUS_SETTINGS"] = folder
        window = MainWindow(FakeServices(Path(folder)))
        window.resize(width, height)
        begun(window, patient())
        found = {"ratio": window.devicePixelRatioF(), "wrong": judged(window)}
        print(json.dumps(found), flush=True)
    os._exit(0)


def each(screens):
    """Judge one after the other, each in a child; returns the code of the last that fails."""
    code = 0
    for screen in screens:
        child = os.fork()
        if child == 0:
            try:
                main(*screen)
            except BaseException as error:  # a child never goes on as its parent
                print(repr(error), file=sys.stderr, flush=True)
                os._exit(1)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) or code
    return code


if __name__ == "__main__":
    sys.exit(each(json.loads(sys.argv[1])))
