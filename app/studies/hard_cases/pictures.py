"""Hard cases of pictures and scores: slices turned by 45°, far off, thin; one sample."""

from collections.abc import Callable
from dataclasses import replace
from math import log, pi
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.errors import NumericalError
from app.core.rotation import rotation_exp
from app.imaging.header import ImagePlane
from app.imaging.interpolation import Interpolation, interpolate
from app.imaging.oblique import Plane, oblique_image
from app.imaging.orthogonal import OrthogonalSlicer, View, letters
from app.imaging.stack import TOLERANCE_MM, irregular, normal, plane_affine, stack
from app.imaging.volume import Volume
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.errors import TrajectoryError
from app.scoring.paths import frechet, raw_length, resampled, smooth_length, time_warping
from app.scoring.score import score
from app.scoring.smoothness import log_dimensionless_jerk, spectral_arc_length
from app.scoring.tolerance import Bands, tolerance
from app.scoring.trajectory import Trajectory
from app.studies.hard_cases.case import HardCase, analytic, answers, digits, named
from app.studies.hard_cases.volumes import volume_of

_Way = Callable[..., Any]

OBLIQUE: Final = digits("normal of an oblique slice").given


def _plane(position: Any, orientation: Any = OBLIQUE, spacing: Any = (0.7, 0.9)) -> ImagePlane:
    return ImagePlane(tuple(position), tuple(orientation), spacing)


# --- DICOM geometry -------------------------------------------------------------------------------
def _normal() -> HardCase:
    reference = digits("normal of an oblique slice")
    return HardCase(
        subsystem="DICOM geometry",
        case="normal of a slice turned by 35° and tilted by 37°",
        given="direction cosines in double precision",
        way=normal,
        found=lambda way: way(_plane((0.0, 0.0, 0.0))),
        reference=reference,
        unit="1",
        bound=3e-16,
        beyond=answers("the letters of a direction between two axes are both", _both_letters),
    )


def _both_letters() -> bool:
    return letters((1.0, 1.0, 0.0)) in ("LP", "PL")


def _corner() -> HardCase:
    reference = digits("corner of an oblique slice 90 km off")
    v = reference.given
    plane = _plane(v[6:9], v[:6], (v[9], v[10]))

    def corner(way: _Way) -> Any:
        return (way(plane, np.zeros(3)) @ [v[11], v[12], 0.0, 1.0])[:3]

    return HardCase(
        subsystem="DICOM geometry",
        case="last corner of an oblique slice 90 km from the origin",
        given="512 × 512 pixels of 0.7 × 0.9 mm at ±9e7 mm",
        way=plane_affine,
        found=corner,
        reference=reference,
        unit="mm",
        bound=5e-8,  # two roundings of 9e7
        beyond=named(NumericalError, lambda: plane_affine(plane, np.full(3, np.nan))),
    )


def _shuffled() -> HardCase:
    """Slices in any order, tilted gantry: the grid follows the positions, not the numbers."""
    step = 1.37 * normal(_plane((0.0, 0.0, 0.0))) + 0.3 * np.array(OBLIQUE[3:])
    order = (3, 0, 4, 1, 2, 5)
    planes = [_plane(np.array([10.0, -20.0, 30.0]) + k * step) for k in order]

    def columns(way: _Way) -> Any:
        found = way(planes, (512, 512))
        return [*found.affine_mm[:3, 2], *found.affine_mm[:3, 3]]

    def uneven() -> bool:
        moved = [*planes[:-1], _plane(np.array([10.0, -20.0, 30.0]) + 5.2 * step)]
        return bool(irregular(stack(moved, (512, 512)), [str(k) for k in order]))

    return HardCase(
        subsystem="DICOM geometry",
        case="slices in no order, oblique and sheared as by a tilted gantry",
        given="six slices, 1.37 mm along the normal and 0.3 mm across",
        way=stack,
        found=columns,
        reference=analytic("the step and the first position", [*step, 10.0, -20.0, 30.0]),
        unit="mm",
        bound=1e-14,
        beyond=answers("an uneven gap is named irregular", uneven),
    )


