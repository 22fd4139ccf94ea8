"""The table of a sweep over conditions, whole or while it grows: means, and what they cost.

`acus cohort` writes the table at its end and each finished part beside it (`FILE.parts`). Scripts
did the attempts: the figures say what conditions cost a script, nobody's skill.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from app.core.arrow import arrow
from app.core.messages import sentence
from app.studies.errors import StudyError

PASSED: Final = "passed"
"""Measure whose mean is a share, 0 to 1."""

_SEED: Final = "seed"
"""First column behind the conditions."""

_NAMES: Final = ("exercise", "version")
_MEASURES: Final = ("total", PASSED, "duration_s")
_VALUE: Final = "value_"


@dataclass(frozen=True, slots=True)
class SweepMean:
    """The attempts of one condition.

    Attributes:
        series: value of the condition that parts the lines; empty without one.
        at: value of the condition along the axis.
        attempts: that could be judged.
        mean: of the measure.
        lower, upper: interval of 95 %: Student's t; of a share Wilson's (1927); the mean itself
            where one attempt tells no interval.
    """

    series: str
    at: str | float
    attempts: int
    mean: float
    lower: float
    upper: float


@dataclass(frozen=True)
class SweepTable:
    """Attempts of a sweep as columns.

    Attributes:
        columns: by name, in their order; None where there is no value.
        finished: whether all parts are there.
        wanted: attempts of the whole sweep; None where nothing says.
        attempt_s: time of a processor for one attempt [s]; None where nothing says.
    """

    columns: Mapping[str, Sequence[Any]]
    finished: bool
    wanted: int | None = None
    attempt_s: float | None = None

    @property
    def attempts(self) -> int:
        """Return how many attempts there are."""
        return len(self.columns[_SEED])

    @property
    def unjudged(self) -> int:
        """Return how many have no score; no mean holds them."""
        return sum(total is None for total in self.columns["total"])

    @property
    def conditions(self) -> tuple[str, ...]:
        """Return the columns that were varied; of a sweep of one condition the skill."""
        names = list(self.columns)[: list(self.columns).index(_SEED)]
        varied = [name for name in names if len(set(self.columns[name])) > 1]
        return tuple(varied) or ("skill",)

    @property
    def measures(self) -> tuple[str, ...]:
        """Return the columns of which there are means."""
        values = [name for name in self.columns if name.startswith(_VALUE)]
        told = [name for name in values if any(one is not None for one in self.columns[name])]
        return (*_MEASURES, *told)

    @property
    def exercise(self) -> str:
        """Return which exercise it is, with its version; empty while there is no attempt."""
        some = zip(*(self.columns[name] for name in _NAMES), strict=True)
        return next((f"{name}, v{version}" for name, version in some), "")

    def means(self, measure: str, over: str, apart: str = "") -> tuple[SweepMean, ...]:
        """Return the means of a measure, series by series, along a condition.

        Other conditions that were varied are in them as they come, each as often as it was tried.

        Args:
            measure: one of `measures`.
            over: one of `conditions`.
            apart: another one; empty for one series.
        """
        groups: dict[tuple[str, Any], list[float]] = {}
        series = self.columns[apart] if apart else [""] * self.attempts
        rows = zip(
            series, self.columns[over], self.columns["total"], self.columns[measure], strict=True
        )
        for part, at, total, value in rows:
            if total is not None and value is not None:
                groups.setdefault((_words(part), at), []).append(float(value))
        found = [
            SweepMean(part, at, len(values), *_mean(values, measure == PASSED))
            for (part, at), values in groups.items()
        ]
        return tuple(sorted(found, key=lambda one: (one.series, _order(one.at))))


def read_sweep(path: Path) -> SweepTable:
    """Read a sweep's table, or its parts while it is not there.

    Args:
        path: of the table, `.parquet`.

    Raises:
        StudyError: where neither is there, or the file is no table of a sweep; names the extra
            where pyarrow is not installed.
    """
    pa = arrow(StudyError, "research")
    folder = path.with_name(f"{path.name}.parts")
    parts = sorted(folder.glob("*.parquet"))
    finished = path.is_file()
    if not finished and not parts:
        raise StudyError(
            sentence(
                "{path} is no table of a sweep, and no part of one lies beside it: choose what "
                "`acus cohort sweep --out` wrote, or is writing",
                path=path,
            )
        )
    tables, spent = [], [0.0, 0.0]
    try:
        for one in [path] if finished else parts:
            tables.append(pa.parquet.read_table(one, partitioning=None))
        whole = pa.concat_tables([one.replace_schema_metadata(None) for one in tables])
        for one in parts:
            cost = (pa.parquet.read_schema(one).metadata or {}).get(b"acus_spent")
            attempts, _, working = json.loads(cost or b"[0, 0, 0]")
            spent = [spent[0] + float(attempts), spent[1] + float(working)]
        columns = {name: whole.column(name).to_pylist() for name in whole.column_names}
        lacking = {_SEED, "total", *_NAMES, *_MEASURES} - columns.keys()
    except (OSError, ValueError, TypeError, pa.ArrowException) as error:
        raise StudyError(
            sentence(
                "{path} is no table of a sweep, or is damaged: choose what "
                "`acus cohort sweep --out` wrote, or is writing",
                path=path,
            )
        ) from error
    if lacking:
        raise StudyError(
            sentence(
                "{path} is no table of a sweep (no {columns}): `acus cohort sweep` writes one",
                path=path,
                columns=", ".join(sorted(lacking)),
            )
        )
    wanted = len(columns[_SEED]) if finished else _wanted(folder)
    return SweepTable(columns, finished, wanted, spent[1] / spent[0] if spent[0] else None)


def _wanted(folder: Path) -> int | None:
    """Return how many attempts the sweep shall have; None where it does not say."""
    try:
        return int(json.loads((folder / "run.json").read_text(encoding="utf-8"))["rows"])
    except (OSError, ValueError, LookupError, TypeError):
        return None


def _mean(values: Sequence[float], share: bool) -> tuple[float, float, float]:
    """Return a mean with its interval of 95 %: Wilson's (1927) of a share, else Student's t."""
    from scipy.stats import binomtest, ttest_1samp

    number, mean = len(values), math.fsum(values) / len(values)
    if share:
        lower, upper = binomtest(round(sum(values)), number).proportion_ci(method="wilson")
    elif number < 2 or len(set(values)) == 1:  # which tell no interval
        return mean, mean, mean
    else:
        lower, upper = ttest_1samp(values, 0.0).confidence_interval()
    return mean, float(lower), float(upper)


def _order(value: Any) -> tuple[bool, float, str]:
    """Return what numbers are sorted by, and texts behind them."""
    number = isinstance(value, int | float)
    return (not number, float(value) if number else 0.0, "" if number else str(value))


def _words(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
