"""What can go wrong with a research study."""

from app.core.errors import AcusError


class ResearchError(AcusError):
    """A research study that cannot be read, begun, gone on with or handed out; says what to do."""
