"""Attempts that lie in the source tree, where editable installs of earlier versions kept them.

All users of one tree had one folder there. So nothing is taken over by itself, and by whoever asks
only what this station signed; the rest stays, and can be listed and opened where it is.
"""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass
from pathlib import Path
from uuid import uuid4

from app.core import paths
from app.core.messages import counted, sentence
from app.session.errors import SessionError
from app.session.header import TRASH
from app.session.journal import Journal, Step, move, removal
from app.session.people import People
from app.session.signature import Signed, signature_file
from app.session.store import beside, records, settled, verdict_of


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """Attempts in the source tree.

    Attributes:
        folder: where they lie.
        records: their files, without those that are in this user's folder too.
    """

    folder: Path
    records: tuple[Path, ...]

    @property
    def words(self) -> str:
        """Say in one line how many lie where, and what can be done about it."""
        return counted(
            "{n} attempt lies in {folder}, where earlier versions kept attempts: `acus session "
            "gather` brings yours here, `acus session list --folder {folder}` lists all",
            "{n} attempts lie in {folder}, where earlier versions kept attempts: `acus session "
            "gather` brings yours here, `acus session list --folder {folder}` lists all",
            len(self.records),
            folder=self.folder,
        )


def elsewhere(folder: Path) -> Elsewhere | None:
    """Return what lies in the source tree while records go to `folder`; None if nothing does.

    Only this user's own folder asks: a folder that was chosen is what was wanted.

    Raises:
        SessionError: if a folder cannot be read.
    """
    tree = paths.tree_sessions()
    if tree is None or folder != paths.own_sessions() or folder.resolve() == tree.resolve():
        return None
    here = {path.name for place in (folder, folder / TRASH) for path in records(place)}
    there = tuple(path for path in records(tree) if path.name not in here)
    return Elsewhere(tree, there) if there else None


def signed_here(result: Elsewhere, people: People) -> tuple[Path, ...]:
    """Return the records that this station signed or admitted, without those erased here.

    Reads what stands beside each record; takes a moment where there are many.

    Raises:
        SessionError: if the list of people cannot be read.
    """
    gone = people.erased_attempts()
    return tuple(
        path
        for path in result.records
        if path.stem not in gone and verdict_of(path) in (Signed.VERIFIED, Signed.ADMITTED)
    )


def gather(result: Elsewhere, folder: Path, people: People) -> int:
    """Bring the attempts that this station signed from the source tree into a folder of records.

    They are copied, then moved into their place and deleted in the tree as one step; what may not
    be deleted there stays there too.

    Returns:
        How many there were.

    Raises:
        SessionError: if one cannot be read or written; then none has come.
    """
    own = signed_here(result, people)
    settled(folder)
    stage = folder / f".gathering.{uuid4().hex}"
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        with Journal(folder, [removal(stage)]) as journal:
            stage.mkdir(mode=0o700)
            journal.plan([*_steps(own, stage, folder), removal(stage), *_cleared(result, own)])
    except OSError as error:
        what = error.filename or folder
        raise SessionError(
            sentence(
                "cannot bring attempts here: {place}: {error_strerror}",
                place=what,
                error_strerror=error.strerror,
            )
        ) from error
    return len(own)


def _steps(own: tuple[Path, ...], stage: Path, folder: Path) -> list[Step]:
    """Copy records with their signatures; return what puts them into their place."""
    steps = []
    for record in own:
        for path in (signature_file(record), record):  # a record is never without its own
            shutil.copyfile(path, stage / path.name)
            with (stage / path.name).open("rb+") as stream:
                os.fsync(stream.fileno())
            steps.append(move(stage / path.name, folder / path.name))
    return steps


def _cleared(result: Elsewhere, own: tuple[Path, ...]) -> list[Step]:
    if not os.access(result.folder, os.W_OK):
        return []
    return [removal(path) for record in own for path in beside(record)]
