"""One slice of the phantom as a DICOM CT Image Storage file."""

import hashlib
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from pydicom.dataset import FileDataset, FileMetaDataset
from pydicom.uid import UID, ExplicitVRLittleEndian

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
    for empty in ("PatientBirthDate", "PatientSex", "StudyDate", "StudyTime", "AccessionNumber",
                  "ReferringPhysicianName", "PositionReferenceIndicator"):  # fmt: skip
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
