"""Errors of commissioning."""

from app.device.errors import DeviceError


class CommissioningError(DeviceError):
    """A routine found something wrong; the message says what, and what to do."""


class RecordError(DeviceError):
    """The record of a device cannot be read or written; the file stays as it is."""
