"""The header of one DICOM image file: what a CT series needs of it, and where its pixels lie."""

from dataclasses import dataclass
from pathlib import Path

from app.imaging.pixel_data import PixelData, PixelFormat

Point = tuple[float, float, float]

CT_IMAGE = "1.2.840.10008.5.1.4.1.1.2"
MR_IMAGE = "1.2.840.10008.5.1.4.1.1.4"
MULTI_FRAME = {
    "1.2.840.10008.5.1.4.1.1.2.1": "enhanced CT",
    "1.2.840.10008.5.1.4.1.1.2.2": "legacy converted enhanced CT",
    "1.2.840.10008.5.1.4.1.1.4.1": "enhanced MR",
    "1.2.840.10008.5.1.4.1.1.4.4": "legacy converted enhanced MR",
}
"""SOP classes whose files hold a frame for each slice."""


@dataclass(frozen=True, slots=True)
class Identity:
    """Which object a file holds. Patient and study appear only inside the pseudonym.

    Attributes:
        owner: what says whose image it is, as (attribute, keyed digest) pairs; an attribute that
            is absent is left out. Only to be compared.
    """

    sop_uid: str
    sop_class: str
    series_uid: str
    modality: str
    image_type: tuple[str, ...]
    label: str
    pseudonym: str
    frame_of_reference: str
    owner: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class ImagePlane:
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
        frame: index of the frame in its file, from 0; 0 for a file of one image.
        thickness_mm: of the slice; None where it is not given.
        marks: what tells several passes over the same places apart, as (name, value) pairs:
            acquisition, time position and the like; never shown as they are.
        obstacle: why an image cannot be used though nothing is damaged; empty mostly.
    """

    path: Path
    identity: Identity
    format: PixelFormat
    plane: ImagePlane | None
    rescale: Rescale | None
    windows: tuple[tuple[float, float], ...]
    pixels: PixelData
    damage: str
    frame: int = 0
    thickness_mm: float | None = None
    marks: tuple[tuple[str, str], ...] = ()
    obstacle: str = ""
