"""What runs the tests once more where one of their processes died."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[1] / "tools" / "twice-if-killed"
DIED = "worker 'gw1' crashed while running 'tests/test_a.py::test_b'"


def run(tmp_path: Path, *outcomes: tuple[str, int]) -> tuple[int, str, int]:
    """Exit code, output and number of runs of tests that end so, one after another."""
    for number, (text, code) in enumerate(outcomes, 1):
        (tmp_path / f"text-{number}").write_text(text + "\n")
        (tmp_path / f"code-{number}").write_text(str(code))
    tests = tmp_path / "tests.sh"
    tests.write_text(
        "cd " + str(tmp_path) + "\n"
        "echo run >> runs; n=$(wc -l < runs)\ncat text-$n\nexit $(cat code-$n)\n"
    )
    done = subprocess.run(
        [str(SCRIPT), "bash", str(tests)], capture_output=True, text=True, check=False, timeout=60
    )
    return done.returncode, done.stdout, len((tmp_path / "runs").read_text().split())


@pytest.mark.parametrize(
    ("outcomes", "code", "runs"),
    [
        ([("3 passed", 0)], 0, 1),
        ([("1 failed, 2 passed", 1)], 1, 1),
        ([(DIED, 1), ("3 passed", 0)], 0, 2),
        ([(DIED, 1), (DIED, 1)], 1, 2),
        ([(DIED, 1), ("1 failed", 1)], 1, 2),
    ],
    ids=["passes", "fails", "dies once", "dies twice", "dies, then fails"],
)
def test_only_a_death_lets_the_tests_run_once_more(tmp_path, outcomes, code, runs):
    assert run(tmp_path, *outcomes)[0::2] == (code, runs)


DEADLY = """
import os
import pathlib
import pytest

@pytest.mark.parametrize("number", range(4))
def test_it(number):
    with open("runs.txt", "a") as runs:
        runs.write(str(number))
    if number == 2 and not pathlib.Path("died").exists():
        pathlib.Path("died").touch()
        os._exit(3)
"""


@pytest.mark.long("journey")
def test_what_passed_before_a_death_is_not_run_again(tmp_path):
    (tmp_path / "test_deadly.py").write_text(DEADLY)
    hooks = (Path(__file__).parent / "conftest.py").read_text()
    wanted = ("pytest_collection_modifyitems", "pytest_runtest_logreport")
    kept = re.findall(rf"^def (?:{'|'.join(wanted)})\(.*?(?=^\S)", hooks, re.DOTALL | re.MULTILINE)
    assert len(kept) == len(wanted)
    head = "import os\nfrom pathlib import Path\nimport pytest\nROOT, FIRST = Path(), ()\n\n"
    (tmp_path / "conftest.py").write_text(head + "\n\n".join(kept))
    done = subprocess.run(
        [str(SCRIPT), sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
        + ["--numprocesses", "1", "--max-worker-restart", "0"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=240,
    )
    assert done.returncode == 0, done.stdout
    assert (tmp_path / "runs.txt").read_text() == "01223"


def test_a_death_is_named_at_the_end(tmp_path):
    _, output, _ = run(tmp_path, (DIED, 1), ("3 passed", 0))
    assert output.splitlines()[-1] == f"Died in the first run: {DIED}"


IN_TIME = """
import os
import time

def test_a():
    assert 0.0 < float(os.environ["ACUS_TESTS_UNTIL"]) - time.time() <= 600.0

def test_b():
    os.environ["ACUS_TESTS_UNTIL"] = str(time.time())
"""
"""The time of the run is over with the second test of the first file."""


@pytest.mark.long("journey")
def test_a_run_that_may_take_so_long_ends_then_and_begins_with_another_file_each_time(tmp_path):
    hooks = (Path(__file__).parent / "conftest.py").read_text()
    wanted = ("pytest_configure", "pytest_collection_modifyitems", "pytest_runtest_setup")
    parts = [
        re.search(rf"^(?:@[^\n]*\n)?def {name}\(.*?(?=^\S)", hooks, re.DOTALL | re.MULTILINE)[0]
        for name in wanted
    ]
    head = "import os\nimport socket\nimport time\nfrom pathlib import Path\nimport pytest\n"
    (tmp_path / "conftest.py").write_text(
        f"{head}ROOT, FIRST = Path(), ()\n\n" + "\n\n".join(parts)
    )
    for name in "xyz":
        (tmp_path / f"test_{name}.py").write_text(IN_TIME)
    for turn, first in (("0", "x"), ("4", "y"), ("16777215", "x")):
        limits = {"ACUS_TESTS_SECONDS": "600", "ACUS_TESTS_TURN": turn}
        done = subprocess.run(
            [sys.executable, "-m", "pytest", "-v", "-p", "no:cacheprovider", "-p", "no:randomly"]
            + ["--numprocesses", "1", "--dist", "loadfile", "--no-loadscope-reorder"],
            cwd=tmp_path,
            env=os.environ | limits,
            capture_output=True,
            text=True,
            check=False,
            timeout=240,
        )
        assert done.returncode == 0, done.stdout
        passed = re.findall(r"PASSED test_(\w)\.py::(\w+)", done.stdout)
        assert passed == [(first, "test_a"), (first, "test_b")], done.stdout
        assert "2 passed, 4 skipped" in done.stdout
