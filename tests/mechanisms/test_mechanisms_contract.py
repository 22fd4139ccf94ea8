"""What every machine that points a needle at a remote centre must do, whatever it is made of."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.errors import ConfigurationError
from app.mechanisms.errors import MechanismError
from app.mechanisms.profile import load_profile, parse_profile, profile_class, profile_names
from app.mechanisms.remote_centre import REGULAR, PartKind, RemoteCentre
from app.mechanisms.status import Status

FAST = settings(derandomize=True, deadline=None, max_examples=40)
STEP = 1e-6

_FOLDED = float(np.arccos(0.425))  # both elbows of the first profile's in one point

SINGULAR: dict[str, list[tuple[tuple[float, float], str]]] = {
    "pantograph": [((1.0, np.pi - 1.0), REGULAR), ((_FOLDED, np.pi - _FOLDED), "parallel")],
    "tensegrity": [
        ((1.8, 2.2), REGULAR),
        ((1e-9, 2.2), "extended_first"),
        ((2.0, 1e-9), "extended_second"),
    ],
}
"""Joint angles of the kind's first profile -> name of the singularity there."""


@pytest.fixture(params=profile_names())
def profile(request: pytest.FixtureRequest):
    return load_profile(request.param)


tilts, azimuths = st.floats(0.0, 0.98), st.floats(-np.pi, np.pi)
rates = st.tuples(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))
turns = st.tuples(*(st.floats(-1.0, 1.0),) * 3)


def leaning(profile, share: float, azimuth: float) -> FloatArray:
    tilt = share * profile.tilt_limit
    sine = np.sin(tilt)
    return np.array([sine * np.cos(azimuth), sine * np.sin(azimuth), -np.cos(tilt)])


def slope(call: Any, q: FloatArray, way: FloatArray) -> FloatArray:
    return (call(q + STEP * way) - call(q - STEP * way)) / (2.0 * STEP)


def in_loop(profile, machine: RemoteCentre, q, qd=(0.0, 0.0), depth: float = 0.03) -> FloatArray:
    """State after the machine's own stages of a tick."""
    state, stages = sv.empty_state(), machine.stages()
    state[sv.Q], state[sv.QD], state[sv.DEPTH] = q, qd, depth
    for stage in (stages.pose, stages.dynamics):
        if stage is not None:
            stage.function(state, stage.parameters)
    return state


@FAST
@given(share=tilts, azimuth=azimuths)
@pytest.mark.parametrize("name", profile_names())
def test_joints_and_axis_are_inverse_of_each_other(name, share, azimuth):
    profile = load_profile(name)
    machine, axis = profile.machine, leaning(profile, share, azimuth)
    branches = machine.joints(axis)
    assert len({branch.name for branch in branches}) == len(branches)
    assert any(branch.mounted for branch in branches)
    assert_allclose(machine.axis(machine.usable(axis)), axis, atol=1e-11)
    assert machine.holds(axis)
    assert all(branch.status is Status.OK for branch in branches if branch.mounted)
    for q, (low, high) in zip(machine.usable(axis), machine.joint_ranges, strict=True):
        assert low < q < high


@pytest.mark.long("statistics")
@FAST
@given(share=tilts, azimuth=azimuths, qd=rates)
@pytest.mark.parametrize("name", profile_names())
def test_jacobian_and_its_rate_are_slopes(name, share, azimuth, qd):
    profile = load_profile(name)
    machine, way = profile.machine, np.array(qd)
    q = machine.usable(leaning(profile, share, azimuth))
    pose = machine.pose(q)
    columns = [slope(machine.axis, q, e) for e in np.eye(2)]
    assert_allclose(pose.jacobian, np.column_stack(columns), atol=1e-7)
    assert_allclose(pose.axis @ pose.jacobian, 0.0, atol=1e-12)
    assert_allclose(machine.jacobian_rate(q, way), slope(machine.jacobian, q, way), atol=2e-6)


