"""VTK actors of the stage: marks of constant width, surfaces in two finenesses, clouds of balls."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPlane, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersHybrid import vtkDepthSortPolyData
from vtkmodules.vtkFiltersSources import vtkCylinderSource, vtkRegularPolygonSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkGlyph3DMapper,
    vtkPolyDataMapper,
    vtkProp3D,
    vtkRenderer,
)

from app.core.arrays import FloatArray
from app.core.transform import rotation_between
from app.views.kit.theme import Mark
from app.views.scene.display import Display, rgb
from app.views.scene.mesh import Mesh, to_polydata

SHORTEST_MM = 1e-6
"""Rods shorter than this have no direction and are not shown."""

SEEN_THROUGH = 0.45
"""Opacity of what is drawn once more over everything that hides it; 1 in an x-ray."""


class Solid:
    """A source's surface in the colour of a mark, as thick as asked for or as can be seen.

    Args:
        renderer: where it stands.
        source: a surface of radius 1.
        mark: its colour.
        radius_mm: its radius.
        least_px: width that it never falls below on the screen; 0 for none.
        over: of the layer over the picture, in which it is seen through what hides it.
        opacity: of the surface itself.
    """

    def __init__(
        self,
        renderer: vtkRenderer,
        source: vtkAlgorithm,
        mark: Mark,
        radius_mm: float = 1.0,
        least_px: float = 0.0,
        over: vtkRenderer | None = None,
        opacity: float = 1.0,
    ) -> None:
        self._mark, self._display = mark, Display()
        self._radius_mm, self._least_px, self._mm_per_px = radius_mm, least_px, 0.0
        self._matrix: FloatArray | None = None
        self._source = source  # its output port does not keep it
        self._where, self._is_shown = (renderer, over), True
        self._actors = [
            _actor(where, source, opacity * share)
            for where, share in ((renderer, 1.0), (over, SEEN_THROUGH))
            if where is not None
        ]
        self.show(Display())

    @property
    def radius_mm(self) -> float:
        """Radius at this zoom."""
        return max(self._radius_mm, 0.5 * self._least_px * self._mm_per_px)

    def zoom(self, mm_per_px: float) -> None:
        """Be seen at this size of a pixel [mm]."""
        if self._least_px > 0.0 and mm_per_px != self._mm_per_px:
            self._mm_per_px = mm_per_px
            self._stand()

    def show(self, display: Display) -> None:
        """Take the colour for this background; in an x-ray nothing hides it."""
        self._display = display
        for actor in self._actors:
            actor.GetProperty().SetColor(*rgb(display.colour(self._mark.colour)))
        for ghost in self._actors[1:]:
            ghost.GetProperty().SetOpacity(1.0 if display.xray else SEEN_THROUGH)

    def set_shown(self, shown: bool) -> None:
        """Stand in the picture where it was placed, or not at all."""
        self._is_shown = shown
        self._stand()

    def remove(self) -> None:
        """Stand in the picture no longer."""
        for actor, renderer in zip(self._actors, self._where, strict=False):
            if renderer is not None:
                renderer.RemoveActor(actor)

    def set_mark(self, mark: Mark) -> None:
        """Take the colour of another mark."""
        self._mark = mark
        self.show(self._display)

    def place(self, matrix: FloatArray | None) -> None:
        """Stand where a matrix (4, 4) brings the source of radius 1; hidden without one."""
        self._matrix = matrix
        self._stand()

    def _stand(self) -> None:
        for actor in self._actors:
            actor.SetVisibility(self._matrix is not None and self._is_shown)
            if self._matrix is not None:
                actor.SetUserMatrix(_vtk_matrix(self._matrix @ np.diag([*self._thick(), 1.0])))

    def _thick(self) -> tuple[float, float, float]:
        return self.radius_mm, self.radius_mm, self.radius_mm


class Rod(Solid):
    """A cylinder between two points; arguments as of `Solid`."""

    def __init__(
        self,
        renderer: vtkRenderer,
        mark: Mark,
        radius_mm: float,
        least_px: float = 0.0,
        over: vtkRenderer | None = None,
        opacity: float = 1.0,
    ) -> None:
        source = vtkCylinderSource()
        source.SetRadius(1.0)
        source.SetResolution(16)
        super().__init__(renderer, source, mark, radius_mm, least_px, over, opacity)

    def span(self, start: ArrayLike | None, end: ArrayLike | None) -> None:
        """Run from `start` to `end` [mm]; hidden without both or without length."""
        placed = None
        if start is not None and end is not None:
            first, last = np.array([start, end], np.float64)
            length = float(np.linalg.norm(last - first))
            if length > SHORTEST_MM:
                placed = np.eye(4)
                turn = rotation_between([0.0, 1.0, 0.0], last - first)
                placed[:3, :3] = turn @ np.diag([1.0, length, 1.0])
                placed[:3, 3] = (first + last) / 2
        self.place(placed)

    def _thick(self) -> tuple[float, float, float]:
        return self.radius_mm, 1.0, self.radius_mm


class Ball(Solid):
    """A sphere at a point; arguments as of `Solid`."""

    def __init__(
        self,
        renderer: vtkRenderer,
        mark: Mark,
        radius_mm: float,
        least_px: float = 0.0,
        over: vtkRenderer | None = None,
        opacity: float = 1.0,
    ) -> None:
        source = vtkSphereSource()
        source.SetRadius(1.0)
        source.SetThetaResolution(28)
        source.SetPhiResolution(20)
        super().__init__(renderer, source, mark, radius_mm, least_px, over, opacity)

    def put(self, at: ArrayLike | None, half_axes: FloatArray | None = None) -> None:
        """Stand at a point [mm], with `half_axes` as columns [mm] as an ellipsoid; hidden without
        a point.
        """
        placed = None
        if at is not None:
            placed = np.eye(4)
            placed[:3, 3] = np.asarray(at, np.float64)
            if half_axes is not None:
                placed[:3, :3] = half_axes
        self.place(placed)


class Ring(Solid):
    """A circle about an axis, drawn as a line; arguments as of `Solid`."""

    def __init__(self, renderer: vtkRenderer, mark: Mark, width_px: float, over: vtkRenderer):
        source = vtkRegularPolygonSource()
        source.SetNumberOfSides(64)
        source.SetRadius(1.0)
        source.GeneratePolygonOff()
        super().__init__(renderer, source, mark, over=over)
        for actor in self._actors:
            actor.GetProperty().SetLineWidth(width_px)
            actor.GetProperty().LightingOff()

    def surround(self, at: ArrayLike | None, axis: ArrayLike, radius_mm: float) -> None:
        """Lie about an axis through a point [mm]; hidden without one."""
        placed = None
        if at is not None:
            placed = np.eye(4)
            placed[:3, :3] = radius_mm * rotation_between([0.0, 0.0, 1.0], axis)
            placed[:3, 3] = np.asarray(at, np.float64)
        self.place(placed)


class SurfaceActor:
    """A mesh, and its coarse version for while the picture moves.

    Args:
        renderer: where it stands.
        colour: `#rrggbb`.
        opacity: below 1 only what faces the eye is drawn, from back to front.
    """

    def __init__(self, renderer: vtkRenderer, colour: str, opacity: float) -> None:
        self._mapper, self._sorter = vtkPolyDataMapper(), vtkDepthSortPolyData()
        self._meshes: tuple[vtkPolyData, ...] | None = None
        self.usual_opacity = opacity
        actor = vtkActor()
        actor.SetMapper(self._mapper)
        surface = actor.GetProperty()
        surface.SetColor(*rgb(colour))
        surface.SetAmbient(0.18)
        surface.SetDiffuse(0.85)
        surface.SetSpecular(0.12)
        surface.SetSpecularPower(18.0)
        actor.VisibilityOff()
        self._actor, self._renderer, self._is_shown = actor, renderer, True
        self._sorter.SetDirectionToBackToFront()
        self._sorter.SetDepthSortModeToFirstPoint()
        self._sorter.SetCamera(renderer.GetActiveCamera())
        self._sorter.SetProp3D(actor)
        self.set_opacity(opacity)
        renderer.AddActor(actor)

    def nearest(self, backwards: FloatArray) -> float:
        """Return how near [mm] it comes at most to an eye that looks against `backwards`."""
        bounds = np.array(self._actor.GetBounds()).reshape(3, 2)
        return float(np.maximum(bounds[:, 0] * backwards, bounds[:, 1] * backwards).sum())

    def draw_last(self) -> None:
        """Be drawn after all others."""
        self._renderer.RemoveActor(self._actor)
        self._renderer.AddActor(self._actor)

    def remove(self) -> None:
        """Stand in the picture no longer."""
        self._renderer.RemoveActor(self._actor)

    @property
    def is_seen_through(self) -> bool:
        """Return whether it is in the picture, and translucent."""
        return bool(self._actor.GetVisibility()) and self._actor.GetProperty().GetOpacity() < 1.0

    def set_opacity(self, opacity: float) -> None:
        """Be seen through, or not."""
        surface = self._actor.GetProperty()
        surface.SetOpacity(opacity)
        # Far sides of a translucent skin would only veil what is inside.
        surface.SetBackfaceCulling(opacity < 1.0)

    def set_shown(self, shown: bool) -> None:
        """Stand in the picture, if there is a mesh."""
        self._is_shown = shown
        self._actor.SetVisibility(shown and self._meshes is not None)

    def set_meshes(self, meshes: Sequence[Mesh] | None) -> None:
        """Take the fine and the coarse mesh, or show none."""
        shown = tuple(mesh for mesh in meshes or () if mesh.count > 0)
        self._meshes = tuple(to_polydata(mesh) for mesh in shown) or None
        self.set_shown(self._is_shown)

    def choose(self, moving: bool, ordered: bool) -> None:
        """Show the coarse version while `moving`; with `ordered` its triangles need no sorting."""
        if self._meshes is None:
            return
        data = self._meshes[-1 if moving else 0]
        if ordered or not self.is_seen_through:
            self._mapper.SetInputData(data)
        else:
            self._sorter.SetInputData(data)
            self._mapper.SetInputConnection(self._sorter.GetOutputPort())

    def cut(self, plane: vtkPlane | None) -> None:
        """Show only what is on the normal's side of a plane; None shows all."""
        self._mapper.RemoveAllClippingPlanes()
        if plane is not None:
            self._mapper.AddClippingPlane(plane)


