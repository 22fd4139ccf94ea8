"""A registration check: touched and picked fiducials of a plate, and what they say of a target.

It asks too whether lengths between fiducials are right, which residuals of a rigid fit hide.
A calibration board whose squares were entered wrongly leaves every residual of the calibration, and
every pair held back, as good as they were: the same wrong ruler measured both. Everything that the
cameras measure later is too long or too short by one factor. Fiducials at known distances tell:

    s = Σ wᵢ·(R·xᵢ)·yᵢ / Σ wᵢ·|xᵢ|²,   sd(s) = σ / √(Σ wᵢ·|xᵢ|²)

with x, y the reference and measured points about their centroids, R of the rigid fit (the best one
does not depend on s) and σ a careful touch's standard deviation per axis.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.confidence import chi_square_quantile, covariance_radius
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.planning.registration.correspondence import Outlier, Reordering, better_order, outlier
from app.planning.registration.errors import RegistrationError
from app.planning.registration.plate import FiducialPlate
from app.planning.registration.points import NamedPoints
from app.planning.registration.rigid import RigidFit, rigid_fit
from app.planning.registration.uncertainty import (
    FiducialError,
    TargetError,
    fiducial_error,
    inflation,
    scatter_beyond,
    shaped_target_error,
    stated_target_error,
    target_error,
)

LARGEST: Final = 0.01
"""A relative error of lengths up to this is no mistake: a plate is not better known."""

_SURE: Final = 3.0
_RARE: Final = 0.999


@dataclass(frozen=True, slots=True)
class Scale:
    """Lengths between measured points over those between reference points.

    Attributes:
        value: 1 is right.
        sd: standard deviation of it by careful touches.
        explains: whether the points fit as careful touches do once lengths are divided by it: one
            misplaced point is no scale.
    """

    value: float
    sd: float
    explains: bool

    @property
    def wrong(self) -> bool:
        """Return whether lengths are wrong by more than `LARGEST`, beyond doubt."""
        return self.explains and abs(self.value - 1.0) > LARGEST + _SURE * self.sd


def scale_of(fit: RigidFit, variance: float) -> Scale:
    """Return the scale of a fit.

    Args:
        fit: of reference to measured points.
        variance: of a careful touch per axis [m²].
    """
    w = fit.weights
    x = (fit.reference - w @ fit.reference / len(w)) @ fit.T_measured_reference.rotation.T
    y = fit.measured - w @ fit.measured / len(w)
    extent = float(w @ np.sum(x * x, axis=1))
    value = float(w @ np.sum(x * y, axis=1)) / extent
    remaining = float(w @ np.sum((y - value * x) ** 2, axis=1))
    limit = chi_square_quantile(_RARE, 3 * len(w) - 7) * variance
    return Scale(value, float(np.sqrt(variance / extent)), remaining <= limit)


LARGEST_SCATTER = 0.99
"""Residuals that a careful touch exceeds this rarely are called too large."""


@dataclass(frozen=True, slots=True, eq=False)
class PointCheck:
    """The plate's fiducials against the same ones found in another frame.

    Attributes:
        names: of the fiducials used.
        fit: plate to that frame.
        fiducial: localisation error from the residuals.
        target: expected error by the residuals, errors as large in every direction.
        shaped: the same, the shape of the errors by the residuals, too; None for fewer than five.
        stated: expected error by the covariances that came with the points, larger by what the
            residuals contradict them; None without.
        contradicted: whether the residuals are larger than those covariances allow.
        shared: variance per axis [m²] of what all points share, by the plate.
        reordering: an order that fits far better; None if the given one is right.
        outlier: one point that does not belong; None.
        tolerance: of a single residual [m].
        scattered: whether the residuals are larger than careful work explains.
        scale: of the lengths between the points; a rigid fit does not show it.
    """

    names: tuple[str, ...]
    fit: RigidFit
    fiducial: FiducialError
    target: TargetError
    shaped: TargetError | None
    stated: TargetError | None
    contradicted: bool
    shared: float
    reordering: Reordering | None
    outlier: Outlier | None
    tolerance: float
    scattered: bool
    scale: Scale

    @property
    def trusted(self) -> bool:
        """Return whether the points are what they are named after; neither scale nor residual is
        wrong.
        """
        if self.scale.wrong:
            return False
        within = bool((np.linalg.norm(self.fit.residuals, axis=1) <= self.tolerance).all())
        return within and self.reordering is None and self.outlier is None

    def bounded(self, point: ArrayLike) -> FloatArray:
        """Covariance [m²] at a point whose 95 % ellipsoid, by chi-square, holds the error.

        By the covariances that came with the points, as long as the residuals bear them out; else
        by the larger of these, made larger, and of what the residuals say. What all points share
        shows in no residual: that is the plate's.
        """
        by_residuals = (self.shaped or self.target).bounded(point)
        spread = by_residuals
        if self.stated is not None:
            spread = self.stated.at(point)
            if self.contradicted:
                spread = max(spread, by_residuals, key=lambda one: float(np.trace(one)))
        return spread + self.shared * np.eye(3)

    @property
    def condition(self) -> str:
        """Return what the figure at the target rests on, for people."""
        shift = (
            sentence(
                "a shift that all share: {sqrt_mm:.2f} mm by the plate",
                sqrt_mm=np.sqrt(self.shared) / MILLIMETRE,
            )
            if self.shared
            else sentence("a shift that all share is not in it")
        )
        if self.stated is not None:
            shape = sentence("errors of each point as stated")
            shape += sentence(", which the residuals exceed") if self.contradicted else ""
        elif self.shaped is not None:
            shape = sentence("shape of the errors by the residuals")
        else:
            shape = sentence("holds for errors that are as large in every direction")
        return f"{shape}; {shift}"


def check_points(
    plate: FiducialPlate, reference: FloatArray, result: NamedPoints, shared: float = 0.0
) -> PointCheck:
    """Check points that were found against the plate's.

    Args:
        plate: gives names, tolerance and the error to expect.
        reference: `plate.touch` or `plate.beads`.
        result: the same fiducials in another frame; some may be left out.
        shared: variance per axis of what all of them share [m²].

    Raises:
        RegistrationError: if a name is not on the plate, or the points fix no rotation.
    """
    fit = rigid_fit(reference[plate.rows(result.names)], result.points)
    tolerance = plate.tolerance_mm * MILLIMETRE
    variance = (plate.localisation_mm * MILLIMETRE) ** 2 / 3.0
    limit = chi_square_quantile(LARGEST_SCATTER, fit.freedom) * variance
    stated, contradicted = _stated(fit, result)
    return PointCheck(
        result.names,
        fit,
        fiducial_error(fit),
        target_error(fit),
        shaped_target_error(fit),
        stated,
        contradicted,
        shared,
        better_order(fit, tolerance),
        outlier(fit, tolerance),
        tolerance,
        fit.sum_of_squares > limit,
        scale_of(fit, variance),
    )


def _stated(fit: RigidFit, result: NamedPoints) -> tuple[TargetError | None, bool]:
    """Error by the points' own covariances, scaled where residuals contradict; and whether so."""
    if not result.stated:
        return None, False
    error = stated_target_error(fit, result.covariances)
    factor, by_chance = scatter_beyond(fit, result.covariances)
    if factor <= by_chance:
        return error, False
    scaled = frozen(error.covariance * factor * inflation(fit.freedom))
    return TargetError(error.centroid, scaled), True


