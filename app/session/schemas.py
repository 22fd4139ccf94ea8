"""Channels of a record and their JSON schemas.

The `foxglove.*` schemas are the published ones of github.com/foxglove/foxglove-sdk
(schemas/jsonschema), without their prose; the `acus.*` ones are our own. Metres, radians, newtons.
"""

from dataclasses import dataclass
from math import isfinite
from typing import Any, Final

Schema = dict[str, Any]


def _object(title: str, properties: Schema, optional: tuple[str, ...] = ()) -> Schema:
    required = [name for name in properties if name not in optional]
    return {"title": title, "type": "object", "properties": properties, "required": required}


def _array(items: Schema) -> Schema:
    return {"type": "array", "items": items}


_NUMBER: Final[Schema] = {"type": "number"}
_NUMBER_OR_NULL: Final[Schema] = {"type": ["number", "null"]}
_TEXT: Final[Schema] = {"type": "string"}
_FLAG: Final[Schema] = {"type": "boolean"}
_COUNT: Final[Schema] = {"type": "integer", "minimum": 0}
_TIME: Final = _object(
    "time",
    {
        "sec": {"type": "integer", "minimum": 0},
        "nsec": {"type": "integer", "minimum": 0, "maximum": 999999999},
    },
)
_VECTOR: Final = _object("foxglove.Vector3", dict.fromkeys("xyz", _NUMBER))
_VECTOR_OR_NULL: Final[Schema] = _VECTOR | {
    "type": ["object", "null"],
    "properties": dict.fromkeys("xyz", _NUMBER_OR_NULL),
}
_QUATERNION: Final = _object("foxglove.Quaternion", dict.fromkeys("xyzw", _NUMBER))
_POSE: Final = _object("foxglove.Pose", {"position": _VECTOR, "orientation": _QUATERNION})

FRAME_TRANSFORM: Final = _object(
    "foxglove.FrameTransform",
    {
        "timestamp": _TIME,
        "parent_frame_id": _TEXT,
        "child_frame_id": _TEXT,
        "translation": _VECTOR,
        "rotation": _QUATERNION,
    },
)
POSE_IN_FRAME: Final = _object(
    "foxglove.PoseInFrame", {"timestamp": _TIME, "frame_id": _TEXT, "pose": _POSE}
)
_JOINT: Final = _object(
    "foxglove.JointState",
    {"name": _TEXT, "position": _NUMBER, "velocity": _NUMBER, "effort": _NUMBER},
    optional=("position", "velocity", "effort"),
)
JOINT_STATES: Final = _object(
    "foxglove.JointStates", {"timestamp": _TIME, "joints": _array(_JOINT)}
)
LOG: Final = _object(
    "foxglove.Log",
    {
        "timestamp": _TIME,
        "level": {"oneOf": [{"const": value} for value in range(6)]},
        "message": _TEXT,
        "name": _TEXT,
        "file": _TEXT,
        "line": _COUNT,
        "kind": _TEXT,
        "data": {"type": "object"},
    },
    optional=("kind", "data"),
)
ATTEMPT: Final = _object(
    "acus.Attempt",
    {
        "timestamp": _TIME,
        "time": _NUMBER,
        "state": _TEXT,
        "valid": _FLAG,
        "depth_source": _TEXT,
        "depth": _NUMBER_OR_NULL,
        "tip": _VECTOR_OR_NULL,
        "axis": _VECTOR_OR_NULL,
        "hub": _VECTOR_OR_NULL,
        "target": _VECTOR_OR_NULL,
        "bend": _array(_NUMBER),
    },
    optional=("bend",),
)
WRENCH: Final = _object(
    "acus.Wrench",
    {
        "timestamp": _TIME,
        "wanted": _VECTOR_OR_NULL,
        "guide": _VECTOR_OR_NULL,
        "felt": _VECTOR_OR_NULL,
        "felt_least": _NUMBER_OR_NULL,
        "felt_most": _NUMBER_OR_NULL,
        "felt_source": _TEXT,
        "measured": _NUMBER_OR_NULL,
        "along": _NUMBER_OR_NULL,
        "clamped": _FLAG,
        "enabled": _FLAG,
        "assistance": _NUMBER_OR_NULL,
        "fault": _COUNT,
    },
    optional=("felt_source", "measured", "felt_least", "felt_most", "along"),
)
QUALITY: Final = _object(
    "acus.TrackingQuality",
    {
        "timestamp": _TIME,
        "status": _TEXT,
        "residual_px": _NUMBER_OR_NULL,
        "orientation_age": _NUMBER_OR_NULL,
        "depth_age": _NUMBER_OR_NULL,
        "sigma_along": _NUMBER_OR_NULL,
        "radius_95": _NUMBER_OR_NULL,
        "deflection": _NUMBER_OR_NULL,
        "spread": _array(_NUMBER),
    },
    optional=("radius_95", "deflection", "spread"),
)
_TEXT_OR_NULL: Final[Schema] = {"type": ["string", "null"]}
SCORE: Final = _object(
    "acus.Score",
    {
        "total": _NUMBER_OR_NULL,
        "passed": _FLAG,
        "void_reason": _TEXT,
        "scoring_version": {"type": "integer"},
        "rows": _array(
            _object(
                "acus.ScoreRow",
                {
                    "name": _TEXT,
                    "label": _TEXT,
                    "unit": _TEXT,
                    "value": _NUMBER_OR_NULL,
                    "note": _TEXT,
                    "band": _TEXT_OR_NULL,
                },
            )
        ),
    },
    optional=("passed", "void_reason", "scoring_version", "rows"),
)
"""Of a stored score, what lists and tables need; `scoring.result.Score` knows the whole."""


