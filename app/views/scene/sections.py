"""The CT itself in the 3D picture: slices as textured planes, and the volume as rays see it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from math import ceil

import numpy as np
from numpy.typing import NDArray
from vtkmodules import vtkRenderingVolumeOpenGL2  # its import registers the OpenGL classes
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction, vtkPlane
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkColorTransferFunction,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkTexture,
    vtkVolume,
    vtkVolumeProperty,
)

from app.core.arrays import FloatArray
from app.imaging.body import body_mask
from app.imaging.oblique import oblique_image
from app.planning.patient import Patient
from app.views.scene.actors import place_by
from app.views.scene.display import Rgb, Section
from app.views.scene.surfaces import reduced

MOST_PIXELS = 512
"""Columns or rows of a plane's picture."""

INSIDE = 0.3
"""Share of body around a pixel from which it is shown: air around the patient hides nothing."""

BEHIND_MM = 0.3
"""A cut's picture stands this far behind it, so that a needle in the plane is drawn over it."""

GPU_CELLS, SOFTWARE_CELLS = 256, 96
"""Cells of the rendered volume along its longest side, with a graphics card and without."""


class SectionActor:
    """A section as a rectangle with the CT on it; transparent outside the body."""

    def __init__(self, renderer: vtkRenderer) -> None:
        self._plane, self._texture = vtkPlaneSource(), vtkTexture()
        self._texture.InterpolateOn()
        self._texture.SetWrap(vtkTexture.ClampToEdge)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(self._plane.GetOutputPort())
        self._actor = vtkActor()
        self._actor.SetMapper(mapper)
        self._actor.SetTexture(self._texture)
        self._actor.ForceOpaqueOn()  # pixels are there or not: nothing to be sorted
        self._actor.GetProperty().LightingOff()
        self._actor.VisibilityOff()
        renderer.AddActor(self._actor)

    def place(self, section: Section | None) -> None:
        """Stand where a section is; hidden without one."""
        self._actor.SetVisibility(section is not None)
        if section is None:
            return
        frame, (left, top, right, bottom) = section.frame, _extent(section)
        pixel = max(right - left, bottom - top) / MOST_PIXELS
        columns, rows = ceil((right - left) / pixel), ceil((bottom - top) / pixel)
        for set_corner, x, y in (
            (self._plane.SetOrigin, left, top),
            (self._plane.SetPoint1, left + columns * pixel, top),
            (self._plane.SetPoint2, left, top + rows * pixel),
        ):
            set_corner(*frame.lps_mm(x, y))
        picture = _picture(section, left, top, pixel, columns, rows)
        image = vtkImageData()
        image.SetDimensions(columns, rows, 1)
        image.GetPointData().SetScalars(numpy_to_vtk(picture.reshape(-1, 4), deep=True))
        self._texture.SetInputData(image)

    def step_back(self, towards: FloatArray | None) -> None:
        """Stand a little behind its plane, seen from where `towards` points; None stands in it."""
        self._actor.SetPosition(*(np.zeros(3) if towards is None else -BEHIND_MM * towards))


def _extent(section: Section) -> tuple[float, float, float, float]:
    """Left, top, right and bottom [mm] of what the volume fills in a plane, at most."""
    volume = section.patient.volume
    ends = np.array([[-0.5, size - 0.5] for size in volume.size])
    corners = volume.lps_mm(np.array(list(product(*ends))))
    at = np.array([section.frame.point(corner)[:2] for corner in corners])
    (left, top), (right, bottom) = at.min(axis=0).tolist(), at.max(axis=0).tolist()
    return left, top, right, bottom


def _picture(
    section: Section, left: float, top: float, pixel: float, columns: int, rows: int
) -> NDArray[np.uint8]:
    """Pixels of a section, RGBA, shape (rows, columns, 4)."""
    plane = section.frame.pixels(left, top, pixel, columns, rows, 0.0)
    patient, window = section.patient, section.window
    hu = oblique_image(patient.volume, plane)
    grey = np.clip((hu - (window.level - window.width / 2)) * (255.0 / window.width), 0.0, 255.0)
    coarse = max(1, round(2.0 / pixel))  # the body is known on a coarse grid
    points = plane.points_mm()[::coarse, ::coarse]
    share = patient.body.share(points.reshape(-1, 3)).reshape(points.shape[:2])
    inside = np.repeat(np.repeat(share > INSIDE, coarse, axis=0), coarse, axis=1)[:rows, :columns]
    picture = np.empty((rows, columns, 4), np.uint8)
    picture[:, :, :3] = grey[:, :, None]
    picture[:, :, 3] = np.where(inside, 255, 0)
    return picture


@dataclass(frozen=True, slots=True)
class Preset:
    """How rays see values.

    Attributes:
        points: value [HU], colour and opacity at it [1 per 10 mm], rising; linear between.
        shaded: whether light falls on edges.
    """

    points: tuple[tuple[float, Rgb, float], ...]
    shaded: bool = True


