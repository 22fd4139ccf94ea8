"""What can be wrong with structures and their files."""

from app.imaging.errors import ImagingError


class StructureError(ImagingError, ValueError):
    """A structure that cannot be: empty, off the CT, or a name that is taken or unknown."""


class StructureFileError(StructureError):
    """A file that cannot be read as structures, or not be written; says what is wrong with it."""


class FrameOfReferenceError(StructureError):
    """The file was drawn on another frame of reference than that of the CT."""


class ExtraMissingError(StructureError, ImportError):
    """A package of an extra is not installed; the message names the extra."""
