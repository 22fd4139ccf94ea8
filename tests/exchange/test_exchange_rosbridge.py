"""rosbridge: what a plain web socket, roslibpy and SciPy's rotations make of it."""

import json
import subprocess
import sys
import time
from contextlib import contextmanager, suppress

import cbor2
import numpy as np
import pytest
from live_rig import HEAD_UP, PLAN, Stage, device, knock, needle, wait_for
from scipy.spatial.transform import Rotation
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from app.exchange.errors import LinkAddressError
from app.exchange.live.doors import Doors
from app.exchange.live.rosbridge import server as rosbridge_server
from app.exchange.moment import Validity
from app.exchange.ros_topics import TOPICS, quaternion, stamp

TOKEN = "a-token-of-twenty-signs"


@pytest.fixture
def stage():
    return Stage()


@contextmanager
def serving(stage, doors=None, port=0):
    server = rosbridge_server(stage, doors or Doors(), port)
    server.open()
    try:
        yield server
    finally:
        server.close()


@pytest.fixture
def server(stage):
    with serving(stage) as one:
        yield one


@contextmanager
def peer_of(server, path="", **options):
    with connect(f"ws://127.0.0.1:{server.port}/{path}", **options) as peer:
        yield peer


@pytest.fixture
def peer(server):
    with peer_of(server) as one:
        yield one


def say(peer, **document):
    peer.send(json.dumps(document))


def hear(peer, op="publish", timeout=3.0):
    """Return the next message of a kind."""
    end = time.monotonic() + timeout
    while True:
        data = peer.recv(timeout=max(0.0, end - time.monotonic()))
        document = cbor2.loads(data) if isinstance(data, bytes) else json.loads(data)
        if document["op"] == op:
            return document


def hear_one(peer, topic, **more):
    say(peer, op="subscribe", topic=topic, **more)
    return hear(peer)["msg"]


# --- what is told ---------------------------------------------------------------------------------
def test_quaternions_are_those_of_scipy():
    turns = Rotation.random(500, random_state=2)
    halves = Rotation.from_rotvec(np.pi * np.vstack([np.eye(3), -np.eye(3), np.ones(3) / 3**0.5]))
    for one in [*turns, *halves, Rotation.identity()]:
        found = quaternion(one.as_matrix())
        back = Rotation.from_quat([found[axis] for axis in "xyzw"])
        assert (back * one.inv()).magnitude() < 1e-12
        assert found["w"] >= 0.0


def test_times_are_whole_seconds_and_nanoseconds():
    assert stamp(1_700_000_000.25) == {"sec": 1_700_000_000, "nanosec": 250_000_000}
    assert stamp(-0.5) == {"sec": -1, "nanosec": 500_000_000}


def test_the_needle_is_in_metres_where_it_stands_in_the_robot_s_frame(peer):
    pose = hear_one(peer, "/needle_pose", type="geometry_msgs/msg/PoseWithCovarianceStamped")
    assert pose["header"]["frame_id"] == "world"
    assert pose["pose"]["pose"]["position"] == {"x": 0.05, "y": -0.04, "z": 0.02}
    turn = Rotation.from_quat([pose["pose"]["pose"]["orientation"][a] for a in "xyzw"])
    np.testing.assert_allclose(turn.apply([0, 0, 1]), [0.0, 0.6, -0.8], atol=1e-12)
    spread = np.array(pose["pose"]["covariance"]).reshape(6, 6)
    np.testing.assert_array_equal(np.diag(spread), [1e-6, 4e-6, 9e-6, 0, 0, 0])


def test_frames_lead_from_the_robot_to_patient_tip_and_hub(peer):
    frames = {one["child_frame_id"]: one for one in hear_one(peer, "/tf")["transforms"]}
    assert set(frames) == {"patient", "needle_tip_marker", "P_u"}
    patient = frames["patient"]["transform"]
    turn = Rotation.from_quat([patient["rotation"][axis] for axis in "xyzw"])
    np.testing.assert_allclose(turn.apply([0.0, 0.0, 1.0]), [0, 1, 0], atol=1e-12)  # head to +y
    assert patient["translation"] == {"x": 0.1, "y": 0.2, "z": 0.05}
    hub = frames["P_u"]["transform"]["translation"]
    np.testing.assert_allclose([hub[a] for a in "xyz"], [0.05, -0.16, 0.18], atol=1e-12)


