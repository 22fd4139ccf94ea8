"""Results that leave by the command line: gradebook, statements, report, and what is refused."""

import json
import sys
from datetime import UTC, datetime, timedelta
from pathlib import Path
from types import MappingProxyType

import pytest

sys.path.append(str(Path(__file__).parents[1] / "exchange"))
from lrs_server import ScriptedLrs, answer

from app.__main__ import main
from app.core.paths import sessions
from app.scoring.conditions import Conditions
from app.session.course import Course, CourseItem
from app.session.people import People, people_folder
from app.session.sidecar import file_digest, write_summary
from app.session.signature import signature_file, signed
from app.session.station import StationKey
from app.session.summary import Summary

HOME = "https://training.hospital.example"


@pytest.fixture
def acus(monkeypatch, capsys):
    def run(*words, code=0):
        monkeypatch.setattr(sys, "argv", ["acus", *map(str, words), "--json"])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert ended.value.code == code, err
        return json.loads(out)["facts"] if out else err

    return run


def record(name, student, total, day):
    """A record that its sidecar says all of."""
    folder, key = sessions(), StationKey.of()  # what it has seen it seals
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.mcap"
    path.write_bytes(b"not opened: the sidecar is enough")
    score = {"total": total, "passed": total >= 60.0, "void_reason": "", "rows": []}
    started = (datetime(2026, 10, 1, 9, tzinfo=UTC) + timedelta(days=day)).isoformat()
    under = Conditions("first-insertion", 1)
    summary = Summary(name, started, student, "first-insertion", state="ended", duration=61.5,
                      score=MappingProxyType(score), conditions=under)  # fmt: skip
    write_summary(path, summary)
    signature_file(path).write_text(signed(path, file_digest(path), summary, {}, key))


@pytest.fixture
def group(acus, tmp_path):
    """Two students out of Moodle's participants, with six attempts each, in a course."""
    (tmp_path / "participants.csv").write_text(
        "First name,Last name,Username,Email address,Groups\n"
        "Łukasz,Żak,lzak,lzak@x.example,A\nZoë,Ångström,zoe,zoe@x.example,A\n"
    )
    taken = acus("people", "roster", tmp_path / "participants.csv")
    assert (taken["added"], taken["errors"]) == (["lzak", "zoe"], [])
    item = CourseItem(exercise="first-insertion", version=1)
    Course(id="autumn", title="Autumn course", items=(item,)).save()
    for number in range(6):
        for name in ("lzak", "zoe"):
            total = 50.0 + 8.0 * (number % 2) + (10.0 if name == "zoe" else 0.0)
            record(f"{name}-{number}", People().find(name).key, total, number)


@pytest.mark.long("journey")
def test_a_gradebook_by_address_and_mean_says_how_sure_it_is(acus, group, tmp_path):
    out = tmp_path / "grades.csv"
    words = ("results", "export", "moodle", "--out", out, "--course", "autumn")
    done = acus(*words, "--identifier", "email", "--grade", "mean:2", "--feedback")
    assert out.read_text(encoding="utf-8-sig").splitlines()[1:] == [
        "lzak@x.example,54,mean of the last 2 attempts; not passed yet",
        "zoe@x.example,64,mean of the last 2 attempts; passed",
    ]
    assert "uncertain by 4.0 points" in done["chance"]  # 8/√2 from one to the next, of two
    best = acus(*words)
    assert "who tries more often is graded higher" in best["chance"]
    assert "10 pairs of attempts" in best["chance"]


