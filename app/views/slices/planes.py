"""The planes of all panes: how each lies, which slice of it is shown, how it is looked at."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.reformat import Frame
from app.imaging.volume import Volume
from app.views.slices.looks import Look
from app.views.slices.panes import MPR_PANES, PaneId
from app.views.slices.plane import SlicePlane, looked_at, own_plane, reformat_plane


class Planes:
    """State without signals; who changes it tells the panes.

    Attributes:
        cursor_mm: the crosshair's point, LPS, shape (3,), read-only.
        oblique: panes that lie along a frame of their own, not along the volume.
    """

    def __init__(self) -> None:
        self._volume: Volume | None = None
        self._slicer: OrthogonalSlicer | None = None
        self.cursor_mm: FloatArray = frozen(np.zeros(3))
        self.oblique: set[PaneId] = set()
        self._planes: dict[PaneId, SlicePlane] = {}
        self._own_index: dict[PaneId, float] = {}
        self._looks: dict[PaneId, Look] = {}
        self._shown: dict[PaneId, SlicePlane] = {}
        self._frames: dict[PaneId, tuple[SlicePlane, float, FloatArray, Frame]] = {}
        self._indices: dict[PaneId, tuple[SlicePlane, FloatArray, float]] = {}

    def begin(self, volume: Volume, slicer: OrthogonalSlicer) -> None:
        """Lay the three patient views through a volume's middle; the needle's panes have none."""
        self._volume, self._slicer = volume, slicer
        self._planes = {pane: own_plane(slicer, View(pane)) for pane in MPR_PANES}
        self._own_index, self._shown, self._frames, self._indices = {}, {}, {}, {}
        self.oblique = set()
        middle = [(count - 1) / 2 for count in volume.size]
        self.cursor_mm = frozen(volume.lps_mm(middle))

    def own(self, pane: PaneId) -> SlicePlane | None:
        """Plane of a pane as it lies in the patient, neither turned on the screen nor thick."""
        return self._planes.get(pane)

    def shown(self, pane: PaneId) -> SlicePlane | None:
        """Plane of a pane as it is looked at, turned and thick."""
        plane = self._planes.get(pane)
        if plane is None:
            return None
        if pane not in self._shown:
            self._shown[pane] = looked_at(plane, self.look(pane))
        return self._shown[pane]

    def look(self, pane: PaneId) -> Look:
        """How a pane looks at its plane: slab and turn."""
        return self._looks.get(pane, Look())

    def set_look(self, pane: PaneId, look: Look) -> None:
        """Give a pane another slab, or turn it."""
        self._looks[pane] = look
        self._shown.pop(pane, None)

    def lay(self, pane: PaneId, frame: Frame | None, ahead: ArrayLike | None) -> None:
        """Lay a pane's plane along a frame, see `Viewing.set_frame`; nothing without a volume."""
        if self._volume is None or self._slicer is None:
            return
        before = self._planes.pop(pane, None)
        self._shown.pop(pane, None)
        (self.oblique.discard if frame is None else self.oblique.add)(pane)
        if frame is not None:
            if ahead is None and before is not None and not pane.is_needle:
                ahead = before.ahead
            self._planes[pane] = reformat_plane(self._volume, frame, pane, ahead, pane.is_needle)
        elif not pane.is_needle:
            self._planes[pane] = own_plane(self._slicer, View(pane))

    def index(self, pane: PaneId) -> float:
        """Slice shown in a pane: the one at the crosshair, or so many away from the needle."""
        plane = self._planes.get(pane)
        if plane is None or pane.is_needle:
            return self._own_index.get(pane, 0.0)
        known = self._indices.get(pane)
        if known is None or known[0] is not plane or known[1] is not self.cursor_mm:
            known = plane, self.cursor_mm, plane.index_at(self.cursor_mm)
            self._indices[pane] = known
        return known[2]

    def frame(self, pane: PaneId) -> Frame | None:
        """Plane of a pane as it cuts the others: through the crosshair, or at its own slice."""
        plane = self._planes.get(pane)
        if plane is None:
            return None
        index, known = self.index(pane), self._frames.get(pane)
        if known is not None and known[:2] == (plane, index) and known[2] is self.cursor_mm:
            return known[3]  # asked for by every pane that shows its trace
        frame = plane.frame(index)
        if not pane.is_needle:
            frame = frame.moved(frame.point(self.cursor_mm)[2])
        self._frames[pane] = plane, index, self.cursor_mm, frame
        return frame

    def go_to(self, pane: PaneId, index: float) -> None:
        """Show a slice of a pane, kept in the volume; the crosshair goes along if it is linked."""
        plane = self._planes.get(pane)
        if plane is None:
            return
        if pane.is_needle:
            self._own_index[pane] = plane.kept(index, plane.frame(0.0).origin_mm)
            return
        at = plane.point(self.cursor_mm, 0.0)
        self.cursor_mm = frozen(plane.lps_mm(at.x, at.y, plane.kept(index, self.cursor_mm)))
