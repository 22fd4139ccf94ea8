"""What an exercise says of how it is read: taken as a beginning, or held while it is open."""

from __future__ import annotations

from dataclasses import replace

from app.exercises.locks import Lock
from app.exercises.schema import Exercise
from app.views.reading.layouts import FOUR
from app.views.reading.workspace import WorkspacePage
from app.views.slices.panes import PaneId
from app.views.slices.presentation import Slab
from app.views.slices.presets import default_window


def let_go(workspace: WorkspacePage) -> None:
    """End what the last exercise held: the user may change everything again."""
    workspace.viewing.greys.fix(False)
    workspace.viewing.fix_slabs(False)
    workspace.fix_layout(False)


def apply(workspace: WorkspacePage, exercise: Exercise) -> None:
    """Read as an exercise says; what it locks cannot be changed until `let_go`.

    Where it locks the reading as a whole, what it does not say is as at the program's first start;
    else that is left as the student has it.
    """
    let_go(workspace)
    part, whole = exercise.reading, Lock.READING in exercise.locked
    window, layout, slab = part.window_level, part.layout, part.slab
    viewing, greys = workspace.viewing, workspace.viewing.greys
    if whole or window is not None:
        greys.set_locked(False)
        greys.set(window or default_window())
        greys.fix(whole or part.locked)
    if whole or slab is not None:
        wanted = Slab() if slab is None else Slab(slab.kind, slab.thickness_mm)
        for pane in PaneId:
            viewing.set_presentation(pane, replace(viewing.presentation(pane), slab=wanted))
        viewing.fix_slabs(whole or part.locked)
    if whole or layout is not None:
        workspace.show_layout(layout or FOUR.name)
        workspace.fix_layout(whole or part.locked)