@pytest.mark.long("journey")
def test_what_moodle_could_not_tell_apart_is_refused_and_nothing_is_written(acus, group, tmp_path):
    out = tmp_path / "grades.csv"
    words = ("results", "export", "moodle", "--out", out)
    assert "no idnumber is known of lzak, zoe" in acus(*words, "--identifier", "idnumber", code=2)
    assert "by username, email or idnumber" in acus(*words, "--identifier", "name", code=2)
    assert "take best, first, last, or mean:3" in acus(*words, "--grade", "worst", code=2)
    (tmp_path / "r.csv").write_text("pseudonym,email\nzoe,LZAK@x.example\n")
    acus("people", "roster", tmp_path / "r.csv")
    refused = acus(*words, "--identifier", "email", code=2)
    assert "lzak, zoe have the same email" in refused
    assert len(refused.strip().splitlines()) == 1
    assert not out.exists()
    tidy = ("results", "export", "tidy", "--out", out)
    assert "are for moodle" in acus(*tidy, "--feedback", code=2)
    assert not out.exists()


@pytest.mark.long("journey")
def test_statements_are_written_twice_alike_and_queued_once(acus, group, tmp_path):
    words = ("results", "xapi", "--home", HOME, "--course", "autumn")
    done = acus(*words, "--out", tmp_path / "a.json", "--queue")
    assert (done["statements"], done["new"], done["waiting"]) == (12, 12, 12)
    again = acus(*words, "--out", tmp_path / "b.jsonl", "--queue")
    assert (again["new"], again["waiting"]) == (0, 12)
    array = json.loads((tmp_path / "a.json").read_text())
    lines = (tmp_path / "b.jsonl").read_text().splitlines()
    assert [json.loads(line) for line in lines] == array
    assert {one["actor"]["account"]["name"] for one in array} == {"lzak", "zoe"}
    assert array[0]["result"]["duration"] == "PT61.50S"
    acus("people", "remark", "lzak-0", "--void", "the phone rang")
    assert acus(*words, "--queue")["waiting"] == 11
    acus("people", "erase", "zoe", "--records")
    assert acus(*words, "--queue")["waiting"] == 5
    assert "own, such as" in acus("results", "xapi", "--home", "x", "--queue", code=2)
    assert "nothing to do" in acus(*words, code=2)


@pytest.mark.long("journey")
def test_statements_reach_a_record_store_whose_password_is_shown_nowhere(
    acus, group, capsys, monkeypatch
):
    monkeypatch.setenv("ACUS_LRS_PASSWORD", "correct horse")
    assert "tells no record store" in acus("results", "send", code=2)
    with ScriptedLrs(answer(401)) as server:
        words = ("results", "lrs", server.url, "--home", HOME, "--user", "acus")
        assert "give --home" in acus(*words[:3], code=2)
        assert "give name and password again" in acus(*words, code=2)
        assert acus("results", "lrs")["lrs"] is None
        assert acus(*words) == {"lrs": server.url, "home": HOME, "user": "acus", "waiting": 0}
        told = acus("results", "send")
        assert told["new"] == told["sent"] == len(server.held) == 12
        assert (told["waiting"], told["refused"]) == (0, [])
        for path in (people_folder() / "statements").iterdir():
            path.unlink()
        server.held.clear()
        server.script += [answer(400, b"no")] * 30
        monkeypatch.setattr(sys, "argv", ["acus", "results", "send"])
        with pytest.raises(SystemExit) as ended:
            main()
        assert ended.value.code == 3
        shown = capsys.readouterr()
        assert "0 statements sent; 12 wait" in shown.out
        assert "correct horse" not in shown.out + shown.err
        assert acus("results", "lrs")["waiting"] == 12
        assert acus("results", "lrs", "--forget")["lrs"] is None
    assert not (people_folder() / "lrs.json").exists()


@pytest.mark.long("journey")
def test_a_report_takes_a_rule_and_a_place(acus, group, tmp_path):
    words = ("results", "export", "pdf", "--out", tmp_path / "r.pdf", "--course", "autumn")
    done = acus(*words, "--grade", "last", "--place", "Basel", "--names")
    assert (tmp_path / "r.pdf").read_bytes().startswith(b"%PDF")
    assert "does not rise" in done["chance"]
