"""Whose files are taken: a station is its key, not its id or its name."""

import json
import secrets
from collections.abc import Callable
from pathlib import Path

import pytest
from school_stations import SchoolStation, headed, pool, resigned, stored

from app.session.errors import SessionError
from app.session.gathering import gather_file
from app.session.results_file import write_course, write_results
from app.session.signature import signature_text
from app.session.station import StationKey, key_file
from app.session.stations import stations_of


@pytest.fixture
def patch() -> pytest.MonkeyPatch:
    with pytest.MonkeyPatch.context() as patch:
        yield patch


@pytest.fixture
def school(tmp_path: Path, patch: pytest.MonkeyPatch) -> list[SchoolStation]:
    """Return two stations that know each other, and their head."""
    head = headed(tmp_path / "head", patch)
    write_course(tmp_path / "course", head.folder)
    one, two = (SchoolStation(tmp_path / name, name, patch) for name in ("A", "B"))
    for station in (one, two):
        station.enter()
        gather_file(tmp_path / "course", station.folder, trust=True)
    one.record(student())
    gather(two, results(one, tmp_path / "a"))
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


def impostor(root: Path, of: SchoolStation) -> SchoolStation:
    """Return a station that says it is another one, by a key of its own."""
    of.enter()
    document = {"station": StationKey.of().station, "secret": secrets.token_hex(32)}
    false = SchoolStation(root / "false", "F", of.patch)
    key_file().write_text(json.dumps(document))
    return false


@pytest.mark.long("journey")
@pytest.mark.parametrize("whose", [0, 1])
def test_nobody_is_let_in_under_the_id_of_a_known_station_or_of_this_one(
    school, tmp_path: Path, whose: int
) -> None:
    *_, two, _ = school
    false = impostor(tmp_path, school[whose])
    false.record(student(1))
    out = results(false, tmp_path / "false-results")
    two.enter()
    before = stored(two), stations_of(two.enter())
    with pytest.raises(SessionError, match="which is not known here by this key"):
        gather(two, out)
    assert (stored(two), stations_of(two.enter())) == before


def test_its_own_results_are_here_already_and_make_it_no_other_station(
    school, tmp_path: Path
) -> None:
    _, two, head = school
    name = two.record(student(1))
    two.enter().remark(name, comment="well done")
    out = results(two, tmp_path / "b")
    before = stations_of(two.enter())
    done = gather(two, out)
    assert (done.attempts, done.present, done.remarks, done.different) == (0, 1, 0, ())
    assert stations_of(two.enter()) == before
    gather(head, out)
    write_course(tmp_path / "again", head.folder)  # it names B among the stations that are known
    gather(two, tmp_path / "again")
    own = StationKey.of().station
    assert own not in {known.station for known in stations_of(two.enter()).values()}


def test_a_station_that_lost_its_attempts_has_them_again_by_its_own_results(
    school, tmp_path: Path
) -> None:
    _, two, _ = school
    name = two.record(student(1))
    out = results(two, tmp_path / "b")
    for path in two.folder.glob(f"{name}*"):
        path.unlink()
    assert gather(two, out).attempts == 1
    assert name in stored(two)["attempts"]


def test_a_course_that_comes_after_the_attempts_marks_what_is_beyond_it(
    tmp_path: Path, patch: pytest.MonkeyPatch
) -> None:
    head = headed(tmp_path / "head", patch)
    write_course(tmp_path / "course", head.folder)
    one = SchoolStation(tmp_path / "A", "A", patch)
    for _ in range(3):
        one.record(student())
    results(one, tmp_path / "a")  # they have numbers now
    assert gather(one, tmp_path / "course").excess == 1
    assert stored(one)["excess"] == {"2026-A-0003"}


def test_stations_that_a_known_ones_course_names_are_known(school, tmp_path: Path) -> None:
    one, two, head = school
    gather(head, results(one, tmp_path / "a-again"))
    write_course(tmp_path / "again", head.folder)
    three = SchoolStation(tmp_path / "C", "C", one.patch)
    gather(three, tmp_path / "again")
    names = {known.name for known in stations_of(three.enter()).values()}
    assert names == {"head", "A"}
    assert gather_file(tmp_path / "a", three.folder).attempts == 1, "without trust"
    assert two.name not in names


Members = dict[str, bytes]
KEYS: dict[str, StationKey] = {}


def as_another_student(manifest: dict, _: Members) -> None:
    manifest["attempts"][0]["student"] = student(2)


def as_another_exercise(manifest: dict, _: Members) -> None:
    manifest["attempts"][0]["exercise"] = "kidney"


def swapped(manifest: dict, members: Members) -> None:
    """Let the signatures of two attempts change their places."""
    first, second = (f"records/{one['attempt']}.sig" for one in manifest["attempts"])
    members[first], members[second] = members[second], members[first]


def signed_by_a_new_key(manifest: dict, members: Members) -> None:
    """Sign an attempt in the name of its station, by a key that nobody knows."""
    name = f"records/{manifest['attempts'][0]['attempt']}.sig"
    document = json.loads(members[name])
    false = StationKey(document["station"], secrets.token_bytes(32))
    members[name] = signature_text(document, false).encode()


def signed_by_another_known_station(manifest: dict, members: Members) -> None:
    """Sign an attempt in the name of its station, by the key of one that is known as another."""
    name = f"records/{manifest['attempts'][0]['attempt']}.sig"
    document = json.loads(members[name])
    members[name] = signature_text(document, KEYS["head"]).encode()


def with_another_total(manifest: dict, members: Members) -> None:
    name = f"records/{manifest['attempts'][0]['attempt']}.sig"
    document = json.loads(members[name])
    document["shown"]["total"] = "99.000000"
    members[name] = json.dumps(document).encode()


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "change",
    [
        as_another_student,
        as_another_exercise,
        swapped,
        signed_by_a_new_key,
        signed_by_another_known_station,
        with_another_total,
    ],
)
def test_an_attempt_is_what_its_station_signed_of_it_and_nothing_else(
    school, tmp_path: Path, change: Callable[[dict, Members], None]
) -> None:
    one, two, head = school
    head.enter()
    KEYS["head"] = StationKey.of()
    one.record(student())  # of the same student, so that ids alone tell them apart
    out = results(one, tmp_path / "two")
    forged = resigned(out, tmp_path / "forged", one, change)
    for path in two.folder.glob("*"):
        path.unlink()
    with pytest.raises(SessionError, match="is forged"):
        gather(two, forged)
    assert stored(two)["attempts"] == {}
    assert gather(two, out).attempts == 2


def test_a_record_that_is_not_what_the_list_says_is_not_taken(school, tmp_path: Path) -> None:
    """Whole and listed, but not the one that was numbered: its digest is another."""
    one, two, _ = school
    one.record(student(1))
    out = results(one, tmp_path / "two")

    def change(_: dict, members: Members) -> None:
        first, second = sorted(name for name in members if name.endswith(".mcap"))
        members[second] = members[first]

    with pytest.raises(SessionError, match="is damaged at records"):
        gather(two, resigned(out, tmp_path / "forged", one, change))
