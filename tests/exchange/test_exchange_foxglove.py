"""Foxglove's web socket protocol, by a plain client written after its document.

The messages of the schemas that records have too are checked by Foxglove's own (`session.schemas`).
"""

import json
import struct
import time
from contextlib import contextmanager, suppress

import jsonschema
import numpy as np
import pytest
from live_rig import Stage, needle, tetrahedron, wait_for
from scipy.spatial.transform import Rotation
from websockets.exceptions import InvalidHandshake
from websockets.sync.client import connect

from app.core.paths import resources
from app.exchange.live.doors import Doors
from app.exchange.live.foxglove import CHANNELS
from app.exchange.live.foxglove import server as foxglove_server
from app.exchange.moment import Validity

TOKEN = "a-token-of-twenty-signs"


class Viewer:
    """A client: who the server is, its channels by topic, what comes by subscription."""

    def __init__(self, socket):
        self.socket = socket
        self.info = json.loads(socket.recv(timeout=3))
        advertised = json.loads(socket.recv(timeout=3))
        assert advertised["op"] == "advertise"
        self.channels = {one["topic"]: one for one in advertised["channels"]}

    def say(self, **document):
        self.socket.send(json.dumps(document))

    def subscribe(self, topic, number=7):
        channel = self.channels[topic]["id"]
        self.say(op="subscribe", subscriptions=[{"id": number, "channelId": channel}])

    def hear(self, number=7, timeout=3.0):
        """Return the time [ns] and the body of the next message of a subscription."""
        end = time.monotonic() + timeout
        while True:
            data = self.socket.recv(timeout=max(0.0, end - time.monotonic()))
            if isinstance(data, bytes):
                opcode, subscription, nanoseconds = struct.unpack_from("<BIQ", data)
                assert opcode == 1
                if subscription == number:
                    return nanoseconds, json.loads(data[13:])

    def body(self, topic, number=7):
        self.subscribe(topic, number)
        return self.hear(number)[1]


@pytest.fixture
def stage():
    return Stage()


@contextmanager
def serving(stage, doors=None):
    server = foxglove_server(stage, doors or Doors(), 0)
    server.open()
    try:
        yield server
    finally:
        server.close()


@contextmanager
def viewing(server, path="", protocol="foxglove.websocket.v1", **options):
    with connect(
        f"ws://127.0.0.1:{server.port}/{path}", subprotocols=[protocol], **options
    ) as socket:
        yield Viewer(socket)


@pytest.fixture
def server(stage):
    with serving(stage) as one:
        yield one


@pytest.fixture
def viewer(server):
    with viewing(server) as one:
        yield one


def test_the_server_says_who_it_is_and_every_channel_has_a_schema(viewer):
    assert (viewer.info["op"], viewer.info["name"]) == ("serverInfo", "Acus")
    assert len(viewer.channels) == len(CHANNELS)
    for channel in viewer.channels.values():
        assert (channel["encoding"], channel["schemaEncoding"]) == ("json", "jsonschema")
        schema = json.loads(channel["schema"])
        jsonschema.Draft7Validator.check_schema(schema)
        assert schema["title"] == channel["schemaName"]


@pytest.mark.parametrize("protocol", ["foxglove.websocket.v1", "foxglove.sdk.v1"])
def test_both_names_of_the_protocol_are_spoken_and_no_other(server, protocol):
    with viewing(server, protocol=protocol) as viewer:
        assert viewer.body("/tf")["transforms"]
    with pytest.raises(InvalidHandshake), viewing(server, protocol="chat"):
        pass


def test_every_message_is_as_its_schema_says(stage, viewer):
    for number, topic in enumerate(viewer.channels, 20):
        if topic == "/events":
            viewer.subscribe(topic, number)
            time.sleep(0.1)
            stage.say("scan", "control scan 1")
            body = viewer.hear(number)[1]
            assert (body["name"], body["message"]) == ("scan", "control scan 1")
        else:
            body = viewer.body(topic, number)
        jsonschema.validate(body, json.loads(viewer.channels[topic]["schema"]))


def test_frames_and_tip_are_metres_in_the_robot_s_frame(viewer):
    frames = {one["child_frame_id"]: one for one in viewer.body("/tf")["transforms"]}
    assert frames["patient"]["translation"] == {"x": 0.1, "y": 0.2, "z": 0.05}
    assert frames["needle"]["translation"] == {"x": 0.05, "y": -0.04, "z": 0.02}
    pose = viewer.body("/needle/tip", 8)["pose"]
    turn = Rotation.from_quat([pose["orientation"][axis] for axis in "xyzw"])
    np.testing.assert_allclose(turn.apply([0, 0, 1]), [0.0, 0.6, -0.8], atol=1e-12)