@FAST
@given(share=tilts, azimuth=azimuths, qd=rates, moment=turns)
@pytest.mark.parametrize("name", profile_names())
def test_statics_do_the_work_of_the_moment(name, share, azimuth, qd, moment):
    profile = load_profile(name)
    machine, m = profile.machine, np.array(moment)
    q = machine.usable(leaning(profile, share, azimuth))
    pose = machine.pose(q)
    spin = np.cross(pose.axis, pose.jacobian @ np.array(qd))
    torques = machine.joint_torques(q, m)
    assert torques @ np.array(qd) == pytest.approx(m @ spin, abs=1e-12)
    across = m - pose.axis * (pose.axis @ m)
    assert_allclose(machine.moment(q, torques), across, atol=1e-9)


@FAST
@given(share=tilts, azimuth=azimuths, qd=rates)
@pytest.mark.parametrize("name", profile_names())
def test_the_stage_of_the_loop_says_the_same(name, share, azimuth, qd):
    profile = load_profile(name)
    machine, axis = profile.machine, leaning(profile, share, azimuth)
    q = machine.usable(axis)

    def tool(angles: FloatArray) -> FloatArray:
        d = machine.axis(angles)
        return (machine.centre - d * machine.centre[2] / d[2])[:2]

    state = in_loop(profile, machine, q)
    assert state[sv.KINEMATICS] == Status.OK
    assert_allclose(state[sv.P3], tool(q), atol=1e-12)
    columns = [slope(tool, q, e) for e in np.eye(2)]
    assert_allclose(state[sv.JACOBIAN].reshape(2, 2), np.column_stack(columns), atol=1e-7)


def matrix(state: FloatArray, block: slice) -> FloatArray:
    left, cross, right = state[block]
    return np.array([[left, cross], [cross, right]])


@pytest.mark.long("statistics")
@FAST
@given(share=tilts, azimuth=azimuths, qd=rates, depth=st.floats(0.0, 1.0))
@pytest.mark.parametrize("name", profile_names())
def test_mass_is_positive_and_motion_makes_no_energy(name, share, azimuth, qd, depth):
    profile = load_profile(name)
    machine, way = profile.machine, np.array(qd)
    low, high = profile.depth_range
    at = low + depth * (high - low)
    q = machine.usable(leaning(profile, share, azimuth))
    terms, state = machine.dynamics(q, way, at), in_loop(profile, machine, q, way, at)
    for mass in (terms.mass, matrix(state, sv.INERTIA)):
        assert_allclose(mass, mass.T)
        assert (np.linalg.eigvalsh(mass) > 0.0).all()
    assert_allclose(matrix(state, sv.MASS), terms.mass, rtol=1e-12, atol=1e-15)
    assert_allclose(state[sv.BIAS], terms.velocity, rtol=1e-9, atol=1e-15)
    assert_allclose(state[sv.WEIGHT], terms.gravity, rtol=1e-9, atol=1e-15)
    drift = machine.jacobian_rate(q, way) @ way
    tool_rate = slope(lambda x: in_loop(profile, machine, x)[sv.JACOBIAN], q, way)
    assert_allclose(state[sv.DRIFT], tool_rate.reshape(2, 2) @ way, atol=1e-6)
    assert np.isfinite(drift).all()
    # What the velocity terms take is what changes the kinetic energy at constant speed.
    growth = slope(lambda x: machine.dynamics(x, way, at).mass, q, way)
    assert way @ terms.velocity == pytest.approx(0.5 * way @ growth @ way, abs=1e-8)


