"""The phantom as a folder of DICOM CT Image Storage files: made once, kept in the cache.

It lies on a scanner's grid: what every slice shares is drawn first, then its blur and noise.
"""

import hashlib
import os
import shutil
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from pydicom.dataset import FileDataset, FileMetaDataset
from pydicom.uid import UID, ExplicitVRLittleEndian
from scipy import ndimage

from app.core import paths
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.phantom import trunk
from app.imaging.phantom.canvas import AIR, Canvas
from app.imaging.phantom.grid import Grid
from app.imaging.phantom.lesion import make_patient
from app.imaging.phantom.patient import MODEL_TOP, Patient
from app.imaging.phantom.shapes import Field, cover
from app.imaging.phantom.vessels import vasculature

_CT_IMAGE: Final = UID("1.2.840.10008.5.1.4.1.1.2")
_INTERCEPT: Final = -1024


def uid(*parts: object) -> UID:
    """UID under 2.25 (PS3.5 B.2) made from what it stands for, the same every time."""
    digest = hashlib.sha256(repr(parts).encode()).digest()[:16]
    return UID(f"2.25.{int.from_bytes(digest, 'big')}")


def write_slice(
    path: Path, hu: NDArray[np.int16], seed: int, index: int, position_mm: Any, spacing_mm: Any
) -> None:
    """Write one file.

    Args:
        path: where to.
        hu: Hounsfield values, -1024 to 3071, shape (rows, columns).
        seed: of the patient.
        index: of the slice, from 0 at the feet.
        position_mm: LPS of the first pixel.
        spacing_mm: between pixels and between slices.
    """
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID = _CT_IMAGE
    meta.MediaStorageSOPInstanceUID = uid("phantom", seed, hu.shape, spacing_mm, index)
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    file = FileDataset(str(path), {}, file_meta=meta, preamble=b"\0" * 128)
    _identify(file, seed, index, (seed, hu.shape, spacing_mm))
    _place(file, position_mm, spacing_mm)
    _pixels(file, hu)
    file.save_as(path, enforce_file_format=True)


def _identify(file: FileDataset, seed: int, index: int, series: tuple[Any, ...]) -> None:
    file.SOPClassUID = file.file_meta.MediaStorageSOPClassUID
    file.SOPInstanceUID = file.file_meta.MediaStorageSOPInstanceUID
    file.ImageType = ["ORIGINAL", "PRIMARY", "AXIAL"]
    file.Modality = "CT"
    file.Manufacturer = "Acus"
    file.ManufacturerModelName = "procedural phantom"
    file.PatientName = f"Phantom^Seed{seed}"
    file.PatientID = f"PHANTOM-{seed}"
    file.StudyInstanceUID = uid("study", *series)
    file.SeriesInstanceUID = uid("series", *series)
    file.FrameOfReferenceUID = uid("frame", seed)
    file.BodyPartExamined = "ABDOMEN"
    file.SeriesDescription = "Procedural torso"
    file.StudyID = str(seed)
    file.SeriesNumber, file.AcquisitionNumber, file.InstanceNumber = 1, 1, index + 1
    for empty in (
        "PatientBirthDate",
        "PatientSex",
        "StudyDate",
        "StudyTime",
        "AccessionNumber",
        "ReferringPhysicianName",
        "PositionReferenceIndicator",
    ):
        setattr(file, empty, "")  # type 2: present, value unknown


def _place(file: FileDataset, position_mm: Any, spacing_mm: Any) -> None:
    pixel, between = spacing_mm
    file.PatientPosition = "HFS"
    file.ImagePositionPatient = [f"{value:.6f}" for value in position_mm]
    file.ImageOrientationPatient = [1, 0, 0, 0, 1, 0]
    file.PixelSpacing = [f"{pixel:.6f}", f"{pixel:.6f}"]
    file.SliceThickness = f"{between:.6f}"
    file.KVP, file.ConvolutionKernel = "120", "SOFT"


def _pixels(file: FileDataset, hu: NDArray[np.int16]) -> None:
    file.SamplesPerPixel, file.PhotometricInterpretation = 1, "MONOCHROME2"
    file.Rows, file.Columns = hu.shape
    file.BitsAllocated, file.BitsStored, file.HighBit, file.PixelRepresentation = 16, 12, 11, 0
    file.RescaleSlope, file.RescaleIntercept, file.RescaleType = "1", str(_INTERCEPT), "HU"
    file.WindowWidth, file.WindowCenter = "400", "40"
    file.PixelData = (hu - _INTERCEPT).astype("<u2").tobytes()


_HALF_X, _HALF_Y = 170.0, 120.0
"""The body fits between these model coordinates [mm]."""

_NOISE_TILE: Final = 1024


