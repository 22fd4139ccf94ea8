"""What eyes read off the slices of a control scan."""

import numpy as np

METAL_HU = 1000
"""Brighter than tissue: metal, or bone away from the path."""

NEAR_MM = 6.0
"""Metal further off the planned path than this is not read for."""


def remaining_mm(volume, entry_mm, target_mm) -> float | None:
    """How far the metal ends before the target, along the plan; None where none is seen."""
    entry = np.asarray(entry_mm)
    path = np.asarray(target_mm) - entry
    length = float(np.linalg.norm(path))
    k, j, i = np.nonzero(volume.hu >= METAL_HU)
    offsets = volume.lps_mm(np.column_stack([i, j, k])) - entry
    along = offsets @ path / length
    near = np.linalg.norm(offsets - np.outer(along, path / length), axis=1) < NEAR_MM
    return length - float(along[near].max()) if near.any() else None
