"""Survey: does every subsystem hold where its formulas are delicate?

The cases stand in `hard_cases`, one register for this table, the tests and the documentation.
"""

from typing import Any, Final

from app.core.progress import Progress
from app.studies.findings import Findings, Sheet, Survey
from app.studies.hard_cases.case import HardOutcome, tried
from app.studies.hard_cases.register import cases

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
