"""Where things lie in a phantom patient: the truth that exercises and tests compare with."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.imaging.phantom import organs, skeleton
from app.imaging.phantom.lesion import make_patient, planned_patient
from app.imaging.phantom.patient import MODEL_TOP, Patient, Point
from app.imaging.phantom.shapes import Field, union
from app.imaging.phantom.tubes import Tubes, joined
from app.imaging.phantom.vessels import vasculature


@dataclass(frozen=True, slots=True)
class Anatomy:
    """Truth of a phantom patient, LPS [mm].

    Attributes:
        seed: which patient.
        lesion_mm: centre of the liver lesion: the default target.
        lesion_radius_mm: its mean radius.
        entry_mm: on the skin: a default entry whose straight path to the lesion passes between
            the ribs, meets neither lung nor gut nor large vessels, is 60 to 90 mm long and at most
            30° off the vertical of a supine patient.
        organs: a point inside each named organ; the `lung nodule` of a patient who has one.
    """

    seed: int
    lesion_mm: Point
    lesion_radius_mm: float
    entry_mm: Point
    organs: Mapping[str, Point]


def anatomy(seed: int) -> Anatomy:
    """Return the truth of the patient of a seed."""
    patient, entry = planned_patient(seed)
    scale = patient.scale
    inside = _ORGANS if patient.nodule is None else _ORGANS | {"lung nodule": patient.nodule[0]}
    mean_scale = (scale[0] * scale[1] * scale[2]) ** (1.0 / 3.0)
    return Anatomy(
        seed=seed,
        lesion_mm=_lps(patient, patient.lesion_mm),
        lesion_radius_mm=patient.lesion_radius_mm * mean_scale,
        entry_mm=_lps(patient, entry),
        organs=MappingProxyType({name: _lps(patient, at) for name, at in inside.items()}),
    )


_ORGANS: Final[dict[str, Point]] = {
    "liver": (-100.0, 10.0, 190.0),
    "right kidney": (-76.0, 44.0, 118.0),
    "left kidney": (76.0, 44.0, 132.0),
    "spleen": (112.0, 45.0, 200.0),
    "aorta": (6.0, -1.0, 165.0),
    "vena cava": (-19.0, 2.0, 140.0),
    "right lung": (-80.0, 40.0, 285.0),
    "left lung": (90.0, 40.0, 285.0),
    "spine": (0.0, 27.0, 168.0),
}


def _lps(patient: Patient, model: Point) -> Point:
    x, y, z = (m * s for m, s in zip(model, patient.scale, strict=True))
    return x, y, z


_Box = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]
_BOXES: Final[Mapping[str, _Box]] = {
    "liver": ((-165.0, 100.0), (-118.0, 98.0), (90.0, 310.0)),
    "heart": ((-50.0, 100.0), (-100.0, 25.0), (235.0, 310.0)),
    "stomach": ((-30.0, 140.0), (-95.0, 45.0), (130.0, 265.0)),
    "spleen": ((40.0, 165.0), (-40.0, 95.0), (140.0, 265.0)),
    "kidneys": ((-115.0, 115.0), (0.0, 95.0), (55.0, 235.0)),
    "gallbladder": ((-72.0, -14.0), (-85.0, 10.0), (120.0, 196.0)),
    "cartilage": ((-150.0, 150.0), (-118.0, 40.0), (180.0, 310.0)),
    "pancreas": ((-52.0, 92.0), (-45.0, 60.0), (125.0, 210.0)),
}
"""Where each organ lies at most, model coordinates."""


def organ_fields(seed: int, step_mm: float) -> dict[str, tuple[NDArray[np.float32], FloatArray]]:
    """Return how deep points lie in the organs of the patient of a seed, for their surfaces.

    Args:
        seed: of the patient.
        step_mm: distance between points, in model coordinates.

    Returns:
        By the organ's name its field, shape (K, J, I), positive inside [mm] and negative at the
        edges, and the affine (i, j, k) → LPS [mm], shape (4, 4).
    """
    patient = make_patient(seed)
    x, y, z = patient.lesion_mm
    r = patient.lesion_radius_mm + 4.0
    boxes = dict(_BOXES) | {"lesion": ((x - r, x + r), (y - r, y + r), (z - r, z + r))}
    found = {}
    for name, box in boxes.items():
        axes = [np.arange(low, high + step_mm, step_mm) for low, high in box]
        points = np.meshgrid(*axes[::-1], indexing="ij")
        depth = -_distance(patient, name, organs.place_of(patient, *points[::-1]))
        found[name] = _cut_to_scan(patient, depth, axes, step_mm)
    tubes = vasculature(patient)
    for name, vessels in (
        ("arteries", tubes.arteries),
        ("veins", joined([tubes.cava, tubes.portal, tubes.hepatic])),
    ):
        found[name] = _tube_field(patient, vessels, 0.7 * step_mm)
    return found


def _distance(patient: Patient, name: str, at: organs.Place) -> Field:
    if name == "kidneys":
        return union(organs.kidney(patient, at, True), organs.kidney(patient, at, False))
    if name in ("gallbladder", "pancreas"):
        shape = {"gallbladder": organs.gallbladder, "pancreas": organs.pancreas}[name]
        return shape(at)
    if name == "cartilage":
        p = np.abs(np.arctan2(at.x, at.y)) / np.pi
        _, ends = skeleton.rib_distance(at.wall - 5.0, p, at.z)
        return np.minimum(ends, skeleton.costal_arch_distance(at.wall - 5.0, p, at.z))
    shapes = {
        "liver": organs.liver,
        "heart": organs.heart,
        "stomach": organs.stomach,
        "spleen": organs.spleen,
        "lesion": organs.lesion,
    }
    filling = name in ("liver", "stomach", "spleen")
    return shapes[name](patient, organs.touching(at) if filling else at)


def _tube_field(
    patient: Patient, tubes: Tubes, step: float
) -> tuple[NDArray[np.float32], FloatArray]:
    """Depth in tubes on a grid around them, ball by ball."""
    balls = tubes.balls
    low, high = (balls[:, :3] - 12.0).min(axis=0), (balls[:, :3] + 12.0).max(axis=0)
    axes = [np.arange(a, b + step, step) for a, b in zip(low, high, strict=True)]
    depth = np.full([len(axis) for axis in axes[::-1]], -2.0 * step, np.float32)
    for x, y, z, radius in balls.tolist():
        spans, squares = [], []
        for axis, centre in zip(axes, (x, y, z), strict=True):
            reach = radius + 2.0 * step
            first, last = np.searchsorted(axis, (centre - reach, centre + reach)).tolist()
            spans.append(slice(first, last))
            squares.append((axis[first:last] - centre) ** 2)
        away = np.sqrt(squares[2][:, None, None] + squares[1][:, None] + squares[0])
        part = depth[spans[2], spans[1], spans[0]]
        np.maximum(part, radius - away, out=part)
    return _cut_to_scan(patient, depth, axes, step)


def _cut_to_scan(
    patient: Patient, depth: Field, axes: list[FloatArray], step: float
) -> tuple[NDArray[np.float32], FloatArray]:
    """End a field with the scan and at its own edges; return it with its affine."""
    z = axes[2][:, None, None]
    ended = np.minimum(depth, np.minimum(z, MODEL_TOP / patient.scale[2] - z)).astype(np.float32)
    for axis in range(3):
        np.moveaxis(ended, axis, 0)[[0, -1]] = -step
    affine = np.diag([step * s for s in patient.scale] + [1.0])
    affine[:3, 3] = [axis[0] * s for axis, s in zip(axes, patient.scale, strict=True)]
    return ended, affine
