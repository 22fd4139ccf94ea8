"""Lengths of a needle pantograph from a URDF, or from the text of a xacro with literal numbers.

What is read (names of the laboratory's public description):

| value | from |
|---|---|
| base | `panto_a5` less `panto_a1`, x of the origins |
| proximal | `panto_a2` and `panto_a4`, x: both arms must agree |
| distal | `panto_a3`, x, and `panto_right_link2_to_end` where the file has it |
| fulcrum | `panto_base_to_fulcrum`, x from midway between the motors |
| needle length | the cylinder of the link `tool_phi_link` |

The file may come from anywhere: a document type declaration (and with it every entity) is refused.
"""

import xml.etree.ElementTree as ET
from math import isfinite
from pathlib import Path
from typing import Any

from app.core.configuration import parse
from app.exchange.errors import UrdfError
from app.mechanisms.profile import DeviceProfile, GeometrySection, Provenance

_LARGEST = 5_000_000
"""Size above which a file is no robot description [bytes]."""

_SAME = 1e-6
"""Difference of the two arms that is taken for rounding [m]."""

_DIGITS = 12
"""Decimals that are kept of a difference of two lengths [m]."""


def read_geometry(path: Path) -> GeometrySection:
    """Read the lengths; each is marked as imported: the file does not say where it has them.

    Raises:
        UrdfError: if the file cannot be read, is no XML, has a document type, lacks a joint, has
            an expression instead of a number, or its arms differ.
        ConfigurationError: if the lengths make no needle pantograph.
    """
    root = _root(path)
    joints = _Joints(path, root)
    left, right = joints.origin("panto_a1"), joints.origin("panto_a5")
    middle = 0.5 * (left[0] + right[0])
    if left[1:] != (0.0, 0.0) or right[1:] != (0.0, 0.0):
        raise UrdfError(f"{path}: panto_a1 {left} and panto_a5 {right} must lie on the x axis")
    proximal = _equal(path, joints, "panto_a2", "panto_a4")
    distal = joints.length("panto_a3")
    if joints.has("panto_right_link2_to_end"):
        distal = _equal(path, joints, "panto_a3", "panto_right_link2_to_end")
    x, y, z = joints.origin("panto_base_to_fulcrum")
    values: dict[str, Any] = {
        "proximal": proximal,
        "distal": distal,
        "base": round(right[0] - left[0], _DIGITS),
        "fulcrum": (round(x - middle, _DIGITS), y, z),
        "needle_length": _needle_length(path, root),
    }
    provenance = dict.fromkeys(values, Provenance.IMPORTED)
    return parse(values | {"provenance": provenance}, GeometrySection, str(path))


def profile_like(model: DeviceProfile, geometry: GeometrySection, name: str) -> dict[str, Any]:
    """Return a profile document (for YAML) with the geometry read and all else from `model`.

    What was measured or published of the model is an estimate of another robot, and marked so.

    Raises:
        ConfigurationError: if the two do not fit together.
    """
    document = model.model_dump(mode="json", exclude_none=True)
    document["name"] = name
    document["description"] = f"lengths from a URDF, all else from {model.name}"
    for section in document.values():
        if isinstance(section, dict):
            section["provenance"] = dict.fromkeys(section["provenance"], "estimated")
    document["geometry"] = geometry.model_dump(mode="json")
    parse(document, DeviceProfile, f"profile {name}")
    return document


class _NoDoctype(ET.TreeBuilder):
    """Builder that ends at a document type declaration: entities could be anything, and huge."""

    def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
        raise UrdfError("has a document type declaration (DOCTYPE), which a URDF never needs")


class _Joints:
    """Origins of the joints of a file, by name."""

    def __init__(self, path: Path, root: ET.Element) -> None:
        self.path = path
        self.found: dict[str, ET.Element] = {}
        for joint in root.iter("joint"):
            name = joint.get("name", "")
            if name in self.found and joint.find("origin") is not None:
                raise UrdfError(f"{path}: joint {name!r} is there twice")
            if joint.find("parent") is not None:  # not those of ros2_control
                self.found[name] = joint

    def has(self, name: str) -> bool:
        return name in self.found

    def origin(self, name: str) -> tuple[float, float, float]:
        if name not in self.found:
            there = ", ".join(sorted(self.found)) or "no joints"
            raise UrdfError(f"{self.path}: joint {name!r} is missing; there are: {there}")
        origin = self.found[name].find("origin")
        if origin is None:
            return 0.0, 0.0, 0.0  # URDF's own default
        what = f"{self.path}: joint {name!r}, origin"
        if any(_numbers(origin.get("rpy", "0 0 0"), what)):
            turned = origin.get("rpy")
            raise UrdfError(f"{what}: rpy is {turned!r}; turned joints are not supported")
        return _numbers(origin.get("xyz", "0 0 0"), what)

    def length(self, name: str) -> float:
        x, y, z = self.origin(name)
        if (y, z) != (0.0, 0.0) or not x > 0.0:
            raise UrdfError(
                f"{self.path}: joint {name!r} stands at ({x}, {y}, {z}) m; a link of the arms goes"
                " along +x"
            )
        return x


def _equal(path: Path, joints: _Joints, left: str, right: str) -> float:
    one, other = joints.length(left), joints.length(right)
    if abs(one - other) > _SAME:
        raise UrdfError(
            f"{path}: the arms differ: {left} at {one} m, {right} at {other} m; Acus' pantograph is"
            " symmetric"
        )
    return one


def _needle_length(path: Path, root: ET.Element) -> float:
    for link in root.iter("link"):
        if link.get("name") == "tool_phi_link":
            for cylinder in link.iter("cylinder"):
                text = cylinder.get("length", "")
                return _number(text, f"{path}: link 'tool_phi_link', cylinder length")
            raise UrdfError(f"{path}: link 'tool_phi_link' has no cylinder, which is the needle")
    raise UrdfError(f"{path}: link 'tool_phi_link' is missing; the needle is its cylinder")


def _numbers(text: str, what: str) -> tuple[float, float, float]:
    parts = text.split()
    if len(parts) != 3:
        raise UrdfError(f"{what}: {text!r} is not three numbers")
    x, y, z = (_number(part, what) for part in parts)
    return x, y, z


def _number(text: str, what: str) -> float:
    if "$" in text:
        raise UrdfError(
            f"{what}: {text!r} is a xacro expression; expand the file first (xacro FILE > out.urdf)"
        )
    try:
        value = float(text)
    except ValueError:
        raise UrdfError(f"{what}: {text!r} is not a number") from None
    if not isfinite(value):
        raise UrdfError(f"{what}: {text!r} is not finite")
    return value


def _root(path: Path) -> ET.Element:
    try:
        content = path.read_bytes()
    except OSError as error:
        raise UrdfError(f"cannot read {path}: {error.strerror or error}") from error
    if len(content) > _LARGEST:
        raise UrdfError(f"{path} has {len(content)} bytes; a URDF has at most {_LARGEST}")
    parser = ET.XMLParser(target=_NoDoctype())
    try:
        parser.feed(content)
        root: ET.Element = parser.close()
    except UrdfError as error:
        raise UrdfError(f"{path} {error}") from None
    except (ET.ParseError, ValueError, LookupError) as error:
        raise UrdfError(f"{path} is not XML: {error}") from error
    return root
