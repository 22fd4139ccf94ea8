"""What a needle does to the lung while it does it: punctures of the pleura, fissures, aerated way.

What is judged at the end is told by `session.tissues` from the whole way; here the same is counted
look by look, as complications depend on it while the attempt runs. Both needles count, that for
local anaesthetic and the outer one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.imaging.field.tissue_field import UNKNOWN, TissueField, TissueKind
from app.imaging.field.walking import holding
from app.planning.errors import PlanError
from app.planning.sampling import lesion_code
from app.planning.tissues import SMALL_VESSELS
from app.session.tissues import BACK_MM, GAP_MM

STEP_MM: Final = 0.5
"""Between two looks the way is followed in steps of this."""

TOUCHES_MM: Final = 2.0
"""A lesion so near to what is no lung has contact to the pleura."""

BULLA: Final = "bulla"
"""In the name of a tissue that is one."""


class LungWatch:
    """Follows the tip of a needle through a field.

    Attributes:
        punctures: how often the pleura was punctured inwards.
        fissures: how often the tip went from one lobe into another; 0 where no lobes are known.
        bullae: how often it went into a bulla.
        aerated_mm: length of lung on one way forwards, the longest of them.
        in_lung: whether the tip is in the lung, or in something within it.
        entry_mm: where the pleura was punctured last, LPS, shape (3,); None if it was not.
    """

    def __init__(self, field: TissueField, target_mm: ArrayLike) -> None:
        self._field = field
        lungs = field.of_kind(TissueKind.LUNG)
        held = set(holding(field, target_mm).tolist())
        self._lung = {tissue.code for tissue in lungs}
        small = {t.code for t in field.tissues if t.name in SMALL_VESSELS}
        airways = {t.code for t in field.of_kind(TissueKind.AIR)}
        self.target_in_lung = bool(held & self._lung)
        within = small | airways | {UNKNOWN} | (held if self.target_in_lung else set())
        self._within = within - self._lung
        self._bulla = {t.code for t in field.tissues if BULLA in t.name.lower()}
        self._names = {t.code: t.name for t in lungs}
        self.knows_lobes = len(set(self._names.values())) > 2  # of two lungs at least one is parted
        self.punctures = self.fissures = self.bullae = 0
        self.aerated_mm = 0.0
        self.in_lung = False
        self.entry_mm: FloatArray | None = None
        self._last: tuple[FloatArray, float] | None = None
        self._entered = self._front = self._way = self._outside = 0.0
        self._code = UNKNOWN

    @property
    def knows_bullae(self) -> bool:
        """Return whether somebody labelled bullae."""
        return bool(self._bulla)

    def look(self, tip_mm: ArrayLike, depth_mm: float) -> bool:
        """Follow the tip to where it is, where the tissue about it rests; False if nothing changed.

        Args:
            tip_mm: LPS, shape (3,).
            depth_mm: of the tip; 0 and less is outside the body.
        """
        tip = frozen(tip_mm, (3,), "tip_mm")
        if depth_mm <= 0.0:
            self._last, self.in_lung = None, False
            return False
        begin, depth = self._last or (tip, depth_mm)
        self._last = tip, depth_mm
        steps = max(1, int(np.ceil(float(np.linalg.norm(tip - begin)) / STEP_MM)))
        shares = np.arange(1, min(steps, 400) + 1) / min(steps, 400)
        places = begin + shares[:, None] * (tip - begin)
        codes = self._field.codes_at(places).tolist()
        depths = (depth + shares * (depth_mm - depth)).tolist()
        before = self._state()
        for place, code, at in zip(places, codes, depths, strict=True):
            self._step(place, int(code), at)
        return self._state() != before

    def _state(self) -> tuple[int, int, int, float]:
        return self.punctures, self.fissures, self.bullae, self.aerated_mm

    def _step(self, place: FloatArray, code: int, depth: float) -> None:
        if code in self._lung:
            if not self.in_lung:
                self.punctures += 1
                self.in_lung, self.entry_mm = True, place
                self._entered = self._front = depth
                self._way = 0.0
            elif self._code in self._lung and self._names[code] != self._names[self._code]:
                self.fissures += self.knows_lobes
            self._outside = 0.0
        elif self.in_lung and code not in self._within:
            self._leave(depth)
        if code in self._bulla and self._code not in self._bulla:
            self.bullae += 1
        if code in self._lung or code in self._within:
            self._code = code if code in self._lung or code in self._bulla else self._code
        self._go_on(code, depth)

    def _leave(self, depth: float) -> None:
        self._outside = self._outside or depth
        drawn_out = depth < self._entered - BACK_MM
        through = depth > max(self._entered, self._outside) + GAP_MM
        if drawn_out or through:
            self.in_lung, self._outside, self._code = False, 0.0, UNKNOWN

    def _go_on(self, code: int, depth: float) -> None:
        if not self.in_lung:
            return
        if depth > self._front:
            if code in self._lung:
                self._way += depth - self._front
                self.aerated_mm = max(self.aerated_mm, self._way)
            self._front = depth
        elif depth < self._front - BACK_MM:
            self._front, self._way = depth, 0.0


@dataclass(frozen=True, slots=True)
class LesionFacts:
    """A lesion in the lung.

    Attributes:
        diameter_mm: of a ball of its volume.
        touches: whether it has contact to the pleura.
    """

    diameter_mm: float
    touches: bool


def lesion_facts(field: TissueField, target_mm: ArrayLike) -> LesionFacts | None:
    """Return what a field tells of the lesion at a target; None where nobody labelled one."""
    from scipy import ndimage  # not for who only watches

    try:
        code = lesion_code(field, target_mm)
    except PlanError:
        return None
    target = frozen(target_mm, (3,), "target_mm")
    parts, count = ndimage.label(field.labels == code)
    at = np.rint(target @ field.inverse_mm[:3, :3].T + field.inverse_mm[:3, 3]).astype(int)
    at = np.clip(at, 0, np.array(field.labels.shape[::-1]) - 1)
    number = int(parts[at[2], at[1], at[0]])
    lesion = parts == number if count and number else field.labels == code
    volume = float(lesion.sum()) * abs(float(np.linalg.det(field.affine_mm[:3, :3])))
    rounds = max(1, round(TOUCHES_MM / float(field.spacing_mm.min())))
    box = tuple(
        slice(max(0, part.start - rounds - 1), part.stop + rounds + 1)
        for part in ndimage.find_objects(lesion.astype(np.int8))[0]
    )
    near = ndimage.binary_dilation(lesion[box], iterations=rounds) & ~lesion[box]
    lung = [t.code for t in field.of_kind(TissueKind.LUNG, TissueKind.AIR)]
    small = [t.code for t in field.tissues if t.name in SMALL_VESSELS]
    others = ~np.isin(field.labels[box], [*lung, *small, code])
    return LesionFacts(float(np.cbrt(6.0 * volume / np.pi)), bool((near & others).any()))
