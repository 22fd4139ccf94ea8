"""Survey: does the tissue do what was measured?

The cases stand in resources/published.yaml: what was measured of needles in tissue, how, by whom,
and the range that holds it. Each is driven along its protocol (`insertions`), by today's values and
models and by those of before, and held against its range. Where measurements exclude each other
both are shown; the one that is not followed says why. Where ours is a value that was set by such
numbers, or where it is so by definition, agreeing is no finding: that is counted apart.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from math import isfinite
from pathlib import Path
from typing import Any, Final

from app.core import paths
from app.core.configuration import read_yaml
from app.core.messages import sentence
from app.core.progress import Progress
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.tissues import FIRST, PUBLISHED, TISSUES
from app.studies.errors import StudyError
from app.studies.findings import Findings, Sheet, Survey
from app.studies.insertions import EXPERIMENTS, PARAMETERS

DECLARATION: Final[dict[str, Any]] = {
    "title": "Published: needles in tissue, measured and ours",
    "question": "Does the tissue do what was measured of it?",
    "reference": "published measurements, each with its protocol and range",
}

KINDS: Final = ("gel", "organ", "in vivo", "cadaver", "people", "definition")
"""What a figure is of; they are never mixed."""

_WANTED: Final[Mapping[str, Any]] = {
    "id": str,
    "what": str,
    "drive": str,
    "protocol": dict,
    "value": (int, float),
    "range": list,
    "unit": str,
    "source": str,
    "kind": str,
    "read": str,
}
_MAY: Final[Mapping[str, Any]] = {"means": str, "chosen": bool, "choice": str}

MEANINGS: Final = ("mean", "at most", "at least", "middle of the range")
"""What the value is that a source gives; only an inequality, or a range, where it gives no more."""

COLUMNS: Final = (
    "case",
    "what",
    "kind",
    "unit",
    "measured",
    "range",
    "ours",
    "ours/measured",
    "before",
    "verdict",
    "source",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PublishedCase:
    """A measurement.

    Attributes:
        name: of the case, unique.
        what: was measured.
        drive: key of `insertions.EXPERIMENTS`.
        protocol: tissue, gauge, speeds [mm/s] and depths [mm] of it.
        value: what was measured [unit].
        least, most: range that holds it, by its spread or its statement.
        unit: of all three.
        source: who measured it, in what.
        kind: one of `KINDS`.
        read: how the figure was come by.
        chosen: whether the program's values are made to follow it.
        choice: why it is followed, or why not.
        means: what the value is, of `MEANINGS`.
    """

    name: str
    what: str
    drive: str
    protocol: Mapping[str, Any]
    value: float
    least: float
    most: float
    unit: str
    source: str
    kind: str
    read: str
    chosen: bool = True
    choice: str = ""
    means: str = MEANINGS[0]

    @property
    def measured(self) -> str:
        """Return the value as its source gives it."""
        if self.means == "middle of the range":
            return f"{self.least:g} to {self.most:g}"
        return f"{self.value:g}" if self.means == "mean" else f"{self.means} {self.value:g}"

    @property
    def is_definition(self) -> bool:
        """Return whether it holds because the value or the effect was made so."""
        return self.chosen and (self.kind == "definition" or self.drive in PARAMETERS)

    def ours(self, version: str = PUBLISHED) -> float:
        """Return what the program's values and models of a version give [unit]."""
        return EXPERIMENTS[self.drive](version, self.protocol)

    def holds(self, value: float) -> bool:
        """Return whether a value lies in the range."""
        return self.least <= value <= self.most


def cases_file() -> Path:
    """Return the program's own file of cases."""
    return paths.resources() / "published.yaml"


@cache
def cases() -> tuple[PublishedCase, ...]:
    """Return the program's own cases, see `read_cases`."""
    return read_cases(cases_file())


def read_cases(path: Path) -> tuple[PublishedCase, ...]:
    """Read cases, in the file's order.

    Raises:
        ConfigurationError: if it is not YAML.
        StudyError: naming file, case and what is wrong: a range that excludes its own value, an
            unknown drive, kind, tissue or gauge, a key too many or too few, two of one name.
    """
    document = read_yaml(path)
    rows = document.get("cases") if isinstance(document, dict) else None
    if not isinstance(rows, list) or not rows:
        raise StudyError(sentence("{path} has no list `cases`", path=path))
    read = tuple(_case(path, number, row) for number, row in enumerate(rows, 1))
    names = [case.name for case in read]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise StudyError(
            sentence(
                "{path}: two cases are called {case_name!r}; rename one",
                path=path,
                case_name=twice[0],
            )
        )
    return read


