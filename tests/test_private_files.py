"""What other accounts of the computer can read of what the program writes: nothing."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from app.core import paths

ROOT = Path(__file__).resolve().parents[1]
WRITE = """
import app.__main__ as program
from app.core import paths
from app.core.files import write_atomically
paths.keep_private()
write_atomically(paths.settings() / "a" / "settings.yaml", b"x")
(paths.sessions() / "day").mkdir(parents=True)
(paths.sessions() / "day" / "record.mcap").write_bytes(b"x")
"""


@pytest.mark.promise("docs/people.md: another account of the computer")
def test_what_the_program_writes_is_for_its_account_alone():
    os.umask(0o022)
    subprocess.run([sys.executable, "-c", WRITE], cwd=ROOT, check=True)
    written = [path for root in (paths.settings(), paths.sessions()) for path in root.rglob("*")]
    assert len(written) == 4
    assert all(path.stat().st_mode & 0o077 == 0 for path in written)


def test_folders_of_earlier_versions_are_closed_and_chosen_ones_are_left(tmp_path, monkeypatch):
    monkeypatch.setattr(paths, "_of_user", lambda kind: str(tmp_path / kind))
    monkeypatch.delenv("ACUS_DATA")
    for folder in (paths.data(), paths.settings()):
        folder.mkdir(parents=True, mode=0o755)
    before = os.umask(0o022)
    paths.keep_private()
    os.umask(before)
    assert paths.data().stat().st_mode & 0o777 == 0o700
    assert paths.settings().stat().st_mode & 0o777 == 0o755  # by ACUS_SETTINGS
