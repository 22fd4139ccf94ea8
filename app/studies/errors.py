"""Errors of the studies room."""

from app.core.errors import AcusError


class StudyError(AcusError, ValueError):
    """A study that does not exist, or one that is not built as it must be."""
