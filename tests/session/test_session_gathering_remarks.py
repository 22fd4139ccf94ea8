"""Remarks of several stations: the latest by their counters holds, and nobody else's are taken."""

import json
import zipfile
from itertools import permutations
from pathlib import Path

import pytest
from school_stations import SchoolStation, headed, pool, resigned

from app.session.archive import erase_person
from app.session.errors import SessionError
from app.session.gathering import gather_file
from app.session.people import People
from app.session.results_file import write_course, write_results
from app.session.station import StationKey


@pytest.fixture
def patch() -> pytest.MonkeyPatch:
    with pytest.MonkeyPatch.context() as patch:
        yield patch


@pytest.fixture
def school(tmp_path: Path, patch: pytest.MonkeyPatch) -> list[SchoolStation]:
    """Return two stations with the course of a head, which lies at `course`."""
    head = headed(tmp_path / "head", patch)
    write_course(tmp_path / "course", head.folder)
    return [joined(tmp_path, name, patch) for name in ("A", "B")]


def joined(root: Path, name: str, patch: pytest.MonkeyPatch) -> SchoolStation:
    station = SchoolStation(root / name, name, patch)
    station.enter()
    gather_file(root / "course", station.folder, trust=True)
    return station


def student(number: int = 0) -> str:
    return list(pool()[1])[number]


def told(station: SchoolStation, out: Path) -> Path:
    station.enter()
    write_results(out, station.folder)
    return out


def heard(station: SchoolStation, out: Path):
    station.enter()
    return gather_file(out, station.folder, trust=True)


@pytest.mark.long("journey")
def test_the_latest_remark_by_the_counters_holds_in_whatever_order_files_come(
    school, tmp_path: Path, patch: pytest.MonkeyPatch
) -> None:
    """Three in turn, of A, B and A again: neither the order of ids nor that of files decides."""
    one, two = school
    name = one.record(student())
    files = []
    for number, (mine, other) in enumerate(((one, two), (two, one), (one, two))):
        mine.enter().remark(name, comment=f"{number}")
        files.append(told(mine, tmp_path / f"{number}"))
        heard(other, files[-1])
    for number, order in enumerate(permutations(range(3))):
        three = joined(tmp_path, f"C{number}", patch)
        for place, each in enumerate(order):
            heard(three, files[each])
            latest = str(max(order[: place + 1]))
            assert three.enter().remarks()[name].comment == latest, order


@pytest.mark.long("journey")
def test_a_remark_that_is_taken_back_stays_so_whatever_comes_late(school, tmp_path: Path) -> None:
    one, two = school
    name = one.record(student())
    one.enter().remark(name, void="bent")
    early = told(one, tmp_path / "early")
    heard(two, early)
    two.enter().remark(name, void="")
    heard(one, told(two, tmp_path / "late"))
    assert one.enter().remarks()[name].void == ""
    assert heard(two, early).remarks == 0
    assert two.enter().remarks()[name].void == ""


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "change",
    [
        {"value": "passed with honours"},
        {"kind": "void"},
        {"attempt": "2026-A-0002"},
        {"counter": 9},
        {"public": "ab" * 32},
    ],
)
def test_a_remark_that_was_changed_after_it_was_signed_lets_nothing_of_the_file_in(
    school, tmp_path: Path, change: dict[str, object]
) -> None:
    one, two = school
    name = one.record(student())
    one.record(student())
    one.enter().remark(name, comment="well done")
    out = told(one, tmp_path / "a")
    changed = resigned(out, tmp_path / "b", one, lambda of, _: of["remarks"][0].update(change))
    with pytest.raises(SessionError, match="is forged: a remark in it is not signed"):
        heard(two, changed)
    assert two.enter().remarks() == {}
    assert list(two.folder.glob("*.mcap")) == []
    assert heard(two, out).remarks == 1


def test_nobody_is_quoted_by_another_known_station(
    school, tmp_path: Path, patch: pytest.MonkeyPatch
) -> None:
    """What another known station has signed in this one's name is not this one's word."""
    one, two = school
    name = one.record(student())
    one.enter().remark(name, comment="well done")
    out = told(one, tmp_path / "a")
    three = joined(tmp_path, "C", patch)
    heard(two, told(three, tmp_path / "c"))
    three.enter()
    other = StationKey.of()

    def change(of: dict, _: dict[str, bytes]) -> None:
        remark = of["remarks"][0] | {"value": "failed", "public": other.public}
        bare = {key: remark[key] for key in remark if key not in ("public", "signature")}
        of["remarks"][0] = remark | {"signature": other.sign("remark", bare)}

    with pytest.raises(SessionError, match="is forged: a remark in it is not signed"):
        heard(two, resigned(out, tmp_path / "b", one, change))


def test_a_station_passes_on_what_it_said_itself_alone(school, tmp_path: Path) -> None:
    one, two = school
    name = one.record(student())
    one.enter().remark(name, comment="well done")
    heard(two, told(one, tmp_path / "a"))
    mine = two.record(student())
    two.enter().remark(mine, void="bent")
    done = heard(one, told(two, tmp_path / "b"))
    assert (done.attempts, done.remarks) == (1, 1)
    with zipfile.ZipFile(tmp_path / "b") as archive:
        manifest = json.loads(archive.read("manifest.json"))
    for part in ("attempts", "remarks"):
        assert [row["attempt"] for row in manifest[part]] == [mine]


@pytest.mark.parametrize("part", ["remarks", "attempts"])
def test_a_station_vouches_for_nothing_of_another(school, tmp_path: Path, part: str) -> None:
    one, two = school
    name = one.record(student())
    one.enter().remark(name, comment="well done")
    out = told(one, tmp_path / "a")
    changed = resigned(
        out, tmp_path / "b", one, lambda of, _: of[part][0].update(station="0123456789abcdef")
    )
    with pytest.raises(SessionError, match="is damaged at manifest"):
        heard(two, changed)


def test_attempts_and_remarks_of_who_was_erased_here_are_counted_as_left_out(
    school, tmp_path: Path
) -> None:
    one, two = school
    name = one.record(student())
    one.enter().remark(name, comment="well done")
    out = told(one, tmp_path / "a")
    erase_person(two.enter().find(student()).pseudonym, two.folder, delete_records=True)
    done = heard(two, out)
    assert (done.attempts, done.remarks, done.left_out) == (0, 0, 2)
    done = heard(two, tmp_path / "course")
    assert (done.people, done.left_out) == (0, 1)
    assert student() not in {person.key for person in People().everybody()}
