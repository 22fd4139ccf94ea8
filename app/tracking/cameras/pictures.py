"""Writing pictures of cameras to a folder, with an outline drawn in."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.errors import CameraError

_OUTLINE = (80, 220, 80)


def write_pictures(folder: Path, images: Mapping[str, Image]) -> None:
    """Write each picture as `<name>.png`.

    Raises:
        CameraError: if one cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, image in images.items():
            if not cv2.imwrite(str(folder / f"{name}.png"), image):
                raise CameraError(f"cannot write {folder / name}.png")
    except OSError as error:
        raise CameraError(f"cannot write into {folder}: {error.strerror or error}") from error


def with_outline(image: Image, outline: FloatArray) -> Image:
    """Return a copy with a closed line [px], (m, 2); as it is without points."""
    drawn = image.copy()
    if outline.size:
        points = np.rint(outline).astype(np.int32)
        cv2.polylines(drawn, [points], True, _OUTLINE, 2, cv2.LINE_AA)
    return drawn
