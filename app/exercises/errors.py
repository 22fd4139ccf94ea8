"""Errors of exercises."""

from app.core.errors import AcusError, ConfigurationError


class ExerciseError(ConfigurationError):
    """An exercise file that cannot be used; names file, field, value and what would be valid."""


class UnknownExerciseError(AcusError, LookupError):
    """No exercise has that name; the message lists those that exist."""
