import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.arrays import angle_between
from app.core.errors import NumericalError
from app.core.rotation import rotation_exp, rotation_log
from app.core.transform import RigidTransform, rotation_between

number = st.floats(-10.0, 10.0)
vector = st.tuples(number, number, number).map(np.array)
twist = st.tuples(vector, st.tuples(*[st.floats(-1.7, 1.7)] * 3).map(np.array)).map(np.concatenate)
EXAMPLES = settings(max_examples=100, derandomize=True, deadline=None)


@EXAMPLES
@given(twist, twist, vector)
def test_composing_is_applying_one_after_the_other(a, b, p):
    T_world_patient, T_patient_voxel = RigidTransform.exp(a), RigidTransform.exp(b)
    T_world_voxel = T_world_patient @ T_patient_voxel
    assert T_world_voxel @ p == pytest.approx(T_world_patient @ (T_patient_voxel @ p), abs=1e-11)


@EXAMPLES
@given(twist, vector)
def test_the_inverse_goes_back(a, p):
    T = RigidTransform.exp(a)
    assert T.inverse() @ (T @ p) == pytest.approx(p, abs=1e-12)
    assert (T.inverse() @ T).matrix() == pytest.approx(np.eye(4), abs=1e-13)


@EXAMPLES
@given(twist)
def test_the_logarithm_undoes_the_exponential(a):
    assert RigidTransform.exp(a).log() == pytest.approx(a, abs=1e-10)


@pytest.mark.parametrize("angle", [0.0, 1e-300, 1e-160, 1e-15, 1e-9, 1e-8, 1e-5, 1e-4, 0.1, 3.0])
def test_a_rotation_vector_survives_the_round_trip_at_every_scale(angle):
    omega = angle * np.array([2.0, -1.0, 2.0]) / 3.0
    assert rotation_log(rotation_exp(omega)) == pytest.approx(omega, rel=1e-9, abs=1e-300)


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-9, 1e-12, 0.0])
@pytest.mark.parametrize(
    "axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.6, 0.0, -0.8), (-0.48, 0.6, 0.64)]
)
def test_near_a_half_turn_the_axis_keeps_full_precision(gap, axis):
    omega = (np.pi - gap) * np.array(axis, dtype=float)
    back = rotation_log(rotation_exp(omega))
    if np.dot(back, omega) < 0:  # at π both signs are the same rotation
        assert np.linalg.norm(omega) > np.pi - 1e-11
        back = -back
    assert back == pytest.approx(omega, abs=1e-12)


@pytest.mark.parametrize("angle", [1e-12, 1e-6, 9.9e-5, 1.01e-4, 1e-2, 1.0, 3.1])
def test_the_translation_part_agrees_with_sixty_digits(angle):
    mpmath.mp.dps = 60
    xi = np.array([0.3, -0.2, 0.5, *(angle * np.array([2.0, -1.0, 2.0]) / 3.0)])
    m = mpmath.matrix(4, 4)
    m[0, 1], m[0, 2], m[0, 3] = -mpmath.mpf(xi[5]), mpmath.mpf(xi[4]), mpmath.mpf(xi[0])
    m[1, 0], m[1, 2], m[1, 3] = mpmath.mpf(xi[5]), -mpmath.mpf(xi[3]), mpmath.mpf(xi[1])
    m[2, 0], m[2, 1], m[2, 3] = -mpmath.mpf(xi[4]), mpmath.mpf(xi[3]), mpmath.mpf(xi[2])
    exact = np.array(mpmath.expm(m, method="taylor").tolist(), dtype=float)
    assert RigidTransform.exp(xi).matrix() == pytest.approx(exact, abs=3e-12)


@EXAMPLES
@given(
    vector.filter(lambda v: np.linalg.norm(v) > 1e-3),
    vector.filter(lambda v: np.linalg.norm(v) > 1e-3),
)
def test_the_smallest_rotation_turns_one_direction_onto_the_other(a, b):
    R = rotation_between(a, b)
    assert R @ a / np.linalg.norm(a) == pytest.approx(b / np.linalg.norm(b), abs=1e-12)
    assert R @ R.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.norm(rotation_log(R)) == pytest.approx(angle_between(a, b), abs=1e-9)


def test_the_smallest_rotation_does_not_jump_at_a_right_angle():
    start = np.array([0.0, 0.0, -1.0])
    before, after = (
        rotation_between(start, [np.sin(t) * 0.6, np.sin(t) * 0.8, -np.cos(t)])
        for t in (0.5 * np.pi - 1e-9, 0.5 * np.pi + 1e-9)
    )
    assert before == pytest.approx(after, abs=1e-8)


@pytest.mark.parametrize("direction", [*np.eye(3), *-np.eye(3), np.array([1.0, 1.0, 1.0])])
@pytest.mark.parametrize("offset", [0.0, 1e-16, 1e-9, 1e-5])
def test_opposite_directions_are_joined_by_a_rotation_and_not_by_noise(direction, offset):
    end = -direction + offset * np.roll(direction, 1)
    R = rotation_between(direction, end)
    assert np.linalg.det(R) == pytest.approx(1.0)
    assert R @ direction == pytest.approx(
        end / np.linalg.norm(end) * np.linalg.norm(direction), abs=1e-12
    )


def test_arrays_of_points_are_transformed_row_by_row():
    T = RigidTransform.exp([1, 2, 3, 0.1, 0.2, 0.3])
    points = np.arange(12.0).reshape(4, 3)
    assert T @ points == pytest.approx(np.array([T @ p for p in points]))


def test_values_cannot_be_changed():
    T = RigidTransform.identity()
    with pytest.raises(ValueError, match="read-only"):
        T.translation[0] = 1.0


@pytest.mark.parametrize(
    ("rotation", "message"),
    [
        (np.diag([1.0, 1.0, -1.0]), "reflection"),
        (np.eye(3) * 1.1, "orthonormal"),
        (np.full((3, 3), np.nan), "not finite"),
        (np.eye(4), "shape"),
    ],
)
def test_what_is_no_rotation_is_refused_by_name(rotation, message):
    with pytest.raises(NumericalError, match=message):
        RigidTransform(rotation, np.zeros(3))
