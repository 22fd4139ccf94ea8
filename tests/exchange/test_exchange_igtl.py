"""OpenIGTLink: bytes as the protocol's own library has them, and what pyigtl understands of them.

The sums are those in the standard messages of github.com/openigtlink/OpenIGTLink (Testing/igtlutil,
igtl_test_data_*.h): a CRC of 64 bits in the header holds every byte of the body.
"""

import errno
import socket
import struct
import threading
import time
from contextlib import contextmanager, suppress

import numpy as np
import pyigtl
import pytest
from crcmod import mkCrcFun
from live_rig import HEAD_UP, PLAN, Stage, knock, needle, scan, wait_for

from app.exchange.errors import LinkAddressError, LinkMessageError
from app.exchange.live import doors as doors_module
from app.exchange.live import igtl_messages as igtl
from app.exchange.live.doors import Doors
from app.exchange.live.igtl import IgtlServer
from app.exchange.live.igtl_client import Address, IgtlClient
from app.exchange.moment import Validity, needle_rotation

VALUES = [
    *(-0.954892, 0.196632, -0.222525, -0.196632, 0.142857, 0.970014),
    *(0.222525, 0.970014, -0.0977491, 46.0531, 19.4709, 46.0531),
]
STAMP = 1234567892 / 2**32
LANDMARKS = tuple(
    igtl.NamedPoint(f"POINT_DESCRIPTION_{k}", place, colour, radius, "Landmark", "IMAGE_0")
    for k, (place, colour, radius) in enumerate([
        ((10, 15, 20), (255, 0, 0, 255), 5.0),
        ((25, 30, 35), (0, 255, 0, 255), 3.0),
        ((40, 45, 50), (0, 0, 255, 255), 1.0),
    ])
)  # fmt: skip


def standard_matrix():
    matrix = np.eye(4)
    matrix[:3] = np.array(VALUES).reshape(4, 3).T
    return matrix


@pytest.mark.parametrize(
    ("kind", "content", "version", "metadata", "size", "crc"),
    [
        ("TRANSFORM", igtl.transform(standard_matrix()), 1, {}, 0x30, 0xF6DD2B8EB4DF6DD2),
        (
            "TRANSFORM",
            igtl.transform(standard_matrix()),
            2,
            {"First patient age": "22", "Second patient age": "25"},
            0x75,
            0xF698F64FDAE266DD,
        ),
        (
            "STATUS",
            igtl.status(15, "ACTUATOR_DISABLED", "Actuator A is disabled.", 10),
            1,
            {},
            0x36,
            0x98EE43EED8E431CF,
        ),
        ("STRING", igtl.string("Welcome to OpenIGTLink"), 1, {}, 0x1A, 0xCEF1B42A701104D4),
        ("POINT", igtl.points(LANDMARKS), 1, {}, 0x198, 0xA55CC62D99C18210),
    ],
)
def test_messages_are_those_of_the_protocol_s_own_library(
    kind, content, version, metadata, size, crc
):
    data = igtl.packed(kind, "DeviceName", STAMP, content, version, metadata, 1)
    named = struct.pack(">H12s20s", version, kind.encode(), b"DeviceName")
    assert data[:58] == named + struct.pack(">QQQ", 1234567892, size, crc)
    read = igtl.message_of(igtl.head_of(data[:58], 1 << 20), data[58:])
    assert (read.kind, read.device, read.time) == (kind, "DeviceName", STAMP)
    assert (read.content, dict(read.metadata)) == (content, metadata)


@pytest.mark.parametrize("size", [0, 1, 7, 8, 1000, 100_003])
def test_the_checksum_is_that_of_another_library(size):
    data = np.random.default_rng(size).bytes(size)
    other = mkCrcFun(0x142F0E1EBA9EA3693, rev=False, initCrc=0, xorOut=0)
    assert igtl.checksum(data) == other(data)


def unpacked(data):
    """What pyigtl reads in a message."""
    fields = pyigtl.messages.MessageBase.parse_header(data[:58])
    message = pyigtl.messages.MessageBase.create_message(fields["message_type"])
    message.unpack(fields, data[58:])
    return message


