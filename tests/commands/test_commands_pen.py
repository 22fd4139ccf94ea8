"""`acus pen`: printing, listing, and calibrating from pictures of a folder."""

import json

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from app.commands import build
from app.tracking.errors import CameraError
from app.tracking.pen.errors import PenError
from app.tracking.pen.settings import load_settings
from app.tracking.simulated.pen_scene import PenScene, body_pose
from tests.tracking.pen_rig import ENTRY, camera, picture, renderer, webcam


@pytest.fixture(autouse=True)
def own_folders(tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("ACUS_SETTINGS", str(tmp_path / "settings"))


def acus(*arguments):
    return CliRunner().invoke(build(), ["pen", *arguments], catch_exceptions=False)


def test_the_pens_are_listed_with_what_is_known_of_their_tips():
    rows = json.loads(acus("list", "--json").stdout)["facts"]["pens"]
    assert [row["name"] for row in rows] == ["cube", "ring"]
    assert all("drawing" in row["tip"] for row in rows)


def test_a_simulated_pen_an_unknown_one_and_a_source_that_cannot_be_read_are_refused():
    with pytest.raises(PenError, match="--source"):
        acus("calibrate", "--source", "simulated")
    with pytest.raises(PenError, match="cube, ring"):
        acus("print", "--pen", "wand", "--out", "x.pdf")
    with pytest.raises(CameraError, match="usb"):
        acus("calibrate", "--source", "phone")


@pytest.mark.long("journey")
def test_pictures_of_a_rocked_and_rolled_pen_give_its_tip_and_its_shaft(tmp_path):
    model, tip = camera(), np.array([0.001, -0.001, 0.172])
    shaft = tip / np.linalg.norm(tip) + np.array([0.02, -0.01, 0.0])  # not through the middle
    shaft /= np.linalg.norm(shaft)
    draw, rng, folder = renderer(model), np.random.default_rng(4), tmp_path / "pictures"
    folder.mkdir()
    for k in range(36):
        lean = 0.5 * np.array([np.cos(2.4 * k), np.sin(2.4 * k)]) * np.sqrt((k + 1) / 36)
        axis = np.array([*lean, -1.0]) / np.linalg.norm([*lean, 1.0])
        pose = body_pose(ENTRY, axis, tip, tip / np.linalg.norm(tip), 1.0 + rng.uniform(-0.2, 0.2))
        cv2.imwrite(str(folder / f"{k:03d}.bmp"), picture(draw, PenScene(pose, ENTRY), k).image)
    lens = tmp_path / "lens.yaml"
    lens.write_text(webcam(model).calibration.model_dump_json(), encoding="utf-8")
    rolled = tmp_path / "rolled"
    rolled.mkdir()
    lying = np.array([0.25, 0.1, -0.963])
    for k in range(24):
        shift = ENTRY + np.array([0.001 * k, 0.0, 0.0])
        pose = body_pose(shift, lying / np.linalg.norm(lying), tip, shaft, 0.09 * k)
        cv2.imwrite(str(rolled / f"{k:03d}.bmp"), picture(draw, PenScene(pose, shift), k).image)
    found = acus(
        "calibrate", "--source", f"folder:{folder}", "--lens", str(lens), "--json",
        "--roll", f"folder:{rolled}",
    )  # fmt: skip
    document = json.loads(found.stdout)["facts"]
    assert (
        np.linalg.norm(np.array(document["tip_mm"]) - 1e3 * tip) < 3.0 * document["tip_sd_mm"] + 0.3
    )
    assert document["tip_sd_mm"] < 1.5
    assert load_settings().profile().tip.calibrated
    assert document["axis_by"] == "rolling"
    measured = np.array(load_settings().profile().tip.axis)
    error = np.degrees(np.linalg.norm(np.cross(measured, shaft)))
    assert error < 3.0 * document["axis_sd_deg"] + 0.1
    assert error < 0.5
