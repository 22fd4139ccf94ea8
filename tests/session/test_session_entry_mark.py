"""A marked entry is in the record and the score of attempts that begin at it."""

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from session_fakes import EXERCISE, Bench

from app.exercises.procedure import GridPart, ProcedurePart
from app.imaging.scan_order import ScanOrder
from app.imaging.skin_grid import GridPlace
from app.planning.entry_mark import EntryMark, NeedleAngles, mark_of
from app.scoring import metrics
from app.session.control_scan import scans_of
from app.session.recording import read_recording
from app.session.replay import contents

ENTRY = np.array([-12.5, -98.0, 310.2])


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    bench.trainer._exercise = SimpleNamespace(
        **vars(EXERCISE) | {"procedure": ProcedurePart(grid=GridPart(lines=11))}
    )
    yield bench
    bench.trainer.close()


def marked(at: np.ndarray, error: float = 3.5) -> EntryMark:
    planned = ENTRY + (3.0, 0.0, 1.8)
    return EntryMark(GridPlace(310.2, 6, 2.0), at, planned, error, NeedleAngles(0.0, 0.0))


def attempt(bench: Bench, mark: EntryMark | None):
    bench.run(0.2)
    bench.trainer.mark_entry(mark)
    bench.trainer.begin("s")
    bench.insertion(0.03)
    return bench.trainer.end()


@pytest.mark.long("journey")
def test_the_mark_is_told_recorded_and_scored(bench: Bench) -> None:
    result = attempt(bench, marked(ENTRY + (0.2, 0.0, 0.1)))
    assert result.record is not None
    recording = read_recording(result.record)
    (event,) = [e for e in recording.events if e.data.get("step") == "mark_entry"]
    assert mark_of(event.data).error_mm == 3.5
    assert "line 6 +2.0 mm: 3.5 mm on the skin from the planned entry" in event.message
    listed = contents(recording)
    assert any("line 6 +2.0 mm" in line for line in listed.sentences())
    assert listed.document()["entry_mark"]["line"] == 6
    assert metrics.find("entry_mark_error").compute(recording.trajectory()) == 3.5


@pytest.mark.long("journey")
@pytest.mark.parametrize("mark", [None, marked(ENTRY + (0.0, 0.0, 9.0))])
def test_a_mark_elsewhere_or_none_is_not_scored(bench: Bench, mark: EntryMark | None) -> None:
    from app.scoring.errors import MetricUnavailableError

    result = attempt(bench, mark)
    assert result.record is not None
    path = read_recording(result.record).trajectory()
    with pytest.raises(MetricUnavailableError, match="no entry was marked"):
        metrics.find("entry_mark_error").compute(path)


@pytest.mark.long("journey")
def test_scans_of_such_an_exercise_show_the_grid(bench: Bench) -> None:
    bench.run(0.2)
    bench.trainer.begin("s")
    bench.insertion(0.03)
    bench.trainer.scan(ScanOrder(310.2))
    (scan,) = scans_of(bench.trainer.events.drain())
    assert scan.look.grid is not None
    assert scan.look.grid.lines == 11
    assert scan.look.grid.up == pytest.approx((0.0, -1.0))
    np.testing.assert_allclose(scan.look.grid.centre_mm, (-12.5, -38.0, 310.2))
    assert scan.data()["version"] == 3
