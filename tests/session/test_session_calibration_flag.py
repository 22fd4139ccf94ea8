"""Attempts made with a calibration of the cameras that was later found bad say so."""

from dataclasses import replace
from pathlib import Path

import pytest
from session_fakes import Bench

from app.core import paths
from app.session.calibration_flag import CalibrationFlags
from app.session.sidecar import read_summary, sidecar
from app.session.store import list_sessions
from app.tracking.calibration.history_file import HistoryFile

CONDEMNED = """\
calibrations:
- {id: good, kept: 2026-01-01T00:00:00Z}
- id: bad
  kept: 2026-01-01T00:00:00Z
  condemned: {date: 2026-01-02T00:00:00Z, reason: the left camera was bumped}
"""


def attempt(folder: Path, calibration: str) -> Path:
    bench = Bench(folder)
    cameras = {"name": "wide"} | ({"calibration": calibration} if calibration else {})
    bench.trainer._context = replace(bench.context, metadata={"cameras": cameras})
    bench.run(0.1)
    bench.trainer.begin("s-1")
    bench.run(0.3)
    bench.trainer.end()
    return next(folder.glob("*.mcap"))


def condemn() -> None:
    folder = paths.data() / "calibrations"
    folder.mkdir(parents=True)
    (folder / "history.yaml").write_text(CONDEMNED)


@pytest.mark.parametrize("beside", [True, False])
def test_an_attempt_made_with_a_calibration_found_bad_later_is_flagged(
    tmp_path: Path, beside: bool
) -> None:
    path = attempt(tmp_path / "s", "bad")
    assert list_sessions(path.parent)[0].problems == ()
    if not beside:
        sidecar(path).unlink()
    condemn()
    (summary,) = list_sessions(path.parent)
    assert summary.calibration == "bad"
    assert "the left camera was bumped" in summary.problems[-1]
    assert read_summary(path).problems == ()  # the record itself stays as it is


@pytest.mark.parametrize("calibration", ["good", ""])
def test_other_attempts_are_not_flagged(tmp_path: Path, calibration: str) -> None:
    path = attempt(tmp_path / "s", calibration)
    condemn()
    assert list_sessions(path.parent)[0].problems == ()


def test_a_history_that_cannot_be_read_is_told_with_the_attempts_that_need_it(
    tmp_path: Path,
) -> None:
    (tmp_path / "history.yaml").write_text("calibrations: 3\n")
    flags = CalibrationFlags.read(tmp_path)
    assert "not known" in flags.problem("any")
    assert flags.problem("") == ""


def test_an_attempt_from_before_calibrations_were_recorded_has_none(tmp_path: Path) -> None:
    path = attempt(tmp_path / "s", "")
    text = sidecar(path).read_text().replace(' "calibration": "",\n', "")
    sidecar(path).write_text(text)
    assert read_summary(path).calibration == ""
    assert HistoryFile().active is None
