"""Ours against the peer's, and both against the standard."""

import json
import os
import select
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.extras import not_installed
from app.core.messages import sentence
from app.imaging import stack
from app.imaging.filling import padding_of
from app.imaging.header import SliceHeader
from app.imaging.reading import read_pixels, read_series
from app.imaging.rescaling import padding_stands_out
from app.imaging.series import Series
from app.studies.errors import StudyError

PATIENCE = 300.0
"""Longest time that it may take for one image [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class PeerImage:
    """What the peer made of an image.

    Attributes:
        values: shape (K, J, I).
        affine_mm: (i, j, k) -> LPS, shape (4, 4).
    """

    values: NDArray[Any]
    affine_mm: FloatArray


class Peer:
    """Started at the first question, started again when a file has crashed it. Close it."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._folder = tempfile.TemporaryDirectory(prefix="acus-peer-")

    def close(self) -> None:
        """End it; idempotent."""
        self._end()
        self._folder.cleanup()

    def facts(self, files: Sequence[Path]) -> list[dict[str, Any]]:
        """Return what pydicom says of each file; nothing if it cannot read one of them."""
        answer = self._ask({"facts": [str(file) for file in files]})
        found: list[dict[str, Any]] = answer.get("facts", [])
        return found

    def image(self, files: Sequence[Path]) -> PeerImage | str:
        """Read an image; or why it cannot be read.

        Raises:
            StudyError: if SimpleITK is not installed.
        """
        with tempfile.TemporaryDirectory(dir=self._folder.name) as links:
            for number, file in enumerate(files):
                Path(links, f"{number:05d}").symlink_to(file.absolute())
            out = Path(self._folder.name, "values.npy")
            answer = self._ask(
                {"files": [str(file) for file in files], "folder": links, "out": str(out)}
            )
        if error := answer.get("error"):
            if "No module named 'SimpleITK'" in error:
                raise not_installed(
                    StudyError, sentence("SimpleITK, which this study needs,"), "bench"
                )
            return " ".join(str(error).split())
        values = np.load(out, allow_pickle=False)
        out.unlink()
        if values.ndim == 2:
            values = values[None]
        return PeerImage(values, _affine(answer)) if values.ndim == 3 else "not of 3 dimensions"

    def _ask(self, request: dict[str, Any]) -> dict[str, Any]:
        process = self._process or self._start()
        if process.stdin is None or process.stdout is None:
            return {"error": "not started"}
        try:
            process.stdin.write(json.dumps(request).encode() + b"\n")
            process.stdin.flush()
            ready, _, _ = select.select([process.stdout], [], [], PATIENCE)
            line = process.stdout.readline() if ready else b""
        except OSError:
            line = b""
        if line.endswith(b"\n"):
            answer: dict[str, Any] = json.loads(line)
            return answer
        self._end()
        return {"error": "crashed" if ready else f"took longer than {PATIENCE:.0f} s"}

    def _start(self) -> "subprocess.Popen[bytes]":
        program = Path(__file__).with_name("peer_program.py")
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-W", "ignore", str(program)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=os.environ | {"ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS": "1"},
        )
        return self._process

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            for stream in (process.stdin, process.stdout):
                if stream is not None:
                    stream.close()
            process.kill()
            process.wait()


def _affine(answer: dict[str, Any]) -> FloatArray:
    affine = np.eye(4)
    direction = np.array(answer["direction"])
    turn = direction.reshape(3, 3) if direction.size == 9 else np.eye(3)
    spacing = np.ones(3)
    spacing[: len(answer["spacing"])] = answer["spacing"]
    affine[:3, :3] = turn * spacing
    affine[: len(answer["origin"]), 3] = answer["origin"]
    return affine


VOXELS = 1000
"""Voxels drawn at random, for their place."""

ROUNDED = "equal, rounded"
"""Voxels that are the nearest 32-bit numbers to the peer's of 64 bits."""

UNEXPLAINED = "unexplained"

SAME_MM = 0.01
"""Places that differ by less are the same."""


@dataclass(frozen=True, slots=True, eq=False)
class Ours:
    """What Acus made of a series.

    Attributes:
        values: shape (K, J, I); None where nothing can be read.
        affine_mm: None where there is no volume.
        error: why reading failed although the series was not refused.
    """

    values: NDArray[Any] | None
    affine_mm: FloatArray | None
    error: str = ""


@dataclass(frozen=True, slots=True)
class SeriesAgreement:
    """How two readings compare.

    Attributes:
        values: "equal", `ROUNDED`, "to 3" for the largest difference, or why there is none.
        geometry: "equal", or how far apart the same voxel lies.
        ours_mm, peer_mm: farthest that a voxel lies from where its own file puts it; None where
            there is no volume.
        because: where the two differ, what makes them.
    """

    values: str
    geometry: str
    ours_mm: float | None
    peer_mm: float | None
    because: str = ""


def read(series: Series) -> Ours:
    """Read a series as the program would; of a refused one its slices, if they can be decoded."""
    try:
        if series.usable:
            volume = read_series(series)
            return Ours(volume.hu, volume.affine_mm)
        if not (_ordered(series) and _decodable(series.slices)):
            return Ours(None, None)
        values = read_pixels(series)
    except AcusError as error:
        return Ours(None, None, str(error))
    if len(series.slices) > 1 or series.slices[0].plane is None:
        return Ours(values, None)
    plane = series.slices[0].plane
    return Ours(values, stack.plane_affine(plane, stack.normal(plane)))


def _ordered(series: Series) -> bool:
    """Return whether both readers would put the slices into one order, though there is no
    volume.
    """
    return len(series.slices) == 1 or series.reason.startswith(("gap", "uneven", "slices shifted"))


