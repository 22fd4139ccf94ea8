"""USB cameras on a scripted driver: ports, locking, times, and everything that goes wrong."""

import threading
import time

import cv2
import numpy as np
import pytest
from camera_fakes import LEFT, RIGHT, FakeBus

from app.core.clock import SystemClock
from app.tracking.cameras.capture import Controls
from app.tracking.cameras.ports import camera_ports, find_port
from app.tracking.cameras.source import CameraSource, SourceKind, parse_source
from app.tracking.cameras.usb import CaptureTime, UsbCamera
from app.tracking.cameras.watch import CameraHealth, CameraReader, CameraState
from app.tracking.errors import CameraError


@pytest.fixture
def bus():
    return FakeBus()


@pytest.fixture
def camera(bus):
    camera = UsbCamera("1-1.2", opener=bus.open, ports=bus.ports)
    yield camera
    for capture in bus.captures:
        capture.resume.set()
    camera.close()


def _node(folder, name, index, interface, title):
    device = folder / "devices" / interface
    device.mkdir(parents=True, exist_ok=True)
    entry = folder / "class" / name
    entry.mkdir(parents=True)
    (entry / "device").symlink_to(device)
    (entry / "index").write_text(f"{index}\n")
    (entry / "name").write_text(f"{title}\n")


def test_identical_cameras_are_told_apart_by_the_port_that_the_system_names(tmp_path):
    for name, index, interface in (
        ("video0", 0, "1-1.1:1.0"), ("video1", 1, "1-1.1:1.0"),
        ("video2", 0, "1-1.2:1.0"), ("video3", 1, "1-1.2:1.0"),
    ):  # fmt: skip
        _node(tmp_path, name, index, interface, "HD Webcam")
    by_path = tmp_path / "dev" / "v4l" / "by-path"
    by_path.mkdir(parents=True)
    (by_path / "pci-0000:00:14.0-usb-0:1.2:1.0-video-index0").symlink_to("../../video2")
    ports = camera_ports(tmp_path / "class", tmp_path / "dev")
    assert [(port.port, port.title) for port in ports] == [
        ("1-1.1", "HD Webcam"),
        ("1-1.2", "HD Webcam"),
    ]
    node = str(tmp_path / "dev" / "video2")
    assert find_port("1-1.2", ports) == node
    assert find_port("pci-0000:00:14.0-usb-0:1.2:1.0-video-index0", ports) == node
    assert find_port("2", ports) == node


def test_two_cameras_in_one_device_are_named_by_their_interfaces(tmp_path):
    _node(tmp_path, "video0", 0, "2-1:1.0", "Stereo")
    _node(tmp_path, "video2", 0, "2-1:1.2", "Stereo")
    ports = camera_ports(tmp_path / "class", tmp_path / "dev")
    assert [port.port for port in ports] == ["2-1:1.0", "2-1:1.2"]


def test_an_empty_port_is_named_with_what_is_plugged_in():
    with pytest.raises(CameraError, match=r"usb:3-1; plugged in are: usb:1-1.1 \(Webcam\)"):
        find_port("3-1", (LEFT, RIGHT))
    with pytest.raises(CameraError, match="none is plugged in"):
        find_port("0", ())


@pytest.mark.parametrize(
    ("text", "source"),
    [
        ("usb:1-1.2", CameraSource(SourceKind.USB, "1-1.2")),
        ("usb:0", CameraSource(SourceKind.USB, "0")),
        ("folder:/a:b", CameraSource(SourceKind.FOLDER, "/a:b")),
        (" Video:x.avi ", CameraSource(SourceKind.VIDEO, "x.avi")),
        ("simulated", CameraSource(SourceKind.SIMULATED)),
    ],
)
def test_a_source_is_read_and_written(text, source):
    assert parse_source(text) == source
    assert parse_source(str(source)) == source


@pytest.mark.parametrize("text", ["", "usb", "usb:", "firewire:1", "simulated:2", "/dev/video0"])
def test_another_form_of_source_is_refused_with_the_valid_ones(text):
    with pytest.raises(CameraError, match=r"usb:PORT.*folder:PATH, video:PATH, simulated"):
        parse_source(text)


