"""What is written over the 3D picture can be read on its background."""

import numpy as np
import pytest
from PySide6.QtCore import QRect
from PySide6.QtGui import QColor, QImage, QPainter

from app.views.scene.display import ORGAN_COLOURS, Display
from app.views.scene.words import COMPASS_PX, draw_words, error_note, note_place

PANE = QRect(0, 0, 300, 160)


def written(display, legend, pane=PANE, error_scale=0.0, taken=None):
    """Luma of every pixel of a pane with its words, 0 to 255."""
    image = QImage(pane.size(), QImage.Format.Format_RGB32)
    image.fill(QColor(display.background))
    painter = QPainter(image)
    draw_words(painter, pane, display, error_scale, legend, "", taken)
    painter.end()
    pixels = np.frombuffer(image.constBits(), np.uint8).reshape(pane.height(), pane.width(), 4)
    return pixels[..., :3] @ np.array([0.114, 0.587, 0.299])


@pytest.mark.parametrize("light", [False, True])
@pytest.mark.parametrize("colour", [*ORGAN_COLOURS.values(), "#ffffff"])
def test_every_organ_of_the_legend_stands_out_from_the_background(application, colour, light):
    shade, display = QColor(colour), Display(light=light)
    luma = written(display, (((shade.red(), shade.green(), shade.blue()), "Organ"),))
    title = written(display, ())
    new = luma[luma != title]
    assert np.abs(new - luma[0, 0]).max() > 40.0


@pytest.mark.parametrize("width", [120, 180, 262, 400])
def test_no_line_runs_below_the_button_however_narrow_the_pane(application, width):
    pane, button = QRect(0, 0, width, 300), QRect(width - 48, 6, 42, 38)
    legend = tuple(((200, 200, 200), "a structure with quite a long name") for _ in range(3))
    luma = written(Display(), legend, pane, 10.0, button)
    below = luma[button.top() : button.bottom() + 1, button.left() : button.right() + 1]
    assert (below == luma[0, 0]).all()
    assert (luma[:, : button.left()] != luma[0, 0]).any()


def test_in_a_narrow_pane_the_scale_of_the_tips_error_is_said_in_short(application):
    assert error_note(10.0) == "Tip error 95 %, 10× enlarged"
    assert error_note(10.0, short=True) == "Error 95 %, 10×"
    wide, narrow = (QRect(0, 0, width, 200) for width in (500, 180))
    said = [(written(Display(), (), pane, 10.0) > 60.0).any(axis=0) for pane in (wide, narrow)]
    ends = [int(np.flatnonzero(columns)[-1]) for columns in said]
    assert ends[1] < 180 - 8 < ends[0]


def test_a_note_whose_word_has_no_room_beside_the_compass_stands_over_it():
    pane = QRect(0, 0, 160, 220)
    assert note_place(pane, 40).left() == 110
    above = note_place(pane, 90)
    assert above.width() >= 90
    assert above.bottom() < pane.height() - COMPASS_PX + 1
