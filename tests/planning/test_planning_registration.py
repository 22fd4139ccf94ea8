"""Rigid registration: the fit, the estimate of the fiducials' error, the error at a target."""

from pathlib import Path

import numpy as np
import pytest

from app.core.arrays import FloatArray
from app.core.confidence import chi_square_quantile, f_quantile
from app.core.errors import ConfigurationError
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.planning.registration.check import RegistrationCheck
from app.planning.registration.errors import RegistrationError
from app.planning.registration.plate import FiducialPlate, load_plate, plate_names
from app.planning.registration.points import NamedPoints, read_points
from app.planning.registration.record import FoundPoint, RegistrationRecord, Registrations
from app.planning.registration.rigid import rigid_fit
from app.planning.registration.uncertainty import fiducial_error, stated_target_error, target_error
from app.planning.registration.words import (
    NOT_CHECKED,
    student_line,
    target_line,
    technician_lines,
    troubles,
)

MM = 1e-3
POSE = RigidTransform(rotation_exp(np.array([0.4, -1.1, 2.0])), np.array([0.1, -0.2, 0.3]))
SPREADS = {
    "four corners": [[0, 0, 0], [80, 0, 0], [0, 50, 10], [70, 60, 0]],
    "three on a thin triangle": [[0, 0, 0], [100, 0, 0], [50, 12, 0]],
    "nearly a line": [[0, 0, 0], [30, 1, 2], [60, -2, 1], [100, 3, -2], [120, -4, 0]],
    "twelve in a box": np.random.default_rng(5).uniform(0, 100, (12, 3)).tolist(),
}


def corners(name: str) -> FloatArray:
    return np.array(SPREADS[name], dtype=float) * MM


def touches(plate: FiducialPlate, pose: RigidTransform, sd: float, seed: int = 1) -> NamedPoints:
    rng = np.random.default_rng(seed)
    points = pose @ plate.touch + sd * rng.standard_normal(plate.touch.shape)
    return NamedPoints(plate.names, points, np.zeros((len(points), 3, 3)))


@pytest.mark.parametrize("name", SPREADS)
def test_exact_points_give_the_exact_transform(name: str) -> None:
    fit = rigid_fit(corners(name), POSE @ corners(name))
    np.testing.assert_allclose(fit.T_measured_reference.matrix(), POSE.matrix(), atol=1e-12)
    assert fit.fre < 1e-15


def test_no_small_turn_or_shift_fits_better() -> None:
    rng = np.random.default_rng(3)
    x, weights = corners("twelve in a box"), rng.uniform(0.2, 3.0, 12)
    y = POSE @ x + 0.004 * rng.standard_normal(x.shape)
    fit = rigid_fit(x, y, weights)
    for twist in 1e-4 * rng.standard_normal((50, 6)):
        other = RigidTransform.exp(twist) @ fit.T_measured_reference
        squares = fit.weights @ np.sum((y - other @ x) ** 2, axis=1)
        assert squares > fit.sum_of_squares


def test_a_point_of_small_weight_hardly_counts() -> None:
    x = corners("twelve in a box")
    y = POSE @ x
    y[4] += 0.02
    weights = np.where(np.arange(12) == 4, 1e-5, 1.0)
    fit = rigid_fit(x, y, weights)
    assert np.abs(fit.T_measured_reference.matrix() - POSE.matrix()).max() < 1e-5


def test_a_mirror_image_is_never_fitted_by_a_reflection() -> None:
    x = corners("twelve in a box")
    fit = rigid_fit(x, POSE @ (x * [1.0, 1.0, -1.0]))
    assert np.linalg.det(fit.T_measured_reference.rotation) == pytest.approx(1.0)
    assert fit.fre > 10 * MM


