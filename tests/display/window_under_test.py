"""The trainer's own window in a process of its own, telling a file where its parts are.

`python -m tests.display.window_under_test FILE` is `acus run`, besides that it writes places [px of
the screen] and states as JSON. It takes no orders: whoever reads the file uses mouse and keyboard.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import QPointF, Qt, QTimer
from PySide6.QtWidgets import QPushButton, QWidget

from app.compose.desktop import Desktop
from app.core.files import write_atomically
from app.views.debrief.feature import DebriefFeature
from app.views.shell.application import start
from app.views.shell.collector import collect_for
from app.views.shell.window import MainWindow
from tests.display.scan_reading import remaining_mm

PERIOD_MS = 100


def main() -> None:
    """Run the window until it is closed."""
    report = Path(sys.argv[1])
    application = start()
    window = MainWindow(Desktop())
    collector = collect_for(window)
    window.show()
    timer = QTimer(window, interval=PERIOD_MS)
    timer.timeout.connect(lambda: write_atomically(report, json.dumps(state_of(window)).encode()))
    timer.start()
    code = application.exec()
    collector.close()
    sys.exit(code)


def state_of(window: MainWindow) -> dict[str, Any]:
    """Places and states of what a user would look at."""
    workspace, run = window.workspace, window.conductor.controller.run
    snapshot = None if run is None else run.trainer.snapshot()
    panel = workspace.exercise_panel
    return {
        "settled": window.conductor.settled,
        "page": type(window.pages.currentWidget()).__name__,
        "message": window.message_bar.text if not window.message_bar.isHidden() else "",
        "begin": middle(window.start_page.begin),
        "exercises": exercises(window),
        "exercise_tab": tab(window, 1),
        "start": middle(panel.buttons.start) if panel.buttons.start.isEnabled() else None,
        "start_visible": panel.buttons.start.isVisible(),
        "tool": window.workspace.viewing.tool.value,
        "plan": plan(window),
        "marks": marks(window),
        "pad": pad(window),
        "needle_shown": workspace.viewing.needle is not None,
        "scan": scan(window),
        "scan_panel": scan_panel(window),
        "debrief_scans": window.feature(DebriefFeature).page.scans.rowCount(),
        "state": None if snapshot is None else snapshot.state.value,
        "measured": snapshot is not None and snapshot.pose.measured,
        "remaining_mm": None if snapshot is None else 1e3 * snapshot.offset.remaining,
        "off_mm": None if snapshot is None else 1e3 * snapshot.offset.lateral,
    }


def middle(widget: QWidget) -> list[int]:
    """Middle of a widget on the screen."""
    at = widget.mapToGlobal(widget.rect().center())
    return [at.x(), at.y()]


def exercises(window: MainWindow) -> dict[str, list[int]]:
    """Middle of each exercise's row on the start page that can be seen."""
    rows, places = window.start_page.exercises, {}
    for number in range(rows.count()):
        item = rows.item(number)
        box = rows.visualItemRect(item)
        if rows.viewport().rect().contains(box.center()):
            at = rows.viewport().mapToGlobal(box.center())
            places[item.data(Qt.ItemDataRole.UserRole)] = [at.x(), at.y()]
    return places


def scan_panel(window: MainWindow) -> dict[str, Any] | None:
    """Where the scanner's controls lie, and what they say."""
    panel = window.workspace.exercise_panel.scan
    if not panel.isVisible():
        return None
    parts = {name: middle(getattr(panel, name)) for name in ("head", "feet", "here", "slices")}
    return parts | {
        "centre_mm": panel.order.centre_mm,
        "number": panel.order.slices,
        "count": panel.count.text(),
    }


def scan(window: MainWindow) -> dict[str, Any] | None:
    """What eyes read off the slices of the last scan: where along the plan the metal ends."""
    view, draft = window.workspace.scan_view, window.editor.edit.draft
    volume = view.viewing.volume
    if view.scan is None or volume is None or not (draft.entry_mm and draft.target_mm):
        return None
    remaining = remaining_mm(volume, draft.entry_mm, draft.target_mm)
    return {
        "number": view.scan.number,
        "slices": volume.size[2],
        "remaining_mm": remaining,
    }


def tab(window: MainWindow, number: int) -> list[int]:
    """Middle of a panel's name beside the panes."""
    names = window.workspace.side.findChildren(QPushButton, "side-name")
    return middle(names[number])


def plan(window: MainWindow) -> dict[str, Any]:
    """Points of the plan and whether the robot can follow."""
    draft = window.editor.edit.draft
    return {
        "entry_mm": draft.entry_mm,
        "target_mm": draft.target_mm,
        "reachable": window.editor.verdict.placed is not None,
    }


def marks(window: MainWindow) -> dict[str, list[int]]:
    """Where entry and target of the plan lie in the axial pane."""
    canvas, draft = window.workspace.panes[0].canvas, window.editor.edit.draft
    places = {}
    for name, point in (("entry", draft.entry_mm), ("target", draft.target_mm)):
        if point is not None and canvas.plane is not None:
            at = canvas.plane.point(point, canvas.index)
            place = canvas.mapToGlobal(canvas.pixel_at(at.x, at.y))
            places[name] = [round(place.x()), round(place.y())]
    return places


def pad(window: MainWindow) -> dict[str, list[float]] | None:
    """Middle of the bull's-eye, its radius, and where the hand stands on it."""
    run, bullseye = window.conductor.controller.run, window.workspace.bullseye
    hand = bullseye.hand
    if run is None or hand is None or not bullseye.isVisible():
        return None
    scene, area = run.scene(), bullseye.pad.area
    tilts = np.asarray(scene.frame.tilts(hand.direction))
    places = (area.point(scene.scale.place(tilts)), area.centre)
    at, centre = (bullseye.pad.mapToGlobal(QPointF(place)) for place in places)
    return {"hand": [at.x(), at.y()], "centre": [centre.x(), centre.y()]}


if __name__ == "__main__":
    main()
