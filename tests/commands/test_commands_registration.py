"""`acus registration check | list` and `acus plate list`."""

import json
from pathlib import Path

import numpy as np
import pytest

from app.__main__ import main
from app.planning.registration.plate import load_plate


def run(monkeypatch: pytest.MonkeyPatch, *arguments: str, noun: str = "registration") -> int:
    monkeypatch.setattr("sys.argv", ["acus", noun, *arguments])
    try:
        main()
    except SystemExit as stop:
        return int(stop.code or 0)
    return 0


def points(folder: Path, shift: dict[str, float], names: str = "ABCDEF") -> Path:
    """Touches of the plate in its place, with 0.1 mm of error; some shifted along x [mm]."""
    plate = load_plate("stepped-plate")
    assert plate.place is not None
    rng = np.random.default_rng(8)
    rows = ["name,x_mm,y_mm,z_mm"]
    for name, point in zip(names, plate.place.transform @ plate.touch * 1e3, strict=True):
        x, y, z = point + 0.1 * rng.standard_normal(3) + [shift.get(name, 0.0), 0.0, 0.0]
        rows.append(f"{name},{x},{y},{z}")
    path = folder / "touched.csv"
    path.write_text("\n".join(rows))
    return path


def test_good_touches_say_how_well_screen_and_needle_agree(tmp_path, monkeypatch, capsys):
    path = points(tmp_path, {})
    assert run(monkeypatch, "check", "--touched", str(path), "--json") == 0
    document = json.loads(capsys.readouterr().out)["facts"]
    assert document["trusted"] is True
    assert 0.2 < document["agreement_95_mm"] < 1.5
    assert document["tre_rms_mm"] < document["tre_95_mm"]
    assert document["touched"]["fre_mm"] < 0.3
    assert run(monkeypatch, "check", "--touched", str(path)) == 0
    text = capsys.readouterr().out
    assert "screen and needle agree within ± " in text
    assert "FRE says how well the points fit each other" in text


def test_a_wrong_touch_ends_with_code_3_and_names_it(tmp_path, monkeypatch, capsys):
    path = points(tmp_path, {"D": 7.0})
    assert run(monkeypatch, "check", "--touched", str(path), "--json") == 3
    document = json.loads(capsys.readouterr().out)["facts"]
    assert document["agreement_95_mm"] is None
    assert "fiducial D lies" in document["troubles"][0]


def test_exchanged_names_end_with_code_3(tmp_path, monkeypatch, capsys):
    path = points(tmp_path, {}, "ABCDFE")
    assert run(monkeypatch, "check", "--touched", str(path)) == 3
    assert "fiducials F and E were touched in another order" in capsys.readouterr().out


@pytest.mark.parametrize("target", ["1,2", "a,b,c", "1,2,nan"])
def test_a_bad_target_is_named(tmp_path, monkeypatch, capsys, target):
    assert (
        run(monkeypatch, "check", "--touched", str(points(tmp_path, {})), "--target", target) == 2
    )
    assert "three numbers" in capsys.readouterr().err


def test_plates_are_listed(monkeypatch, capsys):
    assert run(monkeypatch, "list", "--json", noun="plate") == 0
    assert json.loads(capsys.readouterr().out)["facts"]["plates"][0]["name"] == "stepped-plate"


def test_no_saved_checks_is_said(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    assert run(monkeypatch, "list") == 0
    assert "no registration checks" in capsys.readouterr().out
