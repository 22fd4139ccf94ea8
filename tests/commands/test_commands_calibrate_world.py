"""`acus calibrate world` on rendered pictures."""

import json
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from board_pictures import board_picture
from calibration_samples import sample

from app.__main__ import main
from app.tracking.calibration.boards import parse_board
from app.tracking.calibration.history import CalibrationHistory
from app.tracking.calibration.placed_board import place
from app.tracking.optics.rig import load_rig

SPEC = "charuco:7x5:15mm:11mm:DICT_5X5_100"
AT = (-38.0, 175.0, 20.0, 120.0, 0.0, 0.0)


@pytest.fixture
def acus(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    def run(*arguments: str) -> tuple[int, str]:
        monkeypatch.setattr(sys, "argv", ["acus", "calibrate", "world", *arguments])
        try:
            code = main() or 0
        except SystemExit as error:
            code = int(error.code or 0)
        captured = capsys.readouterr()
        return code, captured.out + captured.err

    return run


@pytest.fixture(scope="module")
def pictures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("place")
    for model in load_rig("wide").models:
        image = board_picture(parse_board(SPEC), model, model.T_camera_world @ place(*AT))
        cv2.imwrite(str(folder / f"{model.name}01.png"), image)
    return folder


@pytest.fixture
def history() -> CalibrationHistory:
    history = CalibrationHistory()
    history.keep(sample(load_rig("wide"), "cal-one").model_copy(update={"world": None}))
    return history


def test_the_cameras_places_are_found_and_kept(acus, history, pictures: Path) -> None:
    at = ",".join(str(number) for number in AT)
    code, text = acus("--images", str(pictures), "--at", at, "--board", SPEC)
    assert code == 0
    assert "add --keep" in text
    assert history.active().id == "cal-one"
    code, text = acus("--images", str(pictures), "--at", at, "--board", SPEC, "--keep", "--json")
    assert code == 0
    document = json.loads(text)["facts"]
    for model in load_rig("wide").models:
        found = np.array(document["camera_centres_mm"][model.name])
        np.testing.assert_allclose(found, model.centre * 1e3, atol=1.0)
    assert document["scale"] == pytest.approx(1.0, abs=1e-3)
    assert document["remarks"] == []
    assert history.active().id == document["id"]
    assert history.active().world is not None
    assert set(document) == {
        "id", "T_world_left", "sd_mm", "sd_rad", "camera_centres_mm", "rms_px", "pictures",
        "refused", "scale", "scale_sd", "disagreement_mm", "fulcrum_sd_mm",
        "remarks", "kept",
    }  # fmt: skip


@pytest.mark.long("journey")
def test_what_is_wrong_is_named(acus, history, pictures: Path) -> None:
    folder = str(pictures)
    for arguments, said in (
        (("--images", folder, "--at", "1,2"), "is not x,y,z"),
        (("--images", folder, "--at", "1,2,nan"), "is not x,y,z"),
        (("--images", folder, "--images", folder, "--at", "1,2,3"), "2 folders and 1 places"),
        (("--images", folder, "--at", "0,0,0", "--calibration", "no"), "there are cal-one"),
        (("--images", folder, "--at", "0,0,0,0,0,0"), "faces down"),
        (("--images", folder + "-none", "--at", "0,0,0"), "no folder"),
    ):
        code, text = acus(*arguments, "--board", SPEC)
        assert code == 2
        assert said in text


def test_without_a_calibration_it_says_what_to_do_first(acus, pictures: Path) -> None:
    code, text = acus("--images", str(pictures), "--at", "0,0,0", "--board", SPEC)
    assert code == 2
    assert "acus calibrate stereo --keep" in text
