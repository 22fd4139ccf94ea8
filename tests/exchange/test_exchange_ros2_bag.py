"""Bags of ROS 2: rosbags (pure Python, its own definitions and CDR) opens what we write."""

from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from scipy.spatial.transform import Rotation

from app.exchange.errors import ExportError
from app.exchange.ros2_bag import write_bag
from app.exchange.ros_messages import DEFINITIONS, cdr, definition
from app.exchange.ros_topics import TOPICS
from app.session.recording import read_recording

RECORDS = Path(__file__).parents[1] / "data" / "records"
STORE = get_typestore(Stores.LATEST)


@pytest.fixture(scope="module")
def recording():
    return read_recording(sorted(RECORDS.glob("*.mcap"))[0])


@pytest.fixture(scope="module")
def bag(recording, tmp_path_factory):
    folder = tmp_path_factory.mktemp("bags") / "attempt"
    write_bag(recording, folder)
    return folder


@pytest.mark.parametrize("kind", sorted(DEFINITIONS))
def test_definitions_are_those_of_ros(kind):
    assert STORE.fielddefs[kind][1] == get_types_from_msg(definition(kind), kind)[kind][1]


def test_cdr_is_that_of_rosbags_to_the_byte():
    """Names of odd lengths before numbers that must be aligned."""
    header = {"stamp": {"sec": -7, "nanosec": 123_456_789}, "frame_id": "é"}
    body = {
        "header": header, "name": ["a", "bcd", ""], "position": [1.5, -2.25, 1e300],
        "velocity": [], "effort": [0.0],
    }  # fmt: skip
    types = STORE.types
    theirs = types["sensor_msgs/msg/JointState"](
        header=types["std_msgs/msg/Header"](
            stamp=types["builtin_interfaces/msg/Time"](**header["stamp"]), frame_id="é"
        ),
        name=body["name"],
        **{part: np.array(body[part], dtype=np.float64) for part in ("position", "velocity",
                                                                     "effort")},
    )  # fmt: skip
    kind = "sensor_msgs/msg/JointState"
    assert cdr(kind, body) == bytes(STORE.serialize_cdr(theirs, kind))


def test_every_channel_has_a_schema_and_the_file_says_that_it_is_of_ros_2(bag):
    with (bag / "attempt_0.mcap").open("rb") as stream:
        reader = make_reader(stream)
        summary = reader.get_summary()
        assert reader.get_header().profile == "ros2"
    assert summary.channels
    for channel in summary.channels.values():
        assert channel.message_encoding == "cdr"
        assert summary.schemas[channel.schema_id].encoding == "ros2msg"
        assert summary.schemas[channel.schema_id].name == TOPICS[channel.topic].type


def test_rosbags_reads_every_message_and_finds_the_attempt_in_it(bag, recording):
    samples, placed = recording.samples, recording.placed_plan()
    counts, poses, wrenches = dict.fromkeys(TOPICS, 0), [], []
    with AnyReader([bag]) as reader:
        assert {one.topic for one in reader.connections} == set(TOPICS)
        previous = 0
        for connection, time, raw in reader.messages():
            message = reader.deserialize(raw, connection.msgtype)
            counts[connection.topic] += 1
            assert time >= previous
            previous = time
            if connection.topic == "/needle_pose":
                poses.append(message.pose.pose)
            elif connection.topic == "/hub_wrench":
                wrenches.append([message.wrench.force.x, message.wrench.force.y])
            elif connection.topic == "/image_points":
                points = message.data
        total = reader.message_count
    assert total == sum(counts.values())
    measured = samples.valid if samples.radius is None else (
        samples.valid & np.isfinite(samples.radius)
    )  # fmt: skip
    assert counts["/needle_pose"] == np.count_nonzero(measured) > 50
    tips = np.array([[p.position.x, p.position.y, p.position.z] for p in poses])
    np.testing.assert_array_equal(tips, samples.tip[measured])
    turns = Rotation.from_quat(
        [[getattr(p.orientation, axis) for axis in "xyzw"] for p in poses]
    ).apply([0.0, 0.0, 1.0])
    np.testing.assert_allclose(turns, samples.axis[measured], atol=1e-9)
    np.testing.assert_allclose(points, 1e-3 * np.r_[placed.plan.entry_mm, placed.plan.target_mm])
    assert counts["/acus/events"] > 0
    assert counts["/joint_states"] == len(wrenches) > 50


def test_the_bag_names_nobody(bag, recording):
    text = (bag / "metadata.yaml").read_text() + str((bag / "attempt_0.mcap").read_bytes())
    assert recording.metadata["session"]["student"] not in text


def test_nothing_is_left_of_a_bag_that_cannot_be_written(recording, tmp_path):
    (tmp_path / "there").mkdir()
    with pytest.raises(ExportError, match="is there already"):
        write_bag(recording, tmp_path / "there")
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="cannot be written"):
        write_bag(recording, tmp_path / "file" / "bag")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "there"]
