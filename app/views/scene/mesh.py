"""Triangle meshes as plain arrays, and the two that a patient gives: skin and bone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, map_coordinates
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkFiltersCore import (
    vtkBinnedDecimation,
    vtkFlyingEdges3D,
    vtkQuadricDecimation,
    vtkWindowedSincPolyDataFilter,
)

from app.core.arrays import FloatArray
from app.core.progress import Cancelled, Progress
from app.imaging.structures.structure import Structure

ITERATIONS, PASS_BAND = 15, 0.06
"""Of the windowed-sinc smoothing: takes steps of the voxels away, not the shape."""

SAME_WAY = 0.3
"""Cosine between gradient and triangles from which the gradient is believed as the normal."""


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """Triangles with outward normals.

    Attributes:
        points: float32, shape (n, 3).
        triangles: int32 indices, shape (m, 3).
        normals: float32 unit vectors, shape (n, 3).
    """

    points: NDArray[np.float32]
    triangles: NDArray[np.int32]
    normals: NDArray[np.float32]

    @property
    def count(self) -> int:
        """Number of triangles."""
        return len(self.triangles)


def isosurface(
    values: NDArray[Any],
    affine_mm: FloatArray,
    level: float,
    most: int,
    progress: Progress | None = None,
) -> Mesh:
    """Surface of `values` at `level`, smoothed and thinned to at most `most` triangles.

    Its normals are the values' own gradient, so that light falls on it as on the fine surface.
    Flying edges (Schroeder et al. 2015), windowed-sinc smoothing (Taubin et al. 1996), quadric
    decimation (Garland and Heckbert 1997).

    Args:
        values: shape (K, J, I).
        affine_mm: voxel (i, j, k) → LPS [mm], shape (4, 4).
        level: value on the surface.
        most: bound of the number of triangles.
        progress: reports from inside the filters, and may be cancelled there.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    edges = vtkFlyingEdges3D()
    edges.SetInputData(_image(values))
    edges.SetValue(0, level)
    edges.ComputeNormalsOff()
    smooth = vtkWindowedSincPolyDataFilter()
    smooth.SetInputConnection(edges.GetOutputPort())
    smooth.SetNumberOfIterations(ITERATIONS)
    smooth.SetPassBand(PASS_BAND)
    run(edges, progress.part(0.0, 0.2))
    run(smooth, progress.part(0.2, 0.4))
    return _to_mesh(_thin(smooth.GetOutput(), most, progress.part(0.4, 1.0)), affine_mm, values)


def structure_mesh(structure: Structure, most: int, progress: Progress | None = None) -> Mesh:
    """Surface of a structure with at most `most` triangles, where its share passes one half."""
    mask, affine = structure.mask, np.array(structure.grid_mm)
    affine[:3, 3] -= affine[:3, :3].sum(axis=1)  # the layer around it
    factors = _factors(structure, most)
    k, j, i = factors
    around = [(1, 1 + -(n + 2) % f) for n, f in zip(mask.shape, factors, strict=True)]
    share = np.pad(mask, around)
    depth, height, width = (n // f for n, f in zip(share.shape, factors, strict=True))
    share = share.reshape(depth, k, height, j, width, i).mean(axis=(1, 3, 5), dtype=np.float32)
    affine[:3, 3] += affine[:3, :3] @ (np.array([i, j, k]) - 1.0) / 2.0
    affine[:3, :3] = affine[:3, :3] * (i, j, k)
    values = gaussian_filter(np.pad(share, 1), 0.7)
    affine[:3, 3] -= affine[:3, :3].sum(axis=1)
    level = min(0.5, 0.5 * float(values.max()))  # what is thinner than a voxel stays
    return isosurface(values, affine, level, most, progress)


def _factors(structure: Structure, most: int) -> tuple[int, int, int]:
    """Voxels (k, j, i) to take together: its box has about as many cells as suit the triangles."""
    spacing = np.linalg.norm(structure.affine_mm[:3, :3], axis=0)[::-1]
    extent = spacing * structure.mask.shape
    wanted = float((extent.prod() / (50.0 * most)) ** (1.0 / 3.0))
    k, j, i = (max(1, round(wanted / s)) for s in spacing)
    return k, j, i


def coarser(mesh: Mesh, most: int, progress: Progress | None = None) -> Mesh:
    """Version of `mesh` with at most `most` triangles, made in one pass: for while it moves."""
    if mesh.count <= most:
        return mesh
    decimate = vtkBinnedDecimation()
    decimate.SetInputData(_polydata(mesh.points, mesh.triangles))
    divisions = max(4, int((most / 3.0) ** 0.5))  # a surface crosses about 1.5 d² of d³ bins
    for _ in range(8):
        decimate.SetNumberOfDivisions(divisions, divisions, divisions)
        run(decimate, progress or Progress())
        if decimate.GetOutput().GetNumberOfPolys() <= most:
            break
        divisions = max(2, int(divisions * 0.8))
    return _to_mesh(decimate.GetOutput(), np.eye(4))


def to_polydata(mesh: Mesh) -> vtkPolyData:
    """Return the mesh as VTK's, sharing no memory with it."""
    result = _polydata(mesh.points, mesh.triangles)
    result.GetPointData().SetNormals(numpy_to_vtk(mesh.normals, deep=True))
    return result


def _polydata(points: NDArray[np.float32], triangles: NDArray[Any]) -> vtkPolyData:
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    cells = vtkCellArray()
    offsets = np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int64)
    connectivity = np.ascontiguousarray(triangles, dtype=np.int64).ravel()
    cells.SetData(numpy_to_vtk(offsets, deep=True), numpy_to_vtk(connectivity, deep=True))
    result = vtkPolyData()
    result.SetPoints(places)
    result.SetPolys(cells)
    return result


