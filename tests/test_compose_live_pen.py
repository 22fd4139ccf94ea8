"""A pen opened for the window's page: simulated, from a folder, missing."""

import time

import cv2
import numpy as np
import pytest

from app.compose.live_pen import open_live_pen
from app.tracking.cameras.watch import CameraState
from app.tracking.errors import CameraError
from app.tracking.fix import FixStatus
from app.tracking.pen.settings import PenSettings
from tests.tracking.pen_rig import camera, picture, renderer, scene


def until(so, timeout=60.0):
    end = time.monotonic() + timeout
    while not so() and time.monotonic() < end:
        time.sleep(0.01)
    return so()


@pytest.fixture
def opened():
    kept = []

    def open_it(settings):
        kept.append(open_live_pen(settings))
        return kept[-1]

    yield open_it
    for live in kept:
        live.close()
        live.close()


def test_a_simulated_pen_is_rocked_before_a_webcam_whose_lens_is_known(opened):
    live, heard = opened(PenSettings()), []
    live.listen(heard.append)
    assert until(lambda: len(heard) > 2)
    seen = live.observed()
    assert seen.fix.status is FixStatus.VALID
    assert not live.webcam().guessed
    frame = live.newest()
    assert live.newest() is frame or live.newest().time > frame.time
    assert live.health().state is CameraState.LIVE
    assert live.statistics().fault == ""
    live.listen(None)
    assert live.speed() < 0.5


def test_pictures_of_a_folder_stand_in_for_a_webcam_with_what_was_found_drawn_in(tmp_path, opened):
    frame = picture(renderer(camera()), scene()[0])
    for number in range(2):
        cv2.imwrite(str(tmp_path / f"{number}.png"), frame.image)
    live = opened(PenSettings(source=f"folder:{tmp_path}", size=(640, 480)))
    assert until(lambda: live.observed() is not None and live.newest() is not None)
    assert live.observed().needle is not None
    assert live.webcam().guessed, "no lens was named"
    assert not np.array_equal(live.newest().image, frame.image)
    assert live.settings() == ()


def test_a_folder_that_is_not_there_is_refused_by_name(tmp_path):
    with pytest.raises(CameraError, match="nowhere"):
        open_live_pen(PenSettings(source=f"folder:{tmp_path / 'nowhere'}"))
