"""`acus research`: from the design to students in arms, one line for each thing that cannot be."""

import json
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime, timedelta

import pytest

from app.__main__ import main
from app.core import paths
from app.exercises.library import load_exercise
from app.research import find_study
from app.research.ledger import LEDGER
from app.session.course import find_course
from app.session.people import People
from app.session.roster import RosterLine

NAME = "assistance-study"
CONSENT = ("--consent-by", "AB", "--consent-version", "1", "--stratum", "experience=none")


@pytest.fixture
def acus(monkeypatch, capsys):
    def run(*words, code=0):
        monkeypatch.setattr("sys.argv", ["acus", *map(str, words), "--json"])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert ended.value.code == code, err
        return json.loads(out)["facts"] if out else err

    return run


@pytest.fixture
def begun(acus, tmp_path):
    path = tmp_path / "design.yaml"
    acus("research", "new", "--out", path)
    acus("research", "begin", path, "--seed", "3")
    People().take_roster([RosterLine(name, f"Name {name}", "1843") for name in ("Ada", "Bob")])
    return path


def refused(acus, *words):
    said = acus(*words, code=2)
    assert len(said.strip().splitlines()) == 1
    return said


@pytest.mark.long("journey")
def test_the_example_design_can_begin(acus, tmp_path):
    path = tmp_path / "design.yaml"
    acus("research", "new", "--out", path)
    found = acus("research", "check", path)
    assert (found["arms"], found["problems"]) == (["guided", "unguided"], [])
    assert found["lists"] == ["experience=none", "experience=some"]
    assert "is there already" in refused(acus, "research", "new", "--out", path)


@pytest.mark.long("journey")
def test_each_arm_gets_its_exercise_and_a_course_that_tells_no_arm(begun):
    for number, assistance in (("1", 0.7), ("2", 0.0)):
        course = find_course(f"{NAME}-{number}")
        (item,) = course.items
        assert load_exercise(item.exercise).assistance == assistance
        assert "guided" not in course.title + course.id


@pytest.mark.long("journey")
def test_the_exercise_of_an_arm_stays_what_it_was_when_the_study_began(begun):
    study = find_study(NAME)
    before = study.exercise("guided")
    path = paths.data() / "exercises" / f"{NAME}-1.yaml"
    path.write_text(path.read_text().replace("assistance: 0.7", "assistance: 0.2"))
    assert load_exercise(before.id).assistance == 0.2
    assert find_study(NAME).exercise("guided").assistance == before.assistance == 0.7


@pytest.mark.long("journey")
def test_an_enrolled_student_takes_the_course_of_the_arm_and_no_other(acus, begun):
    one = acus("research", "enrol", NAME, "Ada", *CONSENT)
    assert People().find("Ada").groups == (one["course"],)
    assert one["consent"]["by"] == "AB"
    assert one["consent"]["version"] == "1"
    assert find_course(one["course"]).takes(People().find("Ada"))
    assert "enrolled already" in refused(acus, "research", "enrol", NAME, "ada", *CONSENT)


@pytest.mark.long("journey")
def test_a_ledger_holds_no_pseudonym_name_or_key(acus, begun):
    acus("research", "enrol", NAME, "Ada", *CONSENT)
    key = People().find("Ada").key
    folder = paths.data() / "research" / NAME
    data = b"".join(path.read_bytes() for path in folder.iterdir())
    for secret in ("Ada", "Name Ada", key):
        assert secret.encode() not in data


@pytest.mark.long("journey")
def test_arms_are_hidden_until_the_data_are_locked(acus, begun):
    acus("research", "enrol", NAME, "Ada", *CONSENT)
    (before,) = acus("research", "status")["studies"]
    assert (before["blind"], before["arms"], before["enrolled"]) == (True, [], 1)
    acus("research", "lock", NAME, "--by", "CD")
    (after,) = acus("research", "status", NAME)["studies"]
    assert sum(arm["enrolled"] for arm in after["arms"]) == 1
    assert "were locked" in refused(acus, "research", "enrol", NAME, "Bob", *CONSENT)
    assert "were locked" in refused(acus, "research", "lock", NAME, "--by", "CD")


