"""Pictures from folders and videos, and pictures of the wrong size."""

import cv2
import numpy as np
import pytest

from app.core.clock import SystemClock, VirtualClock
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.cameras.checked import CheckedCamera
from app.tracking.cameras.feed import CameraFeed
from app.tracking.cameras.files import FolderCamera, VideoCamera, pictures_in
from app.tracking.errors import CameraError


@pytest.fixture
def folder(tmp_path):
    for number in range(3):
        image = np.full((48, 64, 3), 40 * number, np.uint8)
        assert cv2.imwrite(str(tmp_path / f"picture-{number}.png"), image)
    (tmp_path / "notes.txt").write_text("no picture")
    return tmp_path


def test_a_folder_delivers_its_pictures_in_order_and_at_its_rate(folder):
    clock = VirtualClock(10.0)
    camera = FolderCamera(folder, 20.0, clock, loops=False)
    camera.open()
    frames = [camera.read() for _ in range(3)]
    assert [int(frame.image[0, 0, 0]) for frame in frames] == [0, 40, 80]
    assert np.diff([frame.time for frame in frames]) == pytest.approx([0.05, 0.05])
    with pytest.raises(CameraError, match=r"3 pictures of .* are over"):
        camera.read()
    camera.close()
    with pytest.raises(CameraError, match="not open"):
        camera.read()


def test_two_looping_folders_stay_in_step_and_skip_what_was_not_read(folder):
    clock = VirtualClock(10.01)
    first, second = (FolderCamera(folder, 20.0, clock) for _ in range(2))
    first.open()
    clock.sleep(0.33)
    second.open()
    one, other = first.read(), second.read()
    clock.sleep(5.0)
    assert first.read().time - one.time >= 5.0
    pair = first.read(), second.read()
    assert pair[0].time == pytest.approx(pair[1].time)
    assert np.array_equal(pair[0].image, pair[1].image)
    assert other.time > one.time


def test_a_damaged_picture_is_named_and_the_next_one_follows(folder):
    whole = (folder / "picture-1.png").read_bytes()
    (folder / "picture-1.png").write_bytes(whole[:20])
    camera = FolderCamera(folder, 20.0, VirtualClock(10.0), loops=False)
    camera.open()
    camera.read()
    with pytest.raises(CameraError, match=r"picture-1.png is no picture or is damaged"):
        camera.read()
    assert camera.read().image[0, 0, 0] == 80


def test_a_folder_that_is_missing_or_empty_is_named(tmp_path):
    with pytest.raises(CameraError, match=r"no folder .*absent"):
        FolderCamera(tmp_path / "absent").open()
    with pytest.raises(CameraError, match=r"no picture in"):
        FolderCamera(tmp_path).open()


@pytest.fixture
def video(tmp_path):
    path = tmp_path / "film.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 25.0, (64, 48))
    if not writer.isOpened():
        pytest.skip("this OpenCV writes no video")
    for number in range(5):
        writer.write(np.full((48, 64, 3), 50 * number, np.uint8))
    writer.release()
    return path


def test_a_video_delivers_its_pictures_at_its_own_times(video):
    clock = VirtualClock(3.0)
    camera = VideoCamera(video, clock, loops=False)
    camera.open()
    frames = [camera.read() for _ in range(5)]
    assert [round(float(f.image.mean()) / 50) for f in frames] == [0, 1, 2, 3, 4]
    assert np.diff([f.time for f in frames]) == pytest.approx([0.04] * 4)
    with pytest.raises(CameraError, match="is over"):
        camera.read()


def test_a_video_that_loops_goes_on_with_times_that_grow(video):
    clock = VirtualClock(3.0)
    camera = VideoCamera(video, clock)
    camera.open()
    times = [camera.read().time for _ in range(12)]
    assert np.all(np.diff(times) > 0.0)
    camera.close()
    camera.close()


def test_a_video_of_too_many_pixels_is_refused_before_a_picture_is_decoded(video, monkeypatch):
    monkeypatch.setattr("app.tracking.picture_file.MOST_PIXELS", 48 * 48)
    with pytest.raises(CameraError, match=r"film\.avi has more than .* pixels"):
        VideoCamera(video).open()


def test_a_file_in_place_of_a_folder_is_called_a_file(tmp_path):
    path = tmp_path / "one.png"
    path.touch()
    with pytest.raises(CameraError, match=r"one\.png is a file; folder:PATH names a folder"):
        pictures_in(path)


def test_what_is_no_video_is_named(tmp_path):
    (tmp_path / "film.avi").write_bytes(b"nothing")
    with pytest.raises(CameraError, match=r"film.avi is no video"):
        VideoCamera(tmp_path / "film.avi").open()
    with pytest.raises(CameraError, match=r"no video .*other.avi"):
        VideoCamera(tmp_path / "other.avi").open()


def test_pictures_of_another_size_than_the_calibrations_are_refused_by_name(folder):
    camera = CheckedCamera(
        FolderCamera(folder, 20.0, VirtualClock()), "left", "folder:x", (640, 480), "calibration c1"
    )
    with pytest.raises(
        CameraError, match=r"camera left \(folder:x\) gives pictures of 64x48, .*\(calibration c1\)"
    ):
        camera.open()


def test_the_feed_says_how_far_apart_two_cameras_capture():
    clock = SystemClock()
    cameras = [_Ticking(clock, 0.0), _Ticking(clock, 0.008)]
    feed = CameraFeed(cameras, ("left", "right"), clock, True, lambda *_: None)
    assert feed.skew() is None
    feed.open()
    for _ in range(12):
        feed.wait()
    skew = feed.skew()
    feed.close()
    assert skew.median == pytest.approx(0.008, abs=1e-6)


def test_nobody_waits_for_a_camera_that_is_gone():
    clock = SystemClock()
    feed = CameraFeed([_Ticking(clock, 0.0), _Gone()], ("a", "b"), clock, True, lambda *_: None)
    feed.open()
    for _ in range(4):
        feed.wait()
    start = clock.now()
    pairs = [feed.wait() for _ in range(10)]
    rate = 10.0 / (clock.now() - start)
    feed.close()
    assert all(right is None for _, right in pairs)
    assert rate > 12.0  # fifty are captured; waiting for the other one leaves six


class _Gone(Camera):
    """Unplugged."""

    def open(self):
        pass

    def read(self):
        raise CameraError("it was unplugged")

    def close(self):
        pass


class _Ticking(Camera):
    """Fifty pictures a second at the clock's own multiples, shifted."""

    def __init__(self, clock, shift):
        self.clock, self.shift, self.last = clock, shift, 0

    def open(self):
        self.last = int(50.0 * self.clock.now())

    def read(self):
        self.last = max(self.last + 1, int(50.0 * self.clock.now()))
        self.clock.sleep(self.last / 50.0 + 0.01 - self.clock.now())
        image = np.full((48, 64, 3), self.last % 250, np.uint8)
        return CameraFrame(image, self.last / 50.0 + self.shift)

    def close(self):
        pass
