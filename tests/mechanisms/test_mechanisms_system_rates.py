"""The complete system's derivatives against differences, there and back."""

import numpy as np
import pytest

from app.mechanisms.errors import MechanismError, SingularError
from app.mechanisms.pantograph import (
    LengthMode,
    inverse,
    jacobian,
    joints_by_hub,
    system_forward,
    system_inverse,
    system_rates,
)
from app.mechanisms.profile import load_profile

GEOMETRY = load_profile("icube").pantograph


def tool_points(n: int, tilt_deg: float = 45.0, seed: int = 7) -> np.ndarray:
    """Random tool points of needles up to a tilt, even over the disc, shape (n, 2)."""
    rng = np.random.default_rng(seed)
    radius = GEOMETRY.fulcrum[2] * np.tan(np.radians(tilt_deg)) * np.sqrt(rng.uniform(0, 1, n))
    turn = rng.uniform(0.0, 2.0 * np.pi, n)
    return GEOMETRY.fulcrum[:2] + np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])


@pytest.mark.parametrize("mode", list(LengthMode))
def test_the_systems_derivatives_are_those_of_the_hub_point(mode):
    step = 1e-6
    for p3 in tool_points(25):
        q, l_out = inverse(GEOMETRY, p3), 0.09 if mode is LengthMode.MEASURED else None

        def hub(q, l_out=l_out):
            return system_forward(GEOMETRY, q, l_out, mode).hub

        rates = system_rates(GEOMETRY, q, l_out, mode)
        found = [(hub(q + step * e) - hub(q - step * e)) / (2 * step) for e in np.eye(2)]
        assert rates.by_joints == pytest.approx(np.column_stack(found), abs=1e-9)
        assert rates.by_tool @ jacobian(GEOMETRY, q) == pytest.approx(rates.by_joints, abs=1e-16)
        if l_out is None:
            assert not rates.by_length.any()
        else:
            longer, shorter = hub(q, l_out + step), hub(q, l_out - step)
            assert rates.by_length == pytest.approx((longer - shorter) / (2 * step), abs=1e-9)


def test_joint_rates_of_a_moving_hub_are_the_derivative_of_the_inverse():
    step = 1e-6
    for p3 in tool_points(25):
        hub = system_forward(GEOMETRY, inverse(GEOMETRY, p3), 0.11).hub

        def joints(at):
            return system_inverse(GEOMETRY, at)[0]

        found = [(joints(hub + step * e) - joints(hub - step * e)) / (2 * step) for e in np.eye(3)]
        map_back = joints_by_hub(GEOMETRY, hub)
        assert map_back == pytest.approx(np.column_stack(found), abs=1e-7)
        rates = system_rates(GEOMETRY, inverse(GEOMETRY, p3), 0.11)
        assert map_back @ rates.by_joints == pytest.approx(np.eye(2), abs=1e-12)
        assert map_back @ rates.by_length == pytest.approx(np.zeros(2), abs=1e-12)


def test_joint_rates_in_a_mode_that_does_not_close_are_refused():
    hub = system_forward(GEOMETRY, inverse(GEOMETRY, (0.0, 0.16)), 0.11).hub
    with pytest.raises(MechanismError, match="does not close there in assembly 1"):
        joints_by_hub(GEOMETRY, hub, mode=(-1, 1))
    reach = (GEOMETRY.proximal + GEOMETRY.distal) * (1 - 1e-16)
    far = np.array([0.0, np.sqrt(reach**2 - GEOMETRY.base**2 / 4)])
    p3 = np.array([*far, 0.0])
    away = (GEOMETRY.fulcrum - p3) / np.linalg.norm(GEOMETRY.fulcrum - p3)
    with pytest.raises((SingularError, MechanismError)):
        joints_by_hub(GEOMETRY, GEOMETRY.fulcrum + 0.1 * away)
