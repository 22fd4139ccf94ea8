"""A course of 20 students, 12 exercises, 10 attempts each: every form in which 2400 attempts leave.

Run as `make bench BENCH=leave`. To reach: each form in 10 s. Beside them stands what the program
cannot avoid, reading the summaries of all attempts from their text and writing them as JSON again;
the ratio to it says what a form costs on whatever computer this is. How often each form reports is
printed too: a bar that moves 20 times can be cancelled 20 times.
"""

import json
import os
import statistics
import tempfile
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from time import perf_counter

import numpy as np

from app.core.progress import Progress
from app.exchange.moodle import GradeRule, MoodleChoice
from app.exchange.results import Results, ResultsFormat, results_text
from app.exchange.xapi import statements, statements_text
from app.scoring.conditions import Assistance, Conditions, DeviceKind
from app.session.board import progress_board
from app.session.course import CourseItem
from app.session.index import Indexed
from app.session.people import Person
from app.session.statement_queue import StatementQueue
from app.session.summary import Summary
from app.views.people.group_report import group_report
from app.views.people.report_facts import ReportFacts
from app.views.people.results_report import write_report
from tests.bench.in_turn import compare

STUDENTS, EXERCISES, ATTEMPTS, LIMIT_S = 20, 12, 10, 10.0
METRICS = 14


def results() -> Results:
    """Return a course of made-up attempts, with summaries as the index holds them."""
    random, began = np.random.default_rng(1), datetime(2026, 10, 1, tzinfo=UTC)
    people = [Person(f"p-{k}", f"resident-{k:02d}", ("A",)) for k in range(STUDENTS)]
    names = [f"exercise-{k}" for k in range(EXERCISES)]
    some = []
    for place in range(STUDENTS * EXERCISES * ATTEMPTS):
        number, rest = divmod(place, STUDENTS * EXERCISES)
        student, exercise = people[rest % STUDENTS].key, names[rest // STUDENTS]
        total = float(np.clip(random.normal(55.0 + 3.0 * number, 8.0), 0.0, 100.0))
        under = Conditions(exercise, 1, assistance=Assistance(0.5, 0.5, 0.5, 0.5),
                           kind=DeviceKind.SIMULATED, hand="mouse", scoring_version=3)  # fmt: skip
        rows = [
            {"name": f"metric_{k}", "label": "", "unit": "mm", "value": float(random.normal()),
             "note": "", "tolerance": None, "utility": 1.0, "band": "good", "sd": 0.1}
            for k in range(METRICS)
        ]  # fmt: skip
        started = (began + timedelta(minutes=place)).isoformat()
        score = {"total": total, "passed": total >= 60.0, "void_reason": "", "rows": rows}
        name = f"a-{place:04d}"
        summary = Summary(name, started, student, exercise, state="ended", duration=95.0,
                          score=score, conditions=under)  # fmt: skip
        document = json.dumps(summary.document(), sort_keys=True)
        some.append(
            Indexed(name, started, student, exercise, 1, "ended", 95.0, total, total >= 60.0,
                    "verified", True, json.dumps(under.document()), document)
        )  # fmt: skip
    items = [CourseItem(exercise=name, version=1) for name in names]
    board = progress_board(people, items, some, {}, datetime.now(UTC))
    return Results(board, some, {person.key: person for person in people}, {}, {})


def fresh(found: Results) -> Results:
    """Return the same results, of which nothing has been read from its text."""
    return replace(found, attempts=[replace(one) for one in found.attempts])


def main() -> None:
    """Print how long each form takes, how often it reports, and what of it cannot be avoided."""
    with tempfile.TemporaryDirectory() as name:
        os.environ["ACUS_DATA"] = name
        found, folder = results(), Path(name)
        choice = MoodleChoice(rule=GradeRule.of("mean:3"), feedback=True)

        def unavoidable() -> None:
            json.dumps([json.loads(one.document) for one in found.attempts])

        def text(form: ResultsFormat, progress: Progress) -> str:
            return results_text(fresh(found), form, False, progress, choice)

        def report(progress: Progress) -> None:
            facts = ReportFacts("Autumn", "A")
            write_report(folder / "r.pdf", lambda: group_report(found, {}, facts, progress))

        def queued(progress: Progress) -> None:
            told = statements(fresh(found), "https://bench.example", "autumn", progress)
            statements_text(told, array=False)
            StatementQueue(folder / f"queue-{perf_counter()}").put(told)

        forms: dict[str, Callable[[Progress], object]] = {
            form.value: (lambda progress, form=form: text(form, progress)) for form in ResultsFormat
        }
        forms |= {"pdf": report, "xapi and its queue": queued}
        print(f"{len(found.attempts)} attempts of {STUDENTS} students at {EXERCISES} exercises")
        for title, work in forms.items():
            told: list[float] = []
            work(Progress(lambda fraction, _, told=told: told.append(fraction)))
            ways = {title: lambda work=work: work(Progress()), "read and written": unavoidable}
            compare(ways, 5, LIMIT_S)
            both = []
            for _ in range(3):
                times = []
                for way in ways.values():
                    start = perf_counter()
                    way()
                    times.append(perf_counter() - start)
                both.append(times[0] / times[1])
            print(f"{title}: {statistics.median(both):.2f} times that, reported {len(told)} times")


if __name__ == "__main__":
    main()
