"""Folders of plug-ins: found by being there; what lies in them is found, imported and compiled."""

import importlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

from app.core import compiled, plugin_folders
from app.core.plugin_folders import APP, PluginFolder

ROOT = Path(__file__).resolve().parents[2]


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def program(tmp_path, monkeypatch):
    """Make a program of which two folders are rooms and one is a folder of plug-ins."""
    write(tmp_path / "app" / "core" / "__init__.py", '"""A room."""\n')
    write(tmp_path / "app" / "views" / "__init__.py", '"""A room with a DECLARATION in words."""\n')
    write(tmp_path / "app" / "claw" / "__init__.py", '"""It."""\n\nDECLARATION = {"title": "It"}\n')
    monkeypatch.setattr(plugin_folders, "APP", tmp_path / "app")
    plugin_folders.folders.cache_clear()
    yield tmp_path / "app"
    plugin_folders.folders.cache_clear()


@pytest.fixture
def foreign(tmp_path, monkeypatch):
    """Append a folder of somebody else's, a package of its own, to the search path."""
    folder = tmp_path / "somebody_s_claw"
    write(folder / "__init__.py", "")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))  # of the process that tries its files
    found = (*plugin_folders.folders(), PluginFolder(folder, "somebody_s_claw"))
    monkeypatch.setattr(plugin_folders, "folders", lambda: found)
    importlib.invalidate_caches()
    yield folder
    plugin_folders.refused.clear()
    for name in [one for one in sys.modules if one.split(".")[0] == "somebody_s_claw"]:
        del sys.modules[name]


def test_a_folder_of_the_program_that_declares_itself_is_one_of_plugins(program):
    (found,) = plugin_folders.folders()
    assert (found.path, found.package, found.is_own) == (program / "claw", "app.claw", True)


def test_its_files_are_listed_by_kind_and_named_by_their_package(program):
    path = write(program / "claw" / "studies" / "grip.py", "")
    write(program / "claw" / "studies" / "_part.py", "")
    write(program / "claw" / "studies" / "tables" / "grip.json", "")
    (found,) = plugin_folders.folders()
    assert plugin_folders.files("studies") == [path]
    assert plugin_folders.files("studies", "other") == plugin_folders.files("laws") == []
    assert found.module_name(path) == "app.claw.studies.grip"
    assert plugin_folders.folder_of(path) == found
    assert plugin_folders.folder_of(program / "core" / "x.py") is None


def test_nothing_outside_a_folder_of_plugins_names_it():
    for folder in plugin_folders.folders():
        naming = [
            str(path.relative_to(APP))
            for path in sorted(APP.rglob("*.py"))
            if not path.is_relative_to(folder.path)
            and any(
                name in path.read_text(encoding="utf-8")
                for name in (
                    folder.package,
                    f"app/{folder.path.name}/",
                    f"import {folder.path.name}\n",
                )
            )
        ]
        assert naming == []


def test_a_study_of_somebody_elses_folder_is_found_and_imported_as_its_package_has_it(foreign):
    from app.studies import runner

    write(foreign / "studies" / "__init__.py", "")
    text = 'DECLARATION = {"title": "T", "question": "Q?", "reference": "R"}\nVALUE = 3\n'
    path = write(foreign / "studies" / "claw_grip.py", text)
    assert "claw_grip" in runner.study_names()
    assert not runner.KIND.is_own(path)
    module = runner.KIND.load(runner.declaration("claw_grip"))
    assert (module.__name__, module.VALUE) == ("somebody_s_claw.studies.claw_grip", 3)


def test_a_study_cannot_take_the_name_of_one_in_a_folder_of_the_programs_own(foreign):
    from app.studies import runner

    own = next(f for folder in plugin_folders.folders() for f in folder.files("studies"))
    path = write(foreign / "studies" / own.name, own.read_text(encoding="utf-8"))
    assert runner.KIND.is_own(own)
    assert "is a name of the program's own; rename the file" in runner.KIND.refused()[path]
    assert runner.declaration(own.stem).path == own


def test_a_machine_of_a_folder_is_one_of_the_kinds_and_imported_as_its_package_has_it(foreign):
    from app.mechanisms.profile import device

    write(foreign / "machines" / "__init__.py", "")
    write(foreign / "machines" / "claw" / "__init__.py", "")
    write(foreign / "machines" / "claw" / "profile.py", "class PROFILE:\n    pass\n")
    write(foreign / "machines" / "claw" / "machine.py", "def machine(profile):\n    return None\n")
    assert "claw" in device.kinds()
    assert device.profile_class("claw", "x").__module__ == "somebody_s_claw.machines.claw.profile"


