"""A child process runs this very program, whatever else is called `app`."""

import os
import subprocess
from pathlib import Path

import app
from app.core.child_process import environment, interpreter, module_command

APP = Path(app.__file__).parent

ELSEWHERE = {"studies/dicom_cases/comparison.py"}
"""Start a program that is none of Acus' own."""


def test_a_child_finds_this_program_and_no_other(tmp_path, monkeypatch):
    foreign = tmp_path / "app"
    foreign.mkdir()
    (foreign / "__init__.py").write_text("raise RuntimeError('another app')")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    line = [*interpreter("-W", "ignore"), "-c", "import app; print(app.__file__)"]
    done = subprocess.run(
        line, env=environment(), cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert Path(done.stdout.strip()) == APP / "__init__.py"


def test_a_childs_environment_is_its_parents_with_what_is_asked_for(monkeypatch):
    monkeypatch.setenv("PYTHONPATH", "/some/where")
    own = environment(OMP_NUM_THREADS="1")
    assert own["PYTHONPATH"] == f"{APP.parent}{os.pathsep}/some/where"
    assert own["OMP_NUM_THREADS"] == "1"
    assert {
        name: own[name] for name in os.environ if name not in ("PYTHONPATH", "OMP_NUM_THREADS")
    } == {
        name: value
        for name, value in os.environ.items()
        if name not in ("PYTHONPATH", "OMP_NUM_THREADS")
    }
    monkeypatch.delenv("PYTHONPATH")
    assert environment()["PYTHONPATH"] == str(APP.parent)


def test_a_module_is_run_without_the_working_directory():
    line = module_command("app", "exercise", "list", options=("-W", "ignore"))
    assert line[1:] == ["-P", "-W", "ignore", "-m", "app", "exercise", "list"]


def test_all_children_of_the_program_are_started_this_way():
    naming = {
        path.relative_to(APP).as_posix()
        for path in APP.rglob("*.py")
        if "sys.executable" in path.read_text(encoding="utf-8")
    }
    assert naming == {"core/child_process.py", *ELSEWHERE}
