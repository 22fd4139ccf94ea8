"""What can go wrong with a PACS; no message quotes a patient's data."""

from app.imaging.errors import ImagingError


class PacsError(ImagingError):
    """Root of the PACS errors."""


class PacsUnreachableError(PacsError, OSError):
    """No connection: host unknown, refused, silent, or lost in the middle."""


class PacsRefusedError(PacsError):
    """The PACS does not accept this program, or not what it asks for."""


class PacsDataError(PacsError, ValueError):
    """The PACS sent something else than it was asked for, or not all of it."""
