"""Which calibrations there are, which one is in use, and which were found bad.

Each calibration is a file `<id>.yaml` that is written once; `history.yaml` beside them says what
was in use when. Nothing is ever deleted, and every file is written whole or not at all.
"""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

import yaml

from app.core.files import write_atomically
from app.core.messages import sentence
from app.tracking.calibration.formats.own import load_calibration, save_calibration, text_of
from app.tracking.calibration.history_file import (
    NAME,
    FoundBad,
    HistoryFile,
    calibrations_folder,
    read_history,
)
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration

_LONGEST_REASON: Final = 300


@dataclass(frozen=True, slots=True)
class KeptCalibration:
    """One calibration of the history.

    Attributes:
        id: of the calibration.
        kept: when it came in; None for a file that the history does not know yet.
        active: whether it is the one in use.
        rejected: when and why it was found bad, or None.
        path: its file.
    """

    id: str
    kept: datetime | None
    active: bool
    rejected: FoundBad | None
    path: Path


class CalibrationHistory:
    """The calibrations in a folder. Every call reads the folder anew and writes what it changed.

    Args:
        folder: where they are; made when the first is kept.
        now: wall-clock time.
    """

    def __init__(
        self, folder: Path | None = None, now: Callable[[], datetime] = lambda: datetime.now(UTC)
    ) -> None:
        self.folder = folder or calibrations_folder()
        self._now = now

    def entries(self) -> tuple[KeptCalibration, ...]:
        """All calibrations, oldest first.

        Raises:
            CalibrationError: if the history cannot be read; it stays as it is.
        """
        history = self._read()
        active = history.active
        return tuple(
            KeptCalibration(k.id, k.kept, k.id == active, k.condemned, self._path(k.id))
            for k in history.calibrations
        ) + tuple(
            KeptCalibration(name, None, False, None, self._path(name))
            for name in self._strays(history)
        )

    def active(self) -> StereoCalibration | None:
        """Return the calibration in use, or None.

        Raises:
            CalibrationError: if its file or the history cannot be read.
        """
        active = self._read().active
        return None if active is None else self.load(active)

    def load(self, calibration_id: str) -> StereoCalibration:
        """Read one calibration by its whole id.

        Raises:
            CalibrationError: if it is not there, cannot be read, or is another one than its name.
        """
        path = self._path(calibration_id)
        calibration = load_calibration(path)
        if calibration.id != calibration_id:
            raise CalibrationError(
                sentence(
                    "{path}: id: {needed_id} is needed as the file's name says, got "
                    "{stated_id}; was the file renamed?",
                    path=path,
                    needed_id=calibration_id,
                    stated_id=calibration.id,
                )
            )
        return calibration

    def find(self, beginning: str) -> KeptCalibration:
        """Return the calibration whose id begins so.

        Raises:
            CalibrationError: if there is none or more than one; names them.
        """
        entries = self.entries()
        exact = [entry for entry in entries if entry.id == beginning]
        found = exact or [entry for entry in entries if entry.id.startswith(beginning)]
        if len(found) == 1 and beginning:
            return found[0]
        names = ", ".join(entry.id for entry in (found or entries)) or "none at all"
        what = "several calibrations begin" if found else "no calibration begins"
        raise CalibrationError(
            sentence(
                "{trouble} with {beginning!r}; there are {names}",
                trouble=what,
                beginning=beginning,
                names=names,
            )
        )

    def keep(self, calibration: StereoCalibration) -> Path:
        """Keep a calibration and use it from now on.

        Raises:
            CalibrationError: if another calibration has its id, or it cannot be written.
        """
        history = self._read()
        if calibration.id == NAME:
            raise CalibrationError(
                sentence("a calibration cannot be called {name!r}: give it another id", name=NAME)
            )
        path = self._path(calibration.id)
        if not path.exists():
            save_calibration(path, calibration)
        elif text_of(self.load(calibration.id)) != text_of(calibration):
            raise CalibrationError(
                sentence(
                    "another calibration is already kept as {calibration_id}; nothing is "
                    "overwritten: give this one another id",
                    calibration_id=calibration.id,
                )
            )
        self._write(history.known(calibration.id, self._now()).using(calibration.id))
        return path

    def use(self, calibration_id: str) -> None:
        """Use a kept calibration from now on.

        Raises:
            CalibrationError: if it is unknown, unreadable, or was found bad.
        """
        entry = self.find(calibration_id)
        if entry.rejected is not None:
            raise CalibrationError(
                sentence(
                    "calibration {entry_id} was found bad ({entry_rejected_reason}); calibrate "
                    "again or use another one",
                    entry_id=entry.id,
                    entry_rejected_reason=entry.rejected.reason,
                )
            )
        self.load(entry.id)
        self._write(self._read().known(entry.id, self._now()).using(entry.id))

    def undo(self) -> str | None:
        """Go back to what was used before; return its id, None for no calibration at all.

        Raises:
            CalibrationError: if nothing was used.
        """
        history = self._read()
        if history.position < 0:
            raise CalibrationError(sentence("no calibration is in use: there is nothing to undo"))
        return self._write(history.at(history.next_good(-1)))

    def redo(self) -> str | None:
        """Take back an `undo`; return the id that is in use then.

        Raises:
            CalibrationError: if there is nothing to take back.
        """
        history = self._read()
        position = history.next_good(+1)
        if position >= len(history.used):
            raise CalibrationError(
                sentence("there is no undone calibration that could be used again")
            )
        return self._write(history.at(position))

    def reject(self, calibration_id: str, reason: str) -> str | None:
        """Say that a calibration was found bad; attempts made with it are flagged from now on.

        If it is in use, the one before is used again. Returns the id in use then.

        Raises:
            CalibrationError: if it is unknown, or no reason is given.
        """
        words = " ".join(reason.split())[:_LONGEST_REASON]
        if not words:
            raise CalibrationError(
                sentence("say why the calibration is bad: attempts are flagged with it")
            )
        entry = self.find(calibration_id)
        history = self._read().known(entry.id, self._now())
        return self._write(history.rejecting(entry.id, FoundBad(date=self._now(), reason=words)))

    def _strays(self, history: HistoryFile) -> list[str]:
        """Files that the history does not know: copied in, or kept as the power went."""
        known = {k.id for k in history.calibrations} | {NAME}
        return sorted(p.stem for p in self.folder.glob("*.yaml") if p.stem not in known)

    def _path(self, calibration_id: str) -> Path:
        return self.folder / f"{calibration_id}.yaml"

    def _read(self) -> HistoryFile:
        return read_history(self.folder)

    def _write(self, history: HistoryFile) -> str | None:
        """Write the history; return the id in use."""
        path = self._path(NAME)
        text = yaml.safe_dump(history.model_dump(mode="json"), sort_keys=False)
        try:
            write_atomically(path, text)
        except OSError as error:
            raise CalibrationError(
                sentence(
                    "the history of calibrations cannot be written to {path}: {error_strerror}",
                    path=path,
                    error_strerror=error.strerror or error,
                )
            ) from error
        return history.active
