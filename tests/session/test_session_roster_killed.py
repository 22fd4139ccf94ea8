"""A roster whose program is killed at any step leaves no names behind in files of another name."""

import os
import signal
from itertools import count
from pathlib import Path

import pytest

from app.core.files import watched
from app.session import journal
from app.session.people import NAMES_FILE, People
from app.session.roster import RosterLine

NAMES = {"Dora": "Dirac", "Ada": "Lovelace of another roster"}


def take(folder: Path, kill_at: int = -1) -> int:
    """Take the roster, in this process; the steps that it took are counted."""
    numbers = count()

    def watch(what: str, path: Path) -> None:
        if next(numbers) == kill_at:
            os.kill(os.getpid(), signal.SIGKILL)

    with watched(watch):
        People(folder).take_roster([RosterLine(key, name, "1933") for key, name in NAMES.items()])
    return next(numbers)


def begun(folder: Path) -> Path:
    people = People(folder)
    people.add(RosterLine("Ada", "Lovelace", "1843"))
    people.database.close()
    return folder


def holding(folder: Path, name: str) -> list[str]:
    """Files that hold a name, whatever they are called."""
    return sorted(
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and name.encode() in path.read_bytes()
    )


@pytest.mark.long("journey")
@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_roster_that_is_killed_at_any_step_leaves_no_names(tmp_path, monkeypatch):
    steps = take(begun(tmp_path / "counted"))
    assert steps >= 5
    left = []
    for at in range(steps):
        folder = begun(tmp_path / str(at))
        if (pid := os.fork()) == 0:
            take(folder, at)
            os._exit(1)
        assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == -signal.SIGKILL
        left += holding(folder, "Dirac")
        monkeypatch.setattr(journal, "_swept", set())
        people = People(folder)  # the next start
        there = {person.pseudonym: person.name for person in people.everybody(names=True)}
        assert there in ({"Ada": "Lovelace"}, NAMES), at
        assert holding(folder, "Dirac") == ([NAMES_FILE] if there == NAMES else []), at
        assert holding(folder, "another roster") == holding(folder, "Dirac"), at
        assert [path.name for path in folder.iterdir() if path.name.startswith(".")] == [], at
        people.database.close()
    assert any(name != NAMES_FILE for name in left)  # some kills did leave a part, until then
