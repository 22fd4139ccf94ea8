"""Errors of the tracking room."""

from app.core.errors import AcusError, ConfigurationError


class TrackingError(AcusError):
    """Something about cameras, pictures or fixes that cannot be used."""


class RigError(TrackingError, ConfigurationError):
    """A rig profile that describes no usable pair of cameras."""


class CameraError(TrackingError):
    """A camera that cannot be opened or delivers no picture."""


class CalibrationError(TrackingError):
    """Pictures, boards or files from which no calibration can be had."""
