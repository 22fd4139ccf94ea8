"""How far an estimate is from the truth, by the covariance that it states."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from app.core.arrays import FloatArray
from app.core.confidence import chi_square_quantile, covariance_radius


@dataclass(frozen=True, slots=True, eq=False)
class Deviation:
    """How far an estimate is off, in its own measure.

    Attributes:
        square: Mahalanobis distance squared.
        freedom: number of parameters in it.
        ratios: error over standard deviation, by the parameter's name.
        within: whether the 95 % sphere holds it; None for what is no point.
    """

    square: float
    freedom: int
    ratios: dict[str, float]
    within: bool | None = None

    @classmethod
    def of(
        cls, error: FloatArray, covariance: FloatArray, names: tuple[str, ...], point: bool = False
    ) -> Self:
        """Weigh an error by the covariance that is stated."""
        square = float(error @ np.linalg.solve(covariance, error))
        ratios = dict(zip(names, (error / np.sqrt(np.diag(covariance))).tolist(), strict=True))
        within = float(np.linalg.norm(error)) <= covariance_radius(covariance) if point else None
        return cls(square, len(error), ratios, within)

    @property
    def held(self) -> bool:
        """Return whether the 95 % ellipsoid holds it."""
        return self.square <= chi_square_quantile(0.95, self.freedom)
