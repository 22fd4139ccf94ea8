"""`acus calibrate list|show|use|undo|redo|reject|export|import|print`."""

import json
import sys
from pathlib import Path

import pytest
from calibration_samples import sample

from app.__main__ import main
from app.tracking.calibration.history import CalibrationHistory
from app.tracking.optics.rig import load_rig

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def acus(monkeypatch: pytest.MonkeyPatch, capsys: Capture):
    def run(*arguments: str) -> tuple[int, str]:
        monkeypatch.setattr(sys, "argv", ["acus", "calibrate", *arguments])
        try:
            code = main() or 0
        except SystemExit as error:
            code = int(error.code or 0)
        captured = capsys.readouterr()
        return code, captured.out + captured.err

    return run


@pytest.fixture
def kept() -> CalibrationHistory:
    history = CalibrationHistory()
    for name in ("cal-one", "cal-two"):
        history.keep(sample(load_rig("thesis"), name))
    return history


@pytest.mark.long("journey")
def test_the_list_says_which_is_in_use_and_which_was_found_bad(acus, kept) -> None:
    assert acus("list") == (0, acus("list")[1])
    assert "* cal-two" in acus("list")[1]
    assert acus("reject", "cal-two", "--why", "camera bumped")[1].strip() == "in use: cal-one"
    text = acus("list")[1]
    assert "* cal-one" in text
    assert "FOUND BAD: camera bumped" in text
    document = json.loads(acus("list", "--json")[1])["facts"]
    assert [c["id"] for c in document["calibrations"]] == ["cal-two", "cal-one"]
    assert document["calibrations"][0]["found_bad"] == "camera bumped"
    assert document["calibrations"][1]["in_use"] is True
    assert set(document["calibrations"][0]) == {
        "id", "file", "kept", "in_use", "found_bad", "problem", "created", "board", "cameras",
        "baseline_mm", "rms_px", "validation_rms_mm", "world", "uncertainty_known",
    }  # fmt: skip


def test_an_empty_list_says_so(acus) -> None:
    code, text = acus("list")
    assert code == 0
    assert "no calibrations" in text


def test_undo_redo_and_use_move_what_is_in_use(acus, kept) -> None:
    assert json.loads(acus("undo", "--json")[1])["facts"] == {"in_use": "cal-one"}
    assert acus("undo")[1].strip() == "no calibration is in use"
    assert acus("redo")[1].strip() == "in use: cal-one"
    assert acus("use", "cal-t")[1].strip() == "in use: cal-two"
    code, text = acus("use", "nope")
    assert code == 2
    assert "there are cal-one, cal-two" in text


def test_show_tells_cameras_validation_and_notes(acus, kept) -> None:
    text = acus("show", "cal-one")[1]
    for words in ("640x480", "0.050 mm RMS", "k3 dropped", "cal-one.yaml"):
        assert words in text
    document = json.loads(acus("show", "cal-one", "--json")[1])["facts"]
    assert document["calibration"]["id"] == "cal-one"


def test_a_damaged_file_is_listed_with_its_reason(acus, kept) -> None:
    (kept.folder / "cal-one.yaml").write_text("id: 3\n")
    code, text = acus("list")
    assert code == 0
    assert "cal-one.yaml" in text
    assert acus("show", "cal-one")[0] == 2


def test_what_is_exported_is_imported_again(acus, kept, tmp_path: Path) -> None:
    assert acus("export", "cal-one", "--format", "ros", "--out", str(tmp_path / "ros"))[0] == 0
    pair = [str(tmp_path / "ros" / f"{name}.yaml") for name in ("left", "right")]
    code, text = acus("import", *pair)
    assert code == 0
    assert "in use from now on" in text
    assert "the calibration's own uncertainty is not known" in text
    assert "own uncertainty" not in acus("show", "cal-one")[1]
    path = tmp_path / "own.yaml"
    assert acus("export", "cal-one", "--out", str(path), "--json")[0] == 0
    assert path.read_text() == (kept.folder / "cal-one.yaml").read_text()
    assert len(json.loads(acus("list", "--json")[1])["facts"]["calibrations"]) == 3
    code, text = acus("export", "cal-one", "--format", "xml", "--out", str(path))
    assert code == 2
    assert "only yaml and ros" in text


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--unit", "1"), "a length with its unit"),
        (("--size", "big"), "WIDTHxHEIGHT"),
        ((), "no YAML file"),
    ],
)
def test_a_wrong_option_of_import_is_named(acus, tmp_path: Path, options, said: str) -> None:
    for name in ("a.txt", "b.txt"):
        (tmp_path / name).write_text("")
    code, text = acus("import", str(tmp_path / "a.txt"), str(tmp_path / "b.txt"), *options)
    assert code == 2
    assert said in text


def test_a_board_is_written_as_pdf_and_an_ambiguous_one_is_said_to_be_so(
    acus, tmp_path: Path
) -> None:
    path = tmp_path / "board.pdf"
    code, text = acus("print", "--board", "checkerboard:7x5:25mm", "--out", str(path))
    assert code == 0
    assert "half a turn" in text
    assert path.read_bytes().startswith(b"%PDF")
    document = json.loads(acus("print", "--out", str(path), "--json")[1])["facts"]
    assert document["pattern_mm"] == [180.0, 120.0]
    code, text = acus("print", "--board", "checkerboard:7x5:60mm", "--out", str(path))
    assert code == 2
    assert "does not fit on A4" in text
    assert acus("print", "--out", str(tmp_path / "b.png"))[0] == 2