@dataclass(frozen=True, slots=True, eq=False)
class RegistrationAgreement:
    """How far what the screen shows may be from where the needle is, at one point.

    Attributes:
        offset: displacement that was found and is not corrected [m], shape (3,), world.
        covariance: of all that is not known [m²], shape (3, 3), world; by chi-square.
    """

    offset: FloatArray
    covariance: FloatArray

    @property
    def radius(self) -> float:
        """Distance that holds with 95 % at least [m]: the offset found and the sphere round it."""
        return float(np.linalg.norm(self.offset)) + covariance_radius(self.covariance)


@dataclass(frozen=True, slots=True, eq=False)
class RegistrationCheck:
    """One check with a plate.

    Attributes:
        plate: that was used.
        world: touches, T_world_plate.
        patient: picks in a CT, T_patient_plate; None where no CT was used.
    """

    plate: FiducialPlate
    world: PointCheck
    patient: PointCheck | None = None

    @classmethod
    def of(
        cls, plate: FiducialPlate, touched: NamedPoints, picked: NamedPoints | None = None
    ) -> "RegistrationCheck":
        """Check touches, and picks where there are any.

        Raises:
            RegistrationError: if a name is not on the plate, or points fix no rotation.
        """
        world = check_points(plate, plate.touch, touched, (plate.shared_sd_mm * MILLIMETRE) ** 2)
        patient = check_points(plate, plate.beads, picked) if picked is not None else None
        return cls(plate, world, patient)

    @property
    def trusted(self) -> bool:
        """Return whether both parts are."""
        return self.world.trusted and (self.patient is None or self.patient.trusted)

    @property
    def T_world_patient(self) -> RigidTransform | None:
        """Measured registration of the scanned phantom (LPS metres); None without picks."""
        if self.patient is None:
            return None
        T_patient_plate = self.patient.fit.T_measured_reference
        return self.world.fit.T_measured_reference @ T_patient_plate.inverse()

    def spread(self, p_world: ArrayLike) -> FloatArray:
        """Covariance [m²] at a point whose 95 % ellipsoid holds the error, shape (3, 3), world.

        With picks that of the measured T_world_patient: the touches' and the picks' errors add.
        """
        return self._summed(p_world, PointCheck.bounded)

    def expected(self, p_world: ArrayLike) -> FloatArray:
        """Covariance of the error that the residuals let expect at a point [m²], shape (3, 3)."""
        return self._summed(p_world, lambda part, point: (part.shaped or part.target).at(point))

    def _summed(
        self, p_world: ArrayLike, of: Callable[[PointCheck, FloatArray], FloatArray]
    ) -> FloatArray:
        point = frozen(p_world, (3,), "target")
        covariance = of(self.world, point)
        T_world_patient = self.T_world_patient
        if self.patient is None or T_world_patient is None:
            return covariance
        rotation = T_world_patient.rotation
        inside = of(self.patient, T_world_patient.inverse() @ point)
        result: FloatArray = covariance + rotation @ inside @ rotation.T
        return result

    def agreement(
        self,
        p_world: ArrayLike,
        tip_covariance: ArrayLike | None = None,
        T_world_patient: RigidTransform | None = None,
    ) -> RegistrationAgreement:
        """Return how well screen and needle agree at a point.

        Args:
            p_world: the target, where the program believes it [m], shape (3,).
            tip_covariance: of the tracked tip [m²], shape (3, 3), calibration included.
            T_world_patient: that the screen uses. With it, and picks, the offset is that from the
                measured one; else from the plate's known place.

        Raises:
            RegistrationError: if the points cannot be trusted, or there is nothing to compare
                with: a plate without a known place, and no picks.
        """
        if not self.trusted:
            raise RegistrationError(
                sentence(
                    "the points do not fit the plate, so nothing can be said of the target; see "
                    "the residuals, touch the named fiducials again"
                )
            )
        point = frozen(p_world, (3,), "target")
        tip = np.zeros((3, 3)) if tip_covariance is None else frozen(tip_covariance, (3, 3), "tip")
        measured, used, own = self.T_world_patient, T_world_patient, 0.0
        if measured is None or used is None:
            if self.plate.place is None:
                raise RegistrationError(
                    sentence(
                        "plate {plate_name} has no known place in the robot's frame and no beads "
                        "were picked: the touches have nothing to agree with; give `place`, or "
                        "pick the beads in the CT",
                        plate_name=self.plate.name,
                    )
                )
            measured, used = self.world.fit.T_measured_reference, self.plate.place.transform
            own = (self.plate.place_sd_mm * MILLIMETRE) ** 2
        offset = measured @ (used.inverse() @ point) - point
        return RegistrationAgreement(
            frozen(offset), frozen(self.spread(point) + tip + own * np.eye(3))
        )
