"""A needle that another program tracks: pyigtl serves it, in another process, by its own numbers.

The patient of the tests lies supine: L to +x, S to +y, A to +z of the world; the entry is the
fulcrum. So a point at (R, A, S) mm from the entry is at (-R, S, A) mm from the fulcrum.
"""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from app.compose.needle_sources import check, named, needle_source
from app.compose.recomputed import replay_recording
from app.compose.tracked_needle import TrackedSettings
from app.compose.trainer import TrainerSetup, build_rig
from app.core.arrays import unit
from app.core.clock import SystemClock, VirtualClock
from app.core.errors import AcusError
from app.exchange.errors import LinkAddressError, LinkMessageError
from app.exchange.live import igtl_messages as igtl
from app.exchange.live.igtl_client import Address, PeerTime
from app.exercises.scene import device_of, placed_plan_of
from app.planning.plan import Plan
from app.session.recording import read_recording
from app.tracking.fix import FixStatus
from tests.layered import layered

ENTRY = np.array([0.0, -100.0, 0.0])
PLAN = Plan(ENTRY, np.array([15.0, -35.0, 10.0]), "test")

PROGRAM = """
import sys, time
import numpy as np, pyigtl
server = pyigtl.OpenIGTLinkServer(port=int(sys.argv[1]), local_server=True)
print("ready", flush=True)
end = time.time() + float(sys.argv[2])
while time.time() < end:
    if server.is_connected():
        matrix = np.array([[1, 0, 0, 5.0], [0, 0.8, -0.6, 70.0], [0, 0.6, 0.8, -3.0], [0, 0, 0, 1]])
        matrix = matrix @ np.diag([1.0, -1.0, -1.0, 1.0])
        message = pyigtl.TransformMessage(matrix, device_name="NeedleTipToRas")
        message.header_version = 2
        message.metadata = {"TransformValid": "1", "TransformStatus": "OK"}
        server.send_message(message, wait=False)
        time.sleep(0.02)
    else:
        time.sleep(0.01)
server.stop()
"""


def setup(folder, clock, text="igtl:localhost:1"):
    exercise = layered("first-insertion")
    placed = placed_plan_of(exercise, device_of(exercise), PLAN)
    return TrainerSetup(
        exercise, placed, sessions=folder, clock=clock, source=needle_source(*named(text))
    )


class Bench:
    """A rig in virtual time, and the messages that its peer would send."""

    def __init__(self, folder):
        self.clock = VirtualClock(100.0)
        self.rig = build_rig(setup(folder, self.clock))
        self.trainer, self.tracker = self.rig.trainer, self.rig.tracker
        self.rig.loop.open()
        self.sent = 1_700_000_000.0

    def tell(self, matrix, name="NeedleTipToRas", version=2, stamp=None, **metadata):
        data = igtl.packed(
            "TRANSFORM", name, self.sent if stamp is None else stamp, igtl.transform(matrix),
            version, metadata,
        )  # fmt: skip
        head = igtl.head_of(data[:58], 1000)
        self.tracker.take(igtl.message_of(head, data[58:]), self.clock.now())

    def run(self, matrix, seconds, **metadata):
        end = self.clock.now() + seconds - 1e-9
        while self.clock.now() < end:
            self.tell(matrix, **metadata)
            snapshot = self.trainer.step(20)
            self.sent += 0.02
        return snapshot


@pytest.fixture
def bench(tmp_path):
    made = Bench(tmp_path)
    yield made
    made.rig.close()


def pose(tip_ras, axis_ras):
    """NeedleTipToRas [mm]: +z out of the tip."""
    z = unit(axis_ras)
    x = unit(np.cross([0.0, 0.0, 1.0], z))
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    matrix[:3, 3] = tip_ras
    return matrix


# The entry, LPS (0, -100, 0), is RAS (0, 100, 0); 30 mm along the axis the tip is inside.
AXIS_RAS = unit([-0.1, -1.0, 0.2])
INSIDE = pose(np.array([0.0, 100.0, 0.0]) + 30.0 * AXIS_RAS, AXIS_RAS)


