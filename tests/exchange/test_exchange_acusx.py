"""An exercise as one file: there and back, and files that are not what they seem."""

import hashlib
import io
import json
import zipfile
from pathlib import Path

import numpy as np
import pytest
from dicom_factory import SERIES, Slices
from typer.testing import CliRunner

from app.commands import build
from app.exchange.acusx import (
    CtMissingError,
    PackageError,
    TakenError,
    pack,
    read_manifest,
    unpack,
)
from app.exchange.markups import read_plan
from app.exercises.errors import UnknownExerciseError
from app.exercises.library import load_exercise, read_exercise
from app.exercises.schema import Exercise
from app.exercises.writing import write_exercise
from app.imaging.library import CtLibrary
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.structures.files import read_structures, write_structures
from app.imaging.structures.structure import Structure, StructureKind, StructureSet


def of_ct(folder, **more):
    """An exercise on the CT of a folder."""
    return Exercise.model_validate(
        {
            "id": "mine", "title": "Mine", "description": "Zwölf Zeilen\nund eine",
            "ct": {"folder": folder, "digest": load_ct(folder).digest},
            "plan": {"entry_mm": [1.0, -2.0, 3.0], "target_mm": [1.0, 20.0, 3.0], "name": "way"},
        } | more
    )  # fmt: skip


@pytest.fixture
def ct(tmp_path):
    Slices().write(tmp_path / "given" / "Meier^Otto")
    return tmp_path / "given" / "Meier^Otto"


@pytest.fixture
def file(tmp_path, ct):
    path = tmp_path / "mine.acusx"
    pack(path, of_ct(ct), load_ct(ct))
    return path


@pytest.fixture
def elsewhere(tmp_path, monkeypatch):
    """The folders of another computer."""
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "other" / "data"))
    monkeypatch.setenv("ACUS_SETTINGS", str(tmp_path / "other" / "settings"))
    return tmp_path / "other" / "data"


def rewritten(path, change=None, add=(), manifest=None):
    """The file again, with other members or another manifest; its digests are made to fit."""
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    members |= change or {}
    members = {name: value for name, value in members.items() if value is not None}
    document = json.loads(members.pop("manifest.json"))
    document["files"] = {name: hashlib.sha256(raw).hexdigest() for name, raw in members.items()}
    document |= manifest or {}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("manifest.json", json.dumps(document))
        for name, raw in members.items():
            archive.writestr(name, raw)
        for info, raw in add:
            archive.writestr(info, raw)
    return path


def left_of(folder):
    return sorted(str(one.relative_to(folder)) for one in folder.rglob("*") if one.is_file())


# --- there and back -----------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_a_phantoms_exercise_comes_back_equal(tmp_path, elsewhere):
    exercise = load_exercise("past-the-vessel").model_copy(update={"id": "mine"})
    folder = phantom_series(3, slices=8, rows=32)  # its digest is of no concern here
    manifest = pack(tmp_path / "a.acusx", exercise, load_ct(folder))
    assert manifest.ct.phantom == 3
    found = unpack(tmp_path / "a.acusx")
    assert found.exercise == exercise
    assert not found.known
    assert load_exercise("mine") == exercise
    assert unpack(tmp_path / "a.acusx").known


