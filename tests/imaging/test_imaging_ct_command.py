"""`acus ct list` and `acus ct point`."""

import hashlib
import json
import sys

import numpy as np
import pytest

from app.__main__ import main
from app.imaging.phantom.anatomy import anatomy
from app.imaging.phantom.series import phantom_series
from tests.imaging.dicom_factory import Slices
from tests.imaging.test_imaging_enhanced import write_enhanced


def run(monkeypatch, capsys, *arguments) -> tuple[int, str, str]:
    monkeypatch.setattr(sys, "argv", ["acus", "ct", *map(str, arguments)])
    with pytest.raises(SystemExit) as ended:
        main()
    out, err = capsys.readouterr()
    return int(ended.value.code or 0), out, err


@pytest.fixture
def ct(monkeypatch, capsys):
    return lambda *arguments: run(monkeypatch, capsys, *arguments)


def test_list_prints_geometry_and_reason_and_no_name(ct, tmp_path):
    Slices().write(tmp_path)
    Slices(series="2.25.7", shear=0.3).write(tmp_path, "t")
    Slices(series="2.25.8", offsets=(0.0, 2.0, 4.3, 6.0)).write(tmp_path, "u")
    (tmp_path / "note.txt").write_text("x")
    code, out, _ = ct("list", tmp_path, "--json")
    answer = json.loads(out)["facts"]
    good, tilted, uneven = answer["series"]
    assert code == 0
    assert good["usable"]
    assert good["reason"] == ""
    assert good["size"] == [16, 12, 5]
    assert good["spacing_mm"] == [0.5, 0.8, 2.0]
    assert good["origin_mm"] == [-20.0, 30.0, -100.0]
    assert good["direction"] == [1, 0, 0, 0, 1, 0, 0, 0, 1]
    assert tilted["usable"]
    assert tilted["notes"] == ["gantry tilt 16.7°"]
    assert tilted["remedy"] == "straighten"
    assert not uneven["usable"]
    assert "uneven spacing" in uneven["reason"]
    assert uneven["remedy"] == "resample"
    assert answer["ignored"] == [{"file": "note.txt", "reason": "not a DICOM file"}]
    code, text, _ = ct("list", tmp_path)
    assert "usable" in text
    assert "refused" in text
    assert "gantry tilt 16.7°" in text
    assert "ecret" not in (out + text).lower()


@pytest.mark.long("journey")
def test_a_frame_of_a_multi_frame_file_is_named_from_one(ct, tmp_path):
    write_enhanced(tmp_path / "e", Slices())
    _, out, _ = ct("list", tmp_path, "--json")
    slices = json.loads(out)["facts"]["series"][0]["slices"]
    uid = slices[0]["sop_uid"]
    frames = [one["frame"] for one in slices]
    assert sorted(frames) == [1, 2, 3, 4, 5]
    assert {one["sop_uid"] for one in slices} == {uid}
    _, out, _ = ct("point", tmp_path, "--voxel", "3,2,4", "--json")
    answer = json.loads(out)["facts"]
    assert (answer["sop_uid"], answer["frame"]) == (uid, frames[4])
    _, out, _ = ct(
        "point", tmp_path, "--sop", uid, "--pixel", "3,2", "--frame", frames[4], "--json"
    )
    assert json.loads(out)["facts"] == answer
    code, _, err = ct("point", tmp_path, "--sop", uid, "--pixel", "3,2", "--frame", "6")
    assert code == 2
    assert "frame 6" in err
    code, _, err = ct("point", tmp_path, "--voxel", "3,2,4", "--frame", "2")
    assert code == 2
    assert "go with --sop" in err


def test_a_digest_is_what_another_program_computes_from_values_and_geometry(ct, tmp_path):
    slices = Slices()
    slices.write(tmp_path)
    _, out, _ = ct("digest", tmp_path, "--json")
    answer = json.loads(out)["facts"]
    values = np.stack([slices.stored(k) - 1024 for k in range(5)]).astype("<i2")
    assert answer["values"] == hashlib.sha256(values.tobytes()).hexdigest()
    assert answer["kind"] == "<i2"
    assert answer["size"] == [16, 12, 5]
    expected = np.eye(4)
    expected[:3, :3] = np.diag([0.5, 0.8, 2.0])
    expected[:3, 3] = slices.origin
    np.testing.assert_allclose(np.reshape(answer["affine_mm"], (4, 4)), expected, atol=1e-9)
    _, text, _ = ct("digest", tmp_path)
    assert answer["values"] in text


def test_slices_far_apart_are_said_to_have_nothing_between_them(ct, tmp_path):
    Slices(offsets=(0.0, 247.0), tags={"SliceThickness": "2.5"}).write(tmp_path / "far")
    Slices(offsets=(0.0, 2.5, 5.0), tags={"SliceThickness": "2.5"}).write(tmp_path / "near")
    notes = {}
    for name in ("far", "near"):
        _, out, _ = ct("list", tmp_path / name, "--json")
        notes[name] = json.loads(out)["facts"]["series"][0]["notes"]
    assert notes["far"] == ["slices lie 247.0 mm apart and are 2.5 mm thick: what is shown between "
                            "them is interpolated, nothing there was scanned"]  # fmt: skip
    assert notes["near"] == []


def test_a_file_without_a_frame_of_reference_is_not_counted_as_one(ct, tmp_path):
    slices = Slices()
    slices.write(tmp_path)
    slices.write_one(tmp_path / "s000", 0, 0.0, FrameOfReferenceUID=None)
    _, out, _ = ct("list", tmp_path, "--json")
    (note,) = [one for one in json.loads(out)["facts"]["series"][0]["notes"] if "frame" in one]
    assert "2 frames" not in note
    assert "name no frame of reference" in note


