"""From the residuals of a fit to the error of a fiducial, and to the error at any other point.

Model: measured_i = R · reference_i + t + n_i, n_i independent, normal, of variance σ² / weight_i in
every axis. To first order the error of the fit is a twist (τ, ω) about the weighted centroid c,

    τ = Σ w n / Σ w,      ω = M⁻¹ Σ w q × n,      q = R reference - c,   M = Σ w (|q|² I - q qᵀ),

so that a point p is off by τ + ω × (p - c), whose covariance is σ² (I / Σ w + [d]ₓ M⁻¹ [d]ₓᵀ),
d = p - c. Its trace for equal weights is Fitzpatrick, West and Maurer's (IEEE Trans. Med. Imaging
17, 694, 1998): ⟨TRE²⟩ = ⟨FLE²⟩ / N · (1 + ⅓ Σ d_k² / f_k²), with FLE² = 3 σ², d_k the distance of p
from principal axis k of the fiducials and f_k the fiducials' root mean square distance from it. The
residuals are independent of the twist and have 3 N - 6 degrees of freedom, so that
⟨FRE²⟩ = (1 - 2 / N) ⟨FLE²⟩ (Sibson 1979).

All of this is for errors that are as large in every direction. Those of touches are not: cameras
see badly along their view, a needle slides along its shaft. Where covariances come with the points
they tell the shape; otherwise residuals of five points or more do, roughly (`shaped_target_error`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.confidence import chi_square_quantile, f_quantile
from app.core.rotation import skew
from app.planning.registration.rigid import RigidFit


@dataclass(frozen=True, slots=True)
class FiducialError:
    """Fiducial localisation error, estimated from the residuals.

    Attributes:
        rms: root mean square 3D error of one fiducial [m]; √3 times that of one axis.
        lower, upper: the true one lies between these with 95 % [m].
        freedom: degrees of freedom of the estimate, 3 N - 6.
    """

    rms: float
    lower: float
    upper: float
    freedom: int


def fiducial_error(fit: RigidFit, probability: float = 0.95) -> FiducialError:
    """Estimate the localisation error, unbiased in the square: FLE² = FRE² N / (N - 2).

    The sum of squares over σ² is chi-square with 3 N - 6 degrees of freedom, which gives the
    interval; with three fiducials its ends are a factor of 6.6 apart.
    """
    total, freedom = 3.0 * fit.sum_of_squares, fit.freedom
    tail = 0.5 * (1.0 - probability)
    return FiducialError(
        float(np.sqrt(total / freedom)),
        float(np.sqrt(total / chi_square_quantile(1.0 - tail, freedom))),
        float(np.sqrt(total / chi_square_quantile(tail, freedom))),
        freedom,
    )


@dataclass(frozen=True, slots=True, eq=False)
class TargetError:
    """Target registration error that is expected of a fit, at any point.

    Attributes:
        centroid: weighted centroid of the transformed reference points [m], shape (3,).
        covariance: of the twist about the centroid (translation [m], rotation vector [rad]),
            shape (6, 6).
        freedom: degrees of freedom behind the scale of `covariance`; 0 where it is known.
    """

    centroid: FloatArray
    covariance: FloatArray
    freedom: int = 0

    def at(self, point: ArrayLike) -> FloatArray:
        """Covariance of the error at a point of the measured frame [m²], shape (3, 3)."""
        jacobian = np.hstack([np.eye(3), -skew(frozen(point, (3,), "target") - self.centroid)])
        result: FloatArray = jacobian @ self.covariance @ jacobian.T
        return result

    def rms(self, point: ArrayLike) -> float:
        """Root mean square error at a point [m]: the figure that papers call TRE."""
        return float(np.sqrt(np.trace(self.at(point))))

    def bounded(self, point: ArrayLike, probability: float = 0.95) -> FloatArray:
        """Covariance whose ellipsoid, taken by chi-square, holds the error with `probability`.

        The scale σ² is itself an estimate, so that the ellipsoid follows from F(3, 3 N - 6): this
        is `at` times 3 F / χ²: 3.6 for three fiducials, 1.3 for six.
        """
        return self.at(point) * inflation(self.freedom, probability)


def inflation(freedom: int, probability: float = 0.95) -> float:
    """Factor on a covariance of estimated scale that makes up for the estimate's own error."""
    if not freedom:
        return 1.0
    return 3.0 * f_quantile(probability, 3, freedom) / chi_square_quantile(probability, 3)


def target_error(fit: RigidFit) -> TargetError:
    """Return the error to expect, its scale taken from the residuals."""
    levers, centroid = _levers(fit)
    variance = fit.sum_of_squares / fit.freedom
    return TargetError(
        centroid, frozen(variance * np.linalg.inv(_information(levers, fit))), fit.freedom
    )


FEWEST_FOR_SHAPE = 5
"""Points from which on residuals say in which directions the errors are larger."""


