"""`acus calibrate views`, `mono` and `stereo` on rendered pictures."""

import json
import re
from pathlib import Path

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from app.commands import build
from app.core.configuration import load
from app.core.errors import ConfigurationError
from app.tracking.calibration.formats.own import load_calibration
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import CameraCalibration
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


@pytest.mark.long("journey")
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
    document = json.loads(text)["facts"]
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


@pytest.mark.long("journey")
def test_a_calibration_that_is_contradicted_ends_with_3_and_is_kept_only_by_force(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    file = tmp_path / "cameras.yaml"
    wrong = ["stereo", "--images", str(folder), "--board", "checkerboard:9x6:20mm"]
    wrong += ["--baseline-mm", "83", "--out", str(file), "--keep"]
    result = CliRunner().invoke(build(), ["calibrate", *wrong], catch_exceptions=False)
    assert result.exit_code == 3
    assert "verdict: not good enough: a length that is known contradicts it" in result.stdout
    assert re.search(r"squares of (24\.9|25)", result.stdout)
    assert not file.exists()
    assert not (tmp_path / "data").exists()
    result = CliRunner().invoke(build(), ["calibrate", *wrong, "--force"], catch_exceptions=False)
    assert result.exit_code == 0
    assert file.exists()


@pytest.mark.long("journey")
def test_stray_files_are_named_and_pictures_of_one_camera_help_its_lens(
    folder: Path, tmp_path: Path
) -> None:
    pairs, more = tmp_path / "pairs", tmp_path / "more"
    for place in (pairs, more):
        place.mkdir()
    for path in folder.glob("*.png"):
        place = more if path.stem in ("left06", "left07") else pairs
        (place / path.name).write_bytes(path.read_bytes())
    (pairs / "notes.txt").write_text("x")
    (pairs / "desk.png").write_bytes((pairs / "left01.png").read_bytes())
    plain = ["stereo", "--images", str(pairs), *BOARD, "--hold-back", "0", "--json"]
    found = json.loads(run(*plain, "--left-alone", str(more)))["facts"]
    assert len(found["residuals"]) == 5
    assert [part.split(":")[0] for part in found["remarks"]] == ["skipped", "no partner"]
    assert "desk.png, notes.txt" in found["remarks"][0]
    assert "right06.png, right07.png" in found["remarks"][1]
    assert found["verdict"] == "usable"
    assert found["reason"] == "unchecked"
    without = json.loads(run(*plain))["facts"]
    assert found["cameras"][0]["sd"]["fx"] < without["cameras"][0]["sd"]["fx"]
    assert {one["name"] for one in found["pictures"]} > {"left06.png", "right07.png"}


@pytest.mark.long("journey")
def test_mono_calibrates_each_camera_that_the_names_speak_of(folder: Path) -> None:
    text = run("mono", "--images", str(folder), *BOARD, "--hold-back", "0")
    assert "left" in text
    assert "right" in text
    assert text.count("k3") == 2


@pytest.mark.long("journey")
def test_the_lens_of_one_camera_is_written_alone(folder: Path, tmp_path: Path):
    lefts, lens = tmp_path / "left", tmp_path / "lens.yaml"
    lefts.mkdir()
    for path in folder.glob("left*.png"):
        (lefts / path.name).write_bytes(path.read_bytes())
    run("mono", "--images", str(lefts), *BOARD, "--hold-back", "0", "--out", str(lens))
    calibration = load(lens, CameraCalibration)
    assert calibration.views > 2
    assert calibration.covariance[0][0] > 0.0
    with pytest.raises(ConfigurationError, match="left, right"):
        run("mono", "--images", str(folder), *BOARD, "--out", str(tmp_path / "two.yaml"))


@pytest.mark.long("journey")
def test_views_says_of_every_picture_what_it_is_good_for(folder: Path) -> None:
    document = json.loads(run("views", "--images", str(folder), *BOARD, "--json"))["facts"]
    assert len(document["views"]) == 14
    assert all(view["used"] for view in document["views"])


@pytest.mark.long("journey")
def test_too_few_pairs_are_refused_whatever_has_no_partner(folder: Path, tmp_path: Path) -> None:
    for path in folder.glob("*0[1-3].png"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    (tmp_path / "right02.png").unlink()
    with pytest.raises(CalibrationError, match="2 of 2 pairs"):
        run("stereo", "--images", str(tmp_path), *BOARD)
