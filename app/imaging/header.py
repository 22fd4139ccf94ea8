"""The header of one DICOM image file: what a CT series needs of it, and where its pixels lie."""

from dataclasses import dataclass
from pathlib import Path

from app.imaging.pixel_data import PixelData, PixelFormat

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Identity:
    """Which object a file holds. Patient and study appear only inside the pseudonym."""

    sop_uid: str
    sop_class: str
    series_uid: str
    modality: str
    image_type: tuple[str, ...]
    label: str
    pseudonym: str
    frame_of_reference: str


@dataclass(frozen=True, slots=True)
class Plane:
    """Where the pixels of one file lie in the patient (DICOM PS3.3 C.7.6.2).

    Attributes:
        position_mm: centre of the first pixel, LPS.
        orientation: direction of growing column index, then of growing row index, unit vectors.
        pixel_spacing_mm: distance between rows, then between columns.
    """

    position_mm: Point
    orientation: tuple[float, float, float, float, float, float]
    pixel_spacing_mm: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Rescale:
    """Stored value to Hounsfield units: `hu = slope * stored + intercept`."""

    slope: float
    intercept: float


@dataclass(frozen=True, slots=True)
class SliceHeader:
    """One image of a series: a file, or one frame of a multi-frame file.

    Attributes:
        plane: None where position, orientation or spacing is absent.
        rescale: None where the file gives no Hounsfield units.
        damage: what makes the file unreadable; empty when nothing does.
        frame: which frame of the file, from 0.
    """

    path: Path
    identity: Identity
    format: PixelFormat
    plane: Plane | None
    rescale: Rescale | None
    windows: tuple[tuple[float, float], ...]
    pixels: PixelData
    damage: str
    frame: int = 0