def test_the_pictures_are_the_drivers_with_the_drivers_times(bus, camera):
    camera.open()
    frames = [camera.read() for _ in range(5)]
    times = [frame.time for frame in frames]
    assert camera.driver_time
    assert bus.captures[0].node == RIGHT.node
    assert np.all(np.diff(times) > 0.0)
    assert all(0.0 < time.monotonic() - t < 30.0 for t in times)
    assert bus.captures[0].values[cv2.CAP_PROP_BUFFERSIZE] == 1
    camera.close()
    camera.close()
    assert bus.captures[0].released


@pytest.mark.parametrize("stamp", ["none", "count"])
def test_a_driver_without_monotonic_times_is_replaced_by_the_delivery_less_the_latency(bus, stamp):
    bus.script = {"stamp": stamp}
    camera = UsbCamera("1-1.1", latency=0.2, opener=bus.open, ports=bus.ports)
    camera.open()
    frame = camera.read()
    camera.close()
    assert not camera.driver_time
    assert 0.2 <= time.monotonic() - frame.time < 30.0


@pytest.mark.parametrize("stamp", [0.0, np.nan, np.inf, -5.0, 8.9, 10.1])
def test_an_implausible_stamp_ends_the_trust_in_all_later_ones(stamp):
    capture = CaptureTime(latency=0.05)
    assert capture.of(9_990.0, 10.0) == pytest.approx(9.99)
    assert capture.of(1e3 * stamp, 10.0) == pytest.approx(9.95)
    assert capture.of(10_020.0, 10.03) == pytest.approx(9.98)
    assert not capture.trusted


def test_what_the_driver_does_not_accept_is_reported(bus):
    bus.script = {"refuses": {cv2.CAP_PROP_AUTOFOCUS, cv2.CAP_PROP_EXPOSURE}}
    controls = Controls(exposure=5e-3, white_balance=4000.0)
    camera = UsbCamera("1-1.1", controls, opener=bus.open, ports=bus.ports)
    camera.open()
    camera.close()
    said = {setting.name: setting for setting in camera.settings}
    assert not said["exposure [ms]"].accepted
    assert "did not accept 5" in said["exposure [ms]"].text
    assert not said["focus"].accepted
    assert "holding" in said["focus"].text
    assert said["white balance [K]"].accepted
    assert said["white balance [K]"].got == 4000.0


def test_what_is_not_given_is_held_where_the_camera_has_brought_it(bus, camera):
    camera.open()
    values = bus.captures[0].values
    assert values[cv2.CAP_PROP_EXPOSURE] == 157.0
    assert values[cv2.CAP_PROP_AUTOFOCUS] == 0.0
    assert [s.got for s in camera.settings if s.name == "exposure [ms]"] == [pytest.approx(15.7)]


def test_another_size_is_refused_by_name(bus, camera):
    bus.script = {"size": (1280, 720)}
    with pytest.raises(CameraError, match="1280x720 where 640x480"):
        camera.open()
    assert bus.captures[0].released


def test_nothing_at_the_port_is_an_error_that_says_what_is_there(bus, camera):
    bus.plugged.remove(RIGHT)
    with pytest.raises(CameraError, match=r"usb:1-1.2; plugged in are: usb:1-1.1"):
        camera.open()
    with pytest.raises(CameraError, match="not open"):
        UsbCamera("1-1.2", opener=bus.open, ports=bus.ports).read()


@pytest.mark.long("statistics")
def test_a_driver_that_hangs_hangs_nobody_else_and_is_said_when_opened_again(bus, camera):
    camera.open()
    bus.captures[0].mode = "hang"
    assert bus.captures[0].hanging.wait(30.0)
    begin = time.monotonic()
    with pytest.raises(CameraError, match="no picture for"):
        _drain(camera)
    assert time.monotonic() - begin < 20.0
    begin = time.monotonic()
    camera.close()
    assert time.monotonic() - begin < 20.0
    with pytest.raises(CameraError, match="hangs"):
        camera.open()
    bus.captures[0].resume.set()
    _until(lambda: bus.captures[0].released)
    camera.open()
    assert camera.read().image.shape == (480, 640, 3)


