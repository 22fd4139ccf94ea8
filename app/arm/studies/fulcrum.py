"""Study: how exactly two cameras know the fulcrum, and the tool that turns about it.

Everything is measured in pictures: a tool on a table and in a trocar, drawn as both cameras see it,
with noise, and found by the program's own detectors.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import numpy as np

from app.arm.eyes import (
    Fulcrum,
    FulcrumStatus,
    Pair,
    ShaftLine,
    ToolBlob,
    ToolEyes,
    ToolPose,
    ToolRenderer,
    ToolScene,
    ToolStatus,
    TrocarStatus,
    eyes,
    find_tool,
    meet_lines,
    meet_planes,
    ring_outline,
    solve_trocar,
    tool_outline,
)
from app.arm.laparoscopy import ToolBody, TrocarRing
from app.core.arrays import FloatArray, angle_between, unit
from app.core.messages import sentence
from app.core.units import DEGREE, MILLIMETRE
from app.studies.findings import Figure, Findings, Sheet
from app.studies.in_use import called
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way
from app.tracking.confidence import chi_square_quantile
from app.tracking.errors import TrackingError
from app.tracking.simulated.picture_effects import NoiseTile, noise

DECLARATION: Final[dict[str, Any]] = {
    "title": "The fulcrum from pictures: motion of the shaft, or the trocar itself",
    "question": "Which way finds the point that a tool turns about, and how far must it be turned?",
    "reference": "the point through which the tool is drawn; pictures with noise",
}

TOOL: Final = ToolBody()
OUTLINE: Final = tool_outline(TOOL)
_FULCRUM: Final = np.array([0.15, 0.0, 0.002])
_NORMAL: Final = np.array([0.05, -0.1, 1.0])
_NOISE: Final = 4.0
_SEEDS: Final = 5
_SEEN: Final = 0.5  # [mm], what the machine's own error leaves of the trocar's play
_GOAL_MM: Final = 1.0
_GOAL_DEG: Final = 1.0


class Stand:
    """Two cameras before a table with a trocar, and what the program finds in their pictures."""

    def __init__(self, noise_grey: float = _NOISE, trocar: TrocarRing | None = None) -> None:
        self.trocar = trocar or TrocarRing(_FULCRUM, _NORMAL)
        models = eyes()
        self.eyes = ToolEyes(
            models=models,
            outline=OUTLINE,
            trocar_radius=self.trocar.outer,
            noise_grey=noise_grey,
        )
        self._renderers = [ToolRenderer(model, TOOL, self.trocar) for model in models]
        self._tiles = [
            NoiseTile.make(m.image_size, noise_grey, 7 + k) for k, m in enumerate(models)
        ]

    def pictures(self, scene: ToolScene, rng: np.random.Generator) -> Pair:
        """Return what both cameras deliver."""
        first, second = (
            noise(renderer.render(scene), tile, rng)
            for renderer, tile in zip(self._renderers, self._tiles, strict=True)
        )
        return first, second


def spiral(amplitude: float, count: int, phase: float) -> Iterator[FloatArray]:
    """Yield directions from the handle to the tip, evenly over a cone of half angle [rad].

    The first few cover it as the whole does.
    """
    for k in range(count):
        lean = amplitude * float(np.sqrt((0.5 + k * 0.6180339887) % 1.0))
        turn = phase + 2.399963 * k
        yield np.array([np.sin(lean) * np.cos(turn), np.sin(lean) * np.sin(turn), -np.cos(lean)])


@dataclass(frozen=True, slots=True, eq=False)
class ShaftMotion:
    """Poses of a tool that was turned about the trocar, and the last pictures of it."""

    poses: tuple[ToolPose, ...]
    pictures: Pair


def motion(stand: Stand, amplitude: float, count: int, seed: int) -> ShaftMotion:
    """Turn a tool about the trocar within a cone of half angle [rad] and look at it."""
    rng = np.random.default_rng(seed)
    poses = []
    for axis in spiral(amplitude, count, rng.uniform(0.0, 2.0 * np.pi)):
        scene = ToolScene.through(stand.trocar.p_world, axis, rng.uniform(0.05, 0.12))
        pictures = stand.pictures(scene, rng)
        found = stand.eyes.tool(pictures)
        if isinstance(found, ToolPose) and found.status is ToolStatus.FOUND:
            poses.append(found)
    return ShaftMotion(tuple(poses), pictures)


def by_lines(poses: tuple[ToolPose, ...]) -> Fulcrum:
    """Return the fulcrum by least squares of lines."""
    return meet_lines([ShaftLine(p.p_world, p.axis_world, p.covariance) for p in poses])


def by_planes(poses: tuple[ToolPose, ...]) -> Fulcrum:
    """Return the fulcrum by what each picture shows, weighted."""
    return meet_planes([sight for pose in poses for sight in pose.sights])


def _required(result: Fulcrum) -> FloatArray:
    if result.status is not FulcrumStatus.FOUND:
        raise TrackingError(
            sentence(
                "no fulcrum: {result_status}; turn the tool further",
                result_status=result.status.value,
            )
        )
    return result.p_world


def _case(setting: Setting) -> Case:
    values = setting.values
    stand = Stand(values["noise"])
    moved = [
        motion(stand, values["amplitude_deg"] * DEGREE, int(values["poses"]), seed)
        for seed in range(_SEEDS)
    ]

    def error(result: Any) -> float:
        away = np.linalg.norm(np.array(result) - stand.trocar.p_world, axis=1)
        return float(np.sqrt(np.mean(away**2))) / MILLIMETRE

    return Case((stand, moved), error, _SEEN)


def _from_motion(way: Callable[[tuple[ToolPose, ...]], Fulcrum]) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        _, moved = case.data
        return Prepared(lambda: [_required(way(one.poses)) for one in moved], len(moved))

    return prepare


def _from_trocar(case: Case) -> Prepared:
    stand, moved = case.data

    def centre(pictures: Pair) -> FloatArray:
        found = stand.eyes.trocar(pictures)
        if found.status is not TrocarStatus.FOUND:
            raise TrackingError(sentence("no trocar: {status}", status=found.status.value))
        return np.asarray(found.p_world)

    return Prepared(lambda: [centre(one.pictures) for one in moved], len(moved))


AMPLITUDES_DEG: Final = (0.2, 1.0, 2.0, 5.0, 10.0, 20.0, 40.0)
COUNTS: Final = (3, 6, 12)
NOISES: Final = (2.0, 4.0, 8.0, 16.0)


def _errors(result: list[Fulcrum], true: FloatArray) -> tuple[str | float, str | float, str]:
    """RMS error and mean stated deviation [mm], and how many gave no answer."""
    given = [one for one in result if one.status is FulcrumStatus.FOUND]
    refused = [one.status.value for one in result if one.status is not FulcrumStatus.FOUND]
    told = f"{len(refused)} {refused[0]}" if refused else "-"
    if not given:
        return "-", "-", told
    away = [np.linalg.norm(one.p_world - true) / MILLIMETRE for one in given]
    stated = [np.sqrt(np.trace(one.covariance)) / MILLIMETRE for one in given]
    return (
        round(float(np.sqrt(np.mean(np.square(away)))), 3),
        round(float(np.mean(stated)), 3),
        told,
    )


@cache
def _against_motion() -> Sheet:
    stand, rows = Stand(), []
    for amplitude in AMPLITUDES_DEG:
        moved = [motion(stand, amplitude * DEGREE, COUNTS[-1], seed) for seed in range(_SEEDS)]
        for count in COUNTS:
            lines = [by_lines(one.poses[:count]) for one in moved]
            planes = [by_planes(one.poses[:count]) for one in moved]
            given = _errors(planes, stand.trocar.p_world)
            rows.append((amplitude, count, _errors(lines, stand.trocar.p_world)[0], *given))
    return Sheet(
        "motion",
        f"Amplitude and number of poses, noise {_NOISE:g} grey levels",
        ("cone's half angle [°]", "poses", "lines [mm]", "planes [mm]", "said [mm]", "refused"),
        tuple(rows),
    )


def _against_noise() -> Sheet:
    rows: list[tuple[Any, ...]] = []
    for level in NOISES:
        stand = Stand(level)
        moved = [motion(stand, 20.0 * DEGREE, 12, seed) for seed in range(_SEEDS)]
        true = stand.trocar.p_world
        lines, planes = ([way(m.poses) for m in moved] for way in (by_lines, by_planes))
        rings = [stand.eyes.trocar(one.pictures) for one in moved]
        given = [ring for ring in rings if ring.status is TrocarStatus.FOUND]
        away = [np.linalg.norm(ring.p_world - true) / MILLIMETRE for ring in given]
        ring_error = round(float(np.sqrt(np.mean(np.square(away)))), 3) if away else "-"
        rows.append((level, _errors(lines, true)[0], _errors(planes, true)[0], ring_error))
    return Sheet(
        "noise",
        "Noise of the pictures, 12 poses within 20°",
        ("noise [grey levels]", "lines [mm]", "planes [mm]", "trocar [mm]"),
        tuple(rows),
    )


@dataclass(frozen=True, slots=True, eq=False)
class PoseErrors:
    """Errors of tools in pictures: position [m], angle [rad], squared distances in deviations."""

    position: FloatArray
    angle: FloatArray
    distance: FloatArray
    refused: tuple[str, ...]
    wrong_tips: int


def poses(count: int, inserted: bool, seed: int = 1) -> PoseErrors:
    """Look at tools anywhere on the table, or in the trocar."""
    stand, rng = Stand(), np.random.default_rng(seed)
    position, angle, distance, refused, wrong = [], [], [], [], 0
    for _ in range(count):
        scene = _anywhere(stand, rng, inserted)
        found = stand.eyes.tool(stand.pictures(scene, rng))
        if not isinstance(found, ToolPose) or found.status is not ToolStatus.FOUND:
            refused.append(found.status if isinstance(found, ToolPose) else found.reason)
            continue
        seen = OUTLINE.length - OUTLINE.centre(scene.hidden)
        sign = 1.0 if float(found.axis_world @ scene.axis_world) >= 0.0 else -1.0
        off = np.concatenate(
            [
                found.p_world - (scene.p_tip - seen * scene.axis_world),
                found.axis_world - sign * scene.axis_world,
            ]
        )
        position.append(float(np.linalg.norm(off[:3])))
        angle.append(angle_between(found.axis_world, sign * scene.axis_world))
        distance.append(float(off @ np.linalg.pinv(found.covariance, rcond=1e-9) @ off))
        tip = found.tip_axis_world
        wrong += tip is not None and float(tip @ scene.axis_world) < 0.0
    return PoseErrors(
        np.array(position), np.array(angle), np.array(distance), tuple(refused), wrong
    )


def _anywhere(stand: Stand, rng: np.random.Generator, inserted: bool) -> ToolScene:
    if inserted:
        axis = unit(np.array([*rng.normal(0.0, 0.3, 2), -1.0]))
        return ToolScene.through(stand.trocar.p_world, axis, rng.uniform(0.03, 0.12))
    turn = rng.uniform(0.0, 2.0 * np.pi)
    axis = np.array([np.cos(turn), np.sin(turn), 0.0])
    middle = np.array([rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1), 0.009])
    return ToolScene(middle + 0.5 * OUTLINE.length * axis, axis)


_TRIALS: Final = 120


def _pose_rows() -> list[tuple[Any, ...]]:
    rows = []
    for words, inserted in (("on the table", False), ("in the trocar", True)):
        found = poses(_TRIALS, inserted)
        within = np.mean(found.distance < chi_square_quantile(0.95, 5))
        mm, deg = found.position / MILLIMETRE, found.angle / DEGREE
        rows.append(
            (
                words,
                *(round(float(q), 3) for q in np.percentile(mm, (50, 95, 100))),
                *(round(float(q), 3) for q in np.percentile(deg, (50, 95, 100))),
                round(float(within), 2),
                found.wrong_tips,
                f"{len(found.refused)} {found.refused[0]}" if found.refused else "-",
            )
        )
    return rows


def _findings() -> Findings:
    moved, noisy, rows = _against_motion(), _against_noise(), _pose_rows()
    tool = Sheet(
        "pose",
        f"Tool from two pictures, {_TRIALS} of each, noise {_NOISE:g} grey levels",
        (
            "tool",
            "position [mm], 50 %",
            "position, 95 %",
            "position, largest",
            "angle [°], 50 %",
            "angle, 95 %",
            "angle, largest",
            "share within the 95 % region",
            "wrong tips",
            "refused",
        ),
        tuple(rows),
    )
    position, angle = max(row[1] for row in rows), max(row[4] for row in rows)
    steady = next(row[3] for row in moved.rows if row[:2] == (20.0, 12))
    ring = next(row[3] for row in noisy.rows if row[0] == _NOISE)
    reached = all(isinstance(value, float) and value <= _SEEN for value in (steady, ring))
    return Findings(
        (moved, noisy, tool),
        (
            Figure("motion", _draw_motion, (8.0, 4.5)),
            Figure("pictures", _draw_pictures, (11.0, 8.4)),
        ),
        (
            f"Tool: {position:.2f} mm and {angle:.3f}° in the median (goal {_GOAL_MM:g} mm, "
            f"{_GOAL_DEG:g}°).",
            f"Fulcrum: {steady} mm RMS from 12 poses within 20°, {ring} mm from the trocar itself "
            f"(goal {_SEEN:g} mm).",
        ),
        bool(position <= _GOAL_MM and angle <= _GOAL_DEG and reached),
    )


def _draw_motion(figure: Any) -> None:
    axes = figure.add_subplot(1, 1, 1)
    rows = _against_motion().rows
    for count, style in zip(COUNTS, ("^:", "s--", "o-"), strict=True):
        for column, words, colour in ((2, "lines", "#0072B2"), (3, "planes", "#D55E00")):
            given = [(r[0], r[column]) for r in rows if r[1] == count and r[column] != "-"]
            axes.plot(*zip(*given, strict=True), style, color=colour, markersize=4)
            axes.lines[-1].set_label(f"{words}, {count} poses")
    axes.axhline(_SEEN, color="#222222", linewidth=0.8, label=f"{_SEEN:g} mm")
    axes.set(xscale="log", yscale="log", xlabel="half angle of the shaft's motion [°]")
    axes.set_ylabel("RMS error of the fulcrum [mm]")
    axes.grid(True, color="#DDDDDD", linewidth=0.5)
    axes.legend(fontsize=7)
    figure.tight_layout()


def _draw_pictures(figure: Any) -> None:
    """Both cameras' pictures of a tool on the table and in the trocar, with what is found."""
    stand, rng = Stand(), np.random.default_rng(2)
    for row, inserted in enumerate((False, True)):
        pictures = stand.pictures(_anywhere(stand, rng, inserted), rng)
        for column, picture in enumerate(pictures):
            axes = figure.add_subplot(2, 2, 2 * row + column + 1)
            axes.imshow(picture[..., ::-1])
            blob, ring = find_tool(picture), ring_outline(picture)
            if isinstance(blob, ToolBlob):
                hull = np.vstack([blob.hull, blob.hull[:1]])
                axes.plot(*hull.T, color="#FFFFFF", linewidth=0.8)
                axes.plot(*blob.moments.centre, "o", color="#CC0000", markersize=4)
                if blob.moments.axis is not None:
                    reach = 0.5 * blob.moments.length * blob.moments.axis
                    ends = np.stack([blob.moments.centre - reach, blob.moments.centre + reach])
                    axes.plot(*ends.T, color="#CC0000", linewidth=0.8)
            if not isinstance(ring, TrocarStatus):
                axes.plot(*ring.T, ".", color="#F0E442", markersize=1.5)
            axes.set_axis_off()
    figure.tight_layout()


