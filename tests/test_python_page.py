"""The page 'Acus from Python' is one notebook: its blocks are run in their order."""

import re
from pathlib import Path
from shutil import copy

import pytest

from tests.machine_records import FOLDER

PAGE = Path(__file__).resolve().parents[1] / "docs" / "python.md"


def blocks() -> list[str]:
    """The page's blocks of code, each with its place in front, so that errors name lines of it."""
    text = PAGE.read_text(encoding="utf-8")
    return [
        "\n" * text[: found.start(1)].count("\n") + found[1]
        for found in re.finditer(r"^```python\n(.*?)^```", text, flags=re.DOTALL | re.MULTILINE)
    ]


@pytest.mark.long("journey")
def test_the_pages_blocks_run_in_their_order(tmp_path, monkeypatch):
    pytest.importorskip("matplotlib", reason="the extra `plots` is not installed")
    records = tmp_path / "sessions"
    records.mkdir()
    for path in FOLDER.glob("*.mcap"):
        copy(path, records)
    monkeypatch.setenv("ACUS_SESSIONS", str(records))
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for block in blocks():
        exec(compile(block, str(PAGE), "exec"), names)
    assert (tmp_path / "attempt.png").stat().st_size > 5000
    assert (tmp_path / "oblique.png").stat().st_size > 5000


def test_the_page_shows_every_function_of_the_package():
    import acus

    text = PAGE.read_text(encoding="utf-8")
    functions = {name for name in acus.__all__ if name.islower() and name[0] != "_"}
    assert functions - set(re.findall(r"(?:`|acus\.)(\w+)", text)) == set()


def test_the_page_is_short():
    assert len(PAGE.read_text(encoding="utf-8").split()) <= 700
