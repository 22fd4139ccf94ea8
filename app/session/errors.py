"""What can go wrong with an attempt and its record."""

from app.core.errors import AcusError


class SessionError(AcusError):
    """Root of the errors of an attempt, its record and its store."""


class IllegalTransitionError(SessionError):
    """An event that the attempt's state does not know; the message names the legal ones."""


class ScanNotPossibleError(SessionError):
    """A control scan while nobody knows where the needle is; it is not counted."""


class ProcedureNotPossibleError(SessionError):
    """A step of the procedure cannot be done now; nothing has changed."""


class ControlLockedError(SessionError):
    """A control that the exercise keeps as it is."""


class NotReadyError(SessionError):
    """The robot's loop has not reported yet (its kernels are being loaded)."""


class RecordingError(SessionError):
    """A record cannot be written (disk full, folder not writable, name already taken)."""


class BrokenRecordingError(SessionError):
    """A file that is not a readable record of an attempt; the message says why."""


class BudgetExceededError(BrokenRecordingError):
    """A record that would take more memory than one of its size may; nothing of it is used."""


class SessionNotFoundError(SessionError):
    """No session, or more than one, has this id."""


class ReplayError(SessionError):
    """A record that cannot be computed once more; the message says what it lacks."""


class PeopleError(SessionError):
    """Something about a person that cannot be done; says what would be valid."""


class ScriptsSetNoMarkError(SessionError):
    """Scripts, not people: what they do sets no pass mark."""
