"""The tensegrity needle holder as MJCF, for MuJoCo: loops and cables, which URDF cannot say.

Every joint axis runs through the remote centre O, so every body stands there, turned as the machine
with its guide upright, and all joints are zero in that pose. Each pantograph is two chains of
curved bars from its base joint A; they end on the guide by `connect` constraints (and cross in C
with two rhombi). Joints are called by the point that they turn about and the bar they move
(`A1_B1`), bars by their joints (`B1_T1`), sites by their point, tendons as Acus' cables.

| in the file | is |
|---|---|
| `guide_x`, `guide_y` | turns of the guide about x0, then about its own y |
| `needle_depth` | the needle in the guide, tip beyond O [m] |
| tendon, `B1D1` … `C2A2` | a cable; actuator of the same name: its tension [N], within the limits |
| `armature`, `frictionloss`, `damping` of a tendon | what its winch weighs and rubs |

With one rhombus nothing stands in C, the middle of the arc A T, to which the paper leads its second
cable: a pair of nearly weightless turns (`arc1`) carries the site. Cables do not stretch here.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from itertools import pairwise
from math import acos, cos, radians, sin
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, cross, unit
from app.mechanisms.tensegrity import machine_points
from app.mechanisms.tensegrity.profile import TensegrityProfile
from app.simulation.mjcf import line, text

_UPRIGHT: Final = (0.0, 0.0, 1.0)
_PIECES: Final = 8
"""Straight capsules that a curved bar is drawn by."""
_HALF_WIDTH: Final = 0.006
_NOTHING: Final = 1e-9
"""Mass [kg] and inertia [kg·m²] of what has none in our mechanics; simulators refuse zero."""
_CARRIAGE: Final = 2e-6
"""Inertia of what carries C where no bar does [kg·m²]: 0.2 % of the machine's, for with less a
simulator's soft constraints give way under the cable."""
_BAR, _METAL, _NEEDLE, _CABLE = (
    "0.75 0.75 0.78 1",
    "0.45 0.5 0.6 1",
    "0.85 0.85 0.9 1",
    "0.9 0.6 0 1",
)

Points = dict[str, FloatArray]


def write(profile: TensegrityProfile) -> str:
    """Return a profile as MJCF text, the needle's tip at the remote centre.

    Raises:
        MechanismError: if the machine cannot hold its guide upright.
    """
    geometry, section = profile.geometry.bars, profile.geometry
    shown = machine_points(geometry, _UPRIGHT)
    points = {name: np.asarray(place) for name, place in shown.points.items()}
    root = ET.Element("mujoco", model=profile.name)
    ET.SubElement(root, "compiler", angle="radian", autolimits="true", inertiafromgeom="false")
    option = ET.SubElement(
        root,
        "option",
        timestep="0.0005",
        gravity=text(*profile.mounting.gravity),
        integrator="implicitfast",
        tolerance="1e-12",
    )
    ET.SubElement(option, "flag", contact="disable", refsafe="disable")
    half = 0.5 * radians(section.heading_deg)
    base = ET.SubElement(
        ET.SubElement(root, "worldbody"),
        "body",
        name="base",
        pos=text(*section.fulcrum),
        quat=text(cos(half), 0.0, 0.0, sin(half)),
    )
    _site(base, "O", np.zeros(3))
    equality = ET.Element("equality")
    guide = _guide(base, profile)
    for number, radius in zip("12", geometry.radii, strict=True):
        _site(base, f"A{number}", points[f"A{number}"])
        _site(guide, f"T{number}", points[f"T{number}"])
        pantograph = _Pantograph(profile, points, number, radius, equality)
        pantograph.add(base, geometry.rhombi)
    root.append(equality)
    _cables(root, profile, shown.cables)
    ET.indent(root)
    return f"{ET.tostring(root, encoding='unicode', xml_declaration=True)}\n"


