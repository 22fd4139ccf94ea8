"""Small PNG files of what the window shows: a palette of greys for the CT, the rest for marks."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage, QPixmap

WIDEST_PX = 1280
GREYS = 72
"""Of 256 colours; the eye tells no more apart on a page."""

ALIKE = 10
"""Channels that differ by less make a grey."""


def small_png(picture: QPixmap, path: Path) -> None:
    """Write a picture with a palette of its own, scaled down to `WIDEST_PX` if it is wider.

    Raises:
        OSError: if the file cannot be written.
    """
    image = picture.toImage().convertToFormat(QImage.Format.Format_RGB888)
    if image.width() > WIDEST_PX:
        image = image.scaledToWidth(WIDEST_PX, Qt.TransformationMode.SmoothTransformation)
    data, step = bytes(image.constBits()), image.bytesPerLine()
    shown = Image.frombytes("RGB", (image.width(), image.height()), data, "raw", "RGB", step)
    indexed = shown.quantize(palette=_palette(np.asarray(shown)), dither=Image.Dither.NONE)
    indexed.save(path, optimize=True)


def _palette(pixels: NDArray[np.uint8]) -> Image.Image:
    """Return greys at even steps and the colours that stand for all others."""
    levels = np.linspace(0, 255, GREYS).round().astype(np.uint8)
    found = np.repeat(levels[:, None], 3, axis=1)
    packed = pixels.reshape(-1, 3).astype(np.uint32) @ np.array([65536, 256, 1], np.uint32)
    values, counts = np.unique(packed, return_counts=True)  # of rows it takes ten times as long
    colours = np.stack([values >> 16, values >> 8 & 255, values & 255], axis=-1).astype(np.uint8)
    spread = colours.max(axis=1).astype(int) - colours.min(axis=1)
    times = np.sqrt(counts).astype(int)  # a mark counts beside large areas
    colours = np.repeat(colours, times, axis=0)[np.repeat(spread >= ALIKE, times)]
    if len(colours):
        strip = Image.fromarray(colours[None]).quantize(256 - GREYS, Image.Quantize.MEDIANCUT)
        found = np.vstack([found, np.array(strip.getpalette(), np.uint8).reshape(-1, 3)])
    palette = Image.new("P", (1, 1))
    palette.putpalette(found.ravel().tolist())
    return palette