@pytest.mark.parametrize("name", SPREADS)
def test_the_predicted_error_is_fitzpatricks_formula(name: str) -> None:
    x = corners(name)
    rng = np.random.default_rng(7)
    fit = rigid_fit(x, x + 0.5 * MM * rng.standard_normal(x.shape))
    point = np.array([0.05, 0.12, -0.07])
    placed = fit.T_measured_reference @ x
    centre = placed.mean(axis=0)
    axes = np.linalg.svd(placed - centre)[2]

    def squares(p: FloatArray) -> FloatArray:
        """Squared distances from each principal axis, shape (..., 3)."""
        along = (p - centre) @ axes.T
        return np.sum(along**2, axis=-1, keepdims=True) - along**2

    ratio = squares(point) / squares(placed).mean(axis=0)
    fle = fiducial_error(fit).rms
    expected = fle**2 / len(x) * (1.0 + ratio.sum() / 3.0)
    assert target_error(fit).rms(point) ** 2 == pytest.approx(expected, rel=1e-9)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", SPREADS)
def test_monte_carlo_agrees_with_error_estimate_and_prediction(name: str) -> None:
    """FLE is unbiased in the square, TRE has the right covariance, 95 % ellipsoids hold 95 %."""
    x, sigma, point = corners(name), 0.02 * MM, np.array([0.04, 0.06, -0.08])
    rng = np.random.default_rng(11)
    n, trials = len(x), 2500
    squares, errors, inside, covered = [], [], 0, 0
    truth = POSE @ point
    limit = 3.0 * f_quantile(0.95, 3, 3 * n - 6)
    for noise in sigma * rng.standard_normal((trials, n, 3)):
        fit = rigid_fit(x, POSE @ x + noise)
        found = fiducial_error(fit)
        squares.append(found.rms**2)
        covered += found.lower < np.sqrt(3) * sigma < found.upper
        error = fit.T_measured_reference @ point - truth
        errors.append(error)
        inside += error @ np.linalg.solve(target_error(fit).at(truth), error) < limit
    assert np.mean(squares) == pytest.approx(3 * sigma**2, rel=0.05)
    assert covered / trials == pytest.approx(0.95, abs=0.013)
    assert inside / trials == pytest.approx(0.95, abs=0.013)
    exact = rigid_fit(x, POSE @ x)
    predicted = stated_target_error(exact, np.tile(sigma**2 * np.eye(3), (n, 1, 1))).at(truth)
    spread = np.cov(np.array(errors).T)
    assert np.abs(spread - predicted).max() < 0.08 * np.trace(predicted)


def test_the_inflated_covariance_is_the_f_ellipsoid() -> None:
    x = corners("four corners")
    fit = rigid_fit(x, POSE @ x + 1e-4 * np.random.default_rng(2).standard_normal(x.shape))
    error = target_error(fit)
    ratio = error.bounded(np.zeros(3))[0, 0] / error.at(np.zeros(3))[0, 0]
    assert ratio * chi_square_quantile(0.95, 3) == pytest.approx(3 * 4.757, rel=1e-3)  # F(3, 6)


@pytest.mark.long("statistics")
def test_unequal_covariances_are_carried_to_the_target() -> None:
    x, rng, trials = corners("twelve in a box"), np.random.default_rng(17), 3000
    roots = 1e-4 * rng.uniform(-1, 1, (12, 3, 3))
    spreads = roots @ roots.transpose(0, 2, 1)
    weights = 1.0 / np.trace(spreads, axis1=1, axis2=2)
    point = np.array([0.0, 0.1, 0.2])
    errors = [
        rigid_fit(x, x + np.einsum("nij,nj->ni", roots, noise), weights).T_measured_reference
        @ point - point
        for noise in rng.standard_normal((trials, 12, 3))
    ]  # fmt: skip
    predicted = stated_target_error(rigid_fit(x, x, weights), spreads).at(point)
    assert np.abs(np.cov(np.array(errors).T) - predicted).max() < 0.1 * np.trace(predicted)


@pytest.mark.parametrize("name", plate_names())
def test_every_shipped_plate_finds_two_exchanged_points(name: str) -> None:
    plate = load_plate(name)
    assert plate.likeness > 5 * plate.localisation_mm * MM
    for i in range(len(plate.names)):
        for j in range(i):
            order = list(plate.names)
            order[i], order[j] = order[j], order[i]
            found = touches(plate, POSE, 0.2 * MM)
            check = RegistrationCheck.of(
                plate, NamedPoints(tuple(order), found.points, found.covariances)
            )
            line = troubles(check)[0]
            assert not check.trusted
            assert f" {order[i]} " in line
            assert f" {order[j]} " in line
            assert "another order" in line


