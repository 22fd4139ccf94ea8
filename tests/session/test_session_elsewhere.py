"""Attempts are kept in the user's own folder; what lies in the source tree is offered."""

import os
import shutil
import signal
import subprocess
import sys
from itertools import count
from pathlib import Path

import pytest
from session_fakes import Bench

from app.__main__ import main
from app.core import paths
from app.core.files import watched
from app.session.elsewhere import elsewhere, gather
from app.session.people import People
from app.session.roster import RosterLine
from app.session.signature import signature_file
from app.session.store import list_sessions, records, settled, verdict_of
from tests.kills.works import _ended_by

ROOT = Path(paths.__file__).parents[2]


def attempts(folder: Path, count: int, student: str = "S1") -> None:
    bench = Bench(folder)
    bench.run(0.1)
    for _ in range(count):
        bench.trainer.begin(student)
        bench.run(0.5, 0.06)
        bench.trainer.end()


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The source tree's folder, with two attempts of this station and one of another."""
    folder = tmp_path / "tree" / "sessions"
    attempts(folder, 2)
    foreign = folder / "20200101-000000-ffff.mcap"
    shutil.copy(min(folder.glob("*.mcap")), foreign)
    monkeypatch.setattr(paths, "tree_sessions", lambda: folder)
    monkeypatch.delenv("ACUS_SESSIONS")
    return folder


