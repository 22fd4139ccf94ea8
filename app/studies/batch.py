"""All studies in a row: each result kept as soon as it is there, so that the next run goes on.

A study that breaks is told and does not end the run; one that needs what this installation lacks,
or folders that nobody named, is left out and told, too.
"""

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import StrEnum
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Final

from app import __version__
from app.core.errors import AcusError
from app.core.progress import Cancelled, Progress
from app.studies.errors import StudyError
from app.studies.files import write
from app.studies.findings import Survey, SurveyResult
from app.studies.kept import Kept, read, was_of
from app.studies.runner import REPEATS, examine, find_study, run
from app.studies.study import Result, Study

QUICK: Final = 2
"""Timings per way and setting of a quick run: enough to see the order of the ways."""


class StudyOutcome(StrEnum):
    """What became of a study."""

    MEASURED = "measured"
    KEPT = "kept"  # from a run before
    LEFT_OUT = "left out"
    BROKEN = "broken"


@dataclass(frozen=True, slots=True)
class Done:
    """A study of a run.

    Attributes:
        text: why it is left out or broken; empty otherwise.
        result: what was measured in this run; None otherwise.
    """

    name: str
    outcome: StudyOutcome
    text: str = ""
    result: Result | SurveyResult | None = None


def run_all(
    names: Iterable[str],
    folder: Path,
    repeats: int = REPEATS,
    fresh: bool = False,
    progress: Progress | None = None,
    answer: Callable[[Done], object] = lambda done: None,
    lend: Callable[[str], Any] | None = None,
    quick: bool = False,
) -> tuple[Done, ...]:
    """Run studies one after the other and write what they find.

    Args:
        names: of the studies.
        folder: for tables and pictures; results that it holds of the same version, of studies that
            are still the same and with as many repeats are kept.
        repeats: timings per way and setting.
        fresh: measure all anew.
        progress: told how far it is; may cancel between two settings.
        answer: called with each study that is done.
        lend: gives what studies borrow from rooms above.
        quick: surveys on less, where they know how; what a quick one found is not kept for one
            that is not.

    Raises:
        Cancelled: when the progress says so; what is finished stays.
    """
    watch, chosen, found = progress or Progress(), tuple(names), []
    for number, name in enumerate(chosen):
        watch.report(number / len(chosen), name)
        part = watch.part(number / len(chosen), (number + 1) / len(chosen))
        found.append(_done(name, folder, repeats, fresh, part, lend, quick))
        answer(found[-1])
    return tuple(found)


def _done(
    name: str,
    folder: Path,
    repeats: int,
    fresh: bool,
    progress: Progress,
    lend: Callable[[str], Any] | None,
    quick: bool,
) -> Done:
    try:
        study = find_study(name)
        if not fresh and _is_there(study, folder / f"{name}.json", repeats, quick):
            return Done(name, StudyOutcome.KEPT)
        if isinstance(study, Survey) and study.inputs:
            return Done(
                name, StudyOutcome.LEFT_OUT, f"it needs {study.inputs}: acus study {name} DIR"
            )
        result: Result | SurveyResult = (
            examine(study, progress, quick=quick, lend=lend)
            if isinstance(study, Survey)
            else run(study, repeats, progress, lend=lend)
        )
        write(result, folder, repeats, find_spec("matplotlib") is not None, quick)
    except Cancelled:
        raise
    except AcusError as error:
        missing = "install the extra" in str(error)
        return Done(name, StudyOutcome.LEFT_OUT if missing else StudyOutcome.BROKEN, str(error))
    except Exception as error:  # a file of the user's may do anything
        return Done(name, StudyOutcome.BROKEN, f"{type(error).__name__}: {error}")
    if result.findings is not None and result.findings.passed is False:
        return Done(name, StudyOutcome.BROKEN, "; ".join(result.findings.lines), result)
    return Done(name, StudyOutcome.MEASURED, "", result)


def _is_there(study: Study | Survey, path: Path, repeats: int, quick: bool) -> bool:
    """Return whether a run before has left the result of this very study."""
    if not path.is_file():
        return False
    try:
        if isinstance(study, Survey):
            was_measured = json.loads(path.read_text(encoding="utf-8"))["measured"]
            enough = quick or not was_measured.get("quick", False)
            return bool(enough and was_measured["version"] == __version__)
        was: Kept = read(path)
    except (StudyError, ValueError, KeyError, TypeError):
        return False  # broken off while it was written, or of an older form
    same = was.version == __version__ and was.repeats >= repeats
    return same and not was_of(was, study)
