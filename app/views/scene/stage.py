"""What stands in the 3D picture. Built, changed and rendered on one thread only."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from vtkmodules import vtkRenderingOpenGL2  # its import registers the OpenGL classes
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from app.core.confidence import principal_axes
from app.core.errors import AcusError
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.imaging.structures.structure import Colour
from app.planning.draft import DraftPlan
from app.planning.error_overlay import SMALLEST_MM
from app.planning.needle_overlay import NeedleOverlay
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.plan.entry_map import COLOURS, SIZES_PX, EntryMap
from app.views.scene.actors import Ball, Ellipsoid, Rod, SurfaceActor, colour
from app.views.scene.cloud import Cloud
from app.views.scene.mesh import Mesh
from app.views.scene.orbit import Orbit
from app.views.scene.robot import RobotShape
from app.views.scene.surfaces import Surfaces

EYE_DISTANCE_MM = 2000.0
LINK_RADIUS_MM, FULCRUM_RADIUS_MM = 4.0, 7.0
NEEDLE_RADIUS_MM, PATH_RADIUS_MM, POINT_RADIUS_MM = 1.2, 0.7, 3.0
NEEDLE_PX, PATH_PX, POINT_PX = 4.0, 2.0, 9.0
"""Widths that needle, path and points never fall below on the screen, however small the zoom."""


class SceneError(AcusError):
    """The 3D view cannot be drawn."""


class Stage:
    """Surfaces, robot, needle and plan in patient LPS millimetres, and the off-screen window."""

    def __init__(self) -> None:
        self._renderer = vtkRenderer()
        self._renderer.SetBackground(*colour(theme.IMAGE_BACKGROUND))
        self._renderer.GetActiveCamera().ParallelProjectionOn()
        self._window: vtkRenderWindow | None = None
        self._over = over = vtkRenderer()  # over the picture: what must be seen through the body
        over.SetLayer(1)
        over.SetActiveCamera(self._renderer.GetActiveCamera())
        self._skin = SurfaceActor(self._renderer, theme.SKIN, opacity=0.4)
        self._bone = SurfaceActor(self._renderer, theme.BONE, opacity=1.0)
        self._structures: list[SurfaceActor] = []
        self._entries = [
            Cloud(self._renderer, rgb, 0.5 * size)
            for rgb, size in zip(COLOURS, SIZES_PX, strict=True)
        ]
        self._links = [Rod(self._renderer, theme.ROBOT, LINK_RADIUS_MM) for _ in range(5)]
        self._fulcrum = Ball(self._renderer, theme.ROBOT, FULCRUM_RADIUS_MM)
        self._needle = [self._new_piece()]
        self._tip = Ball(
            self._renderer, theme.NEEDLE_TIP, 2 * NEEDLE_RADIUS_MM, 1.5 * NEEDLE_PX, over
        )
        self._error = Ellipsoid(self._renderer, theme.NEEDLE_TIP, opacity=0.35)
        self._path = Rod(self._renderer, theme.PATH, PATH_RADIUS_MM, PATH_PX, over)
        self._entry = Ball(self._renderer, theme.ENTRY, POINT_RADIUS_MM, POINT_PX, over)
        self._target = Ball(self._renderer, theme.TARGET, POINT_RADIUS_MM, POINT_PX, over)

    def _new_piece(self) -> Rod:
        return Rod(self._renderer, theme.NEEDLE, NEEDLE_RADIUS_MM, NEEDLE_PX, self._over)

    def open(self) -> None:
        """Make the OpenGL context on the calling thread."""
        self._window = _off_screen_window()
        self._window.SetNumberOfLayers(2)
        self._window.AddRenderer(self._renderer)
        self._window.AddRenderer(self._over)

    def close(self) -> None:
        """Free the OpenGL context; idempotent."""
        if self._window is not None:
            self._window.RemoveRenderer(self._over)
            self._window.RemoveRenderer(self._renderer)
            self._window.Finalize()
            self._window = None

    def set_surfaces(self, surfaces: Surfaces | None) -> None:
        """Show skin and bone, or none."""
        self._skin.set_meshes((surfaces.skin, surfaces.skin_moving) if surfaces else None)
        self._bone.set_meshes((surfaces.bone, surfaces.bone_moving) if surfaces else None)

    def set_structures(self, shown: tuple[tuple[Colour, Mesh], ...]) -> None:
        """Show structures in these colours, and no others."""
        for actor in self._structures:
            actor.remove()
        self._structures = []
        for rgb, mesh in shown:
            mark = Mark("#" + "".join(f"{value:02x}" for value in rgb))
            actor = SurfaceActor(self._renderer, mark, opacity=1.0)
            actor.set_meshes((mesh,))
            self._structures.append(actor)

    def set_entry_map(self, shown: EntryMap | None) -> None:
        """Show scored entries as balls in the colours of their classes, or none."""
        for number, cloud in enumerate(self._entries):
            points = None if shown is None else shown.points_mm[shown.classes == number]
            cloud.place(points)

    def set_plan(self, draft: DraftPlan) -> None:
        """Show entry, target and the path between them."""
        self._entry.place(draft.entry_mm)
        self._target.place(draft.target_mm)
        self._path.place(draft.entry_mm, draft.target_mm)

    def set_needle(self, needle: NeedleOverlay | None, scale: float = 1.0) -> None:
        """Show the needle, grey where its pose is not valid; its error `scale` times enlarged."""
        if needle is None:
            for rod in self._needle:
                rod.place(None, None)
            self._tip.place(None)
            self._error.place(None, None)
            return
        pieces = list(pairwise(needle.points_mm))
        while len(self._needle) < len(pieces):
            self._needle.append(self._new_piece())
        for number, rod in enumerate(self._needle):
            rod.place(*(pieces[number] if number < len(pieces) else (None, None)))
            rod.set_colour(theme.NEEDLE if needle.valid else theme.ROBOT)
        self._tip.place(needle.tip_mm)
        error = needle.error
        if error is None:
            self._error.place(None, None)
        else:
            axes = scale * principal_axes(error.covariance_mm2 + SMALLEST_MM**2 * np.eye(3))
            self._error.place(error.centre_mm, axes)

    def set_robot(self, robot: RobotShape | None, T_patient_world: RigidTransform) -> None:
        """Show the links and the ball; world metres are brought into the patient."""
        rods = [] if robot is None else robot.links()
        for number, rod in enumerate(self._links):
            if number < len(rods):
                start, end = (T_patient_world @ np.array(rods[number])) / MILLIMETRE
                rod.place(start, end)
            else:
                rod.place(None, None)
        fulcrum = None if robot is None else (T_patient_world @ robot.fulcrum) / MILLIMETRE
        self._fulcrum.place(fulcrum)

    def render(self, orbit: Orbit, size_px: tuple[int, int], moving: bool) -> NDArray[np.uint8]:
        """Return the picture, RGBA, shape (height, width, 4), top row first.

        Raises:
            SceneError: if the stage is closed.
        """
        window = self._window
        if window is None:
            raise SceneError("the 3D view is closed: open it before rendering")
        self._skin.choose(moving)
        self._bone.choose(moving)
        for actor in self._structures:
            actor.choose(moving)
        self._aim(orbit, size_px)
        width, height = size_px
        window.SetSize(width, height)
        window.Render()
        pixels = vtkUnsignedCharArray()
        window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels, 0)
        picture = vtk_to_numpy(pixels).reshape(height, width, 4)[::-1].copy()
        picture[:, :, 3] = 255
        return picture

    def _aim(self, orbit: Orbit, size_px: tuple[int, int]) -> None:
        camera = self._renderer.GetActiveCamera()
        camera.SetFocalPoint(*orbit.focus_mm)
        camera.SetPosition(*(orbit.focus_mm + EYE_DISTANCE_MM * orbit.backwards))
        camera.SetViewUp(*orbit.up)
        camera.SetParallelScale(0.5 * size_px[1] * orbit.mm_per_px(size_px))
        camera.SetClippingRange(1.0, 2.0 * EYE_DISTANCE_MM)
        mm_per_px = orbit.mm_per_px(size_px)
        for rod in (*self._needle, self._path):
            rod.zoom(mm_per_px)
        for ball in (self._tip, self._entry, self._target):
            ball.zoom(mm_per_px)


def _off_screen_window() -> vtkRenderWindow:
    """EGL needs no display and works the same with and without one; else what VTK offers."""
    kind = getattr(vtkRenderingOpenGL2, "vtkEGLRenderWindow", vtkRenderWindow)
    window: vtkRenderWindow = kind()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    return window
