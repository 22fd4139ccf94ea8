"""The record: readable by everybody's MCAP reader, complete, honest about what is lost."""

import errno
import json
import os
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import jsonschema
import numpy as np
import pytest
from mcap.reader import make_reader
from session_fakes import WALL, Bench, row

from app.core import state_vector as sv
from app.core.clock import SystemClock, VirtualClock
from app.core.disclaimer import DISCLAIMER
from app.core.events import Event
from app.core.rotation import rotation_exp
from app.session import blocks
from app.session.budget import ReadingBudget
from app.session.errors import BrokenRecordingError, RecordingError, SessionError
from app.session.header import SessionHeader, new_id, pseudonym
from app.session.reasons import AttemptEvidence
from app.session.recorder import Recorder
from app.session.recording import read_recording
from app.session.review import review
from app.session.sample import quaternion
from app.session.schemas import CHANNELS
from app.session.scored import seen_from


def budget() -> ReadingBudget:
    return ReadingBudget("a.mcap", 1 << 20)


def header(session_id: str = "a-1", **values: object) -> SessionHeader:
    return SessionHeader(session_id, WALL, 100.0, "s-1", "liver-01", **values)


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Path:
    bench = Bench(tmp_path_factory.mktemp("record"))
    bench.run(0.1)
    bench.trainer.begin("s-7f3a")
    bench.insertion(0.06, x=0.05)
    bench.trainer.scan()
    result = bench.trainer.end()
    assert result.record is not None
    return result.record


def test_mcaps_own_reader_takes_the_file_with_all_its_checks(record: Path) -> None:
    with record.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        summary = reader.get_summary()
        assert summary is not None
        assert {c.topic for c in summary.channels.values()} == set(CHANNELS)
        counts: dict[str, int] = {}
        for _, channel, _ in reader.iter_messages():
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
        assert counts.keys() == set(CHANNELS)
        names = {m.name for m in reader.iter_metadata()}
        assert {"session", "exercise", "software", "device", "plan", "result"} <= names
        names = {a.name for a in reader.iter_attachments()}
        assert names == {"plan.mrk.json", "score.json", "samples.acus"}


def test_the_json_messages_keep_their_schemas(record: Path) -> None:
    validators, seen = {}, dict.fromkeys(CHANNELS, 0)
    with record.open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            if schema is None:
                continue
            document = json.loads(message.data, parse_constant=pytest.fail)
            stamp = document["timestamp"]
            assert stamp["sec"] * 10**9 + stamp["nsec"] == message.log_time
            assert (channel.message_encoding, schema.encoding) == ("json", "jsonschema")
            seen[channel.topic] += 1
            if seen[channel.topic] % 25 != 1:  # jsonschema is slow
                continue
            if schema.id not in validators:
                validators[schema.id] = jsonschema.Draft202012Validator(json.loads(schema.data))
            validators[schema.id].validate(document)


def test_json_channels_stay_at_or_below_100_hz(record: Path) -> None:
    with record.open("rb") as stream:
        times: dict[str, list[int]] = {}
        for _, channel, message in make_reader(stream).iter_messages(topics=["/attempt"]):
            times.setdefault(channel.topic, []).append(message.log_time)
    assert np.diff(times["/attempt"]).min() >= 0.00999e9


def test_log_times_are_wall_clock_at_the_beginning_and_monotonic_after() -> None:
    assert header().nanoseconds(100.0) == round(WALL.timestamp() * 1e3) * 10**6
    assert header().nanoseconds(101.5) - header().nanoseconds(100.0) == 1_500_000_000
    assert header().nanoseconds(-1e12) == 0


def test_the_head_holds_the_pseudonym_the_seed_and_the_disclaimer(record: Path) -> None:
    session = read_recording(record).metadata["session"]
    assert session["student"] == "s-7f3a"
    assert session["seed"] == "7"
    assert session["note"] == DISCLAIMER
    assert session["started"] == "2026-01-15T09:31:22.418+00:00"


def test_events_stand_in_the_record_in_order(record: Path) -> None:
    events = read_recording(record).events
    assert [e.kind for e in events] == ["state", "state", "state", "scan", "state"]
    assert events[3].data["number"] == 1
    assert len(events[3].data["tip_m"]) == 3
    assert all(a.time <= b.time for a, b in pairwise(events))


