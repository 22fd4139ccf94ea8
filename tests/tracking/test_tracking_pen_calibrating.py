"""Calibrating a pen from pictures: poses on the sheet, tip, direction, and what is kept."""

import dataclasses

import numpy as np
import pytest
from pen_rig import BASE, BODY, DOWN, ENTRY, PEN, TIP, camera, sighting, step, webcam

from app.core.transform import RigidTransform
from app.tracking.cameras.camera import CameraFrame
from app.tracking.confidence import chi_square_quantile
from app.tracking.errors import CameraError
from app.tracking.pen.calibrating import PoseCollector, relative_pose
from app.tracking.pen.drawing import draw_observation
from app.tracking.pen.errors import PenError
from app.tracking.pen.locator import BoardLocator
from app.tracking.pen.pose import PoseStatus
from app.tracking.pen.settings import PenSettings, load_settings, save_pen, save_settings
from app.tracking.simulated.pen_scene import body_pose

MODEL = camera()
BLANK = step(MODEL).observe(CameraFrame(np.full((480, 640, 3), 128, np.uint8), 1.0))
TRUE_TIP = np.array([0.0015, -0.001, 0.172])


def observed(T_world_body, rng):
    """An observation from corners, without a picture."""
    poses = []
    for board, T in ((BODY, T_world_body), (BASE, PEN.base.pose(ENTRY))):
        T_camera = MODEL.T_camera_world @ T
        seen = [
            sighting(MODEL, T_camera, m, rng, 0.05, board.build_sd)
            for m in board.markers
            if T_camera.rotate(m.normal) @ (T_camera @ m.corners.mean(axis=0)) < -0.1
        ]
        poses.append(BoardLocator(board, 0.0).locate(MODEL, seen))
    return dataclasses.replace(BLANK, body=poses[0], base=poses[1])


def rocking(rng, n=45, spread=0.45):
    for _ in range(n):
        lean = spread * rng.uniform(-1.0, 1.0, 2)
        axis = np.array([*lean, -1.0]) / np.linalg.norm([*lean, 1.0])
        direction = TRUE_TIP / np.linalg.norm(TRUE_TIP)
        pose = body_pose(ENTRY, axis, TRUE_TIP, direction, rng.uniform(0.0, 6.0))
        seen = observed(pose, rng)
        if seen.body.status is PoseStatus.FOUND:
            yield seen, pose


def test_the_covariance_of_a_pose_on_the_sheet_holds():
    distances = []
    for seen, pose in rocking(np.random.default_rng(1), 30):
        true = PEN.base.pose(ENTRY).inverse() @ pose
        found = relative_pose(seen)
        error = (found.T @ true.inverse()).log()
        distances.append(error @ np.linalg.solve(found.covariance, error))
    assert np.mean(np.array(distances) < chi_square_quantile(0.95, 6)) >= 0.85
    assert 0.7 < np.mean(distances) / 6.0 < 1.4


def test_a_rocked_pen_is_calibrated_to_its_true_tip():
    collector = PoseCollector()
    for seen, _ in rocking(np.random.default_rng(2)):
        collector.add(seen)
    assert not collector.add(seen), "the same pose says nothing new"
    found = collector.finish(PEN)
    error = found.tip.p_tip - TRUE_TIP
    assert error @ np.linalg.solve(found.tip.covariance, error) < chi_square_quantile(0.999, 3)
    assert np.linalg.norm(error) < 2e-3
    assert found.pen.tip.calibrated
    assert "standard deviation" in found.words
    assert collector.share == pytest.approx(len(collector.poses) / 80)


def test_pictures_without_cube_or_sheet_give_no_pose():
    blank = step(MODEL).observe(CameraFrame(np.full((480, 640, 3), 128, np.uint8), 1.0))
    collector = PoseCollector()
    assert not collector.add(blank)
    with pytest.raises(PenError, match="too few"):
        collector.finish(PEN)


def test_a_calibrated_pen_and_the_settings_are_kept(tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("ACUS_SETTINGS", str(tmp_path / "settings"))
    assert load_settings() == PenSettings()
    chosen = PenSettings(source="usb:0", size=(640, 480))
    save_settings(chosen)
    assert load_settings() == chosen
    assert not chosen.profile().tip.calibrated
    tip = PEN.tip.model_copy(update={"calibrated": True, "position_mm": (1.0, 2.0, 170.0)})
    save_pen(PEN.model_copy(update={"tip": tip}))
    assert chosen.profile().tip == tip


def test_a_lens_is_read_from_its_file_and_a_wrong_name_is_named(tmp_path):
    from app.tracking.pen.settings import load_webcam

    lens = webcam(MODEL).calibration
    file = tmp_path / "lens.yaml"
    file.write_text(lens.model_dump_json(), encoding="utf-8")
    assert load_webcam(file).calibration == lens
    pair = {
        "id": "x",
        "created": "2026-11-22T10:00:00Z",
        "cameras": [lens.model_dump(mode="json") | {"name": name} for name in ("left", "right")],
        "pose": {"rotation": np.eye(3).tolist(), "translation_mm": [1.0, 0.0, 0.0]},
    }
    import yaml

    both = tmp_path / "pair.yaml"
    both.write_text(yaml.safe_dump(pair), encoding="utf-8")
    assert load_webcam(both, "right").calibration.name == "right"
    with pytest.raises(CameraError, match="left, right"):
        load_webcam(both, "middle")


def test_what_was_found_is_drawn_and_an_empty_picture_stays_as_it_is():
    blank = CameraFrame(np.full((480, 640, 3), 128, np.uint8), 1.0)
    seen = step(MODEL).observe(blank)
    assert np.array_equal(draw_observation(blank.image, seen), blank.image)
    pose = body_pose(ENTRY, np.array([0.0, 0.0, -1.0]), TIP, DOWN, 1.0)
    found = observed(pose, np.random.default_rng(0))
    assert isinstance(found.body.T_camera_board, RigidTransform)
    assert not np.array_equal(draw_observation(blank.image, found), blank.image)
