"""What the keys of a pane do: one small function for each action of the bindings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF

from app.views.slices.bindings import Action
from app.views.slices.gestures import ZOOM_PER_NOTCH, thicken
from app.views.slices.looks import Slab, Turn
from app.views.slices.presets import default_window
from app.views.slices.slab import as_point
from app.views.slices.viewing import Tool

if TYPE_CHECKING:
    from app.views.slices.pane import SlicePane

PAGE = 10
"""Slices that the Page keys move."""

NUDGE_MM = 1.0
"""How far a key moves the crosshair."""

END = 1e9


class PaneActions:
    """Carries out the actions of one pane."""

    def __init__(self, pane: SlicePane) -> None:
        self._pane = pane
        scroll, zoom, nudge = self._scroll, self._zoom, self._nudge
        self._table: dict[Action, Callable[[], object]] = {
            Action.NEXT: lambda: scroll(1), Action.PREVIOUS: lambda: scroll(-1),
            Action.TEN_ON: lambda: scroll(PAGE), Action.TEN_BACK: lambda: scroll(-PAGE),
            Action.FIRST: lambda: scroll(-END), Action.LAST: lambda: scroll(END),
            Action.ZOOM_IN: lambda: zoom(1), Action.ZOOM_OUT: lambda: zoom(-1),
            Action.FIT: pane.canvas.fit, Action.RESET: self.reset,
            Action.ZOOM_TOOL: self._zoom_tool, Action.INVERT: self.invert,
            Action.TURN_RIGHT: lambda: self.turn(1), Action.TURN_LEFT: lambda: self.turn(-1),
            Action.MIRROR: lambda: self.mirror(False),
            Action.MIRROR_UPRIGHT: lambda: self.mirror(True),
            Action.SLAB_KIND: self.next_kind, Action.THICKER: lambda: thicken(pane.canvas, 1),
            Action.THINNER: lambda: thicken(pane.canvas, -1), Action.CINE: pane.cine.toggle,
            Action.PANE_ON: lambda: pane.leave_wanted.emit(True),
            Action.PANE_BACK: lambda: pane.leave_wanted.emit(False),
            Action.MAXIMISE: pane.maximise_wanted.emit,
            Action.LEFT: lambda: nudge(-1, 0), Action.RIGHT: lambda: nudge(1, 0),
            Action.UP: lambda: nudge(0, -1), Action.DOWN: lambda: nudge(0, 1),
            Action.MENU: self._menu,
        }  # fmt: skip

    def do(self, action: Action) -> bool:
        """Carry it out; False if it means nothing now and the key is somebody else's."""
        viewing = self._pane.viewing
        if action is Action.CANCEL:
            return self._cancel()
        if action is Action.PLACE:
            return self._place()
        if viewing.volume is not None or action in (Action.PANE_ON, Action.PANE_BACK):
            self._table[action]()
        return True

    # --- slices, zoom, crosshair --------------------------------------------------------------
    def _scroll(self, slices: float) -> None:
        canvas = self._pane.canvas
        canvas.viewing.show_slice(canvas.pane, canvas.index + slices)

    def _zoom(self, steps: int) -> None:
        canvas = self._pane.canvas
        x, y = canvas.plane_at(QPointF(canvas.rect().center()))
        canvas.set_camera(canvas.camera.zoomed(ZOOM_PER_NOTCH**steps, x, y))

    def _nudge(self, right: int, down: int) -> None:
        canvas, viewing = self._pane.canvas, self._pane.viewing
        if canvas.plane is not None:
            at = canvas.plane.point(viewing.cursor_mm, canvas.index)
            x, y = at.x + right * NUDGE_MM, at.y + down * NUDGE_MM
            viewing.set_cursor(canvas.plane.lps_mm(x, y, canvas.index))

    def _zoom_tool(self) -> None:
        self._pane.viewing.left_zooms = not self._pane.viewing.left_zooms

    def _cancel(self) -> bool:
        viewing = self._pane.viewing
        going = (
            viewing.tool is not Tool.NAVIGATE or viewing.left_zooms or self._pane.cine.is_running
        )
        viewing.left_zooms = False
        viewing.set_tool(Tool.NAVIGATE)
        self._pane.cine.stop()
        return going

    def _place(self) -> bool:
        """Place entry or target at the crosshair, without a mouse."""
        viewing = self._pane.viewing
        if viewing.tool is Tool.NAVIGATE:
            return False
        viewing.point_refused = False
        viewing.point_placed.emit(viewing.tool, as_point(viewing.cursor_mm), True)
        if not viewing.point_refused:
            viewing.set_tool(Tool.NAVIGATE)
        return True

    # --- greys, slab, turn --------------------------------------------------------------------
    def reset(self) -> None:
        """Fit the image, one slice thick, in the window that was there at first."""
        viewing, pane = self._pane.viewing, self._pane.pane
        viewing.set_look(pane, replace(viewing.look(pane), slab=Slab()))
        self._pane.canvas.fit()
        if not viewing.greys.is_locked:
            viewing.set_window(default_window(), pane)

    def invert(self) -> None:
        """Swap bright and dark in all panes."""
        greys = self._pane.viewing.greys
        greys.set_inverted(not greys.is_inverted)

    def turn(self, quarters: int) -> None:
        """Turn what is seen clockwise."""
        self._take_turn(self._turn.turned(quarters))

    def mirror(self, upright: bool) -> None:
        """Swap left and right, or top and bottom."""
        self._take_turn(self._turn.flipped(upright))

    def upright(self) -> None:
        """Turn back to the radiological convention."""
        self._take_turn(Turn())

    def next_kind(self) -> None:
        """Project the slab in the next way."""
        self.take_slab(self._slab.next_kind())

    def take_slab(self, slab: Slab) -> None:
        """Look at another slab."""
        viewing, pane = self._pane.viewing, self._pane.pane
        viewing.set_look(pane, replace(viewing.look(pane), slab=slab))

    @property
    def _turn(self) -> Turn:
        return self._pane.viewing.look(self._pane.pane).turn

    @property
    def _slab(self) -> Slab:
        return self._pane.viewing.look(self._pane.pane).slab

    def _take_turn(self, turn: Turn) -> None:
        viewing, pane = self._pane.viewing, self._pane.pane
        viewing.set_look(pane, replace(viewing.look(pane), turn=turn))

    def _menu(self) -> None:
        canvas = self._pane.canvas
        self._pane.show_menu(canvas.mapToGlobal(canvas.rect().center()))
