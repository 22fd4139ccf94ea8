"""What an exercise says of how it is read: taken as a beginning, or held while it is open."""

from __future__ import annotations

from app.exercises.reading import ReadingPart
from app.views.workspace import Workspace


def let_go(workspace: Workspace) -> None:
    """End what the last exercise held: the user may change everything again."""
    workspace.viewing.greys.fix(False)
    workspace.fix_layout(False)


def apply(workspace: Workspace, part: ReadingPart) -> None:
    """Read as an exercise says; what it locks cannot be changed until `let_go`."""
    let_go(workspace)
    greys, window = workspace.viewing.greys, part.window_level
    if window is not None:
        greys.set_locked(False)
        greys.set(window)
        greys.fix(part.locked)
    if part.layout is not None:
        workspace.show_layout(part.layout)
        workspace.fix_layout(part.locked)