def _rounded_cosines() -> HardCase:
    # Six decimals of the direction cosines, as scanners write them: the file's numbers rule.
    rounded = tuple(round(value, 6) for value in OBLIQUE)
    step = 1.5 * normal(_plane((0.0, 0.0, 0.0), rounded))
    planes = [_plane(np.round(k * step, 2), rounded) for k in range(40)]

    def worst(way: _Way) -> Any:
        return max(way(planes, (512, 512)).off_mm.max() - TOLERANCE_MM, 0.0)

    return HardCase(
        subsystem="DICOM geometry",
        case="positions rounded to 0.01 mm, cosines to six digits, 40 slices",
        given="an oblique series of 1.5 mm",
        way=stack,
        found=worst,
        reference=analytic("no voxel further off than 0.01 mm", 0.0),
        unit="mm",
        bound=0.0,
        beyond=answers("the letters of a direction between two axes are both", _both_letters),
    )


def _half_way() -> tuple[HardCase, ...]:
    found = []
    for angle in (44.999999, 45.0, 45.000001, 180.0):
        turned = volume_of(rotation_exp((0.0, 0.0, np.radians(angle))))
        found.append(
            HardCase(
                subsystem="DICOM geometry",
                case=f"places in the views of a volume turned by {angle:.9g}°",
                given="axial, sagittal and coronal, there and back",
                way=OrthogonalSlicer,
                found=lambda way, v=turned: _there_and_back(way(v)),
                reference=analytic("the places themselves", np.tile([1.0, 2.0, 3.0], 3)),
                unit="pixels",
                bound=1e-13,
                beyond=named(NumericalError, _flat_volume),
            )
        )
    return tuple(found)


def _there_and_back(slicer: Any) -> list[float]:
    return [
        value
        for view in View
        for value in slicer.from_lps_mm(view, slicer.to_lps_mm(view, 1, 2, 3))
    ]


def _flat_volume() -> Volume:
    flat = np.eye(3)
    flat[:, 2] = flat[:, 1]
    return volume_of(flat)


# --- oblique planes -------------------------------------------------------------------------------
def _linear_volume(direction: FloatArray, shape: tuple[int, int, int]) -> Volume:
    # A volume whose values are 2 i - 3 j + 5 k, which trilinear slices must keep.
    k, j, i = np.indices(shape)
    hu = (2 * i - 3 * j + 5 * k).astype(np.int16)
    return volume_of(direction, shape, hu=hu)


def _linear_at(volume: Volume, points_mm: FloatArray) -> FloatArray:
    i, j, k = np.moveaxis(volume.voxel(points_mm.reshape(-1, 3)), -1, 0)
    return 2.0 * i - 3.0 * j + 5.0 * k


def _sliced() -> tuple[HardCase, ...]:
    volume = _linear_volume(rotation_exp((0.1, -0.2, 0.3)), (9, 11, 13))
    middle = volume.lps_mm((6.0, 5.0, 4.0))
    right, down, up = volume.direction.T
    found = []
    for words, across, below in (
        ("along two axes of the voxels", right, down),
        ("through an axis, turned by 1e-9 rad", right, down + 1e-9 * up),
        ("through an axis, turned by 45°", right, (down + up) / np.sqrt(2.0)),
        ("through no axis", *rotation_exp((0.3, 0.2, -0.4))[:2]),
    ):
        plane = Plane.centred(middle, across, below / np.linalg.norm(below), 0.3, 9, 9)
        found.append(
            HardCase(
                subsystem="oblique planes",
                case=f"a plane {words}",
                given="values 2 i - 3 j + 5 k, 9 × 9 pixels of 0.3 mm",
                way=oblique_image,
                found=lambda way, p=plane: way(volume, p),
                reference=analytic(
                    "the linear field at the pixels' centres",
                    _linear_at(volume, plane.points_mm()),
                ),
                unit="HU",
                bound=5e-6,  # of a single precision picture
                beyond=answers("the value for outside, everywhere, far away", _far_away),
            )
        )
    return tuple(found)


