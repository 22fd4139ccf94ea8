"""Where the patient is seen: the slices with their state, and the 3D view."""

from __future__ import annotations

from dataclasses import dataclass

from app.views.scene.view import SceneView
from app.views.slices.pane import SlicePane
from app.views.slices.viewing import Viewing


@dataclass(frozen=True, slots=True, eq=False)
class PatientViews:
    """What features draw on.

    Attributes:
        viewing: state of the slices of the planning CT: crosshair, window, tool, needle, plan.
        panes: axial, sagittal and coronal.
        needle_panes: those whose planes follow the needle.
        scene: the 3D view.
    """

    viewing: Viewing
    panes: tuple[SlicePane, ...]
    needle_panes: tuple[SlicePane, ...]
    scene: SceneView

    @property
    def slices(self) -> tuple[SlicePane, ...]:
        """All slice panes of the planning CT, whether the layout shows them or not."""
        return (*self.panes, *self.needle_panes)

    def refresh(self) -> None:
        """Draw every slice anew."""
        for pane in self.slices:
            pane.canvas.refresh()