class _Pantograph:
    """One of the two, about its own base joint."""

    def __init__(
        self,
        profile: TensegrityProfile,
        points: Points,
        number: str,
        radius: float,
        equality: ET.Element,
    ) -> None:
        self._density, self._friction = profile.inertia.bar_density, profile.friction
        self._points, self._number, self._radius = points, number, radius
        self._equality = equality

    def add(self, base: ET.Element, rhombi: int) -> None:
        """Add both chains, closed on the guide, and what carries C."""
        if rhombi == 1:
            for elbow in "BD":
                near = self._bar(base, "A", elbow)
                far = self._bar(near, elbow, "T")
                self._close(far, f"T_by_{elbow}", "T")
            self._arc(base)
            return
        ends = []
        for elbow, beyond in ("BF", "DE"):
            near = self._bar(base, "A", elbow)
            long = self._bar(near, elbow, "C", beyond)
            ends.append(f"{self._name('C')}_by_{elbow}")
            _site(long, ends[-1], self._points[self._name("C")])
            far = self._bar(long, beyond, "T")
            self._close(far, f"T_by_{beyond}", "T")
        _site(long, self._name("C"), self._points[self._name("C")])
        ET.SubElement(self._equality, "connect", _STIFF, site1=ends[0], site2=ends[1])

    def _name(self, point: str) -> str:
        return point + self._number

    def _close(self, body: ET.Element, name: str, point: str) -> None:
        site = f"{name[:1]}{self._number}{name[1:]}"
        _site(body, site, self._points[self._name(point)])
        ET.SubElement(self._equality, "connect", _STIFF, site1=site, site2=self._name(point))

    def _bar(self, parent: ET.Element, *stops: str) -> ET.Element:
        """Add a bar that turns about its first joint; one that crosses in C goes on beyond it."""
        names = [self._name(stop) for stop in stops]
        body = ET.SubElement(parent, "body", name=f"{names[0]}_{names[-1]}")
        axis = unit(self._points[names[0]])
        ET.SubElement(body, "joint", name=f"{names[0]}_{names[1]}", axis=text(*axis))
        parts = [
            _arc_inertia(self._points[near], self._points[far], self._radius, self._density)
            for near, far in pairwise(names)
        ]
        _inertial(body, *_together(parts))
        for near, far in pairwise(names):
            _curve(body, self._points[near], self._points[far])
        if len(stops) == 2 and stops[1] != "T":
            _site(body, names[1], self._points[names[1]])
        elif len(stops) == 3:
            _site(body, names[2], self._points[names[2]])
        return body

    def _arc(self, base: ET.Element) -> None:
        """Add C in the middle of the arc A T: turn about A, then twice by the same angle."""
        a, t = self._name("A"), self._name("T")
        name = f"arc{self._number}"
        aside = unit(cross(self._points[a], self._points[t]))
        about = ET.SubElement(base, "body", name=name)
        ET.SubElement(about, "joint", name=name, axis=text(*unit(self._points[a])))
        _inertial(about, _NOTHING, np.zeros(3), _CARRIAGE * np.eye(3))
        body = about
        for part in ("near", "far"):
            body = ET.SubElement(body, "body", name=f"{name}_{part}")
            ET.SubElement(body, "joint", name=f"{name}_{part}", axis=text(*aside))
            _inertial(body, _NOTHING, np.zeros(3), _CARRIAGE * np.eye(3))
            if part == "near":
                _site(body, self._name("C"), self._points[self._name("C")])
        joints = {"joint1": f"{name}_far", "joint2": f"{name}_near"}
        ET.SubElement(self._equality, "joint", _STIFF, polycoef="0 1 0 0 0", **joints)
        self._close(body, "T_by_arc", "T")


_STIFF: Final = {"solref": "0.001 1", "solimp": "0.9999 0.9999 0.001"}
"""Of the constraints that close the loops."""


def _guide(base: ET.Element, profile: TensegrityProfile) -> ET.Element:
    part, up = profile.inertia, np.array(_UPRIGHT)
    cross_piece = ET.SubElement(base, "body", name="guide_cross")
    ET.SubElement(cross_piece, "joint", name="guide_x", axis="1 0 0")
    _inertial(cross_piece, _NOTHING, np.zeros(3), _NOTHING * np.eye(3))
    guide = ET.SubElement(cross_piece, "body", name="guide")
    ET.SubElement(guide, "joint", name="guide_y", axis="0 1 0")
    across = max(part.guide_inertia, _NOTHING)
    inertia = np.diag([across, across, _NOTHING])
    _inertial(guide, max(part.guide_mass, _NOTHING), part.guide_centre * up, inertia)
    near = min(profile.geometry.first_radius, profile.geometry.second_radius)
    line(guide, 0.8 * near * up, 1.1 * near * up, 0.01, _METAL)
    _site(guide, "guide", part.guide_centre * up)
    needle = ET.SubElement(guide, "body", name="needle")
    low, high = profile.depth_range
    ET.SubElement(
        needle,
        "joint",
        name="needle_depth",
        type="slide",
        axis="0 0 -1",
        range=text(float(low), float(high)),
    )
    length = profile.needle_length
    across = max(part.needle_inertia, _NOTHING)
    inertia = np.diag([across, across, _NOTHING])
    centre = (length - part.needle_centre) * up
    _inertial(needle, max(part.needle_mass, _NOTHING), centre, inertia)
    line(needle, np.zeros(3), length * up, 0.001, _NEEDLE)
    _site(needle, "tip", np.zeros(3))
    _site(needle, "hub", length * up)
    return guide


