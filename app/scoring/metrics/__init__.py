"""Metrics, one file each. See 'How to add a metric' in docs/extending.md.

They are listed and read as text (`core.plugins`); a metric is imported when it is computed, one of
somebody else's in a process of its own (`scoring.foreign`). Whatever such a file does breaks no
score: it has no value, and says why.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from app.core.messages import sentence
from app.core.plugins import FLAG, SLOTS, Declaration, Field, PluginKind, read_statements
from app.scoring.errors import (
    MetricError,
    MetricNotAskedError,
    MetricUnavailableError,
    UnknownMetricError,
)
from app.scoring.foreign import MetricOutcome, measured, outcome

if TYPE_CHECKING:
    from app.scoring.trajectory import Trajectory


@dataclass(frozen=True, slots=True, kw_only=True)
class Metric(Declaration):
    """One number about an attempt.

    Attributes:
        unit: of the value.
        higher_is_better: direction; for a signed value (depth) the distance from zero counts.
        reads: slots of the loop's state that it uses beyond the needle's pose; the scene compiler
            keeps the effects that write them.
        fault: why its file cannot be used; empty if it can.
    """

    unit: str
    higher_is_better: bool
    reads: tuple[str, ...]
    fault: str = ""

    @property
    def definition(self) -> str:
        """Return what is measured, in words: the text at the top of its file."""
        return ast.get_docstring(ast.Module(read_statements(self.path), [])) or ""

    @property
    def is_own(self) -> bool:
        """Return whether it is one of the program's own."""
        return KIND.is_own(self.path)

    def measured(self, trajectory: Trajectory) -> MetricOutcome:
        """Return its value of an attempt and how far that is known, or why there is none.

        Raises:
            Exception: if one of the program's own files fails; none of somebody else's does.
        """
        if self.fault:
            return MetricOutcome(None, None, self.fault)
        if not self.is_own:
            return measured(self.path, trajectory)
        return outcome(KIND.load(self), trajectory)

    def compute(self, trajectory: Trajectory) -> float:
        """Return the value of an attempt; never NaN.

        Raises:
            MetricUnavailableError: if the attempt does not allow it, or a file of somebody else's
                cannot be used or fails; says why.
            MetricError: if one of the program's own files cannot be used.
        """
        found = self.measured(trajectory)
        if found.value is None:
            raise (MetricUnavailableError if found.asked else MetricNotAskedError)(found.note)
        return found.value

    def deviation(self, trajectory: Trajectory) -> float | None:
        """Return the standard deviation of `compute`, in the same unit; None if it is not known.

        It is the file's own function `deviation`, which a file need not have.

        Raises:
            Exception: if one of the program's own files fails.
        """
        return self.measured(trajectory).sd


def available() -> dict[str, Metric]:
    """Every metric by name: the program's own, appended folders', then the user's.

    Somebody else's file that takes a name of the program's own is none; one that cannot be used is
    listed with its fault.

    Raises:
        MetricError: if one of the program's own files is no metric.
    """
    found: dict[str, list[Path]] = {}
    for path in KIND.files():  # the folders are looked through once, not once for each metric
        if not KIND.taken(path):
            found.setdefault(path.stem, []).append(path)
    return {name: _readable(files) for name, files in sorted(found.items())}


def find(name: str) -> Metric:
    """Return one metric by name.

    Raises:
        UnknownMetricError: listing the metrics that exist.
        MetricError: if one of the program's own files is no metric.
    """
    files = KIND.files(escape(name)) if Path(name).name == name else []
    if not (usable := [path for path in files if not KIND.taken(path)]):
        raise UnknownMetricError(
            sentence(
                "no metric {name!r}; there are {names}", name=name, names=", ".join(KIND.names())
            )
        )
    return _readable(usable)


def _readable(files: list[Path]) -> Metric:
    path = files[0]
    try:
        return KIND.read(path) if len(files) == 1 else KIND.find(path.stem)
    except MetricError as error:
        if KIND.is_own(path):
            raise
        return Metric(
            name=path.stem,
            path=path,
            title=path.stem,
            unit="",
            higher_is_better=False,
            reads=(),
            fault=str(error),
        )


def _label(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value


KIND: Final[PluginKind[Metric]] = PluginKind(
    noun="a metric",
    declares=Metric,
    fields={
        "title": Field("a text", _label),
        "unit": Field("a text, empty for a number without unit", _label),
        "higher_is_better": FLAG,
        "reads": SLOTS,
    },
    error=MetricError,
    package=__name__,
    folder="metrics",
    functions=("compute",),
)
