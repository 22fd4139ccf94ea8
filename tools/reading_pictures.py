"""Makes the pictures of reading, planning, structures, scanning, privacy and PACS.

Part of `make docs-pictures`. `python -m tools.reading_pictures FOLDER [PART…]` opens the window in
memory on the chest CT of the test data; without it on the built-in phantom, and says so. The
attempt stands still in virtual time, so that the pictures come out the same every time. It wants
settings and data folders of its own (`ACUS_SETTINGS`, `ACUS_DATA`).
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Sequence
from math import radians
from pathlib import Path

import numpy as np
from PySide6.QtWidgets import QScrollArea

from app.imaging.structures.edit import brushed
from app.imaging.structures.structure import Structure, StructureKind
from app.imaging.window import WindowLevel
from app.planning.measurements import Angle, Distance, Probe, Region
from app.views.measure.feature import MeasureFeature
from app.views.plan.feature import PlanFeature
from app.views.plan.paths import PathsFeature
from app.views.shell.application import start
from app.views.slices.panes import PaneId
from app.views.slices.presentation import OperatorSide, Presentation, Slab
from app.views.slices.turning import StartingPlanes, straighten, turn_planes
from app.views.structures.feature import StructuresFeature
from tools.dialog_pictures import pacs, report, series
from tools.docs_pictures import CHEST
from tools.reading_studio import Studio, chest_of
from tools.robot_pictures import pause, wait

LUNG = WindowLevel(1500.0, -600.0)


def structures(studio: Studio) -> None:
    """Make ribs by threshold, a lesion and a vessel by the brush; show the path's distances."""
    window = studio.window
    desk, draft = window.feature(StructuresFeature), window.editor.edit.draft
    if draft.target_mm is None or draft.entry_mm is None:
        raise RuntimeError("there is no plan to measure structures against")
    target, entry = np.array(draft.target_mm), np.array(draft.entry_mm)
    desk.brush.set(low=250.0, high=3000.0)
    desk.threshold()
    wait(lambda: len(desk.book.structures) == 1)
    desk.book.change(
        desk.book.structures.structures[0].name, name="Bones", kind=StructureKind.BONE, warn_mm=2.0
    )
    _paint(studio, "Lesion", [target], 9.0, StructureKind.TARGET, 0.0)
    along = np.linspace(-30.0, 30.0, 31)[:, None] * np.array([0.55, 0.35, 0.75])
    _paint(
        studio,
        "Hepatic vein",
        0.4 * entry + 0.6 * target + [13.0, 4.0, 0.0] + along,
        4.0,
        StructureKind.VESSEL,
        10.0,
    )
    wait(lambda: desk.is_settled)
    window.workspace.side.setCurrentWidget(desk.panel)
    window.workspace.show_layout("1+3")
    studio.zoom(2.6)
    studio.keep_window("structures-distance")


def _paint(
    studio: Studio,
    name: str,
    dabs: Sequence[np.ndarray],
    radius: float,
    kind: StructureKind,
    warn: float,
) -> None:
    book = studio.window.editors.structures
    if book.volume is None:
        raise RuntimeError("no patient is shown: there is nothing to paint on")
    painted: Structure | None = None
    for dab in dabs:
        found = brushed(painted, book.volume, dab, radius, add=True)
        if found is not None:
            book.put(name, *found, starts_step=painted is None)
        painted = book.structures.find(name)
    book.change(name, kind=kind, warn_mm=warn)


def entry_map(studio: Studio) -> None:
    """Score every path to the target and look at one."""
    window = studio.window
    window.feature(PathsFeature).make()
    wait(lambda: window.feature(PathsFeature).scores is not None)
    side, plan = window.workspace.side, window.feature(PlanFeature).panel
    scroller = next(area for area in window.findChildren(QScrollArea) if area.widget() is plan)
    side.setCurrentWidget(scroller)
    table = window.feature(PathsFeature).panel.table
    table.selectRow(0)
    pause(0.3)
    scroller.ensureWidgetVisible(window.feature(PathsFeature).panel.take)
    studio.zoom(2.0)
    studio.keep_window("planning-map")
    window.feature(PathsFeature).clear()
    window.view_menu.cursor_to_target()
    for structure in tuple(window.editors.structures.structures):
        window.editors.structures.remove(structure.name)


