"""What a student chooses for a control scan: current, gaps, a tilt, and whether he leaves."""

import hashlib
import json
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from session_fakes import EXERCISE, Bench

from app.core.events import Event
from app.exercises.guidance import HAND_USV_PER_MAS, ROTATION_S, GuidancePart, ScanChoice
from app.exercises.parts import NeedlePart
from app.imaging.errors import ScanOrderError
from app.imaging.scan_order import ScanNeedle, ScanOrder, ScanTip, Seen
from app.session.control_scan import INNER_MM, ControlScan, scan_marks, scans_of
from app.session.errors import IllegalTransitionError
from app.session.procedure import ToolInHand
from app.session.recording import read_recording
from app.session.replay import contents

ASKED = GuidancePart(
    streak=True, tube_current=(20.0, 50.0, 100.0), leave_room_s=20.0, gantry_tilt=True,
    interval_mm=8.0, needle_ends="drawn", breath="layers",
)  # fmt: skip


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    bench.trainer._exercise = SimpleNamespace(
        **vars(EXERCISE) | {"guidance": ASKED, "needle": NeedlePart(gauge=20)}
    )
    bench.run(0.2)
    bench.trainer.begin("s")
    bench.insertion(0.04)
    bench.trainer.events.drain()
    yield bench
    bench.trainer.close()


def order(**changes: float) -> ScanOrder:
    return ScanOrder(**{"centre_mm": 310.2, "slices": 3, "slice_mm": 5.0, "interval_mm": 8.0}
                     | changes)  # type: ignore[arg-type]  # fmt: skip


def taken(bench: Bench) -> tuple[ControlScan, ...]:
    return scans_of(bench.trainer.events.drain())


@pytest.mark.long("machine")
def test_who_stays_gets_the_scan_at_once_and_a_dose_of_the_hand(bench: Bench) -> None:
    assert bench.trainer.scan(order(), ScanChoice(50.0)) == 1
    (scan,) = taken(bench)
    assert scan.dose == pytest.approx(3 * 3.85 * 50.0 / 150.0)
    assert scan.hand_usv == pytest.approx(HAND_USV_PER_MAS * 50.0 * ROTATION_S)
    assert HAND_USV_PER_MAS == pytest.approx(0.101, abs=0.001)  # 220 µSv over 2178 mAs
    assert scan.look.noise_hu == pytest.approx(4.0 * np.sqrt(150.0 / 50.0 - 1.0))


@pytest.mark.long("machine")
def test_who_leaves_waits_in_the_attempts_own_time_which_counts(bench: Bench) -> None:
    began = bench.trainer.snapshot().elapsed
    assert bench.trainer.scan(order(), ScanChoice(50.0, leaves=True)) == 0
    bench.run(9.8)
    assert taken(bench) == ()
    assert bench.trainer.snapshot().out_of_room == pytest.approx(10.2, abs=0.1)
    bench.run(0.4)
    (scan,) = taken(bench)
    assert (scan.hand_usv, scan.choice.leaves) == (0.0, True)
    bench.run(9.9)
    snapshot = bench.trainer.snapshot()
    assert snapshot.out_of_room is None
    assert snapshot.elapsed - began == pytest.approx(20.1, abs=0.1)
    words = [event.message for event in bench.trainer.events.drain() if event.kind == "room"]
    assert words == ["the student is back at the patient"]


@pytest.mark.long("machine")
def test_nobody_is_at_the_needle_meanwhile(bench: Bench) -> None:
    bench.trainer.scan(order(), ScanChoice(50.0, leaves=True))
    bench.run(1.0)
    depth = bench.trainer.snapshot().pose.depth
    bench.trainer.hand(0.1, 0.0, 0.06)
    bench.run(1.0)
    assert bench.trainer.snapshot().pose.depth == pytest.approx(depth, abs=1e-6)
    with pytest.raises(IllegalTransitionError, match=r"back in 18 s"):
        bench.trainer.scan(order(), ScanChoice(50.0))
    bench.run(19.0)
    bench.trainer.hand(0.0, 0.0, 0.045)
    bench.run(0.2)
    assert bench.trainer.snapshot().pose.depth == pytest.approx(0.045, abs=1e-3)


@pytest.mark.long("machine")
def test_a_needle_that_nobody_sees_from_outside_is_told_and_not_counted(bench: Bench) -> None:
    bench.trainer.scan(order(), ScanChoice(50.0, leaves=True))
    bench.tracker.status = "out_of_view"
    bench.run(10.2)
    told = [event.message for event in bench.trainer.events.drain() if event.kind == "room"]
    assert any("not measured" in words for words in told)
    assert bench.trainer.snapshot().scans == 0


@pytest.mark.long("machine")
def test_an_attempt_that_ends_outside_has_no_scan(bench: Bench) -> None:
    bench.trainer.scan(order(), ScanChoice(50.0, leaves=True))
    result = bench.trainer.end()
    assert result.scans == 0
    assert bench.trainer.snapshot().out_of_room is None


