"""What the slice panes share: one volume, one crosshair, one window, one tool, and their planes.

Of each plane: how it lies, which slice of it is shown, how it is looked at.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QObject, Signal

from app.core.arrays import FloatArray, frozen
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.reformat import Frame
from app.imaging.volume import Volume
from app.imaging.window import PRESETS, WindowLevel, presets
from app.planning.draft import DraftPlan
from app.planning.error_overlay import ErrorOverlay
from app.planning.needle_overlay import NeedleOverlay
from app.session.touching import TargetMarks
from app.views.slices.bindings import OHIF, Scheme
from app.views.slices.panes import MPR_PANES, PaneId
from app.views.slices.pictures import PictureMaker
from app.views.slices.plane import SlicePlane, own_plane, presented, reformat_plane
from app.views.slices.presentation import Presentation
from app.views.slices.presets import Greys


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
        self._presentations: dict[PaneId, Presentation] = {}
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
            self._shown[pane] = presented(plane, self.presentation(pane))
        return self._shown[pane]

    def presentation(self, pane: PaneId) -> Presentation:
        """Return how a pane looks at its plane: slab and turn."""
        return self._presentations.get(pane, Presentation())

    def set_presentation(self, pane: PaneId, presentation: Presentation) -> None:
        """Give a pane another slab, or turn it."""
        self._presentations[pane] = presentation
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


FOLLOW_DEAD_BAND_MM = 0.3
"""Slices that follow the tip stay while it moves less than this, so that they do not tremble."""

TARGET_DEAD_BAND_MM = 0.05
"""A target that moves is drawn anew beyond this."""


class Tool(StrEnum):
    """What the left button does in a slice."""

    NAVIGATE = "navigate"
    ENTRY = "entry"
    TARGET = "target"
    PLANE = "plane"


class Viewing(QObject):
    """State of the slice views; panes draw it and change it through its methods.

    The crosshair is the one point that axial, sagittal and coronal pass through, turned or not:
    scrolling one of them moves it along that pane's normal, so slices and crosshairs cannot
    disagree. The needle's panes stand off their own plane by a number of slices of their own.

    Signals:
        volume_changed, cursor_changed, window_changed, tool_changed, plan_changed, needle_changed.
        needle_shown(): all that goes along with a needle has changed too.
        plane_changed(PaneId): a pane's plane is another one, or is scrolled away from its needle.
        presentation_changed(PaneId): a pane is turned or has another slab; zoom and pan start anew.
        scheme_changed(): mouse and keys mean something else.
        traces_changed(): other planes of the needle show their traces in the patient views.
        point_placed(Tool, tuple, bool): with any tool but `NAVIGATE`, a point was clicked or
            dragged to in LPS [mm]; the flag is True for the first event of a gesture, a new step
            to undo. Who listens takes the tools that are his and leaves the others.
    """

    volume_changed = Signal()
    cursor_changed = Signal()
    window_changed = Signal()
    tool_changed = Signal()
    plan_changed = Signal()
    needle_changed = Signal()
    needle_shown = Signal()
    plane_changed = Signal(object)
    point_placed = Signal(object, object, bool)
    presentation_changed = Signal(object)
    scheme_changed = Signal()
    traces_changed = Signal()

    def __init__(self, window: WindowLevel, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.volume: Volume | None = None
        self.slicer: OrthogonalSlicer | None = None
        self._planes = Planes()
        self.pictures = PictureMaker(self)
        self.pictures.idle.connect(self._go_on)
        self._next_needle: NeedleOverlay | None = None
        self.greys = Greys(window, self)
        self.greys.changed.connect(self.window_changed)
        self.scheme, self.left_zooms, self.level_reversed = OHIF, False, False
        self.tool = Tool.NAVIGATE
        self.draft = DraftPlan()
        self.target_now_mm: FloatArray | None = None
        self.targets: TargetMarks | None = None
        self.tolerances_mm: tuple[float, ...] = ()
        self.needle: NeedleOverlay | None = None
        self.target_error: ErrorOverlay | None = None
        self.shows_errors, self.shows_traces = True, True
        self.seen_panes: frozenset[PaneId] = frozenset()
        self.follows_tip = self.is_slab_fixed = False
        self.point_refused = False
        self.clicked_pane: PaneId | None = None

    @property
    def window(self) -> WindowLevel:
        """Window of the panes that have none of their own."""
        return self.greys.common

    def set_scheme(self, scheme: Scheme) -> None:
        """Take other bindings of mouse and keys."""
        self.scheme = scheme
        self.scheme_changed.emit()

    def set_volume(self, volume: Volume) -> None:
        """Show another volume; the crosshair goes to its middle."""
        before = "HU" if self.volume is None else self.volume.unit
        self.volume, self.slicer = volume, OrthogonalSlicer(volume)
        self._next_needle = None  # of another patient
        self._planes.begin(volume, self.slicer)
        self.volume_changed.emit()
        if volume.unit != before or volume.unit != "HU":
            choices = PRESETS if volume.unit == "HU" else presets(volume)
            self.set_window(next(iter(choices.values())))

    def forget(self) -> None:
        """Show nothing: its patient leaves."""
        self.volume = self.slicer = self.needle = self._next_needle = None
        self._planes, self.draft, self.target_now_mm = Planes(), DraftPlan(), None
        self.targets = None
        self.volume_changed.emit()

    def set_cursor(self, lps_mm: ArrayLike) -> None:
        """Move the crosshair to an LPS point [mm], kept inside the volume."""
        if self.volume is None:
            return
        last = np.asarray(self.volume.size) - 1.0
        voxel = np.clip(self.volume.voxel(lps_mm), 0.0, last)
        self._planes.cursor_mm = frozen(self.volume.lps_mm(voxel))
        self.cursor_changed.emit()

    # --- planes -------------------------------------------------------------------------------
    @property
    def cursor_mm(self) -> FloatArray:
        """The crosshair's point, LPS [mm], shape (3,), read-only."""
        return self._planes.cursor_mm

    def plane(self, pane: PaneId) -> SlicePlane | None:
        """Plane of a pane as it is looked at, turned and thick; None without a volume, or while a
        needle pane has no needle.
        """
        return self._planes.shown(pane)

    def is_oblique(self, pane: PaneId) -> bool:
        """Return whether a pane lies along a frame of its own, not along the volume."""
        return pane in self._planes.oblique

    def own(self, pane: PaneId) -> SlicePlane | None:
        """Plane of a pane as it lies in the patient, neither turned on the screen nor thick."""
        return self._planes.own(pane)

    def presentation(self, pane: PaneId) -> Presentation:
        """Return how a pane looks at its plane: slab and turn."""
        return self._planes.presentation(pane)

    def set_presentation(self, pane: PaneId, presentation: Presentation) -> None:
        """Give a pane another slab, unless an exercise holds them, or turn it."""
        if self.is_slab_fixed and presentation.slab != self.presentation(pane).slab:
            self.greys.refused.emit()
            presentation = replace(presentation, slab=self.presentation(pane).slab)
        if presentation != self.presentation(pane):
            self._planes.set_presentation(pane, presentation)
            self.presentation_changed.emit(pane)
            self.plane_changed.emit(pane)

    def fix_slabs(self, fixed: bool) -> None:
        """Keep the slabs of all panes as they are for an exercise, or end that."""
        self.is_slab_fixed = fixed

    def set_frame(self, pane: PaneId, frame: Frame | None, ahead: ArrayLike | None = None) -> None:
        """Lay a pane's plane along a frame.

        Args:
            pane: whose.
            frame: where; None goes back to the volume's own slices, or takes the needle away.
            ahead: side of the frame towards which slices count up; for None into the screen with a
                needle's pane, and where the pane's slices went so far with the others.
        """
        if self.volume is not None:
            self._planes.lay(pane, frame, ahead)
            self.plane_changed.emit(pane)

    def index(self, pane: PaneId) -> float:
        """Slice shown in a pane: the one at the crosshair, or so many away from the needle."""
        return self._planes.index(pane)

    def frame(self, pane: PaneId) -> Frame | None:
        """Plane of a pane as it cuts the others: through the crosshair, or at its own slice."""
        return self._planes.frame(pane)

    def show_slice(self, pane: PaneId, index: float) -> None:
        """Go to a slice of a pane, kept in the volume; the crosshair goes along if it is linked."""
        if self.own(pane) is None:
            return
        self._planes.go_to(pane, index)
        if pane.is_needle:
            self.plane_changed.emit(pane)
        else:
            self.cursor_changed.emit()

    def set_window(self, window: WindowLevel, pane: PaneId | None = None) -> None:
        """Change width and level of all panes, or of one if each has its own."""
        self.greys.set(window, pane)

    def set_tool(self, tool: Tool) -> None:
        """Choose what the left button does."""
        if tool is not self.tool:
            self.tool = tool
            self.tool_changed.emit()

    def refuse_point(self) -> None:
        """Note that the point just placed was not taken: the tool stays for another try."""
        self.point_refused = True

    def set_draft(self, draft: DraftPlan) -> None:
        """Show entry and target, at rest."""
        self.draft, self.target_now_mm = draft, None
        self.plan_changed.emit()

    def set_target_now(self, target_mm: FloatArray | None) -> None:
        """Show the target where breathing has it now, LPS [mm]; None shows it at rest."""
        before, self.target_now_mm = self.target_now_mm, target_mm
        if before is None or target_mm is None:
            changed = before is not target_mm
        else:
            changed = bool(np.abs(target_mm - before).max() > TARGET_DEAD_BAND_MM)
            self.target_now_mm = target_mm if changed else before
        if changed:
            self.plan_changed.emit()

    def set_targets(self, targets: TargetMarks | None) -> None:
        """Show targets that are touched one after the other, and how many were; None shows none."""
        before, self.targets = self.targets, targets
        if before is not targets and not (before is not None and before.same(targets)):
            self.plan_changed.emit()

    @property
    def shown_draft(self) -> DraftPlan:
        """The plan as it is drawn: with the target where it is now."""
        now = self.target_now_mm
        return self.draft if now is None else self.draft.with_target(now)

    def set_tolerances(self, radii_mm: tuple[float, ...]) -> None:
        """Draw these rings round the target [mm], from the inside."""
        self.tolerances_mm = radii_mm
        self.plan_changed.emit()

    def follow_needle(self, needle: NeedleOverlay) -> None:
        """Show a needle that moves, as soon as every pane has drawn the last one.

        On a machine that cannot keep up, panes then draw fewer needles, but each of them whole: in
        all panes the same one, over pictures that are its own. The newest one is never left out.
        """
        if self.pictures.is_awaited:
            self._next_needle = needle
        else:
            self.set_needle(needle)

    def _go_on(self) -> None:
        if self._next_needle is not None:
            self.set_needle(self._next_needle)

    def set_needle(self, needle: NeedleOverlay | None) -> None:
        """Show the live needle (None hides it); the image is not touched unless slices follow."""
        self.needle, self._next_needle = needle, None
        self.needle_changed.emit()
        tip = needle.tip_mm if needle is not None and needle.valid and self.follows_tip else None
        if tip is not None and np.linalg.norm(tip - self.cursor_mm) > FOLLOW_DEAD_BAND_MM:
            self.set_cursor(tip)
        self.needle_shown.emit()

    def set_target_error(self, error: ErrorOverlay | None) -> None:
        """Show how far the target may be from where the CT has it; None where nobody checked."""
        self.target_error = error
        self.plan_changed.emit()

    def set_shows_errors(self, shown: bool) -> None:
        """Draw error ellipses round target and tip, or none."""
        self.shows_errors = shown
        self.plan_changed.emit()
        self.needle_changed.emit()

    def set_shows_traces(self, shown: bool) -> None:
        """Draw where the needle's planes cut the patient views, or not."""
        self.shows_traces = shown
        self.traces_changed.emit()

    def set_seen(self, panes: Iterable[PaneId]) -> None:
        """Tell which panes of the needle somebody sees: only theirs show traces."""
        self.seen_panes = frozenset(panes)
        self.traces_changed.emit()

    def set_follows_tip(self, follows: bool) -> None:
        """Let the slices pass through the needle's tip from now on, or stay."""
        self.follows_tip = follows
        self.set_needle(self.needle)
