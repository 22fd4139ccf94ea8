"""Metrics of somebody else's: computed in a process of their own, each file in its own.

Such a file can end the process, crash it, spoil its modules or never come back. There that costs
its own row, which says why, and nothing else. The process has the user's rights: it is a limit for
accidents, not for an intruder.
"""

from __future__ import annotations

import atexit
import importlib.util
import pickle
import sys
import threading
from collections import OrderedDict
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.errors import ImagingError, WorkerLostError
from app.imaging.worker.jobs import Job
from app.imaging.worker.limits import Allowance
from app.imaging.worker.pool import ImagingWorker
from app.imaging.worker.values import ATTACHED
from app.scoring.errors import MetricNotAskedError, MetricUnavailableError

if TYPE_CHECKING:
    from app.scoring.trajectory import Trajectory

LIMIT = Allowance(5.0, 1 << 30, 15.0)
"""What one file may take for one attempt: processor time, memory, time on the clock."""

_LOADING: Final = Allowance(60.0)
_MOST_WARM: Final = 4
"""Files whose processes are kept for the next attempt."""


@dataclass(frozen=True, slots=True)
class MetricOutcome:
    """What a file gave for an attempt.

    Attributes:
        value: None if it gave none.
        sd: standard deviation of the value; None if it is not known.
        note: why there is no value; empty if there is one.
        asked: whether the exercise has what it measures.
    """

    value: float | None
    sd: float | None
    note: str
    asked: bool = True


def outcome(
    module: Any,
    trajectory: Trajectory,
    borne: type[BaseException] = MetricUnavailableError,
) -> MetricOutcome:
    """Ask a metric's file for its value of an attempt, and for its deviation where it knows one.

    Args:
        module: the file.
        trajectory: the attempt.
        borne: what its `deviation` may raise: the value stands.

    Raises:
        BaseException: whatever else the file raises.
    """
    try:
        value = float(module.compute(trajectory))
    except MetricUnavailableError as error:
        return MetricOutcome(None, None, str(error), not isinstance(error, MetricNotAskedError))
    if not isfinite(value):
        return MetricOutcome(None, None, "the value is too large to be written as a number")
    try:
        sd = module.deviation(trajectory) if hasattr(module, "deviation") else None
        sd = -1.0 if sd is None else float(sd)  # None: not known
    except borne:
        sd = -1.0
    return MetricOutcome(value, sd if isfinite(sd) and sd >= 0.0 else None, "")


_LOAD: Final[Job[None]] = Job("app.scoring.foreign:load", None)
_MEASURE: Final[Job[MetricOutcome]] = Job("app.scoring.foreign:measure", MetricOutcome)


class _Processes:
    """The processes of the files used last, and what files have cost theirs."""

    def __init__(self) -> None:
        self._warm: OrderedDict[Path, ImagingWorker] = OrderedDict()
        self._costly: dict[tuple[Path, int], str] = {}
        self._lock = threading.Lock()

    def measured(self, path: Path, trajectory: Trajectory) -> MetricOutcome:
        """Compute a metric; what a file did to its process is remembered until it is changed."""
        try:
            key = path, path.stat().st_mtime_ns
        except OSError as error:
            return MetricOutcome(
                None,
                None,
                sentence(
                    "{path} cannot be read: {error_strerror}",
                    path=path,
                    error_strerror=error.strerror or error,
                ),
            )
        with self._lock:
            if key not in self._costly:
                try:
                    return self._call(path, trajectory)
                except WorkerLostError as lost:
                    self._costly[key] = f"{path}: the process that computes it {lost.reason}"
                except (ImagingError, OSError) as error:
                    return MetricOutcome(None, None, f"{path} cannot be computed: {error}")
            return MetricOutcome(None, None, self._costly[key])

    def close(self) -> None:
        """End all of them; idempotent."""
        while self._warm:
            self._warm.popitem()[1].close()

    def _call(self, path: Path, trajectory: Trajectory) -> MetricOutcome:
        worker = self._warm.pop(path, None)
        if worker is None:
            worker = ImagingWorker(most=1)
            worker.call(_LOAD, (), _LOADING, Progress())  # the program's own modules count nothing
        try:
            packed = np.frombuffer(pickle.dumps(trajectory), np.uint8)
            found = worker.call(_MEASURE, (path.absolute(), packed), LIMIT, Progress())
        except BaseException:
            worker.close()
            raise
        self._warm[path] = worker
        while len(self._warm) > _MOST_WARM:
            self._warm.popitem(last=False)[1].close()
        return found


_processes = _Processes()
atexit.register(_processes.close)


def measured(path: Path, trajectory: Trajectory) -> MetricOutcome:
    """Compute the metric of somebody else's file in a process of its own; never raises.

    Args:
        path: the file.
        trajectory: the attempt.
    """
    return _processes.measured(path, trajectory)


# --- in the process ------------------------------------------------------------------------------
def load(progress: Progress) -> None:
    """Import what every metric needs."""
    importlib.import_module("app.scoring.trajectory")


def measure(
    path: Path, packed: Annotated[NDArray[np.uint8], ATTACHED], progress: Progress
) -> MetricOutcome:
    """Import a file, and ask it for an attempt.

    Args:
        path: the file.
        packed: the attempt, pickled by the program.
        progress: of the job.
    """
    trajectory: Trajectory = pickle.loads(packed.tobytes())
    try:
        module = _module(path)
    except BaseException as error:
        return MetricOutcome(None, None, f"{path} cannot be imported: {_named(error)}")
    try:
        return outcome(module, trajectory, BaseException)
    except BaseException as error:
        return MetricOutcome(None, None, f"{path}: compute() fails: {_named(error)}")


def _module(path: Path) -> Any:
    name = f"app.scoring.metrics.{path.stem}"
    stamp = path.stat().st_mtime_ns
    known = sys.modules.get(name)
    if known is not None and getattr(known, "_acus_stamp", None) == (str(path), stamp):
        return known
    specification = importlib.util.spec_from_file_location(name, path)
    if specification is None or specification.loader is None:
        raise ImportError(sentence("it is no Python file"))
    module = sys.modules[name] = importlib.util.module_from_spec(specification)
    try:
        specification.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    vars(module)["_acus_stamp"] = str(path), stamp
    return module


def _named(error: BaseException) -> str:
    text = f"{type(error).__name__}: {error}".rstrip(": ")
    return (
        sentence("it ends the program ({fault})", fault=text)
        if isinstance(error, SystemExit)
        else text
    )
