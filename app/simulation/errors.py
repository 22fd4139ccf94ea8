"""Errors of the simulation room."""

from app.core.errors import AcusError


class SimulationError(AcusError, ValueError):
    """A scene, effect or plant that cannot be simulated as described."""
