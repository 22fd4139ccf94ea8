"""VTK actors of the stage: rods, balls and surfaces in two finenesses."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtGui import QColor
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersSources import vtkCylinderSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from app.core.arrays import FloatArray
from app.core.transform import rotation_between
from app.views.kit.theme import Mark
from app.views.scene.mesh import Mesh, to_polydata

SHORTEST_MM = 1e-6
"""Rods shorter than this have no direction and are not shown."""


def colour(name: str) -> tuple[float, float, float]:
    """Return `#rrggbb` as three floats in [0, 1]."""
    value = QColor(name)
    return value.redF(), value.greenF(), value.blueF()


SEEN_THROUGH = 0.45
"""Opacity of what is drawn once more over everything that hides it."""


class Rod:
    """A cylinder between two points, as thick as asked for or as can be seen.

    Args:
        renderer: where it stands.
        mark: its colour.
        radius_mm: its radius.
        least_px: width that it never falls below on the screen; 0 for none.
        over: of the layer over the picture, in which it is seen through what hides it.
    """

    def __init__(
        self,
        renderer: vtkRenderer,
        mark: Mark,
        radius_mm: float,
        least_px: float = 0.0,
        over: vtkRenderer | None = None,
    ) -> None:
        source = vtkCylinderSource()
        source.SetRadius(1.0)
        source.SetResolution(16)
        self._radius_mm, self._least_px, self._mm_per_px = radius_mm, least_px, 0.0
        self._ends: FloatArray | None = None
        self._actors = [_actor(renderer, source.GetOutputPort(), mark)]
        if over is not None:
            self._actors.append(_ghost(over, source.GetOutputPort(), mark))

    def place(self, start: ArrayLike | None, end: ArrayLike | None) -> None:
        """Run from `start` to `end` [mm]; hidden without both or without length."""
        self._ends = None
        if start is not None and end is not None:
            ends = np.array([start, end], np.float64)
            if np.linalg.norm(ends[1] - ends[0]) > SHORTEST_MM:
                self._ends = ends
        self._stand()

    def zoom(self, mm_per_px: float) -> None:
        """Be seen at this size of a pixel [mm]."""
        if self._least_px > 0.0 and mm_per_px != self._mm_per_px:
            self._mm_per_px = mm_per_px
            self._stand()

    def _stand(self) -> None:
        for actor in self._actors:
            actor.SetVisibility(self._ends is not None)
        if self._ends is None:
            return
        first, last = self._ends
        length = float(np.linalg.norm(last - first))
        radius = max(self._radius_mm, 0.5 * self._least_px * self._mm_per_px)
        placed = np.eye(4)
        turn = rotation_between([0.0, 1.0, 0.0], last - first)
        placed[:3, :3] = turn @ np.diag([radius, length, radius])
        placed[:3, 3] = (first + last) / 2
        for actor in self._actors:
            actor.SetUserMatrix(_matrix(placed))

    def set_colour(self, mark: Mark) -> None:
        """Take the colour of `mark`."""
        for actor in self._actors:
            actor.GetProperty().SetColor(*colour(mark.colour))


class Ball:
    """A sphere at a point, as large as asked for or as can be seen; arguments as of `Rod`."""

    def __init__(
        self,
        renderer: vtkRenderer,
        mark: Mark,
        radius_mm: float,
        least_px: float = 0.0,
        over: vtkRenderer | None = None,
    ) -> None:
        source = vtkSphereSource()
        source.SetRadius(1.0)
        source.SetThetaResolution(20)
        source.SetPhiResolution(14)
        self._radius_mm, self._least_px = radius_mm, least_px
        self._actors = [_actor(renderer, source.GetOutputPort(), mark)]
        if over is not None:
            self._actors.append(_ghost(over, source.GetOutputPort(), mark))
        self.zoom(0.0)

    def place(self, at: ArrayLike | None) -> None:
        """Stand at a point [mm]; hidden without one."""
        for actor in self._actors:
            actor.SetVisibility(at is not None)
            if at is not None:
                actor.SetPosition(*np.asarray(at, dtype=np.float64))

    def zoom(self, mm_per_px: float) -> None:
        """Be seen at this size of a pixel [mm]."""
        for actor in self._actors:
            actor.SetScale(max(self._radius_mm, 0.5 * self._least_px * mm_per_px))


class Ellipsoid:
    """A translucent sphere, stretched and turned."""

    def __init__(self, renderer: vtkRenderer, mark: Mark, opacity: float) -> None:
        source = vtkSphereSource()
        source.SetRadius(1.0)
        source.SetThetaResolution(28)
        source.SetPhiResolution(20)
        self._actor = _actor(renderer, source.GetOutputPort(), mark)
        self._actor.GetProperty().SetOpacity(opacity)

    def place(self, at: ArrayLike | None, half_axes: FloatArray | None) -> None:
        """Stand at a point [mm] with these half axes as columns [mm]; hidden without."""
        self._actor.SetVisibility(at is not None and half_axes is not None)
        if at is not None and half_axes is not None:
            placed = np.eye(4)
            placed[:3, :3], placed[:3, 3] = half_axes, np.asarray(at, dtype=np.float64)
            self._actor.SetUserMatrix(_matrix(placed))


class SurfaceActor:
    """A mesh, and its coarse version for while the picture moves."""

    def __init__(self, renderer: vtkRenderer, mark: Mark, opacity: float) -> None:
        self._mapper = vtkPolyDataMapper()
        self._meshes: tuple[vtkPolyData, ...] | None = None
        actor = vtkActor()
        actor.SetMapper(self._mapper)
        look = actor.GetProperty()
        look.SetColor(*colour(mark.colour))
        look.SetOpacity(opacity)
        look.SetAmbient(0.2)
        look.SetSpecular(0.15)
        if opacity < 1.0:  # far sides of a translucent skin would only veil what is inside
            look.BackfaceCullingOn()
        actor.VisibilityOff()
        self._actor, self._renderer = actor, renderer
        renderer.AddActor(actor)

    def remove(self) -> None:
        """Stand in the picture no longer."""
        self._renderer.RemoveActor(self._actor)

    def set_meshes(self, meshes: Sequence[Mesh] | None) -> None:
        """Take the fine and the coarse mesh, or show none."""
        shown = tuple(mesh for mesh in meshes or () if mesh.count > 0)
        self._meshes = tuple(to_polydata(mesh) for mesh in shown) or None
        self._actor.SetVisibility(bool(shown))

    def choose(self, moving: bool) -> None:
        """Show the coarse version while `moving`."""
        if self._meshes is not None:
            self._mapper.SetInputData(self._meshes[-1 if moving else 0])


def _actor(renderer: vtkRenderer, port: object, mark: Mark) -> vtkActor:
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(port)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour(mark.colour))
    actor.GetProperty().SetAmbient(0.35)
    actor.VisibilityOff()
    renderer.AddActor(actor)
    return actor


def _ghost(over: vtkRenderer, port: object, mark: Mark) -> vtkActor:
    actor = _actor(over, port, mark)
    actor.GetProperty().SetOpacity(SEEN_THROUGH)
    return actor


def _matrix(values: FloatArray) -> vtkMatrix4x4:
    matrix = vtkMatrix4x4()
    matrix.DeepCopy(values.ravel().tolist())
    return matrix