def test_the_laboratory_s_topics_have_its_types_and_numbers(peer):
    plan = hear_one(peer, "/image_points", type="std_msgs/Float64MultiArray")  # spelled as in ROS 1
    assert plan["data"] == [0.01, -0.1, 0.2, 0.03, -0.05, 0.22]
    line = hear_one(peer, "/visualization_marker", type="visualization_msgs/msg/Marker")
    ends = [[one[axis] for axis in "xyz"] for one in line["points"]]
    np.testing.assert_allclose(ends, [[0.11, 0.4, 0.15], [0.13, 0.42, 0.10]], atol=1e-12)  # by hand
    assert (line["type"], line["header"]["frame_id"]) == (4, "world")
    assert hear_one(peer, "/angle_error", type="std_msgs/msg/Float64") == {"data": 0.05}
    say(peer, op="unsubscribe", topic="/angle_error")
    joints = hear_one(peer, "/joint_states", type="sensor_msgs/msg/JointState")
    assert (joints["name"], joints["position"]) == (["panto_a1", "panto_a5"], [2.1, 1.0])


def test_forces_are_newtons_at_the_hub(peer):
    wrench = hear_one(peer, "/hub_wrench", type="geometry_msgs/msg/WrenchStamped")["wrench"]
    assert wrench["force"] == {"x": 0.3, "y": -0.4, "z": 0.0}


def test_cbor_has_the_same_numbers_as_typed_arrays(peer):
    joints = hear_one(peer, "/joint_states", compression="cbor")
    tag = joints["position"]
    assert tag.tag == 86, "float64, little-endian (RFC 8746)"
    np.testing.assert_array_equal(np.frombuffer(tag.value, "<f8"), [2.1, 1.0])


def test_a_peer_may_speak_cbor_too(peer):
    peer.send(cbor2.dumps({"op": "subscribe", "topic": "/angle_error"}))
    assert hear(peer)["msg"] == {"data": 0.05}


def test_a_needle_that_is_not_valid_is_not_told_but_that_it_is_not(stage, peer):
    stage.change(needle=needle(Validity.OUT_OF_VIEW))
    assert hear_one(peer, "/acus/needle_validity") == {"data": "OUT_OF_VIEW"}
    say(peer, op="subscribe", topic="/needle_pose")
    with pytest.raises(TimeoutError):
        hear(peer, timeout=0.3)
    stage.change(needle=needle())
    assert hear(peer)


def test_nothing_waits_in_a_queue_and_a_throttle_is_kept(stage, peer):
    stage.change(device=None)
    say(peer, op="subscribe", topic="/needle_pose", throttle_rate=200, queue_length=100)
    times = []
    for _ in range(5):
        found = hear(peer)["msg"]["header"]["stamp"]
        times.append(found["sec"] + 1e-9 * found["nanosec"])
        assert time.time() - times[-1] < 0.15, "the newest value, not a queued one"
    assert np.diff(times).min() > 0.19


def test_events_are_told_once_each(stage, peer):
    stage.say("state", "before")
    say(peer, op="subscribe", topic="/acus/events")
    time.sleep(0.1)
    stage.say("scan", "control scan 1")
    assert hear(peer)["msg"] == {"data": "scan: control scan 1"}
    with pytest.raises(TimeoutError):
        hear(peer, timeout=0.2)


def test_numbers_that_are_none_are_not_sent(stage, server, peer):
    stage.change(device=type(device())(("a",), np.array([np.nan]), *[np.zeros(1)] * 2,
                                       np.zeros(3), 0.1, 1.0))  # fmt: skip
    say(peer, op="subscribe", topic="/joint_states")
    assert wait_for(lambda: "not finite" in server.journal.last)
    assert hear_one(peer, "/angle_error") == {"data": 0.1}


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e308])
@pytest.mark.parametrize("topic", ["/tf", "/needle_pose"])
def test_a_pose_that_no_number_can_hold_is_left_out_and_the_peer_stays(stage, peer, topic, value):
    stage.change(needle=needle(p_tip=(value, 0.0, 0.0)))
    say(peer, op="subscribe", topic=topic)
    say(peer, op="subscribe", topic="/angle_error")
    said = hear(peer)
    while said["topic"] != "/angle_error":  # it is told once
        json.dumps(said, allow_nan=False)
        said = hear(peer)
    stage.change(needle=needle())
    assert wait_for(lambda: hear(peer)["topic"] == topic)


