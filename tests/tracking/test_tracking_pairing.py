"""Which pictures were taken together, by their names."""

from pathlib import Path

import pytest

from app.tracking.calibration.pairing import cameras_of, pair_by_name, pair_folder, pair_folders
from app.tracking.errors import CalibrationError


def paths(*names: str) -> list[Path]:
    return [Path(name) for name in names]


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("left01.jpg", "right01.jpg"),
        ("01_Left.png", "01_RIGHT.png"),
        ("camera0_3.png", "camera1_3.png"),
        ("camera2_12.png", "camera4_12.png"),
        ("cam-0-7.bmp", "cam-1-7.bmp"),
        ("0_12.png", "1_12.png"),
        ("frame_12_0.png", "frame_12_1.png"),
        ("l3.png", "r03.png"),
        ("shot_12_l.png", "shot_12_r.png"),
    ],
)
def test_a_pair_is_one_name_with_two_cameras(left: str, right: str) -> None:
    (pair,) = pair_by_name(paths(right, left)).pairs
    assert (pair.left.name, pair.right.name) == (left, right)


def test_pairs_come_in_the_order_of_their_numbers() -> None:
    names = [f"{side}{i}.png" for side in ("left", "right") for i in (10, 9, 1, 2)]
    assert [pair.name for pair in pair_by_name(paths(*names)).pairs] == ["1", "2", "9", "10"]


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (("left1.png", "right2.png"), "left1.png, right2.png"),
        (("left1.png", "left01.png", "right1.png"), "both number 1"),
        (("camera0_1.png", "camera1_1.png", "camera2_1.png"), "3 camera"),
        (("left1.png", "right1.png", "a.png", "b.png"), "a.png, b.png: the name does not say"),
        (("a.png", "b.png"), "does not say the camera"),
    ],
)
def test_a_mismatch_is_refused_by_name(names: tuple[str, ...], words: str) -> None:
    with pytest.raises(CalibrationError, match=words):
        pair_by_name(paths(*names))


def test_two_folders_are_compared_by_the_rest_of_the_name() -> None:
    pairs = pair_folders(
        paths("a/shot_1.png", "a/shot_2.png"), paths("b/shot_01.png", "b/shot_2.png")
    ).pairs
    assert [(p.left.name, p.right.name) for p in pairs] == [
        ("shot_1.png", "shot_01.png"),
        ("shot_2.png", "shot_2.png"),
    ]
    found = pair_folders(paths("a/left1.png"), paths("b/right1.png", "b/img3.png"))
    assert [path.name for path in found.alone[1]] == ["img3.png"]
    with pytest.raises(CalibrationError, match=r"img3\.png"):
        pair_folders(paths("a/left1.png"), paths("b/img3.png"))


def test_a_folder_may_hold_one_folder_per_camera(tmp_path: Path) -> None:
    for side in ("left", "right"):
        (tmp_path / side).mkdir()
        for i in (1, 2):
            (tmp_path / side / f"{i}.png").write_bytes(b"x")
    assert [pair.left.parent.name for pair in pair_folder(tmp_path).pairs] == ["left", "left"]


def test_a_folder_that_is_missing_or_empty_is_named(tmp_path: Path) -> None:
    for folder in (tmp_path, tmp_path / "none"):
        with pytest.raises(CalibrationError, match=folder.name):
            pair_folder(folder)


def test_pictures_of_two_cameras_are_told_apart_and_of_one_kept_together() -> None:
    found, strays = cameras_of(paths("left1.png", "right1.png", "left2.png", "desk.png"))
    assert {name: len(files) for name, files in found.items()} == {"left": 2, "right": 1}
    assert [path.name for path in strays] == ["desk.png"]
    assert list(cameras_of(paths("a1.png", "a2.png"))[0]) == ["camera"]


def test_stray_files_are_named_and_skipped_and_lone_pictures_serve_their_camera(
    tmp_path: Path,
) -> None:
    names = ("left1.png", "right1.png", "left2.png", "right3.png", "desk.png", "notes.txt", ".x")
    for name in names:
        (tmp_path / name).write_bytes(b"x")
    found = pair_folder(tmp_path)
    assert [pair.name for pair in found.pairs] == ["1"]
    assert [[path.name for path in side] for side in found.alone] == [["left2.png"], ["right3.png"]]
    assert [path.name for path in found.skipped] == ["desk.png", "notes.txt"]
    assert found.remarks[0].startswith("skipped: desk.png, notes.txt")
    assert "left2.png: used for the left camera alone" in found.remarks[1]


def test_a_stray_picture_beside_the_folders_of_two_cameras_is_skipped(tmp_path: Path) -> None:
    for side in ("left", "right"):
        (tmp_path / side).mkdir()
        (tmp_path / side / "1.png").write_bytes(b"x")
    (tmp_path / "overview.jpg").write_bytes(b"x")
    found = pair_folder(tmp_path)
    assert len(found.pairs) == 1
    assert [path.name for path in found.skipped] == ["overview.jpg"]
