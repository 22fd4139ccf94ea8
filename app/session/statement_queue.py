"""Statements about attempts that wait to be sent: a folder that `exchange.lrs` empties.

Each call of `put` writes one file with what is new, whole or not at all; each call of `sent` one
with the ids that have arrived. What waits is all that was put and not sent, so order does not
matter, twice is the same as once, two programs may put and send at one moment, and whatever ends a
program leaves the queue as it was before or after. Statements name students by pseudonym: those of
somebody who is erased leave the queue with him.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final
from uuid import uuid4

from app.core.errors import writing
from app.core.files import remove, sweep, write_atomically
from app.core.messages import sentence
from app.session.errors import SessionError

FOLDER: Final = "statements"
"""Name of the queue in the folder of people."""

_WAITING, _SENT = "waiting-", "sent-"


@dataclass(frozen=True, slots=True)
class QueuedStatement:
    """A statement, and whose attempt it is about.

    Attributes:
        student: key of the person.
        statement: JSON-ready, with an `id`.
    """

    student: str
    statement: Mapping[str, Any]

    @property
    def id(self) -> str:
        """Return the statement's id."""
        return str(self.statement["id"])


class StatementQueue:
    """The queue in a folder.

    Args:
        folder: of the queue; it need not exist.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def put(self, statements: Iterable[QueuedStatement]) -> int:
        """Add statements that neither wait nor were sent; return how many were new.

        Raises:
            SessionError: if the queue cannot be read or written; nothing was added then.
        """
        known = {queued.id for queued in self._all()} | self._arrived()
        new = {queued.id: queued for queued in statements if queued.id not in known}
        if new:
            self._write(self._named(_WAITING), new.values())
        return len(new)

    def waiting(self) -> list[QueuedStatement]:
        """Return what has not been sent, each once, by id.

        Raises:
            SessionError: if the queue cannot be read.
        """
        arrived = self._arrived()
        left = {queued.id: queued for queued in self._all() if queued.id not in arrived}
        return [left[name] for name in sorted(left)]

    def sent(self, ids: Collection[str]) -> None:
        """Note what has arrived; files of which nothing waits any more go.

        Raises:
            SessionError: if that cannot be written.
        """
        if ids:
            self._keep(self._named(_SENT), "".join(f"{name}\n" for name in sorted(ids)))
        arrived = self._arrived()
        for path in self._files(_WAITING):
            if all(queued.id in arrived for queued in _read(path)):
                remove(path)

    def forget(self, students: Collection[str]) -> None:
        """Take out what is about these students, by key.

        Raises:
            SessionError: if the queue cannot be read or written.
        """
        self._take_out(lambda queued: queued.student in students)

    def take_back(self, voiding: Mapping[str, QueuedStatement]) -> int:
        """Take out statements that wait; where one was sent, add the one that voids it.

        Args:
            voiding: by the id of the statement that no longer holds.

        Returns:
            How many were added.

        Raises:
            SessionError: if the queue cannot be read or written.
        """
        arrived = self._arrived()
        self._take_out(lambda queued: queued.id in voiding and queued.id not in arrived)
        return self.put(voiding[name] for name in sorted(voiding) if name in arrived)

    # --- inside -----------------------------------------------------------------------------------
    def _take_out(self, unwanted: Callable[[QueuedStatement], bool]) -> None:
        for path in self._files(_WAITING):
            every = _read(path)
            left = [queued for queued in every if not unwanted(queued)]
            if not left:
                remove(path)
            elif len(left) < len(every):
                self._write(path, left)

    def _files(self, kind: str) -> list[Path]:
        return sorted(self.folder.glob(f"{kind}*.jsonl"))

    def _named(self, kind: str) -> Path:
        return self.folder / f"{kind}{uuid4().hex}.jsonl"

    def _all(self) -> list[QueuedStatement]:
        return [queued for path in self._files(_WAITING) for queued in _read(path)]

    def _arrived(self) -> set[str]:
        return {name for path in self._files(_SENT) for name in _text(path).split()}

    def _write(self, path: Path, statements: Iterable[QueuedStatement]) -> None:
        lines = (
            json.dumps({"student": queued.student, "statement": queued.statement})
            for queued in statements
        )
        self._keep(path, "".join(f"{line}\n" for line in lines))

    def _keep(self, path: Path, text: str) -> None:
        with writing(path, SessionError):
            self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            sweep(self.folder)
            write_atomically(path, text)


def _read(path: Path) -> list[QueuedStatement]:
    found = []
    for line in _text(path).splitlines():
        try:
            document = json.loads(line)
            queued = QueuedStatement(str(document["student"]), dict(document["statement"]))
            _ = queued.id
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise SessionError(
                sentence(
                    "{path} is damaged: move it away, and put the statements into the queue again",
                    path=path,
                )
            ) from error
        found.append(queued)
    return found


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return ""  # another program has taken it away meanwhile
    except (OSError, UnicodeDecodeError) as error:
        raise SessionError(
            sentence("cannot read {path}: {error_strerror}", path=path, error_strerror=error)
        ) from error
