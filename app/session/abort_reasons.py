"""Reasons for which this program itself breaks an attempt off, as they stand in records.

A record holds the English text; here it becomes the sentence again that it was, which is shown in
the user's language. Every other reason, such as a fault's own words, stays as it is.
"""

from typing import Final

from app.core.messages import sentence

__all__ = [
    "BY_USER",
    "OTHER_PATIENT",
    "TRAINER_CLOSED",
    "WINDOW_CLOSED",
    "abort_words",
    "known_reason",
]

BY_USER: Final = sentence("by the user")
OTHER_PATIENT: Final = sentence("another patient was opened")
WINDOW_CLOSED: Final = sentence("the window was closed")
TRAINER_CLOSED: Final = sentence("the trainer was closed")

_KNOWN: Final = {str(one): one for one in (BY_USER, OTHER_PATIENT, WINDOW_CLOSED, TRAINER_CLOSED)}
_BEFORE: Final = "aborted: "


def known_reason(reason: str) -> str:
    """Return a reason of a record as the sentence that it was, where it is one of this program."""
    return _KNOWN.get(reason, reason)


def abort_words(reason: str) -> str:
    """Say that an attempt was aborted, and why.

    Args:
        reason: alone, or as an event of a record says it, after `aborted: `.
    """
    return sentence("aborted: {reason}", reason=known_reason(reason.removeprefix(_BEFORE)))
