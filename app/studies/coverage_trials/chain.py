"""One chain: pictures of a board, two cameras, the world frame, a fix; and how far each is off.

Estimated by what `acus calibrate` estimates with, but for its search for views that do not belong:
all belong here. It starts from another calibration of the same rig, never from the truth.
"""

from datetime import UTC, datetime
from functools import cache
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.studies.coverage_trials.deviation import Deviation
from app.studies.coverage_trials.scene import LENSES, RIGS, SIZE, RigScene, TrueCamera, scene
from app.tracking.calibration.bundle import Adjusted, adjust
from app.tracking.calibration.mono import calibrate_mono
from app.tracking.calibration.placed_board import PlacedBoard
from app.tracking.calibration.selection import smallest_model
from app.tracking.calibration.sightings import AdjustedState, SeenBoard
from app.tracking.calibration.views import BoardView
from app.tracking.calibration.world import WorldFrame, find_world, with_world
from app.tracking.markers.extractor import Centre
from app.tracking.optics.calibration import (
    PARAMETERS,
    CameraCalibration,
    PoseCalibration,
    StereoCalibration,
)
from app.tracking.optics.rig import OFFSET_SD_MM
from app.tracking.solver import FixSolver, SeenMarker, systematic_px

VIEWS: Final = 8
"""Pairs that calibrate: few, so that many chains can be tried."""

PLACE_SD: Final = (0.1, 0.05)
"""How exactly the board lies where it is said to, per axis [mm, °]."""

MARKER_PX: Final = 0.1

QUANTITIES: Final = ("left camera", "right camera", "relative pose", "tip")
POSE: Final = ("tx", "ty", "tz", "rx", "ry", "rz")
TIP: Final = ("x", "y", "z")


def chain(rig: str, lens: str, seed: int) -> dict[str, Deviation]:
    """Calibrate once, see the tip once; deviations by `QUANTITIES`."""
    own = (RIGS.index(rig), LENSES.index(lens))
    before, rng = scene(rig, lens), np.random.default_rng([seed, *own])
    start, poses = _start(rig, lens, seed % SETS)
    views = [[before.view(side, T, rng) for T in poses] for side in (0, 1)]
    adjusted, names = _estimated(views, start)
    calibration = _calibration(before, adjusted, names)
    calibration = with_world(calibration, _world(before, calibration, rng), before.board.spec)
    p, covariance = adjusted.state.parameters, adjusted.covariance
    found = {
        name: _lens(camera, p[i], covariance[9 * i : 9 * i + 9, 9 * i : 9 * i + 9], names[i])
        for i, (name, camera) in enumerate(zip(QUANTITIES[:2], before.cameras, strict=True))
    }
    left, right = (camera.T_camera_world for camera in before.cameras)
    twist = (right @ left.inverse() @ adjusted.state.T_right_left.inverse()).log()
    found["relative pose"] = Deviation.of(twist, covariance[18:, 18:], POSE)
    found["tip"] = _tip(before, calibration, rng)
    return found


_ROUNDS: Final = (20, 60)
"""Steps of one camera alone, which only says which coefficients the views tell, and of both. Fewer
(3 and 6) leave some of rig `wide` short of the optimum."""

SETS: Final = 10
"""Sets of places at which the board is shown."""


@cache
def _start(rig: str, lens: str, number: int) -> tuple[AdjustedState, tuple[RigidTransform, ...]]:
    """Places of the board, and the calibration of other pictures of them."""
    before, rng = scene(rig, lens), np.random.default_rng([number, 2])
    poses = before.poses(VIEWS, 100 + number)
    monos = [calibrate_mono([before.view(s, T, rng) for T in poses], "camera", 0) for s in (0, 1)]
    states = [mono.adjusted.state for mono in monos]
    T_right_left = states[1].poses[0] @ states[0].poses[0].inverse()
    parameters = np.vstack([state.parameters[:, :9] for state in states])
    return AdjustedState(parameters, T_right_left, states[0].poses), poses


