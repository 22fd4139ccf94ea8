"""Structures of risk: how near the needle came, in the record, the score and the replay."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from session_fakes import Bench

from app.core.errors import AcusError
from app.core.events import Event
from app.imaging.series import Series
from app.imaging.structures.distance import SignedDistance
from app.imaging.structures.structure import Structure
from app.imaging.volume import Volume
from app.scoring.errors import TrajectoryError
from app.scoring.risks import RiskMark
from app.session.recording import read_recording
from app.session.replay import contents
from app.session.risks import Risk, event_of, mark_sentence, risk_marks

ENTRY = np.array([-12.5, -98.0, 310.2])
"""Of the bench's plan, DICOM LPS [mm]; the path runs along +P."""


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    yield bench
    bench.trainer.close()


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> SignedDistance:
    """Voxels of 1 mm that fill a box whose corners are given beside the entry, L, P, S [mm]."""
    size = (60, 110, 60)
    affine = np.eye(4)
    affine[:3, 3] = ENTRY + [-29.5, -19.5, -29.5]
    series = Series("2.25.1", "CT", "", size, None, None, None, True, "", (), "p", "", ())
    volume = Volume(np.zeros(size[::-1], np.int16), affine, series)
    k, j, i = np.indices(volume.hu.shape)
    at = volume.lps_mm(np.stack([i, j, k], axis=-1).reshape(-1, 3)) - ENTRY
    mask = ((at > low) & (at < high)).all(axis=1).reshape(volume.hu.shape)
    return SignedDistance.of(Structure.of("box", mask, volume))


BESIDE = ((4.0, 20.0, -5.0), (12.0, 30.0, 5.0))
BEYOND = ((-6.0, 50.0, -6.0), (6.0, 60.0, 6.0))


def attempt(bench: Bench, *risks: Risk, depth: float = 0.04):
    """Insert to a depth, end, and return the result."""
    bench.trainer._risks = risks
    bench.run(0.2)
    bench.trainer.begin("s")
    bench.insertion(depth)
    return bench.trainer.end()


@pytest.mark.long("machine")
def test_how_near_the_needle_came_is_in_record_and_score(bench: Bench) -> None:
    result = attempt(bench, Risk("vessel", 5.0, box(*BESIDE)), Risk("lung", 3.0, box(*BEYOND)))
    assert result.record is not None
    recording = read_recording(result.record)
    vessel, lung = risk_marks(recording.events)
    assert vessel.closest_mm == pytest.approx(4.0, abs=0.2)  # the shaft passes it
    assert vessel.breach_mm == pytest.approx(1.0, abs=0.2)
    assert lung.closest_mm == pytest.approx(10.0, abs=0.5)  # the tip stays before it
    assert lung.breach_mm == 0.0
    assert vessel.inside_s == lung.inside_s == 0.0
    assert lung.depth_mm == pytest.approx(40.0, abs=0.5)
    values = {row.name: row.value for row in result.score.rows}
    assert values["risk_breach"] == pytest.approx(vessel.breach_mm)
    assert values["risk_distance"] == pytest.approx(vessel.closest_mm)
    assert recording.trajectory().risks == (vessel, lung)
    listed = contents(recording)
    assert any("vessel" in line and "too near" in line for line in listed.sentences())
    assert [row["structure"] for row in listed.document()["risks"]] == ["vessel", "lung"]


def test_a_needle_inside_is_negative_and_scores_no_distance(bench: Bench) -> None:
    result = attempt(bench, Risk("lung", 3.0, box(*BEYOND)), depth=0.056)
    values = {row.name: row.value for row in result.score.rows}
    assert values["risk_distance"] == 0.0
    assert values["risk_breach"] == pytest.approx(3.0 + 5.0, abs=0.1)  # 5 mm in
    (mark,) = result.trajectory.risks
    assert "deep in lung" in mark_sentence(mark)
    assert mark.inside_s is not None
    assert 0.0 < mark.inside_s <= result.duration
    assert values["risk_time"] == mark.inside_s
    assert "; inside for " in mark_sentence(mark)
    assert risk_marks([event_of(mark)]) == (mark,)