def test_the_needle_of_the_peer_is_the_needle_of_the_trainer(bench):
    snapshot = bench.run(INSIDE, 0.6)
    fulcrum = np.array(bench.rig.profile.fulcrum)
    towards = np.array([0.1, 0.2, -1.0]) / np.linalg.norm([0.1, 0.2, -1.0])  # by hand
    pose = snapshot.measured_pose
    assert pose.measured
    np.testing.assert_allclose(pose.axis, towards, atol=1e-4)
    np.testing.assert_allclose(pose.p_tip, fulcrum + 0.03 * towards, atol=1e-4)
    assert pose.depth == pytest.approx(0.03, abs=1e-4)
    assert np.abs(bench.rig.loop.latest().row).max() < np.inf


def test_the_fix_has_the_covariance_of_calibration_registration_and_noise(bench):
    bench.tell(INSIDE)
    fix = bench.tracker.latest.read().value
    known = TrackedSettings()
    one = 1e-6 * (0.7**2 + known.registration_sd_mm**2 + known.noise_sd_mm**2)
    np.testing.assert_allclose(fix.covariance, one * np.eye(3), atol=1e-12)
    np.testing.assert_allclose(fix.noise_covariance, 1e-6 * 0.3**2 * np.eye(3), atol=1e-15)


def test_a_reference_of_the_peer_is_followed_by_its_registration(bench):
    turned = np.array([[0, -1, 0, 10.0], [1, 0, 0, -20.0], [0, 0, 1, 5.0], [0, 0, 0, 1]])
    bench.tell(np.linalg.inv(turned) @ INSIDE, "NeedleTipToReference")
    assert bench.tracker.latest.read().value.status is FixStatus.NO_ORIENTATION
    assert "no ReferenceToRas" in bench.tracker.latest.read().value.reason
    bench.tell(turned, "ReferenceToRas")
    bench.sent += 1.0
    bench.tell(np.linalg.inv(turned) @ INSIDE, "NeedleTipToReference")
    found = bench.tracker.latest.read().value.p_tip_world
    bench.sent += 1.0
    bench.tell(INSIDE)
    np.testing.assert_allclose(found, bench.tracker.latest.read().value.p_tip_world, atol=1e-5)


def test_a_peer_that_says_the_needle_is_hidden_makes_it_invalid_at_once_in_its_words(bench):
    assert bench.run(INSIDE, 0.4).pose.valid
    bench.sent += 0.02
    bench.tell(INSIDE, TransformValid="0", TransformStatus="OUT_OF_VIEW")
    fix = bench.tracker.latest.read().value
    assert (fix.status, fix.usable) == (FixStatus.OUT_OF_VIEW, False)
    assert "NeedleTipToRas is OUT_OF_VIEW" in fix.reason
    snapshot = bench.run(INSIDE, 0.5, TransformValid="0", TransformStatus="MISSING")
    assert not snapshot.pose.valid
    assert bench.run(INSIDE, 0.3, TransformStatus="OK").pose.valid


def test_silence_makes_the_pose_invalid_within_a_quarter_of_a_second(bench):
    assert bench.run(INSIDE, 0.4).pose.valid
    for _ in range(13):
        snapshot = bench.trainer.step(20)
    assert not snapshot.pose.valid


def test_the_same_pose_told_again_and_again_is_no_new_one(bench):
    assert bench.run(INSIDE, 0.4).pose.valid
    for _ in range(20):
        bench.tell(INSIDE, stamp=bench.sent - 0.02)
        snapshot = bench.trainer.step(20)
    assert not snapshot.pose.valid


@pytest.mark.parametrize(
    ("matrix", "words"),
    [
        (INSIDE @ np.diag([-1.0, 1.0, 1.0, 1.0]), "left-handed"),
        (INSIDE * 1.2, "scales by 1.2"),
        (np.full((4, 4), np.nan), "not finite"),
        (np.full((4, 4), 3e38), "a value of it is"),
    ],
)
def test_what_is_no_pose_is_refused_by_name_and_the_attempt_goes_on(bench, matrix, words):
    bench.run(INSIDE, 0.4)
    with pytest.raises(LinkMessageError, match=f"NeedleTipToRas is refused: .*{words}"):
        bench.tell(matrix)
    assert words in bench.tracker.latest.read().value.reason
    assert not bench.tracker.latest.read().value.usable
    bench.sent += 0.02
    assert bench.run(INSIDE, 0.1).pose.valid
    assert not any(event.kind == "fault" for event in bench.trainer.events.drain())


