"""The pantograph in MuJoCo: its closed loop moved, accelerated and held, to check ours against.

For studies: `felt_in_mujoco(profile, tilt, azimuth, torques, l_out=None) -> force at the hub (3,)`.
"""

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.exchange.errors import ExchangeError, ExportError
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph import forward, inverse, jacobian, needle_at
from app.mechanisms.pantograph.profile import PantographProfile
from app.simulation.mjcf import import_mujoco, line, text

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


def write_mjcf(profile: PantographProfile, settings: MjcfSettings | None = None) -> str:
    """Return the profile as MJCF text.

    Raises:
        ExportError: if the tool has no mass, which MuJoCo cannot move.
    """
    how = settings or MjcfSettings()
    if not profile.inertia.tool_mass > 0.0:
        raise ExportError(
            sentence(
                "device {profile_name}: tool_mass is {profile_inertia_tool_mass} kg; MuJoCo "
                "needs a positive one",
                profile_name=profile.name,
                profile_inertia_tool_mass=profile.inertia.tool_mass,
            )
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


def _option(root: ET.Element, profile: PantographProfile, how: MjcfSettings) -> None:
    option = ET.SubElement(
        root,
        "option",
        timestep=text(how.step),
        gravity=text(*(profile.mounting.gravity if how.gravity is None else how.gravity)),
        integrator="RK4",
        solver="Newton",
        tolerance="1e-16",
        jacobian="dense",
    )
    ET.SubElement(option, "flag", contact="disable", refsafe="disable")


def _arm(
    world: ET.Element,
    profile: PantographProfile,
    how: MjcfSettings,
    x: float,
    names: tuple[str, str, str],
    carries: bool,
) -> None:
    lengths, part = profile.geometry, profile.inertia
    driven, passive, side = names
    damping = profile.friction.viscous if how.damped else 0.0
    body = ET.SubElement(world, "body", name=f"{side}_driven", pos=text(x, 0.0, 0.0))
    ET.SubElement(
        body,
        "joint",
        name=driven,
        axis="0 0 1",
        armature=text(part.reflected_rotor),
        damping=text(damping),
    )
    _link(body, part.proximal_mass, part.proximal_centre, part.proximal_inertia, lengths.proximal)
    body = ET.SubElement(body, "body", name=f"{side}_passive", pos=text(lengths.proximal, 0.0, 0.0))
    ET.SubElement(body, "joint", name=passive, axis="0 0 1")
    mass, centre, inertia = part.distal_mass, part.distal_centre, part.distal_inertia
    if carries:  # the tool's mass at the link's end, lumped into it
        total = mass + part.tool_mass
        inertia += mass * part.tool_mass / total * (lengths.distal - centre) ** 2
        mass, centre = total, (mass * centre + part.tool_mass * lengths.distal) / total
    _link(body, mass, centre, inertia, lengths.distal)
    ET.SubElement(body, "site", name=f"{side}_end", pos=text(lengths.distal, 0.0, 0.0))


def _link(body: ET.Element, mass: float, centre: float, inertia: float, length: float) -> None:
    # It turns about z only: what stands at x and y does not matter, but must be that of a body.
    ET.SubElement(
        body,
        "inertial",
        pos=text(centre, 0.0, 0.0),
        mass=text(mass),
        diaginertia=text(0.01 * inertia, inertia, inertia),
    )
    line(body, (0, 0, 0), (length, 0, 0), 0.006, "0.6 0.6 0.65 1")


def _needle(world: ET.Element, profile: PantographProfile, how: MjcfSettings) -> None:
    lengths, part = profile.geometry, profile.inertia
    start = 0.0 if how.slides else how.fixed_depth
    needle = ET.SubElement(world, "body", name="needle", pos=text(*lengths.fulcrum))
    ET.SubElement(needle, "joint", name="needle_x", axis="1 0 0")
    ET.SubElement(needle, "joint", name="needle_y", axis="0 1 0")
    if how.slides:
        ET.SubElement(needle, "joint", name="depth", type="slide", axis="0 0 -1")
    hub = lengths.needle_length - start
    ET.SubElement(
        needle,
        "inertial",
        pos=text(0.0, 0.0, hub - part.needle_centre),
        mass=text(max(part.needle_mass, _NOTHING)),
        diaginertia=text(*(2 * [max(part.needle_inertia, _NOTHING)]), _NOTHING),
    )
    ET.SubElement(needle, "site", name="hub", pos=text(0.0, 0.0, hub))
    ET.SubElement(needle, "site", name="tip", pos=text(0.0, 0.0, -start))
    line(needle, (0, 0, hub), (0, 0, -start), 0.0025, "0.85 0.85 0.9 1")
    carriage = ET.SubElement(needle, "body", name="carriage")
    ET.SubElement(carriage, "joint", name="lever", type="slide", axis="0 0 -1")
    ET.SubElement(
        carriage,
        "inertial",
        pos="0 0 0",
        mass=text(part.tool_mass),
        diaginertia=text(*(3 * [_NOTHING])),
    )
    ET.SubElement(carriage, "site", name="carriage")


def _connect(equality: ET.Element, how: MjcfSettings, item: str, other: str) -> None:
    ET.SubElement(
        equality,
        "connect",
        name=f"{item}_{other}",
        site1=item,
        site2=other,
        solref=text(-how.stiffness, -2.0 * sqrt(how.stiffness)),
        solimp=text(IMPEDANCE, IMPEDANCE, 1e-3, 0.5, 1.0),
    )


_REST = 1e-9
"""Joint speed below which the mechanism counts as at rest [rad/s]."""


class MujocoPantograph:
    """A profile as a running MuJoCo model; coordinates are the motor angles and the depth.

    Raises:
        SimulationError: if the extra is not installed.
        ExchangeError: if MuJoCo refuses the model.
    """

    def __init__(self, profile: PantographProfile, settings: MjcfSettings | None = None) -> None:
        self.mujoco = import_mujoco("physics")
        self.profile, self.settings = profile, settings or MjcfSettings()
        try:
            self.model = self.mujoco.MjModel.from_xml_string(write_mjcf(profile, self.settings))
        except ValueError as error:
            raise ExchangeError(
                sentence(
                    "MuJoCo refuses the model of device {profile_name}: {error}",
                    profile_name=profile.name,
                    error=error,
                )
            ) from error
        self.data = self.mujoco.MjData(self.model)
        self.motors = [self.address("panto_a1"), self.address("panto_a5")]

    def address(self, joint: str) -> int:
        """Index of a joint in positions and velocities (each has one of both)."""
        return int(self.model.joint(joint).qposadr[0])

    @property
    def q(self) -> FloatArray:
        """Motor angles [rad], shape (2,)."""
        return np.array(self.data.qpos[self.motors])

    @property
    def depth(self) -> float:
        """Depth of the tip [m]."""
        settings = self.settings
        return (
            float(self.data.qpos[self.address("depth")])
            if settings.slides
            else settings.fixed_depth
        )

    def place(self, q: ArrayLike, qd: ArrayLike, depth: float = 0.0, rate: float = 0.0) -> None:
        """Close the loop at motor angles and rates, shapes (2,), and depth and depth rate.

        Raises:
            MechanismError: if the pose does not exist.
        """
        q, qd = np.asarray(q, dtype=np.float64), np.asarray(qd, dtype=np.float64)
        positions, rates = _closed(self.profile.pantograph, q, qd)
        positions |= {"depth": depth}
        rates |= {"depth": rate}
        # The carriage slides on the needle, which slides itself.
        if self.settings.slides:
            positions["lever"] -= depth
            rates["lever"] -= rate
        self.mujoco.mj_resetData(self.model, self.data)
        for k in range(self.model.njnt):
            name = self.model.joint(k).name
            self.data.qpos[k], self.data.qvel[k] = positions[name], rates[name]
        self.mujoco.mj_forward(self.model, self.data)
        if self.settings.holds_hub:
            self.data.mocap_pos[0] = self.data.site("hub").xpos
            self.mujoco.mj_forward(self.model, self.data)

    def push(self, torques: ArrayLike) -> None:
        """Put torques on the motors from now on [N·m], shape (2,)."""
        self.data.qfrc_applied[:] = 0.0
        self.data.qfrc_applied[self.motors] = torques

    def run(self, steps: int) -> None:
        """Integrate a number of steps."""
        self.mujoco.mj_step(self.model, self.data, nstep=steps)

    def acceleration(self) -> FloatArray:
        """Accelerations of the joints with rigid constraints, shape (nv,).

        MuJoCo's mass matrix, bias forces and constraint Jacobian, solved for the accelerations that
        keep the constraints exactly (its own solver lets 1e-4 of the violation pass).
        """
        model, data = self.model, self.data
        self.mujoco.mj_forward(model, data)
        mass = np.zeros((model.nv, model.nv))
        self.mujoco.mj_fullM(model, data, mass)
        jacobian, bias = self._constraints()
        n = len(bias)
        system = np.block([[mass, jacobian.T], [jacobian, np.zeros((n, n))]])
        force = data.qfrc_applied + data.qfrc_passive - data.qfrc_bias
        solution = np.linalg.lstsq(system, np.concatenate([force, -bias]), rcond=1e-13)[0]
        return np.array(solution[: model.nv])

    def held_force(self) -> FloatArray:
        """Force that the held hub exerts on the hand [N] in world, shape (3,)."""
        rows = self.data.efc_id[: self.data.nefc] == self.model.equality("hub_hand").id
        return -np.array(self.data.efc_force[: self.data.nefc][rows])

    def _constraints(self) -> tuple[FloatArray, FloatArray]:
        """Jacobian of all constraints (n, nv), and what its rate times the velocity is (n,)."""
        model, data = self.model, self.data
        size = 3, model.nv
        rows, biases = [], []
        for k in range(model.neq):
            row = np.zeros(size)
            bias = np.zeros(3)
            for sign, site in ((1.0, model.eq_obj1id[k]), (-1.0, model.eq_obj2id[k])):
                jac, rate = np.zeros(size), np.zeros(size)
                point, body = data.site_xpos[site], int(model.site_bodyid[site])
                self.mujoco.mj_jac(model, data, jac, None, point, body)
                self.mujoco.mj_jacDot(model, data, rate, None, point, body)
                row += sign * jac
                bias += sign * rate @ data.qvel
            rows.append(row)
            biases.append(bias)
        return np.vstack(rows), np.concatenate(biases)


def felt_in_mujoco(
    profile: PantographProfile,
    tilt: float,
    azimuth: float,
    torques: ArrayLike,
    l_out: float | None = None,
) -> FloatArray:
    """Force that motor torques make a still hand feel, by MuJoCo's closed-loop statics.

    The hub is held where it is, gravity and friction are left out, and the model is let come to
    rest.

    Args:
        profile: the device.
        tilt: of the needle from the vertical [rad].
        azimuth: direction in which the tip leans, from +x [rad].
        torques: at the motors (left, right) [N·m], shape (2,).
        l_out: hub to fulcrum [m]; None takes the printed mode, needle length less L_in.

    Returns:
        Force at the hub [N] in world, shape (3,).

    Raises:
        SimulationError: if the extra is not installed.
        ExchangeError: if the model does not come to rest.
        MechanismError: if the pose does not exist.
    """
    geometry = profile.pantograph
    lean = np.tan(tilt) * np.array([np.cos(azimuth), np.sin(azimuth)])
    needle = needle_at(geometry, geometry.fulcrum[:2] + geometry.fulcrum[2] * lean, l_out)
    settings = MjcfSettings(holds_hub=True, gravity=(0.0, 0.0, 0.0), stiffness=1e6)
    machine = MujocoPantograph(profile, settings)
    machine.model.dof_damping[:] = 0.5
    machine.place(inverse(geometry, needle.p3), (0.0, 0.0), needle.depth)
    machine.push(torques)
    for _ in range(200):
        machine.run(20)
        if np.abs(machine.data.qvel).max() < _REST:
            return machine.held_force()
    speed = np.abs(machine.data.qvel).max()
    raise ExchangeError(
        sentence(
            "MuJoCo's model of {profile_name} still moves at {speed:.2g} rad/s after 0.4 s; the"
            " torques {torques} N·m may be too large",
            profile_name=profile.name,
            speed=speed,
            torques=np.asarray(torques).tolist(),
        )
    )


def _closed(
    geometry: Geometry, q: FloatArray, qd: FloatArray
) -> tuple[dict[str, float], dict[str, float]]:
    """Positions and velocities of all joints but the depth, by their names."""
    p3, v = forward(geometry, q), jacobian(geometry, q) @ qd
    positions: dict[str, float] = {}
    rates: dict[str, float] = {}
    for driven, passive, side, k in (
        ("panto_a1", "panto_a2", -1, 0),
        ("panto_a5", "panto_a4", 1, 1),
    ):
        along = np.array([np.cos(q[k]), np.sin(q[k])])
        across = np.array([-along[1], along[0]])
        elbow = np.array([0.5 * side * geometry.base, 0.0]) + geometry.proximal * along
        ex, ey = p3 - elbow
        wx, wy = v - geometry.proximal * qd[k] * across
        positions |= {driven: q[k], passive: np.arctan2(ey, ex) - q[k]}
        rates |= {driven: qd[k], passive: (ex * wy - ey * wx) / geometry.distal**2 - qd[k]}
    needle = np.array([*p3, 0.0]) - geometry.fulcrum
    lever = float(np.linalg.norm(needle))
    dx, dy, dz = axis = needle / lever
    stretch = axis @ (*v, 0.0)
    tx, ty, tz = (np.array([*v, 0.0]) - stretch * axis) / lever
    # Rx(a) Ry(b) turns straight down into (-sin b, sin a cos b, -cos a cos b).
    positions |= {"needle_x": np.arctan2(dy, -dz), "needle_y": -np.arcsin(dx), "lever": lever}
    cosine = dy * dy + dz * dz
    rates |= {
        "needle_x": (dy * tz - dz * ty) / cosine,
        "needle_y": -tx / np.sqrt(cosine),
        "lever": float(stretch),
    }
    return positions, rates
