"""Pictures of a demonstration show slices and words as they are when the numbers are."""

import numpy as np
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from app.planning.needle_overlay import NeedleOverlay
from app.views.shell.demonstration import StillPictures
from app.views.slices.pane import SlicePane
from app.views.slices.panes import PaneId
from app.views.slices.presets import default_window
from app.views.slices.viewing import Viewing


def pixels(pictures: StillPictures, name: str) -> QImage:
    return pictures._taken[name].toImage()


def test_a_picture_shows_the_needle_that_came_just_now(
    application, volume, destroy, settle, tmp_path
) -> None:
    viewing, window = Viewing(default_window()), QWidget()
    pane = SlicePane(viewing, PaneId.AXIAL, window)
    destroy(window)
    window.resize(280, 240)
    pane.resize(280, 240)
    window.show()
    viewing.set_volume(volume)
    middle = viewing.cursor_mm
    for depth in (-10.0, 5.0):
        settle(lambda: pane.canvas.is_settled)
        tip = middle + [0.0, depth, 0.0]
        viewing.set_needle(NeedleOverlay(tip - [0.0, 40.0, 0.0], tip))
    pictures = StillPictures(window, tmp_path)
    pictures.take("now")
    settle(lambda: pane.canvas.is_settled)
    settle()
    pictures.take("at rest")
    assert pixels(pictures, "now") == pixels(pictures, "at rest")
    viewing.pictures.close()


def test_a_picture_shows_words_that_have_just_grown_whole(
    application, destroy, settle, tmp_path
) -> None:
    window = QWidget()
    column, words = QVBoxLayout(window), QLabel("–")
    words.setWordWrap(True)
    column.addWidget(words)
    column.addStretch(1)
    destroy(window)
    window.resize(120, 200)
    window.show()
    settle()
    words.setText("the depth is not measured at this moment, and that takes several lines")
    pictures = StillPictures(window, tmp_path)
    pictures.take("now")
    settle()
    pictures.take("at rest")
    assert pixels(pictures, "now") == pixels(pictures, "at rest")
    assert np.isclose(words.height(), words.heightForWidth(words.width()), atol=1)
