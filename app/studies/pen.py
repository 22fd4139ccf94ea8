"""Study: how well one webcam knows a pen with printed markers, and whether it says so honestly."""

from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, unit
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.mechanisms.profile import load_profile
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey
from app.tracking.cameras.camera import CameraFrame
from app.tracking.confidence import chi_square_quantile
from app.tracking.optics.calibration import CameraCalibration
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import CameraProfile
from app.tracking.pen.board import Marker, MarkerBoard
from app.tracking.pen.body import PenProfile, TipProfile, load_pen
from app.tracking.pen.detector import MarkerSighting
from app.tracking.pen.locator import BoardLocator
from app.tracking.pen.needle import PenTip, solve_needle
from app.tracking.pen.pose import PoseStatus
from app.tracking.pen.step import PenStep
from app.tracking.pen.webcam import Webcam
from app.tracking.simulated.pen import PenRenderer
from app.tracking.simulated.pen_scene import PenScene, body_pose

DECLARATION: Final[dict[str, Any]] = {
    "title": "A pen with printed markers before one webcam",
    "question": "How well is a needle known that is a pen before a webcam?",
    "reference": "rendered pictures with known truth; trials with everything declared drawn anew",
}


_FOCAL_PER_WIDTH: Final = 0.97


@dataclass(frozen=True, slots=True)
class Setup:
    """A condition: edge of the cube [mm], distance of the webcam [m], width of its pictures [px],
    height, and noise [grey levels].
    """

    edge_mm: float = 40.0
    distance: float = 0.45
    width: int = 640
    height: int = 480
    noise: float = 4.0

    def pen(self) -> PenProfile:
        """Return the cube of this size, print and tip exact."""
        pen = load_pen("cube")
        body = pen.body.model_copy(
            update={"edge_mm": self.edge_mm, "marker_mm": 0.75 * self.edge_mm, "build_sd_mm": 0.0}
        )
        base = pen.base.model_copy(update={"build_sd_mm": 0.0})
        exact = TipProfile(covariance_mm2=((0.0,) * 3,) * 3, axis_sd_deg=0.0)
        return pen.model_copy(update={"body": body, "base": base, "tip": exact})

    def camera(self) -> CameraModel:
        """Return a webcam in front of the sheet and above it, looking at where the cube is."""
        entry = load_profile("icube").fulcrum / MILLIMETRE
        looks_at = entry + np.array([0.0, 0.0, 70.0])
        way = unit([0.15, 0.80, 0.50])
        position = looks_at + self.distance / MILLIMETRE * way
        focal = _FOCAL_PER_WIDTH * self.width
        return CameraProfile(
            name="webcam",
            image_size=(self.width, self.height),
            focal_px=(focal, focal),
            centre_px=(0.5 * (self.width - 1), 0.5 * (self.height - 1)),
            distortion=(-0.05, 0.02, 0.0, 0.0, 0.0),
            position_mm=_triple(position),
            looks_at_mm=_triple(looks_at),
        ).model()


SETUPS: Final = (
    Setup(),
    Setup(edge_mm=30.0),
    Setup(edge_mm=50.0),
    Setup(distance=0.35),
    Setup(distance=0.60),
    Setup(width=1280, height=720),
    Setup(distance=0.60, width=1280, height=720),
    Setup(noise=1.0),
    Setup(noise=8.0),
)


def _triple(values: FloatArray) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return x, y, z


_POSES: Final = 24
_TRIALS: Final = 1000
_SEED: Final = 5


@dataclass(frozen=True, slots=True, eq=False)
class Outcome:
    """Errors of tip [m] and axis [rad], and squared Mahalanobis distances of the tip."""

    tip: FloatArray
    axis: FloatArray
    distance: FloatArray
    share: float


