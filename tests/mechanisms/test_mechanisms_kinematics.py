"""The five-bar and the complete system: golden vectors, inverses, finite differences."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.mechanisms.errors import MechanismError, NoGripError, UnreachableError
from app.mechanisms.pantograph import (
    Geometry,
    LengthMode,
    forward,
    inverse,
    jacobian,
    needle_at,
    system_forward,
    system_inverse,
)
from app.mechanisms.profile import load_profile

GEOMETRY = load_profile("icube").pantograph
RELAXED = settings(derandomize=True, deadline=None, max_examples=60)


def workspace(tilt_deg: float = 45.0, rings: int = 6, spokes: int = 16) -> np.ndarray:
    """Tool points over the disc that needles up to a tilt reach, shape (n, 2)."""
    radii = GEOMETRY.fulcrum[2] * np.tan(np.radians(np.linspace(0.0, tilt_deg, rings)))
    angles = np.linspace(0.0, 2.0 * np.pi, spokes, endpoint=False)
    r, a = (grid.ravel() for grid in np.meshgrid(radii, angles))
    return np.column_stack([r * np.cos(a), r * np.sin(a) + GEOMETRY.fulcrum[1]])


tilts = st.floats(0.0, np.radians(45.0))
azimuths = st.floats(-np.pi, np.pi)


def axis_of(tilt: float, azimuth: float) -> np.ndarray:
    return np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])


def test_forward_gives_the_laboratorys_golden_vector():
    p3 = forward(GEOMETRY, (np.pi - 0.5, 0.5))
    assert p3 == pytest.approx([0.0, 0.149223285959824], abs=1e-15)


def test_system_forward_gives_the_laboratorys_golden_vector():
    needle = system_forward(GEOMETRY, (np.pi - 0.5, 0.5), mode=LengthMode.PRINTED)
    assert needle.hub == pytest.approx([0.0, 0.174218467450767, 0.198431955345491], abs=1e-15)
    assert needle.residual == 0.0


def test_inverse_then_forward_is_the_identity_over_the_whole_workspace():
    for p3 in workspace():
        assert forward(GEOMETRY, inverse(GEOMETRY, p3)) == pytest.approx(p3, abs=1e-15)


def test_forward_then_inverse_is_the_identity_over_the_whole_workspace():
    for p3 in workspace():
        q = inverse(GEOMETRY, p3)
        assert inverse(GEOMETRY, forward(GEOMETRY, q)) == pytest.approx(q, abs=2e-15)


def test_the_inverse_is_right_where_the_printed_one_is_not():
    q = inverse(GEOMETRY, (0.020, 0.180))
    assert q == pytest.approx([2.283, 0.571], abs=5e-4)


def test_joint_angles_are_continuous_around_the_rim_of_the_workspace():
    rim = workspace(45.0, 2, 720).reshape(720, 2, 2)[:, 1]
    q = np.array([inverse(GEOMETRY, p3) for p3 in rim])
    assert np.abs(np.diff(q, axis=0)).max() < 0.02


def test_the_jacobian_is_the_derivative_of_forward():
    step = 1e-6
    for p3 in workspace():
        q = inverse(GEOMETRY, p3)
        columns = [
            (forward(GEOMETRY, q + step * e) - forward(GEOMETRY, q - step * e)) / (2.0 * step)
            for e in np.eye(2)
        ]
        assert jacobian(GEOMETRY, q) == pytest.approx(np.column_stack(columns), abs=2e-9)


def test_the_condition_of_the_jacobian_stays_below_the_known_bound():
    conditions = [np.linalg.cond(jacobian(GEOMETRY, inverse(GEOMETRY, p))) for p in workspace(39.0)]
    assert max(conditions) < 1.77


@RELAXED
@given(tilts, azimuths, st.floats(0.02, 0.25))
def test_system_inverse_then_forward_is_the_identity_for_a_measured_length(tilt, azimuth, l_out):
    hub = GEOMETRY.fulcrum - l_out * axis_of(tilt, azimuth)
    q, needle = system_inverse(GEOMETRY, hub)
    again = system_forward(GEOMETRY, q, l_out)
    assert again.hub == pytest.approx(hub, abs=1e-14)
    assert needle.axis == pytest.approx(axis_of(tilt, azimuth), abs=1e-14)
    assert needle.residual == pytest.approx(GEOMETRY.needle_length - needle.l_in - l_out, abs=1e-15)


@RELAXED
@given(tilts, azimuths)
def test_in_the_printed_mode_the_tip_rests_at_the_tool_point(tilt, azimuth):
    p3 = GEOMETRY.fulcrum[:2] + GEOMETRY.fulcrum[2] * np.tan(tilt) * np.array(
        [np.cos(azimuth), np.sin(azimuth)]
    )
    needle = needle_at(GEOMETRY, p3)
    assert needle.tip == pytest.approx([*p3, 0.0], abs=1e-15)
    assert needle.depth == pytest.approx(needle.l_in, abs=1e-15)


def test_hub_fulcrum_tool_point_and_tip_lie_on_one_line():
    needle = needle_at(GEOMETRY, (0.03, 0.19), l_out=0.08)
    for point in (needle.hub, needle.tip, np.array([*needle.p3, 0.0])):
        away = np.cross(point - GEOMETRY.fulcrum, needle.axis)
        assert np.abs(away).max() < 1e-16
    assert np.linalg.norm(needle.tip - needle.hub) == pytest.approx(GEOMETRY.needle_length)


def test_the_other_assembly_mirrors_the_tool_about_the_elbows():
    q = (2.4, 0.6)
    above, below = forward(GEOMETRY, q), forward(GEOMETRY, q, assembly=-1)
    elbows = np.array([[-0.0425 + 0.1 * np.cos(2.4), 0.1 * np.sin(2.4)]])
    elbows = np.vstack([elbows, [0.0425 + 0.1 * np.cos(0.6), 0.1 * np.sin(0.6)]])
    middle, along = elbows.mean(axis=0), elbows[1] - elbows[0]
    assert np.dot(above - below, along) == pytest.approx(0.0, abs=1e-16)
    assert (above + below) / 2.0 == pytest.approx(middle, abs=1e-16)
    assert along[0] * (above - elbows[0])[1] - along[1] * (above - elbows[0])[0] > 0.0


def test_a_length_that_does_not_fit_the_mode_is_refused():
    with pytest.raises(MechanismError, match="mode 'measured' needs l_out"):
        system_forward(GEOMETRY, (2.6, 0.5))
    with pytest.raises(MechanismError, match="does not fit mode 'printed'"):
        system_forward(GEOMETRY, (2.6, 0.5), 0.1, LengthMode.PRINTED)


def test_a_needle_without_grip_is_refused_with_its_lengths():
    with pytest.raises(NoGripError, match=r"0\.2 m must stand out"):
        needle_at(GEOMETRY, (0.0, 0.16056 + 0.19))


def test_a_point_out_of_reach_is_refused_with_its_coordinates():
    with pytest.raises(UnreachableError, match=r"\(0\.0, 0\.3\)"):
        inverse(GEOMETRY, (0.0, 0.3))


def test_a_geometry_that_cannot_be_built_is_refused():
    with pytest.raises(MechanismError, match=r"proximal is -0\.1"):
        Geometry(-0.1, 0.165, 0.085, GEOMETRY.fulcrum, 0.2)
    with pytest.raises(MechanismError, match="above the links"):
        Geometry(0.1, 0.165, 0.085, np.array([0.0, 0.16, 0.0]), 0.2)
