"""What can be wrong with a folder, a series, a file or a point."""

from typing import TYPE_CHECKING

from app.core.errors import AcusError

if TYPE_CHECKING:
    from app.imaging.series import Series


class ImagingError(AcusError):
    """Root of this room's errors."""


class FolderError(ImagingError, OSError):
    """The path does not exist, is not a folder, cannot be read, or holds no DICOM file."""


class FileDamagedError(ImagingError, ValueError):
    """A file cannot be read as the DICOM image that it claims to be."""


class NotExactError(Exception):
    """A value does not fit 16 bits; read again as float32. Nobody outside is told."""


class WorkerLostError(FileDamagedError):
    """A file made the process that reads it crash or hang; that process was replaced.

    Args:
        message: for whoever wanted the file.
        reason: what the process did, as in "was ended by SIGSEGV".
    """

    def __init__(self, message: str, reason: str = "") -> None:
        super().__init__(message)
        self.reason = reason


class WorkerError(ImagingError, RuntimeError):
    """The process that reads files cannot be started, or is not what it should be."""


class SeriesRefusedError(ImagingError, ValueError):
    """The series cannot be made into a volume; the message says why."""


class TooLargeError(SeriesRefusedError):
    """The volume does not fit the memory; the message says what would.

    Attributes:
        offer: the series as one that can be read at half size; None where that does not help.
    """

    def __init__(self, message: str, offer: "Series | None" = None) -> None:
        super().__init__(message)
        self.offer = offer


class SeriesUnknownError(ImagingError, LookupError):
    """No series, or no file, of that identifier is in the folder."""


class SeriesAmbiguousError(ImagingError, LookupError):
    """Several usable CT series and none was named.

    Attributes:
        series: the usable ones, to choose from.
    """

    def __init__(self, message: str, series: "tuple[Series, ...]" = ()) -> None:
        super().__init__(message)
        self.series = series


class OutsideImageError(ImagingError, IndexError):
    """A voxel, pixel, slice or point lies outside the image."""


class InvalidEntryError(ImagingError, ValueError):
    """An entry that does not lie on the skin.

    Attributes:
        distance_mm: how far the nearest skin is [mm].
    """

    def __init__(self, message: str, distance_mm: float) -> None:
        super().__init__(message)
        self.distance_mm = distance_mm


class BeadError(ImagingError, ValueError):
    """No bead where one was clicked: nothing bright, too large, or cut off by the CT's edge."""


class ScanOrderError(ImagingError, ValueError):
    """A control scan that no scanner takes: too few or too many slices, or of no thickness."""


def brief(error: BaseException) -> str:
    """Kind of a foreign error and where it comes from, without its words: they quote the file."""
    trace, module = error.__traceback__, ""
    while trace is not None:
        module = trace.tb_frame.f_globals.get("__name__", module)
        trace = trace.tb_next
    return f"{type(error).__name__} in {module}" if module else type(error).__name__