def test_a_picture_and_its_place_are_read_by_pyigtl_as_they_are():
    taken = scan()
    to_ras = np.diag([-1.0, -1.0, 1.0, 1.0]) @ taken.affine_mm
    read = unpacked(igtl.packed("IMAGE", "ControlScan", 1.0, igtl.image(taken.hu, to_ras), 2))
    assert read.world_coordinate_system == "ras"
    np.testing.assert_array_equal(read.image, taken.hu)
    np.testing.assert_allclose(read.ijk_to_world_matrix, to_ras, atol=1e-4)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda m: m.__setitem__((0, 3), np.nan), "not finite"),
        (lambda m: m.__setitem__((1, 1), np.inf), "not finite"),
        (lambda m: m.__setitem__((0, 3), 3e38), "3e\\+38"),
        (lambda m: m.__setitem__((slice(0, 3), 0), -m[:3, 0]), "left-handed"),
        (lambda m: m.__imul__(1.01), "scales by 1.01"),
        (lambda m: m.__setitem__((slice(0, 3), 0), m[:3, 1]), "right angles|left-handed"),
        (lambda m: m.__setitem__((slice(0, 3), slice(0, 3)), 0.0), "scales by 0"),
    ],
)
def test_a_matrix_that_is_no_pose_is_refused_by_name(change, words):
    matrix = np.eye(4)
    change(matrix)
    data = igtl.packed("TRANSFORM", "NeedleToRas", 1.0, igtl.transform(matrix))
    message = igtl.message_of(igtl.head_of(data[:58], 100), data[58:])
    with pytest.raises(LinkMessageError, match=f"NeedleToRas is refused: .*({words})"):
        igtl.matrix_of(message)


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda d: d.__setitem__(60, d[60] ^ 1), "CRC is wrong"),
        (lambda d: d.__setitem__(1, 9), "no header of version 1 to 3"),
        (lambda d: d.__setitem__(slice(42, 50), b"\xff" * 8), "at most 1000 are taken"),
        (lambda d: d.__setitem__(3, 0xC3), "is no text"),
        (lambda d: d.__setitem__(slice(2, 14), bytes(12)), "has no type"),
    ],
)
def test_what_is_no_message_is_refused_with_what_is_wrong(damage, words):
    data = bytearray(igtl.packed("STRING", "Events", 1.0, igtl.string("here"), 2, {"a": "b"}))
    damage(data)
    with pytest.raises(LinkMessageError, match=words):
        igtl.message_of(igtl.head_of(bytes(data[:58]), 1000), bytes(data[58:]))


def test_metadata_that_reach_beyond_the_body_are_refused():
    for place, value in ((60, 0xFF), (62, 0xFF), (59, 0)):
        data = bytearray(igtl.packed("STRING", "Events", 1.0, igtl.string("x"), 2, {"a": "b"}))
        data[place] = value
        body = bytes(data[58:])
        head = igtl.Head("STRING", "Events", 1.0, 2, len(body), igtl.checksum(body))
        with pytest.raises(LinkMessageError, match="extended header or metadata do not fit"):
            igtl.message_of(head, body)


# --- the server -----------------------------------------------------------------------------------
@pytest.fixture
def stage():
    return Stage()


@pytest.fixture
def server(stage):
    one = IgtlServer(stage, Doors(), 0)
    one.open()
    yield one
    one.close()


@pytest.fixture
def peer(server):
    client = pyigtl.OpenIGTLinkClient("127.0.0.1", server.port)
    yield client
    client.stop()


def speak_version_2(peer):
    message = pyigtl.StringMessage("hello", device_name="peer")
    message.header_version = 2
    peer.send_message(message)


def test_slicer_s_numbers_are_these(peer):
    """A needle of a supine patient, by hand: x of the world is L, y is S, z is A.

    The tip stands at (0.05, -0.04, 0.02) m, the patient's origin at (0.1, 0.2, 0.05): it is
    50 mm to the right, 240 mm towards the feet, 30 mm to the back, and points to S 0.6, P 0.8.
    """
    found = peer.wait_for_message("NeedleToRas", 5)
    matrix = found.matrix
    np.testing.assert_allclose(matrix[:3, 3], [50.0, -30.0, -240.0], atol=1e-4)
    np.testing.assert_allclose(matrix[:3, 2], [0.0, -0.8, 0.6], atol=1e-6)
    np.testing.assert_allclose(matrix[:3, 0], [0.0, 0.6, 0.8], atol=1e-6)
    hub = peer.wait_for_message("HubToRas", 5).matrix
    np.testing.assert_allclose(
        hub[:3, 3], np.array([50.0, -30.0, -240.0]) - 200.0 * matrix[:3, 2], atol=1e-3
    )
    world = peer.wait_for_message("WorldToRas", 5).matrix
    np.testing.assert_allclose(
        world @ [50.0, -40.0, 20.0, 1.0], [50.0, -30.0, -240.0, 1], atol=1e-3
    )
    plan = peer.wait_for_message("Plan", 5)
    assert plan.names == ["Entry", "Target"]
    np.testing.assert_allclose(plan.positions, [[-10, 100, 200], [-30, 50, 220]], atol=1e-4)


def test_the_pose_has_its_own_time_and_not_that_of_sending(stage, peer):
    stage.still = True
    stage.change(needle=needle(wall=1_700_000_000.25))
    assert wait_for(lambda: _at(peer, 1_700_000_000.25))
    time.sleep(0.2)
    peer.get_latest_messages()
    assert peer.wait_for_message("NeedleToRas", 0.3) is None, "the same pose was told again"


