"""ROS 2 messages as bytes: the definitions of the types that Acus tells, and CDR by them.

A definition is a type's fields, as ROS 2's interfaces have them (common_interfaces, tf2_msgs),
without remarks; it goes into a bag beside the messages. CDR (OMG DDSI-RTPS, "XCDR1"):
little-endian, each number at a multiple of its size, counted from behind the first four bytes.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Any, Final, NamedTuple

import numpy as np

from app.core.messages import sentence
from app.exchange.errors import ExportError

DEFINITIONS: Final[Mapping[str, str]] = {
    "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec\n",
    "builtin_interfaces/msg/Duration": "int32 sec\nuint32 nanosec\n",
    "std_msgs/msg/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "std_msgs/msg/String": "string data\n",
    "std_msgs/msg/Float64": "float64 data\n",
    "std_msgs/msg/ColorRGBA": "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n",
    "std_msgs/msg/MultiArrayDimension": "string label\nuint32 size\nuint32 stride\n",
    "std_msgs/msg/MultiArrayLayout": "std_msgs/MultiArrayDimension[] dim\nuint32 data_offset\n",
    "std_msgs/msg/Float64MultiArray": "std_msgs/MultiArrayLayout layout\nfloat64[] data\n",
    "geometry_msgs/msg/Point": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/msg/Vector3": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/msg/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n",
    "geometry_msgs/msg/Pose": (
        "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"
    ),
    "geometry_msgs/msg/PoseWithCovariance": "geometry_msgs/Pose pose\nfloat64[36] covariance\n",
    "geometry_msgs/msg/PoseWithCovarianceStamped": (
        "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n"
    ),
    "geometry_msgs/msg/Transform": (
        "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"
    ),
    "geometry_msgs/msg/TransformStamped": (
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"
    ),
    "geometry_msgs/msg/Wrench": "geometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n",
    "geometry_msgs/msg/WrenchStamped": "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n",
    "tf2_msgs/msg/TFMessage": "geometry_msgs/TransformStamped[] transforms\n",
    "visualization_msgs/msg/UVCoordinate": "float32 u\nfloat32 v\n",
    "visualization_msgs/msg/MeshFile": "string filename\nuint8[] data\n",
    "sensor_msgs/msg/CompressedImage": "std_msgs/Header header\nstring format\nuint8[] data\n",
    "visualization_msgs/msg/Marker": (
        "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
        "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
        "builtin_interfaces/Duration lifetime\nbool frame_locked\n"
        "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring texture_resource\n"
        "sensor_msgs/CompressedImage texture\n"
        "visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\n"
        "string mesh_resource\nvisualization_msgs/MeshFile mesh_file\n"
        "bool mesh_use_embedded_materials\n"
    ),
    "sensor_msgs/msg/JointState": (
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
        "float64[] effort\n"
    ),
}

_SIZES: Final = {
    "bool": ("?", 1),
    "uint8": ("B", 1),
    "int32": ("i", 4),
    "uint32": ("I", 4),
    "float32": ("f", 4),
    "float64": ("d", 8),
}

_LITTLE_ENDIAN: Final = b"\x00\x01\x00\x00"


class _MessageField(NamedTuple):
    """Type of a field's items, its name, and how many: None for one, 0 for any number."""

    type: str
    name: str
    size: int | None


@lru_cache(None)
def _fields(kind: str) -> tuple[_MessageField, ...]:
    fields = []
    for line in DEFINITIONS[kind].splitlines():
        item, name = line.split()
        base, bracket, size = item.partition("[")
        count = int(size.rstrip("]") or 0) if bracket else None
        if "/" in base and "/msg/" not in base:
            base = base.replace("/", "/msg/")
        fields.append(_MessageField(base, name, count))
    return tuple(fields)


def definition(kind: str) -> str:
    """Return a type's definition with those of all types in it, as a bag has it."""
    needed: dict[str, None] = {}

    def gather(of: str) -> None:
        for field in _fields(of):
            if field.type in DEFINITIONS and field.type not in needed:
                needed[field.type] = None
                gather(field.type)

    gather(kind)
    parts = [DEFINITIONS[kind]]
    parts += [f"MSG: {name.replace('/msg/', '/')}\n{DEFINITIONS[name]}" for name in needed]
    return ("=" * 80 + "\n").join(parts)


def cdr(kind: str, body: Mapping[str, Any]) -> bytes:
    """Return a message as CDR.

    Args:
        kind: its type, one of `DEFINITIONS`.
        body: its fields by name; a field that is left out is an error.
    """
    out = bytearray()
    _write(out, kind, body)
    return _LITTLE_ENDIAN + bytes(out)


def _write(out: bytearray, kind: str, value: Any) -> None:
    if kind == "string":
        data = str(value).encode() + b"\0"
        _write(out, "uint32", len(data))
        out += data
    elif kind in _SIZES:
        code, size = _SIZES[kind]
        out += bytes(-len(out) % size) + struct.pack(f"<{code}", value)
    else:
        for field in _fields(kind):
            _write_field(out, field, value[field.name])


def _write_field(out: bytearray, field: _MessageField, value: Any) -> None:
    if field.size is None:
        _write(out, field.type, value)
        return
    if field.size == 0:
        _write(out, "uint32", len(value))
    elif len(value) != field.size:
        raise ExportError(
            sentence(
                "{name} has {size} items, not {wanted}",
                name=field.name,
                size=len(value),
                wanted=field.size,
            )
        )
    if field.type == "float64":
        if len(value):
            out += bytes(-len(out) % 8) + np.asarray(value, dtype="<f8").tobytes()
        return
    items: Iterable[Any] = value
    for item in items:
        _write(out, field.type, item)
