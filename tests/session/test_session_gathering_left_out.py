"""What files of stations leave out, and what of them is left out here."""

import json
import zipfile
from pathlib import Path

import pytest
from school_stations import SchoolStation, headed, pool, stored

from app.session.archive import erase_person
from app.session.course import Course, CourseItem, courses_folder, find_course
from app.session.gathering import gather_file
from app.session.results_file import write_course, write_results
from app.session.sidecar import cached
from app.session.store import delete


@pytest.fixture
def patch() -> pytest.MonkeyPatch:
    with pytest.MonkeyPatch.context() as patch:
        yield patch


@pytest.fixture
def school(tmp_path: Path, patch: pytest.MonkeyPatch) -> list[SchoolStation]:
    """Return two stations with the course and the names of a head, and the head."""
    head = headed(tmp_path / "head", patch)
    write_course(tmp_path / "course", head.folder, names=True)
    one, two = (SchoolStation(tmp_path / name, name, patch) for name in ("A", "B"))
    for station in (one, two):
        station.enter()
        gather_file(tmp_path / "course", station.folder, trust=True, names=True)
    return [one, two, head]


def student(number: int = 0) -> str:
    return list(pool()[1])[number]


def results(station: SchoolStation, out: Path) -> Path:
    station.enter()
    write_results(out, station.folder)
    return out


def gather(station: SchoolStation, file: Path):
    station.enter()
    return gather_file(file, station.folder, trust=True)


def erase(station: SchoolStation, delete_records: bool) -> None:
    person = station.enter().find(student()).pseudonym
    erase_person(person, station.folder, delete_records=delete_records)


def manifest_of(out: Path) -> dict:
    with zipfile.ZipFile(out) as archive:
        return json.loads(archive.read("manifest.json"))


@pytest.mark.long("journey")
def test_who_was_erased_with_records_kept_is_gone_everywhere_and_the_records_stay(
    school, tmp_path: Path
) -> None:
    one, two, head = school
    name = two.record(student())
    two.enter().remark(name, comment="well done")
    gather(one, results(two, tmp_path / "b"))
    erase(one, delete_records=False)
    done = gather(two, results(one, tmp_path / "a"))
    assert done.erased == 1
    end = stored(two)
    assert set(end["attempts"]) == {name}
    assert (end["said"], student() in end["people"]) == ({}, False)
    assert set(people_names(two)) == {student(1), student(2)}
    # where another station deleted the records they go here too, whichever file comes first
    erase(head, delete_records=True)
    gather(two, results(head, tmp_path / "h"))
    gather(one, tmp_path / "h")
    gather(head, tmp_path / "a")
    gather(head, results(two, tmp_path / "b2"))
    assert [stored(station)["attempts"] for station in (one, two, head)] == [{}] * 3


def people_names(station: SchoolStation) -> dict[str, str]:
    return dict(station.enter().names())


def test_a_course_erases_who_was_erased_where_it_was_written(school, tmp_path: Path) -> None:
    one, _, head = school
    one.record(student())
    erase(head, delete_records=True)
    write_course(tmp_path / "later", head.folder)
    assert gather(one, tmp_path / "later").erased == 1
    assert stored(one)["attempts"] == {}


def test_an_attempt_that_was_deleted_here_does_not_come_back(school, tmp_path: Path) -> None:
    one, two, _ = school
    name = one.record(student())
    gather(two, results(one, tmp_path / "a"))
    delete(two.folder, name)
    done = gather(two, tmp_path / "a")
    assert (done.attempts, done.present) == (0, 1)
    assert stored(two)["attempts"] == {}
    one.enter()
    delete(one.folder, name)
    write_results(tmp_path / "later", one.folder)
    assert manifest_of(tmp_path / "later")["attempts"] == []


def test_a_record_that_was_altered_is_named_and_left_out(school, tmp_path: Path) -> None:
    one, *_ = school
    first, second = one.record(student()), one.record(student())
    results(one, tmp_path / "a")  # numbered while they were whole
    with (one.folder / f"{first}.mcap").open("ab") as stream:
        stream.write(b"x")
    one.enter()
    written = write_results(tmp_path / "b", one.folder)
    assert (written.attempts, written.left_out) == (1, (first,))
    assert [row["attempt"] for row in manifest_of(tmp_path / "b")["attempts"]] == [second]


def test_a_course_takes_its_own_attempts_and_remarks_alone(school, tmp_path: Path) -> None:
    one, *_ = school
    name = one.record(student())
    people = one.enter()
    people.remark(name, comment="well done")
    item = CourseItem(exercise="kidney", version=1)
    other = Course(id="winter", title="Winter", groups=("A",), items=(item,))
    written = write_results(tmp_path / "w", one.folder, other)
    assert (written.attempts, written.remarks) == (0, 0)
    written = write_results(tmp_path / "a", one.folder, find_course("autumn"))
    assert (written.attempts, written.remarks) == (1, 1)


def test_pins_and_names_travel_only_if_asked(school, tmp_path: Path) -> None:
    *_, head = school
    head.enter()
    write_course(tmp_path / "bare", head.folder)
    write_course(tmp_path / "names", head.folder, names=True)
    write_course(tmp_path / "all", head.folder, names=True, pins=True)
    bare, names, every = (
        {key for person in manifest_of(tmp_path / name)["people"] for key in person}
        for name in ("bare", "names", "all")
    )
    assert bare == {"key", "pseudonym", "groups"}
    assert names - bare == {"name"}
    assert every - names == {"pin"}


def test_a_course_that_is_another_one_here_stays_and_is_named(school, tmp_path: Path) -> None:
    one, *_ = school
    file = courses_folder(one.enter().folder) / "autumn.yaml"
    file.write_text(file.read_text().replace("Autumn", "Ours"))
    before = file.read_bytes()
    done = gather(one, tmp_path / "course")
    (line,) = done.different
    assert line.startswith("people/courses/autumn.yaml is another file here: the one here was kept")
    assert "another id" in line
    assert file.read_bytes() == before


def test_a_summary_that_was_altered_on_the_way_is_left_out(school, tmp_path: Path) -> None:
    one, two, _ = school
    name = one.record(student())
    with (
        zipfile.ZipFile(results(one, tmp_path / "a")) as old,
        zipfile.ZipFile(tmp_path / "b", "w") as new,
    ):
        for info in old.infolist():
            data = old.read(info)
            if info.filename.endswith(f"{name}.json"):
                data = json.dumps(json.loads(data) | {"duration": 1.0}).encode()
            new.writestr(info.filename, data, info.compress_type)
    assert gather(two, tmp_path / "b").attempts == 1
    assert cached(two.folder / f"{name}.mcap") is None
