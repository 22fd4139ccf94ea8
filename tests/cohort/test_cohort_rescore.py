"""Stored attempts scored anew: by present bands, nothing lost silently, the same bytes again."""

from pathlib import Path
from shutil import copyfile

import pyarrow.parquet as parquet
import pytest

from app.cohort import CohortError, crew_of, rescore
from app.cohort import rescoring as room
from app.exercises.schema import Exercise
from app.session.recording import open_recording
from app.session.verify import EXERCISE_FILE, judged_by, verify

RECORDS = sorted((Path(__file__).parents[1] / "data" / "records").glob("*.mcap"))
MACHINES = sorted((Path(__file__).parents[1] / "data" / "records-machines").glob("*.mcap"))


@pytest.fixture
def folder(tmp_path):
    place = tmp_path / "records"
    place.mkdir()
    for record in (*RECORDS, *MACHINES[:3]):
        copyfile(record, place / record.name)
    return place


def rows(file):
    return parquet.read_table(file).to_pylist()


def own_exercise(record):
    return Exercise.model_validate_json(open_recording(record).attachments[EXERCISE_FILE])


@pytest.mark.long("journey")
def test_an_attempt_under_its_own_exercise_scores_as_its_written_values_judged_again(
    folder, tmp_path
):
    """The written score is of version 5 or 6: its values are judged by the rules of today."""
    record = RECORDS[0]
    recording = open_recording(record)
    tolerances, rules = judged_by(recording, None)
    exercise = own_exercise(record)
    out = tmp_path / "a.parquet"
    rescore(folder, out, crew_of(), exercise)
    (row,) = rows(out)
    checked = verify(recording)
    assert row["id"] == record.stem
    assert row["written_total"] == checked.written.total
    measured = {one.name: one.value for one in checked.recomputed.rows}
    assert row["value_lateral_error"] == measured["lateral_error"]
    assert exercise.rules == rules
    assert dict(exercise.tolerances) == dict(tolerances)


def test_another_pass_mark_and_wider_bands_change_who_passes_and_no_record(folder, tmp_path):
    exercise = own_exercise(RECORDS[0])
    wide = {
        name: one.model_copy(update={"expert": 1e6, "good": 2e6, "pass_": 3e6, "zero": 4e6})
        for name, one in exercise.tolerances.items()
        if name in ("lateral_error", "depth_error", "angle_error", "total_time")
    }
    lenient = exercise.model_copy(
        update={
            "tolerances": wide,
            "bands": {},
            "rules": exercise.rules.model_copy(update={"pass_mark": 10.0}),
        }
    )
    before = {file.name: file.read_bytes() for file in folder.glob("*.mcap")}
    results = []
    for number, one in enumerate((exercise, lenient)):
        out = tmp_path / f"{number}.parquet"
        rescore(folder, out, crew_of(), one)
        results += rows(out)
    strict, easy = results
    assert (strict["passed"], easy["passed"]) == (False, True)
    assert easy["total"] == pytest.approx(100.0)
    assert {file.name: file.read_bytes() for file in folder.glob("*.mcap")} == before


@pytest.mark.long("journey")
def test_every_attempt_has_a_row_and_what_cannot_be_scored_says_why(folder, tmp_path):
    (folder / "20990101-000000-cut.mcap").write_bytes(RECORDS[0].read_bytes()[:3000])
    (folder / "20990101-000001-none.mcap").write_bytes(b"no record at all")
    out = tmp_path / "a.parquet"
    done = rescore(folder, out, crew_of())
    table = rows(out)
    assert done.rows == len(table) == len(list(folder.glob("*.mcap")))
    for row in table:
        assert (row["total"] is None) == bool(row["not_scored"] or row["void_reason"])
    broken = [row for row in table if row["id"].startswith("2099")]
    assert all(row["not_scored"] for row in broken)


@pytest.mark.long("journey")
def test_the_table_is_the_same_to_the_bit_however_it_is_cut_up_and_gone_on_with(
    folder, tmp_path, monkeypatch
):
    first, second = tmp_path / "a.parquet", tmp_path / "b.parquet"
    rescore(folder, first, crew_of())
    monkeypatch.setattr(room, "RECORDS", 2)
    done = rescore(folder, second, crew_of())
    assert done.parts == 3
    assert first.read_bytes() == second.read_bytes()
    again = rescore(folder, second, crew_of())
    assert (again.done_before, second.read_bytes()) == (3, first.read_bytes())


def test_a_folder_without_attempts_of_the_exercise_is_named(folder, tmp_path):
    other = own_exercise(RECORDS[0]).model_copy(update={"id": "of-nobody"})
    with pytest.raises(CohortError, match="no attempt of exercise of-nobody in"):
        rescore(folder, tmp_path / "a.parquet", crew_of(), other)
    empty = tmp_path / "empty"
    empty.mkdir()
    with pytest.raises(CohortError, match="there is no attempt in"):
        rescore(empty, tmp_path / "a.parquet", crew_of())


def test_a_record_that_is_another_file_for_a_worker_is_refused(folder, tmp_path):
    part = room._part(folder, room.list_sessions(folder)[:1], {})
    path = Path(part.given["records"][0]["path"])
    path.write_bytes(path.read_bytes() + b"x")
    with pytest.raises(CohortError, match="another file for a worker"):
        part.do(part.given)
    path.unlink()
    with pytest.raises(CohortError, match="all computers see under one name"):
        part.do(part.given)
