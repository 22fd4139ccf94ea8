"""Errors of point-based registration."""

from app.core.errors import AcusError


class RegistrationError(AcusError, ValueError):
    """Points that cannot be registered; the message says which, why, and what to do."""


class DegenerateFiducialsError(RegistrationError):
    """Fiducials that do not fix a rotation: fewer than three, coincident, or on one line."""