def test_images_at_one_place_have_no_spacing_and_a_mosaic_is_called_one(ct, tmp_path):
    Slices(offsets=(0.0, 8e-14)).write(tmp_path / "same")
    _, out, _ = ct("list", tmp_path / "same", "--json")
    for series in json.loads(out)["facts"]["series"]:
        assert series["spacing_mm"] is None
    kinds = {"ImageType": ["ORIGINAL", "PRIMARY", "M", "MOSAIC"]}
    Slices(tags=kinds).write(tmp_path / "mosaic")
    _, out, _ = ct("list", tmp_path / "mosaic", "--json")
    assert "a mosaic" in json.loads(out)["facts"]["series"][0]["reason"]


def test_a_refusal_names_the_remedy_that_there_is(ct, tmp_path):
    Slices(offsets=(0.0, 2.0, 4.3, 6.0)).write(tmp_path)
    code, _, err = ct("digest", tmp_path)
    assert code == 2
    assert "--remedy resample" in err
    code, out, _ = ct("digest", tmp_path, "--remedy", "resample")
    assert code == 0
    assert "sha256" in out


def test_point_finds_a_voxel_and_a_pixel(ct, tmp_path):
    slices = Slices()
    slices.write(tmp_path)
    code, out, _ = ct("point", tmp_path, "--voxel", "3,2,4", "--json")
    assert code == 0
    expected = {"lps_mm": [-18.5, 31.6, -92.0], "hu": int(slices.stored(4)[2, 3]) - 1024}
    answer = json.loads(out)["facts"]
    assert answer["hu"] == expected["hu"]
    assert answer["lps_mm"] == pytest.approx(expected["lps_mm"], abs=1e-9)
    assert (answer["sop_uid"], answer["frame"]) == ("2.25.1000.5", 1)
    _, out, _ = ct("point", tmp_path, "--sop", "2.25.1000.5", "--pixel", "3,2", "--json")
    assert json.loads(out)["facts"] == answer
    _, out, _ = ct("point", tmp_path, "--voxel", "3,2,4")
    assert out.startswith("LPS -18.500 31.600 -92.000 mm")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--voxel", "-1,2,3"), "I 0 to 15"),
        (("--voxel", "1,2,5"), "K 0 to 4"),
        (("--voxel", "1,2"), "3 whole numbers"),
        (("--voxel", "a,b,c"), "3 whole numbers"),
        (("--sop", "2.25.1000.5", "--pixel", "16,0"), "columns 0 to 15"),
        (("--sop", "2.25.1000.5", "--pixel=-1,0"), "columns 0 to 15"),
        (("--sop", "2.25.9", "--pixel", "0,0"), "no file with SOPInstanceUID 2.25.9"),
        (("--sop", "2.25.9"), "go together"),
        ((), "name a point"),
        (("--voxel", "1,2,3", "--series", "2.25.4"), "no series 2.25.4"),
    ],
)
def test_bad_points_are_one_line_and_exit_code_two(ct, tmp_path, arguments, words):
    Slices().write(tmp_path)
    code, out, err = ct("point", tmp_path, *arguments)
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1


@pytest.mark.parametrize("verb", ["list", "point"])
def test_bad_folders_are_one_line_and_exit_code_two(ct, tmp_path, verb):
    (tmp_path / "empty").mkdir()
    for folder, words in (("nowhere", "does not exist"), ("empty", "is empty")):
        more = ("--voxel", "0,0,0") if verb == "point" else ()
        code, _, err = ct(verb, tmp_path / folder, *more)
        assert code == 2
        assert words in err
        assert err.count("\n") == 1


@pytest.mark.long("journey")
def test_path_says_what_a_straight_line_meets_and_how_sure_that_is(ct):
    folder, plan = phantom_series(1, slices=60, rows=64), anatomy(1)
    ends = [",".join(f"{value:.1f}" for value in p) for p in (plan.entry_mm, plan.lesion_mm)]
    code, out, _ = ct("path", folder, f"--entry={ends[0]}", f"--target={ends[1]}", "--json")
    answer = json.loads(out)["facts"]
    assert code == 0
    assert [row["words"] for row in answer["tissues"] if row["length_mm"] > 1.0] == [
        *("skin", "fat", "muscle", "fat", "liver", "lesion"),
    ]
    assert {row["source"] for row in answer["tissues"]} == {"recipe"}
    code, out, _ = ct("path", folder, f"--entry={ends[0]}", f"--target={ends[1]}")
    assert "liver, 41." in out
    code, _, said = ct("path", folder, "--entry=1,2", f"--target={ends[1]}")
    assert code != 0
    assert "three numbers X,Y,Z" in said


@pytest.mark.long("journey")
def test_path_reports_a_path_through_the_lung_and_says_where_there_is_none(ct):
    folder = phantom_series(2000, slices=60, rows=64)
    x, y, z = anatomy(2000).organs["lung nodule"]
    entry, target = "--entry=-111.7,-83.8,259.9", f"--target={x:.2f},{y:.2f},{z:.2f}"
    code, out, _ = ct("path", folder, entry, target, "--lung", "--json")
    report = json.loads(out)["facts"]["lung"]
    assert code == 0
    assert len(report["pleura"]) == len(report["fissures"]) == 1
    assert report["fissures"][0]["beyond"] == "right lower lobe"
    assert 30.0 < report["lung_mm"] < 60.0
    assert report["is_protected"] is True
    code, out, _ = ct("path", folder, entry, target, "--lung")
    assert "Fissures crossed: 1 (" in out
    code, _, said = ct("path", folder, "--entry=-60,-105,150", "--target=-74,-9,152", "--lung")
    assert code != 0
    assert "this path does not go through the lung" in said
