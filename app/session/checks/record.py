"""The result of the day: one file per daily check."""

from datetime import datetime
from pathlib import Path
from typing import Annotated

import yaml
from pydantic import Field

from app.core import paths
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.core.files import write_atomically
from app.core.messages import sentence
from app.session.checks.steps import CheckVerdict, StepResult, overall


class StepRecord(Strict):
    """A step as it came out."""

    name: str
    verdict: CheckVerdict
    found: str
    todo: str = ""


class DayCheck(Strict):
    """One daily check.

    Attributes:
        created: local time with its offset.
        verdict: of all steps.
        steps: in their order.
        device: name of the device profile; `simulated` whether the robot was.
        calibration: id of the cameras' calibration; empty for cameras by their profile.
    """

    version: Annotated[int, Field(ge=1, le=1)] = 1
    created: datetime
    verdict: CheckVerdict
    steps: tuple[StepRecord, ...]
    device: str = ""
    simulated: bool = False
    calibration: str = ""

    @classmethod
    def of(
        cls,
        results: tuple[StepResult, ...],
        now: datetime,
        device: str = "",
        simulated: bool = False,
        calibration: str = "",
    ) -> "DayCheck":
        """Take the results at a local time."""
        steps = tuple(
            StepRecord(name=one.name, verdict=one.verdict, found=one.found, todo=one.todo)
            for one in results
        )
        return cls(
            created=now,
            verdict=overall(results),
            steps=steps,
            device=device,
            simulated=simulated,
            calibration=calibration,
        )

    def words(self, now: datetime) -> str:
        """Return `checked today 08:12`, or when else, and whether all was well."""
        verdict = {
            CheckVerdict.GOOD: sentence("checked"),
            CheckVerdict.WARNING: sentence("checked with remarks"),
            CheckVerdict.BAD: sentence("check failed"),
            CheckVerdict.WAITING: sentence("check not finished"),
        }[self.verdict]
        if self.created.date() == now.date():
            return sentence("{verdict} today {time}", verdict=verdict, time=f"{self.created:%H:%M}")
        return sentence("{verdict} {date:%Y-%m-%d %H:%M}", verdict=verdict, date=self.created)


def checks_folder() -> Path:
    """Folder of the checks, in the user's data folder (`ACUS_DATA` overrides)."""
    return paths.data() / "checks"


def save_check(check: DayCheck, folder: Path | None = None) -> Path:
    """Write a check whole or not at all; returns its file."""
    path = (folder or checks_folder()) / f"{check.created:%Y%m%d-%H%M%S}.yaml"
    text = yaml.safe_dump(check.model_dump(mode="json"), sort_keys=False, allow_unicode=True)
    write_atomically(path, text)
    return path


def newest_check(folder: Path | None = None) -> DayCheck | None:
    """Newest check that can be read; None without any. A damaged file is passed over."""
    for path in sorted((folder or checks_folder()).glob("*.yaml"), reverse=True):
        try:
            return load(path, DayCheck)
        except ConfigurationError:
            continue
    return None
