"""What is written over the 3D picture can be read on its background."""

import numpy as np
import pytest
from PySide6.QtCore import QRect
from PySide6.QtGui import QColor, QImage, QPainter

from app.views.scene.display import ORGAN_COLOURS, Display
from app.views.scene.words import draw_words

PANE = QRect(0, 0, 300, 160)


def written(display, legend):
    """Luma of every pixel of a pane with its words, 0 to 255."""
    image = QImage(PANE.size(), QImage.Format.Format_RGB32)
    image.fill(QColor(display.background))
    painter = QPainter(image)
    draw_words(painter, PANE, display, 0.0, legend, "")
    painter.end()
    pixels = np.frombuffer(image.constBits(), np.uint8).reshape(PANE.height(), PANE.width(), 4)
    return pixels[..., :3] @ np.array([0.114, 0.587, 0.299])


@pytest.mark.parametrize("light", [False, True])
@pytest.mark.parametrize("colour", [*ORGAN_COLOURS.values(), "#ffffff"])
def test_every_organ_of_the_legend_stands_out_from_the_background(application, colour, light):
    shade, display = QColor(colour), Display(light=light)
    luma = written(display, (((shade.red(), shade.green(), shade.blue()), "Organ"),))
    title = written(display, ())
    new = luma[luma != title]
    assert np.abs(new - luma[0, 0]).max() > 40.0
