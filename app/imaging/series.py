"""What a folder holds: series, usable or not, and the files that belong to none.

A recipe says what was asked for on the way from files to a volume: the same can be asked again.
"""

import hashlib
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from app.imaging.header import Point, SliceHeader

NO_REMEDY = "none"
"""In the place of a remedy's name: the series is read as it is. No remedy may be called so."""


class Refusal(StrEnum):
    """What keeps a series from being read as it is; the first of several."""

    NOTHING = "nothing"
    UNEVEN = "uneven"  # the places of its slices alone
    TOO_LARGE = "too large"  # the memory alone
    OTHER = "other"  # its `reason` says what


@dataclass(frozen=True, slots=True)
class Ignored:
    """A file that belongs to no series, and why."""

    path: Path
    reason: str


@dataclass(frozen=True, slots=True)
class Series:
    """One series of a folder, or one pass of a series that holds several over the same places.

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
        part: which pass of the series, such as "acquisition-2"; empty where it is all of it.
        refusal: which kind of reason it is.
        remedies: names of the remedies that make a refused series readable on request, or a usable
            one better; see `imaging.remedies`.
        notes: what a reader should know though it keeps nothing from being read.
        unit: of the values, "HU"; empty for MR and others without one.
        tilt_deg: angle between the slices' normal and their stacking direction (gantry tilt);
            0 below what counts as one.
        volume_file: the file of a format that holds a whole volume (NIfTI); then no `slices`.
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
    part: str = ""
    refusal: Refusal = Refusal.NOTHING
    remedies: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    unit: str = "HU"
    tilt_deg: float = 0.0
    volume_file: Path | None = None

    @property
    def key(self) -> str:
        """Name of the series in its folder: its UID, with `#part` where it is one pass of it."""
        return f"{self.uid}#{self.part}" if self.part else self.uid

    @property
    def remedy(self) -> str:
        """Name of the remedy that is offered first; `NO_REMEDY` where none is."""
        return self.remedies[0] if self.remedies else NO_REMEDY

    @property
    def frame(self) -> str:
        """Stands for the frame of reference where positions are compared; empty without one.

        The UID itself can lead to the patient and is never written.
        """
        uid = self.frame_of_reference
        return hashlib.sha256(uid.encode()).hexdigest()[:16] if uid else ""

    @property
    def files(self) -> tuple[Path, ...]:
        """Files of the series, each once, in the order of `slices`."""
        if self.volume_file is not None:
            return (self.volume_file,)
        return tuple(dict.fromkeys(header.path for header in self.slices))


@dataclass(frozen=True, slots=True)
class Listing:
    """Everything found in a folder.

    Attributes:
        path: what was searched.
        series: usable or not.
        ignored: files that belong to none.
        root: folder that files are named relative to; `path` where None.
        keeper: holds the files of an unpacked archive for as long as the listing lives.
    """

    path: Path
    series: tuple[Series, ...]
    ignored: tuple[Ignored, ...]
    root: Path | None = None
    keeper: Any = field(default=None, compare=False, repr=False)

    @property
    def usable(self) -> tuple[Series, ...]:
        """Series that can be read as a volume."""
        return tuple(series for series in self.series if series.usable)

    def shown(self, path: Path) -> str:
        """Name of a file of the listing, relative to what was searched."""
        try:
            return str(path.relative_to(self.root or self.path))
        except ValueError:
            return str(path)


@dataclass(frozen=True, slots=True)
class Recipe:
    """How a series was read, or is to be; `reading.read_again` follows it.

    Attributes:
        remedy: name of the remedy that was asked for; `NO_REMEDY` for none.
        factors: voxels along i, j and k that were averaged to one.
        spacing_mm: of the slices that were made; None where none were.
    """

    remedy: str = NO_REMEDY
    factors: tuple[int, int, int] = (1, 1, 1)
    spacing_mm: float | None = None


AS_IT_IS = Recipe()
"""Read without asking for anything."""