class Cloud:
    """Balls at points, all of one colour, as one actor."""

    def __init__(self, renderer: vtkRenderer, rgb_255: Iterable[int], radius_mm: float) -> None:
        source = vtkSphereSource()
        source.SetRadius(radius_mm)
        source.SetThetaResolution(8)
        source.SetPhiResolution(6)
        self._mapper = vtkGlyph3DMapper()
        self._mapper.SetSourceConnection(source.GetOutputPort())
        self._mapper.ScalingOff()
        self._mapper.SetScalarVisibility(False)
        self._mapper.SetInputData(vtkPolyData())
        self._actor = vtkActor()
        self._actor.SetMapper(self._mapper)
        self._actor.GetProperty().SetColor(*(value / 255.0 for value in rgb_255))
        self._actor.GetProperty().SetAmbient(0.4)
        self._actor.VisibilityOff()
        self._renderer, self._has_points, self._is_shown = renderer, False, True
        renderer.AddActor(self._actor)

    def set_shown(self, shown: bool) -> None:
        """Stand in the picture, if there are points."""
        self._is_shown = shown
        self._actor.SetVisibility(shown and self._has_points)

    def remove(self) -> None:
        """Stand in the picture no longer."""
        self._renderer.RemoveActor(self._actor)

    def place(self, points_mm: FloatArray | None) -> None:
        """Stand at points [mm], shape (n, 3); hidden without."""
        self._has_points = points_mm is not None and len(points_mm) > 0
        self.set_shown(self._is_shown)
        if points_mm is None or not self._has_points:
            return
        places = vtkPoints()
        places.SetData(numpy_to_vtk(np.ascontiguousarray(points_mm), deep=True))
        data = vtkPolyData()
        data.SetPoints(places)
        self._mapper.SetInputData(data)


def place_by(prop: vtkProp3D, affine: FloatArray) -> None:
    """Give an actor or a volume the place that an affine (4, 4) says."""
    prop.SetUserMatrix(_vtk_matrix(affine))


def _actor(renderer: vtkRenderer, source: vtkAlgorithm, opacity: float) -> vtkActor:
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetOpacity(opacity)
    actor.GetProperty().SetAmbient(0.35)
    actor.VisibilityOff()
    renderer.AddActor(actor)
    return actor


def _vtk_matrix(values: FloatArray) -> vtkMatrix4x4:
    matrix = vtkMatrix4x4()
    matrix.DeepCopy(values.ravel().tolist())
    return matrix
