"""`history.yaml`: which calibrations are known, and which was in use when."""

from datetime import datetime
from pathlib import Path
from typing import Annotated, Final, Literal, Self

from pydantic import Field, model_validator

from app.core import paths
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.tracking.errors import CalibrationError

NAME: Final = "history"
"""Stem of the history's file; no calibration can be called so."""


class FoundBad(Strict):
    """That a calibration was found bad: when and why."""

    date: datetime
    reason: Annotated[str, Field(min_length=1)]


class CalibrationEntry(Strict):
    """One calibration: when it came in, and whether it was found bad."""

    id: str
    kept: datetime
    condemned: FoundBad | None = None


class HistoryFile(Strict):
    """`history.yaml`: calibrations in the order they were kept; ids in the order they were used."""

    version: Literal[1] = 1
    calibrations: tuple[CalibrationEntry, ...] = ()
    used: tuple[str, ...] = ()
    position: Annotated[int, Field(ge=-1)] = -1

    @model_validator(mode="after")
    def _positions(self) -> Self:
        if self.position >= len(self.used):
            raise ValueError(
                sentence(
                    "position {position} lies beyond the {used_positions} used",
                    position=self.position,
                    used_positions=len(self.used),
                )
            )
        if unknown := set(self.used) - {known.id for known in self.calibrations}:
            raise ValueError(
                sentence("used names {unknown}, which no calibration has", unknown=sorted(unknown))
            )
        return self

    @property
    def active(self) -> str | None:
        """Id of the calibration in use."""
        return self.used[self.position] if self.position >= 0 else None

    def known(self, calibration_id: str, now: datetime) -> "HistoryFile":
        """Return the history with this calibration in it, come in now if it is new."""
        if any(known.id == calibration_id for known in self.calibrations):
            return self
        new = CalibrationEntry(id=calibration_id, kept=now)
        return self.model_copy(update={"calibrations": (*self.calibrations, new)})

    def using(self, calibration_id: str) -> "HistoryFile":
        """Return the history with a known calibration in use."""
        if self.active == calibration_id:
            return self
        used = (*self.used[: self.position + 1], calibration_id)
        return self.model_copy(update={"used": used, "position": len(used) - 1})

    def rejecting(self, calibration_id: str, bad: FoundBad) -> "HistoryFile":
        """Return the history with a calibration found bad and not in use."""
        known = tuple(
            k.model_copy(update={"condemned": bad}) if k.id == calibration_id else k
            for k in self.calibrations
        )
        marked = self.model_copy(update={"calibrations": known})
        return marked.at(marked.next_good(-1)) if self.active == calibration_id else marked

    def at(self, position: int) -> "HistoryFile":
        """Return the history with what was in use at a position in use again."""
        return self.model_copy(update={"position": position})

    def next_good(self, step: int) -> int:
        """Position of the next calibration in a direction (-1, +1) that was not found bad.

        -1 or the number of used ones if there is none.
        """
        bad = {known.id for known in self.calibrations if known.condemned}
        position = self.position + step
        while 0 <= position < len(self.used) and self.used[position] in bad:
            position += step
        return position


def calibrations_folder() -> Path:
    """Folder of the calibrations, in the user's data folder (`ACUS_DATA` overrides)."""
    return paths.data() / "calibrations"


def read_history(folder: Path) -> HistoryFile:
    """Read the history of a folder; an empty one if there is none yet.

    Raises:
        CalibrationError: if it is there and cannot be used; it stays as it is.
    """
    path = folder / f"{NAME}.yaml"
    if not path.exists():
        return HistoryFile()
    try:
        return load(path, HistoryFile)
    except ConfigurationError as error:
        raise CalibrationError(
            sentence("{error}; mend the file or move it away", error=error)
        ) from error


def rejected_ids(folder: Path | None = None) -> dict[str, str]:
    """Reason by id of every calibration found bad; reads one small file.

    Raises:
        CalibrationError: if the history is there and cannot be read.
    """
    history = read_history(folder or calibrations_folder())
    return {k.id: k.condemned.reason for k in history.calibrations if k.condemned}