def measurements(studio: Studio) -> None:
    """Take one of each kind, with their list."""
    workspace, editor = studio.window.workspace, studio.window.editors.measures
    x, y, z = workspace.viewing.cursor_mm.tolist()
    editor.add(Distance((x - 42.0, y + 5.0, z), (x + 40.0, y + 5.0, z), "Across"))
    editor.add(Angle((x - 40.0, y - 40.0, z), (x, y, z), (x - 5.0, y - 62.0, z), "To the skin"))
    editor.add(Probe((x + 30.0, y + 20.0, z), "Point"))
    editor.add(Region((x - 20.0, y + 30.0, z), (22.0, 0.0, 0.0), (0.0, 14.0, 0.0), "Liver"))
    studio.window.feature(MeasureFeature).show()
    studio.zoom(2.6)
    studio.keep_window("planning-measurements")
    editor.clear()
    workspace.show_layout("2x2")
    for pane in workspace.panes:
        pane.reset()


def layouts(studio: Studio) -> None:
    """Go through every layout, without and with the bull's-eye, and maximise a pane."""
    workspace = studio.window.workspace
    for name, word in (
        ("2x2", "four"),
        ("1+3", "one-and-three"),
        ("6-up", "six"),
        ("needle", "needle"),
    ):
        workspace.show_layout(name)
        for bullseye in (False, True):
            workspace.show_bullseye(bullseye)
            studio.keep(f"reading-{word}" + ("-bullseye" if bullseye else ""))
    workspace.show_bullseye(False)
    workspace.show_layout("2x2")
    pane = workspace.panes[0]
    pane.maximise_wanted.emit()
    studio.keep("reading-maximised")
    pane.maximise_wanted.emit()


def room(studio: Studio) -> None:
    """Set up a left-handed desk, then a projector."""
    workspace, projector = studio.window.workspace, studio.window.projector
    workspace.set_left_handed(True)
    studio.keep_window("reading-left-handed")
    workspace.set_left_handed(False)
    projector.set_all(True)
    studio.keep_window("reading-projector")
    projector.set_all(False)


def looks(studio: Studio) -> None:
    """Show slabs, oblique planes, and the operator's side."""
    viewing = studio.window.workspace.viewing
    window = viewing.window
    viewing.set_window(LUNG)
    viewing.set_presentation(PaneId.AXIAL, Presentation(slab=Slab("mip", 20.0)))
    viewing.set_presentation(PaneId.CORONAL, Presentation(slab=Slab("minip", 20.0)))
    target = viewing.cursor_mm
    viewing.set_cursor((55.0, 140.0, target[2] + 90.0))
    studio.keep("reading-slab")
    for pane in (PaneId.AXIAL, PaneId.CORONAL):
        viewing.set_presentation(pane, Presentation())
    viewing.set_window(window)
    viewing.set_cursor(target)
    turned = (PaneId.SAGITTAL, PaneId.CORONAL)
    turn_planes(viewing, StartingPlanes.of(viewing, turned), (0.0, 0.0, 1.0), radians(24.0))
    studio.keep("reading-oblique")
    straighten(viewing)
    side = studio.window.view_menu.operator[OperatorSide.HEAD]
    side.trigger()
    studio.keep("reading-operator")
    studio.window.view_menu.operator[OperatorSide.CONVENTION].trigger()


def scanning(studio: Studio) -> None:
    """Take a control scan in an assessment: nothing live, three slices."""
    window, panel = studio.window, studio.window.workspace.exercise_panel
    window.conductor.controller.abort()
    studio.trainer.step()  # time stands still: nobody else ends the attempt
    pause(1.0)
    studio.begin("scans-only")
    studio.insert(0.75)
    window.workspace.show_exercise()
    panel.scan.table.setValue(float(window.workspace.viewing.cursor_mm[2]))
    panel.buttons.scan_requested.emit()
    wait(lambda: window.workspace.scan_view.scan is not None)
    studio.trainer.step()  # the panel counts it
    window.workspace.show_layout("2x2")
    studio.keep_window("reading-control-scan")


PLANNING = {"structures": structures, "map": entry_map, "measurements": measurements}
READING = {"layouts": layouts, "room": room, "looks": looks}
REST = {"scanning": scanning, "series": series, "report": report, "pacs": pacs}


def main(folder: Path, parts: Sequence[str]) -> None:
    """Make them all, or those of some parts."""
    application = start(offscreen=True)
    wanted = set(parts or (*PLANNING, *READING, *REST))
    with tempfile.TemporaryDirectory() as sessions:
        studio = Studio(folder, Path(sessions), chest_of(CHEST))
        try:
            studio.begin("first-insertion")
            for table in (PLANNING, READING, REST):
                if table is READING and wanted & READING.keys():
                    studio.insert()
                for name, make in table.items():
                    if name in wanted:
                        make(studio)
        finally:
            studio.window.editor.saved(Path("kept"))
            studio.window.close()
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