def test_blocks_give_back_every_bit() -> None:
    rng = np.random.default_rng(2)
    rows = rng.normal(size=(101, sv.SLOTS))
    rows[:, sv.TICK] = np.arange(7, 108)
    block = blocks.unpack(blocks.pack(rows, 5), budget())
    assert (block.first_tick, block.lost) == (7, 5)
    indices = [sv.INDEX[name] for name in blocks.COLUMNS]
    acts = (rows[:, sv.TRAINEE_PHASE] > 0.0) & (rows[:, sv.ENABLED] > 0.0)
    rows[np.ix_(acts, [sv.INDEX[name] for name in blocks.TRAINEE])] = np.nan
    np.testing.assert_array_equal(block.values, rows[:, indices])
    assert blocks.unpack(blocks.pack(np.empty((0, sv.SLOTS)), 0), budget()).values.shape[0] == 0


def test_a_block_holds_every_input_and_the_encoders() -> None:
    assert set(blocks.COLUMNS) >= {n for n, i in sv.INDEX.items() if i < sv.INPUTS}
    assert set(blocks.COLUMNS) >= {"time", "tick", "q_left", "q_right", "q_time"}


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda b: b"", "begin with"),
        (lambda b: b"XXXX" + b[4:], "begin with"),
        (lambda b: b[:4] + b"\x09\x00" + b[6:], "version 9"),
        (lambda b: b[:-1], "bytes"),
        (lambda b: b + b"\x00", "bytes"),
    ],
)
def test_a_spoilt_block_is_refused(spoil: Callable[[bytes], bytes], said: str) -> None:
    good = blocks.pack(np.zeros((3, sv.SLOTS)), 0)
    with pytest.raises(BrokenRecordingError, match=said):
        blocks.unpack(spoil(good), budget())


def test_the_thread_records_while_the_loop_runs(tmp_path: Path) -> None:
    clock, rows = SystemClock(), []
    recorder = Recorder(
        tmp_path, header(), lambda since: np.array(rows[since:]).reshape(-1, sv.SLOTS)
    )
    recorder.open()
    recorder.start()
    for tick in range(1, 31):
        rows.append(row(clock.now(), tick))
        time.sleep(0.01)
    recorder.event(Event(clock.now(), "scan", "one"))
    recorder.finish()
    recorder.finish()
    recording = read_recording(recorder.status().path)
    assert list(recording.inputs.column("tick")) == list(range(1, 31))
    assert recording.complete
    assert not [t for t in threading.enumerate() if t.name == "acus-recorder"]


@pytest.mark.long("journey")
def test_everything_older_than_a_second_is_on_the_disk_before_the_file_is_finished(
    tmp_path: Path,
) -> None:
    bench = Bench(tmp_path)
    bench.run(0.1)
    bench.trainer.begin()
    bench.run(5.0, 0.03)
    killed = tmp_path / "killed.mcap"
    killed.write_bytes(next(tmp_path.glob("2026*.mcap")).read_bytes())
    recording = read_recording(killed)
    assert not recording.complete
    assert recording.samples.time[-1] >= bench.clock.now() - 1.05
    assert recording.inputs.column("time")[-1] >= bench.clock.now() - 1.15
    assert recording.placed_plan().plan == bench.placed.plan
    bench.trainer.close()


def test_two_recorders_on_one_id_do_not_touch_each_others_file(tmp_path: Path) -> None:
    first, second = Recorder(tmp_path, header()), Recorder(tmp_path, header())
    first.open()
    before = first.status().path.read_bytes()
    with pytest.raises(RecordingError, match="exists already"):
        second.open()
    assert first.status().path.read_bytes() == before
    second.event(Event(1.0, "scan", "lost"))
    second.finish()
    assert "exists already" in second.status().failure
    first.finish()
    assert read_recording(first.status().path).complete


def test_a_full_disk_ends_the_record_and_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = VirtualClock(100.0)
    recorder = Recorder(tmp_path, header(), clock=clock)
    recorder.open()
    recorder.event(Event(100.0, "scan", "kept"))
    clock.sleep(1.1)
    recorder.drain()

    def full(descriptor: int, data: memoryview) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("app.session.mcap_file._write", full)  # no space set aside helps
    recorder.event(Event(101.2, "scan", "lost"))
    clock.sleep(1.1)
    recorder.drain()
    status = recorder.status()
    assert "No space left" in status.failure
    assert not status.active
    recorder.event(Event(102.0, "scan", "lost as well"))
    recorder.drain()
    recorder.finish()
    assert read_recording(status.path).events[0].message == "kept"


