"""An attempt as two plain files: its series as a table, and all else that scoring needs as JSON.

Both together give back the `Trajectory` that was scored, with time from the attempt's beginning:
the score can be computed again where no record is. Numbers are written with all their digits.
"""

from __future__ import annotations

import csv
import gzip
import io
import json
import math
import zlib
from collections.abc import Mapping
from dataclasses import asdict, is_dataclass
from typing import Any, Final

import numpy as np
from pydantic import TypeAdapter

from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.words import printable
from app.planning.judged import JudgedPlan
from app.planning.placement import PlacedPlan
from app.research.errors import ResearchError
from app.scoring.met import Met
from app.scoring.result import Score
from app.scoring.risks import RiskMark
from app.scoring.rows import ScoreRules
from app.scoring.scans import ScanMark
from app.scoring.score import score
from app.scoring.tolerance import Tolerance
from app.scoring.touches import Touches
from app.scoring.trajectory import Phase, Trajectory
from app.scoring.version import KNOWN_VERSIONS
from app.session.facts import placed_plan
from app.session.verify import Change, changes_between

XYZ: Final = ("x", "y", "z")

SERIES: Final = (
    "time_s",
    "phase",
    *(f"tip_{axis}_m" for axis in XYZ),
    *(f"axis_{axis}" for axis in XYZ),
    "depth_m",
    "depth_valid",
    *(f"felt_{axis}_n" for axis in XYZ),
    *(f"hub_{axis}_m" for axis in XYZ),
    *(f"guide_{axis}_n" for axis in XYZ),
    *(f"target_shift_{axis}_m" for axis in XYZ),
    "sd_along_m",
    "sd_across_m",
    "picture_age_s",
    "clamped",
)
"""Columns of a series: in the robot's frame, SI; what is not known of an attempt is empty."""

_OPTIONAL: Final = {"felt": 3, "hub": 3, "guide": 3, "target_shift": 3, "spread": 3, "clamped": 1}
_PHASES: Final = {phase.name.lower(): phase for phase in Phase}
_MARKS: Final[Mapping[str, Any]] = {
    "scans": TypeAdapter(tuple[ScanMark, ...]),
    "risks": TypeAdapter(tuple[RiskMark, ...]),
    "touches": TypeAdapter(Touches | None),
    "met": TypeAdapter(tuple[Met, ...] | None),
    "planned": TypeAdapter(JudgedPlan | None),
}
_NUMBERS: Final = ("excused", "agreement", "computer", "seen_from")


BROKEN: Final = (
    *(ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError),
    *(OSError, EOFError, csv.Error, zlib.error),
)
"""What files that somebody else may have written raise where they are read."""

_LARGEST: Final = 1 << 28
"""Bytes of a series when it is unpacked."""


def series_table(trajectory: Trajectory) -> bytes:
    """Return the series of an attempt as CSV, compressed; the same bytes each time."""
    t = trajectory
    n = len(t)
    columns: list[Any] = [
        [*(t.time - t.time[0]).tolist()],
        [Phase(int(code)).name.lower() for code in t.phase],
        *t.tip.T.tolist(),
        *t.axis.T.tolist(),
        t.depth.tolist(),
        t.depth_valid.astype(int).tolist(),
    ]
    for name, width in _OPTIONAL.items():
        values = getattr(t, name)
        if values is None:
            columns += [[None] * n] * width
        elif width == 1:
            columns.append(values.astype(int).tolist())
        else:
            columns += values.T.tolist()
    stream = io.StringIO(newline="")
    lines = csv.writer(stream, lineterminator="\r\n")
    lines.writerow(SERIES)
    for row in zip(*columns, strict=True):
        lines.writerow([_cell(value) for value in row])
    return gzip.compress(stream.getvalue().encode(), mtime=0)


def attempt_document(
    trajectory: Trajectory,
    plan: Mapping[str, str],
    standing: Score,
    tolerances: Mapping[str, Tolerance],
    rules: ScoreRules,
) -> dict[str, Any]:
    """Return what else scoring needs of an attempt, JSON-ready, with its score.

    Args:
        trajectory: the attempt.
        plan: its plan, as the head of the record has it.
        standing: the score.
        tolerances: that it was judged by.
        rules: likewise.
    """
    begin = float(trajectory.time[0])
    marks = {name: _plain(getattr(trajectory, name)) for name in _MARKS}
    for one in (*marks["scans"], *marks["risks"], *(marks["met"] or ())):
        one["time"] -= begin
    if marks["touches"]:
        marks["touches"]["times"] = [time - begin for time in marks["touches"]["times"]]
    document = {
        "plan": dict(plan) | {"name": ""},
        "aborted": trajectory.aborted,
        "numbers": {name: float(getattr(trajectory, name)) for name in _NUMBERS},
        "arrays": [name for name in _OPTIONAL if getattr(trajectory, name) is not None],
        "marks": marks,
        "tolerances": {name: one.model_dump(by_alias=True) for name, one in tolerances.items()},
        "rules": rules.model_dump(mode="json"),
        "score": standing.document(),
    }
    return dict(_finite(document))