@pytest.mark.long("journey")
def test_the_next_visit_of_each_student_is_shown_with_its_window(acus, begun):
    acus("research", "enrol", NAME, "Ada", *CONSENT)
    (visit,) = acus("research", "status", NAME)["studies"][0]["due"]
    today = datetime.now(UTC).date().isoformat()
    assert (visit["pseudonym"], visit["visit"], visit["closes"]) == ("Ada", "pre", today)
    acus("research", "leave", NAME, "Ada", "--reason", "moved away")
    assert acus("research", "status", NAME)["studies"][0]["due"] == []


WRONG = {
    "version 2; the study": ("Ada", "--consent-by", "A", "--consent-version", "2"),
    "one of none, some": ("Ada", "--consent-by", "A", "--consent-version", "1"),
    "is no stratum": ("Ada", *CONSENT, "--stratum", "year=1"),
    "give NAME=VALUE": ("Ada", *CONSENT, "--stratum", "year"),
    "who took the consent": (
        *("Ada", "--consent-by", " ", "--consent-version", "1"),
        *("--stratum", "experience=none"),
    ),
    "no student here": ("Eve", *CONSENT),
}


@pytest.mark.long("journey")
@pytest.mark.parametrize("reason", WRONG)
def test_who_cannot_be_enrolled_is_told_why_in_one_line(acus, begun, reason):
    assert reason in refused(acus, "research", "enrol", NAME, *WRONG[reason])
    assert acus("research", "status", NAME)["studies"][0]["enrolled"] == 0


@pytest.mark.long("journey")
def test_a_study_begins_once(acus, begun):
    assert "has begun already" in refused(acus, "research", "begin", begun)
    assert "there: assistance-study" in refused(acus, "research", "status", "other")


@pytest.mark.long("journey")
def test_a_design_that_was_changed_later_is_refused(acus, begun):
    path = paths.data() / "research" / NAME / "design.yaml"
    path.write_text(path.read_text().replace("participants: 60", "participants: 90"))
    assert "was changed after" in refused(acus, "research", "enrol", NAME, "Ada", *CONSENT)


@pytest.mark.long("journey")
def test_students_enrolled_at_once_get_places_of_their_own(begun):
    people = People()
    names = [f"S{k}" for k in range(12)]
    people.take_roster([RosterLine(name, pin="1843") for name in names])
    study = find_study(NAME)

    def enrol(name):
        person = People().find(name)
        return find_study(NAME).enrol(person, {"experience": "some"}, "AB", People()).slot

    with ThreadPoolExecutor(4) as pool:
        slots = list(pool.map(enrol, names))
    assert sorted(slots) == list(range(12))
    arms = [one.arm for one in study.participants()]
    assert abs(arms.count("guided") - 6) <= 3


@pytest.mark.long("journey")
def test_an_entry_of_the_ledger_that_was_changed_is_noticed(acus, begun):
    import sqlite3

    acus("research", "enrol", NAME, "Ada", *CONSENT)
    with sqlite3.connect(paths.data() / "research" / NAME / LEDGER) as ledger:
        ledger.execute("UPDATE entries SET text = replace(text, 'guided', 'other')")
    assert "not as it was written" in refused(acus, "research", "status", NAME)


@pytest.mark.long("journey")
def test_enrolment_ends_with_the_participants_of_the_design_and_on_its_last_day(begun):
    from dataclasses import replace

    from app.research import ResearchError
    from app.research.design import Stopping

    study, people = find_study(NAME), People()
    late = replace(study, clock=lambda: datetime.now(UTC) + timedelta(days=9))
    until = datetime.now(UTC).date()
    ended = late.design.model_copy(update={"stopping": Stopping(until=until)})
    object.__setattr__(late, "design", ended)
    late.__dict__["sealed"] = study.sealed
    with pytest.raises(ResearchError, match="enrolment ended on"):
        late.enrol(people.find("Ada"), {"experience": "none"}, "AB", people)
    few = replace(study, design=study.design.model_copy(update={"participants": 2}))
    few.__dict__["sealed"] = study.sealed
    for name in ("Ada", "Bob"):
        few.enrol(people.find(name), {"experience": "none"}, "AB", people)
    people.take_roster([RosterLine("Eve", pin="1843")])
    with pytest.raises(ResearchError, match="all 2 participants"):
        few.enrol(people.find("Eve"), {"experience": "none"}, "AB", people)


