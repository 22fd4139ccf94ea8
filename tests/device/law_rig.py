"""One force law on one state: forces, energies, and slopes of its potential."""

from typing import Any

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.control import laws
from app.mechanisms.pantograph import inverse, jacobian
from app.mechanisms.profile import load_profile

RELAXED = settings(derandomize=True, deadline=None, max_examples=80)
PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph
FULCRUM = GEOMETRY.fulcrum

directions = st.tuples(*(st.floats(-1.0, 1.0),) * 3).filter(
    lambda v: 0.1 < float(np.linalg.norm(v)) < 1.0
)
tilts = st.floats(0.0, PROFILE.tilt_limit)
azimuths = st.floats(-np.pi, np.pi)
depths = st.floats(*PROFILE.depth_range)


def unit(v: Any) -> FloatArray:
    return np.array(v) / np.linalg.norm(v)


def leaning(tilt: float, azimuth: float) -> FloatArray:
    """Needle direction at a tilt from the vertical [rad]."""
    sine = np.sin(tilt)
    return np.array([sine * np.cos(azimuth), sine * np.sin(azimuth), -np.cos(tilt)])


def across(d: FloatArray, probe: Any) -> FloatArray:
    """Unit vector across d, nearest to the probe."""
    part = np.array(probe) - d * np.dot(d, probe)
    return unit(part if np.linalg.norm(part) > 1e-3 else np.cross(d, np.roll(d, 1)))


def pose(d: Any, depth: float = 0.06, velocity: Any = (0.0, 0.0, 0.0), **slots: float) -> Any:
    """Return a state with the needle in a direction, hub velocity [m/s], and other slots."""
    state = sv.empty_state()
    length = PROFILE.geometry.needle_length
    state[sv.DT], state[sv.TIME] = 1e-3, 5.0
    state[sv.AXIS] = d
    state[sv.L_OUT], state[sv.DEPTH] = length - depth, depth
    state[sv.HUB] = FULCRUM - (length - depth) * np.array(d)
    state[sv.TIP] = FULCRUM + depth * np.array(d)
    state[sv.HUB_V] = velocity
    for name, value in slots.items():
        state[sv.INDEX[name]] = value
    return state


def with_joints(state: FloatArray, qd: Any = (0.0, 0.0)) -> FloatArray:
    """Fill in motor angles, tool point, Jacobian and velocities for the state's direction."""
    d = state[sv.AXIS]
    l_in = -FULCRUM[2] / d[2]
    p3 = FULCRUM + l_in * d
    q = inverse(GEOMETRY, p3[:2])
    matrix = jacobian(GEOMETRY, q)
    state[sv.Q_LEFT], state[sv.Q_RIGHT] = q
    state[sv.QD_LEFT], state[sv.QD_RIGHT] = qd
    state[sv.J_XL], state[sv.J_XR] = matrix[0]
    state[sv.J_YL], state[sv.J_YR] = matrix[1]
    state[sv.P3_X], state[sv.P3_Y] = p3[:2]
    v = matrix @ np.array(qd)
    state[sv.P3_VX], state[sv.P3_VY] = v
    state[sv.L_IN] = l_in
    hub = -(state[sv.L_OUT] / l_in) * (np.array([*v, 0.0]) - d * (d[:2] @ v))
    state[sv.HUB_V] = hub
    return with_dynamics(state)


def with_dynamics(state: FloatArray, profile: Any = PROFILE) -> FloatArray:
    """Fill in what the machine's own stages say of the state's pose."""
    stages = profile.machine.stages()
    for stage in (stages.pose, stages.dynamics):
        stage.function(state, stage.parameters)
    return state


class OneLaw:
    """A law alone, with fresh memory."""

    def __init__(self, name: str, **parameters: float) -> None:
        ((_, self.function, self.memory),) = laws.stages_of({name: parameters}, PROFILE)
        self.bound = laws.energy_bound({name: parameters}, PROFILE)

    def run(self, state: FloatArray) -> FloatArray:
        """One tick on a copy of the state."""
        copy = state.copy()
        self.function(copy, self.memory)
        return copy

    def force(self, state: FloatArray) -> FloatArray:
        """Force of one tick at the hub [N]."""
        done = self.run(state)
        force = done[sv.FORCE]
        assert force.tolist() == done[sv.GUIDE].tolist()
        return force

    def energy(self, state: FloatArray) -> float:
        """Potential [J]."""
        return float(self.run(state)[sv.POTENTIAL])

    def slope(self, state: FloatArray, direction: FloatArray, step: float = 1e-6) -> float:
        """Change of the potential as the hub moves across the needle [J/m], by differences."""
        energies = []
        for s in (step, -step):
            turned = state.copy()
            d = state[sv.AXIS] - s / state[sv.L_OUT] * direction
            turned[sv.AXIS] = d / np.linalg.norm(d)
            if state[sv.L_IN] != 0.0:
                turned = with_joints(turned)
            energies.append(self.energy(turned))
        return (energies[0] - energies[1]) / (2.0 * step)
