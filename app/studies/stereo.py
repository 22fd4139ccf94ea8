"""Study: how exact a triangulated point is, by three ways, over the workspace of two rigs.

Figure 42 of the thesis redone: its E_stereo beside the error that the same pixels really make. The
pixel's noise is the published reprojection error of both cameras, e/√2 per axis.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.studies.findings import Figure, Findings, Sheet
from app.studies.in_use import called
from app.studies.printed_formulas import printed_stereo_error
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way
from app.tracking import solver
from app.tracking.confidence import covariance_radius
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.stereo import kernels, triangulation
from app.tracking.stereo.closed_form import linear
from app.tracking.stereo.epipolar import normalised
from app.tracking.stereo.reprojection import reprojection

DECLARATION: Final[dict[str, Any]] = {
    "title": "Triangulation: three ways, and figure 42 redone",
    "question": "How exact is a triangulated point, and which way is good enough?",
    "reference": "the point itself, exact; noise of the published reprojection errors",
}

RMS_PX: Final = (0.29904, 0.23065)
"""Reprojection errors of the laboratory's two cameras [px], 2D."""

RIGS: Final = ("thesis", "wide")
_SIGMAS: Final = tuple(e / np.sqrt(2.0) for e in RMS_PX)
_FULCRUM: Final = np.array([0.0, 0.16056, 0.090])
_SEEN: Final = 0.25  # [mm]
_POINTS: Final = 200
_TRIALS: Final = 400
_STEP: Final = 4.0 * MILLIMETRE


def workspace(rig: RigProfile, step: float = _STEP) -> FloatArray:
    """Points [m], (n, 3), of the upright plane through the fulcrum that both cameras see.

    Within 45° of the needle's cone and from 10 to 130 mm below the fulcrum.
    """
    x, down = np.meshgrid(np.arange(-0.1, 0.1, step), np.arange(0.01, 0.13, step))
    points = np.stack([x.ravel(), np.zeros(x.size), -down.ravel()], axis=1) + _FULCRUM
    inside = np.abs(x.ravel()) <= down.ravel()
    seen = np.all([model.sees(points, 5.0) for model in rig.models], axis=0)
    return np.asarray(points[inside & seen])