def test_an_exercise_of_a_folder_is_in_the_library(foreign):
    from app.core import paths
    from app.exercises.library import library

    text = (paths.resources() / "exercises" / "first-insertion.yaml").read_text(encoding="utf-8")
    path = write(
        foreign / "exercises" / "claw.yaml", text.replace("id: first-insertion", "id: claw")
    )
    assert library().files["claw"] == path


@pytest.mark.long("journey")
def test_a_feature_of_a_folder_stands_behind_the_one_that_it_names(foreign):
    from app.views.shell import feature_plugins
    from app.views.shell.features import FEATURES

    write(foreign / "features" / "__init__.py", "")
    text = (
        "from app.views.shell.feature import Feature\n\n"
        'DECLARATION = {"title": "Claw", "after": "people", "help": "claw.md"}\n\n\n'
        "class ClawFeature(Feature):\n    pass\n\n\nFEATURE = ClawFeature\n"
    )
    path = write(foreign / "features" / "claw.py", text)
    base = tuple(one for one in FEATURES if one.__module__.startswith("app.views."))
    found = feature_plugins.with_plugins(base)
    names = [one.__name__ for one in found]
    assert names.index("ClawFeature") == names.index("PeopleFeature") + 1
    assert set(FEATURES) < set(found)
    assert feature_plugins.page_of_plugin("somebody_s_claw.features.claw") == "claw.md"
    assert feature_plugins.page_of_plugin("app.views.plan.feature") == ""
    path.write_text(text.replace("people", "nowhere"), encoding="utf-8")
    assert feature_plugins.with_plugins(base) == FEATURES
    assert "after is 'nowhere'; valid are series, " in plugin_folders.refused[path]


def test_a_command_of_a_folder_is_added_to_the_command_line(foreign):
    from app.commands import build

    write(foreign / "commands" / "__init__.py", "")
    text = "def register(root):\n    root.command('claw')(lambda: None)\n"
    write(foreign / "commands" / "claw.py", text)
    assert "claw" in [command.name for command in build().registered_commands]


ENDS = {
    "exits": ("raise SystemExit(5)", "SystemExit: 5"),
    "a base": ("raise GeneratorExit", "GeneratorExit"),
    "half": ("root.command('half')(lambda: None); 1 / 0", "ZeroDivisionError: division by zero"),
    "no type": (
        "root.command('odd')(lambda x: None)\n    root.command('y')(odd)",
        "AssertionError",
    ),
}


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", ENDS)
def test_a_command_of_a_folder_that_ends_the_program_is_refused_and_adds_nothing(foreign, name):
    from typer.testing import CliRunner

    from app.commands import build

    body, reason = ENDS[name]
    write(foreign / "commands" / "__init__.py", "")
    text = f"def odd(x: int | str): ...\n\n\ndef register(root):\n    {body}\n"
    path = write(foreign / "commands" / "claw.py", text)
    root = build()
    said = plugin_folders.refused[path]
    assert said.startswith(f"{path}: register() does not work: {reason}")
    names = {command.name for command in root.registered_commands}
    assert names.isdisjoint({"half", "odd", "y"})
    assert CliRunner().invoke(root, ["--help"]).exit_code == 0


@pytest.mark.long("journey")
@pytest.mark.parametrize("error", ["SystemExit", "KeyboardInterrupt", "GeneratorExit"])
def test_a_file_whose_import_ends_the_program_is_refused(foreign, error):
    from app.commands import build

    write(foreign / "commands" / "__init__.py", "")
    path = write(foreign / "commands" / "claw.py", f"raise {error}\n")
    build()
    assert error in plugin_folders.refused[path]


@pytest.fixture
def listed(tmp_path, monkeypatch):
    """List folders in ACUS_PLUGINS, each of which has an `__init__.py`; return what is found."""

    def listing(*names, missing=()):
        folders = [tmp_path / name for name in names]
        for folder in folders:
            if folder.name not in missing:
                write(folder / "__init__.py", "")
        monkeypatch.setenv("ACUS_PLUGINS", os.pathsep.join(map(str, folders)))
        monkeypatch.setattr(sys, "path", [*sys.path])
        importlib.invalidate_caches()
        plugin_folders.folders.cache_clear()
        return [folder.path for folder in plugin_folders.folders() if not folder.is_own]

    yield listing
    monkeypatch.undo()
    plugin_folders.folders.cache_clear()
    plugin_folders.refused.clear()


