"""What can be wrong with a tissue field."""

from app.imaging.errors import ImagingError


class FieldError(ImagingError, ValueError):
    """A tissue field that cannot be made, read or looked up; the message says why."""
