"""One made-up patient: everything that differs from seed to seed."""

from dataclasses import dataclass
from typing import Final

import numpy as np

Point = tuple[float, float, float]

MODEL_TOP: Final = 300.0
"""Height of the model [mm]: from the iliac crests (0) to the lung bases below the heart (300)."""

NODULES_FROM: Final = 1000
"""Patients of this seed and above have a nodule in the right lung besides; the others have none."""

LOBES_FROM: Final = 2000
"""Patients of this seed and above have fissures, bronchi, emphysema and intercostal vessels too."""


@dataclass(frozen=True, slots=True)
class Patient:
    """Parameters of a patient in the supine position, head first.

    Model coordinates are LPS [mm] divided by `scale`: x to the left, y to the back, z to the head,
    the origin on the body's axis at the height of L5.

    Attributes:
        seed: where all of it comes from.
        scale: size against the nominal adult along x, y, z.
        fat_mm: mean thickness of the subcutaneous fat.
        liver_drop_mm: how far the liver's lower edge hangs below the nominal one.
        dome_mm: shift of the diaphragm, depth of the breath.
        lesion_mm: centre of the liver lesion, model coordinates.
        lesion_radius_mm: its mean radius.
        kidney_mm: shifts of right and left kidney along z.
        noise_hu: standard deviation of the noise.
    """

    seed: int
    scale: Point
    fat_mm: float
    liver_drop_mm: float
    dome_mm: float
    lesion_mm: Point
    lesion_radius_mm: float
    kidney_mm: tuple[float, float]
    noise_hu: float

    def generator(self, part: int) -> np.random.Generator:
        """Random numbers of one part of the anatomy, the same at every call."""
        return np.random.default_rng([self.seed, part])

    @property
    def nodule(self) -> tuple[Point, float] | None:
        """Centre, model coordinates, and radius [mm] of the nodule in the right lung, if any.

        It has its own random numbers, so that nothing else of a patient depends on it.
        """
        if self.seed < NODULES_FROM:
            return None
        low, high = (-92.0, -36.0, 276.0, 5.0), (-72.0, -22.0, 284.0, 7.5)
        x, y, z, radius = self.generator(9).uniform(low, high).tolist()
        return (x, y, z), radius

    @property
    def own_nodule(self) -> tuple[Point, float]:
        """Centre and radius of the nodule of a patient who has one.

        Raises:
            ValueError: if there is none.
        """
        if self.nodule is None:
            raise ValueError(self.seed)
        return self.nodule

    @property
    def has_lobes(self) -> bool:
        """Return whether fissures, bronchi, emphysema and intercostal vessels are known.

        All of it has its own random numbers, so that nothing else of a patient depends on it.
        """
        return self.seed >= LOBES_FROM


def draw_patient(seed: int) -> Patient:
    """Draw a patient whose lesion may still lie badly; see `lesion.make_patient`."""
    rng = np.random.default_rng([seed, 0])

    def between(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    return Patient(
        seed=seed,
        scale=(between(0.95, 1.05), between(0.95, 1.04), between(0.97, 1.03)),
        fat_mm=between(9.0, 17.0),
        liver_drop_mm=between(-8.0, 10.0),
        dome_mm=between(-5.0, 6.0),
        lesion_mm=(between(-92.0, -70.0), between(-32.0, -14.0), between(176.0, 200.0)),
        lesion_radius_mm=between(9.0, 15.0),
        kidney_mm=(between(-8.0, 8.0), between(-8.0, 8.0)),
        noise_hu=between(9.0, 13.0),
    )