STUDY: Final = Study(
    error_label="RMS distance from the true fulcrum [mm]",
    ways=(
        Way(
            "lines",
            "motion",
            _from_motion(by_lines),
            "algebraic least squares of the shaft's lines",
            meet_lines,
        ),
        Way(
            "planes",
            "motion",
            _from_motion(by_planes),
            "distances from the axes in the pictures, weighted",
            meet_planes,
        ),
        Way(
            "trocar",
            "trocar",
            _from_trocar,
            "circle fitted to the ring in two pictures",
            solve_trocar,
        ),
    ),
    settings=(
        Setting("12 poses within 20°", {"amplitude_deg": 20.0, "poses": 12, "noise": 4.0}),
        Setting("12 poses within 5°", {"amplitude_deg": 5.0, "poses": 12, "noise": 4.0}),
        Setting("4 poses within 10°", {"amplitude_deg": 10.0, "poses": 4, "noise": 4.0}),
        Setting("12 poses, noise 12", {"amplitude_deg": 20.0, "poses": 12, "noise": 12.0}),
    ),
    case=_case,
    deadline=Limit(0.1, "0.1 s: three pictures"),
    perception=Limit(_SEEN, "0.5 mm"),
    default="planes",
    exception=(
        "Once per motion a millisecond is nothing. It needs no pose, so that pictures of one "
        "camera count, and its errors are weighed where they arise."
    ),
    in_use=lambda: called(ToolEyes.fulcrum, "meet_planes"),
    findings=_findings,
)
"""Three ways to the fulcrum."""
