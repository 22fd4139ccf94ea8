"""The rigid motion that takes one set of points closest to another."""

import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform


def rigid_fit(source: FloatArray, target: FloatArray) -> RigidTransform:
    """T_target_source with the least sum of squared distances (Kabsch 1976), no scale.

    Args:
        source: points [m], shape (n, 3), not all on one line.
        target: the same points elsewhere.
    """
    middle_source, middle_target = source.mean(axis=0), target.mean(axis=0)
    u, _, vt = np.linalg.svd((source - middle_source).T @ (target - middle_target))
    proper = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt)) or 1.0])
    rotation = (u @ proper @ vt).T
    return RigidTransform(rotation, middle_target - rotation @ middle_source)
