"""The trainer's own window in a process of its own, telling a file where its parts are.

`python -m tests.display.window_under_test FILE` is `acus run`, besides that it writes places [px of
the screen] and states as JSON. It takes no orders: whoever reads the file uses mouse and keyboard.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import QModelIndex, QPoint, QPointF, Qt, QTimer
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QFormLayout,
    QLabel,
    QLineEdit,
    QMenu,
    QMenuBar,
    QPlainTextEdit,
    QPushButton,
    QTabBar,
    QTableView,
    QTextEdit,
    QWidget,
)

from app.arm.features.arm import ArmFeature
from app.compose.desktop import Desktop
from app.core.files import write_atomically
from app.views.author.feature import AuthorFeature
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
        "things": things(window),
        "settled": window.conductor.settled,
        "axial": axial(window),
        **form(window),
        "page": type(window.pages.currentWidget()).__name__,
        "message": window.message_bar.text if not window.message_bar.isHidden() else "",
        "begin": middle(window.start_page.begin),
        "exercises": exercises(window),
        "exercise_tab": tab(window, 1),
        "start": middle(panel.buttons.start) if panel.buttons.start.isEnabled() else None,
        "start_visible": panel.buttons.start.isVisible(),
        "arm": arm(window),
        "tool": window.workspace.viewing.tool.value,
        "plan": plan(window),
        "marks": marks(window),
        "pad": pad(window),
        "touch": touch(window),
        "step": workspace.next_step.text(),
        "touch_note": panel.touch.text() if panel.touch.isVisible() else "",
        "needle_shown": workspace.viewing.needle is not None,
        "scan": scan(window),
        "scan_panel": scan_panel(window),
        "debrief_scans": window.feature(DebriefFeature).page.scans.rowCount(),
        "state": None if snapshot is None else snapshot.state.value,
        "measured": snapshot is not None and snapshot.pose.measured,
        "remaining_mm": None if snapshot is None else 1e3 * snapshot.offset.remaining,
        "off_mm": None if snapshot is None else 1e3 * snapshot.offset.lateral,
    }


def arm(window: MainWindow) -> str:
    """What the bar over the views says of the simulated arm; empty without it."""
    bar = window.feature(ArmFeature).bar
    return bar.words.text() if bar.isVisible() else ""


def axial(window: MainWindow) -> dict[str, list[float]] | None:
    """Where LPS (0, 0) of the axial pane's slice lies on the screen, and 1 mm to L and to P."""
    canvas = window.workspace.panes[0].canvas
    if canvas.plane is None or not canvas.isVisible():
        return None

    def place(x: float, y: float) -> np.ndarray:
        at = canvas.plane.point((x, y, 0.0), canvas.index)
        found = canvas.mapToGlobal(canvas.pixel_at(at.x, at.y))
        return np.array([found.x(), found.y()])

    origin = place(0.0, 0.0)
    steps = {"left": place(100.0, 0.0), "back": place(0.0, 100.0)}
    return {"origin": origin.tolist()} | {
        name: (0.01 * (there - origin)).tolist() for name, there in steps.items()
    }


def form(window: MainWindow) -> dict[str, str]:
    """What the form of an exercise says of its trials and of keeping it."""
    dialog = window.feature(AuthorFeature).dialog
    if dialog is None:
        return {"tried": "", "kept": ""}
    return {"tried": dialog.score.tried.text(), "kept": dialog.note.text()}


def things(window: MainWindow) -> list[dict[str, Any]]:
    """Everything that can be clicked or typed into: of the menu or dialog on top, else of all.

    Each with its kind, its words (its own, or the label beside it), its middle on the screen, and
    the title of the window that it is in.
    """
    popup = QApplication.activePopupWidget()
    modal = QApplication.activeModalWidget()
    tops = [popup or modal] if popup or modal else QApplication.topLevelWidgets()
    found: list[dict[str, Any]] = []
    for top in tops:
        if top is None or not top.isVisible():
            continue
        for widget in (top, *top.findChildren(QWidget)):
            if widget.window() == top and widget.isVisible() and widget.isEnabled():
                title = widget.window().windowTitle()
                found += [{**one, "window": title} for one in _things_of(widget)]
    return found


