"""The arm's scene and the eyes joined: a tool found by pictures alone, fetched and inserted.

`scene` says where things are and moves them, `eyes` look; neither knows the other. What the
pictures show is drawn by `eyes.pictures` from the scene's poses, before the arm has come near: the
arm itself is not in them. Simulation only: nothing drives a real arm.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from app.arm.eyes.blob import ToolMiss
from app.arm.eyes.pictures import ToolRenderer, ToolScene, eyes, tool_outline
from app.arm.eyes.pose import ToolStatus
from app.arm.eyes.trocar import TrocarStatus
from app.arm.eyes.watching import Pair, ToolEyes
from app.arm.laparoscopy import FLATTEST
from app.arm.motion.pick_place import PhaseName
from app.arm.scene import (
    ArmPerformance,
    ArmScene,
    ArmSceneState,
    ArmTimeline,
    ArmTrial,
    CarryError,
    CarryFailure,
    CarryPhase,
    Insertion,
    RunningScene,
    SeenTool,
    ToolBody,
    carry,
    could_carry,
    plan,
)
from app.core.arrays import FloatArray, angle_between, frozen
from app.core.files import write_atomically
from app.core.messages import sentence, sentence_of
from app.core.progress import Progress
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.planning.placement import PlacedPlan
from app.simulation.errors import SimulationError
from app.tracking.cameras.camera import Image
from app.tracking.cameras.survey import write_pictures
from app.tracking.optics.camera_model import CameraModel
from app.tracking.simulated.background import HousingBox
from app.tracking.simulated.picture_effects import NoiseTile, noise

SIMULATION_ONLY: Final = "Simulation only: nothing here drives a real arm."

NOISE: Final = 4.0
"""Standard deviation of a grey value of the pictures."""

SURE: Final = 2.0 * MILLIMETRE
"""Largest standard deviation of the tool's place in any direction [m], to reach for it."""

_LOOKS_AT: Final = (-0.030, 0.0, 0.030)  # of the cameras [m]: a long tool is whole in both
_DISTANCE: Final = 0.9  # from there [m]
_STANDS: Final = ((-0.62, -0.55, 0.56), (0.25, -0.15, 0.95))
"""One to the left, one above: two that stand in line with a tool see it in one plane."""


DEEPEST: Final = 0.120
"""Depth to which the tool of the scene reaches [m]: a longer one is not whole in both pictures."""

PHASES: Final = tuple(name.value for name in PhaseName)

_DOING: Final = {
    PhaseName.APPROACH: "the arm comes to the tool",
    PhaseName.GRASP: "the hand closes on the tool",
    PhaseName.LIFT: "the arm lifts the tool",
    PhaseName.TRANSFER: "the arm brings the tool to the entry",
    PhaseName.ALIGN: "the tool is set upright over the entry",
    PhaseName.PIVOT: "the tool is turned into the path's direction",
    PhaseName.INSERT: "the tool is inserted",
}
_ELSEWHERE: Final = (
    CarryFailure.NOT_SEEN,
    CarryFailure.UNREACHABLE,
    CarryFailure.COLLIDES,
    CarryFailure.NO_WAY,
)
_BETWEEN: Final = (0.05, 0.1, 0.15)  # what pictures for people look at [m]
_TURNS_DEG: Final = (45.0, -45.0, 90.0, -90.0, 135.0, -135.0, 180.0)
_REST: Final = 0.5  # after the insertion [s]


def cameras() -> tuple[CameraModel, CameraModel]:
    """Return the two cameras of the scene."""
    return eyes(distance=_DISTANCE, stands=_STANDS, looks_at=_LOOKS_AT)


@dataclass(frozen=True, slots=True, eq=False)
class ArmSight:
    """What the eyes say of the scene.

    Attributes:
        tool: where the tool lies.
        fulcrum: centre of the trocar [m], shape (3,).
        normal: out of the body, shape (3,).
        errors: against the truth, name with unit -> value.
    """

    tool: SeenTool
    fulcrum: FloatArray
    normal: FloatArray
    errors: dict[str, float]


def pictures(
    scene: ArmScene,
    T_world_tool: RigidTransform,
    models: tuple[CameraModel, CameraModel],
    seed: int,
) -> Pair:
    """Return what both cameras see of the table, with noise.

    Args:
        scene: table, trocar, measures of the tool.
        T_world_tool: where the tool is.
        models: the cameras.
        seed: of the noise.
    """
    table = tuple(HousingBox(box.low, box.high, box.colour) for box in scene.boxes)
    tip = T_world_tool @ [0.0, 0.0, scene.tool.length]
    seen = ToolScene(tip, T_world_tool.rotate([0.0, 0.0, 1.0]))
    rng = np.random.default_rng(seed)
    first, second = (
        noise(
            ToolRenderer(model, scene.tool, scene.trocar, table=table).render(seen),
            NoiseTile.make(model.image_size, NOISE, 2 * seed + k),
            rng,
        )
        for k, model in enumerate(models)
    )
    return first, second