def trajectory_of(document: Mapping[str, Any], table: bytes) -> Trajectory:
    """Return the attempt of two files.

    Raises:
        ResearchError: if they do not fit together, or are damaged.
    """
    try:
        rows = list(csv.reader(io.StringIO(_unpacked(table).decode(), newline="")))
        if tuple(rows[0]) != SERIES:
            raise ValueError(sentence("its columns are not those of a series"))
        columns = dict(zip(SERIES, zip(*rows[1:], strict=True), strict=True))
        marks = {
            name: kind.validate_python(document["marks"][name]) for name, kind in _MARKS.items()
        }
        placed: PlacedPlan = placed_plan(dict(document["plan"]))
        known = set(document["arrays"])
        optional: dict[str, Any] = {
            name: _array(columns, names) if name in known else None
            for name, names in _columns_of().items()
        }
        clamped = optional.pop("clamped")
        numbers: dict[str, Any] = {name: float(document["numbers"][name]) for name in _NUMBERS}
        return Trajectory(
            placed=placed,
            time=_array(columns, ("time_s",)),
            tip=_array(columns, [f"tip_{axis}_m" for axis in XYZ]),
            axis=_array(columns, [f"axis_{axis}" for axis in XYZ]),
            depth=_array(columns, ("depth_m",)),
            phase=np.array([_PHASES[name] for name in columns["phase"]], dtype=np.int8),
            depth_valid=_array(columns, ("depth_valid",)) > 0.0,
            clamped=None if clamped is None else clamped > 0.0,
            aborted=str(document["aborted"]),
            **optional,
            **numbers,
            **marks,
        )
    except (AcusError, ValueError, LookupError, TypeError, OSError, EOFError) as error:
        raise ResearchError(
            sentence("its series cannot be read: {reason}", reason=error)
        ) from error


def differences(document: Mapping[str, Any], table: bytes) -> list[Change]:
    """Score an attempt again from its two files; return what is not as its score says.

    Raises:
        ResearchError: if they are damaged, or the rules of the score are not known here.
    """
    trajectory = trajectory_of(document, table)
    try:
        written = Score.from_json(json.dumps(document["score"]))
        tolerances = {
            str(name): Tolerance.model_validate(limits)
            for name, limits in document["tolerances"].items()
        }
        rules = ScoreRules.model_validate(document["rules"])
    except (AcusError, *BROKEN) as error:
        raise ResearchError(sentence("its score cannot be read: {reason}", reason=error)) from error
    if written.version not in KNOWN_VERSIONS:
        raise ResearchError(
            sentence("its score follows rules {version}, unknown here", version=written.version)
        )
    try:
        now, unscored = score(trajectory, tolerances, rules, written.version), ""
    except (AcusError, ArithmeticError) as error:
        now, unscored = None, str(error)
    return changes_between(written, now, unscored)


def _unpacked(table: bytes) -> bytes:
    """Unpack a series, if it is no larger than one may be."""
    with gzip.GzipFile(fileobj=io.BytesIO(table)) as stream:
        data = stream.read(_LARGEST + 1)
    if len(data) > _LARGEST:
        raise ValueError(sentence("it is too large"))
    return data


def _columns_of() -> dict[str, tuple[str, ...]]:
    return {
        "felt": tuple(f"felt_{axis}_n" for axis in XYZ),
        "hub": tuple(f"hub_{axis}_m" for axis in XYZ),
        "guide": tuple(f"guide_{axis}_n" for axis in XYZ),
        "target_shift": tuple(f"target_shift_{axis}_m" for axis in XYZ),
        "spread": ("sd_along_m", "sd_across_m", "picture_age_s"),
        "clamped": ("clamped",),
    }


def _array(columns: Mapping[str, Any], names: Any) -> Any:
    found = np.array(
        [[float(text) if text else math.nan for text in columns[name]] for name in names]
    )
    return found[0] if len(names) == 1 else found.T


def _cell(value: Any) -> str:
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return ""
    return repr(value) if isinstance(value, float) else str(value)


def _plain(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_plain(one) for one in value]
    return asdict(value) if is_dataclass(value) and not isinstance(value, type) else value


def _finite(value: Any) -> Any:
    """Return a value for JSON: what is not finite as text, which a number reads back from."""
    if isinstance(value, Mapping):
        return {str(key): _finite(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(inner) for inner in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if isinstance(value, np.generic):
        return _finite(value.item())
    return printable(str(value)) if isinstance(value, str) else value
