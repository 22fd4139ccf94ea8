"""A group of 200 students with 50 attempts each: board, every form of results, scores anew.

Run as `make bench BENCH=results`. Records are 10 000 names of one file with a summary beside each,
as recording leaves them; every row of the index is sealed, and every seal looked at. Figures to
keep: the board in 1 s; scores by other bands from metrics, 200 attempts a second; from records of
three minutes, 20 a second on two cores.
"""

import json
import os
import resource
import shutil
import tempfile
from concurrent.futures import ProcessPoolExecutor
from datetime import UTC, datetime, timedelta
from pathlib import Path
from time import perf_counter

import numpy as np

from app.exchange.results import Results, ResultsFormat, results_text
from app.scoring.defaults import PUBLISHED_TOLERANCES
from app.scoring.result import Score
from app.scoring.score import score
from app.session.board import board_of
from app.session.index import Index
from app.session.index_records import listing, mark_of, rows_of
from app.session.people import People
from app.session.recording import open_recording
from app.session.roster import RosterLine
from app.session.sidecar import fresh_kept
from app.session.station import StationKey
from app.views.people.group_report import group_report
from app.views.people.report_facts import ReportFacts
from app.views.people.results_report import student_report, write_report
from tests.bench.bench_record import record
from tests.bench.in_turn import compare

STUDENTS, ATTEMPTS = 200, 50
RECORDS = Path(__file__).resolve().parents[1] / "data" / "records"


def fill(folder: Path, keys: list[str]) -> None:
    """Write the records, one file by 10 000 names, and their rows of the index.

    The rows are those of the one record that is read, with students, days and points of their own.
    """
    source = min(RECORDS.glob("*.mcap"), key=lambda path: path.stat().st_size)
    first = folder / "first.mcap"
    shutil.copy2(source, first)
    index, key = Index(folder), StationKey.of()
    mark = mark_of(folder, "first", listing(folder), key.station)
    (row,) = rows_of(folder, "first", mark, fresh_kept, key)
    began, random = datetime(2026, 1, 1, tzinfo=UTC), np.random.default_rng(1)
    rows = []
    for student, person in enumerate(keys):
        for number in range(ATTEMPTS):
            name = f"a-{student:03d}-{number:02d}"
            (folder / f"{name}.mcap").hardlink_to(first)
            started = (began + timedelta(hours=ATTEMPTS * student + number)).isoformat()
            total = float(random.uniform(30.0, 100.0))
            said = {"id": name, "student": person, "started": started}
            document = json.dumps(json.loads(row["document"]) | said)
            judged = {"total": total, "passed": total > 60.0, "counts": True, "verdict": "verified"}
            rows.append(row | said | judged | {"document": document})
    first.unlink()
    index._put(rows, ())


def timed(title: str, work: object) -> object:
    """Do it, print how long it took, and return what it gave."""
    start = perf_counter()
    found = work()  # type: ignore[operator]
    print(f"{title:44} {perf_counter() - start:6.2f} s")
    return found


def rescored(path: str) -> float | None:
    """Score a record by other bands: read, made a trajectory of, every metric computed."""
    return score(open_recording(Path(path)).trajectory(), PUBLISHED_TOLERANCES).total


def main() -> None:
    """Print all of it."""
    with tempfile.TemporaryDirectory() as name:
        os.environ["ACUS_DATA"] = name
        folder = Path(name) / "sessions"
        folder.mkdir()
        people = People()
        lines = [RosterLine(f"student-{k:03d}", groups=("A",)) for k in range(STUDENTS)]
        timed(f"roster of {STUDENTS}, PINs hashed", lambda: people.take_roster(lines))
        fill(folder, [person.key for person in people.everybody()])
        count = STUDENTS * ATTEMPTS
        compare({f"board of {count}": lambda: board_of(folder, people)}, 5, 1.0)

        board, attempts = board_of(folder, people)
        known = {text: person for person in people.everybody() for text in (person.key,)}
        results = Results(board, attempts, known, people.remarks(), {})
        for form in ResultsFormat:
            timed(f"results, {form.value}", lambda form=form: results_text(results, form))
        out, first = Path(name) / "r.pdf", board.students[0]
        timed(
            "report of the group",
            lambda: write_report(out, lambda: group_report(results, {}, ReportFacts())),
        )
        timed(
            "report of a student",
            lambda: write_report(out, lambda: student_report(results, first, {}, ReportFacts())),
        )
        print(f"most memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB")

        found = json.loads(attempts[0].document)["score"]
        document = json.dumps(found)
        one = Score.from_json(document)
        start = perf_counter()
        for _ in range(2000):
            Score.from_json(document).recomputed(PUBLISHED_TOLERANCES, one.rules)
        print(f"scores from metrics: {2000 / (perf_counter() - start):.0f} a second, 200 to reach")

        paths = [str(record(Path(name), 3.0))] * 40
        with ProcessPoolExecutor(2) as pool:
            list(pool.map(rescored, paths[:4]))  # what a first time loads
            start = perf_counter()
            list(pool.map(rescored, paths, chunksize=4))
            rate = len(paths) / (perf_counter() - start)
        print(
            f"scores from records of three minutes: {rate:.1f} a second on two cores, 20 to reach"
        )


if __name__ == "__main__":
    main()
