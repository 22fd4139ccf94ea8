"""What can go wrong with the work of many."""

from app.core.errors import AcusError


class CohortError(AcusError):
    """The work cannot be begun or went no further; what is done stays done."""
