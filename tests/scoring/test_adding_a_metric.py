"""A metric is added in just the way that docs/extending.md says: one file, nothing else."""

import sys
from pathlib import Path

import pytest
from extending_page import example
from scoring_attempts import Attempt

from app.scoring import metrics
from app.scoring.errors import MetricError
from app.scoring.score import check_names, score, with_shown
from app.scoring.tolerance import Tolerance


@pytest.fixture(params=["appended", "own"])
def added(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    code = example("How to add a metric")[1]
    (tmp_path / "deepest_point.py").write_text(code, encoding="utf-8")
    if request.param == "appended":
        monkeypatch.setattr(metrics, "__path__", [*metrics.__path__, str(tmp_path)])
    else:
        monkeypatch.setenv("ACUS_METRICS", str(tmp_path))
    yield "deepest_point"  # type: ignore[misc]
    sys.modules.pop("app.scoring.metrics.deepest_point", None)


def test_the_metric_of_the_page_is_found_shown_and_scored(added: str) -> None:
    trajectory = Attempt(depth=0.003).trajectory()
    deepest = trajectory.placed.length * 1e3 + 3.0
    row = with_shown(score(trajectory), trajectory).row(added)
    assert row.value == pytest.approx(deepest)
    assert row.tolerance is None

    limits = {"expert": deepest - 5.0, "good": deepest, "pass": deepest + 5.0}
    result = score(trajectory, {added: Tolerance.model_validate(limits)})
    assert result.rows[0].name == added
    assert result.total == pytest.approx(80.0)


def test_the_metric_of_the_page_says_why_it_has_no_value(added: str) -> None:
    phase = ["aligning"] * 2251
    trajectory = Attempt().trajectory(phase=phase)
    row = with_shown(score(trajectory), trajectory).row(added)
    assert row.value is None
    assert row.note == "the needle was never inserted"


@pytest.mark.long("statistics")
def test_a_metric_of_the_users_own_that_is_broken_breaks_no_score_and_says_why(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ACUS_METRICS", str(tmp_path))
    good = example("How to add a metric")[1]
    (tmp_path / "upside.py").write_text(good.replace("False", "3"), encoding="utf-8")
    (tmp_path / "raises.py").write_text(good.replace("    return", "    1 / 0\n    return"))
    trajectory = Attempt().trajectory()
    result = with_shown(score(trajectory), trajectory)
    assert result.row("target_error").value == pytest.approx(0.0, abs=1e-9)
    assert "line 11: higher_is_better is 3; give True or False" in result.row("upside").note
    assert "raises.py: compute() fails: ZeroDivisionError" in result.row("raises").note
    limits = Tolerance.model_validate({"expert": 1.0, "good": 2.0, "pass": 3.0})
    with pytest.raises(MetricError, match=r"upside.py, line 11: higher_is_better is 3"):
        check_names({"upside": limits})


def test_two_files_of_one_name_are_one_metric_that_cannot_be_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for folder in ("own", "appended"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "deepest_point.py").write_text(example("How to add a metric")[1])
    monkeypatch.setenv("ACUS_METRICS", str(tmp_path / "own"))
    monkeypatch.setattr(metrics, "__path__", [*metrics.__path__, str(tmp_path / "appended")])
    trajectory = Attempt().trajectory()
    result = with_shown(score(trajectory), trajectory)
    assert "two files are the metric 'deepest_point'" in result.row("deepest_point").note
    assert result.row("target_error").value is not None


def test_a_metric_with_the_name_of_one_of_the_programs_own_is_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ACUS_METRICS", str(tmp_path))
    (tmp_path / "target_error.py").write_text(example("How to add a metric")[1], encoding="utf-8")
    assert metrics.find("target_error").is_own
    assert metrics.available()["target_error"].title == "Target error"