def look(
    scene: ArmScene,
    T_world_tool: RigidTransform,
    pair: Pair,
    models: tuple[CameraModel, CameraModel] | None = None,
) -> ArmSight:
    """Find tool and trocar in two pictures; the truth only measures.

    Args:
        scene: what stands there.
        T_world_tool: where the tool really is.
        pair: the pictures.
        models: the cameras; None: those of the scene.

    Raises:
        CarryError: if there is no tool, no trocar, or no telling the tip; says why.
    """
    outline = tool_outline(scene.tool)
    watching = ToolEyes(models=models or cameras(), outline=outline, noise_grey=NOISE)
    found, ring = watching.tool(pair), watching.trocar(pair)
    if isinstance(found, ToolMiss):
        raise CarryError(
            CarryFailure.NOT_SEEN, sentence("the eyes find no tool: {reason}", reason=found.reason)
        )
    axis = found.tip_axis_world
    if found.status is not ToolStatus.FOUND or axis is None or not found.whole:
        why = (
            f"{found.status}"
            if found.status is not ToolStatus.FOUND
            else ("its tip cannot be told" if axis is None else "a picture's edge cuts it")
        )
        raise CarryError(
            CarryFailure.NOT_SEEN,
            sentence("the eyes do not know where the tool lies: {reason}", reason=why),
        )
    known = float(np.sqrt(np.linalg.eigvalsh(found.covariance[:3, :3])[-1]))
    if known > SURE:
        raise CarryError(
            CarryFailure.NOT_SEEN,
            sentence(
                "the eyes know the tool's place to {known_mm:.1f} mm only,"
                " {sure_mm:g} mm are needed; turn the tool, or move a camera out of its"
                " line",
                known_mm=known / MILLIMETRE,
                sure_mm=SURE / MILLIMETRE,
            ),
        )
    if ring.status is not TrocarStatus.FOUND:
        raise CarryError(
            CarryFailure.NOT_SEEN,
            sentence(
                "the eyes find no trocar: {ring_status}; let arm and cameras stand elsewhere "
                "round it",
                ring_status=ring.status,
            ),
        )
    tool = SeenTool(found.p_world + (scene.tool.grip - outline.centre()) * axis, axis)
    true_axis = T_world_tool.rotate([0.0, 0.0, 1.0])
    off = tool.p_grip - T_world_tool @ [0.0, 0.0, scene.tool.grip]
    along = float(off @ true_axis)
    errors = {
        "tool_across_mm": float(np.linalg.norm(off - along * true_axis)) / MILLIMETRE,
        "tool_along_mm": abs(along) / MILLIMETRE,
        "tool_axis_deg": float(np.degrees(angle_between(axis, true_axis))),
        "fulcrum_mm": float(np.linalg.norm(ring.p_world - scene.trocar.p_world)) / MILLIMETRE,
        "trocar_normal_deg": float(
            np.degrees(angle_between(ring.normal_world, scene.trocar.normal_world))
        ),
    }
    return ArmSight(tool, ring.p_world, ring.normal_world, errors)