def _estimated(
    views: list[list[BoardView]], start: AdjustedState
) -> tuple[Adjusted, tuple[tuple[str, ...], tuple[str, ...]]]:
    """Estimate both cameras together, with the coefficients that each by itself can tell."""
    seen = [
        [SeenBoard(i, side, view.points, view.pixels) for i, view in enumerate(views[side])]
        for side in (0, 1)
    ]
    names = []
    for side in (0, 1):
        alone = [SeenBoard(s.pose, 0, s.points, s.pixels) for s in seen[side]]
        to_side = (RigidTransform.identity(), start.T_right_left)[side]
        first = AdjustedState(
            start.parameters[side : side + 1],
            RigidTransform.identity(),
            tuple(to_side @ T for T in start.poses),
        )

        def fit(
            wanted: tuple[str, ...],
            earlier: Adjusted | None,
            alone: list[SeenBoard] = alone,
            first: AdjustedState = first,
        ) -> Adjusted:
            if earlier is not None:  # which ones is all that is asked
                return earlier
            return adjust(alone, _without(first, (wanted,)), _free((wanted,)), rounds=_ROUNDS[0])

        names.append(smallest_model(fit)[1])
    both = (names[0], names[1])
    pairs = [one for pair in zip(*seen, strict=True) for one in pair]
    return adjust(pairs, _without(start, both), _free(both), rounds=_ROUNDS[1]), both


def _free(names: tuple[tuple[str, ...], ...]) -> "np.ndarray[tuple[int, ...], np.dtype[np.bool_]]":
    return np.array([[name in row for name in PARAMETERS] for row in names])


def _without(state: AdjustedState, names: tuple[tuple[str, ...], ...]) -> AdjustedState:
    """Return the state with the coefficients at 0 that are not estimated."""
    parameters = np.where(_free(names), state.parameters, 0.0)
    return AdjustedState(parameters, state.T_right_left, state.poses)


def _lens(
    camera: TrueCamera, p: FloatArray, covariance: FloatArray, names: tuple[str, ...]
) -> Deviation:
    """Weigh a camera's parameters; of a rational lens only those that mean the same in both."""
    true = np.array([*camera.matrix[[0, 1, 0, 1], [0, 1, 2, 2]], *camera.distortion[:5]])
    wanted = names if not camera.distortion[5:].any() else names[:4]
    places = [PARAMETERS.index(name) for name in wanted]
    return Deviation.of((p - true)[places], covariance[np.ix_(places, places)], wanted)


def _calibration(
    before: RigScene, adjusted: Adjusted, names: tuple[tuple[str, ...], tuple[str, ...]]
) -> StereoCalibration:
    cameras = []
    for i, p in enumerate(adjusted.state.parameters.tolist()):
        covariance = adjusted.covariance[9 * i : 9 * i + 9, 9 * i : 9 * i + 9]
        cameras.append(
            CameraCalibration(
                name=before.profile.cameras[i].name,
                image_size=SIZE,
                focal_px=(p[0], p[1]),
                centre_px=(p[2], p[3]),
                distortion=(p[4], p[5], p[6], p[7], p[8]),
                estimated=names[i],
                covariance=tuple(map(tuple, covariance.tolist())),
                rms_px=adjusted.rms_px,
                views=VIEWS,
            )
        )
    return StereoCalibration(
        id="coverage",
        created=datetime(2026, 1, 1, tzinfo=UTC),
        cameras=(cameras[0], cameras[1]),
        pose=PoseCalibration.of(adjusted.state.T_right_left, adjusted.covariance[18:, 18:]),
        rms_px=adjusted.rms_px,
        misfit_px=0.0,
        joint_covariance=tuple(map(tuple, adjusted.covariance.tolist())),
    )


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
    sd = float(np.hypot(MARKER_PX, systematic_px(rig)))
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
