"""What a folder holds: series, usable or not, and the files that belong to none."""

from dataclasses import dataclass
from pathlib import Path

from app.imaging.header import Point, SliceHeader


@dataclass(frozen=True, slots=True)
class Ignored:
    """A file that belongs to no series, and why."""

    path: Path
    reason: str


@dataclass(frozen=True, slots=True)
class Series:
    """One DICOM series of a folder.

    Attributes:
        uid: SeriesInstanceUID.
        modality: as the files say.
        label: series number, body part and kernel; never free text.
        size: columns, rows, slices (I, J, K).
        spacing_mm: between columns, rows and slices; None where unknown or of one slice only.
        origin_mm: centre of voxel (0, 0, 0), LPS; None where unknown.
        direction: row-major 3×3; its columns are the directions of i, j and k; None where unknown.
        usable: whether `read_series` makes a volume of it.
        reason: why not; empty for a usable one.
        slices: headers, ascending along the slice normal where that is known.
        pseudonym: stands for patient and study.
        frame_of_reference: FrameOfReferenceUID; empty where the files do not share one.
        windows: (width, level) pairs of the files [HU].
    """

    uid: str
    modality: str
    label: str
    size: tuple[int, int, int]
    spacing_mm: Point | None
    origin_mm: Point | None
    direction: tuple[float, ...] | None
    usable: bool
    reason: str
    slices: tuple[SliceHeader, ...]
    pseudonym: str
    frame_of_reference: str
    windows: tuple[tuple[float, float], ...]

    @property
    def files(self) -> tuple[Path, ...]:
        """Files of the series, in the order of `slices`."""
        return tuple(header.path for header in self.slices)


@dataclass(frozen=True, slots=True)
class Listing:
    """Everything found in a folder."""

    path: Path
    series: tuple[Series, ...]
    ignored: tuple[Ignored, ...]

    @property
    def usable(self) -> tuple[Series, ...]:
        """Series that can be read as a volume."""
        return tuple(series for series in self.series if series.usable)
