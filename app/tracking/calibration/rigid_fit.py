"""The rigid motion that takes one set of points closest to another."""

from app.core.arrays import FloatArray
from app.core.rotation import closest_rotation
from app.core.transform import RigidTransform


def rigid_fit(source: FloatArray, target: FloatArray) -> RigidTransform:
    """T_target_source with the least sum of squared distances, no scale.

    Args:
        source: points [m], shape (n, 3), not all on one line.
        target: the same points elsewhere.
    """
    middle_source, middle_target = source.mean(axis=0), target.mean(axis=0)
    rotation, _ = closest_rotation((source - middle_source).T @ (target - middle_target))
    return RigidTransform(rotation, middle_target - rotation @ middle_source)