@dataclass(frozen=True, eq=False)
class Scan:
    """A patient on a scanner's grid.

    Attributes:
        patient: who.
        rows: rows and columns of a slice.
        pixel_mm: distance between pixels.
    """

    patient: Patient
    rows: int
    pixel_mm: float

    def slice_hu(self, z_mm: float, index: int) -> NDArray[np.int16]:
        """Hounsfield values of the slice at patient height z [mm], shape (rows, rows).

        Args:
            z_mm: LPS height.
            index: number of the slice, which seeds its noise.
        """
        rows, columns = self._body_box
        image = self._room.copy()
        body = Canvas(self.grid, z_mm / self.patient.scale[2], image[rows, columns])
        body.paint_all()
        return self._measured(image, index)

    def _measured(self, image: Field, index: int) -> NDArray[np.int16]:
        """Blur and noise of a scanner with a soft kernel."""
        sharp = ndimage.gaussian_filter(image, 0.45 / self.pixel_mm, mode="nearest", truncate=3.0)
        rng = np.random.default_rng([self.patient.seed, 1000 + index])
        row, column = rng.integers(0, max(1, _NOISE_TILE - self.rows), 2)
        window = self._noise[row : row + self.rows, column : column + self.rows]
        sharp += window * (self._noise_profile * (-1.0 if rng.random() < 0.5 else 1.0))
        return np.clip(np.rint(sharp), -1024.0, 3071.0).astype(np.int16)

    def axis(self, axis: int) -> Field:
        """Model coordinates of the columns (0) or rows (1), shape (rows,)."""
        steps = np.arange(self.rows, dtype=np.float32) - (self.rows - 1) / 2
        result: Field = (steps * (self.pixel_mm / self.patient.scale[axis])).astype(np.float32)
        return result

    @cached_property
    def _body_box(self) -> tuple[slice, slice]:
        def span(axis: Field, half: float) -> slice:
            first, last = np.searchsorted(axis, (-half, half))
            return slice(int(first), int(last))

        return span(self.axis(1), _HALF_Y), span(self.axis(0), _HALF_X)

    @cached_property
    def grid(self) -> Grid:
        """The part of the grid that holds the body."""
        rows, columns = self._body_box
        return Grid(
            self.patient,
            self.axis(0)[None, columns],
            self.axis(1)[rows, None],
            self.pixel_mm,
            vasculature(self.patient),
        )

    @cached_property
    def _room(self) -> Field:
        """Air and the table."""
        image = np.full((self.rows, self.rows), AIR, np.float32)
        x, y = self.axis(0)[None, :], self.axis(1)[:, None]
        top = trunk.HALF_DEPTH_BACK + 7.0 - 26.0 * (x / 190.0) ** 2
        for depth, half, hu in ((1.2, 1.2, -380.0), (16.0, 13.0, -955.0), (31.0, 1.2, -420.0)):
            share = cover(np.abs(y - top - depth) - half, self.pixel_mm)
            image += share * (np.float32(hu) - image)
        return image

    @cached_property
    def _noise(self) -> Field:
        """Correlated noise of the patient's standard deviation; each slice shows a part of it."""
        white: Any = self.patient.generator(7).standard_normal((_NOISE_TILE,) * 2, np.float32)
        noise = ndimage.gaussian_filter(white, min(0.7 / self.pixel_mm, 2.0), mode="wrap")
        return noise * np.float32(self.patient.noise_hu / noise.std())

    @cached_property
    def _noise_profile(self) -> Field:
        """Noise is strongest in the middle of the body and falls off into the air."""
        rho = np.hypot(self.axis(0)[None, :], self.axis(1)[:, None])
        return (0.45 + 0.75 * np.exp(-((rho / 120.0) ** 2))).astype(np.float32)


_FIELD_MM: Final = 384.0
_THREADS: Final = 2


def phantom_series(
    seed: int = 1, progress: Progress | None = None, *, slices: int = 300, rows: int = 512
) -> Path:
    """Folder of the DICOM CT series of a phantom patient, made at the first call.

    Args:
        seed: which patient, 0 or more.
        progress: told how far the making is; cancels it, leaving nothing behind.
        slices: number of slices over the 300 mm from iliac crests to lung bases.
        rows: rows and columns of a slice, over 384 mm.

    Raises:
        ConfigurationError: if a number is out of range.
        Cancelled: if `progress` was cancelled.
    """
    if seed < 0 or not 2 <= slices <= 2000 or not 16 <= rows <= 2048:
        raise ConfigurationError(
            sentence(
                "phantom seed {seed}, {slices} slices, {rows} rows: the seed must be 0 or more, "
                "slices 2 to 2000 and rows 16 to 2048",
                seed=seed,
                slices=slices,
                rows=rows,
            )
        )
    name = f"seed{seed}-{slices}x{rows}"
    folder = paths.cache() / "phantom" / f"{name}-{_version()}"
    if not folder.is_dir():
        _make(folder, seed, slices, rows, progress or Progress())
        for older in set(folder.parent.glob(f"{name}-*")) - {folder}:
            shutil.rmtree(older, ignore_errors=True)  # made by an earlier version of the program
    return folder


def _version() -> str:
    """Digest of the code that makes the phantom, so that an older one is never taken for it."""
    digest = hashlib.sha256()
    for file in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(file.read_bytes())
    return digest.hexdigest()[:10]


def _make(folder: Path, seed: int, slices: int, rows: int, progress: Progress) -> None:
    """Write beside, then rename: the folder is there whole or not at all."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    beside = Path(tempfile.mkdtemp(dir=folder.parent, prefix=".making-"))
    try:
        _write_all(beside, seed, slices, rows, progress)
        beside.chmod(0o755)
        try:
            os.rename(beside, folder)
        except OSError:
            if not folder.is_dir():  # another process made it meanwhile: take that one
                raise
    finally:
        shutil.rmtree(beside, ignore_errors=True)


def _write_all(folder: Path, seed: int, slices: int, rows: int, progress: Progress) -> None:
    pixel, between = _FIELD_MM / rows, MODEL_TOP / slices
    progress.report(0.0, sentence("phantom patient {seed}", seed=seed))
    scan = Scan(make_patient(seed), rows, pixel)
    corner = -(rows - 1) / 2 * pixel

    def write(index: int) -> None:
        z = index * between
        hu = scan.slice_hu(z, index)
        name = folder / f"IM{index + 1:04d}.dcm"
        write_slice(name, hu, seed, index, (corner, corner, z), (pixel, between))

    write(0)  # fills what all slices share before the threads start
    with ThreadPoolExecutor(_THREADS) as pool:
        try:
            for done, _ in enumerate(pool.map(write, range(1, slices)), start=2):
                progress.report(
                    done / slices,
                    sentence("phantom slice {ready} of {slices}", ready=done, slices=slices),
                )
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
