"""Metrics, one file each. A file in this folder is a metric; there is no list to edit."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType

from app.core.state_vector import INDEX
from app.scoring.errors import MetricError, UnknownMetricError
from app.scoring.trajectory import Trajectory


@dataclass(frozen=True, slots=True)
class Metric:
    """One number about an attempt.

    Attributes:
        name: name of its file, used in tolerances.
        label: for display.
        unit: of the value.
        higher_is_better: direction; for a signed value (depth) the distance from zero counts.
        reads: slots of the loop's state that it uses beyond the needle's pose; the scene compiler
            keeps the effects that write them.
        definition: its docstring.
        compute: the value of a trajectory; never NaN.
    """

    name: str
    label: str
    unit: str
    higher_is_better: bool
    reads: tuple[str, ...]
    definition: str
    compute: Callable[[Trajectory], float]


def available() -> dict[str, Metric]:
    """Every metric on the search path of this package, by name.

    Raises:
        MetricError: if a file is not a metric; names the file and what it lacks.
    """
    names = sorted(module.name for module in pkgutil.iter_modules(__path__))
    return {name: _metric(name) for name in names}


def find(name: str) -> Metric:
    """Return one metric by name.

    Raises:
        UnknownMetricError: listing the metrics that exist.
    """
    names = [module.name for module in pkgutil.iter_modules(__path__)]
    if name not in names:
        raise UnknownMetricError(f"no metric {name!r}; there are {', '.join(sorted(names))}")
    return _metric(name)


def _metric(name: str) -> Metric:
    module = importlib.import_module(f"{__name__}.{name}")
    try:
        if name != module.NAME:
            raise MetricError(f"{module.__file__}: NAME is {module.NAME!r}, the file is {name!r}")
        return Metric(
            name=name,
            label=module.LABEL,
            unit=module.UNIT,
            higher_is_better=module.HIGHER_IS_BETTER,
            reads=_reads(module),
            definition=(module.__doc__ or "").strip(),
            compute=module.compute,
        )
    except AttributeError as error:
        raise MetricError(f"{module.__file__} is not a metric: {error}") from error


def _reads(module: ModuleType) -> tuple[str, ...]:
    reads = tuple(getattr(module, "READS", ()))
    unknown = [slot for slot in reads if slot not in INDEX]
    if unknown:
        raise MetricError(f"{module.__file__}: READS names {unknown[0]!r}, which is no state slot")
    return reads
