"""Plans as 3D Slicer markups (`.mrk.json`): one Line, entry then target, LPS millimetres.

With the order [entry, target] Slicer's VolumeResliceDriver puts the probe's-eye slice on the
target.
Schema: Slicer, Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.3.json.
"""

import json
import re
from pathlib import Path
from sys import float_info
from typing import Any, Final, NoReturn

import numpy as np

from app.core.arrays import FloatArray
from app.core.disclaimer import DISCLAIMER
from app.core.errors import writing
from app.core.files import read_at_most, write_atomically
from app.core.messages import sentence
from app.core.words import printable
from app.exchange.errors import ExportError, MarkupsError
from app.planning.errors import PlanError
from app.planning.plan import Plan

SCHEMA: Final = (
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/"
    "Resources/Schema/markups-schema-v1.0.3.json#"
)
"""What Slicer writes; its reader takes every 1.x.y."""

ENTRY: Final = "Entry"
TARGET: Final = "Target"

_READABLE: Final = re.compile(r".*markups-schema-v1\.[0-9]+\.[0-9]+\.json#*")
_TYPES: Final = ("Line", "Fiducial")
_UNITS_MM: Final = {"mm": 1.0, "um": 1e-3}
_TO_LPS: Final = {"LPS": np.ones(3), "RAS": np.array([-1.0, -1.0, 1.0])}


def plan_document(plan: Plan) -> dict[str, Any]:
    """Return the plan as a markups document."""
    return {
        "@schema": SCHEMA,
        "markups": [
            {
                "type": "Line",
                "name": plan.name,
                "coordinateSystem": "LPS",
                "coordinateUnits": "mm",
                "locked": True,
                "labelFormat": "%N-%d",
                "controlPoints": [
                    _control_point("1", ENTRY, plan.entry_mm),
                    _control_point("2", TARGET, plan.target_mm),
                ],
                "measurements": [
                    {
                        "name": "length",
                        "enabled": True,
                        "value": plan.length_mm,
                        "units": "mm",
                        "printFormat": "%-#4.4gmm",
                    }
                ],
                "description": DISCLAIMER,
            }
        ],
    }


def write_plan(path: Path, plan: Plan) -> None:
    """Write a plan, whole or not at all.

    Raises:
        ExportError: if the file cannot be written.
    """
    text = json.dumps(plan_document(plan), indent=1, allow_nan=False, ensure_ascii=False)
    with writing(path, ExportError):
        write_atomically(path, printable(text) + "\n")


