"""Control scans of an attempt: what they saw, what they cost, and what the record keeps."""

import json
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from session_fakes import EXERCISE, Bench

from app.core.events import Event
from app.exercises.guidance import GuidancePart
from app.imaging.scan_order import ScanOrder, Seen
from app.session.control_scan import ControlScan, scan_marks, scans_of
from app.session.errors import IllegalTransitionError, ScanNotPossibleError
from app.session.recording import read_recording
from app.session.replay import contents


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    yield bench
    bench.trainer.close()


def scanned(bench: Bench, *orders: ScanOrder) -> tuple[ControlScan, ...]:
    """Insert to 40 mm, taking these scans there."""
    bench.run(0.2)
    bench.trainer.begin("s")
    bench.insertion(0.04)
    for order in orders:
        bench.trainer.scan(order)
    return scans_of(bench.trainer.events.drain())


@pytest.mark.long("machine")
def test_a_scan_knows_where_the_needle_was_in_the_patient(bench: Bench) -> None:
    (scan,) = scanned(bench, ScanOrder(310.2, 3, 5.0))
    np.testing.assert_allclose(scan.needle.tip_mm, (-12.5, -98.0 + 40.0, 310.2), atol=0.5)
    assert scan.needle.length_mm == pytest.approx(200.0, abs=1.0)
    assert scan.seen is Seen.TIP
    assert scan.dose == pytest.approx(3 * 3.85)
    np.testing.assert_allclose(scan.shift_mm, 0.0, atol=1e-9)


@pytest.mark.long("machine")
def test_a_tip_outside_the_range_is_not_seen_and_costs_the_same(bench: Bench) -> None:
    inside, beside = scanned(bench, ScanOrder(310.2, 3, 5.0), ScanOrder(340.0, 5, 5.0))
    assert (inside.seen, beside.seen) == (Seen.TIP, Seen.NOTHING)
    assert beside.dose == pytest.approx(5 * 3.85)
    assert [inside.number, beside.number] == [1, 2]


@pytest.mark.long("machine")
def test_breathing_is_kept_with_the_scan(bench: Bench) -> None:
    bench.loop.extra = {"target_shift_y": 0.008}
    (scan,) = scanned(bench, ScanOrder(310.2))
    np.testing.assert_allclose(scan.shift_mm, (0.0, 0.0, 8.0), atol=1e-9)


@pytest.mark.long("machine")
def test_count_and_dose_are_metrics_of_the_attempt_and_of_its_record(bench: Bench) -> None:
    scanned(bench, ScanOrder(310.2), ScanOrder(311.0, 4))
    bench.trainer.scan()  # counted only
    result = bench.trainer.end()
    assert result.scans == 3
    assert result.score is not None
    values = {row.name: row.value for row in result.score.rows}
    assert values["control_scans"] == 3.0
    assert values["notional_dose"] == pytest.approx(7 * 3.85)
    assert result.record is not None
    again = read_recording(result.record).trajectory()
    assert [mark.dose for mark in again.scans] == pytest.approx([11.55, 15.4, 0.0])


@pytest.mark.long("machine")
def test_the_record_gives_the_same_scans_back_and_lists_them_for_a_replay(bench: Bench) -> None:
    before = scanned(bench, ScanOrder(310.2), ScanOrder(330.0, 5, 2.5))
    record = bench.trainer.end().record
    assert record is not None
    recording = read_recording(record)
    after = scans_of(recording.events)
    assert [json.dumps(s.data()) for s in after] == [json.dumps(s.data()) for s in before]
    listed = contents(recording)
    text = "\n".join(listed.sentences())
    assert "control scan 2" in text
    assert "teaching estimate" in text
    assert [s["seen"] for s in listed.document()["scans"]] == ["tip", "nothing"]


@pytest.mark.long("machine")
def test_a_scan_says_by_itself_what_its_pictures_showed(bench: Bench) -> None:
    bench.trainer._exercise = SimpleNamespace(
        **vars(EXERCISE) | {"guidance": GuidancePart(streak=True)}
    )
    (scan,) = scanned(bench, ScanOrder(310.2, 4, 2.5))
    data = scan.data()
    assert scan.streak is True
    assert (data["version"], data["streak"]) == (2, True)
    assert data["range_mm"] == [305.2, 315.2]


@pytest.mark.long("machine")
def test_a_needle_that_nobody_sees_is_not_scanned_and_nothing_is_counted(bench: Bench) -> None:
    bench.run(0.2)
    bench.trainer.begin()
    bench.insertion(0.04)
    bench.tracker.status = "out_of_view"
    bench.run(0.5)
    with pytest.raises(ScanNotPossibleError, match="not measured"):
        bench.trainer.scan(ScanOrder(310.2))
    assert bench.trainer.snapshot().scans == 0


def test_a_scan_without_an_attempt_is_refused(bench: Bench) -> None:
    with pytest.raises(IllegalTransitionError, match="begin an attempt first"):
        bench.trainer.scan(ScanOrder(310.2))


@pytest.mark.parametrize(
    "data",
    [{}, {"number": 1}, {"number": 1, "order": 7}, {"number": 1, "order": {"centre_mm": "x"}},
     {"number": 1, "order": {"centre_mm": 1.0, "slices": 99, "slice_mm": 5.0}}],
)  # fmt: skip
def test_a_damaged_event_is_counted_and_shows_nothing(data: dict[str, object]) -> None:
    event = Event(1.0, "scan", "control scan", data)
    assert ControlScan.of(event) is None
    assert [mark.dose for mark in scan_marks([event])] == [0.0]