@pytest.mark.long("journey")
def test_with_the_ct_it_needs_nothing_else_and_tells_nobodys_name(tmp_path, ct, elsewhere):
    volume = load_ct(ct)
    corner = np.zeros(volume.hu.shape, bool)
    corner[1:3, 1:4, 1:4] = True
    drawn = StructureSet((Structure.of("portal vein", corner, volume, StructureKind.VESSEL),))
    write_structures(tmp_path / "Meier.seg.nrrd", drawn, volume)
    part = {"file": tmp_path / "Meier.seg.nrrd", "risks": {"portal vein": 4.0}}
    exercise = of_ct(ct, structures=[part])
    path = tmp_path / "a.acusx"
    manifest = pack(path, exercise, volume, with_ct=True)
    packed = b"".join(zipfile.ZipFile(path).read(name) for name in manifest.files)
    assert b"Meier" not in packed + path.read_bytes()
    assert b"Otto" not in packed
    found = unpack(path)
    assert found.ct.parent == elsewhere / "ct"
    again = load_ct(found.ct)
    assert again.digest == volume.digest == found.exercise.ct.digest
    structure = read_structures(found.structures[0], again).find("portal vein")
    assert structure.mask.sum() == corner.sum()
    assert found.exercise.structures[0].risks == {"portal vein": 4.0}
    same = {"ct": exercise.ct, "structures": exercise.structures}
    assert found.exercise.model_copy(update=same) == exercise
    assert load_exercise("mine") == found.exercise
    assert unpack(path).known
    assert len(CtLibrary().entries()) == 1


def test_the_plan_in_it_opens_in_slicer(file, tmp_path):
    (tmp_path / "plan.mrk.json").write_bytes(zipfile.ZipFile(file).read("plan.mrk.json"))
    assert read_plan(tmp_path / "plan.mrk.json").entry_mm.tolist() == [1.0, -2.0, 3.0]


def test_profiles_of_ones_own_go_along(tmp_path, elsewhere):
    from app.core import paths

    own = tmp_path / "robot.yaml"
    own.write_bytes((paths.resources() / "devices" / "icube.yaml").read_bytes())
    exercise = load_exercise("first-insertion").model_copy(update={"id": "x", "device": str(own)})
    pack(tmp_path / "a.acusx", exercise, load_ct(phantom_series(1, slices=8, rows=32)))
    found = unpack(tmp_path / "a.acusx").exercise
    assert found.device != str(own)
    assert Path(found.device).read_bytes() == own.read_bytes()


# --- which CT -----------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_without_its_ct_it_says_which_one_is_needed(file, ct, elsewhere):
    with pytest.raises(CtMissingError, match="does not hold its CT: name the folder"):
        unpack(file)
    assert not elsewhere.exists()
    assert unpack(file, ct=ct).exercise.ct.folder == ct


def test_among_several_series_of_a_folder_the_digest_finds_the_ct(file, ct, elsewhere):
    Slices(series="1.2.3.9", offsets=(0.0, 2.5, 5.0, 7.5)).write(ct, prefix="t")
    Slices(series="1.2.3.8", origin=(0.0, 0.0, 0.0)).write(ct, prefix="u")
    found = unpack(file, ct=ct).exercise.ct
    assert (found.folder, found.series) == (ct, SERIES)
    assert load_ct(ct, found.series).digest == found.digest


def test_where_none_of_several_series_is_the_ct_all_are_said_to_be_others(
    file, tmp_path, elsewhere
):
    folder = tmp_path / "others"
    Slices(series="1.2.3.9", offsets=(0.0, 2.5, 5.0, 7.5)).write(folder)
    Slices(series="1.2.3.8", origin=(0.0, 0.0, 0.0)).write(folder, prefix="u")
    with pytest.raises(CtMissingError, match=r"none of the 2 CT series in .*others is that of"):
        unpack(file, ct=folder)


def test_another_ct_is_refused_in_whatever_folder_it_lies(file, tmp_path, elsewhere):
    Slices(offsets=(0.0, 2.5, 5.0, 7.5)).write(tmp_path / "other-ct")
    with pytest.raises(CtMissingError, match="another one than the exercise was made on"):
        unpack(file, ct=tmp_path / "other-ct")
    assert not (elsewhere / "exercises").exists()


def test_the_ct_of_pack_must_be_that_of_the_exercise(tmp_path, ct):
    exercise = of_ct(ct)
    Slices(offsets=(0.0, 2.5, 5.0, 7.5)).write(tmp_path / "other-ct")
    with pytest.raises(CtMissingError, match="another one"):
        pack(tmp_path / "a.acusx", exercise, load_ct(tmp_path / "other-ct"))
    assert not (tmp_path / "a.acusx").exists()


