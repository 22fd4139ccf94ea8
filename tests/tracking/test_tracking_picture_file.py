"""Pictures from files: read as they are stored, and none that stands for gigabytes."""

import struct
import subprocess
import sys
import zlib
from pathlib import Path

import cv2
import numpy as np
import pytest
from board_pictures import board_picture, board_pose
from calibration_rig import usual_rig

from app.tracking.calibration.pictures import list_pictures, read_view
from app.tracking.calibration.views import BoardView, Rejection
from app.tracking.cameras.files import read_picture
from app.tracking.errors import CalibrationError, CameraError

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


def huge(ending: str, side: int = 30000) -> bytes:
    """Return a small picture file whose header says that it has so many columns and rows."""
    both = struct.pack(">II", side, side)
    if ending == "png":  # all of it, compressed to a few hundred kilobytes
        rows = zlib.compressobj(9)
        pixels = b"".join(rows.compress(bytes(1 + side // 8)) for _ in range(side)) + rows.flush()
        head = both + bytes([1, 0, 0, 0, 0])
        parts = ((b"IHDR", head), (b"IDAT", pixels), (b"IEND", b""))
        chunks = [
            struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
            for name, data in parts
        ]
        return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)
    if ending == "jpg":
        data = bytearray(jpeg(1))
        at = data.index(b"\xff\xc0")
        data[at + 5 : at + 9] = struct.pack(">HH", side, side)
    elif ending == "bmp":
        data = bytearray(cv2.imencode(".bmp", STORED)[1].tobytes())
        data[18:26] = struct.pack("<ii", side, side)
    elif ending == "pgm":
        data = bytearray(b"P5 # of a camera\n%d %d\n255\n" % (side, side) + bytes(100))
    else:
        data = bytearray(WRITERS[ending](1))
        order, size, word = ("<", 12, "I") if ending == "tif" else (">", 20, "Q")
        at = 8 + 2 if ending == "tif" else 16 + 8
        for k in range(2):
            struct.pack_into(f"{order}I", data, at + k * size + (8 if word == "I" else 12), side)
    return bytes(data)


LOOK = """
import sys
from pathlib import Path
from app.tracking.cameras.files import read_picture
from app.tracking.errors import CameraError
for path in sorted(Path(sys.argv[1]).iterdir()):
    try:
        print(path.name, read_picture(path).shape)
    except CameraError as error:
        print(error)
# Not ru_maxrss: a process begins with the peak of the one that started it.
status = Path("/proc/self/status").read_text()
print(int(status.split("VmHWM:")[1].split()[0]) // 1024)
"""


@pytest.mark.long("statistics")
def test_a_small_file_that_stands_for_gigabytes_is_refused_before_it_is_decoded(
    tmp_path: Path,
) -> None:
    endings = ("png", "jpg", "bmp", "pgm", "tif", "tiff")
    for ending in endings:
        (tmp_path / f"bomb.{ending}").write_bytes(huge(ending))
    done = subprocess.run(
        [sys.executable, "-c", LOOK, str(tmp_path)], capture_output=True, text=True, check=True
    )
    *lines, megabytes = done.stdout.splitlines()
    for line, ending in zip(lines, sorted(endings), strict=True):
        assert f"bomb.{ending} has more than 8192 x 8192 pixels, which are the most" in line
    assert int(megabytes) < 600  # one of them decoded takes 2700
    result = read_view(tmp_path / "bomb.png", RIG.board)
    assert isinstance(result, Rejection)
    assert (result.name, "8192 x 8192" in result.text) == ("bomb.png", True)


@pytest.mark.long("statistics")
def test_a_picture_of_a_large_camera_is_read(tmp_path: Path) -> None:
    for ending in ("png", "jpg", "bmp", "webp", "pgm", "tif", "tiff"):
        image = np.zeros((3000, 4000) if ending == "pgm" else (3000, 4000, 3), np.uint8)
        path = tmp_path / f"large.{ending}"
        path.write_bytes(cv2.imencode(f".{ending}", image)[1].tobytes())
        assert read_picture(path).shape == (3000, 4000, 3)


@pytest.mark.parametrize(("data", "said"), [(b"", "no picture"), (b"GIF89a" + bytes(99), "no pic")])
def test_what_is_no_picture_of_a_known_format_is_refused(
    tmp_path: Path, data: bytes, said: str
) -> None:
    path = tmp_path / "other.png"
    path.write_bytes(data)
    with pytest.raises(CameraError, match=said):
        read_picture(path)


def test_a_folder_of_thousands_of_pictures_is_refused_before_one_is_read(tmp_path: Path) -> None:
    for number in range(2001):
        (tmp_path / f"{number}.png").touch()
    with pytest.raises(CalibrationError, match=r"2001 pictures in .*, 2000 are the most"):
        list_pictures(tmp_path)