def test_two_folders_of_one_list_are_both_found_in_its_order(listed, tmp_path):
    names = ("zeta/second_claw", "alpha/first_claw")
    assert listed(*names) == [tmp_path / name for name in names]
    assert not plugin_folders.refused


def test_a_folder_of_the_list_that_is_missing_is_named_and_the_other_is_found(listed, tmp_path):
    seen = listed("gone_claw", "there_claw", missing=("gone_claw",))
    assert seen == [tmp_path / "there_claw"]
    gone = tmp_path / "gone_claw"
    assert plugin_folders.refused == {gone: f"{gone}: there is no such folder"}


def test_a_folder_of_the_list_that_cannot_be_read_is_named_and_the_other_is_found(
    listed, tmp_path, monkeypatch
):
    shut, is_file = tmp_path / "shut_claw", Path.is_file

    def refuses(path):  # as for who is not root
        if path.is_relative_to(shut):
            raise PermissionError(13, "Permission denied", str(path))
        return is_file(path)

    write(shut / "__init__.py", "")
    monkeypatch.setattr(Path, "is_file", refuses)
    assert listed("shut_claw", "open_claw") == [tmp_path / "open_claw"]
    assert plugin_folders.refused == {shut: f"{shut} cannot be read: Permission denied"}


def test_of_two_folders_of_one_name_the_first_is_found_and_the_second_is_named(listed, tmp_path):
    seen = listed("zeta/twin_claw", "alpha/twin_claw")
    first, second = tmp_path / "zeta" / "twin_claw", tmp_path / "alpha" / "twin_claw"
    assert seen == [first]
    assert list(plugin_folders.refused) == [second]
    assert (
        f"'twin_claw' is no package that can be imported: {first} has that name"
        in (plugin_folders.refused[second])
    )


def test_an_edit_in_a_machine_of_a_folder_of_the_programs_own_changes_the_digest(program):
    text = "from app.core.compiled import njit\n\nLENGTH = 1.0\n"
    kernels = write(program / "claw" / "machines" / "claw" / "kernels.py", text)
    before = compiled.kernels_digest()
    kernels.write_text(text.replace("1.0", "2.0"), encoding="utf-8")
    assert compiled.kernels_digest() != before


def test_an_edit_in_somebody_elses_machine_changes_the_digest_of_its_own_kernels_alone(foreign):
    text = "from app.core.compiled import njit\n\nLENGTH = 1.0\n"
    kernels = write(foreign / "machines" / "claw" / "kernels.py", text)
    before, programs = compiled.plugin_digest(kernels), compiled.kernels_digest()
    kernels.write_text(text.replace("1.0", "2.0"), encoding="utf-8")
    assert compiled.plugin_digest(kernels) != before
    assert compiled.kernels_digest() == programs
    assert compiled.plugin_digest(Path(compiled.__file__)) == ""


INNER = "from app.core.compiled import njit\n\n\n@njit\ndef inner(x):\n    return {} * x\n"
OUTER = """from app.core.compiled import njit
from app.mechanisms.claw.inner import inner


@njit
def outer(x):
    return inner(x)
"""
RUN = """
import os
from app import mechanisms
mechanisms.__path__.append(os.environ["ACUS_MECHANISMS"])
from app.mechanisms.claw.outer import outer
print(outer(1.0))
"""


@pytest.mark.long("journey")
def test_an_edit_in_a_machine_of_the_users_own_is_never_run_from_a_stale_build(tmp_path):
    folder = tmp_path / "mechanisms" / "claw"
    environment = os.environ | {
        "ACUS_MECHANISMS": str(folder.parent),
        "ACUS_CACHE": str(tmp_path / "cache"),
        "PYTHONPATH": str(ROOT),
    }
    environment.pop("NUMBA_CACHE_DIR", None)
    write(folder / "__init__.py", "")
    write(folder / "outer.py", OUTER)
    said = []
    for factor in (1.0, 2.0):
        write(folder / "inner.py", INNER.format(factor))
        done = subprocess.run(
            [sys.executable, "-c", RUN],
            env=environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )
        assert done.returncode == 0, done.stderr
        said.append(done.stdout.strip())
    assert said == ["1.0", "2.0"]
