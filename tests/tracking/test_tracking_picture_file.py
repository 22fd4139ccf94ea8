"""Pictures whose file asks for a turn are read as they are stored."""

import struct
import zlib
from pathlib import Path

import cv2
import numpy as np
import pytest
from board_pictures import board_picture, board_pose
from calibration_rig import usual_rig

from app.tracking.calibration.pictures import read_view
from app.tracking.calibration.views import BoardView
from app.tracking.cameras.files import read_picture

RIG = usual_rig()
POSE = board_pose(RIG.board, 0.4, 15.0, -20.0)
STORED = cv2.cvtColor(board_picture(RIG.board, RIG.left, POSE, supersample=2), cv2.COLOR_GRAY2BGR)


def exif(orientation: int) -> bytes:
    """Return a TIFF header with one entry: the orientation."""
    return b"MM\0*" + struct.pack(">IHHHIHHI", 8, 1, 0x0112, 3, 1, orientation, 0, 0)


def jpeg(orientation: int) -> bytes:
    data = cv2.imencode(".jpg", STORED, [cv2.IMWRITE_JPEG_QUALITY, 98])[1].tobytes()
    part = b"Exif\0\0" + exif(orientation)
    return data[:2] + b"\xff\xe1" + struct.pack(">H", len(part) + 2) + part + data[2:]


def png(orientation: int) -> bytes:
    data = cv2.imencode(".png", STORED)[1].tobytes()
    part = b"eXIf" + exif(orientation)
    chunk = struct.pack(">I", len(part) - 4) + part + struct.pack(">I", zlib.crc32(part))
    return data[:33] + chunk + data[33:]


def webp(orientation: int) -> bytes:
    data = cv2.imencode(".webp", STORED, [cv2.IMWRITE_WEBP_QUALITY, 101])[1].tobytes()
    height, width = STORED.shape[:2]
    size = struct.pack("<I", width - 1)[:3] + struct.pack("<I", height - 1)[:3]
    part = exif(orientation)
    body = b"WEBPVP8X" + struct.pack("<I", 10) + bytes([8, 0, 0, 0]) + size + data[12:]
    body += b"EXIF" + struct.pack("<I", len(part)) + part
    return b"RIFF" + struct.pack("<I", len(body)) + body


def tiff(orientation: int, order: str = "<", big: bool = False) -> bytes:
    height, width = STORED.shape[:2]
    pixels = np.ascontiguousarray(STORED[:, :, ::-1]).tobytes()
    fields = [(256, width), (257, height), (258, 8), (259, 1), (262, 2), (273, None)]
    fields += [(274, orientation), (277, 3), (278, height), (279, len(pixels))]
    short, word, entry = (3, "Q", "HHQ") if big else (3, "I", "HHI")
    head = 16 if big else 8
    start = head + (8 if big else 2) + (20 if big else 12) * len(fields) + (8 if big else 4)
    out = (b"II" if order == "<" else b"MM") + struct.pack(f"{order}H", 43 if big else 42)
    out += struct.pack(f"{order}HHQ", 8, 0, head) if big else struct.pack(f"{order}I", head)
    out += struct.pack(f"{order}{'Q' if big else 'H'}", len(fields))
    for tag, value in fields:
        small = tag in {258, 259, 262, 274, 277}
        kind, shown = (short, "H") if small else (4, "I")
        whole = struct.pack(f"{order}{shown}", start if value is None else value)
        out += struct.pack(f"{order}{entry}", tag, kind, 1) + whole.ljust(8 if big else 4, b"\0")
    return out + struct.pack(f"{order}{word}", 0) + pixels


def big_tiff(orientation: int) -> bytes:
    return tiff(orientation, ">", big=True)


WRITERS = {"jpg": jpeg, "png": png, "webp": webp, "tif": tiff, "tiff": big_tiff}


@pytest.mark.parametrize("ending", WRITERS)
@pytest.mark.parametrize("orientation", range(1, 9))
def test_a_picture_is_read_as_stored_whatever_its_orientation(
    tmp_path: Path, ending: str, orientation: int
) -> None:
    path = tmp_path / f"picture.{ending}"
    path.write_bytes(WRITERS[ending](orientation))
    found = read_picture(path)
    assert found.shape == STORED.shape
    assert np.abs(found.astype(int) - STORED).mean() < 3.0


@pytest.mark.parametrize("orientation", [1, 3, 6, 8])
def test_a_turned_picture_of_the_board_gives_the_same_corners(
    tmp_path: Path, orientation: int
) -> None:
    path = tmp_path / "board.jpg"
    path.write_bytes(jpeg(orientation))
    found = read_view(path, RIG.board)
    assert isinstance(found, BoardView)
    assert found.image_size == RIG.left.image_size
    truth, _ = RIG.left.project(POSE @ found.points)
    assert np.abs(found.pixels - truth).max() < 0.5
