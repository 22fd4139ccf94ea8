"""Joint torques beside the force: added before the joints' limit, which keeps their direction."""

import numpy as np
import pytest
from device.law_rig import GEOMETRY, PROFILE, leaning, pose, with_joints
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.device.control.transmission import Transmission
from app.mechanisms.pantograph import ForceLaw, force_map, jacobian, joint_torques, system_forward

torques = st.floats(-2.0, 2.0)
forces = st.floats(-3.0, 3.0)


def through(force, joint, law=ForceLaw.VIRTUAL_WORK):
    state = with_joints(pose(leaning(0.3, 0.8), 0.05))
    d = state[sv.AXIS]
    state[sv.FORCE] = np.array(force) - d * np.dot(d, force)
    state[[sv.JOINT_LEFT, sv.JOINT_RIGHT]] = joint
    _, function, parameters = Transmission.of(PROFILE, law).stage()
    function(state, parameters)
    return state, state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]


@settings(derandomize=True, deadline=None, max_examples=60)
@given(st.tuples(forces, forces, forces), st.tuples(torques, torques))
def test_the_sum_is_scaled_as_one(force, joint):
    state, sent = through(force, joint)
    needle = system_forward(GEOMETRY, state[[sv.Q_LEFT, sv.Q_RIGHT]], float(state[sv.L_OUT]))
    across = state[sv.FORCE]
    across = across * min(1.0, PROFILE.limits.hand_force / max(np.linalg.norm(across), 1e-300))
    matrix = jacobian(GEOMETRY, state[[sv.Q_LEFT, sv.Q_RIGHT]])
    wanted = joint_torques(matrix, force_map(needle, across)) + np.array(joint)
    largest = np.abs(wanted).max()
    scale = min(1.0, PROFILE.limits.joint_torque / largest) if largest > 0.0 else 1.0
    assert sent == pytest.approx(scale * wanted, abs=1e-9)


@pytest.mark.parametrize("law", list(ForceLaw))
def test_torques_without_a_force_pass_unchanged_under_either_law(law):
    _, sent = through((0.0, 0.0, 0.0), (0.1, -0.2), law)
    assert sent == pytest.approx([0.1, -0.2])