def _cables(
    root: ET.Element, profile: TensegrityProfile, cables: tuple[tuple[str, str], ...]
) -> None:
    tendons, actuators = ET.SubElement(root, "tendon"), ET.SubElement(root, "actuator")
    winch, law = profile.winches, profile.cables
    for ends in cables:
        name = "".join(ends)
        tendon = ET.SubElement(
            tendons,
            "spatial",
            name=name,
            width="0.001",
            rgba=_CABLE,
            armature=text(winch.mass),
            frictionloss=text(winch.coulomb),
            damping=text(winch.viscous),
        )
        for end in ends:
            ET.SubElement(tendon, "site", site=end)
        # a tension shortens its cable
        limits = text(law.least, law.most)
        ET.SubElement(actuators, "motor", name=name, tendon=name, gear="-1", ctrlrange=limits)


def _arc_inertia(
    start: FloatArray, end: FloatArray, radius: float, density: float
) -> tuple[float, FloatArray, FloatArray]:
    """Mass, centre and inertia about O of a uniform arc about O from start to end."""
    u, v = unit(start), unit(end)
    s = acos(float(np.clip(u @ v, -1.0, 1.0)))
    mass = density * radius * s
    middle = unit(u + v)
    ahead = unit(v - u)
    # r = R (cos φ middle + sin φ ahead), φ from -s/2 to s/2
    along, aside = 0.5 * (1.0 + sin(s) / s), 0.5 * (1.0 - sin(s) / s)
    second = along * np.outer(middle, middle) + aside * np.outer(ahead, ahead)
    inertia = mass * radius**2 * (np.eye(3) - second)
    return mass, radius * sin(0.5 * s) / (0.5 * s) * middle, inertia


def _together(
    parts: list[tuple[float, FloatArray, FloatArray]],
) -> tuple[float, FloatArray, FloatArray]:
    """Mass, centre, and inertia about the centre, of parts whose inertia is about O."""
    mass = sum(part[0] for part in parts)
    centre = sum((part[0] * part[1] for part in parts), np.zeros(3)) / mass
    about_origin = sum((part[2] for part in parts), np.zeros((3, 3)))
    steiner = mass * (float(centre @ centre) * np.eye(3) - np.outer(centre, centre))
    inertia = about_origin - steiner
    # A flat body's moments just satisfy A + B = C; what rounding takes from it is given back.
    return mass, centre, inertia + 1e-12 * float(np.trace(inertia)) * np.eye(3)


def _inertial(body: ET.Element, mass: float, centre: FloatArray, inertia: FloatArray) -> None:
    six = [inertia[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
    ET.SubElement(body, "inertial", pos=text(*centre), mass=text(mass), fullinertia=text(*six))


def _curve(body: ET.Element, start: FloatArray, end: FloatArray) -> None:
    shares = np.linspace(0.0, 1.0, _PIECES + 1)
    radius = float(np.linalg.norm(start))
    stops = [radius * _between(unit(start), unit(end), share) for share in shares]
    for near, far in pairwise(stops):
        line(body, near, far, _HALF_WIDTH, _BAR)


def _between(u: FloatArray, v: FloatArray, share: float) -> FloatArray:
    s = acos(float(np.clip(u @ v, -1.0, 1.0)))
    return np.asarray((sin((1.0 - share) * s) * u + sin(share * s) * v) / sin(s))


def _site(body: ET.Element, name: str, place: FloatArray) -> None:
    ET.SubElement(body, "site", name=name, pos=text(*place), size="0.004")
