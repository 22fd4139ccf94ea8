"""An oblique 512² trilinear slice against vtkImageReslice and scipy.ndimage, each on one core.

Figures to reach: not slower than vtkImageReslice with one thread, at least 3 × faster than
scipy.ndimage.map_coordinates(order=1); within 0.5 HU of trilinear interpolation in double
precision. The volume is as large as a real chest CT (512² × 275, int16), with structure and noise
of ±1500 HU so that a misplaced sample shows; the planes are those of a needle that turns.
"""

import time
from collections.abc import Callable

import numpy as np
from scipy.ndimage import map_coordinates
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_FLOAT, vtkMultiThreader
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageReslice

from app.imaging.interpolation import Interpolation, interpolate
from app.imaging.oblique import OUTSIDE_HU, Plane, oblique_image
from app.imaging.series import Series
from app.imaging.volume import Volume
from app.planning.needle_planes import frame_of, in_plane, in_plane_90, probe

SHAPE, SPACING, PIXELS, PIXEL_MM = (275, 512, 512), (0.78125, 0.78125, 1.0), 512, 0.5
ROUNDS, HU_GOAL, VTK_GOAL, SCIPY_GOAL = 7, 0.5, 1.0, 3.0


def volume() -> Volume:
    """A large volume of smooth structure and strong noise."""
    rng = np.random.default_rng(1)
    k, j, i = SHAPE
    hu = rng.integers(-1500, 1500, SHAPE, dtype=np.int16)
    series = Series(
        "1", "CT", "bench", (i, j, k), None, None, None, True, "", (), "CT-BENCH", "1", ()
    )
    return Volume(hu, np.diag([*SPACING, 1.0]), series)


def planes(ct: Volume) -> list[Plane]:
    """The three planes of needles in several directions, in the middle of the volume."""
    middle = ct.lps_mm((np.array(ct.size) - 1) / 2)
    found = []
    for axis in ((0.1, 0.9, 0.2), (0.6, 0.6, -0.4), (-0.3, 0.2, 0.9)):
        needle = frame_of(middle, axis)
        for frame in (in_plane(needle), in_plane_90(needle), probe(needle)):
            half = PIXELS * PIXEL_MM / 2
            found.append(frame.pixels(-half, -half, PIXEL_MM, PIXELS, PIXELS, 0.0))
    return found


def with_vtk(ct: Volume) -> Callable[[Plane], np.ndarray]:
    """Return a slicer by vtkImageReslice with one thread, its input made once."""
    vtkMultiThreader.SetGlobalMaximumNumberOfThreads(1)
    image = vtkImageData()
    image.SetDimensions(*ct.size)
    image.SetSpacing(*SPACING)
    image.GetPointData().SetScalars(numpy_to_vtk(ct.hu.ravel(), deep=False))
    reslice = vtkImageReslice()
    reslice.SetInputData(image)
    reslice.SetNumberOfThreads(1)
    reslice.SetOutputDimensionality(2)
    reslice.SetInterpolationModeToLinear()
    reslice.SetOutputScalarType(VTK_FLOAT)
    reslice.SetBackgroundLevel(OUTSIDE_HU)
    reslice.SetOutputSpacing(PIXEL_MM, PIXEL_MM, 1.0)
    reslice.SetOutputOrigin(0.0, 0.0, 0.0)
    reslice.SetOutputExtent(0, PIXELS - 1, 0, PIXELS - 1, 0, 0)

    def cut(plane: Plane) -> np.ndarray:
        right, down = plane.across_mm / PIXEL_MM, plane.down_mm / PIXEL_MM
        reslice.SetResliceAxesDirectionCosines(*right, *down, *np.cross(right, down))
        reslice.SetResliceAxesOrigin(*plane.corner_mm)
        reslice.Modified()
        reslice.Update()
        scalars = reslice.GetOutput().GetPointData().GetScalars()
        return vtk_to_numpy(scalars).reshape(PIXELS, PIXELS)

    return cut


def with_scipy(ct: Volume) -> Callable[[Plane], np.ndarray]:
    """Return a slicer by scipy.ndimage."""

    def cut(plane: Plane) -> np.ndarray:
        ijk = ct.voxel(plane.points_mm().reshape(-1, 3))
        found = map_coordinates(ct.hu, ijk.T[::-1], np.float32, 1, cval=OUTSIDE_HU)
        return found.reshape(PIXELS, PIXELS)

    return cut


def milliseconds(cut: Callable[[Plane], object], cuts: list[Plane]) -> float:
    """Best of some rounds over all planes, for one picture [ms]."""
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        for plane in cuts:
            cut(plane)
        times.append(1e3 * (time.perf_counter() - start) / len(cuts))
    return min(times)


def error(ct: Volume, cuts: list[Plane]) -> float:
    """Largest difference from double precision over all pixels in the volume [HU]."""
    worst = 0.0
    for plane in cuts:
        points = plane.points_mm().reshape(-1, 3)
        ijk = ct.voxel(points)
        inside = ((ijk >= 0.0) & (ijk <= np.array(ct.size) - 1.0)).all(axis=1)
        exact = interpolate(ct.hu, ijk[inside], Interpolation.TRILINEAR)
        found = oblique_image(ct, plane).reshape(-1)[inside]
        worst = max(worst, float(np.abs(found - exact).max()))
    return worst


def main() -> None:
    """Print times, ratios and the error."""
    ct = volume()
    cuts = planes(ct)
    out = np.empty((PIXELS, PIXELS), np.float32)
    ours = milliseconds(lambda plane: oblique_image(ct, plane, out=out), cuts)
    vtk, scipy = milliseconds(with_vtk(ct), cuts), milliseconds(with_scipy(ct), cuts)
    worst = error(ct, cuts)
    print(
        f"{PIXELS}² trilinear, {len(cuts)} planes, {SHAPE[2]}×{SHAPE[1]}×{SHAPE[0]} int16, one core"
    )
    print(f"Acus             {ours:8.2f} ms")
    print(f"vtkImageReslice  {vtk:8.2f} ms   {vtk / ours:5.2f} × (figure: ≥ {VTK_GOAL:g})")
    print(f"scipy.ndimage    {scipy:8.2f} ms   {scipy / ours:5.2f} × (figure: ≥ {SCIPY_GOAL:g})")
    print(f"largest error against double precision {worst:.4f} HU (figure: ≤ {HU_GOAL:g})")


if __name__ == "__main__":
    main()