def _at(peer, wall):
    found = peer.wait_for_message("NeedleTipToRas", 1)
    return found is not None and abs(found.timestamp - wall) < 1e-6


def test_who_speaks_version_1_gets_no_pose_that_is_not_valid(stage, peer):
    assert peer.wait_for_message("NeedleToRas", 5).header_version == 1
    stage.change(needle=needle(Validity.OUT_OF_VIEW))
    time.sleep(0.2)
    peer.get_latest_messages()
    assert peer.wait_for_message("NeedleToRas", 0.3) is None


def test_who_speaks_version_2_is_told_in_plus_words_what_a_pose_is_worth(stage, peer):
    peer.wait_for_message("NeedleToRas", 5)
    speak_version_2(peer)
    for validity, number in ((Validity.OK, "1"), (Validity.OUT_OF_VIEW, "0")):
        stage.change(needle=needle(validity))
        wanted = {"TransformValid": number, "TransformStatus": validity.value}
        wait_for(lambda wanted=wanted: peer.wait_for_message("NeedleToRas", 1).metadata == wanted)


def test_events_and_control_scans_arrive_as_they_are(stage, peer):
    assert peer.wait_for_message("NeedleToRas", 5)
    stage.say("scan", "control scan 1")
    taken = scan()
    stage.change(scan=taken)
    assert peer.wait_for_message("Events", 5).string == "scan: control scan 1"
    picture = peer.wait_for_message("ControlScan", 5)
    np.testing.assert_array_equal(picture.image, taken.hu)
    corner = picture.ijk_to_world_matrix @ [29, 19, 2, 1]  # by hand: x 120 - 29·0.7, y 95 - 19·0.8
    np.testing.assert_allclose(corner[:3], [99.7, 79.8, 140.0], atol=1e-3)


def test_many_peers_get_all_of_it(server):
    peers = [pyigtl.OpenIGTLinkClient("127.0.0.1", server.port) for _ in range(4)]
    try:
        for peer in peers:
            assert peer.wait_for_message("NeedleTipToRas", 5) is not None
        assert server.status().peers == 4
    finally:
        for peer in peers:
            peer.stop()


def test_ipv6_is_served(server):
    with knock(server.port, "::1") as one:
        assert one.recv(58)[2:8] == b"STATUS"


def test_a_needle_along_the_patient_has_axes_too():
    for axis in np.vstack([np.eye(3), -np.eye(3)]):
        rotation = needle_rotation(axis)
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(rotation) == pytest.approx(1.0)


def dropped(server, words):
    return wait_for(lambda: [line for line in server.journal.lines if words in line], 10.0)


def test_garbage_ends_one_peer_with_one_line(server, peer):
    with knock(server.port) as one:
        one.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n" * 3)
        assert len(dropped(server, "no header of version 1 to 3")) == 1
    assert peer.wait_for_message("NeedleToRas", 5) is not None


@pytest.mark.long("journey")
def test_a_peer_that_takes_nothing_is_dropped_and_others_see_none_of_it(stage, server, peer):
    big = scan(5, 1024, 1024)
    with knock(server.port, buffer=4096):
        stage.change(scan=big)
        begin = time.monotonic()
        assert dropped(server, "took nothing for 1 s")
        assert time.monotonic() - begin < 6.0, "on a busy computer too"
        peer.get_latest_messages()
        assert peer.wait_for_message("NeedleToRas", 2) is not None


def test_a_flood_is_ended_by_name(server):
    data = igtl.packed("STRING", "x", 1.0, igtl.string("flood")) * 100
    with knock(server.port) as one:
        with suppress(OSError):  # it is cut off
            for _ in range(100_000):
                one.sendall(data)
        assert dropped(server, "more than")


def test_poses_that_no_number_can_hold_are_left_out(stage, server, peer):
    assert peer.wait_for_message("NeedleToRas", 5)
    stage.change(needle=needle(p_tip=(1e308, 0.0, 0.0)))
    time.sleep(0.2)
    peer.get_latest_messages()
    assert peer.wait_for_message("NeedleToRas", 0.2) is None
    stage.change(needle=needle())
    assert peer.wait_for_message("NeedleToRas", 5) is not None


def test_a_port_in_use_is_one_line(server):
    with pytest.raises(
        LinkAddressError, match=f"OpenIGTLink cannot listen .*{server.port}.*in use"
    ):
        IgtlServer(Stage(), Doors(), server.port).open()