def _things_of(widget: QWidget) -> list[dict[str, Any]]:
    """What a widget offers; nothing where another one hides its middle."""

    def thing(kind: str, words: str, at: QPoint, **more: Any) -> dict[str, Any]:
        return {"kind": kind, "words": words.replace("&", ""), "at": [at.x(), at.y()], **more}

    if isinstance(widget, QMenu | QMenuBar):
        return [
            thing("entry", action.text(), widget.mapToGlobal(box.center()))
            for action in widget.actions()
            if action.isVisible()
            and action.isEnabled()
            and (box := widget.actionGeometry(action)).isValid()
        ]
    if isinstance(widget, QTabBar):
        return [
            thing("tab", widget.tabText(k), widget.mapToGlobal(widget.tabRect(k).center()))
            for k in range(widget.count())
        ]
    if isinstance(widget, QAbstractItemView):
        return _cells(widget, thing)
    if widget.visibleRegion().isEmpty():
        return []
    centre = widget.mapToGlobal(widget.visibleRegion().boundingRect().center())
    if isinstance(widget, QAbstractButton):
        words = widget.text() or widget.accessibleName() or widget.toolTip()
        return [thing("button", words, centre, on=widget.isChecked())]
    if isinstance(widget, QComboBox):
        return [thing("choice", _beside(widget), centre, value=widget.currentText())]
    if isinstance(widget, QAbstractSpinBox):
        return [thing("number", _beside(widget), centre, value=widget.text())]
    if isinstance(widget, QLineEdit) and not isinstance(widget.parent(), QAbstractSpinBox):
        return [thing("field", _beside(widget), centre, value=widget.text())]
    if isinstance(widget, QTextEdit | QPlainTextEdit):
        return [thing("text", _beside(widget), centre, value=widget.toPlainText())]
    return []


def _cells(view: QAbstractItemView, thing: Callable[..., dict[str, Any]]) -> list[dict[str, Any]]:
    """Cells of a list or table that can be seen."""
    model, found = view.model(), []
    port, root = view.viewport(), QModelIndex()
    if model is None or view.visibleRegion().isEmpty():
        return []
    for row in range(min(model.rowCount(root), 200)):
        for column in range(model.columnCount(root) if isinstance(view, QTableView) else 1):
            index = model.index(row, column)
            box = view.visualRect(index)
            words = index.data(Qt.ItemDataRole.DisplayRole)
            if box.isEmpty() or not port.rect().contains(box.center()):
                continue
            at = port.mapToGlobal(box.center())
            found.append(thing("cell", str(words or ""), at, row=row, column=column))
    return found


def _beside(widget: QWidget) -> str:
    """Words beside a field: its label's, or what it is called for who cannot see it."""
    parent = widget.parentWidget()
    for form in parent.findChildren(QFormLayout) if parent is not None else ():
        named = form.labelForField(widget)
        if isinstance(named, QLabel):
            return named.text()
    for named in parent.findChildren(QLabel) if parent is not None else ():
        if named.buddy() is widget:
            return named.text()
    if widget.accessibleName():
        return widget.accessibleName()
    return widget.placeholderText() if isinstance(widget, QLineEdit) else ""


def middle(widget: QWidget) -> list[int]:
    """Middle of a widget on the screen."""
    at = widget.mapToGlobal(widget.rect().center())
    return [at.x(), at.y()]


def exercises(window: MainWindow) -> dict[str, list[int]]:
    """Middle of each exercise's place on the start page that can be seen."""
    places = {}
    for name, place in window.start_page.map.places.items():
        if place.isVisible() and place.visibleRegion().contains(place.rect().center()):
            places[name] = middle(place)
    return places


def touch(window: MainWindow) -> dict[str, float] | None:
    """How far the tip is from the target to be touched, as pad and depth bar show it."""
    run = window.conductor.controller.run
    snapshot = None if run is None else run.trainer.snapshot()
    if run is None or snapshot is None or snapshot.touch is None:
        return None
    stands, pose = snapshot.touch, snapshot.pose
    scene = run.scene(stands.aim)
    handle, way = scene.handle, 1e3 * (stands.aim.p_target - pose.p_tip)
    assert handle is not None
    return {
        "touched": stands.touched,
        "of": len(stands.task),
        "right_mm": float(way @ scene.frame.right),
        "up_mm": float(way @ scene.frame.up),
        "along_mm": float(way @ pose.axis),
        "depth_mm": 1e3 * pose.depth,
        "outside_mm": 1e3 * handle.outside(pose.depth),
        "radius_px": window.workspace.bullseye.pad.area.radius,
        "reach_mm": 1e3 * handle.reach,
    }


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
