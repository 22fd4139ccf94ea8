"""The bundle of a study: it names nobody, checks itself, and R and Python read it as it is."""

import contextlib
import csv
import gzip
import hashlib
import io
import json
import re
import shutil
import subprocess
import sys
import zipfile
from datetime import UTC, datetime, timedelta
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree as ET

import numpy as np
import pyarrow.parquet
import pytest
import yaml
from scipy import stats

sys.path.append(str(Path(__file__).parents[1] / "session"))
import session_fakes
from session_fakes import Bench

from app.core import paths
from app.research import ResearchError, begin
from app.research.bundle import write_bundle
from app.research.bundle_check import check_bundle
from app.research.bundle_figures import OUTCOME, bundle_figures, participant_means, t_interval
from app.research.bundle_tables import SERIES_TABLE
from app.research.series import attempt_document, differences, series_table, trajectory_of
from app.session.people import People
from app.session.recording import read_recording
from app.session.roster import RosterLine
from app.session.station import StationKey
from app.session.verify import judged_by, verify

NAMES = ("Ada", "Bob", "Cleo", "Dora")
BEGIN = datetime(2026, 1, 14, 8, 0, tzinfo=UTC)


def make_study(folder, blind=False, names=NAMES):
    example = yaml.safe_load((paths.resources() / "research" / "design.yaml").read_text())
    arms = [
        {"name": "guided", "exercise": "first-insertion"},
        {"name": "unguided", "exercise": "first-insertion", "feedback": "held"},
    ]
    changes = {
        "arms": arms,
        "blind_assessor": blind,
        "randomisation": {"method": "blocks", "block_sizes": [2]},
        "visits": [{"name": "pre", "day": 0}, {"name": "post", "day": 3, "before": 2}],
    }
    path = folder / "design.yaml"
    path.write_text(yaml.safe_dump(example | changes))
    people = People()
    people.take_roster([RosterLine(name, f"{name} Lovelace", "1843") for name in NAMES])
    study = begin(path, people, 5, lambda: BEGIN)
    for name in names:
        study.enrol(people.find(name), {}, "XY", people)
    return study, people


def record(records, monkeypatch, *students):
    exercise = SimpleNamespace(**vars(session_fakes.EXERCISE) | {"id": "first-insertion"})
    monkeypatch.setattr(session_fakes, "EXERCISE", exercise)
    for day in (0, 2):
        monkeypatch.setattr(session_fakes, "WALL", BEGIN + timedelta(days=day, hours=1))
        bench = Bench(records)
        bench.run(0.1)
        for place, student in enumerate(students):
            bench.trainer.begin(student)
            bench.insertion(0.06 - 0.003 * place, 0.001 * place)
            bench.trainer.end()


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bundle")
    records = folder / "sessions"
    records.mkdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ACUS_DATA", str(folder / "data"))
        study, people = make_study(folder)
        keys = [people.find(name).key for name in NAMES]
        record(records, patch, *keys)
        done = write_bundle(study, people, records, folder / "b.zip")
        yield SimpleNamespace(
            study=study, people=people, records=records, done=done, path=folder / "b.zip", keys=keys
        )


@pytest.fixture
def here(made, monkeypatch):
    monkeypatch.setenv("ACUS_DATA", str(made.people.folder.parent))
    return made


def contents(path):
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def plain(name, data):
    if name.endswith(".parquet"):
        return str(pyarrow.parquet.read_table(io.BytesIO(data)).to_pydict()).encode()
    return gzip.decompress(data) if name.endswith(".gz") else data


def table(files, name):
    return list(csv.DictReader(io.StringIO(plain(name, files[name]).decode(), newline="")))