@pytest.mark.parametrize(("absent", "left"), [(socket.AF_INET, "[::1]"), (socket.AF_INET6, "127.")])
def test_a_computer_that_has_one_kind_of_address_alone_is_served_there(monkeypatch, absent, left):
    class Half(socket.socket):
        def bind(self, place):
            if self.family == absent:
                raise OSError(errno.EADDRNOTAVAIL, "Cannot assign requested address")
            super().bind(place)

    monkeypatch.setattr(doors_module.socket, "socket", Half)
    opened = Doors().listen(0, "OpenIGTLink")
    assert doors_module.address_of(opened).startswith(left)
    for one in opened:
        one.close()
    none = "127.0.0.1" if absent == socket.AF_INET else "::1"
    with pytest.raises(LinkAddressError, match=f"OpenIGTLink: {none} is no address here"):
        Doors(none).listen(0, "OpenIGTLink")


def test_off_this_computer_nobody_is_served_without_a_list():
    with pytest.raises(LinkAddressError, match="name who may come in, --links-allow"):
        IgtlServer(Stage(), Doors("0.0.0.0"), 0).open()


def test_only_the_listed_and_this_computer_come_in():
    doors = Doors.of("*", "", "10.0.0.0/24, fd00::7")
    inside = ("10.0.0.9", "fd00::7", "::1", "127.0.0.1", "::ffff:10.0.0.3")
    outside = ("10.0.1.9", "fd00::8", "::ffff:10.0.1.3", "nonsense")
    assert all(doors.lets_in(one) for one in inside)
    assert not any(doors.lets_in(one) for one in outside)
    with pytest.raises(LinkAddressError, match=r"'10\.0\.0\.256' is no address"):
        Doors.of("*", "", "10.0.0.256")


def test_without_a_trainer_the_peer_hears_that_there_is_no_needle(stage, server):
    stage.change(running=False, needle=None, plan=None)
    with knock(server.port) as one:
        data = one.recv(200)
        assert data[2:8] == b"STATUS"
        assert struct.unpack_from(">H", data, 58)[0] == 16


def test_the_plan_is_told_again_when_it_changes(stage, peer):
    assert peer.wait_for_message("Plan", 5)
    other = type(PLAN)(PLAN.p_target, PLAN.p_entry, HEAD_UP, 0.2)
    stage.change(plan=other)
    found = peer.wait_for_message("Plan", 5)
    np.testing.assert_allclose(found.positions[0], [-30, 50, 220], atol=1e-4)


# --- the client -----------------------------------------------------------------------------------
@contextmanager
def listening_to(*sent):
    """A client, and a server that sends these bytes to each who comes, then waits."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        listening.settimeout(0.05)
        stop, taken, visits = threading.Event(), [], []

        def serve():
            while not stop.is_set():
                with suppress(TimeoutError):
                    one, _ = listening.accept()
                    visits.append(one)
                    for data in sent:
                        with suppress(OSError):
                            one.sendall(data)

        serving = threading.Thread(target=serve)
        serving.start()
        address = Address("127.0.0.1", listening.getsockname()[1])
        client = IgtlClient(address, lambda message, _: taken.append(message))
        client.open()
        try:
            yield client, taken, visits
        finally:
            client.close()
            stop.set()
            serving.join()
            for one in visits:
                one.close()


POSE = igtl.packed("TRANSFORM", "NeedleTipToRas", 5.0, igtl.transform(np.eye(4)), 2)


def test_the_client_reads_over_what_it_does_not_take():
    picture = igtl.packed("IMAGE", "Ultrasound", 1.0, bytes(3 << 20))
    with listening_to(igtl.packed("STATUS", "x", 1.0, igtl.status(1, "OK")), picture, POSE) as (
        client,
        taken,
        _,
    ):
        wait_for(lambda: taken)
        assert (taken[0].device, taken[0].time, client.connected) == ("NeedleTipToRas", 5.0, True)


def test_one_message_with_a_wrong_sum_is_left_out_and_the_next_is_taken():
    damaged = bytearray(POSE)
    damaged[80] ^= 1
    with listening_to(bytes(damaged), POSE) as (client, taken, visits):
        wait_for(lambda: taken)
        assert len(taken) == len(visits) == 1
        assert "its CRC is wrong" in " ".join(client.journal.lines)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"HTTP/1.1 400 Bad Request\r\n\r\n" * 10, "no header of version 1 to 3"),
        (igtl.HEADER.pack(1, b"IMAGE", b"x", 0, 1 << 40, 0), "announces 1099511627776 bytes"),
        (igtl.HEADER.pack(1, b"TRANSFORM", b"x", 0, 1 << 20, 0), "announces 1048576 bytes"),
    ],
)
def test_a_server_of_something_else_is_left_and_looked_for_again(data, words):
    with listening_to(data) as (client, taken, visits):
        wait_for(lambda: len(visits) >= 3)
        assert words in client.journal.last
        assert len([line for line in client.journal.lines if words in line]) == 1, "said once"
        assert taken == []
        assert len(visits) < 8, "with a longer wait each time"