def test_joint_angles_that_are_none_are_not_sent_as_cbor_either(stage, server, peer):
    stage.change(device=type(device())(("a",), np.array([np.nan]), *[np.zeros(1)] * 2,
                                       np.zeros(3), 0.1, 1.0))  # fmt: skip
    say(peer, op="subscribe", topic="/joint_states", compression="cbor")
    assert wait_for(lambda: "not finite" in server.journal.last)


# --- what is asked --------------------------------------------------------------------------------
def call(peer, service, args, name="call:1"):
    say(peer, op="call_service", id=name, service=service, args=args)
    return hear(peer, "service_response")


def test_a_plan_is_handed_on_in_metres_of_the_patient(stage, peer):
    answer = call(peer, "/acus/place_plan", {"entry": [0.0, -0.1, 0.2], "target": [0, 0, 0.2]})
    assert answer == {
        "op": "service_response", "id": "call:1", "service": "/acus/place_plan",
        "values": {"success": True, "message": ""}, "result": True,
    }  # fmt: skip
    np.testing.assert_array_equal(stage.placed[0], [[0.0, -0.1, 0.2], [0.0, 0.0, 0.2]])
    say(peer, op="publish", topic="/image_points", msg={"data": [0, 0.1, 0, 0, 0.2, 0]})
    wait_for(lambda: len(stage.placed) == 2)


def test_a_plan_that_is_refused_says_why(stage, peer):
    stage.refusal = "an attempt is running: its plan cannot change"
    answer = call(peer, "/acus/place_plan", [[0, 0, 0], [0, 0, 0.1]])
    assert answer["values"] == {"success": False, "message": stage.refusal}


@pytest.mark.parametrize(
    ("args", "words"),
    [
        ({"entry": [0, 0], "target": [0, 0, 0]}, "entry is not 3 numbers"),
        ({"entry": [0, 0, 0]}, "needs entry and target"),
        ({"entry": [0, 0, 1e308], "target": [0, 0, 0]}, "beyond 5 m"),
        ({"entry": [0, 0, float("nan")], "target": [0, 0, 0]}, "beyond 5 m"),
        ({"entry": [120, -30, 80], "target": [0, 0, 0]}, "metres are expected"),
        ({"entry": [True, 0, 0], "target": [0, 0, 0]}, "entry is not 3 numbers"),
        ({"entry": [10**400, 0, 0], "target": [0, 0, 0]}, "beyond 5 m"),
    ],
)
def test_a_plan_that_is_none_is_refused_by_name(stage, peer, args, words):
    answer = call(peer, "/acus/place_plan", args)
    assert (answer["result"], words in answer["values"]) == (False, True)
    assert stage.placed == []


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("garbage", "no JSON"),
        (b"\xff\x00", "no CBOR"),
        ("[1]", "a mapping with `op`"),
        ('{"op": "explode"}', "op 'explode' is not known"),
        ('{"op": "subscribe", "topic": "/nonsense"}', "topic '/nonsense' is not known"),
        ('{"op": "subscribe", "topic": "/tf", "type": "a/b"}', "has type tf2_msgs/msg/TFMessage"),
        ('{"op": "subscribe", "topic": "/tf", "throttle_rate": -1}', "throttle_rate -1"),
        ('{"op": "subscribe"}', "subscribe needs topic"),
        ('{"op": "advertise", "topic": "/tf", "type": "a/b"}', "has type tf2_msgs"),
        ('{"op": "publish", "topic": "/cmd_vel", "msg": {}}', "nobody here listens to '/cmd_vel'"),
        ("[" * 100_000, "recursion|no JSON"),
    ],
)
def test_what_is_wrong_is_answered_in_one_line_and_the_rest_goes_on(server, peer, data, words):
    import re

    peer.send(data)
    assert re.search(words, hear(peer, "status")["msg"])
    assert hear_one(peer, "/angle_error") == {"data": 0.05}


def test_unknown_services_are_answered_with_those_that_there_are(peer):
    answer = call(peer, "/explode", {})
    assert answer["result"] is False
    assert "/acus/place_plan" in answer["values"]
    assert call(peer, "/rosapi/topics", {})["values"]["topics"] == list(TOPICS)
    assert call(peer, "/rosapi/topic_type", ["/tf"])["values"]["type"] == TOPICS["/tf"].type


# --- who comes in ---------------------------------------------------------------------------------
def test_a_web_page_of_elsewhere_does_not_come_in_without_the_token(server):
    with pytest.raises(InvalidStatus, match="403"), peer_of(server, origin="https://evil.example"):
        pass
    with peer_of(server, origin="http://localhost:8000") as peer:
        assert hear_one(peer, "/angle_error")
    assert "evil.example" in " ".join(server.journal.lines)


