"""VTK actors of what an exercise asks for in 3D: lines, electrodes, ablated zones, margins."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import Final

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPlane, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from app.core.arrays import FloatArray
from app.planning.ablation.zone import Zone
from app.views.kit.theme import Mark
from app.views.scene.actors import Ball, Cloud, Ring, Rod, SurfaceActor
from app.views.scene.display import Display, rgb
from app.views.scene.guides import ELECTRODE, LEAST_RING_MM, GuideLine, Guides, rgb_255
from app.views.scene.mesh import Mesh, isosurface
from app.views.slices.zones import ZONE

SHAFT_RADIUS_MM, SHAFT_PX, TIP_RADIUS_MM, TIP_PX, RING_PX = 0.8, 3.0, 1.4, 5.0, 2.2
ZONE_OPACITY: Final = 0.35

_CELL_MM: Final = 1.0  # of the grid on which the union of zones is found
_TRIANGLES: Final = 6000
_TOWARDS_EYE: Final = -8.0  # so many units of depth a line on the skin is drawn before it


class LineActor:
    """Lines of one mark, as wide on the screen at every zoom."""

    def __init__(self, renderer: vtkRenderer, mark: Mark, lines: Sequence[FloatArray]) -> None:
        """Draw lines through points, each of shape (n, 3) [mm]."""
        self._mark, self._renderer = mark, renderer
        points, cells, first = vtkPoints(), vtkCellArray(), 0
        points.SetData(numpy_to_vtk(np.ascontiguousarray(np.vstack(lines)), deep=True))
        for line in lines:
            cells.InsertNextCell(len(line))
            for number in range(first, first + len(line)):
                cells.InsertCellPoint(number)
            first += len(line)
        self.data = vtkPolyData()
        self.data.SetPoints(points)
        self.data.SetLines(cells)
        self._mapper = vtkPolyDataMapper()
        self._mapper.SetInputData(self.data)
        self._mapper.SetResolveCoincidentTopologyToPolygonOffset()
        self._mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, _TOWARDS_EYE)
        self._actor = vtkActor()
        self._actor.SetMapper(self._mapper)
        self._actor.GetProperty().SetLineWidth(mark.width)
        self._actor.GetProperty().LightingOff()
        renderer.AddActor(self._actor)

    def show(self, display: Display) -> None:
        """Take the colour for this background."""
        self._actor.GetProperty().SetColor(*rgb(display.colour(self._mark.colour)))
        self._actor.SetVisibility(display.guides)

    def cut(self, plane: vtkPlane | None) -> None:
        """Show only what is on the normal's side of a plane; None shows all."""
        self._mapper.RemoveAllClippingPlanes()
        if plane is not None:
            self._mapper.AddClippingPlane(plane)

    def remove(self) -> None:
        """Stand in the picture no longer."""
        self._renderer.RemoveActor(self._actor)


class GuideActors:
    """All that stands for one part of an exercise; made once, and removed as a whole.

    Attributes:
        lines, shafts, tips, dots, ring: its actors.
        covered: the union of what is ablated; None where nothing is.
    """

    def __init__(self, renderer: vtkRenderer, over: vtkRenderer, guides: Guides) -> None:
        """Stand in the scene, and seen through the body in the layer over it."""
        by_mark = groupby(sorted(guides.lines, key=_kind), key=_kind)
        groups = [list(group) for _, group in by_mark]
        self.lines = tuple(
            LineActor(renderer, group[0].mark, [line.points_mm for line in group])
            for group in groups
        )
        ends = () if guides.shafts_mm is None else tuple(guides.shafts_mm)
        self.shafts = tuple(Rod(renderer, ELECTRODE, SHAFT_RADIUS_MM, SHAFT_PX, over) for _ in ends)
        self.tips = tuple(Ball(renderer, ELECTRODE, TIP_RADIUS_MM, TIP_PX, over) for _ in ends)
        for shaft, tip, (entry, end) in zip(self.shafts, self.tips, ends, strict=True):
            shaft.span(entry, end)
            tip.put(end)
        self.dots = tuple(Cloud(over, rgb_255(one.mark), one.radius_mm) for one in guides.dots)
        for cloud, one in zip(self.dots, guides.dots, strict=True):
            cloud.place(one.points_mm)
        self.ring: Ring | None = None
        if guides.least is not None:
            at, out, mark = guides.least
            self.ring = Ring(renderer, mark, RING_PX, over)
            self.ring.surround(at, out, LEAST_RING_MM)
        self.covered: SurfaceActor | None = None
        if guides.zones:
            self.covered = SurfaceActor(renderer, ZONE, ZONE_OPACITY)
            self.covered.set_meshes((union(guides.zones),))

    def show(self, display: Display) -> None:
        """Take the colours for this background, or leave the picture."""
        for solid in (*self.shafts, *self.tips, self.ring):
            if solid is not None:
                solid.show(display)
                solid.set_shown(display.guides)
        for line in self.lines:
            line.show(display)
        for cloud in self.dots:
            cloud.set_shown(display.guides)
        if self.covered is not None:
            self.covered.set_shown(display.guides)

    def zoom(self, mm_per_px: float) -> None:
        """Be seen at this size of a pixel [mm]."""
        for solid in (*self.shafts, *self.tips):
            solid.zoom(mm_per_px)

    def cut(self, plane: vtkPlane | None) -> None:
        """Show of lines and zones only what is on the normal's side of a plane; None shows all."""
        for actor in (*self.lines, self.covered):
            if actor is not None:
                actor.cut(plane)

    def remove(self) -> None:
        """Stand in the picture no longer."""
        for actor in (*self.lines, *self.shafts, *self.tips, *self.dots, self.ring, self.covered):
            if actor is not None:
                actor.remove()


def union(zones: Iterable[Zone]) -> Mesh:
    """Return the surface of all that some zones cover together, to a fraction of a millimetre."""
    zones = tuple(zones)
    corners = np.array([zone.box_mm for zone in zones])
    low = corners[:, 0].min(axis=0) - 3.0 * _CELL_MM
    size = np.ceil((corners[:, 1].max(axis=0) - low) / _CELL_MM).astype(int) + 4
    i, j, k = size.tolist()
    places = np.stack(np.meshgrid(np.arange(k), np.arange(j), np.arange(i), indexing="ij"), -1)
    points = low + _CELL_MM * places.reshape(-1, 3)[:, ::-1]
    deepest = np.max([zone.about_mm(points) for zone in zones], axis=0)
    affine = np.diag([_CELL_MM, _CELL_MM, _CELL_MM, 1.0])
    affine[:3, 3] = low
    return isosurface(deepest.reshape(k, j, i), affine, 0.0, _TRIANGLES)


def _kind(line: GuideLine) -> tuple[str, float]:
    return line.mark.colour, line.mark.width