def test_an_attempt_on_it_is_recorded_as_one_without_a_robot_and_replayed_to_the_bit(bench):
    outside = pose(np.array([0.0, 100.0, 0.0]) - 20.0 * AXIS_RAS, AXIS_RAS)
    bench.run(outside, 0.5)
    bench.trainer.begin("student")
    bench.trainer.confirm_outside()
    bench.run(outside, 0.5)
    bench.run(INSIDE, 0.5)
    result = bench.trainer.end()
    recording = read_recording(result.record)
    assert recording.metadata["device"] == {
        "name": "igtl", "igtl": "no", "pen": "no", "simulated": "no",
    }  # fmt: skip
    report = replay_recording(recording)
    assert report.ticks > 500
    assert report.first_difference is None


def test_times_of_the_peer_become_ours_whatever_its_clock_says():
    clock, rng = PeerTime(), np.random.default_rng(4)
    for k in range(200):
        captured = 50.0 + 0.02 * k
        found = clock.captured(captured + 1.7e9, captured + 0.003 + rng.exponential(0.01))
        assert -1e-9 <= found - captured < 0.05
    assert found - captured == pytest.approx(0.003, abs=0.002), "the way itself stays unknown"
    jumped = clock.captured(captured + 9e8, captured + 0.02)
    assert jumped == captured + 0.02, "a clock that was set begins anew"
    assert clock.captured(0.0, 7.0) == 7.0


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("localhost", Address("localhost", 18944)),
        ("10.0.0.7:19000", Address("10.0.0.7", 19000)),
        ("[::1]:19000", Address("::1", 19000)),
        ("::1", Address("::1", 18944)),
    ],
)
def test_an_address_is_a_host_and_perhaps_a_port(text, address):
    assert Address.of(text) == address
    assert Address.of(str(address)) == address


@pytest.mark.parametrize("text", ["", ":1", "host:", "host:0", "host:99999", "host:x", "[::1]x"])
def test_what_is_no_address_is_refused_with_what_would_be(text):
    if text == "host:":
        assert Address.of(text).port == 18944
        return
    with pytest.raises(LinkAddressError, match="valid are igtl:HOST"):
        check(f"igtl:{text}")


def test_a_text_names_the_source_and_a_webcam_stays_the_pen_s():
    assert named("igtl:there:1") == ("igtl", "there:1")
    assert named("usb:0") == ("pen", "usb:0")
    with pytest.raises(AcusError, match="usb"):
        check("nonsense:0")


def free_port():
    import socket

    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def start(port, seconds, folder):
    program = Path(folder) / "server.py"
    program.write_text(PROGRAM)
    server = subprocess.Popen(
        [sys.executable, str(program), str(port), str(seconds)], stdout=subprocess.PIPE, text=True
    )
    assert server.stdout.readline() == "ready\n"
    return server


@pytest.mark.long("machine")
def test_a_server_that_comes_late_goes_and_comes_again_is_followed(tmp_path):
    """pyigtl in a process of its own; the numbers of its matrix are brought over by hand."""
    port = free_port()
    made = needle_source("igtl", f"localhost:{port}")(device_of(layered("first-insertion")))
    exercise = layered("first-insertion")
    placed = placed_plan_of(exercise, made.profile, PLAN)
    made.table(exercise, placed, None, 1)
    tracker = made.tracker(None, SystemClock(), 1)
    tracker.open()
    try:
        for _ in range(2):
            server = start(port, 3.0, tmp_path)
            try:
                fix = _await(tracker, lambda fix: fix.usable)
                p_entry = placed.p_entry
                np.testing.assert_allclose(
                    fix.p_tip_world - p_entry, [-0.005, -0.003, -0.030], atol=1e-6
                )
                assert 0.0 <= time.monotonic() - fix.time < 0.5
            finally:
                server.wait(20)
                server.stdout.close()
            gone = _await(tracker, lambda fix: fix.status is FixStatus.NO_PICTURE)
            assert not gone.usable
    finally:
        tracker.close()


def _await(tracker, wanted, seconds=12.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        stamped = tracker.latest.read()
        if stamped is not None and wanted(stamped.value):
            return stamped.value
        time.sleep(0.01)
    raise AssertionError(tracker.client.journal.lines)