class ArmRun:
    """The arm inserting a tool in its scene by pictures alone: what is known and done of it so far.

    Args:
        scene: what stands there.
        axis: wanted direction of the shaft, handle to tip, shape (3,).
        depth: wanted of the tip beyond the trocar's centre [m].
        seed: of the pictures' noise.
        progress: told how far it is; may cancel.
    """

    def __init__(
        self,
        scene: ArmScene,
        axis: FloatArray,
        depth: float,
        seed: int,
        progress: Progress | None = None,
    ) -> None:
        self.scene, self.axis, self.depth, self.seed = scene, axis, depth, seed
        self.looked: Mapping[str, float] = {}
        self.pair: Pair | None = None
        self.phases: list[CarryPhase] = []
        self.planning = self.physics = self.simulated = 0.0
        self._progress = progress or Progress()
        self._running = RunningScene(scene, self._watch)
        self._states: list[tuple[ArmSceneState, bool, int]] = []
        self._lasts = 1.0

    def run(self, shown: Callable[[RunningScene, str], None] = lambda *_: None) -> None:
        """Look, plan and carry out.

        Args:
            shown: called with the scene and a name once the eyes have looked (`look`) and after
                each phase.

        Raises:
            CarryError: if it cannot be done; names the cause.
            SimulationError, PlannerMissingError: if a package is missing; names the extra.
            Cancelled: when the progress says so.
        """
        report, check = self._progress.report, self._progress.check
        report(0.0, "the scene of the arm is made")
        with self._running as running:
            try:
                report(0.05, "the eyes look for tool and entry")
                lies = running.state.T_world_tool
                self.pair = pictures(self.scene, lies, cameras(), self.seed)
                sight = look(self.scene, lies, self.pair)
                self.looked = sight.errors
                shown(running, "look")
                report(0.1, "the arm's way is planned")
                wanted = Insertion(sight.tool, sight.fulcrum, sight.normal, self.axis, self.depth)
                begin = time.thread_time()
                try:
                    planned = plan(self.scene, wanted, check=check)
                finally:
                    self.planning = time.thread_time() - begin
                self._lasts = planned.duration + len(PHASES)
                for phase in carry(running, wanted, planned):
                    self.phases.append(phase)
                    shown(running, phase.name)
                running.stay(_REST)
            finally:
                self.simulated, self.physics = running.state.time, running.busy

    def trial(self, error: CarryError | None = None) -> ArmTrial:
        """Return what it came to; `error` as `run` raised it."""
        return ArmTrial(
            self.seed,
            self.axis,
            self.depth,
            self.looked,
            tuple(self.phases),
            None if error is None else error.failure,
            "" if error is None else str(error),
            self.simulated,
            self.planning,
            self.physics,
        )

    def performance(self, T_scene_world: RigidTransform) -> ArmPerformance:
        """Return it to be looked at; `T_scene_world` is the bench's world in the scene's."""
        states, held, phase = zip(*self._states, strict=True)
        timeline = ArmTimeline(
            np.array([one.time for one in states]),
            np.array([one.q for one in states]),
            np.array([one.fingers for one in states]),
            np.array([one.T_world_tool.translation for one in states]),
            np.array([one.T_world_tool.rotation for one in states]),
            np.array(held),
            np.array(phase),
            PHASES,
        )
        return ArmPerformance(
            self.scene, timeline, T_scene_world, self.looked, tuple(self.phases), self.seed
        )

    def _watch(self, state: ArmSceneState) -> None:
        now = min(len(self.phases), len(PHASES) - 1)
        self._states.append((state, self._running.holding, now))
        share = 0.3 + 0.7 * min(state.time / self._lasts, 1.0) if state.time > 0.0 else 0.0
        self._progress.report(share, _DOING[PhaseName(PHASES[now])])


def aimed(seed: int) -> tuple[FloatArray, float]:
    """Return a direction within 25° of straight down, shape (3,), and a depth [m], for a seed."""
    rng = np.random.default_rng((seed, 1))
    tilt, azimuth = rng.uniform(0.0, 25.0) * DEGREE, rng.uniform(0.0, 2.0 * np.pi)
    across = np.sin(tilt) * np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    axis = across - [0.0, 0.0, np.cos(tilt)]
    return frozen(axis), float(rng.uniform(0.040, DEEPEST))


def trial(seed: int, progress: Progress | None = None) -> ArmTrial:
    """Let the arm insert a tool in a scene that a seed lays, along a direction that it chooses.

    Raises:
        SimulationError, PlannerMissingError: if a package is missing; names the extra.
        Cancelled: when the progress says so.
    """
    arm_run = _run_of(seed, progress)
    try:
        arm_run.run()
    except CarryError as error:
        return arm_run.trial(error)
    return arm_run.trial()


def _run_of(seed: int, progress: Progress | None = None) -> ArmRun:
    axis, depth = aimed(seed)
    scene = ArmScene.seeded(seed, ToolBody().reaching(depth), axis)
    return ArmRun(scene, axis, depth, seed, progress)


def demonstrate(
    seed: int, folder: Path | None = None, tell: Callable[[str], None] = lambda _: None
) -> ArmTrial:
    """Do a trial and show it.

    Args:
        seed: of the scene, of what is wanted and of the noise.
        folder: for the pictures (both cameras', and one after each phase) and `report.json`.
        tell: is told each phase and how exact it was.

    Raises:
        SimulationError, PlannerMissingError: if a package is missing; names the extra.
        CameraError: if a picture cannot be written.
    """
    arm_run, shown, drawn = _run_of(seed), dict[str, Image](), folder is not None
    failed: CarryError | None = None

    def show(running: RunningScene, name: str) -> None:
        nonlocal drawn
        tell(
            f"{name}: {_in_words(arm_run.phases[-1].errors if arm_run.phases else arm_run.looked)}"
        )
        drawn = drawn and (name != "look" or _draws(running, tell))
        if drawn and name != "look":
            shown[f"{len(arm_run.phases)}-{name}"] = running.picture(looks_at=_BETWEEN)

    try:
        arm_run.run(show)
    except CarryError as error:
        failed = error
    found = arm_run.trial(failed)
    tell(f"the simulation ran at {found.real_time:.1f} times real time")
    if folder is not None:
        if arm_run.pair is not None:
            shown |= {"0-look-left": arm_run.pair[0], "0-look-right": arm_run.pair[1]}
        write_pictures(folder, shown)
        write_atomically(folder / "report.json", _report(found).encode())
    return found


