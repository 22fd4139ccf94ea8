import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.errors import NumericalError
from app.core.rotation import rotation_exp
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.plan import Plan

FULCRUM = np.array([0.0, 0.16056, 0.090])
LETTERS = {
    "L": (1, 0, 0),
    "R": (-1, 0, 0),
    "P": (0, 1, 0),
    "A": (0, -1, 0),
    "S": (0, 0, 1),
}
angles = st.tuples(*[st.floats(-200.0, 200.0)] * 3)
points = st.tuples(*[st.floats(-500.0, 500.0)] * 3)
orientations = st.sampled_from(list(PatientOrientation))
seeded = settings(derandomize=True, deadline=None, max_examples=60)


@pytest.mark.parametrize(
    ("orientation", "letters"),
    [("supine", "LSA"), ("prone", "RSP"), ("left_down", "ASR"), ("right_down", "PSL")],
)
def test_each_orientation_points_its_three_letters_along_x_y_z(
    orientation: str, letters: str
) -> None:
    rotation = PatientOrientation(orientation).rotation
    images = [rotation @ np.array(LETTERS[letter], dtype=float) for letter in letters]
    np.testing.assert_array_equal(np.array(images), np.eye(3))


@pytest.mark.parametrize("orientation", PatientOrientation)
def test_each_orientation_is_right_handed(orientation: PatientOrientation) -> None:
    rotation = orientation.rotation
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    np.testing.assert_array_equal(rotation @ rotation.T, np.eye(3))


@seeded
@given(orientations, angles, points, points)
def test_the_entry_lands_on_the_fulcrum_for_any_rotation(
    orientation: PatientOrientation,
    angle: tuple[float, float, float],
    entry: tuple[float, float, float],
    step: tuple[float, float, float],
) -> None:
    target = np.add(np.add(entry, step), (600.0, 0.0, 600.0))
    plan = Plan(np.array(entry), target)
    placed = PlacedPlan.of(plan, Placement(orientation, angle), FULCRUM)
    T = placed.T_world_patient
    np.testing.assert_allclose(T @ (plan.entry_mm * 1e-3), FULCRUM, atol=1e-14)
    np.testing.assert_allclose(T @ (plan.target_mm * 1e-3), placed.p_target, atol=1e-14)
    np.testing.assert_allclose(
        placed.p_entry + placed.axis * placed.length, placed.p_target, atol=1e-14
    )
    assert np.linalg.det(T.rotation) == pytest.approx(1.0, abs=1e-12)


def test_the_translation_of_the_thesis_is_wrong_as_soon_as_the_patient_is_turned() -> None:
    plan = Plan((10.0, -90.0, 300.0), (4.0, -31.5, 296.0))
    T = Placement().T_world_patient(plan, FULCRUM)
    printed = FULCRUM - plan.entry_mm * 1e-3
    assert np.linalg.norm(T.rotation @ (plan.entry_mm * 1e-3) + printed - FULCRUM) > 0.1


def test_an_anterior_entry_on_a_supine_patient_is_vertical() -> None:
    plan = Plan((0.0, -100.0, 0.0), (0.0, -20.0, 0.0))
    placed = PlacedPlan.of(plan, Placement(), FULCRUM)
    np.testing.assert_allclose(placed.axis, (0.0, 0.0, -1.0))
    assert placed.tilt == 0.0
    assert placed.length == pytest.approx(0.080)


def test_a_free_rotation_about_one_axis_is_the_familiar_angle() -> None:
    placement = Placement(PatientOrientation.PRONE, (0.0, 30.0, 0.0))
    expected = rotation_exp([0.0, np.pi / 6.0, 0.0]) @ PatientOrientation.PRONE.rotation
    np.testing.assert_allclose(placement.rotation, expected, atol=1e-15)


@seeded
@given(orientations, angles, st.tuples(*[st.floats(-3.0, 3.0)] * 3))
def test_turning_composes_in_the_world(
    orientation: PatientOrientation,
    angle: tuple[float, float, float],
    turn: tuple[float, float, float],
) -> None:
    placement = Placement(orientation, angle)
    expected = rotation_exp(turn) @ placement.rotation
    np.testing.assert_allclose(placement.turned(turn).rotation, expected, atol=1e-12)


@pytest.mark.parametrize("bad", [(np.nan, 0.0, 0.0), (0.0, 0.0), (400.0, 0.0, 0.0)])
def test_a_rotation_that_is_no_rotation_is_refused(bad: tuple[float, float, float]) -> None:
    with pytest.raises(NumericalError, match="rotation_deg"):
        Placement(PatientOrientation.SUPINE, bad)
