"""Running studies: errors, medians, failures that stay listed, table, CSV, JSON, picture."""

import csv
import io
import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rich.console import Console

from app.core.errors import NumericalError
from app.core.progress import Cancelled, Progress
from app.studies.errors import StudyError
from app.studies.findings import Figure, Findings, Sheet, Survey
from app.studies.plot import draw, draw_figure
from app.studies.runner import examine, find_study, run, study_names
from app.studies.slice_interpolation import field, oblique_plane, sampled
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way, duration
from app.studies.table import (
    csv_text,
    document,
    failure_lines,
    sheet_csv,
    sheet_table,
    summary_table,
    survey_document,
)


def breaks(case: Case) -> Prepared:
    raise NumericalError("no answer for a negative number")


def small(ways: tuple[Way, ...] | None = None) -> Study:
    return Study(
        name="small",
        title="Small",
        question="?",
        reference="two",
        error_label="error [m]",
        ways=ways
        or (
            Way("exact", "exact", lambda case: Prepared(lambda: 2.0)),
            Way("coarse", "rough", lambda case: Prepared(lambda: 2.0 + case.data)),
            Way("not a number", "rough", lambda case: Prepared(lambda: float("nan"))),
            Way("broken", "broken", breaks),
        ),
        settings=(Setting("a", {"x": 0.1}), Setting("b", {"x": 0.5})),
        case=lambda s: Case(s.values["x"], lambda value: abs(value - 2.0), 0.2),
        deadline=Limit(0.5, "half a second"),
        perception=Limit(0.2, "0.2 m"),
        default=(ways[0].name if ways else "exact"),
    )


class Ticks:
    """A clock that moves by a growing amount at each look."""

    def __init__(self) -> None:
        self.looks = 0

    def __call__(self) -> float:
        self.looks += 1
        return float(self.looks) ** 2 * 0.01


def test_errors_are_against_the_reference_and_times_are_medians() -> None:
    result = run(small(), repeats=3, clock=Ticks())
    first = result.points[0]
    assert first.error == 0.0
    # Looks 1 to 6 lie at 0.01 n²; the three timings are 0.03, 0.07 and 0.11 s.
    assert first.seconds == pytest.approx(0.07)
    coarse = [p for p in result.points if p.way == "coarse"]
    assert [p.error for p in coarse] == pytest.approx([0.1, 0.5])
    assert [p.within_perception for p in coarse] == [True, False]


def test_calls_inside_are_divided_out() -> None:
    way = Way("many", "many", lambda case: Prepared(lambda: 2.0, calls=10))
    result = run(small((way,)), repeats=1, clock=Ticks())
    assert result.points[0].seconds == pytest.approx(0.003)


def test_failures_are_listed_and_not_dropped() -> None:
    result = run(small(), repeats=1)
    assert [(f.way, f.setting) for f in result.failures] == [
        (way, setting) for setting in "ab" for way in ("not a number", "broken")
    ]
    assert "negative number" in result.failures[1].reason
    lines = failure_lines(result)
    assert any("negative number" in line for line in lines)
    assert any(line == "error noticed: coarse" for line in lines)


def test_the_summary_is_each_way_at_its_worst() -> None:
    summary = {p.way: p for p in run(small(), repeats=1).summary()}
    assert summary["coarse"].error == pytest.approx(0.5)
    assert summary["coarse"].setting == "b"
    assert not summary["coarse"].within_perception


def test_table_csv_and_json_say_the_same() -> None:
    result = run(small(), repeats=1)
    console = Console(width=120, file=io.StringIO(), record=True)
    console.print(summary_table(result))
    text = console.export_text()
    assert "coarse" in text
    assert "negative number" in text
    rows = list(csv.DictReader(io.StringIO(csv_text(result))))
    data = json.loads(json.dumps(document(result)))
    assert len(rows) == len(data["points"]) + len(data["failures"])
    assert float(rows[1]["error"]) == data["points"][1]["error"]