def _far_away() -> bool:
    volume = _linear_volume(np.eye(3), (5, 5, 5))
    plane = Plane.centred(np.array([1e6, 0.0, 0.0]), np.eye(3)[0], np.eye(3)[1], 1.0, 4, 4)
    return bool((oblique_image(volume, plane, outside_hu=-1024.0) == -1024.0).all())


def _thin() -> tuple[HardCase, ...]:
    values = np.array([[[3.0], [7.0]]])  # k = 1, j = 2, i = 1
    at = np.array([[0.0, 0.25, 0.0], [-1e6, 1.0, 0.0], [0.5, 1e6, -1e6]])
    return tuple(
        HardCase(
            subsystem="oblique planes",
            case=f"a volume of one slice and one column, read by {way_name}",
            given="2 voxels; inside, and 1e6 voxels away",
            way=interpolate,
            found=lambda way, w=way_name: way(values, at, w),
            reference=analytic("between the two values; the edge goes on", right),
            unit="HU",
            bound=1e-14,
            beyond=answers("the value for outside, everywhere, far away", _far_away),
        )
        for way_name, right in (
            (Interpolation.NEAREST, (3.0, 7.0, 7.0)),
            (Interpolation.TRILINEAR, (4.0, 7.0, 7.0)),
        )
    )


# --- metrics --------------------------------------------------------------------------------------
FULCRUM: Final = np.array([0.0, 0.16056, 0.090])


def _attempt(n: int) -> Trajectory:
    plan = PlacedPlan.of(Plan(np.zeros(3), np.array([0.0, 80.0, 0.0])), Placement(), FULCRUM)
    depth = np.linspace(0.0, plan.length, n)
    return Trajectory(
        placed=plan,
        time=0.01 * np.arange(n, dtype=np.float64),
        tip=plan.p_entry + np.outer(depth, plan.axis),
        axis=np.tile(plan.axis, (n, 1)),
        depth=depth,
        felt=np.zeros((n, 3)),
        phase=np.full(n, "inserting"),
        depth_valid=np.ones(n, dtype=bool),
    )


def _one_sample() -> HardCase:
    def bounded(way: _Way) -> Any:
        result = way(_attempt(1))
        values = [row.value for row in result.rows if row.value is not None]
        silent = [row for row in result.rows if row.value is None and not row.note]
        return [float(not np.isfinite(values).all()), float(len(silent))]

    return HardCase(
        subsystem="metrics",
        case="an attempt of one sample has every value finite, or a reason",
        given="one sample at the skin",
        way=score,
        found=bounded,
        reference=analytic("no value that is no number, no row without a word", (0.0, 0.0)),
        unit="rows",
        bound=0.0,
        beyond=named(TrajectoryError, lambda: replace(_attempt(3), time=np.array([0.0, 1.0, 1.0]))),
    )


def _smoothness() -> tuple[HardCase, ...]:
    rate = 100.0
    bell = np.exp(-5.0 * np.arange(-1.0, 1.0, 1.0 / rate) ** 2)
    # v = t (1 - t) has the constant second difference -2 / n² in n steps.
    n = 200
    t = np.arange(n) / n
    parabola = t * (1.0 - t)
    duration = n / rate
    bends = 2.0 / duration**2
    right = -log(duration**3 / 0.25**2 * bends**2 * (n - 2) / rate)
    return (
        HardCase(
            subsystem="metrics",
            case="smoothness by the spectral arc, of the published bell",
            given="exp(-5 t²), -1 to 1 s at 100 Hz",
            way=spectral_arc_length,
            found=lambda way: way(bell, rate),
            reference=analytic("-1.41403, of the authors' own program", -1.41403),
            unit="1",
            bound=1e-5,
            beyond=answers(
                "0 for one sample, never NaN", lambda: spectral_arc_length(np.ones(1), 100.0) <= 0.0
            ),
        ),
        HardCase(
            subsystem="metrics",
            case="jerk of a parabola of speed at 100 Hz",
            given="t (1 - t), 200 samples",
            way=log_dimensionless_jerk,
            found=lambda way: way(parabola, rate),
            reference=analytic("-ln(T³/v² ∫ (2/T²)² dt), in closed form", right),
            unit="1",
            bound=1e-9,  # second differences of 0.25, ε n²
            beyond=answers("finite for a kink of 1e-8 in a straight line", _barely_bent),
        ),
    )


