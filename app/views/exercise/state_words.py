"""Names of recorded states for people."""

from app.views.kit.text import tr


def state_word(state: str) -> str:
    """Name of a recorded state; unknown ones as they stand."""
    return {
        "ready": tr("Ready"),
        "withdrawing": tr("Withdrawing"),
        "aligning": tr("Aligning"),
        "inserting": tr("Inserting"),
        "holding": tr("Holding"),
        "paused": tr("Paused"),
        "ended": tr("Ended"),
        "aborted": tr("Aborted"),
        "unfinished": tr("Unfinished"),
        "broken": tr("Broken"),
    }.get(state, state)
