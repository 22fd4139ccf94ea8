"""Where things lie in a phantom patient: the truth that exercises and tests compare with."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from app.imaging.phantom.lesion import planned_patient
from app.imaging.phantom.patient import Patient, Point


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
        organs: a point inside each named organ.
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
    mean_scale = (scale[0] * scale[1] * scale[2]) ** (1.0 / 3.0)
    return Anatomy(
        seed=seed,
        lesion_mm=_lps(patient, patient.lesion_mm),
        lesion_radius_mm=patient.lesion_radius_mm * mean_scale,
        entry_mm=_lps(patient, entry),
        organs=MappingProxyType({name: _lps(patient, at) for name, at in _ORGANS.items()}),
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
