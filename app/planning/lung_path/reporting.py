"""The path report of a lung biopsy, of a patient's tissue field: `LungPaths(field).report(...)`.

What the field does not label is not known. Emphysema of a CT is told by its values where no label
does: below -950 HU in the mean over 3 mm (LAA-950, the low attenuation area of quantitative CT).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.imaging.field.naming import BRONCHUS, EMPHYSEMA
from app.imaging.field.tissue_field import FieldTissue, TissueField, TissueKind
from app.imaging.field.walking import Crossed, holding, walk
from app.imaging.interpolation import interpolate
from app.imaging.volume import Volume
from app.planning.errors import PlanError
from app.planning.lung_path import chest_wall
from app.planning.lung_path.values import LungCrossing, LungPathReport, Place, TubeNear
from app.planning.lung_path.walls import crossing_angle, tubes_near

EMPHYSEMA_HU: Final = -950.0
"""Lung of less than this is emphysema (LAA-950)."""

_SAMPLE_MM: Final = 0.25
_MEAN_MM: Final = (-1.0, 0.0, 1.0)  # places along each axis that a mean is taken over
_UNKNOWN_MM: Final = 0.5  # so much that nobody labelled is nothing
_IN_LUNG: Final = ("lung", "pulmonary", "contrast")
_LESIONS: Final = ("nodule", "lesion", "tumour", "tumor", "metastasis", "target")


class LungPaths:
    """Reports paths in one patient.

    Args:
        field: of the patient.
        volume: the CT, for emphysema where the field has no label of it.
    """

    def __init__(self, field: TissueField, volume: Volume | None = None) -> None:
        self._field = field
        self._volume = None if volume is None or volume.unit != "HU" else volume
        lung = field.of_kind(TissueKind.LUNG)
        self._lung = {one.code for one in lung}
        self._bronchi = {one.code for one in lung if _is_airway(one)}
        self._emphysema = {one.code for one in lung if _begins(one, EMPHYSEMA)}
        self._lobes = {one.code for one in lung if "lobe" in one.name.casefold()}
        self._vessels = {
            one.code
            for one in field.of_kind(TissueKind.VESSEL)
            if chest_wall.INTERCOSTAL not in one.name.casefold()
        }
        # others run beside the lung: through them the path leaves it
        self._in_lung = {
            code
            for code in self._vessels
            if any(word in field.tissues[code].name.casefold() for word in _IN_LUNG)
        }
        self._lesions = {
            one.code
            for one in field.of_kind(TissueKind.ORGAN)
            if any(word in one.name.casefold() for word in _LESIONS)
        }

    def report(self, entry_mm: ArrayLike, target_mm: ArrayLike) -> LungPathReport:
        """Report a straight path.

        Args:
            entry_mm: on the skin, LPS, shape (3,).
            target_mm: LPS, shape (3,).

        Raises:
            PlanError: if the path does not go through the lung, or no lung is labelled.
        """
        field = self._field
        entry, target = np.asarray(entry_mm, np.float64), np.asarray(target_mm, np.float64)
        parts = walk(field, [entry, target])
        inner = self._first_lung(parts)
        unknown = sum(
            part.length_mm for part in parts if field.tissues[part.code].kind is TissueKind.UNKNOWN
        )
        known = unknown <= _UNKNOWN_MM
        within = self._within(parts, target)
        wall = inner.begin if np.linalg.norm(inner.begin - entry) > 1e-6 else target
        borders = chest_wall.rib_borders(field, entry, wall)
        spine = chest_wall.spine_mm(field, inner.begin)
        end = _before_target(parts, self._vessels | self._bronchi)
        return LungPathReport(
            entry_mm=_tuple(entry),
            target_mm=_tuple(target),
            length_mm=float(np.linalg.norm(target - entry)),
            unknown_mm=unknown,
            pleura=self._pleura(parts, within) if known else None,
            fissures=self._fissures(parts, within) if known else None,
            lung_mm=self._lung_mm(parts, within) if known else None,
            emphysema_mm=self._emphysema_mm(parts) if known else None,
            rib_below_mm=borders.below_mm,
            rib_above_mm=borders.above_mm,
            rib_below_at=borders.below_at,
            rib_above_at=borders.above_at,
            intercostal_mm=chest_wall.intercostal_mm(field, entry, wall),
            spine_mm=None if spine is None else spine[0],
            is_protected=chest_wall.is_protected(spine, borders),
            vessels=self._tubes(self._vessels, inner, end) if self._vessels else None,
            bronchi=self._tubes(self._bronchi, inner, end) if self._bronchi else None,
        )

    def report_or_none(self, entry_mm: ArrayLike, target_mm: ArrayLike) -> LungPathReport | None:
        """Report a straight path; None where it does not go through the lung."""
        try:
            return self.report(entry_mm, target_mm)
        except PlanError:
            return None

    def _first_lung(self, parts: list[Crossed]) -> Crossed:
        if not self._lung:
            raise PlanError(sentence("no lung is labelled in this patient"))
        for part in parts:
            if part.code in self._lung:
                return part
        raise PlanError(sentence("this path does not go through the lung"))

    def _within(self, parts: list[Crossed], target: FloatArray) -> list[bool]:
        """Tell of each stretch whether it lies within the lung: lung, and what lies in it."""
        held = set(holding(self._field, target).tolist())
        passed = self._in_lung | self._lesions
        if held & self._lung:
            passed |= held
        lung = [part.code in self._lung for part in parts]
        result = list(lung)
        last = -1
        for n, is_lung in enumerate(lung):
            if not is_lung:
                continue
            if last >= 0 and all(part.code in passed for part in parts[last + 1 : n]):
                result[last:n] = [True] * (n - last)
            last = n
        if last >= 0 and all(part.code in passed for part in parts[last + 1 :]):
            result[last:] = [True] * (len(parts) - last)  # the target lies in the lung
        return result

    def _pleura(self, parts: list[Crossed], within: list[bool]) -> tuple[LungCrossing, ...]:
        inside = self._lung | self._in_lung
        return tuple(
            LungCrossing(part.begin_mm, self._angle(part, inside), _tuple(part.begin), goes_in=now)
            for part, now, before in zip(parts[1:], within[1:], within[:-1], strict=True)
            if now != before
        )

    def _angle(self, part: Crossed, inside: set[int]) -> float:
        angle = crossing_angle(self._field, inside, part.begin, part.end - part.begin)
        return part.angle_deg if angle is None else angle

    def _fissures(
        self, parts: list[Crossed], within: list[bool]
    ) -> tuple[LungCrossing, ...] | None:
        """Return where one lobe follows another; None where lung on the way is of no lobe."""
        some = self._lobes | self._emphysema | self._bronchi
        if not self._lobes or any(p.code in self._lung and p.code not in some for p in parts):
            return None
        found = []
        last: Crossed | None = None
        for part, inside in zip(parts, within, strict=True):
            if not inside:
                last = None
            elif part.code in self._lobes:
                if last is not None and last.code != part.code:
                    found.append(self._fissure(last, part))
                last = part
        return tuple(found)

    def _fissure(self, last: Crossed, part: Crossed) -> LungCrossing:
        name = self._field.tissues[part.code].name
        if part.begin_mm - last.end_mm < 1e-6:
            angle = self._angle(part, {part.code})
            return LungCrossing(part.begin_mm, angle, _tuple(part.begin), True, name)
        middle = 0.5 * (last.end + part.begin)
        return LungCrossing(0.5 * (last.end_mm + part.begin_mm), None, _tuple(middle), True, name)

    def _tubes(self, codes: set[int], inner: Crossed, end: FloatArray) -> tuple[TubeNear, ...]:
        """Return what is met, or near, beyond the pleura."""
        return tuple(
            replace(one, depth_mm=inner.begin_mm + one.depth_mm)
            for one in tubes_near(self._field, codes, inner.begin, end)
        )

    def _lung_mm(self, parts: list[Crossed], within: list[bool]) -> float:
        """Return the length between pleura and target: lung, and what runs in it; no lesion."""
        tubes = self._lung | self._in_lung
        counted = [
            inside and part.code in tubes for part, inside in zip(parts, within, strict=True)
        ]
        if parts[-1].code in self._vessels:  # what looks like a vessel holds the target
            counted[-1] = False
        return sum(p.length_mm for p, counts in zip(parts, counted, strict=True) if counts)

    def _emphysema_mm(self, parts: list[Crossed]) -> float | None:
        if self._emphysema:
            return sum(part.length_mm for part in parts if part.code in self._emphysema)
        if self._volume is None:
            return None
        total = 0.0
        about = np.array(np.meshgrid(*[_MEAN_MM] * 3)).reshape(3, -1).T
        for part in parts:
            if part.code not in self._lung - self._bronchi:
                continue
            count = max(1, int(np.ceil(part.length_mm / _SAMPLE_MM)))
            shares = (np.arange(count) + 0.5)[:, None] / count
            places = part.begin + shares * (part.end - part.begin)
            voxels = self._volume.voxel((places[:, None, :] + about).reshape(-1, 3))
            values = interpolate(self._volume.hu, voxels).reshape(count, -1).mean(axis=1)
            total += float((values < EMPHYSEMA_HU).mean()) * part.length_mm
        return total


def _before_target(parts: list[Crossed], tubes: set[int]) -> FloatArray:
    """Return where the path ends; where its target lies in what looks like a tube, before that."""
    return parts[-1].begin if parts[-1].code in tubes else parts[-1].end


def _is_airway(tissue: FieldTissue) -> bool:
    return _begins(tissue, BRONCHUS[:6]) or _begins(tissue, "trachea") or _begins(tissue, "airway")


def _begins(tissue: FieldTissue, known: str) -> bool:
    words = tissue.name.casefold().replace("_", " ").replace("-", " ")
    return any(word.startswith(known) for word in words.split())


def _tuple(place: FloatArray) -> Place:
    x, y, z = place.tolist()
    return x, y, z
