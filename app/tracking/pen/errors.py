"""Errors of the pen."""

from app.tracking.errors import TrackingError


class PenError(TrackingError):
    """A pen with printed markers that cannot be described, found or calibrated."""
