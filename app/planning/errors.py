"""Errors of planning."""

from app.core.errors import AcusError


class PlanError(AcusError, ValueError):
    """A plan that cannot be used: incomplete, not finite, or entry and target too close."""


class MeasurementError(AcusError, ValueError):
    """A measurement that measures nothing: a point that is not finite, a region without extent."""
