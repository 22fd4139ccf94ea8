"""The rigid transform that takes one set of points closest to another."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.messages import counted, sentence
from app.core.rotation import closest_rotation
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.planning.registration.errors import DegenerateFiducialsError, RegistrationError

FEWEST = 3
LARGEST = 10.0
"""No coordinate lies beyond this [m]: millimetres read as metres are found here."""
THINNEST = 1.0 * MILLIMETRE
"""Points closer than this to one line (root mean square [m]) do not fix the turn about it."""
THINNEST_SHARE = 0.01
"""Nor do points whose distance from it is less than this share of their extent along it."""


@dataclass(frozen=True, slots=True, eq=False)
class RigidFit:
    """Best rigid transform between two sets of points.

    Attributes:
        T_measured_reference: takes reference points to measured ones.
        reference: points as they should be [m], shape (n, 3).
        measured: the same points as they were found [m], shape (n, 3).
        residuals: measured minus transformed reference [m], shape (n, 3).
        weights: of the points, mean 1, shape (n,).
    """

    T_measured_reference: RigidTransform
    reference: FloatArray
    measured: FloatArray
    residuals: FloatArray
    weights: FloatArray

    @property
    def count(self) -> int:
        """Number of points."""
        return len(self.reference)

    @property
    def freedom(self) -> int:
        """Degrees of freedom that are left in the residuals: 3 n - 6."""
        return 3 * self.count - 6

    @property
    def sum_of_squares(self) -> float:
        """Weighted sum of the squared residuals [m²]."""
        return float(self.weights @ np.sum(self.residuals**2, axis=1))

    @property
    def fre(self) -> float:
        """Fiducial registration error: weighted root mean square distance [m].

        How well the points fit each other, not how good the registration is: it does not grow
        with the distance from the points, and hardly depends on where they are.
        """
        return float(np.sqrt(self.sum_of_squares / self.count))


def rigid_fit(
    reference: ArrayLike, measured: ArrayLike, weights: ArrayLike | None = None
) -> RigidFit:
    """Fit measured ≈ R · reference + t, least squares with weights, R a proper rotation.

    See `core.rotation.closest_rotation`.

    Args:
        reference: shape (n, 3) [m], n ≥ 3.
        measured: the same points in the same order, shape (n, 3) [m].
        weights: one positive number per point, proportional to 1 / variance; equal without.

    Raises:
        RegistrationError: if shapes or weights do not fit, or a value is not finite or too large.
        DegenerateFiducialsError: if the points do not fix a rotation.
    """
    x, y = checked_points(reference, "reference"), checked_points(measured, "measured")
    if x.shape != y.shape:
        raise RegistrationError(
            sentence(
                "{reference_points} reference points and {measured_points} measured ones: give "
                "each fiducial once in both",
                reference_points=len(x),
                measured_points=len(y),
            )
        )
    w = _checked_weights(weights, len(x))
    require_spread(x, "reference")
    require_spread(y, "measured")
    rotation = _rotation(x, y, w)
    translation = w @ y / len(y) - rotation @ (w @ x / len(x))
    transform = RigidTransform(rotation, translation)
    return RigidFit(transform, x, y, frozen(y - transform @ x), w)


def _rotation(x: FloatArray, y: FloatArray, w: FloatArray) -> FloatArray:
    dx, dy = x - w @ x / len(x), y - w @ y / len(y)
    rotation, gap = closest_rotation((dx * w[:, None]).T @ dy)
    if gap <= 1e-9:  # 0 for a mirrored regular body
        raise DegenerateFiducialsError(
            sentence(
                "two rotations fit these points equally well: the measured ones look like the "
                "mirror image of the reference; check the order of the points and the signs of "
                "the coordinates"
            )
        )
    return rotation


def checked_points(points: ArrayLike, name: str) -> FloatArray:
    """Return a read-only copy of points [m], shape (n, 3).

    Raises:
        RegistrationError: if it is no list of triples, or a value is not finite or beyond 10 m.
    """
    try:
        array = np.array(points, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise RegistrationError(
            sentence("{name} points are not a list of three numbers each", name=name)
        ) from error
    if array.ndim != 2 or array.shape[1:] != (3,):
        raise RegistrationError(
            sentence(
                "{name} points have shape {array_shape}; (n, 3) is needed",
                name=name,
                array_shape=array.shape,
            )
        )
    for i, point in enumerate(array):
        if not np.isfinite(point).all() or np.abs(point).max() > LARGEST:
            raise RegistrationError(
                sentence(
                    "{name} point {i} is {point} m: finite numbers within ±{largest:g} m "
                    "are needed (millimetres where metres are meant?)",
                    name=name,
                    i=i + 1,
                    point=point.tolist(),
                    largest=LARGEST,
                )
            )
    array.setflags(write=False)
    return array


def require_spread(points: FloatArray, name: str) -> None:
    """Refuse points that do not fix a rotation.

    Raises:
        DegenerateFiducialsError: fewer than three, coincident, or on one line.
    """
    if len(points) < FEWEST:
        raise DegenerateFiducialsError(
            counted(
                "{n} {name} point: a registration needs at least {fewest}, and {fewest_to_check} "
                "to find a wrong one",
                "{n} {name} points: a registration needs at least {fewest}, and {fewest_to_check} "
                "to find a wrong one",
                len(points),
                name=name,
                fewest=FEWEST,
                fewest_to_check=FEWEST + 1,
            )
        )
    values = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    extent, width = (values[:2] / np.sqrt(len(points))).tolist()
    if extent < THINNEST:
        raise DegenerateFiducialsError(
            sentence(
                "the {name} points lie within {extent_mm:.2f} mm of each other: they are "
                "one point; touch fiducials that are far apart",
                name=name,
                extent_mm=extent / MILLIMETRE,
            )
        )
    if width < max(THINNEST, THINNEST_SHARE * extent):
        raise DegenerateFiducialsError(
            sentence(
                "the {name} points lie on one line within {width_mm:.2f} mm: the turn about "
                "it stays unknown; add a fiducial beside the line",
                name=name,
                width_mm=width / MILLIMETRE,
            )
        )


def _checked_weights(weights: ArrayLike | None, count: int) -> FloatArray:
    if weights is None:
        return frozen(np.ones(count))
    array = np.array(weights, dtype=np.float64)
    good = array.shape == (count,) and np.isfinite(array).all() and (array > 0.0).all()
    if not good or array.max() > 1e6 * array.min():
        raise RegistrationError(
            sentence(
                "weights {array}: {count} positive numbers within a factor of 1e6 are needed",
                array=array.tolist(),
                count=count,
            )
        )
    return frozen(array / array.mean())
