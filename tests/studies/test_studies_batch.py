"""All studies in a row: kept as they come, gone on with, broken ones told and passed over."""

import json
import sys

import pytest
from typer.testing import CliRunner

from app.commands import build
from app.core.progress import Cancelled, Progress
from app.studies import runner
from app.studies.batch import StudyOutcome, run_all
from app.studies.kept import read

GOOD = '''
"""A study."""
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION = {{"title": "T", "question": "Q", "reference": "R"}}
RUNS = []

def _prepare(case):
    return Prepared(lambda: RUNS.append(1) or 0.0)

STUDY = Study(
    error_label="error [m]",
    ways=(Way("one", "one", _prepare), Way("two", "two", {second})),
    settings=(Setting("a", {{}}),),
    case=lambda setting: Case(None, lambda value: value, 1.0),
    deadline=Limit(1.0, "1 s"),
    perception=Limit(1.0, "1 m"),
    default="one",
)
'''
BROKEN = GOOD.format(second="_prepare").replace("lambda setting: Case", "lambda setting: Cose")
SURVEY = '''
"""A survey."""
from app.studies.findings import Findings, Survey

DECLARATION = {"title": "T", "question": "Q", "reference": "R"}

STUDY = Survey(
    measure=lambda progress: Findings((), lines=("all of it",)),
    quick=lambda progress: Findings((), lines=("less",)),
)
'''
NAMES = ("batch_a", "batch_broken", "batch_b")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    own = tmp_path / "own"
    own.mkdir()
    monkeypatch.setenv("ACUS_STUDIES", str(own))
    for name in NAMES:
        text = BROKEN if name == "batch_broken" else GOOD.format(second="_prepare")
        (own / f"{name}.py").write_text(text, encoding="utf-8")
    yield tmp_path / "out"
    for name in [name for name in sys.modules if "batch_" in name]:
        del sys.modules[name]


def outcomes(done):
    return {one.name: one.outcome for one in done}


@pytest.mark.long("statistics")
def test_a_broken_study_is_told_and_does_not_end_the_run(folder):
    done = run_all(NAMES, folder, repeats=1)
    assert outcomes(done) == {
        "batch_a": StudyOutcome.MEASURED,
        "batch_broken": StudyOutcome.BROKEN,
        "batch_b": StudyOutcome.MEASURED,
    }
    assert done[1].text == "NameError: name 'Cose' is not defined"
    assert read(folder / "batch_b.json").default == "one"
    suffixes = {path.suffix for path in folder.glob("batch_a.*")}
    assert {".csv", ".json"} <= suffixes


@pytest.mark.long("statistics")
def test_what_is_finished_is_not_measured_again_unless_that_is_asked_for(folder):
    run_all(NAMES, folder, repeats=2)
    assert outcomes(run_all(NAMES, folder, repeats=2))["batch_a"] is StudyOutcome.KEPT
    assert outcomes(run_all(NAMES, folder, repeats=3))["batch_a"] is StudyOutcome.MEASURED
    again = run_all(NAMES, folder, repeats=2, fresh=True)
    assert outcomes(again)["batch_b"] is StudyOutcome.MEASURED


@pytest.mark.long("statistics")
def test_a_cancelled_run_keeps_what_is_finished_and_the_next_goes_on(folder):
    progress = Progress()
    with pytest.raises(Cancelled):
        run_all(NAMES, folder, repeats=1, progress=progress, answer=lambda done: progress.cancel())
    assert [path.stem for path in folder.glob("*.json")] == ["batch_a"]
    found = outcomes(run_all(NAMES, folder, repeats=1))
    assert found["batch_a"] is StudyOutcome.KEPT
    assert found["batch_b"] is StudyOutcome.MEASURED


@pytest.mark.long("statistics")
def test_a_study_that_changed_or_a_file_that_is_cut_short_is_measured_anew(folder):
    run_all(NAMES, folder, repeats=1)
    path = folder / "batch_a.json"
    data = json.loads(path.read_text()) | {"default": "two"}
    path.write_text(json.dumps(data))
    (folder / "batch_b.json").write_text('{"study"')
    found = outcomes(run_all(NAMES, folder, repeats=1))
    assert found["batch_a"] is found["batch_b"] is StudyOutcome.MEASURED


@pytest.mark.long("statistics")
def test_the_command_runs_all_goes_on_and_ends_with_1_where_one_is_broken(folder, monkeypatch):
    monkeypatch.setattr(runner, "study_names", lambda: NAMES)
    command = ["study", "all", "--quick", "--out", str(folder), "--json"]
    done = CliRunner().invoke(build(), command)
    assert done.exit_code == 1
    rows = json.loads(done.stdout)["facts"]["studies"]
    assert [row["outcome"] for row in rows] == ["measured", "broken", "measured"]
    done = CliRunner().invoke(build(), [*command, "--fresh"][:-2])
    assert done.exit_code == 1
    assert "batch_a: kept" in done.stderr
    monkeypatch.setattr(runner, "study_names", lambda: ("batch_a",))
    assert CliRunner().invoke(build(), command).exit_code == 0


def test_a_quick_run_asks_surveys_for_less_and_a_full_one_does_not_take_that_for_all(
    folder, monkeypatch
):
    (folder.parent / "own" / "batch_survey.py").write_text(SURVEY, encoding="utf-8")

    def lines(quick):
        (done,) = run_all(("batch_survey",), folder, quick=quick)
        return done.outcome, done.result and done.result.findings.lines

    assert lines(quick=True) == (StudyOutcome.MEASURED, ("less",))
    assert lines(quick=True) == (StudyOutcome.KEPT, None)
    assert lines(quick=False) == (StudyOutcome.MEASURED, ("all of it",))
    assert lines(quick=True) == (StudyOutcome.KEPT, None)
    monkeypatch.setattr(runner, "study_names", lambda: ("batch_survey",))
    command = ["study", "all", "--quick", "--fresh", "--out", str(folder)]
    assert CliRunner().invoke(build(), command).exit_code == 0
    kept = json.loads((folder / "batch_survey.json").read_text())
    assert kept["measured"]["quick"] is True