@pytest.mark.long("machine")
def test_structures_move_with_the_target(bench: Bench) -> None:
    bench.loop.extra = {"target_shift_y": 0.008}  # towards the head
    upwards = ((-5.0, 20.0, 6.0), (5.0, 30.0, 16.0))
    downwards = ((-5.0, 20.0, -16.0), (5.0, 30.0, -6.0))
    attempt(bench, Risk("up", 1.0, box(*upwards)), Risk("down", 1.0, box(*downwards)))
    up, down = bench.trainer.result.trajectory.risks
    assert up.closest_mm == pytest.approx(14.0, abs=0.5)
    assert down.closest_mm == pytest.approx(-2.0, abs=0.5)


@pytest.mark.long("machine")
def test_without_risks_or_outside_the_body_there_is_nothing_to_score(bench: Bench) -> None:
    result = attempt(bench)
    assert not [row.name for row in result.score.rows if "risk" in row.name]
    bench.trainer._risks = (Risk("vessel", 5.0, box(*BESIDE)),)
    bench.run(1.0, -0.02)
    bench.trainer.begin("s")
    bench.run(0.5, -0.02)
    outside = bench.trainer.end()
    assert outside.trajectory is not None
    assert outside.trajectory.risks == ()


@pytest.mark.parametrize(
    "change",
    [{"limit_mm": -1.0}, {"limit_mm": None}, {"closest_mm": float("nan")}, {"closest_mm": "x"},
     {"structure": None, "depth_mm": {}}],
)  # fmt: skip
def test_a_damaged_event_is_left_out(change: dict[str, object]) -> None:
    mark = RiskMark("vessel", 5.0, 4.0, 12.0, 40.0)
    event = event_of(mark)
    assert risk_marks([event]) == (mark,)
    damaged = replace(event, data=dict(event.data) | change)
    assert risk_marks([damaged, Event(1.0, "state", "x", {})]) == ()


def test_a_mark_that_is_none_is_refused() -> None:
    with pytest.raises(TrajectoryError, match="finite"):
        RiskMark("x", -1.0, 0.0)
    assert issubclass(TrajectoryError, AcusError)


def plate(depth_mm: float) -> SignedDistance:
    """Return the distances of one layer of 0.7 mm voxels across the path, its middle at a depth."""
    size = (60, 110, 60)
    affine = np.diag([0.7, 0.7, 0.7, 1.0])
    affine[:3, 3] = ENTRY + [-20.65, depth_mm - 70.0 * 0.7, -20.65]
    series = Series("2.25.1", "CT", "", size, None, None, None, True, "", (), "p", "", ())
    volume = Volume(np.zeros(size[::-1], np.int16), affine, series)
    mask = np.zeros(volume.hu.shape, bool)
    mask[:, 70] = True
    return SignedDistance.of(Structure.of("plate", mask, volume))


@pytest.mark.long("machine")
@pytest.mark.parametrize("depth_mm", [20.0, 24.3, 30.15, 33.33])
def test_the_time_inside_a_plate_of_one_voxel_is_that_since_the_tip_reached_it(
    bench: Bench, depth_mm: float
) -> None:
    result = attempt(bench, Risk("plate", 1.0, plate(depth_mm)))
    assert result.record is not None
    recording = read_recording(result.record)
    samples = recording.samples
    within = samples.valid & (1000.0 * samples.depth >= depth_mm - 0.35)
    spans = np.diff(samples.time, append=samples.time[-1])
    (mark,) = risk_marks(recording.events)
    assert spans[within].sum() > 0.1
    period = float(np.median(spans))
    assert mark.inside_s == pytest.approx(float(spans[within].sum()), abs=1.5 * period)
    assert mark.closest_mm < 0.0