@pytest.mark.long("journey")
def test_another_ct_under_the_same_name_in_the_library_is_left_alone(tmp_path, ct, elsewhere):
    path = tmp_path / "a.acusx"
    pack(path, of_ct(ct), load_ct(ct), with_ct=True)
    first = unpack(path)
    for number, one in enumerate(sorted(first.ct.glob("*.dcm"))):
        raw = bytearray(one.read_bytes())
        raw[-3] ^= 1 + number  # a voxel is another one now
        one.write_bytes(raw)
    with pytest.raises(CtMissingError, match="another CT under the name of this one"):
        unpack(path, name="second")
    assert first.ct.is_dir()
    with pytest.raises(UnknownExerciseError, match="second"):
        load_exercise("second")


@pytest.mark.long("journey")
def test_an_id_that_is_taken_needs_a_choice(file, ct, elsewhere):
    assert unpack(file, ct=ct).exercise.version == 1
    mine = elsewhere / "exercises" / "mine.yaml"
    write_exercise(mine, read_exercise(mine).model_copy(update={"title": "Of somebody else"}))
    with pytest.raises(TakenError, match="--as NAME"):
        unpack(file, ct=ct)
    assert load_exercise("mine").title == "Of somebody else"
    assert unpack(file, ct=ct, name="second").exercise.id == "second"
    assert unpack(file, ct=ct, replace=True).exercise.version == 2
    assert load_exercise("mine@1").title == "Of somebody else"


# --- files that are not what they seem ----------------------------------------------------------
def info(name, mode=0):
    made = zipfile.ZipInfo(name)
    made.compress_type, made.external_attr = zipfile.ZIP_DEFLATED, mode << 16
    return made


@pytest.mark.parametrize(
    ("name", "mode", "told"),
    [
        ("../escaped.yaml", 0, "no part of an exercise"),
        ("/etc/cron.d/x", 0, "no part of an exercise"),
        ("structures/../../escaped.seg.nrrd", 0, "no part of an exercise"),
        ("ct\\..\\..\\x.dcm", 0, "no part of an exercise"),
        ("C:/x.dcm", 0, "no part of an exercise"),
        ("exercise.yaml\n", 0, "no part of an exercise"),
        ("run.exe", 0, "no part of an exercise"),
        ("ct/1.dcm", 0o120777, "a link"),
        ("structures/1.seg.nrrd", 0, "list of files is not what it holds"),
        ("exercise.yaml", 0, "twice"),
    ],
)
@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_members_that_none_has_are_refused_before_anything_is_written(
    name, mode, told, file, ct, elsewhere, tmp_path
):
    rewritten(file, add=[(info(name, mode), b"x")])
    before = left_of(tmp_path)
    for _ in range(2):
        with pytest.raises(PackageError, match=told):
            unpack(file, ct=ct)
    with pytest.raises(PackageError, match=told):
        read_manifest(file)
    assert left_of(tmp_path) == before


@pytest.mark.long("journey")
def test_a_bomb_is_not_unpacked(file, ct, elsewhere):
    big = io.BytesIO(bytes(300 << 20))
    rewritten(file, {"structures/1.seg.nrrd": big.getvalue()})
    assert file.stat().st_size < 1 << 20
    with pytest.raises(PackageError, match=r"would grow .* times"):
        unpack(file, ct=ct)


def test_a_text_of_many_megabytes_is_refused(file, ct, elsewhere):
    rewritten(file, {"exercise.yaml": b"#" * (2 << 20)})
    with pytest.raises(PackageError, match="larger than 1 MB"):
        unpack(file, ct=ct)


def test_a_newer_form_asks_for_a_newer_program(file, ct, elsewhere):
    rewritten(file, manifest={"version": 2, "acus": "9.0", "more": "things"})
    with pytest.raises(PackageError, match=r"newer Acus \(9.0\).* install"):
        unpack(file, ct=ct)