@pytest.mark.long("journey")
def test_a_study_is_bundled_and_verified(acus, begun, tmp_path):
    names = [f"S-{k}" for k in range(6)]  # a block of six at the most has both arms
    People().take_roster([RosterLine(name, pin="1843") for name in names])
    for name in names:
        acus("research", "enrol", NAME, name, *CONSENT)
    out = tmp_path / "b.zip"
    assert "lock the data first" in refused(acus, "research", "bundle", NAME, "--out", out)
    acus("research", "lock", NAME, "--by", "CD")
    assert acus("research", "bundle", NAME, "--out", out)["participants"] == 6
    found = acus("research", "verify", out)
    assert (found["study"], found["problems"]) == (NAME, [])
    out.write_bytes(b"PK")
    assert "fetch it again" in refused(acus, "research", "verify", out)


def test_power_is_for_so_many_students_or_says_how_many_are_needed(acus):
    assumed = ("--effect", "10", "--sd", "15", "--simulations", "500")
    needed = acus("research", "power", *assumed, "--dropout", "0.2")
    assert needed["students"] > needed["complete"]
    assert abs(needed["power"] - 0.8) < 0.1
    few = acus("research", "power", *assumed, "--students", "20")
    assert (few["students"], few["power"] < 0.6) == (20, True)
    assert "--dropout is 1" in refused(acus, "research", "power", *assumed, "--dropout", "1")
    assert "too few" in refused(acus, "research", "power", *assumed, "--students", "3")


SUS = {f"q{k}": x for k, x in enumerate((5, 4, 2, 1, 2, 3, 2, 4, 5, 2), 1)}


@pytest.mark.long("journey")
def test_answers_are_entered_by_options_or_from_a_table_all_or_none(acus, begun, tmp_path):
    for name in ("Ada", "Bob"):
        acus("research", "enrol", NAME, name, *CONSENT)
    options = [word for item, x in SUS.items() for word in ("--answer", f"{item}={x}")]
    words = ("research", "answer", NAME, "sus")
    (one,) = acus(*words, "--student", "Ada", "--visit", "pre", *options)["answers"]
    assert one["scores"] == {"sus": pytest.approx(55.0)}
    again = refused(acus, *words, "--student", "Ada", "--visit", "pre", *options)
    assert "has answered sus at pre already" in again
    table = tmp_path / "a.csv"
    rows = [f"{name},post,{','.join(map(str, SUS.values()))}" for name in ("Ada", "Bob")]
    table.write_text("\n".join([f"student,visit,{','.join(SUS)}", *rows, rows[0]]))
    assert "has answered" in refused(acus, *words, "--from", table)
    table.write_text("\n".join([f"student,visit,{','.join(SUS)}", *rows]))
    assert len(acus(*words, "--from", table)["answers"]) == 2  # none was taken before
    for name, when, reason in (("Ada", "later", "its visits are"), ("Eve", "pre", "no student")):
        said = refused(acus, *words, "--student", name, "--visit", when, *options)
        assert reason in said
    assert "give --from FILE" in refused(acus, *words)


@pytest.mark.long("journey")
def test_a_study_comes_back_from_a_backup_with_the_stations_key(acus, begun, monkeypatch, tmp_path):
    recovery = People().set_instructor("correct horse")
    monkeypatch.setenv("ACUS_INSTRUCTOR_PASSWORD", "correct horse")
    one = acus("research", "enrol", NAME, "Ada", *CONSENT)
    acus("store", "backup", "--out", tmp_path / "b")
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "another"))
    monkeypatch.setattr("typer.prompt", lambda *_, **__: recovery)
    acus("store", "restore", tmp_path / "b", "--key")
    (found,) = acus("research", "status", NAME)["studies"]
    assert [visit["code"] for visit in found["due"]] == [one["code"]]
    assert acus("research", "enrol", NAME, "Bob", *CONSENT)["code"] != one["code"]
