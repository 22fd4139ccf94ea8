"""Hard cases of point-based registration: a bounded answer or a named error, never NaN."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.planning.registration.check import RegistrationCheck
from app.planning.registration.correspondence import better_order, likeness, outlier
from app.planning.registration.errors import DegenerateFiducialsError, RegistrationError
from app.planning.registration.plate import load_plate
from app.planning.registration.points import NamedPoints
from app.planning.registration.rigid import rigid_fit
from app.planning.registration.uncertainty import fiducial_error, inflation, target_error

MM = 1e-3
TRIANGLE = np.array([[0.0, 0.0, 0.0], [0.08, 0.0, 0.0], [0.02, 0.05, 0.0]])
SQUARE = np.array([[0.0, 0, 0], [0.05, 0, 0], [0.05, 0.05, 0], [0, 0.05, 0]])
seeded = settings(derandomize=True, deadline=None, max_examples=80)
coordinates = st.floats(-0.2, 0.2, allow_nan=False)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_fewer_than_three_points_are_refused(count: int) -> None:
    points = np.arange(3.0 * count).reshape(count, 3)
    with pytest.raises(DegenerateFiducialsError, match=f"{count} reference point"):
        rigid_fit(points, points)


@pytest.mark.parametrize("off", [0.0, 1e-9, 0.5 * MM])
def test_points_on_one_line_are_named(off: float) -> None:
    line = np.outer([0.0, 1.0, 2.0, 5.0], [0.02, 0.01, -0.01])
    line[1, 2] += off
    with pytest.raises(DegenerateFiducialsError, match="on one line within"):
        rigid_fit(line, line)


def test_points_that_coincide_are_named() -> None:
    same = np.tile([0.1, 0.2, 0.3], (4, 1))
    with pytest.raises(DegenerateFiducialsError, match="they are one point"):
        rigid_fit(same, same)


def test_good_reference_and_measured_points_on_a_line_are_named() -> None:
    line = np.outer([0.0, 1.0, 2.0], [0.02, 0.01, -0.01])
    with pytest.raises(DegenerateFiducialsError, match="the measured points lie on one line"):
        rigid_fit(TRIANGLE, line)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e300, 11.0])
def test_a_point_that_is_no_place_is_named(value: float) -> None:
    bad = TRIANGLE.copy()
    bad[1, 2] = value
    with pytest.raises(RegistrationError, match="measured point 2 is"):
        rigid_fit(TRIANGLE, bad)


@pytest.mark.parametrize("shape", [(3,), (3, 2), (4, 3), (2, 3, 3)])
def test_points_of_another_shape_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(RegistrationError):
        rigid_fit(TRIANGLE, np.zeros(shape))


@pytest.mark.parametrize("weights", [[1, 1], [1, 0, 1], [1, -1, 1], [1, np.nan, 1], [1, 1e7, 1]])
def test_weights_that_weigh_nothing_are_refused(weights: list[float]) -> None:
    with pytest.raises(RegistrationError, match="weights"):
        rigid_fit(TRIANGLE, TRIANGLE, weights)


def test_the_mirror_image_of_a_regular_body_has_no_best_rotation_and_says_so() -> None:
    body = 0.03 * np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    with pytest.raises(DegenerateFiducialsError, match="mirror image"):
        rigid_fit(body, -body)


@pytest.mark.parametrize("angle", [1e-9, np.pi - 1e-9, np.pi])
def test_tiny_and_half_turns_are_found(angle: float) -> None:
    pose = RigidTransform(rotation_exp([0.0, angle, 0.0]), np.array([0.1, 0.2, 0.3]))
    fit = rigid_fit(TRIANGLE, pose @ TRIANGLE)
    np.testing.assert_allclose(fit.T_measured_reference.matrix(), pose.matrix(), atol=1e-12)


def test_points_without_any_error_promise_a_finite_error_of_nothing() -> None:
    fit = rigid_fit(TRIANGLE, TRIANGLE)
    error = fiducial_error(fit)
    assert 0.0 <= error.lower <= error.rms <= error.upper < 1e-12
    assert np.isfinite(target_error(fit).at([0.0, 0.0, 9.0])).all()


def test_three_points_claim_little() -> None:
    assert inflation(3) == pytest.approx(3.56, abs=0.01)
    assert 1.0 < inflation(300) < 1.02


def test_two_exchanged_points_of_a_square_cannot_be_found_and_the_plate_tells() -> None:
    assert likeness(SQUARE) == pytest.approx(0.0, abs=1e-9)
    turned = rigid_fit(SQUARE, SQUARE[[1, 2, 3, 0]])
    assert turned.fre < 1e-12
    assert better_order(turned, 1 * MM) is None


def test_with_three_points_nobody_is_blamed_alone() -> None:
    bad = TRIANGLE.copy()
    bad[2] += 0.01
    assert outlier(rigid_fit(TRIANGLE, bad), 1 * MM) is None


def test_three_points_with_one_wrong_are_not_trusted() -> None:
    plate = load_plate("stepped-plate")
    points = plate.touch[:3].copy()
    points[2] += 0.02
    found = NamedPoints(("A", "B", "C"), points, np.zeros((3, 3, 3)))
    assert not RegistrationCheck.of(plate, found).trusted


def test_two_wrong_points_are_not_trusted() -> None:
    plate = load_plate("stepped-plate")
    points = plate.touch.copy()
    points[0] += 0.01
    points[4] -= 0.012
    found = NamedPoints(plate.names, points, np.zeros((6, 3, 3)))
    assert not RegistrationCheck.of(plate, found).trusted


def test_touches_in_millimetres_are_refused() -> None:
    plate = load_plate("stepped-plate")
    with pytest.raises(RegistrationError, match="millimetres"):
        NamedPoints(plate.names, plate.touch * 1e3, np.zeros((6, 3, 3)))


@pytest.mark.long("statistics")
@seeded
@given(
    st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=3, max_size=8),
    st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=8, max_size=8),
)
def test_any_points_give_a_proper_rotation_or_a_named_error(
    first: list[tuple[float, float, float]], second: list[tuple[float, float, float]]
) -> None:
    x, y = np.array(first), np.array(second[: len(first)])
    try:
        fit = rigid_fit(x, y)
    except RegistrationError:
        return
    assert np.linalg.det(fit.T_measured_reference.rotation) == pytest.approx(1.0)
    spread = target_error(fit).bounded([0.1, 0.1, 0.1])
    assert np.isfinite(spread).all()
    assert np.linalg.eigvalsh(spread).min() > -1e-12
    better_order(fit, MM)
    outlier(fit, MM)
