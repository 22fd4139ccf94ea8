"""The commands of people, courses, results and the store, from the first student to a backup."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import typer

sys.path.append(str(Path(__file__).parents[1] / "session"))
from session_fakes import Bench

from app.__main__ import main
from app.commands import build, store
from app.commands.completion import courses, students
from app.commands.completion import sessions as completed_sessions
from app.core.paths import sessions
from app.exercises.library import load_exercise
from app.session.course import find_course, read_course
from app.session.people import People, tables


@pytest.fixture
def acus(monkeypatch, capsys):
    def run(*words, code=0):
        monkeypatch.setattr("sys.argv", ["acus", *map(str, words), "--json"])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert ended.value.code == code, err
        return json.loads(out)["facts"] if out else err

    def answer_nothing(*_, **__):
        raise typer.Abort

    monkeypatch.setattr("typer.prompt", answer_nothing)
    return run


def commands_of(noun):
    group = typer.main.get_command(build()).commands[noun]
    return {f"{noun} {name}" for name in group.commands}


def attempts(*students):
    sessions().mkdir(parents=True, exist_ok=True)
    bench = Bench(sessions())
    bench.run(0.1)
    for student in students:
        bench.trainer.begin(student)
        bench.insertion()
        bench.trainer.end()


@pytest.mark.long("journey")
def test_a_course_from_roster_to_gradebook(acus, tmp_path):
    (tmp_path / "r.csv").write_text("pseudonym,name,pin,group\nAda,Lovelace,1843,A\nBob,,,A\n")
    taken = acus("people", "roster", tmp_path / "r.csv")
    assert (taken["added"], list(taken["pins"])) == (["Ada", "Bob"], ["Bob"])
    attempts(People().find("Ada").key, People().find("Bob").key)
    assert "name" not in acus("people", "list")["students"][0]
    assert acus("people", "list", "--names")["students"][0]["name"] == "Lovelace"
    course = tmp_path / "c.yaml"
    course.write_text("id: c\ntitle: C\ngroups: [A]\nitems:\n- {exercise: liver-01}\n")
    refused = acus("course", "save", course, code=3)
    assert "no such exercise" in refused["problems"][0]
    assert refused["files"] == []
    assert acus("course", "list")["courses"] == []
    read_course(course).save()  # as one whose exercise was removed since
    assert acus("course", "list")["courses"][0]["id"] == "c"
    assert acus("course", "show", "c", code=3)["title"] == "C"
    cells = acus("results", "board", "--course", "c")["cells"]
    assert [(c["pseudonym"], c["attempts"]) for c in cells] == [("Ada", 1), ("Bob", 1)]
    points = acus("results", "curve", "Ada", "liver-01")["points"]
    assert points[0]["best"] == points[0]["total"] == cells[0]["best"]
    competent = acus("results", "curve", "Ada", "liver-01")["competence"]
    assert competent == cells[0]["competence"]
    assert (competent["state"], competent["attempts"]) == ("not yet", 1)
    assert competent["words"].startswith("not yet: at least ")
    for form in ("tidy", "wide", "moodle"):
        done = acus("results", "export", form, "--out", tmp_path / f"{form}.csv", "--course", "c")
        assert (done["attempts"], done["students"]) == (2, 2)
    assert (tmp_path / "moodle.csv").read_bytes().startswith(b"\xef\xbb\xbfusername,")
    acus("results", "export", "json", "--out", tmp_path / "all.json")
    for some in ((), ("--student", "Ada"), ("--names", "--course", "c")):
        acus("results", "export", "pdf", "--out", tmp_path / "r.pdf", *some)
        assert (tmp_path / "r.pdf").read_bytes().startswith(b"%PDF")
    assert "is for pdf" in acus(
        "results", "export", "json", "--out", "x", "--student", "Ada", code=2
    )
    gone = "--student", "Eve"
    assert "no student here" in acus("results", "export", "pdf", "--out", "x", *gone, code=2)
    assert len(json.loads((tmp_path / "all.json").read_text())["attempts"]) == 2
    assert "the forms are" in acus("results", "export", "xls", "--out", "x", code=2)


def test_wrong_rosters_end_with_code_3_and_take_nothing(acus, tmp_path):
    (tmp_path / "r.csv").write_bytes("pseudonym\nÉlève\n".encode("latin-1"))
    assert "not UTF-8" in acus("people", "roster", tmp_path / "r.csv", code=3)["errors"][0]
    (tmp_path / "r.csv").write_text("pseudonym\nAda\n../x\n")
    assert len(acus("people", "roster", tmp_path / "r.csv", code=3)["errors"]) == 1
    assert acus("people", "list")["students"] == []
    found = acus("people", "roster", tmp_path / "r.csv", "--partly", code=3)
    assert found["added"] == ["Ada"]
    assert "cannot read" in acus("people", "roster", tmp_path / "none.csv", code=2)


@pytest.mark.long("journey")
def test_what_changes_people_or_deletes_needs_the_instructor(acus, monkeypatch, tmp_path):
    attempts("s")
    name = next(sessions().glob("*.mcap")).stem
    People().set_instructor("correct horse")
    monkeypatch.setenv("ACUS_INSTRUCTOR_PASSWORD", "wrong")
    refused = [
        ("people", "add", "Ada"),
        ("session", "delete", name),
        ("store", "backup", "--out", tmp_path / "b"),
    ]
    for words in refused:
        assert "password is wrong" in acus(*words, code=2)
    assert "too many wrong tries" in acus("people", "add", "Ada", code=2)
    assert People().everybody() == []
    assert (sessions() / f"{name}.mcap").exists()


@pytest.mark.long("journey")
def test_the_instructor_deletes_restores_remarks_and_erases(acus, monkeypatch, tmp_path):
    added = acus("people", "add", "Ada", "--name", "Lovelace", "--pin", "1843")
    acus("people", "pin", "Ada", "7777")
    assert acus("people", "rename", "ada", "Ida")["before"] == "Ada"
    renamed = acus("people", "rename", "Ida", "Ada")
    assert renamed == {"pseudonym": "Ada", "before": "Ida", "key": added["key"]}
    attempts(added["key"], added["key"])
    People().set_instructor("correct horse")
    monkeypatch.setenv("ACUS_INSTRUCTOR_PASSWORD", "correct horse")
    first, second = sorted(path.stem for path in sessions().glob("*.mcap"))
    acus("session", "delete", first)
    assert acus("store", "status")["deleted"] == 1
    assert acus("store", "empty-trash")["deleted"] == []
    acus("session", "restore", first)
    said = acus("people", "remark", second, "--void", "camera fell", "--comment", "again")
    assert (said["void"], said["comment"], said["released"]) == ("camera fell", "again", False)
    assert acus("results", "board")["cells"][0]["attempts"] == 1
    status = acus("store", "status")
    assert status["signatures"] == {"verified": 2, "altered": 0, "unsigned": 0}
    assert acus("session", "verify", first)["signature"] == "verified"
    assert acus("store", "backup", "--out", tmp_path / "b")["records"] == 2
    assert acus("people", "erase", "Ada", "--records")["records"] == 2
    done = acus("store", "restore", tmp_path / "b")
    assert (done["records"], done["erased"], done["people"]) == (0, 2, "kept")


@pytest.mark.long("journey")
def test_a_backup_with_a_key_that_an_earlier_build_wrapped_says_so(acus, monkeypatch, tmp_path):
    people = People()
    people.set_instructor("correct horse")
    monkeypatch.setenv("ACUS_INSTRUCTOR_PASSWORD", "correct horse")
    assert acus("store", "backup", "--out", tmp_path / "b")["key"] is True
    settings = tables()["settings"]
    former = json.dumps({"station": "0" * 16, "salt": "00", "secret": "00", "tag": "00"})
    with people.database.write() as connection:
        change = settings.update().where(settings.c.name == "wrapped")
        connection.execute(change.values(value=former))
    assert acus("store", "backup", "--out", tmp_path / "c")["key"] is False
    said = store.backup(tmp_path / "d").lines[-1]
    assert "sealed by an earlier build" in said
    assert "`acus people instructor`" in said


@pytest.mark.long("journey")
def test_an_altered_record_is_told_by_verify_and_in_the_list(acus):
    attempts("s")
    path = next(sessions().glob("*.mcap"))
    signature = path.with_suffix(".sig")
    signature.write_text(signature.read_text().replace('"ended"', '"aborted"'))
    found = acus("session", "verify", path.stem, code=3)
    assert (found["confirmed"], found["signature"]) == (True, "altered")
    assert acus("session", "list")["sessions"][0]["signature"] == "altered"


@pytest.mark.long("journey")
@pytest.mark.parametrize("harm", ["cut", "altered"])
def test_a_record_that_was_harmed_is_listed_and_shown_without_points(
    acus, monkeypatch, capsys, harm
):
    attempts("s")
    path = next(sessions().glob("*.mcap"))
    whole = acus("session", "list")["sessions"][0]
    assert whole["score"]["total"] is not None
    data = path.read_bytes()
    if harm == "cut":
        path.write_bytes(data[: round(0.95 * len(data))])
    else:
        signature = path.with_suffix(".sig")
        signature.write_text(signature.read_text().replace('"passed": true', '"passed": false'))
    assert acus("session", "list")["sessions"][0]["score"] is None
    shown = acus("session", "show", path.stem)
    assert (shown["score"], shown["signature"]) == (None, "altered")
    for words in (["list"], ["show", path.stem]):
        monkeypatch.setattr("sys.argv", ["acus", "session", *words])
        with pytest.raises(SystemExit):
            main()
        out = capsys.readouterr().out
        assert "— altered" in out
        assert "100 %" not in out
        assert "passed" not in out
        assert out.count("altered after it was signed") == 1


@pytest.mark.long("journey")
def test_an_attempt_that_was_cut_off_is_listed_and_closed(acus):
    attempts("s")
    path = next(sessions().glob("*.mcap"))
    assert acus("session", "recover")["interrupted"] == []
    path.with_suffix(".sig").unlink()
    path.write_bytes(path.read_bytes()[:-60])
    os.utime(path, (1e9, 1e9))
    (found,) = acus("session", "recover")["interrupted"]
    assert found["id"] == path.stem
    assert acus("session", "recover", path.stem)["file"].endswith(path.name)
    assert acus("session", "recover")["interrupted"] == []


@pytest.mark.long("journey")
def test_results_that_a_course_holds_are_shown_to_the_instructor_alone(acus, monkeypatch, tmp_path):
    added = acus("people", "add", "Ada", "--pin", "1843")
    attempts(added["key"])
    name = next(sessions().glob("*.mcap")).stem
    version = acus("session", "list")["sessions"][0]["conditions"]["version"]
    course = tmp_path / "c.yaml"
    item = f"{{exercise: liver-01, version: {version}, purpose: assessment}}"
    course.write_text(f"id: c\ntitle: Exam\nitems:\n- {item}\n")
    read_course(course).save()  # of an exercise that was removed since
    People().set_instructor("correct horse")

    assert acus("session", "list")["hidden"] == 1
    assert "not answered" in acus("session", "show", name, code=2)
    monkeypatch.setenv("ACUS_INSTRUCTOR_PASSWORD", "wrong")
    assert "password is wrong" in acus("session", "show", name, code=2)
    monkeypatch.setenv("ACUS_INSTRUCTOR_PASSWORD", "correct horse")
    assert acus("session", "show", name)["score"]["total"] is not None
    assert acus("session", "list")["sessions"][0]["score"]["total"] is not None
    assert acus("results", "board", "--course", "c")["cells"][0]["attempts"] == 1


OPEN_TO_ALL = {
    *("exercise list", "exercise suggest", "exercise validate", "exercise schema"),
    *("session list", "session recover", "store status", "store rebuild", "session gather"),
    *("research verify", "research power", "course plans"),
}
"""Of these nouns, what needs no instructor: `session list` lists what is nobody's, `session gather`
moves records from a folder that its own account owns and shows none, `research verify` reads a file
that names nobody, `research power` reads nothing and `course plans` lists what ships."""


@pytest.mark.long("journey")
@pytest.mark.promise("docs/people.md: The window and the command line ask the same answer")
def test_what_the_window_closes_is_closed_on_the_command_line(acus, tmp_path):
    key = acus("people", "add", "Ada", "--pin", "1843")["key"]
    attempts(key, key)
    first, second = sorted(path.stem for path in sessions().glob("*.mcap"))
    (tmp_path / "c.yaml").write_text("id: c\ntitle: C\nitems: []\n")
    acus("course", "save", tmp_path / "c.yaml")
    People().set_instructor("correct horse")
    out = tmp_path / "out"
    doors = [
        ("session", "show", first),
        ("session", "replay", first),
        ("session", "verify", first),
        ("session", "compare", first, second),
        ("session", "export", "--out", f"{out}.csv"),
        ("session", "export", first, "--trajectory", "--out", f"{out}.csv"),
        ("session", "delete", first),
        ("session", "restore", first),
        ("results", "board"),
        ("results", "curve", "Ada", "liver-01"),
        ("results", "reliability"),
        ("results", "export", "tidy", "--out", out),
        ("results", "xapi", "--home", "https://x.example", "--out", out),
        ("results", "lrs", "https://lrs.example/xAPI", "--home", "https://x.example"),
        ("results", "send"),
        ("exercise", "new", "Mine", "--out", out),
        ("exercise", "pack", "first-insertion", "--out", out),
        ("exercise", "unpack", out),
        ("exercise", "trial", "first-insertion", "--seeds", "1"),
        ("exercise", "bands", "first-insertion", "--experienced", "A"),
        ("exercise", "mark", "first-insertion", "--experienced", "A"),
        ("research", "new", "--out", out),
        ("research", "check", out),
        ("research", "begin", out),
        ("research", "enrol", "s", "Ada", "--consent-by", "A", "--consent-version", "1"),
        ("research", "answer", "s", "sus", "--from", out),
        ("research", "leave", "s", "Ada"),
        ("research", "status"),
        ("research", "lock", "s", "--by", "A"),
        ("research", "bundle", "s", "--out", out),
        ("people", "list"),
        ("people", "remark", first, "--release"),
        ("course", "list"),
        ("course", "show", "c"),
        ("course", "save", tmp_path / "c.yaml"),
        ("course", "begin", "lung-biopsy-in-six-units", "--on", "2026-11-30"),
        ("store", "backup", "--out", out),
        ("store", "restore", out),
        ("store", "empty-trash"),
        ("store", "stations", "--name", "B"),
        ("store", "revoke", "B"),
        ("store", "renew"),
        ("store", "results", "--out", out),
        ("store", "station", "--out", out),
        ("store", "gather", out),
        ("store", "connect", "sqlite:///out.sqlite"),
        ("store", "sync"),
        ("store", "audit"),
        ("store", "check"),
    ]
    for words in doors:
        assert "a question was not answered" in acus(*words, code=2), words
    assert [path.name for path in tmp_path.iterdir() if "out" in path.name] == []
    assert students("A") == courses("c") == []
    found = acus("session", "list")
    assert (found["sessions"], found["hidden"]) == ([], 2)
    closed = {" ".join(words[:2]) for words in doors}
    for noun in ("session", "results", "exercise", "course", "store", "research"):
        assert commands_of(noun) - OPEN_TO_ALL <= closed, noun


@pytest.mark.long("journey")
@pytest.mark.promise(
    "docs/people.md: it shows records by key, without pseudonyms and names, verifies none, "
    "and counts none as a student's"
)
def test_another_data_folder_opens_records_by_key_without_names_and_verifies_none(
    acus, monkeypatch, tmp_path
):
    key = acus("people", "add", "Ada", "--name", "Lovelace", "--pin", "1843")["key"]
    attempts(key)
    here = sessions()
    People().set_instructor("correct horse")
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "another"))
    (found,) = acus("session", "list", "--folder", here)["sessions"]
    assert (found["student"], found["signature"]) == (key, "unsigned")
    assert acus("results", "board", "--folder", here)["cells"] == []
    assert "Ada" not in json.dumps(acus("people", "list"))


@pytest.mark.long("journey")
def test_a_course_without_versions_pins_the_newest_ones(acus, tmp_path):
    course = tmp_path / "c.yaml"
    course.write_text(
        "id: c\ntitle: C\nitems:\n- {exercise: first-insertion}\n"
        "- {exercise: thick-tissue, version: 1}\n"
    )
    newest = load_exercise("first-insertion").version
    assert newest > 1
    saved = acus("course", "save", course, code=3)  # the other is pinned to one of long ago
    assert len(saved["files"]) == 1
    assert "pins version 1" in saved["problems"][0]
    items = acus("course", "show", "c", code=3)["items"]
    assert [item["version"] for item in items] == [newest, 1]
    assert [item.version for item in find_course("c").items] == [newest, 1]


@pytest.mark.long("journey")
def test_an_id_that_fits_none_or_several_names_none_to_who_may_not_see_them(acus):
    key = acus("people", "add", "Ada", "--pin", "1843")["key"]
    attempts(key, key)
    People().set_instructor("correct horse")
    for typed in ("x", "", "2"):
        said = acus("session", "show", typed, code=2)
        assert "acus session list" in said
        assert not any(path.stem in said for path in sessions().glob("*.mcap"))
    assert completed_sessions("") == []


@pytest.mark.long("journey")
def test_a_question_for_a_password_without_a_terminal_is_a_question_and_no_warning():
    People().set_instructor("correct horse")
    command = [sys.executable, "-m", "app", "people", "list", "--json"]
    options = {"capture_output": True, "text": True, "start_new_session": True}
    done = subprocess.run(command, input="correct horse\n", check=False, **options)
    assert (done.returncode, done.stderr.strip()) == (0, "Instructor's password:")
    assert json.loads(done.stdout)["facts"]["students"] == []
    assert done.stdout.startswith("{")
    done = subprocess.run(command, stdin=subprocess.DEVNULL, check=False, **options)
    assert done.returncode == 2
    assert "getpass" not in done.stderr.lower()
    assert "Warning" not in done.stderr


def test_one_student_is_one_student(acus, monkeypatch, capsys, tmp_path):
    (tmp_path / "r.csv").write_text("pseudonym,pin\nAda,1843\n")
    monkeypatch.setattr("sys.argv", ["acus", "people", "roster", str(tmp_path / "r.csv")])
    with pytest.raises(SystemExit):
        main()
    assert "1 student added, 0 updated" in capsys.readouterr().out


@pytest.mark.long("journey")
@pytest.mark.parametrize("harm", ["cut", "altered"])
def test_a_signed_record_that_was_harmed_is_not_said_to_be_whole(acus, harm):
    attempts("s")
    path = next(sessions().glob("*.mcap"))
    data = path.read_bytes()
    middle = len(data) // 2
    harmed = data[:middle] if harm == "cut" else data[:middle] + b"?" + data[middle + 1 :]
    path.write_bytes(harmed)
    os.utime(path, (1e9, 1e9))
    said = acus("session", "recover", path.stem, code=2)
    assert "altered after it was signed" in said
    assert "acus store restore" in said
    assert path.read_bytes() == harmed


@pytest.mark.long("journey")
def test_an_intact_record_is_said_to_need_no_recovery(acus, monkeypatch, capsys):
    attempts("Ada")
    (path,) = sessions().glob("*.mcap")
    before = path.read_bytes()
    monkeypatch.setattr("sys.argv", ["acus", "session", "recover", path.stem])
    with pytest.raises(SystemExit):
        main()
    assert "nothing to recover" in capsys.readouterr().out
    assert path.read_bytes() == before


@pytest.mark.long("journey")
def test_a_data_folder_that_can_only_be_read_shows_people_and_board_to_the_instructor(
    acus, monkeypatch, capsys
):
    acus("people", "add", "Ada")
    attempts(People().find("Ada").key)
    People().set_instructor("correct horse")
    monkeypatch.setenv("ACUS_INSTRUCTOR_PASSWORD", "correct horse")
    monkeypatch.setattr("app.session.database.os.access", lambda *_: False)
    for words in (("people", "list"), ("results", "board"), ("session", "list")):
        monkeypatch.setattr("sys.argv", ["acus", *words])
        with pytest.raises(SystemExit) as ended:
            main()
        out, said = capsys.readouterr()
        assert ended.value.code == 0, said
        assert ("Ada" in out) == (words != ("session", "list")), out
        assert "\n" not in said.strip()
        assert "wrong tries are not kept" in said


@pytest.mark.long("journey")
def test_a_course_begins_by_a_plan_on_a_day(acus):
    (plan,) = acus("course", "plans")["plans"]
    assert len(plan["units"]) == 6
    begun = acus("course", "begin", plan["id"], "--on", "2026-12-07", "--group", "A")
    assert begun["problems"] == []
    course = find_course(f"{plan['id']}-2026-12")
    assert course.groups == ("A",)
    assert all(item.version >= 1 for item in course.items)
    assert "no day" in acus("course", "begin", plan["id"], "--on", "soon", code=2)
    again = acus("course", "begin", plan["id"], "--on", "2026-12-08", code=2)
    assert "is there already" in again
    assert "no plan of a course" in acus("course", "begin", "heart", "--on", "2026-12-07", code=2)