def test_closing_wakes_an_opening_that_waits(bus, camera):
    def opener(node):
        capture = bus.open(node)
        capture.mode = "hang"
        return capture

    camera = UsbCamera("1-1.1", opener=opener, ports=bus.ports)
    failed = []

    def work():
        try:
            camera.open()
        except CameraError as error:
            failed.append(str(error))

    thread = threading.Thread(target=work)
    thread.start()
    _until(lambda: bus.captures and bus.captures[0].hanging.is_set())
    camera.close()
    bus.captures[0].resume.set()
    thread.join(30.0)
    assert not thread.is_alive()
    assert failed


def test_pictures_that_cannot_be_decoded_are_counted_and_end_the_stream(bus, camera):
    camera.open()
    bus.captures[0].mode = "broken"
    with pytest.raises(CameraError, match="could not be decoded"):
        _drain(camera)
    assert camera.broken >= 1


@pytest.fixture
def reader(camera):
    reader = CameraReader(camera, "right", SystemClock(), threading.Condition(), True)
    yield reader
    reader.close()


def _until(condition, seconds=30.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.005)


def _drain(camera):
    while True:
        camera.read()


def _state(reader):
    return reader.health(time.monotonic()).state


@pytest.mark.long("statistics")
def test_an_unplugged_camera_is_noticed_and_comes_back_at_its_port(bus, reader):
    reader.open()
    _until(lambda: _state(reader) is CameraState.LIVE)
    bus.plugged.remove(RIGHT)
    begin = time.monotonic()
    _until(lambda: _state(reader) is CameraState.FAILED)
    assert time.monotonic() - begin < 20.0
    _until(lambda: "no camera at usb:1-1.2" in reader.health(time.monotonic()).text)
    bus.plugged.append(RIGHT)
    _until(lambda: _state(reader) is CameraState.LIVE)
    assert reader.health(time.monotonic()).reopened == 1
    assert {capture.node for capture in bus.captures} == {RIGHT.node}


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    ("mode", "state", "word"),
    [
        ("hang", CameraState.FAILED, "no picture"),
        ("frozen", CameraState.FROZEN, "does not change"),
        ("same time", CameraState.FROZEN, "does not change"),
        ("backwards", CameraState.FAILED, "go back"),
    ],
)
def test_a_stream_that_goes_wrong_is_noticed_and_named(bus, reader, mode, state, word):
    reader.open()
    _until(lambda: _state(reader) is CameraState.LIVE)
    bus.captures[0].mode = mode
    begin = time.monotonic()
    _until(lambda: _state(reader) in (state, CameraState.STALLED))
    assert time.monotonic() - begin < 20.0
    _until(lambda: _state(reader) is state)
    assert word in reader.health(time.monotonic()).text


def test_a_camera_is_named_once_in_its_trouble():
    named = [CameraHealth("left", CameraState.FAILED, 1.0, message).named
             for message in ("camera left (usb:1): gone", "gone")]  # fmt: skip
    assert named == ["camera left (usb:1): gone", "camera left: gone"]


def test_a_covered_lens_is_told_from_a_driver_that_hangs(bus, camera, reader):
    bus.script = {"image": np.zeros((480, 640, 3), np.uint8)}
    reader.open()
    _until(lambda: _state(reader) is CameraState.FROZEN)
    assert "lens cap" in reader.health(time.monotonic()).text


def test_the_figures_of_a_stream_are_its_rate_and_jitter(camera):
    times = []
    reader = CameraReader(camera, "right", SystemClock(), threading.Condition(), True,
                          lambda frame, _: times.append(frame.time))  # fmt: skip
    reader.open()
    _until(lambda: len(times) > 40)
    reader.close()
    figures, steps = reader.health(time.monotonic()).figures, np.diff(times[-90:])
    assert figures.taken == len(times)
    assert figures.rate == pytest.approx(1.0 / steps.mean())
    assert figures.rate < 210.0
    assert figures.jitter == pytest.approx(steps.std())
    assert figures.text == ""


@pytest.mark.parametrize(
    ("simulated", "words"), [(True, "this computer is too busy"), (False, "check its cable")]
)
def test_a_cable_is_blamed_only_where_there_is_one(simulated, words):
    health = CameraHealth("left", CameraState.STALLED, 1.0, simulated=simulated)
    assert words in health.text