_SKIN, _FLESH, _IVORY = (0.86, 0.68, 0.57), (0.72, 0.36, 0.30), (0.96, 0.92, 0.83)

PRESETS: Mapping[str, Preset] = {
    "bone": Preset(
        (
            (-1000.0, _FLESH, 0.0),
            (140.0, _FLESH, 0.0),
            (240.0, (0.80, 0.58, 0.42), 0.15),
            (400.0, _IVORY, 0.7),
            (3000.0, (1.0, 1.0, 1.0), 0.95),
        )
    ),
    "skin": Preset(
        (
            (-1000.0, _SKIN, 0.0),
            (-550.0, _SKIN, 0.0),
            (-300.0, _SKIN, 0.5),
            (0.0, _SKIN, 0.85),
            (300.0, _IVORY, 0.95),
            (3000.0, _IVORY, 0.95),
        )
    ),
    "lung": Preset(
        (
            (-1000.0, (0.3, 0.5, 0.8), 0.0),
            (-960.0, (0.3, 0.5, 0.8), 0.0),
            (-850.0, (0.45, 0.65, 0.9), 0.03),
            (-650.0, (0.7, 0.8, 0.95), 0.10),
            (-450.0, (0.9, 0.75, 0.7), 0.06),
            (-300.0, (0.9, 0.6, 0.5), 0.0),
            (220.0, _IVORY, 0.0),
            (500.0, _IVORY, 0.25),
            (3000.0, _IVORY, 0.4),
        )
    ),
    "vessels": Preset(
        (
            (-1000.0, _FLESH, 0.0),
            (115.0, (0.75, 0.15, 0.12), 0.0),
            (150.0, (0.85, 0.18, 0.14), 0.18),
            (260.0, (0.95, 0.45, 0.3), 0.6),
            (420.0, _IVORY, 0.35),
            (3000.0, _IVORY, 0.6),
        )
    ),
}
"""By name, in the order of the menu."""


class VolumeActor:
    """The body's values as rays see them."""

    def __init__(self, renderer: vtkRenderer) -> None:
        self._renderer = renderer
        self._mapper = vtkRenderingVolumeOpenGL2.vtkOpenGLGPUVolumeRayCastMapper()
        self._volume = vtkVolume()
        self._volume.SetMapper(self._mapper)
        self._volume.VisibilityOff()
        self._patient: Patient | None = None
        renderer.AddVolume(self._volume)

    def place(self, patient: Patient | None, preset: str, most_cells: int) -> None:
        """Show a patient by a preset; hidden without either.

        Args:
            patient: whose.
            preset: of `PRESETS`.
            most_cells: along the longest side.
        """
        shown = patient is not None and preset in PRESETS
        self._volume.SetVisibility(shown)
        if patient is None or not shown:
            return
        if patient is not self._patient:
            self._take(patient, most_cells)
        self._volume.SetProperty(_property(PRESETS[preset]))

    def forget(self) -> None:
        """Let go of the patient."""
        self._patient = None
        self._volume.VisibilityOff()
        self._mapper.RemoveAllInputs()

    def cut(self, plane: vtkPlane | None) -> None:
        """Show only what is on the normal's side of a plane; None shows all."""
        self._mapper.RemoveAllClippingPlanes()
        if plane is not None:
            self._mapper.AddClippingPlane(plane)

    def _take(self, patient: Patient, most_cells: int) -> None:
        volume = patient.volume
        step = float((volume.spacing_mm * volume.size).max()) / most_cells
        mask, air = body_mask(volume, patient.body), patient.body.skin_level - 600.0
        values, affine = reduced(lambda k: np.where(mask[k], volume.hu[k], air), volume, step)
        cell = np.linalg.norm(affine[:3, :3], axis=0)
        image = vtkImageData()
        depth, height, width = values.shape
        image.SetDimensions(width, height, depth)
        image.SetSpacing(*cell)
        scalars = np.rint(values).astype(np.int16).ravel()
        image.GetPointData().SetScalars(numpy_to_vtk(scalars, deep=True))
        self._mapper.SetInputData(image)
        place_by(self._volume, affine @ np.diag([*(1.0 / cell), 1.0]))
        self._patient = patient


def _property(preset: Preset) -> vtkVolumeProperty:
    colours, opacities = vtkColorTransferFunction(), vtkPiecewiseFunction()
    for value, colour, opacity in preset.points:
        colours.AddRGBPoint(value, *colour)
        opacities.AddPoint(value, opacity)
    shown = vtkVolumeProperty()
    shown.SetColor(colours)
    shown.SetScalarOpacity(opacities)
    shown.SetScalarOpacityUnitDistance(10.0)
    shown.SetInterpolationTypeToLinear()
    shown.SetShade(preset.shaded)
    shown.SetAmbient(0.25)
    shown.SetDiffuse(0.75)
    shown.SetSpecular(0.15)
    return shown
