"""A trainer on pictures that are not simulated, and what keeps one from being built."""

from datetime import UTC, datetime
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from app.compose.camera_check import aim_of, survey_cameras
from app.compose.cameras import real_cameras
from app.compose.desktop import _learner
from app.compose.trainer import TrainerSetup, build_rig
from app.core.clock import SystemClock
from app.exercises.scene import device_of, placed_plan_of, plan_of
from app.session.ct_facts import CtFacts
from app.tracking.calibration.history import CalibrationHistory
from app.tracking.cameras.settings import (
    CameraSettings,
    load_settings,
    parse_cameras,
    save_settings,
)
from app.tracking.errors import CalibrationError, CameraError, RigError
from app.tracking.markers.colour import RED, ColourModel
from app.tracking.optics.calibration import CameraCalibration, PoseCalibration, StereoCalibration
from app.tracking.optics.rig import load_rig
from app.tracking.simulated.cameras import NeedleRenderer
from app.tracking.simulated.scene import MarkerScene
from tests.layered import layered

DEPTH = 0.05


@pytest.fixture(scope="module")
def wide():
    return load_rig("wide")


@pytest.fixture(scope="module")
def settings(wide, tmp_path_factory):
    """Settings of two folders that show an upright needle, tip 50 mm deep, with noise."""
    return _folders(wide, tmp_path_factory.mktemp("upright"), np.array([0.0, 0.0, -1.0]))


@pytest.fixture(scope="module")
def leaning(wide, tmp_path_factory):
    """As above, leaning to one side and 90 mm deep: off the symmetry and off the optical axes."""
    axis = np.array([0.3, 0.1, -1.0]) / np.linalg.norm([0.3, 0.1, -1.0])
    return _folders(wide, tmp_path_factory.mktemp("leaning"), axis, 0.09)


def _folders(wide, folder, axis, depth=DEPTH):
    rng, fulcrum = np.random.default_rng(1), np.array([0.0, 0.16056, 0.090])
    scene = MarkerScene.from_tip(fulcrum + depth * axis, axis, wide.needle.marker_offset)
    for model in wide.models:
        (folder / model.name).mkdir()
        clean = NeedleRenderer(model, wide.needle, wide.blur_px, 1).render(scene).astype(float)
        for number in range(4):
            image = np.clip(clean + rng.normal(0.0, 3.0, clean.shape), 0, 255).astype(np.uint8)
            assert cv2.imwrite(str(folder / model.name / f"{number}.png"), image)
    return parse_cameras(f"left=folder:{folder}/left,right=folder:{folder}/right")


def calibration(rig, **changes):
    cameras = [
        CameraCalibration(name=m.name, image_size=m.image_size, focal_px=tuple(m.intrinsics[:2]),
                          centre_px=tuple(m.intrinsics[2:]), distortion=tuple(m.distortion))
        for m in rig.models
    ]  # fmt: skip
    left, right = (model.T_world_camera for model in rig.models)
    given = {
        "id": "20261122-091244-3f2a", "created": datetime.now(UTC), "cameras": tuple(cameras),
        "pose": PoseCalibration.of(right.inverse() @ left), "world": PoseCalibration.of(left),
    }  # fmt: skip
    return StereoCalibration.model_validate(given | changes)


@pytest.mark.long("machine")
def test_a_trainer_measures_the_depth_with_cameras_and_its_record_says_which(
    wide, settings, tmp_path
):
    CalibrationHistory().keep(calibration(wide))
    exercise = layered("first-insertion")
    placed = placed_plan_of(exercise, device_of(exercise), plan_of(exercise))
    setup = TrainerSetup(exercise, placed, CtFacts("ct-1"), None, 1, tmp_path, cameras=settings)
    rig = build_rig(setup)
    clock = SystemClock()
    try:
        rig.trainer.open()
        end = clock.now() + 60.0
        while clock.now() < end:
            newest = rig.tracker.latest.read()
            if newest is not None and newest.value.has_point:
                break
            clock.sleep(0.02)
        rig.trainer.heartbeat()
        context = rig.trainer._context
    finally:
        rig.close()
    assert newest.value.depth == pytest.approx(DEPTH, abs=1e-3)
    assert context.metadata["cameras"] == {
        "name": "wide", "simulated": "no", "left": "folder", "right": "folder",
        "calibration": "20261122-091244-3f2a",
    }  # fmt: skip