def shaped_target_error(fit: RigidFit) -> TargetError | None:
    """Return the error to expect, scale and shape taken from the residuals.

    All points err by one covariance S, of any shape. The residuals' products are linear in it,

        Σ r rᵀ = Σ (S - S Jᵢ A Jᵢᵀ - Jᵢ A Jᵢᵀ S + Jᵢ A (Σ Jₖᵀ S Jₖ) A Jᵢᵀ),  A = (Σ Jᵢᵀ Jᵢ)⁻¹,

    which is solved for S. There are N - 2 residuals for each direction and they count as so many
    degrees of freedom; one more, as large in every direction, keeps S from being flat by chance.

    Returns:
        None for fewer than five points: two or one residual for a direction tell no shape.
    """
    if fit.count < FEWEST_FOR_SHAPE:
        return None
    levers, _ = _levers(fit)
    jacobians = [_point_jacobian(lever) for lever in levers]
    inverse = np.linalg.inv(_information(levers, fit))

    def products(spread: FloatArray) -> FloatArray:
        twist = inverse @ sum(J.T @ spread @ J for J in jacobians) @ inverse
        total = np.zeros((3, 3))
        for J in jacobians:
            followed = spread @ J @ inverse @ J.T
            total += spread - followed - followed.T + J @ twist @ J.T
        return total

    upper = np.triu_indices(3)
    bases = []
    for i, j in zip(*upper, strict=True):
        basis = np.zeros((3, 3))
        basis[i, j] = basis[j, i] = 1.0
        bases.append(basis)
    matrix = np.column_stack([products(basis)[upper] for basis in bases])
    seen = (fit.residuals.T @ fit.residuals)[upper]
    spread = sum(c * basis for c, basis in zip(np.linalg.solve(matrix, seen), bases, strict=True))
    values, vectors = np.linalg.eigh(spread)
    known = fit.count - 2
    even = fit.sum_of_squares / fit.freedom * np.eye(3)
    shape = (known * (vectors * np.maximum(values, 0.0)) @ vectors.T + even) / (known + 1)
    error = stated_target_error(fit, np.tile(shape, (fit.count, 1, 1)))
    return TargetError(error.centroid, error.covariance, known)


def scatter_beyond(fit: RigidFit, covariances: FloatArray) -> tuple[float, float]:
    """Return by what factor residuals scatter more than stated covariances say, and by chance.

    The residuals are (I - J A Jᵀ W) times the points' errors; weighed by the covariance that this
    gives them their square is chi-square with 3 N - 6 degrees of freedom.

    Args:
        fit: of the points.
        covariances: stated, shape (n, 3, 3) [m²].

    Returns:
        Mean square over what it should be, and what it stays below in 95 of 100 fits.
    """
    levers, _ = _levers(fit)
    jacobian = np.vstack([_point_jacobian(lever) for lever in levers])
    weights = np.repeat(fit.weights, 3)
    keep = np.eye(len(weights)) - jacobian @ np.linalg.inv(_information(levers, fit)) @ (
        jacobian.T * weights
    )
    stated = np.zeros_like(keep)
    for i, spread in enumerate(covariances):
        stated[3 * i : 3 * i + 3, 3 * i : 3 * i + 3] = spread
    values, vectors = np.linalg.eigh(keep @ stated @ keep.T)
    residual = vectors[:, -fit.freedom :].T @ fit.residuals.ravel()
    square = float(np.sum(residual**2 / values[-fit.freedom :]))
    return square / fit.freedom, chi_square_quantile(0.95, fit.freedom) / fit.freedom


def stated_target_error(fit: RigidFit, covariances: ArrayLike) -> TargetError:
    """Return the error that follows from stated covariances of the points.

    Args:
        fit: with any weights; they need not be those that the covariances ask for.
        covariances: of each measured point [m²], shape (n, 3, 3); those of the reference points,
            turned by the fit's rotation, are added by whoever has them.
    """
    spreads = frozen(covariances, (fit.count, 3, 3), "covariances")
    levers, centroid = _levers(fit)
    inverse = np.linalg.inv(_information(levers, fit))
    middle = np.zeros((6, 6))
    for lever, spread, weight in zip(levers, spreads, fit.weights, strict=True):
        jacobian = _point_jacobian(lever)
        middle += weight**2 * jacobian.T @ spread @ jacobian
    return TargetError(centroid, frozen(inverse @ middle @ inverse))


def _levers(fit: RigidFit) -> tuple[FloatArray, FloatArray]:
    points = fit.T_measured_reference @ fit.reference
    centroid = fit.weights @ points / fit.count
    return points - centroid, frozen(centroid)


def _information(levers: FloatArray, fit: RigidFit) -> FloatArray:
    total = np.zeros((6, 6))
    for lever, weight in zip(levers, fit.weights, strict=True):
        jacobian = _point_jacobian(lever)
        total += weight * jacobian.T @ jacobian
    return total


def _point_jacobian(lever: FloatArray) -> FloatArray:
    """Displacement of a point by a twist about the centroid, shape (3, 6)."""
    return np.hstack([np.eye(3), -skew(lever)])