@dataclass(frozen=True, slots=True)
class RecordChannel:
    """A channel: its topic, and its schema or, of a binary one, the name of its layout."""

    topic: str
    schema: Schema | None
    layout: str = ""


CHANNELS: Final = {
    channel.topic: channel
    for channel in (
        RecordChannel("/tf", FRAME_TRANSFORM),
        RecordChannel("/needle/tip", POSE_IN_FRAME),
        RecordChannel("/haptic/joints", JOINT_STATES),
        RecordChannel("/haptic/wrench", WRENCH),
        RecordChannel("/tracking/quality", QUALITY),
        RecordChannel("/attempt", ATTEMPT),
        RecordChannel("/events", LOG),
        RecordChannel("/loop/inputs", None, "acus-block"),
        RecordChannel("/loop/checkpoint", None, "acus-checkpoint"),
    )
}
"""Every channel of a record by topic."""

_NAMES: Final[dict[type, tuple[str, ...]]] = {
    type(None): ("null",),
    bool: ("boolean",),
    int: ("integer", "number"),
    float: ("number",),
    str: ("string",),
    dict: ("object",),
    list: ("array",),
}
"""What a schema may call the types that JSON is read to."""

_NO_SCHEMA: Final[Schema] = {}
_LARGEST: Final = 1e18
"""No number of a record is larger, in whatever unit."""


def conforms(value: Any, schema: Schema) -> bool:
    """Return whether a JSON value has the types and the fields that one of our schemas asks for."""
    names = schema.get("type")
    if names and not _is(value, names):
        return False
    if isinstance(value, dict):
        for name in schema.get("required", ()):
            if name not in value:
                return False
        for name, part in schema.get("properties", _NO_SCHEMA).items():
            if name in value and not conforms(value[name], part):
                return False
    elif isinstance(value, list):
        items = schema.get("items", _NO_SCHEMA)
        for item in value:
            if not conforms(item, items):
                return False
    return True


def _is(value: Any, names: str | list[str]) -> bool:
    """Return whether a value is of one of the types, numbers within bounds."""
    own = _NAMES.get(type(value), ())
    if not any(name in own for name in names) if isinstance(names, list) else names not in own:
        return False
    return not isinstance(value, int | float) or (abs(value) < _LARGEST and isfinite(value))
