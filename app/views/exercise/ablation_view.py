"""Shows how a running attempt stands with its electrodes: on every slice, as it changes."""

from __future__ import annotations

from app.session.ablation import AblationState
from app.session.ablation_shown import AblationShown
from app.session.snapshot import Snapshot
from app.views.reading.workspace import WorkspacePage
from app.views.slices.zones import ZonesLayer


class AblationView:
    """Draws zones, margins and electrodes left in place over the panes of a workspace."""

    def __init__(self, workspace: WorkspacePage) -> None:
        self._workspace = workspace
        self._layers: dict[object, ZonesLayer] = {}
        self._drawn: AblationState | None = None

    def show(self, snapshot: Snapshot) -> None:
        """Draw the state of a snapshot; nothing where the exercise ablates nothing."""
        state = None if snapshot.procedure is None else snapshot.procedure.ablation
        if state is not self._drawn:
            self._drawn = state
            shown = None if state is None else AblationShown.of_state(state)
            for pane in self._workspace.slices:
                if pane not in self._layers:
                    self._layers[pane] = ZonesLayer(pane.canvas)
                self._layers[pane].set_shown(shown)

    def hide(self) -> None:
        """Show nothing."""
        self._drawn = None
        for layer in self._layers.values():
            layer.set_shown(None)
