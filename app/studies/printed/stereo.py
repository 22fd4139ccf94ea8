"""WRONG ON PURPOSE: the error of a triangulated point as annex D of the thesis prints it."""

import numpy as np

from app.core.arrays import FloatArray


def printed_stereo_error(jacobians: FloatArray, variance_px: float) -> float:
    """E_stereo = √(S₁₁ + S₂₂ + S₃₃) / 3 with the first camera's Σ for both (errata B15 to B18).

    Right is √trace for the 3D RMS, and each camera's own Σ. What the annex's K(1:2,1:1) and
    J = [J₁, J₂]ᵀ would give has no shape that can be computed; the right ones stand in for them.

    Args:
        jacobians: of both pixels by the point [px/m], shape (2, 2, 3).
        variance_px: of the first camera's pixels, per axis [px²].

    Returns:
        E_stereo [m].
    """
    stacked = jacobians.reshape(4, 3)
    spread = np.linalg.inv(stacked.T @ stacked / variance_px)
    return float(np.sqrt(np.trace(spread))) / 3.0