def rewritten(path, out, changes, hashed=True):
    files = contents(path) | changes
    if hashed:
        manifest = json.loads(files["manifest.json"])
        digests = {
            n: hashlib.sha256(d).hexdigest() for n, d in files.items() if n != "manifest.json"
        }
        files["manifest.json"] = json.dumps(manifest | {"files": digests}).encode()
    with zipfile.ZipFile(out, "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return out


@pytest.mark.long("journey")
def test_a_bundle_holds_no_pseudonym_name_key_or_date_of_the_station(here):
    files = contents(here.path)
    text = "\n".join(name + plain(name, data).decode() for name, data in files.items())
    secrets = [*NAMES, "Lovelace", *here.keys, StationKey.of(here.people.folder).station, "XY"]
    secrets += [path.stem for path in here.records.glob("*.mcap")]
    assert [one for one in secrets if re.search(rf"(?<!\w){re.escape(one)}(?!\w)", text)] == []
    assert "2026-01" not in text.replace("00000", "")
    assert (here.done.participants, here.done.attempts, here.done.series) == (4, 8, 8)


@pytest.mark.long("journey")
def test_every_score_is_computed_again_from_its_series(here):
    found = check_bundle(here.path)
    assert found.problems == ()
    assert (found.scores, found.digest) == (8, here.done.digest)


@pytest.mark.long("journey")
def test_the_same_study_gives_the_same_bytes(here, tmp_path):
    write_bundle(here.study, here.people, here.records, tmp_path / "again.zip")
    assert (tmp_path / "again.zip").read_bytes() == here.path.read_bytes()


@pytest.mark.long("journey")
def test_scores_in_the_bundle_are_those_of_the_records(here):
    from app.session.store import computed

    totals = sorted(one.score["total"] for one in computed(here.records))
    assert (
        sorted(float(row["score_total"]) for row in table(contents(here.path), "attempts.csv"))
        == totals
    )
    assert len(set(totals)) > 2


READ = {"text": str, "number": float, "whole": int, "yes_no": ("0", "1").index}


@pytest.mark.long("journey")
def test_every_table_is_read_by_its_codebook(here):
    files = contents(here.path)
    by_table = {}
    for row in table(files, "codebook.csv"):
        assert row["definition"], row
        by_table.setdefault(row["table"], {})[row["column"]] = row["kind"]
    series = by_table.pop("series/*.csv.gz")
    by_table |= {name: series for name in files if name.startswith("series/")}
    assert len(by_table) == 6 + 8
    for name, kinds in by_table.items():
        text = plain(name, files[name]).decode()
        assert text.splitlines()[0].split(",") == list(kinds), name
        for row in table(files, name):
            for column, value in row.items():
                assert value == "" or READ[kinds[column]](value) is not None
    known = {row["metric"] for row in table(files, "metrics_codebook.csv")}
    assert {row["metric"] for row in table(files, "metrics.csv")} <= known


@pytest.mark.long("journey")
def test_the_flow_counts_who_came_and_who_is_analysed(here):
    flow = {(r["stage"], r["arm"]): int(r["n"]) for r in table(contents(here.path), "consort.csv")}
    for stage in ("randomised", "began", "attended: pre", "attended: post", "analysed"):
        assert (flow[stage, "all"], flow[stage, "guided"], flow[stage, "unguided"]) == (4, 2, 2)
    assert flow["left", "all"] == 0


@pytest.mark.long("journey")
@pytest.mark.skipif(shutil.which("Rscript") is None, reason="R (Debian's r-base-core) is not here")
def test_r_reads_the_tables_as_they_are(here, tmp_path):
    with zipfile.ZipFile(here.path) as archive:
        archive.extractall(tmp_path)
    script = """
    attempts <- read.csv("attempts.csv")
    participants <- read.csv("participants.csv")
    joined <- merge(attempts, participants, by = c("participant", "arm"))
    stopifnot(nrow(joined) == 8, is.numeric(joined$score_total), is.numeric(joined$day))
    series <- read.csv(gzfile(attempts$series[1]))
    stopifnot(is.numeric(series$tip_x_m), all(diff(series$time_s) > 0))
    wide <- reshape(read.csv("metrics.csv")[, c("attempt", "metric", "value")],
                    idvar = "attempt", timevar = "metric", direction = "wide")
    stopifnot(nrow(wide) == 8, is.numeric(wide$value.target_error))
    cat(format(mean(attempts$score_total), digits = 15))
    """
    (tmp_path / "read.R").write_text(script)
    done = subprocess.run(
        ["Rscript", "--vanilla", "read.R"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    totals = [float(row["score_total"]) for row in table(contents(here.path), "attempts.csv")]
    assert float(done.stdout) == pytest.approx(sum(totals) / 8, rel=1e-12)


@pytest.mark.long("journey")
def test_a_file_that_was_changed_is_named(here, tmp_path):
    changed = rewritten(here.path, tmp_path / "c.zip", {"consort.csv": b"stage\n"}, hashed=False)
    assert check_bundle(changed).problems == (
        "consort.csv was changed after the bundle was made",
        "parquet/consort.parquet is not what the tables hold",
        "figures/consort.svg is not what the tables give",
    )


@pytest.mark.long("journey")
def test_a_score_that_its_series_does_not_give_is_named_also_where_all_hashes_fit(here, tmp_path):
    files = contents(here.path)
    name = next(name for name in files if name.startswith("attempts/"))
    document = json.loads(files[name])
    document["score"]["total"] = 99.5
    changed = rewritten(here.path, tmp_path / "c.zip", {name: json.dumps(document).encode()})
    problems = check_bundle(changed).problems
    assert any("total: 99.5 written" in line for line in problems)
    assert any("attempts.csv is another" in line for line in problems)


@pytest.mark.long("journey")
def test_a_series_that_was_changed_gives_another_score(here, tmp_path):
    files = contents(here.path)
    name = next(name for name in files if name.startswith("series/"))
    rows = [line.split(",") for line in gzip.decompress(files[name]).decode().splitlines()]
    at = rows[0].index("tip_x_m")
    moved = [rows[0], *([*r[:at], str(float(r[at]) + 0.004), *r[at + 1 :]] for r in rows[1:])]
    data = gzip.compress("\r\n".join(map(",".join, moved)).encode())
    problems = check_bundle(rewritten(here.path, tmp_path / "c.zip", {name: data})).problems
    assert any("target_error" in line for line in problems)


@pytest.mark.long("journey")
def test_a_participant_in_another_arm_than_the_committed_list_gives_is_named(here, tmp_path):
    text = contents(here.path)["participants.csv"].decode()
    swapped = re.sub(
        r",(un)?guided,", lambda m: ",guided," if m[1] else ",unguided,", text, count=1
    )
    changed = rewritten(here.path, tmp_path / "c.zip", {"participants.csv": swapped.encode()})
    problem, table_of_it = check_bundle(changed).problems
    assert "is not in the arm that the list gives" in problem
    assert table_of_it == "parquet/participants.parquet is not what the tables hold"


@pytest.mark.long("journey")
@pytest.mark.parametrize("harm", ["cut", "empty", "text", "none"])
def test_what_is_no_bundle_is_refused_in_one_line(here, tmp_path, harm):
    path = tmp_path / "c.zip"
    data = here.path.read_bytes()
    if harm != "none":
        path.write_bytes({"cut": data[: len(data) // 2], "empty": b"", "text": b"hello"}[harm])
    with pytest.raises(ResearchError) as refused:
        check_bundle(path)
    assert "\n" not in str(refused.value)


KEPT = sorted((Path(__file__).parents[1] / "data").glob("records*/*.mcap"))


@pytest.mark.parametrize("path", KEPT, ids=lambda path: path.stem)
def test_a_kept_record_gives_its_score_again_from_series_and_document_alone(path):
    recording = read_recording(path)
    standing = verify(recording).recomputed  # by today's rules; some are of versions long gone
    assert standing is not None
    trajectory = recording.trajectory()
    judged = judged_by(recording, standing)
    document = attempt_document(trajectory, recording.metadata["plan"], standing, *judged)
    kept = json.loads(json.dumps(document, allow_nan=False))
    again = trajectory_of(kept, series_table(trajectory))
    assert differences(kept, series_table(trajectory)) == []
    for name in ("tip", "axis", "felt", "hub", "guide", "target_shift", "spread", "clamped"):
        np.testing.assert_array_equal(getattr(again, name), getattr(trajectory, name))
    assert again.time[0] == 0.0


@pytest.mark.long("journey")
def test_whatever_bytes_of_a_bundle_are_harmed_it_is_reported_or_refused(here, tmp_path):
    data, rng = here.path.read_bytes(), np.random.default_rng(8)
    path = tmp_path / "c.zip"
    for at in rng.integers(0, len(data), 6).tolist():
        harmed = bytearray(data)
        harmed[at : at + 4] = rng.bytes(4)
        path.write_bytes(harmed)
        with contextlib.suppress(ResearchError):
            check_bundle(path)


@pytest.mark.long("journey")
def test_a_series_that_unpacks_to_more_than_one_may_be_is_refused(here, tmp_path, monkeypatch):
    monkeypatch.setattr("app.research.series._LARGEST", 1000)
    assert all("too large" in line for line in check_bundle(here.path).problems)


@pytest.mark.long("journey")
def test_odd_values_in_the_files_of_an_attempt_are_problems_and_no_crash(here, tmp_path):
    files = contents(here.path)
    name = next(name for name in files if name.startswith("attempts/"))
    document = json.loads(files[name])
    for odd in (
        document | {"score": None},
        document | {"plan": []},
        document | {"tolerances": {"target_error": {"x": 1}}},
        document | {"numbers": {}},
        document | {"arrays": []},
        document | {"marks": document["marks"] | {"scans": [{"time": "x"}]}},
        [],
    ):
        harmed = rewritten(here.path, tmp_path / "c.zip", {name: json.dumps(odd).encode()})
        assert check_bundle(harmed).problems
    deep = rewritten(here.path, tmp_path / "c.zip", {name: b"[" * 200_000})
    assert check_bundle(deep).problems


@pytest.fixture
def fresh(monkeypatch, tmp_path):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    return tmp_path


@pytest.mark.long("journey")
def test_an_arm_without_students_and_a_blind_study_make_no_bundle(fresh):
    study, people = make_study(fresh, blind=True, names=("Ada",))
    with pytest.raises(ResearchError, match="lock the data first"):
        write_bundle(study, people, fresh, fresh / "b.zip")
    study.lock("XY")
    with pytest.raises(ResearchError, match=r"arm (un)?guided has no student"):
        write_bundle(study, people, fresh, fresh / "b.zip")
    assert not (fresh / "b.zip").exists()


@pytest.mark.long("journey")
def test_a_reason_that_names_a_student_keeps_the_bundle_from_being_written(fresh):
    study, people = make_study(fresh)
    study.leave(people.find("Bob"), "quarrel with ADA", False, people)
    with pytest.raises(ResearchError, match=r"stands in participants\.csv"):
        write_bundle(study, people, fresh, fresh / "b.zip")
    assert [path.name for path in fresh.glob("*b.zip*")] == []


@pytest.mark.long("journey")
def test_nothing_of_who_withdrew_the_data_or_was_erased_is_in_the_bundle(fresh, monkeypatch):
    study, people = make_study(fresh)
    records = fresh / "sessions"
    records.mkdir()
    record(records, monkeypatch, *(people.find(name).key for name in ("Ada", "Bob", "Cleo")))
    gone = study.leave(people.find("Bob"), "", True, people).code
    people.forget_keys([people.find("Cleo").key])
    assert write_bundle(study, people, records, fresh / "b.zip").attempts == 2
    files = contents(fresh / "b.zip")
    rows = {row["participant"]: row for row in table(files, "participants.csv")}
    assert (len(rows), rows[gone]["withdrawn"], rows[gone]["left_reason"]) == (4, "1", "not given")
    assert len({row["participant"] for row in table(files, "attempts.csv")} - {gone}) == 1
    assert check_bundle(fresh / "b.zip").problems == ()


# --- Parquet and figures --------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_parquet_holds_what_the_csv_files_hold_and_has_their_types(here):
    files = contents(here.path)
    attempts = pyarrow.parquet.read_table(io.BytesIO(files["parquet/attempts.parquet"]))
    rows = table(files, "attempts.csv")
    assert attempts.num_rows == len(rows)
    scores = [row["score_total"] for row in rows]
    assert attempts["score_total"].to_pylist() == [float(x) if x else None for x in scores]
    kinds = {name: str(attempts.schema.field(name).type) for name in ("arm", "day", "passed")}
    assert kinds == {"arm": "string", "day": "int64", "passed": "bool"}


@pytest.mark.long("journey")
def test_all_series_stand_in_one_parquet_file_to_the_last_digit(here):
    files = contents(here.path)
    series = pyarrow.parquet.read_table(io.BytesIO(files[SERIES_TABLE])).to_pydict()
    names = [name for name in sorted(files) if name.startswith("series/")]
    lines = [
        line.split(",")
        for name in names
        for line in gzip.decompress(files[name]).decode().splitlines()[1:]
    ]
    assert len(series["attempt"]) == len(lines)
    assert set(series["attempt"]) == {name[7:-7] for name in names}
    assert [repr(x) for x in series["tip_z_m"]] == [line[4] for line in lines]


@pytest.mark.long("journey")
def test_a_bundle_makes_its_tables_and_figures_again(here):
    report = check_bundle(here.path)
    assert (report.problems, report.notes) == ((), ())
    assert report.made_again == 7 + 2


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", ["parquet/attempts.parquet", SERIES_TABLE, OUTCOME])
def test_a_table_or_figure_of_other_data_is_named(here, tmp_path, name):
    files = contents(here.path)
    if name.endswith(".svg"):
        other = files[name].replace(b"points", b"Points")
    else:
        held = pyarrow.parquet.read_table(io.BytesIO(files[name]))
        stream = io.BytesIO()
        pyarrow.parquet.write_table(held.slice(1), stream)
        other = stream.getvalue()
    assert other != files[name]
    rewritten(here.path, tmp_path / "other.zip", {name: other})
    report = check_bundle(tmp_path / "other.zip")
    assert len(report.problems) == 1
    assert report.problems[0].startswith(f"{name} is not what")


@pytest.mark.long("journey")
def test_a_parquet_file_that_is_garbage_is_named(here, tmp_path):
    name = "parquet/metrics.parquet"
    rewritten(here.path, tmp_path / "other.zip", {name: b"PAR1" + bytes(64)})
    assert check_bundle(tmp_path / "other.zip").problems == (f"{name} is not what the tables hold",)


@pytest.mark.long("journey")
def test_figures_of_another_matplotlib_are_not_compared_and_that_is_said(here, monkeypatch):
    monkeypatch.setattr("app.research.bundle_check.matplotlib_version", lambda: "0.0")
    report = check_bundle(here.path)
    assert report.problems == ()
    assert report.made_again == 7
    assert "here is 0.0: not compared" in report.notes[0]


@pytest.mark.long("journey")
def test_without_the_packages_a_bundle_is_written_and_says_what_is_left_out(
    here, tmp_path, monkeypatch
):
    monkeypatch.setitem(__import__("sys").modules, "pyarrow.csv", None)
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    done = write_bundle(here.study, here.people, here.records, tmp_path / "plain.zip")
    assert len(done.without) == 2
    assert all("extra `research`" in line for line in done.without)
    monkeypatch.undo()
    with zipfile.ZipFile(tmp_path / "plain.zip") as archive:
        assert not [n for n in archive.namelist() if n.startswith(("parquet/", "figures/"))]


def test_a_participant_weighs_the_same_however_often_he_tried():
    attempts = [
        {"attempt": f"a{k}", "arm": "x", "visit": "pre", "participant": who, "score_total": total}
        for k, (who, total) in enumerate([("p", "50.0"), ("p", "70.0"), ("q", "90.0"), ("q", "")])
    ]
    assert participant_means("score_total", attempts, []) == {("x", "pre"): [60.0, 90.0]}


def test_the_interval_of_a_mean_is_that_of_scipy():
    values = np.random.default_rng(4).normal(60.0, 9.0, 11)
    low, high = stats.t.interval(0.95, 10, values.mean(), stats.sem(values))
    assert t_interval(list(values)) == pytest.approx(0.5 * (high - low), rel=1e-12)
    assert t_interval([5.0]) == 0.0


@pytest.mark.long("journey")
def test_the_figure_names_arms_visits_and_the_outcome(here):
    tree = ET.fromstring(contents(here.path)[OUTCOME])
    words = {"".join(one.itertext()).strip() for one in tree.iter() if one.tag.endswith("text")}
    assert {"guided", "unguided", "pre", "post", "score_total [points]"} <= words


@pytest.mark.long("journey")
def test_figures_are_the_same_bytes_each_time(here):
    files = contents(here.path)
    plain = {name: data for name, data in files.items() if name.endswith((".csv", ".yaml"))}
    first = bundle_figures(plain)
    assert first == bundle_figures(plain)
    assert first[OUTCOME] == files[OUTCOME]