def test_one_wrong_point_is_named_with_its_distance() -> None:
    plate = load_plate("stepped-plate")
    found = touches(plate, POSE, 0.1 * MM)
    points = found.points.copy()
    points[3] += POSE.rotate(np.array([0.0, 0.0, 6.0 * MM]))
    check = RegistrationCheck.of(plate, NamedPoints(found.names, points, found.covariances))
    assert check.world.outlier is not None
    assert check.world.outlier.index == 3
    assert check.world.outlier.distance == pytest.approx(6 * MM, rel=0.15)
    assert "fiducial D lies" in troubles(check)[0]
    with pytest.raises(RegistrationError, match="nothing can be said of the target"):
        check.agreement(np.zeros(3))


@pytest.mark.long("statistics")
def test_good_points_are_not_blamed() -> None:
    plate = load_plate("stepped-plate")
    sd = plate.localisation_mm * MM / np.sqrt(3)
    checks = [RegistrationCheck.of(plate, touches(plate, POSE, sd, seed)) for seed in range(200)]
    assert all(check.trusted for check in checks)
    assert np.mean([check.world.scattered for check in checks]) < 0.03


def test_a_check_says_how_far_the_cameras_frame_is_off() -> None:
    plate = load_plate("stepped-plate")
    assert plate.place is not None
    shifted = RigidTransform.from_translation(np.array([1.5 * MM, 0, 0])) @ plate.place.transform
    check = RegistrationCheck.of(plate, touches(plate, shifted, 0.05 * MM))
    target = np.array([0.0, 0.16, 0.03])
    agreement = check.agreement(target, (0.1 * MM) ** 2 * np.eye(3))
    np.testing.assert_allclose(agreement.offset, [1.5 * MM, 0, 0], atol=0.2 * MM)
    assert agreement.radius > 1.5 * MM
    assert student_line(agreement) == (
        f"screen and needle agree within ± {agreement.radius / MM:.1f} mm (95 %)"
    )


@pytest.mark.long("statistics")
def test_the_agreement_holds_in_95_of_100_checks() -> None:
    plate, target = load_plate("stepped-plate"), np.array([0.0, 0.16, 0.03])
    assert plate.place is not None
    rng = np.random.default_rng(23)
    held = 0
    for seed in range(300):
        tip = 0.1 * MM * rng.standard_normal(3)
        noise = RigidTransform.from_translation(plate.place_sd_mm * MM * rng.standard_normal(3))
        pose = noise @ plate.place.transform
        check = RegistrationCheck.of(plate, touches(plate, pose, 0.3 * MM, seed))
        agreement = check.agreement(target, (0.1 * MM) ** 2 * np.eye(3))
        error = tip + pose @ (plate.place.transform.inverse() @ target) - target
        held += np.linalg.norm(error) <= agreement.radius
    assert held / 300 >= 0.95


def test_picks_in_a_ct_measure_where_the_patient_is() -> None:
    plate = load_plate("stepped-plate")
    T_patient_plate = RigidTransform(rotation_exp([0.1, 0.0, -0.3]), np.array([0.02, -0.1, 0.4]))
    beads = T_patient_plate @ plate.beads
    picked = NamedPoints(plate.names, beads, np.zeros((6, 3, 3)))
    check = RegistrationCheck.of(plate, touches(plate, POSE, 0.05 * MM), picked)
    T_world_patient = check.T_world_patient
    assert T_world_patient is not None
    np.testing.assert_allclose(T_world_patient @ beads, POSE @ plate.beads, atol=0.2 * MM)
    agreement = check.agreement(POSE @ plate.beads[0], T_world_patient=T_world_patient)
    np.testing.assert_allclose(agreement.offset, 0.0, atol=1e-12)
    assert 0 < agreement.radius < 1 * MM


def test_without_a_check_no_figure_is_named() -> None:
    assert student_line(None) == NOT_CHECKED
    assert not any(character.isdigit() for character in NOT_CHECKED)


