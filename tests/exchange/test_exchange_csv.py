"""Tables for spreadsheets."""

import csv
import io
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from app.core.clock import VirtualClock
from app.core.disclaimer import DISCLAIMER
from app.exchange.csv_export import (
    FIXED,
    TRAJECTORY_COLUMNS,
    score_table,
    trajectory_table,
    write_csv,
)
from app.exchange.errors import ExportError
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.conditions import Conditions
from app.session.facts import PLAN, plan_record
from app.session.header import SessionHeader
from app.session.machine import State
from app.session.needle import DOWN, DepthSource, NeedlePose
from app.session.recorder import Recorder
from app.session.recording import read_recording
from app.session.sample import Sample
from app.session.summary import Summary

ROWS = [
    {"name": "lateral_error", "unit": "mm", "value": 2.125, "sd": 0.125},
    {"name": "angle_error", "unit": "°", "value": None},
    {"name": "path_ratio", "unit": "", "value": 1.0},
]
SCORED = Summary(
    "a-1",
    "2026-01-15T09:31:22.418+00:00",
    "s-1",
    "liver-01",
    state="ended",
    duration=12.5,
    scans=2,
    score={"total": 86.5, "passed": True, "void_reason": "", "rows": ROWS},
)


def parse(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text, newline=""), strict=True))


def test_one_row_per_attempt_with_units_in_the_column_names() -> None:
    (row,) = parse(score_table([SCORED]))
    metrics = ["lateral_error_mm", "angle_error_deg", "path_ratio_ratio"]
    assert list(row) == [
        *FIXED,
        *metrics,
        *(f"{name}_sd" for name in metrics),
        "drill",
        "bands",
        "note",
    ]
    assert row["score_total_percent"] == "86.5"
    assert row["lateral_error_mm"] == "2.125"
    assert row["lateral_error_mm_sd"] == "0.125"
    assert row["angle_error_deg"] == ""
    assert row["passed"] == "true"
    assert row["note"] == DISCLAIMER


def test_attempts_with_other_metrics_and_without_a_score_share_the_table() -> None:
    other = Summary("b", "", score={"rows": [{"name": "peak_force", "unit": "N", "value": 1.5}]})
    rows = parse(score_table([SCORED, other, Summary("c", "", state="broken", reason="cut off")]))
    assert [r["peak_force_n"] for r in rows] == ["", "1.5", ""]
    assert [r["lateral_error_mm"] for r in rows] == ["2.125", "", ""]
    assert rows[2]["reason"] == "cut off"
    assert {r["note"] for r in rows} == {DISCLAIMER}


def test_a_passed_drill_is_marked_and_moves_no_other_column() -> None:
    practised = Conditions("drill-depth-liver-01", scoring_version=7, drill="depth")
    drill = replace(SCORED, exercise_id="drill-depth-liver-01", conditions=practised)
    whole = replace(SCORED, conditions=replace(practised, exercise="liver-01", drill=""))
    rows = parse(score_table([drill, whole, SCORED]))
    assert [(row["passed"], row["drill"]) for row in rows] == [
        ("true", "depth"), ("true", ""), ("true", ""),
    ]  # fmt: skip
    assert list(rows[0])[-3:] == ["drill", "bands", "note"]


def test_no_attempts_give_the_column_names_alone() -> None:
    assert score_table([]) == ",".join([*FIXED, "drill", "bands", "note"]) + "\r\n"


@pytest.mark.parametrize("text", ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1", "\n=1"])
def test_no_cell_of_text_is_run_as_a_formula(text: str) -> None:
    (row,) = parse(score_table([Summary("a", "", student=text, reason=text)]))
    assert row["student"] == "'" + text
    assert row["reason"] == "'" + text


def test_no_cell_steers_a_terminal() -> None:
    text = score_table([Summary("a", "", student="\x1b]0;x\x07Ada", reason="\u202eyes")])
    assert not set("\x1b\x07\u202e") & set(text)
    assert parse(text)[0]["student"] == r"\u001b]0;x\u0007Ada"


def test_negative_numbers_stay_numbers() -> None:
    summary = Summary("a", "", score={"rows": [{"name": "depth", "unit": "mm", "value": -0.8}]})
    assert parse(score_table([summary]))[0]["depth_mm"] == "-0.8"


def test_commas_quotes_and_line_ends_survive() -> None:
    reason = 'cut, "off"\r\nhere'
    text = score_table([Summary("a", "", reason=reason)])
    assert parse(text)[0]["reason"] == reason
    assert text.endswith("\r\n")


def test_a_trajectory_has_empty_cells_where_the_pose_is_not_valid(tmp_path: Path) -> None:
    placed = PlacedPlan.of(Plan(np.zeros(3), np.array([0.0, 60.0, 0.0])), Placement(), np.zeros(3))
    started = datetime(2026, 1, 15, tzinfo=UTC)
    header = SessionHeader("t", started, 0.0, "s", "e", metadata={PLAN: plan_record(placed)})
    recorder = Recorder(tmp_path, header, clock=VirtualClock())
    recorder.open()
    for k in range(3):
        seen = NeedlePose(
            p_tip=np.array([0.003, 0.0, -0.05]),
            axis=DOWN,
            depth=0.05,
            time=0.02 * k,
            orientation_age=0.0,
            depth_age=0.0,
            depth_source=DepthSource.TRACKED,
            valid=k != 1,
            covariance=np.zeros((3, 3)),
        )
        recorder.sample(Sample(0.02 * k, State.INSERTING, seen, None, placed.p_target))
    recorder.finish()
    rows = parse(trajectory_table(read_recording(recorder.status().path)))
    assert list(rows[0]) == list(TRAJECTORY_COLUMNS)
    assert float(rows[0]["lateral_mm"]) == pytest.approx(3.0)
    assert float(rows[0]["remaining_mm"]) == pytest.approx(10.0)
    assert float(rows[2]["time_s"]) == pytest.approx(0.04)
    assert rows[0]["felt_n"] == ""
    assert (rows[1]["tip_x_mm"], rows[1]["valid"]) == ("", "false")
    assert rows[1]["note"] == DISCLAIMER


def test_the_file_begins_with_the_mark_that_spreadsheets_look_for(tmp_path: Path) -> None:
    path = tmp_path / "out.csv"
    write_csv(path, score_table([SCORED]))
    assert path.read_bytes().startswith(b"\xef\xbb\xbfid,")
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="cannot write"):
        write_csv(tmp_path / "file" / "x.csv", "")


def test_whose_bands_judged_stands_in_its_row() -> None:
    made = Conditions("liver-01", hand="mouse", bands="mouse", bands_source="scripts")
    rows = parse(score_table([replace(SCORED, conditions=made), SCORED]))
    assert [row["bands"] for row in rows] == ["mouse (scripts)", ""]
