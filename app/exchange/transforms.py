"""Rigid transforms as ITK transform files (`.tfm`), in which 3D Slicer saves linear transforms.

The file is text, in LPS millimetres. It stores the *inverse* of what Slicer shows as "to parent":
ITK's transforms resample, they carry a point of the parent back. A point goes to

    R (p - c) + t + c,

with R and t from `Parameters` and the centre c from `FixedParameters` (ITK Software Guide, Book 2,
3.9; itkMatrixOffsetTransformBase). Slicer: Libs/MRML/Core/vtkMRMLTransformStorageNode.
"""

from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

import numpy as np

from app.core.arrays import FloatArray
from app.core.errors import NumericalError
from app.core.files import read_at_most
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.exchange.errors import TransformError
from app.exchange.text_export import write_text

_HEADER = "#Insight Transform File V1.0"
_LONGEST = 65536
_TOLERANCE = 1e-5
Parsed = tuple[FloatArray, FloatArray]


def tfm_text(T_to_from: RigidTransform) -> str:
    """Return the text of a `.tfm` that Slicer loads as the transform from `from` to `to`."""
    inverse = T_to_from.inverse()
    numbers = [*inverse.rotation.ravel().tolist(), *(inverse.translation / MILLIMETRE).tolist()]
    return (
        f"{_HEADER}\n#Transform 0\nTransform: AffineTransform_double_3_3\n"
        f"Parameters: {' '.join(repr(number + 0.0) for number in numbers)}\n"
        "FixedParameters: 0 0 0\n"
    )


def write_tfm(path: Path, T_to_from: RigidTransform) -> None:
    """Write a transform, whole or not at all.

    Args:
        path: the file, ending in `.tfm`.
        T_to_from: from the frame that hangs under the transform in Slicer to its parent (LPS) [m].

    Raises:
        ExportError: if the file cannot be written.
    """
    write_text(path, tfm_text(T_to_from))


def read_tfm(path: Path) -> RigidTransform:
    """Read a rigid transform as Slicer shows it, to its parent.

    Read are affine, Euler, versor and translation transforms, in any of their precisions and with
    any centre. Scale, shear and reflection are refused, a chain of several transforms too.

    Returns:
        T_to_from [m].

    Raises:
        TransformError: naming the file and what is wrong.
    """
    try:
        text = read_at_most(path).decode("utf-8")[: _LONGEST + 1]
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or "it is not text"
        raise TransformError(
            sentence("cannot read {path}: {reason}", path=path, reason=why)
        ) from error
    return parse_tfm(text, str(path))


def parse_tfm(text: str, origin: str) -> RigidTransform:
    """Read the text of a `.tfm`; `origin` names it in messages."""
    fields = _fields(text, origin)
    kind = fields["Transform"].split("_")[0]
    read = _KINDS.get(kind)
    if read is None or not fields["Transform"].endswith(("_3_3", kind)):
        valid = ", ".join(_KINDS)
        _refuse(origin, f"its transform is {fields['Transform'][:60]}; read are {valid}, in 3D")
    parameters = _numbers(fields, "Parameters", origin)
    fixed = _numbers(fields, "FixedParameters", origin)
    matrix, shift = read(parameters, fixed, origin)
    centre = fixed[:3] if fixed.size >= 3 else np.zeros(3)
    offset = shift + centre - matrix @ centre
    return _rigid(matrix, offset, origin).inverse()


def _fields(text: str, origin: str) -> dict[str, str]:
    if len(text) > _LONGEST or not text.lstrip("\ufeff").startswith("#Insight Transform File"):
        _refuse(origin, f"it does not begin with {_HEADER!r}, as ITK's transform files do")
    fields: dict[str, str] = {}
    for line in text.splitlines():
        name, separator, value = line.partition(":")
        if line.startswith("#") or not separator:
            continue
        if name.strip() in fields:
            _refuse(origin, "it holds several transforms; harden the chain into one in Slicer")
        fields[name.strip()] = value.strip()
    for name in ("Transform", "Parameters"):
        if name not in fields:
            _refuse(origin, f"it has no line {name!r}")
    return fields


def _numbers(fields: dict[str, str], name: str, origin: str) -> FloatArray:
    try:
        values = np.array([float(word) for word in fields.get(name, "").split()])
    except ValueError:
        _refuse(origin, f"{name} are not numbers")
    if not np.isfinite(values).all():
        _refuse(origin, f"{name} are not finite")
    return values


def _count(parameters: FloatArray, wanted: int, origin: str) -> None:
    if parameters.size != wanted:
        _refuse(origin, f"it has {parameters.size} parameters; {wanted} are needed")


def _affine(parameters: FloatArray, fixed: FloatArray, origin: str) -> Parsed:
    _count(parameters, 12, origin)
    return parameters[:9].reshape(3, 3), parameters[9:]


def _euler(parameters: FloatArray, fixed: FloatArray, origin: str) -> Parsed:
    """Turn about fixed axes: y first, then x, then z; with ComputeZYX x, then y, then z."""
    _count(parameters, 6, origin)
    x, y, z = (_turn(axis, float(angle)) for axis, angle in enumerate(parameters[:3]))
    zyx = fixed.size > 3 and fixed[3] != 0.0
    return (z @ y @ x if zyx else z @ x @ y), parameters[3:]


def _turn(axis: int, angle: float) -> FloatArray:
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = c
    matrix[j, i], matrix[i, j] = s, -s
    return matrix


def _versor(parameters: FloatArray, fixed: FloatArray, origin: str) -> Parsed:
    """Vector part of a unit quaternion; its scalar part is the positive root."""
    _count(parameters, 6, origin)
    vector = parameters[:3]
    square = float(vector @ vector)
    if square > 1.0 + _TOLERANCE:
        _refuse(origin, f"its versor has length {square**0.5:g}; at most 1 is possible")
    w = max(0.0, 1.0 - square) ** 0.5
    x, y, z = vector
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + 2.0 * (w * cross + cross @ cross), parameters[3:]


def _translation(parameters: FloatArray, fixed: FloatArray, origin: str) -> Parsed:
    _count(parameters, 3, origin)
    return np.eye(3), parameters


def _identity(parameters: FloatArray, fixed: FloatArray, origin: str) -> Parsed:
    return np.eye(3), np.zeros(3)


_KINDS: dict[str, Callable[[FloatArray, FloatArray, str], Parsed]] = {
    "AffineTransform": _affine,
    "MatrixOffsetTransformBase": _affine,
    "Rigid3DTransform": _affine,
    "Euler3DTransform": _euler,
    "VersorRigid3DTransform": _versor,
    "TranslationTransform": _translation,
    "IdentityTransform": _identity,
}


def _rigid(matrix: FloatArray, offset_mm: FloatArray, origin: str) -> RigidTransform:
    """Check and clean the rotation: files round it, RigidTransform wants it to 1e-6."""
    u, stretch, v = np.linalg.svd(matrix)
    if np.abs(stretch - 1.0).max() > _TOLERANCE:
        _refuse(
            origin,
            f"it stretches by {stretch.min():.6g} to {stretch.max():.6g} (scale or shear); only "
            "rotations and shifts can be used",
        )
    try:
        return RigidTransform(u @ v, offset_mm * MILLIMETRE)
    except NumericalError:
        _refuse(origin, "it mirrors; only rotations and shifts can be used")


def _refuse(origin: str, reason: str) -> NoReturn:
    raise TransformError(sentence("{origin}: {reason}", origin=origin, reason=reason))
