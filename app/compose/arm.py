"""The arm's scene and the eyes joined: a tool found by pictures alone, fetched and brought.

`simulation.arm` says where things are and moves them, `tracking.tool` looks; neither knows the
other. What the pictures show is drawn by `tracking.simulated.tool` from the scene's poses, before
the arm has come near: the arm itself is not in them. Simulation only: nothing drives a real arm.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, angle_between
from app.core.files import write_atomically
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.planning.placement import PlacedPlan
from app.simulation.arm import (
    ArmPerformance,
    ArmScene,
    CarryError,
    CarryFailure,
    CarryPhase,
    RunningScene,
    SeenTool,
    ToolBody,
    carry,
)
from app.simulation.errors import SimulationError
from app.tracking.cameras.camera import Image
from app.tracking.cameras.survey import write_pictures
from app.tracking.optics.camera_model import CameraModel
from app.tracking.simulated.background import HousingBox
from app.tracking.simulated.picture_effects import NoiseTile, noise
from app.tracking.simulated.tool import ToolProfile, ToolRenderer, ToolScene, TrocarPlace, eyes
from app.tracking.tool.blob import ToolMiss
from app.tracking.tool.eyes import Pair, ToolEyes
from app.tracking.tool.pose import ToolStatus
from app.tracking.tool.trocar import TrocarStatus

SIMULATION_ONLY: Final = "Simulation only: nothing here drives a real arm."

NOISE: Final = 4.0
"""Standard deviation of a grey value of the pictures."""

SURE: Final = 2.0 * MILLIMETRE
"""Largest standard deviation of the tool's place in any direction [m], to reach for it."""

_DISTANCE: Final = 0.9  # of the cameras from the middle of the table [m]: the tray is in both
_STANDS: Final = ((-0.62, -0.55, 0.56), (0.25, -0.15, 0.95))
"""One to the left, one above: two that stand in line with a tool see it in one plane."""


def cameras() -> tuple[CameraModel, CameraModel]:
    """Return the two cameras of the scene."""
    return eyes(distance=_DISTANCE, stands=_STANDS)


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


@dataclass(frozen=True, slots=True)
class ArmDemonstration:
    """What a demonstration came to.

    Attributes:
        seed: of the scene and of the pictures' noise.
        looked: errors of what the pictures say.
        phases: those that were done.
        failure: the cause why not all were; None if the tool is over the trocar.
        message: the same in words.
        real_time: simulated seconds per second of computing.
    """

    seed: int
    looked: Mapping[str, float]
    phases: tuple[CarryPhase, ...]
    failure: CarryFailure | None
    message: str
    real_time: float

    def as_json(self) -> str:
        """Return the report."""
        return json.dumps(
            {
                "note": SIMULATION_ONLY,
                "seed": self.seed,
                "phases": [
                    {"name": "look", "time_s": 0.0, "errors": dict(self.looked)},
                    *(
                        {"name": phase.name, "time_s": phase.time, "errors": phase.errors}
                        for phase in self.phases
                    ),
                ],
                "failure": self.failure,
                "message": self.message,
                "simulated_seconds_per_second": self.real_time,
            },
            indent=2,
        )


def tool_body(profile: ToolProfile) -> ToolBody:
    """Return the tool of the pictures as the scene has it."""
    return ToolBody(
        length=profile.length_mm * MILLIMETRE,
        shaft_diameter=profile.shaft_diameter_mm * MILLIMETRE,
        point_length=profile.point_length_mm * MILLIMETRE,
        handle_length=profile.handle_length_mm * MILLIMETRE,
        handle_diameter=profile.handle_diameter_mm * MILLIMETRE,
    )