def _image(values: NDArray[Any]) -> vtkImageData:
    image = vtkImageData()
    depth, height, width = values.shape
    image.SetDimensions(width, height, depth)
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(values).ravel(), deep=True))
    return image


def _thin(surface: vtkPolyData, most: int, progress: Progress) -> vtkPolyData:
    count = surface.GetNumberOfPolys()
    if count <= most:
        return surface
    decimate = vtkQuadricDecimation()
    decimate.SetInputData(surface)
    decimate.SetTargetReduction(1.0 - 0.98 * most / count)
    run(decimate, progress)
    return decimate.GetOutput()


def run(algorithm: vtkAlgorithm, progress: Progress) -> None:
    """Run a VTK filter so that it reports, and stops within itself when cancelled.

    Raises:
        Cancelled: if `progress` was cancelled; what the filter then holds is not whole.
    """

    def report(_: object, __: str) -> None:
        try:
            progress.report(algorithm.GetProgress())
        except Cancelled:  # must not be raised through VTK
            algorithm.SetAbortExecute(1)

    progress.report(0.0)
    observer = algorithm.AddObserver("ProgressEvent", report)
    try:
        algorithm.Update()
    finally:
        algorithm.RemoveObserver(observer)
    progress.report(1.0)


def _to_mesh(
    surface: vtkPolyData, affine_mm: FloatArray, values: NDArray[Any] | None = None
) -> Mesh:
    """Triangles of VTK as a mesh in the patient, its normals from the gradient of `values`."""
    if surface.GetNumberOfPolys() == 0:
        empty = np.zeros((0, 3), np.float32)
        return Mesh(empty, np.zeros((0, 3), np.int32), empty)
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(np.float64)
    placed = (points @ affine_mm[:3, :3].T + affine_mm[:3, 3]).astype(np.float32)
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    uses = np.bincount(triangles.ravel(), minlength=len(points))
    triangles = triangles[(uses[triangles] > 1).any(axis=1)]  # specks thinned to one triangle go
    if np.linalg.det(affine_mm[:3, :3]) < 0.0:  # a mirrored grid turns the triangles inside out
        triangles = triangles[:, ::-1]
    corners = placed[triangles].astype(np.float64)
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros(points.shape)
    for axis in range(3):
        shares = np.repeat(facing[:, axis], 3)
        sums[:, axis] = np.bincount(triangles.ravel(), shares, len(points))
    normals = _unit_rows(sums)
    if values is not None:
        steep = _unit_rows(-_gradient(values, points) @ np.linalg.inv(affine_mm[:3, :3]))
        same = np.einsum("ij,ij->i", steep, normals) > SAME_WAY
        normals[same] = steep[same]
    return Mesh(placed, triangles.astype(np.int32), normals.astype(np.float32))


def _gradient(values: NDArray[Any], points: FloatArray) -> FloatArray:
    """Slopes of `values`, shape (K, J, I), along i, j, k at points (i, j, k), shape (n, 3)."""
    at = points[:, ::-1].T
    slopes = np.empty(points.shape)
    for axis in range(3):
        step = np.zeros((3, 1))
        step[2 - axis] = 1.0
        ahead = map_coordinates(values, at + step, order=1, mode="nearest", output=np.float32)
        behind = map_coordinates(values, at - step, order=1, mode="nearest", output=np.float32)
        slopes[:, axis] = ahead - behind
    return slopes


def _unit_rows(vectors: FloatArray) -> FloatArray:
    """Rows of unit length; rows without a direction stay zero."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0.0)