def read_plan(path: Path) -> Plan:
    """Read a plan from the first Line (else list of points) of a markups file.

    Points named Entry and Target are taken by their names, in whatever order they stand; without
    such names the first is the entry and the second the target. RAS is converted.

    Raises:
        MarkupsError: naming file, field and value, and what would be valid.
    """
    try:
        document = json.loads(read_at_most(path), parse_constant=float)
    except OSError as error:
        raise MarkupsError(
            sentence(
                "cannot read {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    except (ValueError, RecursionError) as error:
        raise MarkupsError(
            sentence(
                "{path} is not JSON: {error_split}",
                path=path,
                error_split=" ".join(str(error).split()),
            )
        ) from error
    return parse_plan(document, str(path))


def parse_plan(document: Any, origin: str) -> Plan:
    """Read a plan from a markups document in memory; `origin` names it in messages."""
    markup, where = _choose(document, origin)
    scale = _scale(markup, origin, where)
    points = markup.get("controlPoints")
    if not isinstance(points, list) or len(points) < 2:
        found = len(points) if isinstance(points, list) else points
        _refuse(origin, f"{where}.controlPoints", found, "two points, Entry and Target")
    entry, target = _pair(points, origin, where)
    name = markup.get("name")
    try:
        return Plan(
            scale * _position(points[entry], origin, f"{where}.controlPoints[{entry}]"),
            scale * _position(points[target], origin, f"{where}.controlPoints[{target}]"),
            name if isinstance(name, str) and name else "Plan",
        )
    except PlanError as error:
        raise MarkupsError(sentence("{origin}: {error}", origin=origin, error=error)) from error


def _control_point(identifier: str, label: str, position: FloatArray) -> dict[str, Any]:
    """Return a control point; older Slicers take a missing `positionStatus` as undefined."""
    return {
        "id": identifier,
        "label": label,
        "position": position.tolist(),
        "selected": True,
        "locked": False,
        "visibility": True,
        "positionStatus": "defined",
    }


def _choose(document: Any, origin: str) -> tuple[dict[str, Any], str]:
    """First Line of the document, else its first list of points, and its place in messages."""
    if not isinstance(document, dict):
        _refuse(origin, "(document)", document, "a JSON object")
    schema = document.get("@schema")
    if not isinstance(schema, str) or not _READABLE.fullmatch(schema):
        _refuse(origin, "@schema", schema, "a Slicer markups schema, version 1.x.y")
    markups = document.get("markups")
    if not isinstance(markups, list) or not markups:
        _refuse(origin, "markups", markups, "a list with one Line")
    for kind in _TYPES:
        for i, markup in enumerate(markups):
            if isinstance(markup, dict) and markup.get("type") == kind:
                return markup, f"markups[{i}]"
    kinds = [markup.get("type") if isinstance(markup, dict) else markup for markup in markups]
    _refuse(origin, "markups[].type", kinds, " or ".join(_TYPES))


def _scale(markup: dict[str, Any], origin: str, where: str) -> FloatArray:
    """Factors from the file's coordinates to LPS millimetres, shape (3,)."""
    system = markup.get("coordinateSystem", "LPS")
    if not isinstance(system, str) or system not in _TO_LPS:
        _refuse(origin, f"{where}.coordinateSystem", system, "LPS or RAS")
    units = markup.get("coordinateUnits", "mm")
    code = units[0] if isinstance(units, list) and units else units
    if not isinstance(code, str) or code not in _UNITS_MM:
        _refuse(origin, f"{where}.coordinateUnits", units, "mm or um")
    result: FloatArray = _TO_LPS[system] * _UNITS_MM[code]
    return result


def _pair(points: list[Any], origin: str, where: str) -> tuple[int, int]:
    """Return the indices of entry and target."""
    named = [p.get("label") if isinstance(p, dict) else None for p in points]
    labels = [str(label or "").strip().lower() for label in named]
    found = [[i for i, label in enumerate(labels) if label == name] for name in ("entry", "target")]
    if all(len(indices) == 1 for indices in found):
        return found[0][0], found[1][0]
    if any(len(indices) > 1 for indices in found):
        _refuse(origin, f"{where}.controlPoints[].label", labels, "one Entry and one Target")
    # One label alone still decides which of two points is which.
    if len(points) == 2 and (found[0] == [1] or found[1] == [0]):
        return 1, 0
    return 0, 1


def _position(point: Any, origin: str, where: str) -> FloatArray:
    """Return the coordinates of a control point, shape (3,)."""
    if not isinstance(point, dict):
        _refuse(origin, where, point, "an object with a position")
    status = point.get("positionStatus", "defined")
    if status != "defined":
        _refuse(origin, f"{where}.positionStatus", status, "defined: place the point in Slicer")
    values = point.get("position")
    if isinstance(values, list) and len(values) == 3 and all(map(_is_number, values)):
        return np.array(values, dtype=np.float64)
    _refuse(origin, f"{where}.position", values, "three finite numbers")


def _is_number(value: object) -> bool:
    """Return whether a JSON value is a finite number (a Python int may be too large for a
    double).
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return abs(value) <= float_info.max


def _refuse(origin: str, name: str, value: object, wanted: str) -> NoReturn:
    text = repr(value)
    short = text if len(text) <= 60 else text[:57] + "..."
    raise MarkupsError(
        sentence(
            "{origin}: {name} is {short}; needed: {wanted}",
            origin=origin,
            name=name,
            short=short,
            wanted=wanted,
        )
    )
