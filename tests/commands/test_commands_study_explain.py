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


@pytest.mark.long("journey")
def test_explain_says_what_is_simulated_why_and_at_what_cost() -> None:
    done = RUN.invoke(build(), ["explain", "first-insertion", "--json"])
    assert done.exit_code == 0
    document = json.loads(done.stdout)["facts"]
    cost = {row["effect"]: (row["cost_ns"], row["picture_ns"]) for row in document["simulated"]}
    along = {"shaft_friction", "puncture", "cutting", "relaxation", "bone_contact"}
    whole = {"lateral_tissue", "tissue_field", "bone_slide", "camera_tone", "camera_jpeg", *along}
    assert set(cost) == whole
    assert all(sum(one or 0.0 for one in both) > 0.0 for both in cost.values())
    assert all(row["why"] for row in document["simulated"])
    calls = {row["effect"]: row for row in document["called_for"]}
    assert calls["puncture"]["simulated"]
    assert calls["breathing"]["without"].startswith("the patient holds the breath")
    assert document["add"] == {}
    (law,) = document["laws"]
    assert law["law"] == "fixture"
    assert law["energy"] == "potential"
    assert 0.0 < law["energy_bound_j"] < 5.0
    assert 0.0 < law["cost_ns"] < 1e6


@pytest.mark.long("journey")
def test_explain_for_the_real_robot_drops_what_it_cannot_render() -> None:
    done = RUN.invoke(build(), ["explain", "first-insertion", "--real"])
    assert done.exit_code == 0
    assert "shaft_friction\n    dropped: it gives the force along the needle" in done.stdout


@pytest.mark.long("journey")
def test_what_is_absent_is_suggested_with_its_cost_and_refused_where_it_has_no_reason(
    tmp_path: Path,
) -> None:
    file = tmp_path / "old.yaml"
    file.write_text(
        "id: old\ntitle: Old\nct: {phantom: {seed: 2}}\n"
        "target_organ: liver\neffects: [lateral_tissue, shaft_friction]\n",
        encoding="utf-8",
    )
    done = RUN.invoke(build(), ["exercise", "validate", "--physics", str(file)])
    assert done.exit_code == 3
    assert "bone_contact is called for and absent: no needle goes through rib" in done.stdout
    assert RUN.invoke(build(), ["exercise", "validate", str(file)]).exit_code == 0

    done = RUN.invoke(build(), ["explain", str(file), "--json"])
    absent = {row["effect"]: row for row in json.loads(done.stdout)["facts"]["called_for"]}
    assert absent["bone_contact"]["absent"]
    assert 0.0 < absent["bone_contact"]["cost_ns"] < 1e5

    done = RUN.invoke(build(), ["exercise", "suggest", str(file)])
    assert done.exit_code == 0
    lines = [line for line in done.stdout.splitlines() if not line.startswith(("#", "effects:"))]
    text = file.read_text(encoding="utf-8").replace("[lateral_tissue, shaft_friction]", "")
    file.write_text(
        "\n".join([text.rstrip(), "  lateral_tissue:", "  shaft_friction:", *lines[1:], lines[0]]),
        encoding="utf-8",
    )
    assert RUN.invoke(build(), ["exercise", "validate", "--physics", str(file)]).exit_code == 0

    with file.open("a", encoding="utf-8") as added:
        added.write('\nwithout: {bevel: "the tip goes straight"}\n')
    done = RUN.invoke(build(), ["exercise", "validate", "--physics", str(file)])
    assert done.exit_code == 3
    assert "bevel is not called for" in done.stdout


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


@pytest.mark.long("journey")
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
