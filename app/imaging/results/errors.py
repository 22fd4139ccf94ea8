"""What keeps an attempt from being written as DICOM objects."""

from app.imaging.errors import ImagingError


class ResultsError(ImagingError, ValueError):
    """A CT that no object may or can refer to, or a folder that cannot be written."""