def test_the_scene_has_path_target_and_the_shaft_from_hub_to_tip(stage, viewer):
    entities = {one["id"]: one for one in viewer.body("/scene")["entities"]}
    assert set(entities) == {"path", "entry", "target", "needle"}
    path = [[end[a] for a in "xyz"] for end in entities["path"]["lines"][0]["points"]]
    np.testing.assert_allclose(path, [[0.11, 0.4, 0.15], [0.13, 0.42, 0.10]], atol=1e-12)
    (shaft,) = entities["needle"]["cylinders"]
    middle = [shaft["pose"]["position"][axis] for axis in "xyz"]
    along = Rotation.from_quat([shaft["pose"]["orientation"][axis] for axis in "xyzw"])
    half = 0.5 * shaft["size"]["z"] * along.apply([0.0, 0.0, 1.0])
    np.testing.assert_allclose(middle + half, [0.05, -0.04, 0.02], atol=1e-12)
    np.testing.assert_allclose(middle - half, [0.05, -0.16, 0.18], atol=1e-12)
    bright = shaft["color"]["a"]
    stage.change(needle=needle(Validity.MISSING))
    faint = wait_for(lambda: _alpha(viewer) != bright and _alpha(viewer))
    assert faint < bright


def _alpha(viewer):
    found = {one["id"]: one for one in viewer.hear()[1]["entities"]}
    return found["needle"]["cylinders"][0]["color"]["a"]


def test_skin_and_structures_come_once_in_the_patient_s_frame(stage, viewer):
    stage.change(surfaces=(tetrahedron(), tetrahedron("vena cava", False, (0.01, 0.02, 0.03))))
    skin, vein = viewer.body("/anatomy")["entities"]
    assert [one["frame_id"] for one in (skin, vein)] == ["patient", "patient"]
    assert (skin["id"], vein["id"]) == ("0 skin", "1 vena cava")
    (triangles,) = vein["triangles"]
    points = np.array([[place[axis] for axis in "xyz"] for place in triangles["points"]])
    np.testing.assert_allclose(points, tetrahedron(at=(0.01, 0.02, 0.03)).points, atol=1e-15)
    a, b, c = np.moveaxis(points[np.array(triangles["indices"]).reshape(-1, 3)], 1, 0)
    inside = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0
    assert inside == pytest.approx(0.1**3 / 6.0)  # seen from outside
    assert skin["triangles"][0]["color"]["a"] < 0.5 < triangles["color"]["a"]
    assert skin["lifetime"] == {"sec": 0, "nsec": 0}  # for ever
    with pytest.raises(TimeoutError):
        viewer.hear(timeout=1.5)


def test_of_another_patient_nothing_of_the_one_before_is_left(stage, viewer):
    stage.change(surfaces=(tetrahedron(),))
    assert viewer.body("/anatomy")["entities"]
    stage.change(surfaces=())
    later = viewer.hear()[1]
    assert later["entities"] == []
    assert [one["type"] for one in later["deletions"]] == [1]  # all


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e308])
def test_a_pose_that_no_number_can_hold_is_left_out_and_the_next_comes(
    stage, server, viewer, value
):
    stage.change(needle=needle(p_tip=(value, 0.0, 0.0)))
    viewer.subscribe("/needle/tip")
    viewer.subscribe("/tf", 8)
    with suppress(TimeoutError):
        place = viewer.hear(timeout=0.5)[1]["pose"]["position"]["x"]
        assert np.isfinite(place)
    stage.change(needle=needle())
    assert wait_for(lambda: viewer.hear()[1]["pose"]["position"]["x"] == 0.05)


def test_no_more_comes_once_it_is_not_wanted(viewer):
    viewer.body("/needle/tip")
    viewer.say(op="unsubscribe", subscriptionIds=[7])
    time.sleep(0.2)
    with suppress(TimeoutError):  # what was on its way already
        for _ in range(20):
            viewer.hear(timeout=0.3)
    with pytest.raises(TimeoutError):
        viewer.hear(timeout=0.3)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("garbage", "Expecting value"),
        ('{"op": "explode"}', "'explode' is not known"),
        ('{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 99}]}', "no channel 99"),
        ('{"op": "subscribe", "subscriptions": [{}]}', "id"),
        ('{"op": "subscribe", "subscriptions": 5}', "int"),
        (b"\x01\x02", "'None' is not known"),
    ],
)
def test_what_is_wrong_is_answered_in_one_line_and_the_rest_goes_on(viewer, data, words):
    viewer.socket.send(data)
    answer = json.loads(viewer.socket.recv(timeout=3))
    assert (answer["op"], words in answer["message"]) == ("status", True)
    assert viewer.body("/tf")["transforms"]


def test_a_token_is_asked_for_where_there_is_one(stage):
    with serving(stage, Doors(token=TOKEN)) as server:
        with pytest.raises(InvalidHandshake), viewing(server):
            pass
        with viewing(server, f"?token={TOKEN}") as viewer:
            assert viewer.body("/tf")["transforms"]


def test_the_layout_that_ships_names_topics_that_there_are():
    layout = json.loads((resources() / "foxglove-layout.json").read_text())
    panels = layout["configById"]
    topics = {one.topic for one in CHANNELS.values()}
    assert set(panels["3D!acus"]["topics"]) <= topics
    plotted = [
        p["value"] for name in panels if name.startswith("Plot") for p in panels[name]["paths"]
    ]
    for path in plotted:
        topic, _, field = path.partition(".")
        schema = next(one.schema for one in CHANNELS.values() if one.topic == topic)
        assert field in schema["properties"]

    def named(place):
        return {place} if isinstance(place, str) else named(place["first"]) | named(place["second"])

    assert named(layout["layout"]) == set(panels)