def _barely_bent() -> bool:
    speed = np.linspace(0.0, 1.0, 100)
    speed[50] += 1e-8
    return bool(np.isfinite(log_dimensionless_jerk(speed, 100.0)))


def _lengths() -> tuple[HardCase, ...]:
    time = np.arange(0.0, 60.0, 0.01)
    turn = pi * time / time[-1]
    half = 0.05 * np.column_stack([np.cos(turn), np.sin(turn), np.zeros(len(turn))])
    still = np.tile([1e3, -1e3, 1e3], (1000, 1)) + 0.0
    line = resampled(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.1]]))
    beside = line + np.array([0.003, 0.0, 0.0])
    return (
        HardCase(
            subsystem="metrics",
            case="length of a minute along a half circle, in blocks",
            given="6000 samples, radius 50 mm",
            way=smooth_length,
            found=lambda way: way(time, half),
            reference=analytic("50 π mm", 0.05 * pi),
            unit="m",
            bound=1e-5,  # chords and block means, each δ²/24 of it, δ = π/120
            beyond=answers(
                "0 for a single point", lambda: smooth_length(time[:1], half[:1]) == 0.0
            ),
        ),
        HardCase(
            subsystem="metrics",
            case="length of a tip that rests 1 km from the origin",
            given="1000 samples at one place",
            way=raw_length,
            found=lambda way: way(still),
            reference=analytic("nothing", 0.0),
            unit="m",
            bound=0.0,
            beyond=answers("0 for no points", lambda: raw_length(np.zeros((0, 3))) == 0.0),
        ),
        HardCase(
            subsystem="metrics",
            case="Fréchet distance of a path 3 mm beside another",
            given="200 points each",
            way=frechet,
            found=lambda way: way(line, beside),
            reference=analytic("3 mm", 0.003),
            unit="m",
            bound=1e-17,
            beyond=answers("of one point to itself 0", lambda: frechet(line[:1], line[:1]) == 0.0),
        ),
        HardCase(
            subsystem="metrics",
            case="mean distance of a path and the same walked with a long rest",
            given="200 points, and the same with the middle 500 times",
            way=time_warping,
            found=lambda way: way(line, np.insert(beside, [100] * 500, beside[100], axis=0)),
            reference=analytic("3 mm: a rest costs no more than the way beside", 0.003),
            unit="m",
            bound=1e-16,
            beyond=answers(
                "of one point to itself 0", lambda: time_warping(line[:1], line[:1]) == 0
            ),
        ),
    )


def _knots() -> HardCase:
    bands = Bands.model_validate({"expert": 1e-300, "good": 1.0, "pass": 1e300, "zero": 1.5e300})
    values = (0.0, -0.0, 5e-324, 1e-300, 1.0, 1e300, 1.5e300, 1e308)
    right = (1.0, 1.0, 1.0, 1.0, 0.8, 0.6, 0.0, 0.0)

    return HardCase(
        subsystem="metrics",
        case="utility at its knots, from 5e-324 to 1e308",
        given="bands at 1e-300, 1, 1e300, 1.5e300",
        way=tolerance,
        found=lambda way: [way(value, bands) for value in values],
        reference=analytic("1, 0.8, 0.6 and 0 at the knots", right),
        unit="1",
        bound=1e-15,
        beyond=named(NumericalError, lambda: tolerance(np.nan, bands)),
    )


CASES: Final = (
    _normal(),
    _corner(),
    _shuffled(),
    _rounded_cosines(),
    *_half_way(),
    *_sliced(),
    *_thin(),
    _one_sample(),
    *_smoothness(),
    *_lengths(),
    _knots(),
)
"""DICOM geometry, oblique planes, metrics."""