def _decodable(headers: Sequence[SliceHeader]) -> bool:
    sizes = {(header.format.rows, header.format.columns) for header in headers}
    return len(sizes) == 1 and all(
        not header.damage
        and header.rescale is not None
        and header.format.samples == 1
        and header.format.bits_allocated in (8, 16)
        and min(header.format.rows, header.format.columns) > 0
        for header in headers
    )


def compare(series: Series, ours: Ours, theirs: PeerImage, peer: Peer) -> SeriesAgreement:
    """Compare voxels, geometry, and both with the standard."""
    if ours.values is None:
        return SeriesAgreement("", "", None, None)
    planes = standard_planes(series, peer)
    flipped = _flipped(planes, theirs)
    values = theirs.values[::-1] if flipped else theirs.values
    if values.shape != ours.values.shape:
        sizes = ("×".join(str(n) for n in reversed(v.shape)) for v in (ours.values, values))
        return SeriesAgreement("sizes {} and {}".format(*sizes), "", None, None)
    affine = _reversed(theirs) if flipped else theirs.affine_mm
    apart = ""
    if ours.affine_mm is not None:
        apart = _apart(ours.affine_mm, affine, ours.values.shape)
    off = _off(affine, planes, ours.values.shape)
    padding = _padding(series, ours.values)
    differ = _differ(ours.values, np.where(padding, ours.values, values))
    return SeriesAgreement(
        differ,
        apart,
        _off(ours.affine_mm, planes, ours.values.shape),
        off,
        "; ".join(filter(None, (_cause(series, differ), _misplacement(series, off)))),
    )


def _padding(series: Series, values: NDArray[Any]) -> NDArray[np.bool_]:
    """Return where nothing was measured and a file's own number would count as tissue; not
    compared.
    """
    masks = [
        padding_of(header, picture) if padding_stands_out(header) else None
        for header, picture in zip(series.slices, values, strict=True)
    ]
    return np.stack([np.zeros(values.shape[1:], bool) if mask is None else mask for mask in masks])


def standard_planes(series: Series, peer: Peer) -> list[Any]:
    """Return position, orientation and spacing of each slice as pydicom reads them, or nothing."""
    files = series.files
    known = dict(zip(files, peer.facts(files), strict=False))
    try:
        return [known[header.path]["planes"][header.frame] for header in series.slices]
    except (KeyError, IndexError):
        return []


def _flipped(planes: list[Any], theirs: PeerImage) -> bool:
    """Return whether the peer counts slices the other way: direction does not make a volume
    another.
    """
    if len(planes) < 2 or None in planes:
        return False
    along = np.subtract(planes[-1][0], planes[0][0])
    return float(along @ theirs.affine_mm[:3, 2]) < 0.0


def _reversed(theirs: PeerImage) -> FloatArray:
    affine = theirs.affine_mm.copy()
    affine[:3, 3] += affine[:3, 2] * (len(theirs.values) - 1)
    affine[:3, 2] *= -1.0
    return affine


def _differ(ours: NDArray[Any], theirs: NDArray[Any]) -> str:
    if np.array_equal(ours, theirs):
        return "equal"
    if ours.dtype == np.float32 and np.array_equal(ours, theirs.astype(np.float32)):
        return ROUNDED
    most = max(
        float(np.abs(a.astype(np.float64) - b.astype(np.float64)).max())
        for a, b in zip(ours, theirs, strict=True)
    )
    return f"to {most:.3g}"


def _cause(series: Series, differ: str) -> str:
    if differ == "equal":
        return ""
    slopes = {header.rescale.slope for header in series.slices if header.rescale is not None}
    broken = sorted(slope for slope in slopes if not slope.is_integer())
    if differ == ROUNDED and broken:
        return f"slope {broken[0]:g}: GDCM keeps 64 bits, Acus the nearest number of 32"
    return UNEXPLAINED


def _misplacement(series: Series, peer_mm: float | None) -> str:
    """Return why the peer puts voxels elsewhere than their files do."""
    if peer_mm is None or peer_mm < SAME_MM:
        return ""
    if series.tilt_deg:
        return f"gantry tilt {series.tilt_deg:.1f}°: GDCM stacks the slices straight"
    if series.reason.startswith(("gap", "uneven", "slices shifted")):
        return "GDCM takes the mean distance for every slice"
    return UNEXPLAINED


def _apart(ours: FloatArray, theirs: FloatArray, shape: tuple[int, ...]) -> str:
    farthest = float(np.linalg.norm((ours - theirs)[:3] @ _corners(shape), axis=0).max())
    return "equal" if farthest < SAME_MM else f"{farthest:.3g} mm apart"


def _corners(shape: tuple[int, ...]) -> FloatArray:
    k, j, i = shape
    ends = [(a, b, c, 1.0) for a in (0, i - 1) for b in (0, j - 1) for c in (0, k - 1)]
    return np.array(ends).T


def _off(affine: FloatArray | None, planes: list[Any], shape: tuple[int, ...]) -> float | None:
    """Farthest [mm] that a random voxel lies from where its file puts it (PS3.3 C.7.6.2.1.1)."""
    if affine is None or not planes or None in planes:
        return None
    random = np.random.default_rng(20)
    k, j, i = (random.integers(0, n, VOXELS) for n in shape)
    position = np.array([plane[0] for plane in planes])[k]
    turn = np.array([plane[1] for plane in planes])[k]
    spacing = np.array([plane[2] for plane in planes])[k]
    right = turn[:, :3] * (spacing[:, 1] * i)[:, None]
    down = turn[:, 3:] * (spacing[:, 0] * j)[:, None]
    there = np.stack([i, j, k], axis=1) @ affine[:3, :3].T + affine[:3, 3]
    return float(np.linalg.norm(there - (position + right + down), axis=1).max())