def rendered(setup: Setup, poses: int = _POSES, seed: int = _SEED) -> Outcome:
    """Errors in rendered pictures over the workspace: an exact print, the pictures' error alone."""
    pen, model, rng = setup.pen(), setup.camera(), np.random.default_rng(seed)
    entry = load_profile("icube").fulcrum
    draw = PenRenderer(
        model, pen.body.board(), pen.base.board(), pen.base.pose(entry), setup.edge_mm * MILLIMETRE
    )
    known = PenStep(pen, _lens(model), entry)
    tips, axes, distances = [], [], []
    for _ in range(poses):
        T_world_body, p_tip, axis = _held(rng, entry)
        image = draw.render(PenScene(T_world_body, p_tip)).astype(np.float64)
        image += rng.normal(0.0, setup.noise, image.shape[:2])[..., None]
        frame = CameraFrame(np.clip(np.rint(image), 0, 255).astype(np.uint8), 1.0)
        needle = known.observe(frame).needle
        if needle is None:
            continue
        error = needle.p_tip - p_tip
        tips.append(float(np.linalg.norm(error)))
        axes.append(float(np.linalg.norm(np.cross(needle.axis, axis))))
        distances.append(float(error @ np.linalg.solve(needle.tip_covariance, error)))
    share = len(tips) / poses
    return Outcome(np.array(tips), np.array(axes), np.array(distances), share)


def trials(count: int = _TRIALS, seed: int = _SEED) -> Outcome:
    """Errors with print, tip and corners drawn anew from what is declared of them."""
    pen, model, rng = load_pen("cube"), Setup().camera(), np.random.default_rng(seed)
    entry = load_profile("icube").fulcrum
    tip = PenTip.of(pen.tip)
    boards = (pen.body.board(), replace(pen.base.board(), markers=pen.base.board().markers[::2]))
    locators = [BoardLocator(board) for board in boards]
    tips, axes, distances = [], [], []
    for _ in range(count):
        T_world_body, _, _ = _held(rng, entry)
        drawn = rng.multivariate_normal(np.zeros(6), tip.covariance)
        p_tip, axis = (
            T_world_body @ (tip.p_tip + drawn[:3]),
            T_world_body.rotate(tip.axis + drawn[3:]),
        )
        poses = [
            locator.locate(model, _sightings(model, model.T_camera_world @ T, board, rng))
            for locator, board, T in zip(
                locators, boards, (T_world_body, pen.base.pose(entry)), strict=True
            )
        ]
        if any(pose.status is not PoseStatus.FOUND for pose in poses):
            continue
        needle = solve_needle(poses[0], poses[1], pen.base.pose(entry), tip, np.zeros((9, 9)))
        error = needle.p_tip - p_tip
        tips.append(float(np.linalg.norm(error)))
        axes.append(float(np.linalg.norm(np.cross(needle.axis, unit(axis)))))
        distances.append(float(error @ np.linalg.solve(needle.tip_covariance, error)))
    return Outcome(np.array(tips), np.array(axes), np.array(distances), len(tips) / count)


def _held(
    rng: np.random.Generator, entry: FloatArray
) -> tuple[RigidTransform, FloatArray, FloatArray]:
    """Pose of a pen in the hole: any lean up to 30°, any depth, any turn; its tip and axis."""
    lean, way = np.tan(30.0 * DEGREE) * np.sqrt(rng.uniform()), rng.uniform(0.0, 2.0 * np.pi)
    axis = unit([lean * np.cos(way), lean * np.sin(way), -1.0])
    p_tip = entry + rng.uniform(-0.02, 0.09) * axis
    tip = PenTip.of(load_pen("cube").tip)
    roll = rng.uniform(0.0, 2.0 * np.pi)
    return body_pose(p_tip, axis, tip.p_tip, tip.axis, roll), p_tip, axis


def _sightings(
    model: CameraModel, T_camera_board: RigidTransform, board: MarkerBoard, rng: np.random.Generator
) -> list[MarkerSighting]:
    """Corners of all faces that the camera sees well, with the print's errors and 0.05 px."""
    found = []
    for marker in board.markers:
        if _slant(T_camera_board, marker) < 0.35:
            continue
        corners = marker.corners + rng.normal(0.0, board.build_sd, (4, 3))
        uv, _ = model.project_camera(T_camera_board @ corners)
        noisy = uv + rng.normal(0.0, 0.05, (4, 2))
        found.append(MarkerSighting(marker.id, noisy, 0.05**2 * np.eye(8)))
    return found


