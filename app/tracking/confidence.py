"""How far the true value may be from a measured one; the formulas stand in `core.confidence`."""

from app.core.confidence import chi_square_quantile, covariance_radius

__all__ = ["chi_square_quantile", "covariance_radius"]
