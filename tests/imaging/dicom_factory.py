"""Small DICOM CT series for tests: any orientation, any defect."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from pydicom.dataset import FileDataset, FileMetaDataset
from pydicom.uid import UID, ExplicitVRLittleEndian

CT_IMAGE = UID("1.2.840.10008.5.1.4.1.1.2")
SERIES = "2.25.1000"

TRANSVERSE = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
SAGITTAL = (0.0, 1.0, 0.0, 0.0, 0.0, -1.0)
CORONAL = (1.0, 0.0, 0.0, 0.0, 0.0, -1.0)
REVERSED = (1.0, 0.0, 0.0, 0.0, -1.0, 0.0)
FEET_FIRST_PRONE = (-1.0, 0.0, 0.0, 0.0, 1.0, 0.0)


def oblique(angle_deg: float = 30.0) -> tuple[float, ...]:
    """Transverse, turned about L and then about P."""
    a, b = np.radians(angle_deg), np.radians(0.6 * angle_deg)
    row = np.array([np.cos(b), 0.0, np.sin(b)])
    turn = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    return (*(turn @ row).tolist(), *(turn @ [0.0, 1.0, 0.0]).tolist())


@dataclass
class Slices:
    """A recipe: `write` makes one file per position along the normal."""

    orientation: tuple[float, ...] = TRANSVERSE
    origin: tuple[float, float, float] = (-20.0, 30.0, -100.0)
    spacing: tuple[float, float] = (0.8, 0.5)  # between rows, between columns
    offsets: tuple[float, ...] = (0.0, 2.0, 4.0, 6.0, 8.0)
    shape: tuple[int, int] = (12, 16)
    series: str = SERIES
    tags: dict[str, Any] = field(default_factory=dict)
    shear: float = 0.0  # drift along the columns per millimetre of normal
    signed: bool = False

    def normal(self) -> np.ndarray:
        return np.cross(self.orientation[:3], self.orientation[3:])

    def position(self, offset: float) -> np.ndarray:
        drift = self.shear * offset * np.array(self.orientation[3:])
        return np.array(self.origin) + offset * self.normal() + drift

    def stored(self, k: int) -> np.ndarray:
        """Distinct value for every voxel."""
        rows, columns = self.shape
        j, i = np.mgrid[:rows, :columns]
        return 1000 * k % 3000 + 20 * j + i

    def write(self, folder: Path, prefix: str = "s") -> list[Path]:
        folder.mkdir(parents=True, exist_ok=True)
        return [
            self.write_one(folder / f"{prefix}{97 * k % 101:03d}", k, offset)
            for k, offset in enumerate(self.offsets)
        ]

    def write_one(self, path: Path, k: int, offset: float, **tags: Any) -> Path:
        meta = FileMetaDataset()
        meta.MediaStorageSOPClassUID = CT_IMAGE
        meta.MediaStorageSOPInstanceUID = UID(f"{self.series}.{k + 1}")
        meta.TransferSyntaxUID = ExplicitVRLittleEndian
        file = FileDataset(str(path), {}, file_meta=meta, preamble=b"\0" * 128)
        self._fill(file, k, offset)
        for name, value in {**self.tags, **tags}.items():
            if value is None:
                delattr(file, name)
            else:
                setattr(file, name, value)
        file.save_as(path, enforce_file_format=True)
        return path

    def _fill(self, file: FileDataset, k: int, offset: float) -> None:
        file.SOPClassUID = CT_IMAGE
        file.SOPInstanceUID = file.file_meta.MediaStorageSOPInstanceUID
        file.StudyInstanceUID, file.SeriesInstanceUID = "2.25.1", self.series
        file.FrameOfReferenceUID = "2.25.2"
        file.Modality, file.ImageType = "CT", ["ORIGINAL", "PRIMARY", "AXIAL"]
        file.PatientName, file.PatientID = "Secret^Name", "SECRET-ID"
        file.SeriesDescription = "Secret^Name free text"
        file.SeriesNumber, file.InstanceNumber = 3, 100 - k
        file.ImagePositionPatient = [
            float(np.format_float_positional(v, 10)) for v in self.position(offset)
        ]
        file.ImageOrientationPatient = [round(v, 12) for v in self.orientation]
        file.PixelSpacing = list(self.spacing)
        file.SliceThickness = "77"
        file.SamplesPerPixel, file.PhotometricInterpretation = 1, "MONOCHROME2"
        file.Rows, file.Columns = self.shape
        file.BitsAllocated = file.BitsStored = 16
        file.HighBit, file.PixelRepresentation = 15, int(self.signed)
        file.RescaleSlope, file.RescaleIntercept = "1", "-1024"
        file.WindowWidth, file.WindowCenter = ["400", "1500"], ["40", "-600"]
        file.PixelData = self.stored(k).astype("<i2" if self.signed else "<u2").tobytes()
