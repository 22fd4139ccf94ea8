"""Measurements for spreadsheets and for 3D Slicer.

Slicer's markups: a distance is a Line, an angle an Angle, a value a Fiducial, a region a
ClosedCurve on its rim; each with what was measured. Schema as in `markups`.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from app.core.disclaimer import DISCLAIMER
from app.core.files import write_atomically
from app.exchange.csv_export import write_csv
from app.exchange.errors import ExportError
from app.exchange.markups import SCHEMA
from app.exchange.tables import table_text
from app.imaging.volume import Volume
from app.planning.measurements import KINDS, Angle, Distance, Measurement, Probe, Region
from app.planning.measuring import measured

COLUMNS: Final = (
    "name", "kind", "quantity", "value", "unit", "x_mm", "y_mm", "z_mm", "note",
)  # fmt: skip
"""Columns of the table: one row for each value; x, y, z is the first point, LPS."""

_TYPES: Final = {Distance: "Line", Angle: "Angle", Probe: "Fiducial", Region: "ClosedCurve"}
_RIM: Final = 24


def measurements_table(items: Sequence[Measurement], volume: Volume) -> str:
    """Return a table of all values (RFC 4180), one row each."""
    rows: list[Sequence[object]] = [COLUMNS]
    for number, item in enumerate(items, start=1):
        found = measured(item, volume)
        for quantity in found:
            rows.append((
                title(item, number), KINDS[type(item)], quantity.name, quantity.value,
                quantity.unit, *item.points[-1 if isinstance(item, Region) else 0],
                f"{found.note}; {DISCLAIMER}" if found.note else DISCLAIMER,
            ))  # fmt: skip
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
        raise ExportError("there is no measurement to write: take one first")
    if path.suffix.lower() == ".csv":
        write_csv(path, measurements_table(items, volume))
        return
    if not path.name.lower().endswith(".json"):
        raise ExportError(f"{path.name}: measurements are written as .csv or .mrk.json")
    text = json.dumps(measurements_document(items, volume), indent=1, allow_nan=False,
                      ensure_ascii=False)  # fmt: skip
    try:
        write_atomically(path, text + "\n")
    except OSError as error:
        raise ExportError(f"cannot write {path}: {error.strerror or error}") from error


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
                "id": str(i), "label": f"{title(item, number)}-{i}", "position": list(point),
                "selected": True, "locked": False, "visibility": True, "positionStatus": "defined",
            }
            for i, point in enumerate(points, start=1)
        ],
        "measurements": [
            {"name": q.name, "enabled": True, "value": q.value, "units": q.unit,
             "printFormat": "%-#4.4g%s"}
            for q in found
            if q.value is not None
        ],
        "description": DISCLAIMER,
    }  # fmt: skip
