"""The program where the modules are absent that only Unix has, as on Windows."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
ABSENT = ("fcntl", "resource", "pty", "tty", "termios")


@pytest.mark.timeout(600)
def test_a_whole_headless_demonstration_runs_without_the_modules_that_only_unix_has(tmp_path):
    block = "\n".join(f"sys.modules[{name!r}] = None" for name in ABSENT)
    (tmp_path / "sitecustomize.py").write_text(f"import sys\n{block}\n")  # in every process
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join((str(tmp_path), str(ROOT))),
        "QT_QPA_PLATFORM": "offscreen",
    }
    said = subprocess.run(
        [sys.executable, "-m", "app", "demo", "--headless", "--out", str(tmp_path / "out")],
        cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=590,
    )  # fmt: skip
    assert said.returncode == 0, said.stdout[-2000:] + said.stderr[-2000:]
    assert "passed" in said.stdout
    assert list((tmp_path / "out").rglob("*.pdf"))
