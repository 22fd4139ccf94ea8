"""A device profile as a MuJoCo model (MJCF text): an independent check of our own mechanics.

The two arms are open chains of hinges (`panto_a1`, `panto_a2`, `panto_a5`, `panto_a4`, named as in
the laboratory's URDF) that meet at P3 by an equality constraint. With a needle, P3 is a carriage of
the tool's mass that slides along it (`lever`); the needle itself hangs in a universal joint at the
fulcrum (`needle_x`, `needle_y`) and slides through it (`depth`, zero with the tip at the fulcrum).
At zero every arm points along +x and the needle straight down; site positions, not the zero pose,
close the loop.

Constraints in MuJoCo are soft. Here they are as stiff as it allows: impedance 0.9999 (its upper
bound), and an own stiffness and critical damping per unit mass (`solref` in its direct format).
Friction of the seal and the Coulomb friction of the joints (a smoothed one here, a dry one there)
are left out; viscous joint friction is there on request.
"""

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from math import sqrt

from app.exchange.errors import ExportError
from app.mechanisms.profile import DeviceProfile

IMPEDANCE = 0.9999
"""Largest constraint impedance of MuJoCo: 1e-4 of an unconstrained acceleration passes."""

_NOTHING = 1e-12
"""Inertia where a body needs one and the mechanics has none [kg·m²]."""


@dataclass(frozen=True, slots=True)
class MjcfSettings:
    """What goes into the model.

    Attributes:
        needle: with the needle; else the bare five-bar with the tool's mass at P3.
        slides: whether the needle slides through the fulcrum, or stays at `fixed_depth`.
        fixed_depth: depth of a needle that does not slide [m].
        holds_hub: hold the hub point where it is (a constraint to the world), as a hand would.
        damped: with the profile's viscous joint friction.
        gravity: in the robot's frame [m/s²]; None takes the profile's.
        step: of the integrator [s].
        stiffness: of the constraints, per unit mass [1/s²]; damping is critical.
    """

    needle: bool = True
    slides: bool = True
    fixed_depth: float = 0.0
    holds_hub: bool = False
    damped: bool = False
    gravity: tuple[float, float, float] | None = None
    step: float = 1e-4
    stiffness: float = 1e7


def write_mjcf(profile: DeviceProfile, settings: MjcfSettings | None = None) -> str:
    """Return the profile as MJCF text.

    Raises:
        ExportError: if the tool has no mass, which MuJoCo cannot move.
    """
    how = settings or MjcfSettings()
    if not profile.inertia.tool_mass > 0.0:
        raise ExportError(
            f"device {profile.name}: tool_mass is {profile.inertia.tool_mass} kg; MuJoCo needs a"
            " positive one"
        )
    root = ET.Element("mujoco", model=profile.name)
    ET.SubElement(root, "compiler", angle="radian", autolimits="true", inertiafromgeom="false")
    _option(root, profile, how)
    world = ET.SubElement(root, "worldbody")
    names = "panto_a1", "panto_a2", "left"
    _arm(world, profile, how, -0.5 * profile.geometry.base, names, carries=not how.needle)
    names = "panto_a5", "panto_a4", "right"
    _arm(world, profile, how, 0.5 * profile.geometry.base, names, carries=False)
    equality = ET.SubElement(root, "equality")
    if how.needle:
        _needle(world, profile, how)
        _connect(equality, how, "carriage", "left_end")
        _connect(equality, how, "carriage", "right_end")
    else:
        _connect(equality, how, "left_end", "right_end")
    if how.holds_hub:
        ET.SubElement(ET.SubElement(world, "body", name="hand", mocap="true"), "site", name="hand")
        _connect(equality, how, "hub", "hand")
    ET.indent(root)
    return ET.tostring(root, encoding="unicode")


def _option(root: ET.Element, profile: DeviceProfile, how: MjcfSettings) -> None:
    option = ET.SubElement(
        root,
        "option",
        timestep=_text(how.step),
        gravity=_text(*(profile.mounting.gravity if how.gravity is None else how.gravity)),
        integrator="RK4",
        solver="Newton",
        tolerance="1e-16",
        jacobian="dense",
    )
    ET.SubElement(option, "flag", contact="disable", refsafe="disable")


