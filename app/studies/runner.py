"""Find studies and run them."""

import math
import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.plugins import TEXT, Declaration, PluginKind
from app.core.progress import Progress
from app.studies.errors import StudyError
from app.studies.findings import Survey, SurveyResult
from app.studies.study import Case, Failure, Point, Prepared, Result, Setting, Study, Way

REPEATS = 9


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredStudy(Declaration):
    """What a study says about itself.

    Attributes:
        question: what it decides.
        reference: what its answers are measured against or compared with, and how good that is.
    """

    question: str
    reference: str


def study_names() -> tuple[str, ...]:
    """Names of all studies, sorted; a folder within is none: it holds what one study needs."""
    return KIND.names()


def declaration(name: str) -> DeclaredStudy:
    """Read what a study says about itself, without importing it.

    Raises:
        StudyError: for an unknown name, listing the known ones, or a broken file.
    """
    return KIND.find(name)


def find_study(name: str) -> Study | Survey:
    """Import a study by name.

    Raises:
        StudyError: for an unknown name, listing the known ones, or a file without `STUDY`.
    """
    declared = KIND.find(name)
    found = getattr(KIND.load(declared), "STUDY", None)
    if not isinstance(found, Study | Survey):
        raise StudyError(
            sentence(
                "study file {declared_path} must define STUDY, a Study or Survey of {name!r}",
                declared_path=declared.path,
                name=name,
            )
        )
    return replace(
        found,
        name=name,
        title=declared.title,
        question=declared.question,
        reference=declared.reference,
    )


KIND: Final[PluginKind[DeclaredStudy]] = PluginKind(
    noun="a study",
    declares=DeclaredStudy,
    fields={"title": TEXT, "question": TEXT, "reference": TEXT},
    error=StudyError,
    package="app.studies",
    folder="studies",
    marks=(b"\nSTUDY", b"\nDECLARATION"),
)


def run(
    study: str | Study,
    repeats: int = REPEATS,
    progress: Progress | None = None,
    clock: Callable[[], float] = time.thread_time,
    lend: Callable[[str], Any] | None = None,
) -> Result:
    """Run every way in every setting, after a warm-up, and take medians of repeated timing.

    Args:
        study: a study, or its name.
        repeats: timings per way and setting, at least 1.
        progress: told how far it is; may cancel.
        clock: source of time [s]; by default the processor's time of this thread, so that what
            other programs take from the machine is not counted.
        lend: gives what a study borrows, by `module:name`.

    Raises:
        StudyError: for an unknown study, a survey (see `examine`), or one that borrows what nobody
            lends.
        Cancelled: when the progress says so.
    """
    chosen = find_study(study) if isinstance(study, str) else study
    if not isinstance(chosen, Study):
        raise StudyError(
            sentence(
                "study {chosen_name} has no ways to time; examine() runs a survey",
                chosen_name=chosen.name,
            )
        )
    lent = _lent(chosen, lend)
    points: list[Point] = []
    failures: list[Failure] = []
    for number, setting in enumerate(chosen.settings):
        if progress is not None:
            progress.report(
                number / len(chosen.settings),
                sentence("{study}: {setting}", study=chosen.name, setting=setting.name),
            )
        case = chosen.case(setting, *lent)
        for way in chosen.ways:
            try:
                points.append(_point(chosen, way, setting, case, max(1, repeats), clock))
            except (AcusError, ArithmeticError, ValueError) as error:
                failures.append(Failure(way.name, setting.name, str(error)))
    findings = chosen.findings() if chosen.findings is not None else None
    return Result(chosen, tuple(points), tuple(failures), findings)


def examine(
    survey: str | Survey,
    progress: Progress | None = None,
    inputs: tuple[Path, ...] = (),
    quick: bool = False,
    lend: Callable[[str], Any] | None = None,
    asked: Mapping[str, Any] | None = None,
) -> SurveyResult:
    """Run a survey.

    Args:
        survey: the survey, or its name.
        progress: told how far it is; may cancel.
        inputs: paths that it works on, for one that takes some.
        quick: on less, where it knows how.
        lend: gives what it borrows, by `module:name`.
        asked: its options, by name.

    Raises:
        StudyError: for an unknown study, one that is timed (see `run`), one that takes no paths,
            or one that borrows what nobody lends.
        Cancelled: when the progress says so.
    """
    chosen = find_study(survey) if isinstance(survey, str) else survey
    if not isinstance(chosen, Survey):
        raise StudyError(
            sentence(
                "study {chosen_name} compares ways by time; run() runs it", chosen_name=chosen.name
            )
        )
    if inputs and not chosen.inputs:
        raise StudyError(
            sentence(
                "study {chosen_name} takes no folders; leave {folder} out",
                chosen_name=chosen.name,
                folder=inputs[0],
            )
        )
    measure = (chosen.quick if quick else None) or chosen.measure
    given = (inputs,) if inputs else ()
    return SurveyResult(chosen, measure(progress, *given, *_lent(chosen, lend), **(asked or {})))


def _lent(chosen: Study | Survey, lend: Callable[[str], Any] | None) -> tuple[Any, ...]:
    """Return what a study borrows; refuse one that does where nobody lends."""
    if chosen.borrows and lend is None:
        raise StudyError(
            sentence(
                "study {chosen_name} needs {chosen_borrows} from a room above; "
                "run it by: acus study {chosen_name}",
                chosen_name=chosen.name,
                chosen_borrows=", ".join(chosen.borrows),
            )
        )
    return tuple(lend(name) for name in chosen.borrows) if lend is not None else ()


def _point(
    study: Study, way: Way, setting: Setting, case: Case, repeats: int, clock: Callable[[], float]
) -> Point:
    prepared = way.prepare(case)
    error = float(case.error(prepared.run()))  # the warm-up: compiles, fills caches
    if not math.isfinite(error):
        raise StudyError(sentence("its result is not finite (error {error})", error=error))
    seconds = statistics.median(_timed(prepared, clock) for _ in range(repeats))
    return Point(
        way.name,
        way.family,
        setting.name,
        error,
        seconds,
        error <= case.perception,
        seconds <= study.deadline.value,
        case.perception,
    )


def _timed(prepared: Prepared, clock: Callable[[], float]) -> float:
    start = clock()
    prepared.run()
    return (clock() - start) / prepared.calls
