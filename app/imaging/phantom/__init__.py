"""A made-up torso: anatomy from a seed, written as a real DICOM CT series."""

from app.imaging.phantom.anatomy import Anatomy, anatomy
from app.imaging.phantom.series import phantom_series

__all__ = ["Anatomy", "anatomy", "phantom_series"]