def test_a_real_full_device_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    recorder = Recorder(tmp_path, header())
    with Path("/dev/full").open("wb", buffering=0) as device:
        monkeypatch.setattr(
            "app.session.mcap_file._write", lambda _, data: os.write(device.fileno(), data)
        )
        with pytest.raises(RecordingError, match="No space left"):
            recorder.open()
    assert list(tmp_path.iterdir()) == []


def test_samples_that_a_full_queue_drops_are_counted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.session.recorder.QUEUE_LENGTH", 3)
    recorder = Recorder(tmp_path, header())
    recorder.open()
    for k in range(5):
        recorder.event(Event(100.0 + k, "scan", str(k)))
    assert recorder.status().lost_samples == 2
    recorder.finish()
    assert read_recording(recorder.status().path).metadata["result"]["lost_samples"] == "2"


@pytest.mark.parametrize("name", ["", "../x", "a/b", ".hidden", "x" * 65, "a\n"])
def test_an_id_that_is_no_file_name_is_refused(name: str) -> None:
    with pytest.raises(SessionError, match="not usable"):
        header(name)


def test_new_ids_differ_within_one_second() -> None:
    ids = {new_id(WALL) for _ in range(50)}
    assert len(ids) > 45
    assert all(i.startswith("20260115-093122-") for i in ids)


@pytest.mark.parametrize(
    ("given", "kept"),
    [("", "anonymous"), ("  ", "anonymous"), ("a\nb\x00", "a b"), ("é" * 99, "é" * 64)],
)
def test_a_pseudonym_is_one_short_line(given: str, kept: str) -> None:
    assert pseudonym(given) == kept


def test_quaternions_turn_vectors_as_their_matrices_do() -> None:
    rng = np.random.default_rng(8)
    vectors = [rng.normal(size=3) * scale for scale in (1e-9, 0.1, 1.0, 3.0) for _ in range(20)]
    vectors += [np.pi * axis for axis in np.eye(3)] + [np.zeros(3)]
    for vector in vectors:
        rotation = rotation_exp(vector)
        q = SimpleNamespace(**quaternion(rotation))
        assert q.w >= 0.0
        x, y, z, w = q.x, q.y, q.z, q.w
        again = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )
        np.testing.assert_allclose(again, rotation, atol=1e-12)


RIG = {
    "range": {"depth_min_mm": -30.0},
    "needle": {"marker_offset_mm": 10.0, "hidden_mm": [-200.0, 20.0]},
}
"""Cameras that would see a marker from 30 mm above the skin on, which a tube hides until its band
stands 20 mm below the fulcrum: there the tip is 10 mm deeper."""


def test_from_which_depth_on_cameras_see_the_marker_is_the_deeper_of_view_and_tube() -> None:
    def seen(**needle: object) -> float:
        rig = RIG | {"needle": {"marker_offset_mm": 10.0} | needle}
        return seen_from({"cameras.json": json.dumps(rig).encode()})

    assert seen() == pytest.approx(-0.030)
    assert seen(hidden_mm=None) == pytest.approx(-0.030)
    assert seen(hidden_mm=[-200.0, 20.0]) == pytest.approx(0.030)
    assert seen(hidden_mm=[-200.0, -80.0]) == pytest.approx(-0.030)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"range": {"depth_min_mm": NaN}, "needle": {}}'])
def test_nobody_knows_from_where_on_cameras_see_where_the_record_does_not_say_it(text: str) -> None:
    assert seen_from({"cameras.json": text.encode()}) == np.inf
    assert seen_from({}) == np.inf


def test_a_record_is_scored_by_the_cameras_that_it_holds(record: Path) -> None:
    recording = read_recording(record)
    own = dict(recording.attachments) | {"cameras.json": json.dumps(RIG).encode()}
    assert replace(recording, attachments=own).trajectory().seen_from == pytest.approx(0.030)


def test_what_the_cameras_of_a_record_cannot_tell_apart_reaches_the_reasons(
    record: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: list[float] = []

    def evidence(*parts: Any, **facts: Any) -> AttemptEvidence:
        given.append(facts.get("unsure_mm", 0.0))
        return AttemptEvidence(*parts, **facts)

    monkeypatch.setattr("app.session.review.AttemptEvidence", evidence)
    shown = review(read_recording(record))
    assert shown.tip_radius is not None
    assert given == [pytest.approx(shown.tip_radius * 1e3)]
    assert given[0] > 0.0
