"""`acus calibrate views`, `mono` and `stereo` on rendered pictures."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from app.commands import build
from app.core.errors import ConfigurationError
from app.tracking.calibration.formats.own import load_calibration
from app.tracking.errors import CalibrationError
from app.tracking.pen.settings import load_webcam
from app.tracking.simulated.board import BoardRenderer
from tests.tracking.calibration_rig import usual_rig

BOARD = ["--board", "checkerboard:9x6:25mm"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place, rig = tmp_path_factory.mktemp("pairs"), usual_rig()
    rng = np.random.default_rng(2)
    for i, T in enumerate(rig.poses(7, 3), 1):
        for camera in (rig.left, rig.right):
            image = BoardRenderer(camera, rig.board, 1).render(
                camera.T_camera_world @ T, 0.8, 2.0, rng
            )
            cv2.imwrite(str(place / f"{camera.name}{i:02d}.png"), image)
    return place


def run(*arguments: str) -> str:
    result = CliRunner().invoke(build(), ["calibrate", *arguments], catch_exceptions=False)
    return result.stdout


def test_stereo_says_what_json_docs_list_and_writes_its_file(folder: Path, tmp_path: Path) -> None:
    file = tmp_path / "cameras.yaml"
    text = run(
        "stereo",
        "--images",
        str(folder),
        *BOARD,
        "--hold-back",
        "2",
        "--baseline-mm",
        "83",
        "--out",
        str(file),
        "--json",
    )
    document = json.loads(text)
    page = (Path(__file__).resolve().parents[2] / "docs" / "json.md").read_text(encoding="utf-8")
    for key in (
        *document,
        *document["cameras"][0],
        *document["validation"],
        *document["checks"][0],
    ):
        assert f"`{key}`" in page or f"`{key}[]`" in page, key
    assert document["baseline_mm"] == pytest.approx(83.0, abs=0.5)
    assert document["validation"]["views"] == 2
    assert document["checks"][0]["passed"] is True
    assert load_calibration(file).id == document["id"]


def test_a_wrong_board_size_is_caught_by_the_baseline(folder: Path, tmp_path: Path) -> None:
    file = tmp_path / "cameras.yaml"
    with pytest.raises(CalibrationError, match="squares of 25"):
        run(
            "stereo",
            "--images",
            str(folder),
            "--board",
            "checkerboard:9x6:20mm",
            "--baseline-mm",
            "83",
            "--out",
            str(file),
        )
    assert not file.exists()


def test_mono_calibrates_each_camera_that_the_names_speak_of(folder: Path) -> None:
    text = run("mono", "--images", str(folder), *BOARD, "--hold-back", "0")
    assert "left" in text
    assert "right" in text
    assert "not supported by the views" in text


def test_the_lens_of_one_camera_is_written_as_the_pen_reads_it(folder: Path, tmp_path: Path):
    lefts, lens = tmp_path / "left", tmp_path / "lens.yaml"
    lefts.mkdir()
    for path in folder.glob("left*.png"):
        (lefts / path.name).write_bytes(path.read_bytes())
    run("mono", "--images", str(lefts), *BOARD, "--hold-back", "0", "--out", str(lens))
    webcam = load_webcam(lens)
    assert not webcam.guessed
    assert webcam.calibration.views > 2
    assert np.sqrt(webcam.parameter_covariance[0, 0]) > 0.0
    with pytest.raises(ConfigurationError, match="left, right"):
        run("mono", "--images", str(folder), *BOARD, "--out", str(tmp_path / "two.yaml"))


def test_views_says_of_every_picture_what_it_is_good_for(folder: Path) -> None:
    document = json.loads(run("views", "--images", str(folder), *BOARD, "--json"))
    assert len(document["views"]) == 14
    assert all(view["used"] for view in document["views"])


def test_a_picture_without_partner_is_refused_by_name(folder: Path, tmp_path: Path) -> None:
    for path in folder.glob("*0[1-3].png"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    (tmp_path / "right02.png").unlink()
    with pytest.raises(CalibrationError, match=r"left02\.png"):
        run("stereo", "--images", str(tmp_path), *BOARD)
