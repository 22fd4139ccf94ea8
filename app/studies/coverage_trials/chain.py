"""One chain: pictures of a board, two cameras, the world frame, a fix; and how far each is off.

The cameras are calibrated by the very call that `acus calibrate` makes: it finds its own start,
chooses the model of each lens and looks for views that do not belong, though all do here.

A camera's parameters are compared where they mean the same in the lens and in the model that was
chosen: all of them if both have five coefficients, else focal lengths and centre. Its rays mean the
same in every model: at four places where boards were seen, how far a corner is predicted from its
pixel, each place by itself.
"""

from datetime import UTC, datetime
from functools import cache
from typing import Final

import numpy as np

from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.studies.coverage_trials.deviation import Deviation
from app.studies.coverage_trials.scene import LENSES, RIGS, RigScene, TrueCamera, scene
from app.tracking.calibration.placed_board import PlacedBoard
from app.tracking.calibration.run import calibrate_stereo
from app.tracking.calibration.sightings import project_with_derivatives
from app.tracking.calibration.world import WorldFrame, find_world, with_world
from app.tracking.markers.extractor import Centre
from app.tracking.optics.calibration import CameraCalibration, StereoCalibration
from app.tracking.optics.lens import LINEAR, LensModel
from app.tracking.optics.rig import OFFSET_SD_MM
from app.tracking.solver import FixSolver, SeenMarker, systematic_px

VIEWS: Final = 8
"""Pairs that calibrate: few, so that many chains can be tried."""

SETS: Final = 10
"""Sets of places at which the board is shown."""

PLACE_SD: Final = (0.1, 0.05)
"""How exactly the board lies where it is said to, per axis [mm, °]."""

MARKER_PX: Final = 0.1

QUANTITIES: Final = (
    *("left camera", "right camera", "left rays", "right rays"),
    *("relative pose", "tip"),
)
POSE: Final = ("tx", "ty", "tz", "rx", "ry", "rz")
TIP: Final = ("x", "y", "z")
_PLACES: Final = ("upper left", "upper right", "lower left", "lower right")

_NOW: Final = datetime(2026, 1, 1, tzinfo=UTC)


def chain(rig: str, lens: str, seed: int) -> dict[str, tuple[Deviation, ...]]:
    """Calibrate once, see the tip once; deviations by `QUANTITIES`."""
    own = (RIGS.index(rig), LENSES.index(lens))
    before, rng = scene(rig, lens), np.random.default_rng([seed, *own])
    poses = board_poses(rig, lens, seed % SETS)
    views = [[before.view(side, T, rng) for T in poses] for side in (0, 1)]
    names = (before.profile.cameras[0].name, before.profile.cameras[1].name)
    calibration = calibrate_stereo(views[0], views[1], names, hold_back=0, now=_NOW)
    calibration = with_world(calibration, _world(before, calibration, rng), before.board.spec)
    pairs = list(zip(before.cameras, calibration.cameras, strict=True))
    deviations: list[tuple[Deviation, ...]]
    deviations = [(_parameters(true, camera),) for true, camera in pairs]
    deviations += [_rays(true, camera, before, poses) for true, camera in pairs]
    left, right = (camera.T_camera_world for camera in before.cameras)
    twist = (right @ left.inverse() @ calibration.pose.transform.inverse()).log()
    deviations.append((Deviation.of(twist, calibration.pose.pose_covariance, POSE),))
    deviations.append((_tip(before, calibration, rng),))
    return dict(zip(QUANTITIES, deviations, strict=True))


@cache
def board_poses(rig: str, lens: str, number: int) -> tuple[RigidTransform, ...]:
    """Return T_world_board at a set of places of the board, of `SETS`."""
    return scene(rig, lens).poses(VIEWS, 100 + number)


def _parameters(true: TrueCamera, camera: CameraCalibration) -> Deviation:
    """Weigh those of a camera's parameters that mean the same in its lens and in its model."""
    alike = camera.lens is LensModel.BROWN and not true.distortion[5:].any()
    names = camera.estimated if alike else LINEAR
    truth = [*true.matrix[[0, 1, 0, 1], [0, 1, 2, 2]], *true.distortion[:5]]
    places = [camera.lens.parameters.index(name) for name in names]
    error = np.concatenate([camera.intrinsics, camera.distortion])[places]
    error = error - np.array(truth)[places]
    return Deviation.of(error, camera.parameter_covariance[np.ix_(places, places)], names)


def _rays(
    true: TrueCamera, camera: CameraCalibration, before: RigScene, poses: tuple[RigidTransform, ...]
) -> tuple[Deviation, ...]:
    """Weigh how far off a camera predicts corners of the boards that it saw, at each place."""
    points = np.concatenate([T @ before.board.points for T in poses])
    pixels = true.pixels(points)
    sides = np.array([[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]])
    wanted = pixels.mean(axis=0) + 1.2 * pixels.std(axis=0) * sides
    nearest = np.linalg.norm(pixels - wanted[:, None], axis=2).argmin(axis=1)
    parameters = np.concatenate([camera.intrinsics, camera.distortion])
    predicted, _, by = project_with_derivatives(true.T_camera_world @ points[nearest], parameters)
    spreads = by @ camera.parameter_covariance @ np.swapaxes(by, 1, 2)
    errors = predicted - pixels[nearest]
    each = zip(errors, spreads, _PLACES, strict=True)
    return tuple(Deviation.of(e, V, (f"u {at}", f"v {at}")) for e, V, at in each)


def _world(
    before: RigScene, calibration: StereoCalibration, rng: np.random.Generator
) -> WorldFrame:
    """Find the world frame by a board that lies a little beside where it is said to."""
    mm, deg = PLACE_SD
    there = RigidTransform.from_translation(before.placed.translation)
    turn = RigidTransform(rotation_exp(deg * DEGREE * rng.normal(size=3)), np.zeros(3))
    shift = RigidTransform.from_translation(mm * MILLIMETRE * rng.normal(size=3))
    really = shift @ there @ turn @ there.inverse() @ before.placed
    pair = (before.view(0, really, rng), before.view(1, really, rng))
    return find_world(
        calibration,
        [PlacedBoard(before.placed, (pair,))],
        place_sd_mm=mm,
        place_sd_deg=deg,
        expected=before.cameras[0].T_camera_world.inverse(),
    )


def _tip(before: RigScene, calibration: StereoCalibration, rng: np.random.Generator) -> Deviation:
    """See a band whose place on the shaft is not quite what the profile says; weigh the tip."""
    rig = before.profile.calibrated(calibration)
    band, axis = before.needle(rng)
    offset = rig.needle.marker_offset + OFFSET_SD_MM * MILLIMETRE * rng.normal()
    sd = float(np.hypot(MARKER_PX, systematic_px(before.profile)))
    seen = [
        SeenMarker(
            camera.pixels(band[None])[0] + sd * rng.normal(size=2),
            MARKER_PX**2 * np.eye(2),
            Centre.BAND,
        )
        for camera in before.cameras
    ]
    fix = FixSolver(rig, before.fulcrum).solve((seen[0], seen[1]), axis, 0.0)
    return Deviation.of(fix.p_tip_world - (band + offset * axis), fix.covariance, TIP, point=True)
