"""Files of others that cannot be used are named with file, line and reason, whatever their kind."""

import json
import sys

import pytest
from typer.testing import CliRunner

from app.commands import build
from app.compose.plugins import plugin_files, refused_files
from app.core import plugin_folders

KINDS = {
    "laws": "force law",
    "effects": "effect",
    "metrics": "metric",
    "extractors": "marker extractor",
    "remedies": "CT remedy",
    "needle_sources": "needle source",
    "studies": "study",
}
BROKEN = {
    "another_key": ("\nDECLARATION = {'nonsense': 1}\n", "line 2"),
    "half_a_line": ("\n\nDECLARATION = {\n", "line 3"),
}


@pytest.fixture
def folders(monkeypatch, tmp_path):
    for folder in KINDS:
        (tmp_path / folder).mkdir()
        monkeypatch.setenv(f"ACUS_{folder.upper()}", str(tmp_path / folder))
    return tmp_path


@pytest.fixture
def feature(monkeypatch, tmp_path):
    """File of a feature in a folder of plug-ins."""
    folder = tmp_path / "acus_other"
    (folder / "features").mkdir(parents=True)
    (folder / "__init__.py").touch()
    monkeypatch.setenv("ACUS_PLUGINS", str(folder))
    monkeypatch.setattr(sys, "path", [*sys.path])
    plugin_folders.folders.cache_clear()
    yield folder / "features" / "lamp.py"
    plugin_folders.folders.cache_clear()


@pytest.mark.parametrize("folder", KINDS)
@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_file_of_any_kind_is_named_with_its_line_and_the_reason(folders, folder, name):
    text, line = BROKEN[name]
    path = folders / folder / f"{name}.py"
    path.write_text(text)
    (found,) = refused_files()
    assert (found.kind, found.path, found.name) == (KINDS[folder], path, name)
    assert str(path) in found.refused or path.name in found.refused
    assert line in found.refused


def test_a_file_that_has_the_name_of_another_is_refused(folders):
    path = folders / "metrics" / "target_error.py"
    path.write_text("x = 1\n")
    (found,) = refused_files()
    assert found.path == path
    assert "is a name of the program's own; rename the file" in found.refused


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (
            "DECLARATION = {'title': 'Lamp', 'after': 'lantern'}\nFEATURE = 1\n",
            "'lantern'; valid are",
        ),
        ("DECLARATION = {'title': 'Lamp'}\nFEATURE = 1\n", "after is None; valid are"),
        ("DECLARATION = {'title': 'Lamp', 'after': 'plan'}\n", "must define FEATURE"),
        ("DECLARATION = {'title': 'Lamp', 'after': 'position'}\nFEATURE = 1\n", ""),
    ],
)
def test_a_feature_that_the_window_would_leave_out_is_named(feature, text, reason):
    feature.write_text(text)
    (listed,) = plugin_files()
    assert listed.path == feature
    assert reason in listed.refused
    assert bool(listed.refused) == bool(reason)


def test_the_list_ends_with_code_3_where_a_file_is_refused_and_with_0_where_none_is(folders):
    assert CliRunner().invoke(build(), ["plugin", "list"]).exit_code == 0
    assert plugin_files() == ()
    empty = CliRunner().invoke(build(), ["plugin", "list"]).stdout
    assert all(f"{KINDS[folder]}: {folders / folder}" in empty for folder in KINDS)
    (folders / "effects" / "mine.py").write_text("DECLARATION = {'nonsense': 1}\n")
    answer = CliRunner().invoke(build(), ["plugin", "list", "--json"])
    assert answer.exit_code == 3
    assert "mine.py, line 1" in json.dumps(json.loads(answer.stdout))


@pytest.mark.long("journey")
def test_the_explanation_of_an_exercise_names_them_too(folders):
    (folders / "effects" / "mine.py").write_text("DECLARATION = {'nonsense': 1}\n")
    said = CliRunner().invoke(build(), ["explain", "first-insertion"]).stdout
    assert "refused effect" in said
    assert "mine.py, line 1" in said
