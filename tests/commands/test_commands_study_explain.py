"""`acus study` and `acus explain`."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from app.commands import build
from app.core.errors import AcusError

RUN = CliRunner()


def test_studies_are_listed() -> None:
    done = RUN.invoke(build(), ["study", "list", "--json"])
    assert done.exit_code == 0
    assert {row["name"] for row in json.loads(done.stdout)["facts"]["studies"]} >= {
        "lateral_tissue",
        "slice_interpolation",
    }


@pytest.mark.long("journey")
def test_a_study_prints_json_and_writes_table_and_picture(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    arguments = ["study", "lateral_tissue", "--json", "--repeats", "1", "--out", str(tmp_path)]
    done = RUN.invoke(build(), arguments)
    assert done.exit_code == 0
    assert json.loads(done.stdout)["facts"]["study"] == "lateral_tissue"
    assert {path.suffix for path in tmp_path.iterdir()} == {".csv", ".json", ".png", ".svg"}


def test_an_unknown_study_or_exercise_is_refused_with_the_known_names() -> None:
    for arguments in (["study", "nothing"], ["explain", "nothing"]):
        with pytest.raises(AcusError, match="there are"):
            RUN.invoke(build(), arguments, catch_exceptions=False)


def test_explain_says_what_is_simulated_why_and_at_what_cost() -> None:
    done = RUN.invoke(build(), ["explain", "first-insertion", "--json"])
    assert done.exit_code == 0
    document = json.loads(done.stdout)["facts"]
    cost = {row["effect"]: (row["cost_ns"], row["picture_ns"]) for row in document["simulated"]}
    assert set(cost) == {"lateral_tissue", "shaft_friction", "camera_tone", "camera_jpeg"}
    assert all(sum(one or 0.0 for one in both) > 0.0 for both in cost.values())
    assert all(row["why"] for row in document["simulated"])
    assert document["dropped"][0]["effect"] == "breathing"
    (law,) = document["laws"]
    assert law["law"] == "fixture"
    assert law["energy"] == "potential"
    assert 0.0 < law["energy_bound_j"] < 5.0
    assert 0.0 < law["cost_ns"] < 1e6


def test_explain_for_the_real_robot_drops_what_it_cannot_render() -> None:
    done = RUN.invoke(build(), ["explain", "first-insertion", "--real"])
    assert done.exit_code == 0
    assert "shaft_friction\n    dropped: it gives the force along the needle" in done.stdout


@pytest.mark.long("journey")
def test_explain_does_not_compile_the_loop_that_it_does_not_run() -> None:
    code = (
        "import sys; from app.exercises.library import load_exercise as load\n"
        "from app.commands.explain import explain; explain('scans-only')\n"
        "print(sorted(n for n in sys.modules if n.startswith('app.device.control.')))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    imported = done.stdout.splitlines()[-1]
    assert "app.device.control.kernel" in imported
    for heavy in ("loop", "governor", "passivity", "safety", "velocity"):
        assert f"'app.device.control.{heavy}" not in imported, heavy


@pytest.mark.long("journey")
def test_no_figure_of_a_table_is_cut_where_no_terminal_limits_it() -> None:
    done = RUN.invoke(build(), ["study", "stereo", "--repeats", "1"])
    assert done.exit_code == 0
    assert max(map(len, done.stdout.splitlines())) > 80
    assert "…" not in done.stdout


def test_explain_says_what_is_touched_and_how_the_hand_moves_the_tip():
    from app.commands.explain import _lines
    from app.compose.explaining import explanation
    from app.exercises.library import load_exercise

    found = explanation(load_exercise("laparoscopic-tool")) | {"refused": []}
    assert len(found["touch"]["targets_lps_mm"]) == 6
    for depth, scale in zip(found["touch"]["depths_mm"], found["touch"]["scales"], strict=True):
        assert scale == pytest.approx(-depth / (300.0 - depth))
    said = "\n".join(_lines(found))
    assert "touches 6 targets" in said
    assert "the other way" in said
    assert explanation(load_exercise("first-insertion"))["touch"] is None
