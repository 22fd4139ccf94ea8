"""The program where the modules are absent that only Unix has, as on Windows."""

import os
import subprocess
import sys
from pathlib import Path

import pydicom
import pytest
from marked_ct import Acus, leaks, marked, needles, readable

ROOT = Path(__file__).resolve().parents[1]
ABSENT = ("fcntl", "resource", "pty", "tty", "termios")

EVERY_PROCESS = """
import logging, sys
for name in {absent!r}:
    sys.modules[name] = None
logging.basicConfig(filename={log!r}, level=logging.DEBUG)
logging.getLogger("numba").setLevel(logging.WARNING)  # it would write every step of compiling
logging.captureWarnings(True)
logging.getLogger(__name__).info("the log is open")
"""


@pytest.fixture(scope="module")
def ct(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A CT that names its patient wherever it can."""
    return marked(tmp_path_factory.mktemp("outside"))


@pytest.fixture(scope="module")
def demonstration(
    ct: Path, tmp_path_factory: pytest.TempPathFactory
) -> tuple[subprocess.CompletedProcess[str], Path]:
    """A whole headless demonstration on it, and the folder of all it wrote, the log among it."""
    site, inside = tmp_path_factory.mktemp("site"), tmp_path_factory.mktemp("inside")
    text = EVERY_PROCESS.format(absent=ABSENT, log=str(inside / "window.log"))
    (site / "sitecustomize.py").write_text(text)
    said = subprocess.run(
        [sys.executable, "-m", "app", "demo", "--headless", "--ct", str(ct), "--out",
         str(inside / "out")],
        cwd=inside, env=Acus(inside).environment | {"PYTHONPATH": f"{site}{os.pathsep}{ROOT}"},
        capture_output=True, text=True, timeout=590, check=False,
    )  # fmt: skip
    return said, inside


@pytest.mark.long("journey")
@pytest.mark.timeout(600)
def test_a_whole_headless_demonstration_runs_without_the_modules_that_only_unix_has(demonstration):
    said, inside = demonstration
    # 3: beside the other tests this computer can be too busy, and the attempt is void
    assert said.returncode in (0, 3), said.stdout[-2000:] + said.stderr[-2000:]
    assert "passed" in said.stdout
    assert list((inside / "out").rglob("*.pdf"))


@pytest.mark.long("journey")
@pytest.mark.timeout(600)
def test_no_identifier_reaches_the_log_the_record_or_the_report_of_an_attempt_in_the_window(
    ct, demonstration
):
    said, inside = demonstration
    words = needles(pydicom.dcmread(next(ct.iterdir())))
    written = [path for path in inside.rglob("*") if path.is_file()]
    assert {path.suffix for path in written} >= {".mcap", ".pdf", ".png", ".log"}
    assert b"the log is open" in (inside / "window.log").read_bytes()
    for path in written:
        if path.name != "window.ini":  # recent folders that the user opened: docs/privacy.md
            assert leaks(str(path).encode() + readable(path), words) == [], path
    assert leaks((said.stdout + said.stderr).encode(), words) == []
