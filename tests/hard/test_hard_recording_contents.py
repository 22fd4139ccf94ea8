"""Records whose contents are no numbers, of another shape, or somebody else's."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hard.recording_rig import PLACED, WALL, pose, write
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.stream_reader import StreamReader

from app.core.clock import VirtualClock
from app.session.errors import RecordingError
from app.session.facts import PLAN, plan_record
from app.session.header import SessionHeader
from app.session.machine import State
from app.session.recorder import Recorder
from app.session.recording import read_recording
from app.session.sample import Sample, encode
from app.session.scan import scan
from app.session.sidecar import read_summary
from app.session.store import find, list_sessions


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_a_pose_that_is_no_number_stands_as_null_in_the_record(tmp_path: Path, bad: float) -> None:
    path = write(tmp_path, 1.0, bad=bad)
    with path.open("rb") as stream:
        for record in StreamReader(stream).records:
            data = getattr(record, "data", b"")
            if type(record).__name__ == "Message" and data[:1] == b"{":
                json.loads(data, parse_constant=pytest.fail)
    recording = read_recording(path)
    assert np.isnan(recording.samples.depth).sum() == 1
    trajectory = recording.trajectory()
    assert len(trajectory) == len(recording.samples.time)  # its force counts all the same
    assert not trajectory.depth_valid[np.isnan(recording.samples.depth)].any()


@pytest.mark.promise("docs/sessions.md: NaN never stands in a file")
@settings(derandomize=True, deadline=None, max_examples=100)
@given(
    st.recursive(
        st.one_of(st.floats(), st.integers(), st.text(max_size=5), st.none(), st.booleans()),
        lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner),
        max_leaves=8,
    )
)
def test_whatever_is_encoded_is_strict_json(document: object) -> None:
    json.loads(encode(document), parse_constant=pytest.fail)


def test_samples_at_equal_times_are_scored_once(tmp_path: Path) -> None:
    clock = VirtualClock(50.0)
    header = SessionHeader("b", WALL, 50.0, "s", "e", metadata={PLAN: plan_record(PLACED)})
    recorder = Recorder(tmp_path, header, clock=clock)
    recorder.open()
    for depth in (0.01, 0.02, 0.03):
        recorder.sample(Sample(50.0, State.INSERTING, pose(50.0, depth), None, np.zeros(3)))
    recorder.finish()
    assert len(read_recording(recorder.status().path).trajectory()) == 1


BAD_MESSAGES = [
    ("/attempt", "timestamp", None),
    ("/attempt", "timestamp", {"sec": "x", "nsec": 0}),
    ("/attempt", "time", 10**400),
    ("/attempt", "time", {}),
    ("/attempt", "state", []),
    ("/attempt", "valid", []),
    ("/attempt", "tip", {"x": 1.0}),
    ("/attempt", "tip", {"x": "a", "y": 0.0, "z": 0.0}),
    ("/events", "data", "x"),
    ("/events", "data", None),
    ("/events", "message", 5),
]


@pytest.mark.parametrize(("topic", "field", "value"), BAD_MESSAGES)
def test_a_message_of_another_shape_is_left_out_and_said(
    tmp_path: Path, topic: str, field: str, value: object
) -> None:
    path = write(tmp_path, 1.0)
    whole = read_recording(path)
    content = scan(path)
    document = json.loads(content.messages[topic][0]) | {field: value}
    clock = VirtualClock(50.0)
    recorder = Recorder(tmp_path, SessionHeader("b", WALL, 50.0, "s-1", "liver-01"), clock=clock)
    recorder.open()
    for data in content.messages[topic]:
        recorder._file.message(topic, 1, data)
    recorder._file.message(topic, 1, json.dumps(document).encode())
    recorder.finish()
    part = read_recording(recorder.status().path)
    assert len(part.samples.time) == (len(whole.samples.time) if topic == "/attempt" else 0)
    assert len(part.events) == (len(whole.events) if topic == "/events" else 0)
    assert any(topic in problem for problem in part.problems)


@pytest.mark.parametrize(
    "change",
    [
        {"version": 2},
        {"scans": math.inf},
        {"student": "\ud800"},
        {"score": {"total": "abc"}},
        {"score": {"total": 1.0, "rows": None}},
        {"score": {"total": 1.0, "rows": [1]}},
        {"score": {"total": 1.0, "rows": [{"name": "x"}]}},
        {"score": [["total", 1.0]]},
    ],
)
def test_a_summary_that_is_not_ours_is_made_again_from_the_record(
    tmp_path: Path, change: dict[str, object]
) -> None:
    path = write(tmp_path, 1.0)
    fresh = read_summary(path)
    path.with_suffix(".json").write_text(json.dumps(fresh.document() | change), encoding="utf-8")
    assert read_summary(path) == fresh
    path.with_suffix(".json").write_text("[" * 100_000, encoding="utf-8")
    assert read_summary(path) == fresh


def test_a_renamed_record_is_listed_by_the_name_that_finds_it(tmp_path: Path) -> None:
    path = write(tmp_path, 1.0)
    path.rename(tmp_path / "renamed.mcap")
    (summary,) = list_sessions(tmp_path)
    assert find(tmp_path, summary.id) == tmp_path / "renamed.mcap"


def test_a_file_in_place_of_the_folder_is_said_to_be_one(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    recorder = Recorder(tmp_path / "file", SessionHeader("a", WALL, 50.0, "s-1", "liver-01"))
    with pytest.raises(RecordingError, match="is a file, not a folder"):
        recorder.open()