@pytest.mark.long("statistics")
def test_a_picture_is_written_with_the_failing_ways_in_its_foot(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    svg = draw(run(small(), repeats=1), tmp_path / "new" / "small.svg")
    assert svg.stat().st_size > 5000
    png = draw(run(small(), repeats=1), tmp_path / "small.png")
    assert png.read_bytes().startswith(b"\x89PNG")
    with pytest.raises(StudyError, match="cannot write the picture"):
        draw(run(small(), repeats=1), tmp_path / "small.nonsense")


def test_without_matplotlib_the_extra_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [n for n in sys.modules if n.startswith("matplotlib")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(StudyError, match="install the extra `plots`"):
        draw(run(small(), repeats=1), tmp_path / "x.png")


def test_a_run_can_be_cancelled() -> None:
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        run(small(), progress=progress)


def test_names_must_be_unique_and_known() -> None:
    way = Way("one", "one", lambda case: Prepared(lambda: 2.0))
    with pytest.raises(StudyError, match="each way needs a name of its own"):
        small((way, way))
    with pytest.raises(StudyError, match=r"there are .*lateral_tissue, .*slice_interpolation"):
        find_study("nothing")


@pytest.mark.parametrize("name", study_names())
def test_every_study_can_be_found(name: str) -> None:
    assert find_study(name).name == name


@pytest.mark.parametrize(
    ("seconds", "text"), [(2.0, "2 s"), (1.5e-3, "1.5 ms"), (2e-6, "2 µs"), (3e-9, "3 ns")]
)
def test_times_are_written_in_the_unit_that_suits(seconds: float, text: str) -> None:
    assert duration(seconds) == text


@pytest.mark.long("statistics")
def test_the_lateral_tissue_study_says_that_a_rigid_needle_is_felt_to_be_wrong() -> None:
    result = run("lateral_tissue", repeats=1)
    assert result.failures == ()
    assert set(result.too_coarse()) == {"rigid", "springs 5", "springs 20", "springs 80"}
    worst: dict[str, Any] = {p.way: p.error for p in result.summary()}
    assert worst["elements 32"] < 1e-6
    assert worst["differences 120"] < 1e-3


@pytest.mark.long("statistics")
def test_the_slice_study_orders_the_ways_by_error() -> None:
    result = run("slice_interpolation", repeats=1)
    assert result.failures == ()
    for setting in result.study.settings:
        errors = [p.error for p in result.points if p.setting == setting.name]
        assert errors[0] > errors[1] > errors[2]
    assert result.too_coarse() == ("nearest",)


def test_the_sampled_volume_is_the_field() -> None:
    volume = sampled(5.0)
    ijk = np.random.default_rng(3).integers(0, volume.size, (200, 3))
    exact = field(volume.lps_mm(ijk), 5.0)
    np.testing.assert_allclose(volume.hu[ijk[:, 2], ijk[:, 1], ijk[:, 0]], exact, atol=1e-4)


def test_the_plane_lies_within_the_volume() -> None:
    corners = oblique_plane().points_mm()[[0, 0, -1, -1], [0, -1, 0, -1]]
    volume = sampled(40.0)
    assert all(volume.contains(corner) for corner in corners)


def surveyed() -> Survey:
    def measure(progress: Progress | None) -> Findings:
        sheet = Sheet("sizes", "Sizes", ("what", "size [m]"), (("ball", 0.0123456), ("arm", 2)))
        line = Figure("line", lambda figure: figure.add_subplot(1, 1, 1).plot([0, 1], [2, 3]))
        return Findings((sheet,), (line,), ("The arm is longer.",))

    return Survey("surveyed", "Surveyed", "?", "a rule", measure)


def test_a_survey_has_tables_pictures_and_sentences(tmp_path: Path) -> None:
    result = examine(surveyed())
    assert survey_document(result)["tables"] == {
        "sizes": [{"what": "ball", "size [m]": 0.0123456}, {"what": "arm", "size [m]": 2}]
    }
    assert survey_document(result)["lines"] == ["The arm is longer."]
    assert sheet_csv(result.findings.sheets[0]) == "what,size [m]\nball,0.0123456\narm,2\n"
    console = Console(width=80, file=io.StringIO(), record=True)
    console.print(sheet_table(result.findings.sheets[0]))
    text = console.export_text()
    assert "size [m]" in text, "a unit is no markup"
    assert "0.01235" in text
    pytest.importorskip("matplotlib")
    path = draw_figure(result.findings.figures[0], tmp_path / "line.png")
    assert path.read_bytes().startswith(b"\x89PNG")


def test_what_is_timed_and_what_is_surveyed_are_told_apart() -> None:
    with pytest.raises(StudyError, match="examine"):
        run(surveyed())  # type: ignore[arg-type]
    with pytest.raises(StudyError, match="run"):
        examine(small())  # type: ignore[arg-type]
    with pytest.raises(StudyError, match="2 headings"):
        Sheet("bad", "Bad", ("a", "b"), ((1.0,),))
    with pytest.raises(StudyError, match="two of its headings are alike"):
        Sheet("bad", "Bad", ("a", "95 %", "95 %"), ((1.0, 2.0, 3.0),))


def test_a_study_may_bring_tables_of_its_own() -> None:
    bare = small()
    found = Findings((Sheet("more", "More", ("x",), ((1.0,),)),))
    result = run(replace(bare, findings=lambda: found), repeats=1)
    assert document(result)["tables"] == {"more": [{"x": 1.0}]}
    assert "tables" not in document(run(bare, repeats=1))