def test_with_a_token_only_who_knows_it_comes_in(stage):
    with serving(stage, Doors(token=TOKEN)) as server:
        for path in ("", "?token=wrong"):
            with pytest.raises(InvalidStatus, match="403"), peer_of(server, path):
                pass
        with peer_of(server, f"?token={TOKEN}", origin="https://app.example") as peer:
            assert hear_one(peer, "/angle_error")
        known = {"Authorization": f"Bearer {TOKEN}"}
        with peer_of(server, additional_headers=known) as peer:
            assert hear_one(peer, "/angle_error")


def test_a_short_token_is_refused():
    with pytest.raises(LinkAddressError, match="at least 16"):
        Doors.of("*", "short")


def test_ipv6_is_served_and_a_port_in_use_is_one_line(stage, server):
    with connect(f"ws://[::1]:{server.port}") as peer:
        assert hear_one(peer, "/angle_error")
    with pytest.raises(LinkAddressError, match="rosbridge cannot listen"):
        rosbridge_server(stage, Doors(), server.port).open()


# --- peers that misbehave -------------------------------------------------------------------------
def test_a_peer_that_hangs_is_dropped_within_a_second_and_others_see_none_of_it(server, peer):
    with knock(server.port) as one:
        one.sendall(
            b"GET / HTTP/1.1\r\nHost: x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"
        )
        assert b"101" in one.recv(100)
        begin = time.monotonic()
        wait_for(lambda: "ping timeout" in " ".join(server.journal.lines))
        assert time.monotonic() - begin < 1.2
    assert hear_one(peer, "/angle_error")


def test_a_flood_is_ended_by_name(server, peer):
    with peer_of(server) as flooding:
        with suppress(ConnectionClosed):
            for _ in range(20_000):
                say(flooding, op="unsubscribe", topic="/tf")
        wait_for(lambda: "500 messages a second" in " ".join(server.journal.lines))
    assert hear_one(peer, "/angle_error")


def test_a_message_that_is_too_large_ends_its_peer(server, peer):
    with peer_of(server) as large, suppress(ConnectionClosed):
        large.send("x" * (2 << 20))
        large.recv(timeout=3.0)
    wait_for(lambda: "code 1009" in " ".join(server.journal.lines))
    assert hear_one(peer, "/angle_error")


PROGRAM = """
import json, sys, threading, roslibpy
ros = roslibpy.Ros(host="127.0.0.1", port=int(sys.argv[1]))
ros.run(timeout=10)
got = {}
done = threading.Event()
def keep(name):
    def take(message):
        got.setdefault(name, dict(message))
        if len(got) == 3:
            done.set()
    return take
topics = [
    roslibpy.Topic(ros, "/image_points", "std_msgs/Float64MultiArray"),
    roslibpy.Topic(ros, "/joint_states", "sensor_msgs/JointState"),
    roslibpy.Topic(ros, "/tf", "tf2_msgs/TFMessage", throttle_rate=100, queue_length=1),
]
for topic in topics:
    topic.subscribe(keep(topic.name))
done.wait(10)
service = roslibpy.Service(ros, "/acus/place_plan", "acus_msgs/PlacePlan")
answer = service.call(roslibpy.ServiceRequest({"entry": [0, -0.1, 0.2], "target": [0, 0, 0.2]}))
got["answer"] = dict(answer)
got["topics"] = ros.get_topics()
print(json.dumps(got))
ros.terminate()
"""


@pytest.mark.long("journey")
def test_roslibpy_subscribes_and_calls(stage, server):
    """In a process of its own: its reactor can be started once."""
    ran = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROGRAM, str(server.port)],
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    got = json.loads(ran.stdout.strip().splitlines()[-1])
    assert got["/image_points"]["data"] == [*PLAN.p_entry, *PLAN.p_target]
    assert got["/joint_states"]["position"] == [2.1, 1.0]
    assert got["/tf"]["transforms"][0]["child_frame_id"] == "patient"
    assert got["/tf"]["transforms"][0]["transform"]["translation"]["x"] == HEAD_UP.translation[0]
    assert got["answer"] == {"success": True, "message": ""}
    assert "/needle_pose" in got["topics"]
    np.testing.assert_array_equal(stage.placed[0], [[0.0, -0.1, 0.2], [0.0, 0.0, 0.2]])