def test_what_was_altered_on_the_way_is_said(file, ct, elsewhere):
    with zipfile.ZipFile(file) as archive:
        files = json.loads(archive.read("manifest.json"))["files"]
    text = zipfile.ZipFile(file).read("exercise.yaml").replace(b"level: 1", b"level: 2")
    rewritten(file, {"exercise.yaml": text}, manifest={"files": files})
    with pytest.raises(PackageError, match="altered after it was packed"):
        unpack(file, ct=ct)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (b"level: 1", b"levl: 1", r"exercise.yaml: levl: Extra"),
        (b"device: icube", b"device: ../../../etc/robot.yaml", "which the file does not hold"),
        (b"rig: wide", b"rig: none", "rig: 'none' is not known"),
        (b"seed: 1", b"seed: 1\nstructures: [{file: /etc/passwd}]", "which the file does not hold"),
        (b"seed: 1", b"seed: 1\nstructures: [{file: ../x}]", "which the file does not hold"),
    ],
)
def test_an_exercise_that_points_elsewhere_is_refused(old, new, told, file, ct, elsewhere):
    text = zipfile.ZipFile(file).read("exercise.yaml")
    assert old in text
    rewritten(file, {"exercise.yaml": text.replace(old, new)})
    with pytest.raises(Exception, match=told):
        unpack(file, ct=ct)
    assert not (elsewhere / "exercises" / "mine.yaml").exists()


@pytest.mark.parametrize("cut", [0, 10, 200, -30])
def test_a_file_that_was_cut_off_or_is_none_is_one_line(cut, file, ct, elsewhere):
    file.write_bytes(file.read_bytes()[:cut])
    with pytest.raises(PackageError, match=r"no exercise file|damaged") as raised:
        unpack(file, ct=ct)
    assert "\n" not in str(raised.value)


@pytest.mark.long("journey")
def test_bits_that_were_turned_over_crash_nothing(file, ct, elsewhere):
    whole, rng, refused = file.read_bytes(), np.random.default_rng(1), []
    for place in rng.integers(0, len(whole), 60):
        raw = bytearray(whole)
        raw[place] ^= 1 << int(rng.integers(8))
        file.write_bytes(raw)
        try:
            assert unpack(file, ct=ct, name="x", replace=True).exercise.id == "x"
        except PackageError as error:
            refused.append(str(error))
    assert len(refused) > 40
    assert [line for line in refused if "\n" in line] == []


# --- on the command line ------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_the_commands_carry_an_exercise_to_another_computer(tmp_path, ct, monkeypatch):
    def acus(*words):
        result = CliRunner().invoke(build(), ["exercise", *map(str, words), "--json"])
        assert result.exit_code == 0, result.output
        return json.loads(result.stdout)["facts"]

    from app.exchange.markups import write_plan
    from app.planning.plan import Plan

    write_plan(tmp_path / "p.mrk.json", Plan(np.array([0.0, 0, 0]), np.array([0.0, 30, 0])))
    made = acus("new", "Leber, links", "--ct", ct, "--plan", tmp_path / "p.mrk.json")
    assert made["id"] == "leber-links"
    assert acus("validate", "leber-links")["exercises"][0]["problems"] == []
    packed = acus("pack", "leber-links", "--out", tmp_path / "a.acusx", "--with-ct")
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "other"))
    there = acus("unpack", packed["file"])
    assert (there["id"], there["known"]) == ("leber-links", False)
    own = [one for one in acus("list")["exercises"] if not one["shipped"]]
    assert [(one["id"], one["versions"]) for one in own] == [("leber-links", [1])]


def test_validate_names_field_and_line_to_the_last_effect(tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_text("id: bad\ntitle: Bad\n\neffects:\n  breathing: {parameters: {amplitud: 1}}\n")
    result = CliRunner().invoke(build(), ["exercise", "validate", str(path), "scans-only"])
    assert result.exit_code == 3
    assert "effects: " in result.stdout
    assert "amplitud" in result.stdout
    assert "(line 4)" in result.stdout
    assert "✔ scans-only" in result.stdout
