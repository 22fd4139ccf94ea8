"""Time of an oblique slab of 512 x 512 pixels and 10 mm against vtkImageReslice on one core."""

import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageReslice

from app.imaging.oblique import Plane
from app.imaging.series import Series
from app.imaging.slab import Projection, slab_image, slab_samples
from app.imaging.volume import Volume

SIZE, PIXELS, THICKNESS_MM, REPEATS = (300, 256, 256), 512, 10.0, 7


def volume() -> Volume:
    """Noise of a CT's range, 1 mm cubes."""
    hu = np.random.default_rng(1).integers(-1000, 1500, SIZE).astype(np.int16)
    k, j, i = SIZE
    series = Series("1", "CT", "b", (i, j, k), None, None, None, True, "", (), "CT", "1", ())
    return Volume(hu, np.eye(4), series)


def best(step) -> float:
    """Shortest of some runs [ms]."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        step()
        times.append(1e3 * (time.perf_counter() - start))
    return min(times)


def peer(shown: Volume, plane: Plane, samples: int):
    """Return a slicer of VTK with as many samples."""
    image = vtkImageData()
    image.SetDimensions(*shown.size)
    image.GetPointData().SetScalars(numpy_to_vtk(shown.hu.ravel()))
    right, down = (v / np.linalg.norm(v) for v in (plane.across_mm, plane.down_mm))
    reslice = vtkImageReslice()
    reslice.SetInputData(image)
    reslice.SetOutputDimensionality(2)
    reslice.SetResliceAxesDirectionCosines(*right, *down, *np.cross(right, down))
    reslice.SetResliceAxesOrigin(*plane.corner_mm)
    pixel = float(np.linalg.norm(plane.across_mm))
    reslice.SetOutputSpacing(pixel, pixel, 1.0)
    reslice.SetOutputExtent(0, plane.columns - 1, 0, plane.rows - 1, 0, 0)
    reslice.SetOutputOrigin(0, 0, 0)
    reslice.SetInterpolationModeToLinear()
    reslice.SetSlabModeToMax()
    reslice.SetSlabNumberOfSlices(samples)
    reslice.SetSlabSliceSpacingFraction(1.0)
    reslice.SetNumberOfThreads(1)
    reslice.SetEnableSMP(False)

    def run():
        reslice.Modified()
        reslice.Update()
        return vtk_to_numpy(reslice.GetOutput().GetPointData().GetScalars())

    return run


def test_slab_against_vtk():
    shown = volume()
    right = np.array([0.8, 0.6, 0.0])
    down = np.cross([0.36, -0.48, 0.8], right)
    plane = Plane.centred(shown.lps_mm([128, 128, 150]), right, down, 0.4, PIXELS, PIXELS)
    samples = slab_samples(shown, THICKNESS_MM)
    theirs = peer(shown, plane, samples)
    lines = []
    for way in Projection:
        slab_image(shown, plane, THICKNESS_MM, way)
        lines.append((way, best(lambda way=way: slab_image(shown, plane, THICKNESS_MM, way))))
    vtk_ms = best(theirs)
    print(f"\noblique slab {PIXELS} x {PIXELS}, {THICKNESS_MM:g} mm, {samples} samples")
    for way, ours in lines:
        print(f"  {way}: {ours:.1f} ms; vtkImageReslice MIP {vtk_ms:.1f} ms; {ours / vtk_ms:.2f}")
