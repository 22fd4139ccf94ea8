"""The program's log: a file of its own that rotates, without identifiers, and what crashed last.

Messages are written without paths, files and pseudonyms. Of an exception its type and the places in
the program are written, never its text: that may quote a file.
"""

import faulthandler
import logging
import os
import sys
import threading
import traceback
from collections.abc import Callable, Iterable
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType
from typing import Final, TextIO

from app.core import paths
from app.core.errors import AcusError
from app.core.identifiers import without_identifiers

LARGEST_BYTES: Final = 512 * 1024
"""Size from which the log goes on in a new file."""

KEPT: Final = 3
"""Older files that are kept."""

LONGEST: Final = 2000
"""Characters of a message that are written."""

_ROOT = Path(__file__).resolve().parents[2]
_log = logging.getLogger("acus")


def folder() -> Path:
    """Return the folder of the logs."""
    return paths.data() / "logs"


class LogFile:
    """Writes what the program logs, and what nobody caught, to a file.

    Args:
        names: gives the names that are known, to be taken out of every line.

    Attributes:
        path: of the file that is written now.
        crash: of the stacks of a program that the system ended.
    """

    def __init__(self, names: Callable[[], Iterable[str]] = tuple) -> None:
        self._names = names
        self.path, self.crash = folder() / "acus.log", folder() / "crash.txt"
        self._handler: logging.Handler | None = None
        self._stacks: TextIO | None = None
        self._is_enabled = False
        self._before = sys.excepthook, threading.excepthook

    def open(self) -> None:
        """Begin to write; where its folder cannot be written the program goes on without a log."""
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            self._keep_last_crash()
            handler = _Private(self.path, maxBytes=LARGEST_BYTES, backupCount=KEPT)
            self._stacks = _private(self.crash).open("w", encoding="utf-8")
        except OSError as error:
            _log.warning("no log is written: %s", error.strerror)
            return
        handler.setFormatter(_Formatter(self._names))
        self._handler = handler
        logging.getLogger().addHandler(handler)
        _log.setLevel(logging.INFO)
        if not faulthandler.is_enabled():  # whoever enabled it reads the stacks elsewhere
            faulthandler.enable(self._stacks)
            self._is_enabled = True
        self._before = sys.excepthook, threading.excepthook
        sys.excepthook, threading.excepthook = _and_then(sys.excepthook), _of_thread
        _log.info("started, process %d", os.getpid())

    def close(self) -> None:
        """Stop writing; idempotent."""
        if self._handler is not None:
            logging.getLogger().removeHandler(self._handler)
            self._handler.close()
            self._handler = None
            sys.excepthook, threading.excepthook = self._before
        if self._stacks is not None:
            if self._is_enabled:
                faulthandler.disable()
            self._stacks.close()
            self._stacks = None

    def _keep_last_crash(self) -> None:
        if self.crash.is_file() and self.crash.stat().st_size > 0:
            self.crash.replace(last_crash())


def last_crash() -> Path:
    """Return where the stacks of the last program lie that the system ended, if one did."""
    return folder() / "last-crash.txt"


def tail(lines: int = 200) -> str:
    """Return the newest lines of the log; nothing without one."""
    try:
        text = (folder() / "acus.log").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    return "\n".join(text.splitlines()[-lines:])


def crash_text() -> str:
    """Return the stacks of the last crash, without the paths of this computer; nothing without."""
    try:
        text = last_crash().read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    return "\n".join(_placed(line) for line in text.splitlines())


def _placed(line: str) -> str:
    """Name a file of a stack from the program's folder or its package on."""
    for mark in (f"{_ROOT}{os.sep}", f"site-packages{os.sep}", f"lib{os.sep}"):
        if mark in line and '"' in line:
            start, quote = line.index('"') + 1, line.index(mark) + len(mark)
            return line[:start] + line[quote:]
    return line


def where(error: BaseException) -> str:
    """Return type and places of an exception, a line each, and never its text."""
    places = [
        f"  {_placed(chr(34) + frame.filename + chr(34))}:{frame.lineno} {frame.name}"
        for frame in traceback.extract_tb(error.__traceback__)
    ]
    return "\n".join([type(error).__name__, *places])


class _Formatter(logging.Formatter):
    def __init__(self, names: Callable[[], Iterable[str]]) -> None:
        super().__init__("%(asctime)s %(levelname)s %(name)s: %(message)s")
        self._names = names

    def format(self, record: logging.LogRecord) -> str:
        kept = {"exc_info": None, "exc_text": None, "args": _without_texts(record.args)}
        plain = logging.makeLogRecord(record.__dict__ | kept)
        text = without_identifiers(super().format(plain)[:LONGEST], self._names())
        error = record.exc_info[1] if record.exc_info else None
        return text if error is None else f"{text}\n{where(error)}"


def _without_texts(args: object) -> object:
    """Put kind and places of an exception where a message would quote its text."""
    if isinstance(args, tuple):
        return tuple(where(arg) if isinstance(arg, BaseException) else arg for arg in args)
    return args


class _Private(RotatingFileHandler):
    """A log that only its owner may read."""

    def _open(self):  # type: ignore[no-untyped-def]
        _private(Path(self.baseFilename))
        return super()._open()


def _private(path: Path) -> Path:
    os.close(os.open(path, os.O_CREAT | os.O_WRONLY, 0o600))
    path.chmod(0o600)
    return path


Hook = Callable[[type[BaseException], BaseException, TracebackType | None], object]


def _and_then(before: Hook) -> Hook:
    """Log what nobody caught, then go on as before."""

    def caught(
        kind: type[BaseException], error: BaseException, trace: TracebackType | None
    ) -> None:
        if not isinstance(error, (KeyboardInterrupt, AcusError)):
            _log.error("nobody caught", exc_info=error)
        before(kind, error, trace)

    return caught


def _of_thread(answer: threading.ExceptHookArgs) -> None:
    if answer.exc_value is not None and not isinstance(answer.exc_value, SystemExit):
        _log.error("nobody caught in a thread", exc_info=answer.exc_value)
        sys.stderr.write(f"{where(answer.exc_value)}\n")
