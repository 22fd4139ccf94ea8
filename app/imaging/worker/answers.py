"""What became of a task: its result, or the error that ended it, in sentences that both know."""

from typing import Any

from app.core.errors import AcusError
from app.core.messages import sentence, sentence_of
from app.imaging import errors as imaging
from app.imaging.errors import FileDamagedError, WorkerLostError, brief
from app.imaging.privacy import errors as privacy
from app.imaging.structures import errors as structures
from app.imaging.worker.attachments import Attachments, AttachmentsError, opened
from app.imaging.worker.sentences import arrived, crossing
from app.imaging.worker.values import ForeignValueError, plain, reader

DONE, FAILED, SYSTEM, PROGRESS = "done", "failed", "system", "progress"

_ERRORS: dict[str, type[Exception]] = {
    name: kind
    for module in (imaging, privacy, structures)
    for name, kind in vars(module).items()
    if isinstance(kind, type) and issubclass(kind, Exception) and kind.__module__ == module.__name__
}
"""Errors that a job may end in; any other one is a file that cannot be read."""

Answer = list[Any]


def done(result: Any, attachments: Attachments) -> Answer:
    """Answer a result; its arrays become attachments."""
    there = plain(result, attachments)
    return [DONE, there, bool(attachments)]


def failed(error: BaseException, allowed: int) -> Answer:
    """Answer an error: our own in their words, foreign ones without theirs, which quote the file.

    Args:
        error: what the job ended in.
        allowed: memory that it had [bytes].
    """
    if isinstance(error, MemoryError):
        text = sentence("it needs more than {size} MB of memory to be read", size=allowed >> 20)
        return [FAILED, FileDamagedError.__name__, crossing(text)]
    if type(error).__name__ in _ERRORS:
        return [FAILED, type(error).__name__, crossing(sentence_of(error))]
    if isinstance(error, AcusError):
        return [FAILED, FileDamagedError.__name__, crossing(sentence_of(error))]
    if isinstance(error, OSError) and error.errno:
        return [SYSTEM, error.errno, error.strerror or "error of the system"]
    text = sentence("it cannot be read ({kind})", kind=brief(error))
    return [FAILED, FileDamagedError.__name__, crossing(text)]


def outcome(kind: Any, answer: Answer, descriptor: int | None) -> Any:
    """Return the result of a task, or the error that it ended in: made, not raised.

    Args:
        kind: type that the result must have.
        answer: of the child.
        descriptor: memory with the arrays of the result; closed here.
    """
    try:
        if descriptor is not None:
            answer = opened(answer, descriptor)
        word, *values = answer
        if word == DONE:
            return reader(kind)(values[0])
        name, text = values
        return _error(word, name, text)
    except (ForeignValueError, AttachmentsError, IndexError, TypeError, ValueError):
        return lost(sentence("talked nonsense"))


def lost(reason: str) -> WorkerLostError:
    """Error of a task that cost its child.

    Args:
        reason: what the child did, as in "was ended by SIGSEGV".
    """
    text = sentence("damaged or hostile file: the process that read it {reason}", reason=reason)
    return WorkerLostError(text, reason)


def _error(word: str, name: Any, text: Any) -> Exception:
    shown = arrived(text)
    if word == SYSTEM:
        return OSError(reader(int)(name), shown)
    return _ERRORS.get(reader(str)(name), FileDamagedError)(shown)
