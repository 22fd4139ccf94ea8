"""The grid on the skin in the 3D view: looked for beside the window, shown when it is there."""

from __future__ import annotations

from PySide6.QtCore import QObject

from app.imaging.skin_grid import SkinGrid
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.scene.guides import GRID, Guides, grid_guides
from app.views.scene.view import SceneView


class GridScene(QObject):
    """Keeps the 3D view's grid and laser as the slices have them; one search at a time."""

    def __init__(self, scene: SceneView, parent: QObject) -> None:
        super().__init__(parent)
        self._scene = scene
        self._wanted: tuple[SkinGrid, float | None] | None = None
        self._task: BackgroundTask | None = None

    def show(self, grid: SkinGrid | None, table_mm: float | None) -> None:
        """Show a grid, and the laser at a table position [mm]; None shows nothing."""
        wanted = None if grid is None else (grid, table_mm)
        if wanted == self._wanted:
            return
        had, self._wanted = self._wanted, wanted
        if had is None or wanted is None or had[0] is not wanted[0]:
            self.close()  # of another patient, or another grid
            self._scene.set_guides(GRID, None)
        self._look()

    def close(self) -> None:
        """End a search; idempotent."""
        if self._task is not None:
            self._task.close()
            self._task = None

    def _look(self) -> None:
        """Look for the newest that is wanted, once the last search has ended."""
        wanted = self._wanted
        if wanted is None or self._task is not None:
            return

        def done(guides: Guides | None) -> None:
            self._task = None
            if wanted is self._wanted:
                self._scene.set_guides(GRID, guides)
            else:
                self._look()

        self._task = run_in_background(
            self, lambda _: grid_guides(*wanted), done, lambda _: done(None), lambda: done(None)
        )