def _arm(
    world: ET.Element,
    profile: DeviceProfile,
    how: MjcfSettings,
    x: float,
    names: tuple[str, str, str],
    carries: bool,
) -> None:
    lengths, part = profile.geometry, profile.inertia
    driven, passive, side = names
    damping = profile.friction.viscous if how.damped else 0.0
    body = ET.SubElement(world, "body", name=f"{side}_driven", pos=_text(x, 0.0, 0.0))
    ET.SubElement(
        body,
        "joint",
        name=driven,
        axis="0 0 1",
        armature=_text(part.reflected_rotor),
        damping=_text(damping),
    )
    _link(body, part.proximal_mass, part.proximal_centre, part.proximal_inertia, lengths.proximal)
    body = ET.SubElement(
        body, "body", name=f"{side}_passive", pos=_text(lengths.proximal, 0.0, 0.0)
    )
    ET.SubElement(body, "joint", name=passive, axis="0 0 1")
    mass, centre, inertia = part.distal_mass, part.distal_centre, part.distal_inertia
    if carries:  # the tool's mass at the link's end, lumped into it
        total = mass + part.tool_mass
        inertia += mass * part.tool_mass / total * (lengths.distal - centre) ** 2
        mass, centre = total, (mass * centre + part.tool_mass * lengths.distal) / total
    _link(body, mass, centre, inertia, lengths.distal)
    ET.SubElement(body, "site", name=f"{side}_end", pos=_text(lengths.distal, 0.0, 0.0))


def _link(body: ET.Element, mass: float, centre: float, inertia: float, length: float) -> None:
    # It turns about z only: what stands at x and y does not matter, but must be that of a body.
    ET.SubElement(
        body,
        "inertial",
        pos=_text(centre, 0.0, 0.0),
        mass=_text(mass),
        diaginertia=_text(0.01 * inertia, inertia, inertia),
    )
    _line(body, (0.0, 0.0, 0.0), (length, 0.0, 0.0), 0.006, "0.6 0.6 0.65 1")


def _needle(world: ET.Element, profile: DeviceProfile, how: MjcfSettings) -> None:
    lengths, part = profile.geometry, profile.inertia
    start = 0.0 if how.slides else how.fixed_depth
    needle = ET.SubElement(world, "body", name="needle", pos=_text(*lengths.fulcrum))
    ET.SubElement(needle, "joint", name="needle_x", axis="1 0 0")
    ET.SubElement(needle, "joint", name="needle_y", axis="0 1 0")
    if how.slides:
        ET.SubElement(needle, "joint", name="depth", type="slide", axis="0 0 -1")
    hub = lengths.needle_length - start
    ET.SubElement(
        needle,
        "inertial",
        pos=_text(0.0, 0.0, hub - part.needle_centre),
        mass=_text(max(part.needle_mass, _NOTHING)),
        diaginertia=_text(*(2 * [max(part.needle_inertia, _NOTHING)]), _NOTHING),
    )
    ET.SubElement(needle, "site", name="hub", pos=_text(0.0, 0.0, hub))
    ET.SubElement(needle, "site", name="tip", pos=_text(0.0, 0.0, -start))
    _line(needle, (0.0, 0.0, hub), (0.0, 0.0, -start), 0.0025, "0.85 0.85 0.9 1")
    carriage = ET.SubElement(needle, "body", name="carriage")
    ET.SubElement(carriage, "joint", name="lever", type="slide", axis="0 0 -1")
    ET.SubElement(
        carriage,
        "inertial",
        pos="0 0 0",
        mass=_text(part.tool_mass),
        diaginertia=_text(*(3 * [_NOTHING])),
    )
    ET.SubElement(carriage, "site", name="carriage")


def _connect(equality: ET.Element, how: MjcfSettings, one: str, other: str) -> None:
    ET.SubElement(
        equality,
        "connect",
        name=f"{one}_{other}",
        site1=one,
        site2=other,
        solref=_text(-how.stiffness, -2.0 * sqrt(how.stiffness)),
        solimp=_text(IMPEDANCE, IMPEDANCE, 1e-3, 0.5, 1.0),
    )


def _line(
    body: ET.Element,
    start: tuple[float, float, float],
    end: tuple[float, float, float],
    radius: float,
    colour: str,
) -> None:
    # To be seen only.
    ET.SubElement(
        body,
        "geom",
        type="capsule",
        fromto=_text(*start, *end),
        size=_text(radius),
        mass="0",
        contype="0",
        conaffinity="0",
        rgba=colour,
    )


def _text(*numbers: float) -> str:
    return " ".join(repr(float(number)) for number in numbers)