def carry_out(
    placed: PlacedPlan,
    seed: int,
    stands_deg: float = 0.0,
    progress: Progress | None = None,
    depth: float | None = None,
) -> ArmPerformance:
    """Let the arm fetch the tool and insert it along a plan, by pictures alone.

    Args:
        placed: the plan on the bench; its entry becomes the trocar's centre in the scene.
        seed: of where the tool lies and of the pictures' noise.
        stands_deg: turn of the arm's place about the vertical through the entry [°].
        progress: told how far it is, in words; may cancel.
        depth: of the tip at the end [m]; None: as far as the target.

    Raises:
        CarryError: if the plan cannot be carried out; says why, and where the arm could stand.
        SimulationError, PlannerMissingError: if a package is missing; names the extra.
        Cancelled: when the progress says so.
    """
    deep = float(np.linalg.norm(placed.p_target - placed.p_entry)) if depth is None else depth
    if not 0.0 < deep <= DEEPEST:
        raise CarryError(
            CarryFailure.UNREACHABLE,
            sentence(
                "the arm would have to insert its tool by {deep_mm:.0f} mm; up to"
                " {deepest_mm:.0f} mm it can: choose an entry nearer to the target",
                deep_mm=deep / MILLIMETRE,
                deepest_mm=DEEPEST / MILLIMETRE,
            ),
        )
    if placed.tilt > FLATTEST:
        raise CarryError(
            CarryFailure.UNREACHABLE,
            sentence(
                "the path leans {placed_tilt_deg:.0f}° from straight down; the arm inserts up to"
                " {flattest_deg:.0f}°: turn the patient, or choose a steeper path",
                placed_tilt_deg=placed.tilt / DEGREE,
                flattest_deg=FLATTEST / DEGREE,
            ),
        )

    def standing(turned_deg: float) -> tuple[ArmScene, FloatArray, RigidTransform]:
        """Scene, direction in it, and the bench's world in it, for a place of the arm."""
        turn = rotation_exp(np.array([0.0, 0.0, -turned_deg * DEGREE]))
        axis = turn @ placed.axis
        scene = ArmScene.seeded(seed, ToolBody().reaching(deep), axis)
        move = scene.trocar.p_world - turn @ placed.p_entry
        return scene, axis, RigidTransform(turn, move)

    scene, axis, T_scene_world = standing(stands_deg)
    arm_run = ArmRun(scene, axis, deep, seed, progress)
    try:
        arm_run.run()
    except CarryError as error:
        if error.failure not in _ELSEWHERE:
            raise
        check = (progress or Progress()).check
        for turn in _TURNS_DEG:
            other, towards, _ = standing(stands_deg + turn)
            if could_carry(other, towards, deep, check) and _could_see(other, seed):
                could = (stands_deg + turn + 180.0) % 360.0 - 180.0
                raise CarryError(error.failure, sentence_of(error), could) from error
        raise
    return arm_run.performance(T_scene_world)


def _report(result: ArmTrial) -> str:
    """Return the report."""
    return json.dumps(
        {
            "note": SIMULATION_ONLY,
            "seed": result.seed,
            "wanted": {
                "tilt_deg": float(np.degrees(result.tilt)),
                "axis": result.axis.tolist(),
                "depth_mm": result.depth / MILLIMETRE,
            },
            "phases": [
                {"name": "look", "time_s": 0.0, "errors": dict(result.looked)},
                *(
                    {"name": phase.name, "time_s": phase.time, "errors": phase.errors}
                    for phase in result.phases
                ),
            ],
            "failure": result.failure,
            "message": result.message,
            "simulated_s": result.simulated,
            "planning_s": result.planning,
            "simulated_seconds_per_second": result.real_time,
        },
        indent=2,
    )


def _could_see(scene: ArmScene, seed: int) -> bool:
    """Return whether the eyes would find tool and trocar."""
    try:
        look(scene, scene.T_world_tool, pictures(scene, scene.T_world_tool, cameras(), seed))
    except CarryError:
        return False
    return True


def _draws(running: RunningScene, tell: Callable[[str], None]) -> bool:
    """Return whether the scene can be drawn here; tells if not."""
    try:
        running.picture()
    except SimulationError as error:
        tell(f"no pictures of the arm, only those of its eyes: {error}")
        return False
    return True


def _in_words(errors: Mapping[str, float]) -> str:
    """Errors with their units, in one line."""
    parts = []
    for name, value in errors.items():
        what, unit_name = name.rsplit("_", 1)
        parts.append(f"{what.replace('_', ' ')} {value:.2f} {unit_name}".replace(" deg", "°"))
    return ", ".join(parts)
