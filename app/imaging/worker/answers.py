"""What became of a task: its result, or the error that ended it, in sentences that both know.

Sentences that cross from the child to the program: template and values, so that they translate.

What the child sends is not trusted: a template may name its values and format numbers by a width of
two digits, and nothing else: no attribute, no index, no room for a text of a gigabyte.
"""

from __future__ import annotations

import math
import re
from string import Formatter
from typing import Any, Final

from app.core.errors import AcusError
from app.core.messages import Formatted, Sentence, sentence, sentence_of
from app.imaging import errors as imaging
from app.imaging.errors import FileDamagedError, WorkerLostError, brief
from app.imaging.privacy import errors as privacy
from app.imaging.structures import errors as structures
from app.imaging.worker.attachments import Attachments, AttachmentsError, opened
from app.imaging.worker.lent_memory import LentMemory
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


def outcome(kind: Any, answer: Answer, memory: LentMemory | None) -> Any:
    """Return the result of a task, or the error that it ended in: made, not raised.

    Args:
        kind: type that the result must have.
        answer: of the child.
        memory: with the arrays of the result; closed here.
    """
    try:
        if memory is not None:
            answer = opened(answer, memory)
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


LONGEST: Final = 600
"""Longest text that is shown [characters]."""

_DEEPEST: Final = 6
_LARGEST: Final = 1 << 64
_FORM: Final = re.compile(r"[-+<>^ ]?0?[0-9]{0,2}(?:,|_)?(?:\.[0-9]{1,2})?[bcdeEfFgGnosxX%z]?")
_TEMPLATE, _VALUES, _FORMATTED = "template", "values", "formatted"


class ForeignSentenceError(ValueError):
    """What came is no sentence."""


def crossing(text: str) -> Any:
    """Return what JSON holds of a text: of a sentence its template and values."""
    if not isinstance(text, Sentence):
        return str(text)
    return {
        _TEMPLATE: text.template,
        _VALUES: {name: _value(value) for name, value in text.values.items()},
    }


def _value(value: Any) -> Any:
    if isinstance(value, Formatted):
        return {_FORMATTED: str(value)}
    if isinstance(value, float) and not math.isfinite(value):
        return {_FORMATTED: str(value)}
    if isinstance(value, int) and abs(value) > _LARGEST:
        return {_FORMATTED: str(value)}
    return crossing(value) if isinstance(value, str) else value


def arrived(message: Any, deep: int = 0) -> str:
    """Return the text, or the sentence, of what `crossing` made.

    Raises:
        ForeignSentenceError: if it is nothing of the kind, or would be too long.
    """
    if isinstance(message, str):
        return message[:LONGEST]
    if deep > _DEEPEST or not isinstance(message, dict):
        raise ForeignSentenceError(sentence("no sentence"))
    if message.keys() == {_FORMATTED} and isinstance(message[_FORMATTED], str):
        return Formatted(message[_FORMATTED][:LONGEST])
    if message.keys() != {_TEMPLATE, _VALUES}:
        raise ForeignSentenceError(sentence("no sentence"))
    template, values = message[_TEMPLATE], message[_VALUES]
    if not isinstance(template, str) or len(template) > LONGEST or not isinstance(values, dict):
        raise ForeignSentenceError(sentence("no sentence"))
    _check(template)
    try:
        text = Sentence(template, {name: _read(value, deep) for name, value in values.items()})
    except (LookupError, ValueError, TypeError, OverflowError) as error:
        raise ForeignSentenceError(sentence("a template without its values")) from error
    if len(text) > 4 * LONGEST:
        raise ForeignSentenceError(sentence("a sentence without end"))
    return text


def _read(value: Any, deep: int) -> Any:
    if value is None or isinstance(value, bool | float):
        return value
    if isinstance(value, int):
        if abs(value) > _LARGEST:
            raise ForeignSentenceError(sentence("a number without end"))
        return value
    return arrived(value, deep + 1)


def _check(template: str) -> None:
    """Refuse a template that does more than name its values and format them."""
    try:
        parts = list(Formatter().parse(template))
    except ValueError as error:
        raise ForeignSentenceError(sentence("no template")) from error
    for _, name, form, conversion in parts:
        plain = name is None or name.isidentifier()
        if not plain or not _FORM.fullmatch(form or "") or conversion not in (None, "r", "s"):
            raise ForeignSentenceError(sentence("a template that does more than name its values"))