def observe(rig: RigProfile, point: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Pixels (2, 2), rays (2, 2) and the rays' covariances (2, 2, 2) of a point without noise."""
    pixels = np.array([model.project(point)[0][0] for model in rig.models])
    return (pixels, *_rays(rig, pixels))


def _rays(rig: RigProfile, pixels: FloatArray) -> tuple[FloatArray, FloatArray]:
    rays, covariances = np.empty((2, 2)), np.empty((2, 2, 2))
    for i, model in enumerate(rig.models):
        found = normalised(model, pixels[i], _SIGMAS[i] ** 2 * np.eye(2))
        if found is None:
            raise ValueError(
                sentence(
                    "no ray of camera {model_name} for {pixels}",
                    model_name=model.name,
                    pixels=pixels[i],
                )
            )
        rays[i], covariances[i] = found
    return rays, covariances


def figures(rig: RigProfile, point: FloatArray) -> tuple[float, float, float]:
    """E_stereo as printed, 3D RMS √trace, and 95 % radius [m] of a point."""
    poses = tuple(model.T_camera_world for model in rig.models)
    _, rays, covariances = observe(rig, point)
    normal = reprojection(poses, rays, point)[1].reshape(2, 2, 3)
    by_ray = [np.linalg.inv(m.ray_jacobian(r)) for m, r in zip(rig.models, rays, strict=True)]
    in_pixels = np.array([a @ b for a, b in zip(by_ray, normal, strict=True)])
    stacked = normal.reshape(4, 3)
    weights = np.zeros((4, 4))
    weights[:2, :2], weights[2:, 2:] = np.linalg.inv(covariances)
    spread: FloatArray = np.asarray(np.linalg.inv(stacked.T @ weights @ stacked), dtype=np.float64)
    return (
        printed_stereo_error(in_pixels, _SIGMAS[0] ** 2),
        float(np.sqrt(np.trace(spread))),
        covariance_radius(spread),
    )


def simulated(rig: RigProfile, point: FloatArray, way: triangulation.Way, seed: int) -> FloatArray:
    """Errors [m], (n, 3), of a point that is triangulated from noisy pixels."""
    rng = np.random.default_rng(seed)
    pixels = observe(rig, point)[0]
    poses = (rig.models[0].T_camera_world, rig.models[1].T_camera_world)
    errors = np.empty((_TRIALS, 3))
    for k in range(_TRIALS):
        noisy = pixels + rng.standard_normal((2, 2)) * np.array(_SIGMAS)[:, None]
        rays, covariances = _rays(rig, noisy)
        found = triangulation.triangulate(poses, rays, covariances, way)
        errors[k] = found.p_world - point
    return errors


def _case(setting: Setting) -> Case:
    rig, rng = load_rig(setting.name), np.random.default_rng(5)
    points = workspace(rig)
    points = points[rng.integers(0, len(points), _POINTS)]
    shots = []
    for point in points:
        noise = rng.standard_normal((2, 2)) * np.array(_SIGMAS)[:, None]
        shots.append(_rays(rig, observe(rig, point)[0] + noise))

    def error(result: Any) -> float:
        distances = np.linalg.norm(np.array(result) - points, axis=1)
        return float(np.sqrt(np.mean(distances**2))) / MILLIMETRE

    return Case((rig, shots), error, _SEEN)


def _way(way: triangulation.Way) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        rig, shots = case.data
        poses = (rig.models[0].T_camera_world, rig.models[1].T_camera_world)

        def run() -> list[FloatArray]:
            return [
                triangulation.triangulate(poses, rays, covariances, way).p_world
                for rays, covariances in shots
            ]

        return Prepared(run, _POINTS)

    return prepare


_USED: Final[dict[triangulation.Way, object]] = {
    triangulation.Way.LINEAR: linear,
    triangulation.Way.MIDPOINT: (kernels.optimum, 0),
    triangulation.Way.REPROJECTION: (kernels.optimum, 10),
}


def _in_use() -> object:
    steps = called(solver.locate, "_STEPS")
    return called(called(solver.locate, "_triangulate"), "optimum"), steps  # type: ignore[arg-type]


def _findings() -> Findings:
    rows = []
    for name in RIGS:
        rig = load_rig(name)
        points = workspace(rig)
        maps = np.array([figures(rig, point) for point in points]) / MILLIMETRE
        chosen = np.random.default_rng(1).choice(len(points), 12, replace=False)
        ratios, inside = [], []
        for k in chosen:
            errors = simulated(rig, points[k], triangulation.Way.REPROJECTION, int(k))
            lengths = np.linalg.norm(errors, axis=1) / MILLIMETRE
            ratios.append(np.sqrt(np.mean(lengths**2)) / maps[k, 1])
            inside.append(np.mean(lengths < maps[k, 2]))
        least, middle, most = maps.min(axis=0), maps.mean(axis=0), maps.max(axis=0)
        for i, label in enumerate(_LABELS):
            rows.append((name, label, *(round(float(v[i]), 4) for v in (least, middle, most))))
        for label, values in (
            ("simulated / 3D RMS [-]", ratios),
            ("share within the 95 % radius [-]", inside),
        ):
            found = (min(values), float(np.mean(values)), max(values))
            rows.append((name, label, *(round(float(v), 3) for v in found)))
    columns = ("rig", "figure", "least", "mean", "most")
    return Findings(
        (Sheet("figure_42", "Figure 42: printed and corrected", columns, tuple(rows)),),
        (Figure("figure_42", draw, (12.0, 7.0)),),
        (
            "E_stereo is a third of the 3D RMS error and a fifth of the radius that holds 95 %; "
            "calibration errors come on top and do not average out.",
        ),
    )


_LABELS: Final = ("E_stereo as printed [mm]", "3D RMS, √trace [mm]", "95 % radius [mm]")


def draw(figure: Any) -> None:
    """Three maps for each rig, on one scale per rig."""
    for row, name in enumerate(RIGS):
        rig = load_rig(name)
        points = workspace(rig)
        maps = np.array([figures(rig, point) for point in points]) / MILLIMETRE
        for column, label in enumerate(_LABELS):
            axes = figure.add_subplot(len(RIGS), 3, 3 * row + column + 1)
            shown = axes.scatter(
                points[:, 0] / MILLIMETRE,
                (points[:, 2] - _FULCRUM[2]) / MILLIMETRE,
                c=maps[:, column],
                s=14,
                marker="s",
                vmin=0.0,
                vmax=float(maps.max()),
            )
            figure.colorbar(shown, ax=axes, shrink=0.8)
            axes.set_title(f"{name}: {label}\nmean {maps[:, column].mean():.3f}", fontsize=9)
            axes.set(aspect="equal", xlabel="x [mm]", ylabel="below the fulcrum [mm]")
    figure.tight_layout()


STUDY: Final = Study(
    error_label="RMS distance from the true point [mm]",
    ways=tuple(
        Way(way.value, way.value, _way(way), "one point from two pictures", _USED[way])
        for way in triangulation.Way
    ),
    settings=tuple(Setting(name, {}) for name in RIGS),
    case=_case,
    deadline=Limit(3e-3, "3 ms for a pair of pictures"),
    perception=Limit(_SEEN, "0.25 mm: a third of a pixel of the CT"),
    default="reprojection",
    because="its covariance is the one that is stated, at any geometry",
    in_use=_in_use,
    findings=_findings,
)
"""Three ways of triangulation, and the thesis' figure 42."""