@FAST
@given(share=tilts, azimuth=azimuths, depth=st.floats(0.0, 1.0))
@pytest.mark.parametrize("name", profile_names())
def test_weight_is_the_slope_of_the_potential(name, share, azimuth, depth):
    profile = load_profile(name)
    machine, part = profile.machine, profile.inertia
    low, high = profile.depth_range
    at = low + depth * (high - low)
    beyond = at + part.needle_centre - profile.needle_length
    gravity = np.array(profile.mounting.gravity)

    def potential(q: FloatArray) -> float:
        links = in_loop(profile, machine, q, depth=at)[sv.LINKS_POTENTIAL]
        return float(links - part.needle_mass * beyond * gravity @ machine.axis(q))

    q = machine.usable(leaning(profile, share, azimuth))
    weight = in_loop(profile, machine, q, depth=at)[sv.WEIGHT]
    assert_allclose(weight, [slope(potential, q, e) for e in np.eye(2)], atol=1e-8)
    links = in_loop(profile, machine, q)[sv.LINKS_POTENTIAL]
    assert abs(links) <= profile.links_potential_bound + 1e-12


@pytest.mark.parametrize(
    ("kind", "q", "called"),
    [(kind, q, called) for kind, places in SINGULAR.items() for q, called in places],
)
def test_singular_places_have_their_names(kind, q, called):
    known = map(load_profile, ("icube", *profile_names()))
    profile = next(profile for profile in known if profile.kind == kind)
    pose = profile.machine.pose(q)
    assert pose.singularity == called
    assert np.isfinite(pose.jacobian).all()
    if called == REGULAR:
        assert pose.measure > 0.0
    else:
        assert pose.measure == pytest.approx(0.0, abs=1e-6)


def test_what_is_out_of_reach_is_said_and_never_a_number(profile):
    machine = profile.machine
    for axis in ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.6, 0.0, 0.8)):
        assert not machine.holds(axis)
        assert all(np.isfinite(branch.q).all() for branch in machine.joints(axis))
        with pytest.raises(MechanismError, match="no joint angles"):
            machine.usable(axis)
    for q in ((np.nan, 1.0), (np.inf, 0.0)):
        pose = machine.pose(q)
        assert pose.status is not Status.OK
        assert np.isfinite(pose.axis).all()
        with pytest.raises(MechanismError):
            machine.axis(q)
        state = in_loop(profile, machine, q)
        assert state[sv.KINEMATICS] != Status.OK
        assert np.isfinite(np.delete(state, sv.INDEX["q_left"])).sum() >= sv.SLOTS - 3


@FAST
@given(share=tilts, azimuth=azimuths)
@pytest.mark.parametrize("name", profile_names())
def test_drawn_links_keep_their_length_and_a_cable_need_not(name, share, azimuth):
    profile = load_profile(name)
    machine = profile.machine
    reference = machine.drawn(machine.usable((0.0, 0.0, -1.0)))
    drawn = machine.drawn(machine.usable(leaning(profile, share, azimuth)))
    assert drawn.rods == reference.rods
    assert drawn.rods[0].part is PartKind.BASE
    for rod, (start, end), (first, last) in zip(
        drawn.rods, drawn.ends(), reference.ends(), strict=True
    ):
        if rod.part is not PartKind.CABLE:
            length = np.linalg.norm(end - start)
            assert length == pytest.approx(np.linalg.norm(last - first), abs=1e-9)
    still = machine.drawn(None)
    assert set(still.points) <= set(drawn.points)
    assert all(rod.part is PartKind.BASE for rod in still.rods)


def test_the_remote_centre_stands_in_world_above_the_plane_of_the_tool_point(profile):
    assert profile.machine.centre.shape == (3,)
    assert profile.machine.centre[2] > 0.0
    assert_allclose(profile.machine.centre, profile.geometry.fulcrum)


def test_a_profile_without_a_kind_is_a_pantograph_and_an_unknown_one_is_refused():
    document = load_profile("icube").model_dump(mode="json")
    assert document.pop("kind") == "pantograph"
    assert parse_profile(document, "it").kind == "pantograph"
    with pytest.raises(ConfigurationError, match=r"kind 'octopus'; valid kinds: pantograph"):
        parse_profile(document | {"kind": "octopus"}, "it")
    with pytest.raises(ConfigurationError, match="valid kinds"):
        profile_class(None, "it")
