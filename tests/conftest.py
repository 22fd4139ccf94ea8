"""What every test may rely on: no display, own user folders, the shared data or a reason."""

import os
import sys
from pathlib import Path

import pytest

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

ROOT = Path(__file__).resolve().parents[1]

# A kernel of a test's rig is cached under the name by which its module was imported first;
# whichever tests run, and in which order, that name must be found again.
sys.path.extend(str(folder) for folder in sorted((ROOT / "tests").iterdir()) if folder.is_dir())


@pytest.fixture(autouse=True)
def own_user_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Settings and recordings of a test stay in the test's folder; caches are shared."""
    monkeypatch.setenv("ACUS_SETTINGS", str(tmp_path / "settings"))
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("ACUS_SESSIONS", str(tmp_path / "sessions"))


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Folder of real CT and stereo data (`ACUS_TEST_DATA`)."""
    folder = Path(os.environ.get("ACUS_TEST_DATA", ROOT.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"real data not found in {folder}: set ACUS_TEST_DATA")
    return folder