def _slant(pose: RigidTransform, marker: Marker) -> float:
    """Cosine between a face's normal and the way to the camera; negative from behind."""
    centre = pose @ marker.corners.mean(axis=0)
    return float(-pose.rotate(marker.normal) @ unit(centre))


def _lens(model: CameraModel) -> Webcam:
    fx, fy, cx, cy = model.intrinsics.tolist()
    return Webcam(
        CameraCalibration(
            name=model.name,
            image_size=model.image_size,
            focal_px=(fx, fy),
            centre_px=(cx, cy),
            lens=model.lens,
            distortion=tuple(model.distortion.tolist()),
        )
    )


_LIMIT: Final = 0.95


def _inside(outcome: Outcome) -> float:
    """Share of the tips inside the 95 % ellipsoid [%]."""
    return 100.0 * float(np.mean(outcome.distance < chi_square_quantile(_LIMIT, 3)))


def _row(setup: Setup, result: Outcome) -> tuple[Cell, ...]:
    if not len(result.tip):
        return (
            setup.edge_mm,
            setup.distance,
            f"{setup.width}x{setup.height}",
            setup.noise,
            0.0,
            "-",
            "-",
            "-",
            "-",
            "-",
        )
    return (
        setup.edge_mm,
        setup.distance,
        f"{setup.width}x{setup.height}",
        setup.noise,
        100.0 * result.share,
        float(np.sqrt(np.mean(result.tip**2))) / MILLIMETRE,
        float(np.percentile(result.tip, 95)) / MILLIMETRE,
        float(np.sqrt(np.mean(result.axis**2))) / DEGREE,
        float(np.percentile(result.axis, 95)) / DEGREE,
        _inside(result),
    )


def _measure(progress: Progress | None = None) -> Findings:
    watch = progress or Progress()
    rows, outcomes = [], []
    for number, setup in enumerate(SETUPS):
        watch.report(
            0.7 * number / len(SETUPS), sentence("cube of {edge_mm:g} mm", edge_mm=setup.edge_mm)
        )
        outcomes.append(rendered(setup))
        rows.append(_row(setup, outcomes[-1]))
    watch.report(0.7, sentence("trials"))
    drawn = trials()
    sheet = Sheet(
        "workspace",
        "Error of the needle in rendered pictures, print and tip exact",
        (
            "edge [mm]",
            "distance [m]",
            "pictures",
            "noise [grey]",
            "found [%]",
            "tip RMS [mm]",
            "tip 95 % [mm]",
            "axis RMS [°]",
            "axis 95 % [°]",
            "in 95 % ellipsoid [%]",
        ),
        tuple(rows),
    )
    lines = (
        f"With a print to 0.2 mm, a tip by the drawing (2 mm across, 5 mm along) and 0.05 px in "
        f"the corners: tip {np.sqrt(np.mean(drawn.tip**2)) / MILLIMETRE:.1f} mm RMS, axis "
        f"{np.sqrt(np.mean(drawn.axis**2)) / DEGREE:.1f}° RMS.",
        f"In {len(drawn.tip)} such trials the 95 % ellipsoid of the tip held the truth in "
        f"{_inside(drawn):.1f} %.",
    )
    return Findings((sheet,), (Figure("errors", lambda figure: _draw(figure, outcomes)),), lines)


def _draw(figure: Any, outcomes: list[Outcome]) -> None:
    axes = figure.add_subplot(1, 1, 1)
    names = [f"{s.edge_mm:g} mm, {s.distance:g} m,\n{s.width} px, {s.noise:g} grey" for s in SETUPS]
    axes.boxplot([outcome.tip / MILLIMETRE for outcome in outcomes], tick_labels=names)
    axes.set(ylabel="error of the tip [mm]")
    axes.tick_params(axis="x", labelsize=6, rotation=30)
    axes.grid(True, axis="y", color="#DDDDDD", linewidth=0.5)
    figure.tight_layout()


STUDY: Final = Survey(
    measure=_measure,
)