@pytest.mark.long("machine")
@pytest.mark.parametrize(
    ("changes", "choice", "words"),
    [({}, ScanChoice(30.0), "30 mA: the exercise offers 20, 50, 100 mA"),
     ({}, ScanChoice(0.0), "0 mA"), ({}, ScanChoice(None), r"\? mA")],
)  # fmt: skip
def test_a_current_that_is_not_offered_is_refused(bench, changes, choice, words) -> None:
    with pytest.raises(ScanOrderError, match=words) as refused:
        bench.trainer.scan(order(**changes), choice)
    assert "\n" not in str(refused.value)
    assert bench.trainer.snapshot().scans == 0


@pytest.mark.long("machine")
def test_what_an_exercise_does_not_offer_is_refused(bench: Bench) -> None:
    plain = GuidancePart()
    for wanted, choice, words in (
        (order(tilt_deg=5.0), ScanChoice(), "keeps it straight"),
        (order(), ScanChoice(50.0), "leaves no choice"),
        (order(), ScanChoice(leaves=True), "no time for leaving"),
    ):
        with pytest.raises(ScanOrderError, match=words):
            plain.check(wanted, choice)


@pytest.mark.long("machine")
def test_the_record_gives_every_choice_back_and_lists_it(bench: Bench) -> None:
    bench.trainer.scan(order(tilt_deg=10.0, pivot_mm=-60.0), ScanChoice(20.0))
    bench.trainer.scan(order(), ScanChoice(100.0, leaves=True))
    bench.run(21.0)
    before = taken(bench)
    result = bench.trainer.end()
    assert result.record is not None
    recording = read_recording(result.record)
    after = scans_of(recording.events)
    assert [json.dumps(s.data()) for s in after] == [json.dumps(s.data()) for s in before]
    assert after[0].order == before[0].order
    assert after[0].look == before[0].look
    assert after[0].data()["version"] == 3
    text = "\n".join(contents(recording).sentences())
    assert "every 8 mm, gantry tilted by 10°, 20 mA, hand 1.0 µSv (teaching estimate)" in text
    assert "every 8 mm, 100 mA, out of the room" in text
    marks = recording.trajectory().scans
    assert [mark.hand_usv for mark in marks] == pytest.approx([1.01, 0.0], abs=0.01)


@pytest.mark.long("machine")
def test_the_exercises_own_needle_is_drawn_and_a_stylet_that_is_out_leaves_it_hollow(bench) -> None:
    bench.trainer.scan(order(), ScanChoice(50.0))
    bench.trainer._procedure = SimpleNamespace(tool=ToolInHand.OPEN, ablation=None)
    bench.trainer.scan(order(), ScanChoice(50.0))
    solid, hollow = taken(bench)
    assert (solid.needle.radius_mm, solid.needle.tip) == (pytest.approx(0.454), ScanTip.CONE)
    assert not solid.needle.hollow
    assert hollow.needle.hollow
    assert hollow.needle.bore_mm == pytest.approx(INNER_MM[20] / 2)
    assert "stylet out" in hollow.chosen


@pytest.mark.long("machine")
def test_a_tip_in_a_gap_is_told(bench: Bench) -> None:
    bench.trainer.scan(order(centre_mm=306.2), ScanChoice(50.0))
    (scan,) = taken(bench)
    assert scan.seen is Seen.BETWEEN
    assert "gap" in scan.sentence(0.0)


def test_a_plain_scan_is_recorded_as_before_to_the_last_bit() -> None:
    bent = np.array([[-3.0, -20.0, 131.0], [-2.0, -5.0, 131.5], [0.0, 6.0, 132.5]])
    needle = ScanNeedle(bent[0], bent[-1], corners_mm=bent)
    shift = np.array([1.0, -2.0, 3.0])
    scan = ControlScan(1, 3.0, ScanOrder(130.3, 4, 4.0), needle, shift, 15.4, True)
    content = json.dumps(scan.data()).encode()
    assert hashlib.sha256(content).hexdigest()[:16] == "ea6bc8979f241a07"  # as version 2 had it


def test_an_older_event_is_read_and_a_damaged_new_one_counted() -> None:
    needle = ScanNeedle(np.zeros(3), np.array([0.0, 0.0, 50.0]))
    plain = ControlScan(1, 3.0, ScanOrder(10.0), needle, np.zeros(3), 11.55)
    data = {"number": 1} | plain.data()
    read = ControlScan.of(Event(3.0, "scan", "", data))
    assert read is not None
    assert (read.hand_usv, read.choice, read.chosen) == (None, ScanChoice(), "")
    for damaged in ({"look": 7}, {"stack": {"interval_mm": "x"}}, {"metal": {"tip": "round"}},
                    {"stack": {"tilt_deg": 40.0}}, {"look": {"target_mm": [1, 2]}}):  # fmt: skip
        assert ControlScan.of(Event(3.0, "scan", "", data | damaged)) is None
    marks = scan_marks([Event(3.0, "scan", "", data | {"hand_usv": -1.0})])
    assert [mark.hand_usv for mark in marks] == [None]