def test_a_learned_colour_is_looked_for_from_the_next_start_on(wide, settings, tmp_path):
    CalibrationHistory().keep(calibration(wide))
    blue = ColourModel(bgr=(200.0, 40.0, 30.0))
    assert real_cameras(settings).colour == RED
    save_settings(settings)
    clicks = []

    def learned(camera, pixel):
        clicks.append(camera)
        return blue

    tracker = SimpleNamespace(learn_colour=learned)
    _learner(tracker, None)("left", np.zeros(2))
    assert load_settings().marker_colour is None
    _learner(tracker, settings)("left", np.zeros(2))
    assert clicks == ["left", "left"]
    exercise = layered("first-insertion")
    placed = placed_plan_of(exercise, device_of(exercise), plan_of(exercise))
    rig = build_rig(
        TrainerSetup(exercise, placed, CtFacts("ct-1"), None, 1, tmp_path, cameras=load_settings())
    )
    try:
        assert [one.coarse.colour for one in rig.stereo.extractors] == [blue, blue]
    finally:
        rig.close()


def test_without_a_calibration_or_its_world_frame_it_is_said_what_to_do(wide, settings):
    with pytest.raises(RigError, match="acus calibrate stereo"):
        real_cameras(settings)
    CalibrationHistory().keep(calibration(wide, world=None))
    with pytest.raises(RigError, match="acus calibrate world"):
        real_cameras(settings)


def test_a_calibration_of_another_size_or_of_swapped_cameras_is_refused(wide, settings):
    history = CalibrationHistory()
    history.keep(calibration(wide))
    with pytest.raises(CalibrationError, match=r"1280x720 .* calibrated at 640x480"):
        real_cameras(settings.model_copy(update={"size": (1280, 720)}))
    made = calibration(wide)
    history.keep(calibration(wide, id="other", cameras=made.cameras[::-1]))
    with pytest.raises(CalibrationError, match="swapped"):
        real_cameras(settings)


def test_a_calibration_that_was_found_bad_is_refused_though_the_settings_name_its_file(
    wide, settings
):
    history = CalibrationHistory()
    path = history.keep(calibration(wide))
    settings = settings.model_copy(update={"calibration": path})
    assert real_cameras(settings).rig.calibration is not None
    history.reject("20261122-091244-3f2a", "a camera was bumped")
    with pytest.raises(CalibrationError, match=r"found bad \(a camera was bumped\)"):
        real_cameras(settings)


@pytest.mark.long("machine")
def test_exchanged_cameras_are_found_by_the_marker_they_see(wide, leaning):
    CalibrationHistory().keep(calibration(wide))
    assert "as calibrated" in survey_cameras(leaning, "", 0.5).order
    swapped = leaning.model_copy(update={"left": leaning.right, "right": leaning.left})
    assert "the cameras are swapped" in survey_cameras(swapped, "", 0.5).order


@pytest.mark.long("machine")
def test_the_cone_of_calibrated_cameras_is_drawn_into_their_pictures(wide, leaning, tmp_path):
    CalibrationHistory().keep(calibration(wide))
    aim = aim_of(leaning, "icube")
    assert aim.basis == "calibration 20261122-091244-3f2a"
    assert aim.cone.share == 1.0
    aim.write_pictures(leaning, tmp_path)
    green = cv2.imread(str(tmp_path / "left.png"))[..., 1].astype(int)
    assert (green > 200).sum() > 500


def test_the_cone_of_uncalibrated_cameras_is_not_taken_for_seen(leaning):
    aim = aim_of(leaning, "icube")
    assert aim.assumed
    assert "not calibrated" in aim.basis
    assert not aim_of(CameraSettings(), "icube").assumed


def test_one_real_camera_is_refused():
    with pytest.raises(CameraError, match="one camera is real and one simulated"):
        parse_cameras("left=usb:1-1")
    with pytest.raises(CameraError, match="same source"):
        parse_cameras("left=usb:1-1,right=usb:1-1")
    assert parse_cameras("simulated") == CameraSettings()