def run(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> int:
    monkeypatch.setattr("sys.argv", ["acus", "session", *arguments])
    with pytest.raises(SystemExit) as stop:
        main()
    return int(stop.value.code or 0)


# --- where they are kept ----------------------------------------------------------------------
def printed(home: Path, *words: str, **more: str) -> str:
    """What a program of somebody with this home folder prints."""
    home.mkdir(exist_ok=True)
    left_out = ("ACUS_SESSIONS", "ACUS_DATA", "ACUS_SETTINGS", "XDG_DATA_HOME", "XDG_CONFIG_HOME")
    kept = {key: value for key, value in os.environ.items() if key not in left_out}
    done = subprocess.run(
        words, cwd=ROOT, env=kept | {"HOME": str(home)} | more, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.long("journey")
def test_each_user_of_a_source_tree_has_a_folder_of_his_own(tmp_path: Path) -> None:
    for name in ("ada", "bob"):
        home = tmp_path / name
        said = printed(home, sys.executable, "-m", "app", "session", "list")
        assert said.strip() == f"no sessions in {home / '.local/share/acus/sessions'}"
    chosen = tmp_path / "chosen"
    said = printed(
        tmp_path / "ada", sys.executable, "-m", "app", "session", "list", ACUS_SESSIONS=str(chosen)
    )
    assert said.strip() == f"no sessions in {chosen}"


def test_make_run_alone_names_the_trees_folder_unless_another_was_chosen(tmp_path: Path) -> None:
    program, new = tmp_path / "bin" / "acus", tmp_path / "installed"
    program.parent.mkdir()
    program.write_text('#!/bin/sh\necho "$1: $ACUS_SESSIONS"\n')
    program.chmod(0o755)
    new.touch()  # nothing is to be installed

    def made(target: str, **more: str) -> str:
        make = ("make", "--silent", target, f"BIN={program.parent}", f"TRAINER={new}")
        return printed(tmp_path, *make, **more).strip()

    assert made("run") == f"run: {ROOT / 'sessions'}"
    assert made("run", ACUS_SESSIONS="/elsewhere") == "run: /elsewhere"
    assert made("demo") == "demo:"


def test_a_start_says_where_attempts_are_kept_and_which_lie_in_the_tree(
    tree: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from app.commands.session import tell_folder

    tell_folder()
    said = capsys.readouterr()
    assert said.out == f"attempts are kept in {paths.own_sessions()}\n"
    assert f"3 attempts lie in {tree}" in said.err
    assert "acus session gather" in said.err
    assert run(monkeypatch, "list") == 0
    assert f"3 attempts lie in {tree}" in capsys.readouterr().err
    monkeypatch.setenv("ACUS_SESSIONS", str(tree))
    tell_folder()
    said = capsys.readouterr()
    assert said.out == f"attempts are kept in {tree}\n"
    assert said.err == ""


# --- what lies in the tree --------------------------------------------------------------------
def test_what_this_station_signed_comes_whole_and_what_others_did_stays(
    tree: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    own = [path.name for path in records(tree) if "ffff" not in path.name]
    assert run(monkeypatch, "gather") == 0
    said = capsys.readouterr().out
    assert f"2 attempts brought from {tree}" in said
    assert "1 stays there" in said
    folder = paths.sessions()
    assert [path.name for path in records(folder)] == own
    assert all(verdict_of(path) == "verified" for path in records(folder))
    left = {path.stem for path in tree.iterdir() if path.suffix in (".mcap", ".sig", ".json")}
    assert left == {"20200101-000000-ffff"}, "nothing of what came is left there"
    assert run(monkeypatch, "gather") == 0
    assert "0 attempts brought" in capsys.readouterr().out
    found = elsewhere(folder)
    assert found is not None
    assert len(found.records) == 1


@pytest.mark.long("journey")
def test_killed_at_any_step_nothing_is_lost_and_the_next_look_finishes_or_undoes_it(
    tree: Path, tmp_path: Path
) -> None:
    kept, ends = tmp_path / "as it was", list[int]()
    shutil.copytree(tree, kept)
    names = {path.name for path in records(tree) if "ffff" not in path.name}
    folder = paths.sessions()

    def program() -> None:
        found, steps = elsewhere(folder), count()
        assert found is not None

        def watch(what: str, path: Path) -> None:
            if next(steps) == len(ends):
                os.kill(os.getpid(), signal.SIGKILL)

        with watched(watch):
            gather(found, folder, People())

    while not ends or ends[-1]:
        for place in (folder, tree):
            shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(kept, tree)
        ends.append(_ended_by(program))
        settled(folder)
        here = {path.name for path in records(folder)}
        there = {path.name for path in records(tree)}
        assert names <= here | there
        assert not here & there
        assert all(verdict_of(path) == "verified" for path in records(folder))
        assert not [path for path in folder.glob(".*") if path.name != ".trash"]
    assert set(ends[:-1]) == {-signal.SIGKILL}
    assert len(ends) > 10
    assert here == names


def test_a_tree_that_may_only_be_read_keeps_what_it_has(
    tree: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = records(tree)
    monkeypatch.setattr("app.session.elsewhere.os.access", lambda *_: False)
    found = elsewhere(paths.sessions())
    assert found is not None
    assert gather(found, paths.sessions(), People()) == 2
    assert records(tree) == before
    assert len(list_sessions(paths.sessions())) == 2


def test_attempts_of_a_person_who_was_erased_do_not_come(
    tree: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    people = People()
    ada, _ = people.add(RosterLine("Ada"))
    attempts(paths.sessions(), 1, ada.key)
    (record,) = records(paths.sessions())
    for path in (record, signature_file(record)):
        shutil.copy(path, tree / path.name.replace("0001", "0009"))
    record.rename(tree / record.name.replace("0001", "0009"))
    found = elsewhere(paths.sessions())
    assert found is not None
    monkeypatch.setattr(
        People, "erased_attempts", lambda _: frozenset(path.stem for path in records(tree))
    )
    assert gather(found, paths.sessions(), people) == 0


def test_a_folder_that_was_chosen_asks_nothing_and_an_installed_program_neither(
    tree: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert elsewhere(tmp_path / "chosen") is None
    assert elsewhere(tree) is None
    assert elsewhere(paths.own_sessions()) is not None
    monkeypatch.setattr(paths, "tree_sessions", lambda: None)
    assert elsewhere(paths.own_sessions()) is None