def pictures(
    scene: ArmScene,
    T_world_tool: RigidTransform,
    models: tuple[CameraModel, CameraModel],
    profile: ToolProfile,
    seed: int,
) -> Pair:
    """Return what both cameras see of the table, with noise.

    Args:
        scene: table, trocar.
        T_world_tool: where the tool is.
        models: the cameras.
        profile: measures and colour of the tool.
        seed: of the noise.
    """
    ring = scene.trocar
    trocar = TrocarPlace(ring.p_world, ring.normal_world, ring.inner, ring.outer)
    table = tuple(HousingBox(box.low, box.high, box.colour) for box in scene.boxes)
    tip = T_world_tool @ [0.0, 0.0, scene.tool.length]
    seen = ToolScene(tip, T_world_tool.rotate([0.0, 0.0, 1.0]))
    rng = np.random.default_rng(seed)
    first, second = (
        noise(
            ToolRenderer(model, profile, trocar, table=table).render(seen),
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
    watching: ToolEyes,
) -> ArmSight:
    """Find tool and trocar in two pictures; the truth only measures.

    Args:
        scene: what stands there.
        T_world_tool: where the tool really is.
        pair: the pictures.
        watching: the eyes, which know the tool's outline.

    Raises:
        CarryError: if there is no tool, no trocar, or no telling the tip; says why.
    """
    found, ring = watching.tool(pair), watching.trocar(pair)
    if isinstance(found, ToolMiss):
        raise CarryError(CarryFailure.NOT_SEEN, f"the eyes find no tool: {found.reason}")
    axis = found.tip_axis_world
    if found.status is not ToolStatus.FOUND or axis is None or not found.whole:
        why = (
            f"{found.status}"
            if found.status is not ToolStatus.FOUND
            else ("its tip cannot be told" if axis is None else "a picture's edge cuts it")
        )
        raise CarryError(CarryFailure.NOT_SEEN, f"the eyes do not know where the tool lies: {why}")
    known = float(np.sqrt(np.linalg.eigvalsh(found.covariance[:3, :3])[-1]))
    if known > SURE:
        raise CarryError(
            CarryFailure.NOT_SEEN,
            f"the eyes know the tool's place to {known / MILLIMETRE:.1f} mm only,"
            f" {SURE / MILLIMETRE:g} mm are needed; turn the tool, or move a camera out of its"
            " line",
        )
    if ring.status is not TrocarStatus.FOUND:
        raise CarryError(CarryFailure.NOT_SEEN, f"the eyes find no trocar: {ring.status}")
    middle = watching.outline.centre() if watching.outline is not None else scene.tool.grip
    tool = SeenTool(found.p_world + (scene.tool.grip - middle) * axis, axis)
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


def demonstrate(
    seed: int, folder: Path | None = None, tell: Callable[[str], None] = lambda _: None
) -> ArmDemonstration:
    """Find tool and trocar by pictures only, then approach, grasp, lift and bring.

    Args:
        seed: of the scene and of the noise.
        folder: for the pictures (both cameras', and one after each phase) and `report.json`.
        tell: is told each phase and how exact it was.

    Raises:
        SimulationError: if MuJoCo is not installed; names the extra.
        CameraError: if a picture cannot be written.
    """
    profile = ToolProfile()
    models = cameras()
    watching = ToolEyes(models=models, outline=profile.outline, noise_grey=NOISE)
    scene = ArmScene.seeded(seed, tool_body(profile))
    shown: dict[str, Image] = {}
    phases: list[CarryPhase] = []
    looked: Mapping[str, float] = {}
    failure, message = None, ""
    with RunningScene(scene) as running:
        lying = running.state.T_world_tool
        pair = pictures(scene, lying, models, profile, seed)
        shown |= {"0-look-left": pair[0], "0-look-right": pair[1]}
        drawn = folder is not None and _draws(running, tell)
        try:
            sight = look(scene, lying, pair, watching)
            looked = sight.errors
            tell(f"look: {_in_words(looked)}")
            for phase in carry(running, sight.tool, sight.fulcrum, sight.normal):
                phases.append(phase)
                tell(f"{phase.name}: {_in_words(phase.errors)}")
                if drawn:
                    shown[f"{len(phases)}-{phase.name}"] = running.picture()
        except CarryError as error:
            failure, message = error.failure, str(error)
            if drawn:
                shown[f"{len(phases) + 1}-{failure}"] = running.picture()
        speed = running.real_time
    tell(f"the simulation ran at {speed:.1f} times real time")
    found = ArmDemonstration(seed, looked, tuple(phases), failure, message, speed)
    if folder is not None:
        write_pictures(folder, shown)
        write_atomically(folder / "report.json", found.as_json().encode())
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
    raise SimulationError("the arm cannot carry out a plan yet")


def _draws(running: RunningScene, tell: Callable[[str], None]) -> bool:
    """Whether the scene can be drawn here; tells if not."""
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