def _case(path: Path, number: int, row: Any) -> PublishedCase:
    name = row.get("id", number) if isinstance(row, dict) else number
    where = f"{path}: case {name}"
    if not isinstance(row, dict):
        raise StudyError(
            sentence(
                "{where} is {row!r}; give {wanted}", where=where, row=row, wanted=", ".join(_WANTED)
            )
        )
    if wrong := sorted((set(_WANTED) - set(row)) | (set(row) - set(_WANTED) - set(_MAY))):
        raise StudyError(
            sentence(
                "{where}: check {key!r}; there must be {wanted}, and may be {may}",
                where=where,
                key=wrong[0],
                wanted=", ".join(_WANTED),
                may=", ".join(_MAY),
            )
        )
    for key, kind in {**_WANTED, **_MAY}.items():
        if key in row and (not isinstance(row[key], kind) or row[key] == ""):
            raise StudyError(
                sentence("{where}: {key} is {row!r}", where=where, key=key, row=row[key])
            )
    ends = row["range"]
    usable = len(ends) == 2 and all(type(end) in (int, float) and isfinite(end) for end in ends)
    if not usable or not ends[0] <= ends[1]:
        raise StudyError(
            sentence(
                "{where}: range is {ends!r}; give [least, most], finite numbers",
                where=where,
                ends=ends,
            )
        )
    if not ends[0] <= row["value"] <= ends[1]:
        raise StudyError(
            sentence(
                "{where}: {measured:g} {unit} was measured, and the range {least:g} to"
                " {largest:g} excludes it; give the range that holds it",
                where=where,
                measured=row["value"],
                unit=row["unit"],
                least=ends[0],
                largest=ends[1],
            )
        )
    _check_names(where, row)
    given = {key: row[key] for key in _WANTED if key not in ("id", "range")}
    more = {key: row[key] for key in _MAY if key in row}
    return PublishedCase(name=row["id"], least=ends[0], most=ends[1], **given, **more)


def _check_names(where: str, row: Mapping[str, Any]) -> None:
    protocol = row["protocol"]
    for what, value, valid in (
        ("drive", row["drive"], tuple(EXPERIMENTS)),
        ("kind", row["kind"], KINDS),
        ("means", row.get("means", "mean"), MEANINGS),
        ("tissue", protocol.get("tissue", "liver"), tuple(TISSUES[PUBLISHED])),
        ("gauge", protocol.get("gauge", 18), tuple(OUTER_DIAMETER)),
        ("against_gauge", protocol.get("against_gauge", 18), tuple(OUTER_DIAMETER)),
    ):
        if value not in valid:
            raise StudyError(
                sentence(
                    "{where}: {quantity} is {entry!r}; there are {valid}",
                    where=where,
                    quantity=what,
                    entry=value,
                    valid=", ".join(map(str, valid)),
                )
            )
    if row.get("chosen") is False and not row.get("choice"):
        raise StudyError(sentence("{where} is not chosen; say in `choice` why", where=where))


def _verdict(case: PublishedCase, ours: float) -> str:
    if case.holds(ours):
        return "definition" if case.is_definition else "within"
    return "OUTSIDE" if case.chosen else "not followed"


def _row(case: PublishedCase, ours: float, before: float) -> tuple[str | float, ...]:
    return (
        case.name,
        case.what,
        case.kind,
        case.unit,
        case.measured,
        f"{case.least:g} to {case.most:g}",
        round(ours, 4),
        round(ours / case.value, 3) if case.value else "-",
        round(before, 4),
        _verdict(case, ours),
        case.source,
    )


def measure(progress: Progress | None = None) -> Findings:
    """Drive every case and hold it against its range."""
    rows, outside = [], []
    for number, case in enumerate(cases()):
        if progress is not None:
            progress.report(number / len(cases()), case.name)
        found = case.ours()
        rows.append(_row(case, found, case.ours(FIRST)))
        if case.chosen and not case.holds(found):
            outside.append(case.name)
    definitions = sum(case.is_definition for case in cases())
    driven = [case.name for case in cases() if case.chosen and not case.is_definition]
    hold = len(driven) - len(set(driven) & set(outside))
    lines = [
        f"{hold} of {len(driven)} measurements that effects are driven along and that are followed"
        f" hold. {definitions} more are definitions: a value beside the numbers that it was set by,"
        f" or so by the effect's own rule. {sum(not case.chosen for case in cases())} are not"
        " followed."
    ]
    lines += [f"OUTSIDE {name}" for name in outside]
    lines += [f"{case.name}: {' '.join(case.choice.split())}" for case in cases() if case.choice]
    sheet = Sheet("published", "Measured, and ours", COLUMNS, tuple(rows))
    how = tuple((case.name, case.read, _protocol(case)) for case in cases())
    protocols = Sheet("protocols", "How it was done", ("case", "read", "protocol"), how)
    return Findings((sheet, protocols), lines=tuple(lines), passed=not outside)


def _protocol(case: PublishedCase) -> str:
    return ", ".join(f"{key} {value}" for key, value in case.protocol.items())


STUDY: Final = Survey(measure=measure)
"""Every case, driven."""
