"""Many balls of one colour, as one actor."""

from __future__ import annotations

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkGlyph3DMapper, vtkRenderer

from app.core.arrays import FloatArray


class Cloud:
    """Balls at points."""

    def __init__(self, renderer: vtkRenderer, rgb: tuple[int, int, int], radius_mm: float) -> None:
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
        self._actor.GetProperty().SetColor(*(value / 255.0 for value in rgb))
        self._actor.GetProperty().SetAmbient(0.4)
        self._actor.VisibilityOff()
        renderer.AddActor(self._actor)

    def place(self, points_mm: FloatArray | None) -> None:
        """Stand at points [mm], shape (n, 3); hidden without."""
        shown = points_mm is not None and len(points_mm) > 0
        self._actor.SetVisibility(shown)
        if points_mm is None or not shown:
            return
        places = vtkPoints()
        places.SetData(numpy_to_vtk(np.ascontiguousarray(points_mm), deep=True))
        data = vtkPolyData()
        data.SetPoints(places)
        self._mapper.SetInputData(data)