def test_the_students_sentence_never_names_the_residual() -> None:
    plate = load_plate("stepped-plate")
    assert plate.place is not None
    check = RegistrationCheck.of(plate, touches(plate, plate.place.transform, 0.2 * MM))
    target = np.array([0.0, 0.16, 0.03])
    assert "FRE" not in student_line(check.agreement(target))
    assert any("not accuracy" in line for line in technician_lines(check))
    assert target_line(check, target).startswith("TRE at the target")


def test_points_come_from_csv_and_yaml(tmp_path: Path) -> None:
    csv = tmp_path / "touched.csv"
    csv.write_text("name,x_mm,y_mm,z_mm,sd_mm\nA,1,2,3,0.2\nB, 4, 5, 6,\n")
    found = read_points(csv)
    assert found.names == ("A", "B")
    np.testing.assert_allclose(found.points, [[0.001, 0.002, 0.003], [0.004, 0.005, 0.006]])
    assert found.covariances[0, 1, 1] == pytest.approx(4e-8)
    assert not found.stated
    plain = tmp_path / "touched.yaml"
    plain.write_text("A: [1, 2, 3]\nB: [4, 5, 6]\n")
    np.testing.assert_allclose(read_points(plain).points, found.points)


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("name,x_mm,y_mm\nA,1,2\n", "column z_mm is missing"),
        ("name,x_mm,y_mm,z_mm\nA,1,2,three\n", "line 2: 'three' is not a number"),
        ("name,x_mm,y_mm,z_mm\nA,1,2,nan\n", "'nan' is not finite"),
        ("name,x_mm,y_mm,z_mm\n", "holds no points"),
        ("name,x_mm,y_mm,z_mm\nA,1,2,3\nA,1,2,3\n", "'A' is given twice"),
        ("name,x_mm,y_mm,z_mm\nA,1,2,30000\n", "millimetres where metres"),
    ],
)
def test_a_bad_file_of_points_is_named(tmp_path: Path, text: str, what: str) -> None:
    path = tmp_path / "touched.csv"
    path.write_text(text)
    with pytest.raises(RegistrationError, match=what):
        read_points(path)


def test_a_saved_check_gives_the_same_figures(tmp_path: Path) -> None:
    from datetime import UTC, datetime

    plate = load_plate("stepped-plate")
    found = touches(plate, POSE, 0.3 * MM)
    spreads = np.tile(1e-8 * np.eye(3), (6, 1, 1))
    found = NamedPoints(found.names, found.points, spreads)
    record = RegistrationRecord(
        id="20261122-081200-aaaa",
        created=datetime(2026, 11, 22, 8, 12, tzinfo=UTC),
        plate=plate,
        touched=FoundPoint.all_of(found),
        calibration="c1",
        rig="wide",
    )
    folder = Registrations(tmp_path)
    folder.save(record)
    again = folder.newest("c1", "wide", simulated=False)
    assert again == record
    assert again.check().world.fit.fre == pytest.approx(
        RegistrationCheck.of(plate, found).world.fit.fre, rel=1e-9
    )
    assert folder.newest("c2", "wide", simulated=False) is None
    assert folder.newest("c1", "wide", simulated=True) is None
    points = FoundPoint.all_of(found)
    marked = record.model_copy(update={"picked": points, "series": "CT-1", "frame": "f1"})
    folder.save(marked)
    same = {"calibration": "c1", "rig": "wide", "simulated": False, "series": "CT-1"}
    assert folder.newest(**same, frame="f1") == marked
    assert folder.newest(**same) == marked  # a record of before that does not say it
    assert folder.newest(**same, frame="f2") is None  # the same patient, other coordinates


def test_an_unknown_plate_names_the_valid_ones() -> None:
    with pytest.raises(ConfigurationError, match="stepped-plate"):
        load_plate("square")


def test_a_list_of_points_that_is_no_text_or_not_there_is_named_once(tmp_path):
    picture = tmp_path / "left01.jpg"
    picture.write_bytes(b"\xff\xd8\xff\xe0")
    with pytest.raises(RegistrationError, match="is no text; give a CSV file"):
        read_points(picture)
    with pytest.raises(RegistrationError, match=r"No such file or directory$"):
        read_points(tmp_path / "nope.csv")
