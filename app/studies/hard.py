"""Survey: does every subsystem hold where its formulas are delicate?

The cases stand in `hard_cases`, here and in folders of plug-ins: one register for this table, the
tests and the documentation.
"""

from functools import cache
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Any, Final

from app.core import plugin_folders
from app.core.messages import sentence
from app.core.progress import Progress
from app.studies import hard_cases
from app.studies.errors import StudyError
from app.studies.findings import Findings, Sheet, Survey
from app.studies.hard_cases.case import SUBSYSTEMS, HardCase, HardOutcome, tried

DECLARATION: Final[dict[str, Any]] = {
    "title": "Hard cases: every subsystem where its formulas are delicate",
    "question": "Is every answer right, bounded, or refused by name?",
    "reference": "60 digits kept as files, or the formula that each case names",
}

COLUMNS: Final = (
    "subsystem",
    "case",
    "input",
    "reference",
    "error",
    "bound",
    "unit",
    "beyond the bound",
    "holds",
)


@cache
def cases() -> tuple[HardCase, ...]:
    """Return the cases of every file that defines `CASES`, in the order of the subsystems.

    Raises:
        StudyError: if a subsystem has no case, or two cases have one name.
    """
    gathered: list[HardCase] = []
    names = [f"{hard_cases.__name__}.{info.name}" for info in iter_modules(hard_cases.__path__)]
    modules = [*map(import_module, names), *plugin_folders.modules("hard_cases")]
    for module in sorted(modules, key=lambda module: module.__name__.rpartition(".")[2]):
        if Path(module.__file__ or "") not in plugin_folders.refused:
            gathered += getattr(module, "CASES", ())
    called = [case.name for case in gathered]
    if twice := sorted({name for name in called if called.count(name) > 1}):
        raise StudyError(
            sentence("two hard cases are called {case_name!r}; rename one", case_name=twice[0])
        )
    if bare := set(SUBSYSTEMS) - {case.subsystem for case in gathered}:
        raise StudyError(
            sentence("subsystems without a hard case: {bare}", bare=", ".join(sorted(bare)))
        )
    return tuple(sorted(gathered, key=lambda case: SUBSYSTEMS.index(case.subsystem)))


def _row(outcome: HardOutcome) -> tuple[str | float, ...]:
    case = outcome.case
    holds = f"skipped: {outcome.skipped}" if outcome.skipped else outcome.trouble or "yes"
    return (
        case.subsystem,
        case.case,
        case.given,
        case.reference.how,
        "" if outcome.skipped else outcome.error,
        case.bound,
        case.unit,
        case.beyond.text,
        holds,
    )


def _measure(progress: Progress | None = None) -> Findings:
    register = cases()
    outcomes = []
    for number, case in enumerate(register):
        if progress is not None:
            progress.report(number / len(register), case.name)
        outcomes.append(tried(case))
    failed = [outcome for outcome in outcomes if outcome.trouble]
    skipped = [outcome for outcome in outcomes if outcome.skipped]
    held = len(outcomes) - len(failed) - len(skipped)
    lines = [f"{held} of {len(outcomes)} cases hold, {len(failed)} fail, {len(skipped)} skipped."]
    lines += [f"FAILED {outcome.case.name}: {outcome.trouble}" for outcome in failed]
    lines += [f"skipped {outcome.case.name}: {outcome.skipped}" for outcome in skipped]
    sheet = Sheet("cases", "Hard cases", COLUMNS, tuple(map(_row, outcomes)))
    return Findings((sheet,), lines=tuple(lines), passed=not failed)


STUDY: Final = Survey(measure=_measure)
"""Every case tried."""
