"""Tables for spreadsheets: attempts, one attempt over time, measurements (RFC 4180, UTF-8).

The first line holds the column names, with units, as every spreadsheet expects; the training
disclaimer stands in the last column, `note`, of every row, so that it survives sorting and cutting.
Measurements also go to 3D Slicer as markups (schema as in `markups`): a distance is a Line, an
angle an Angle, a value a Fiducial, a region a ClosedCurve on its rim; each with what was measured.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.disclaimer import DISCLAIMER
from app.core.errors import writing
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.words import printable
from app.exchange.errors import ExportError
from app.exchange.markups import SCHEMA
from app.imaging.volume import Volume
from app.planning.measurements import KINDS, Angle, Distance, Measurement, Probe, Region
from app.planning.measuring import measured
from app.scoring.conditions import Conditions, comparison_groups
from app.session.curves import curves
from app.session.recording import Recording
from app.session.samples import Samples
from app.session.summary import Summary

_FORMULA: Final = ("=", "+", "-", "@", "\t", "\r", "\n")


def table_text(lines: Iterable[Sequence[object]], semicolons: bool = False) -> str:
    """Write rows of values; with semicolons and decimal commas where a spreadsheet expects them.

    That is what Excel opens by a double click on computers whose decimal sign is the comma.
    """
    stream = io.StringIO(newline="")
    rows = ([cell(value, "," if semicolons else ".") for value in line] for line in lines)
    separator = ";" if semicolons else ","
    csv.writer(stream, delimiter=separator, lineterminator="\r\n").writerows(rows)
    return stream.getvalue()


def cell(value: object, decimal: str = ".") -> str:
    """Return the text of a cell; nothing in it steers a terminal but the ends of its lines.

    What a spreadsheet would run as a formula begins with an apostrophe.
    """
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return f"{value:.9g}".replace(".", decimal) if np.isfinite(value) else ""
    if isinstance(value, int):
        return str(value)
    text = "\r".join(map(printable, str(value).split("\r")))
    return f"'{text}" if text.startswith(_FORMULA) else text


COLUMNS: Final = (
    "name",
    "kind",
    "quantity",
    "value",
    "unit",
    "x_mm",
    "y_mm",
    "z_mm",
    "note",
)
"""Columns of the table: one row for each value; x, y, z is the first point, LPS."""

_TYPES: Final = {Distance: "Line", Angle: "Angle", Probe: "Fiducial", Region: "ClosedCurve"}
_RIM: Final = 24


def measurements_table(items: Sequence[Measurement], volume: Volume) -> str:
    """Return a table of all values (RFC 4180), one row each."""
    rows: list[Sequence[object]] = [COLUMNS]
    for number, item in enumerate(items, start=1):
        found = measured(item, volume)
        for quantity in found:
            rows.append(
                (
                    title(item, number),
                    KINDS[type(item)],
                    quantity.name,
                    quantity.value,
                    quantity.unit,
                    *item.points[-1 if isinstance(item, Region) else 0],
                    f"{found.note}; {DISCLAIMER}" if found.note else DISCLAIMER,
                )
            )
    return table_text(rows)


def measurements_document(items: Sequence[Measurement], volume: Volume) -> dict[str, Any]:
    """Return a markups document with one markup for each measurement."""
    return {
        "@schema": SCHEMA,
        "markups": [_markup(item, number, volume) for number, item in enumerate(items, start=1)],
    }


def write_measurements(path: Path, items: Sequence[Measurement], volume: Volume) -> None:
    """Write a table (`.csv`) or Slicer markups (`.mrk.json`), by the file's name.

    Raises:
        ExportError: if the name is of neither, there is nothing to write, or it cannot be written.
    """
    if not items:
        raise ExportError(sentence("there is no measurement to write: take one first"))
    if path.suffix.lower() == ".csv":
        write_csv(path, measurements_table(items, volume))
        return
    if not path.name.lower().endswith(".json"):
        raise ExportError(
            sentence(
                "{path_name}: measurements are written as .csv or .mrk.json", path_name=path.name
            )
        )
    text = json.dumps(
        measurements_document(items, volume), indent=1, allow_nan=False, ensure_ascii=False
    )
    with writing(path, ExportError):
        write_atomically(path, printable(text) + "\n")


def title(item: Measurement, number: int) -> str:
    """Name of a measurement: its own, else its kind and its number."""
    return item.name or f"{KINDS[type(item)]} {number}"


def _markup(item: Measurement, number: int, volume: Volume) -> dict[str, Any]:
    points = item.outline(_RIM).tolist() if isinstance(item, Region) else item.points
    found = measured(item, volume)
    return {
        "type": _TYPES[type(item)],
        "name": title(item, number),
        "coordinateSystem": "LPS",
        "coordinateUnits": "mm",
        "locked": True,
        "labelFormat": "%N-%d",
        "controlPoints": [
            {
                "id": str(i),
                "label": f"{title(item, number)}-{i}",
                "position": list(point),
                "selected": True,
                "locked": False,
                "visibility": True,
                "positionStatus": "defined",
            }
            for i, point in enumerate(points, start=1)
        ],
        "measurements": [
            {
                "name": q.name,
                "enabled": True,
                "value": q.value,
                "units": q.unit,
                "printFormat": "%-#4.4g%s",
            }
            for q in found
            if q.value is not None
        ],
        "description": DISCLAIMER,
    }


FIXED: Final = (
    "id",
    "started_utc",
    "student",
    "exercise",
    "state",
    "reason",
    "duration_s",
    "scans",
    "score_total_percent",
    "passed",
    "void_reason",
    "exercise_version",
    "exercise_level",
    "assistance_set",
    "assistance_least",
    "assistance_most",
    "assistance_mean",
    "views",
    "hand",
    "scripted",
    "taken_over",
    "robot",
    "device",
    "seed",
    "software",
    "calibration",
    "agreement_mm",
    "scoring_version",
    "comparison_group",
    "signature",
)
"""Columns before the metrics; each metric then has the column `<name>_<unit>`, and one for its
standard deviation. After them stand `drill`, which part of the exercise alone was practised (its
`passed` is no pass of the exercise), `bands`, the hand by whose own bands it was judged and where
these come from, and `note`."""

TRAJECTORY_COLUMNS: Final = (
    "time_s",
    "state",
    "valid",
    "depth_source",
    "tip_x_mm",
    "tip_y_mm",
    "tip_z_mm",
    "depth_mm",
    "tip_radius_95_mm",
    "lateral_mm",
    "remaining_mm",
    "angle_deg",
    "felt_n",
    "felt_least_n",
    "felt_most_n",
    "felt_measured_n",
    "felt_source",
    "tissue_along_n",
    "note",
)
"""Columns of a trajectory; positions in the world frame."""

_UNIT_NAMES: Final = {
    "%": "percent",
    "°": "deg",
    "N·s": "ns",
    "scans": "count",
    "": "ratio",
    "1": "ratio",
}


def score_table(summaries: Iterable[Summary]) -> str:
    """Table of attempts, one row each, in the given order.

    The metrics' columns are the union over all attempts; a metric that an attempt does not have is
    empty there. Scores may be compared within one `comparison_group` only; it is empty without one.
    """
    rows = list(summaries)
    groups = _groups(rows)
    metrics = list(dict.fromkeys(name for row in rows for name in _metrics(row)))
    unsure = [f"{name}_sd" for name in metrics]
    lines: list[list[object]] = [[*FIXED, *metrics, *unsure, "drill", "bands", "note"]]
    for row, group in zip(rows, groups, strict=True):
        values, sds = _metrics(row), _metrics(row, "sd")
        cells = [
            *_fixed(row),
            *_conditions(row),
            group,
            row.signature,
            *(values.get(name) for name in metrics),
            *(sds.get(name) for name in metrics),
            None if row.conditions is None else row.conditions.drill,
            None if row.conditions is None else _bands(row.conditions),
            DISCLAIMER,
        ]
        lines.append(cells)
    return table_text(lines)


def trajectory_table(recording: Recording) -> str:
    """Table of one attempt over time; cells of the tip are empty where no camera vouches for it.

    Raises:
        BrokenRecordingError: if the record holds no usable plan.
    """
    samples = recording.samples
    figures = curves(samples, recording.placed_plan())
    columns = (
        figures.time,
        samples.state,
        samples.valid,
        samples.depth_source,
        *(samples.tip * 1e3).T,
        figures.depth * 1e3,
        _or_unknown(samples.radius, samples) * 1e3,
        figures.lateral * 1e3,
        figures.remaining * 1e3,
        np.degrees(figures.angle),
        figures.felt,
        _or_unknown(samples.felt_least, samples),
        _or_unknown(samples.felt_most, samples),
        samples.measured,
        _sources(samples),
        _or_unknown(samples.along, samples),
    )
    lines: list[list[object]] = [list(TRAJECTORY_COLUMNS)]
    for values in zip(*(column.tolist() for column in columns), strict=True):
        lines.append([*values, DISCLAIMER])
    return table_text(lines)


def _or_unknown(values: NDArray[np.float64] | None, samples: Samples) -> NDArray[np.float64]:
    """Return values that records did not always keep, shape (n,); NaN where there are none."""
    return np.full(len(samples.time), np.nan) if values is None else values


def _sources(samples: Samples) -> NDArray[np.str_]:
    """Say where the force at the hand comes from: the torques, or a gauge; empty without one."""
    known = np.where(np.isfinite(samples.felt).all(axis=1), "estimated", "")
    return np.where(np.isfinite(samples.measured), "measured", known)


def write_csv(path: Path, text: str) -> None:
    """Write a table, whole or not at all, with the byte order mark that spreadsheets look for.

    Raises:
        ExportError: if the file cannot be written.
    """
    with writing(path, ExportError):
        write_atomically(path, b"\xef\xbb\xbf" + text.encode())


def _fixed(row: Summary) -> Sequence[object]:
    score: Mapping[str, Any] = row.score or {}
    return (
        row.id,
        row.started,
        row.student,
        row.exercise_id,
        row.state,
        row.reason,
        row.duration,
        row.scans,
        score.get("total"),
        score.get("passed"),
        score.get("void_reason"),
    )


def _conditions(row: Summary) -> Sequence[object]:
    """Cells of what the score was made under; empty where it is not known."""
    c = row.conditions
    if c is None:
        return [None] * 17
    dial = c.assistance
    return (
        c.version or None,
        c.level or None,
        *((dial.start, dial.least, dial.most, dial.mean) if dial is not None else [None] * 4),
        None if c.views is None else " ".join(c.views),
        c.hand,
        c.scripted,
        c.taken_over,
        c.kind.value,
        c.device,
        c.seed,
        c.software,
        c.calibration,
        c.agreement_mm,
        c.scoring_version or None,
    )


def _bands(conditions: Conditions) -> str:
    """Return `mouse (scripts)`; empty where the exercise's tolerances judged."""
    if not conditions.bands_source:
        return conditions.bands
    return f"{conditions.bands} ({conditions.bands_source})"


def _groups(rows: Sequence[Summary]) -> list[int | None]:
    """Return each row's group; those without a score have none."""
    return comparison_groups(
        [None if (row.score or {}).get("total") is None else row.conditions for row in rows]
    )


def _metrics(row: Summary, key: str = "value") -> dict[str, object]:
    """Metric values by column name, or their standard deviations (`sd`)."""
    rows = (row.score or {}).get("rows", [])
    return {f"{r['name']}_{_unit(str(r['unit']))}": r.get(key) for r in rows}


def _unit(unit: str) -> str:
    if unit in _UNIT_NAMES:
        return _UNIT_NAMES[unit]
    return "".join(c if c.isalnum() else "_" for c in unit.lower()).strip("_")
