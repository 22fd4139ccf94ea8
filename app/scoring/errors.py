"""Errors of scoring."""

from app.core.errors import AcusError


class ScoringError(AcusError):
    """Root of the scoring errors."""


class TrajectoryError(ScoringError, ValueError):
    """Samples that cannot be an attempt: wrong shape, not finite, or time that does not rise."""


class MetricUnavailableError(ScoringError):
    """A metric that this attempt does not allow to compute; the message says why."""


class MetricNotAskedError(MetricUnavailableError):
    """A metric of something that the exercise does not have: no row, unless it has a tolerance."""


class MetricError(ScoringError, TypeError):
    """A file in `scoring/metrics` that is not a metric."""


class UnknownMetricError(ScoringError, KeyError):
    """A tolerance for a metric that does not exist; the message lists those that do."""

    def __str__(self) -> str:
        return str(self.args[0])


class ToleranceError(ScoringError, ValueError):
    """Bands that run against the direction of their metric."""


class ReliabilityError(ScoringError, ValueError):
    """Points that reliability or a pass mark cannot be told from; says what would do."""


class ScoreFormatError(ScoringError, ValueError):
    """A stored score that cannot be read back."""
