"""A biopsy gun's sample as a volume: what its notch holds, and what its throw runs into.

The gun's needle leaves the outer needle's tip and runs ahead by its throw, along the tip's way. Its
notch, a flat cut into one side, ends a dead tip before the throw does; the sleeve that follows cuts
off what has come into it: a half cylinder on the notch's side. Strnad 2021, doi
10.1007/s00261-021-03145-1, shows such needles.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueField, TissueKind
from app.imaging.field.tissue_words import tissue_words
from app.imaging.field.walking import Crossed, holding, walk
from app.planning.errors import PlanError
from app.planning.tissues import SMALL_VESSELS

ALONG_MM: Final = 0.25
"""A sample is looked at in discs of this thickness."""

ACROSS: Final = 24
"""And each of them at so many places."""

GRAZED_MM: Final = 0.3
"""What lies on a throw for less was grazed."""

AtRest = Callable[[FloatArray], FloatArray]
"""Where the tissue at places rests, LPS [mm], shape (n, 3) -> (n, 3)."""

_NO_LESION: Final = (TissueKind.UNKNOWN, TissueKind.AIR, TissueKind.LUNG, TissueKind.SKIN)
_HARMED: Final = (TissueKind.VESSEL, TissueKind.HEART, TissueKind.GUT, TissueKind.BONE)


@dataclass(frozen=True, slots=True)
class Throw:
    """One setting of a side-notch biopsy gun.

    Attributes:
        throw_mm: how far its needle runs ahead of the outer needle's tip.
        notch_mm: length of the notch.
        dead_tip_mm: from the notch's end to the needle's.
        radius_mm: of the core.

    Raises:
        PlanError: naming the number and what would be valid.
    """

    throw_mm: float
    notch_mm: float
    dead_tip_mm: float
    radius_mm: float = 0.4

    def __post_init__(self) -> None:
        numbers = (self.throw_mm, self.notch_mm, self.dead_tip_mm, self.radius_mm)
        if not all(isfinite(number) and number > 0.0 for number in numbers):
            raise PlanError(
                sentence(
                    "a throw of {throw_mm:g} mm with a notch of {notch_mm:g} mm and a tip of "
                    "{tip_mm:g} mm beyond it: all must be above 0",
                    throw_mm=self.throw_mm,
                    notch_mm=self.notch_mm,
                    tip_mm=self.dead_tip_mm,
                )
            )
        if self.notch_mm + self.dead_tip_mm > self.throw_mm:
            raise PlanError(
                sentence(
                    "a notch of {notch_mm:g} mm and {tip_mm:g} mm beyond it are longer than the "
                    "throw of {throw_mm:g} mm: part of the notch would stay in the outer needle",
                    notch_mm=self.notch_mm,
                    tip_mm=self.dead_tip_mm,
                    throw_mm=self.throw_mm,
                )
            )

    @property
    def notch_span_mm(self) -> tuple[float, float]:
        """Return where the notch begins and ends, ahead of the outer needle's tip."""
        end = self.throw_mm - self.dead_tip_mm
        return end - self.notch_mm, end


@dataclass(frozen=True, slots=True)
class Ahead:
    """Something that a throw runs into.

    Attributes:
        name: of the tissue.
        kind: of it.
        ahead_mm: how far ahead of the outer needle's tip it begins.
        length_mm: of the throw in it.
        leaves: whether it is what lies behind the organ: the throw leaves pleura or capsule there.
    """

    name: str
    kind: TissueKind
    ahead_mm: float
    length_mm: float
    leaves: bool = False

    @property
    def sentence(self) -> str:
        """Say it in one line."""
        if self.leaves:
            return sentence(
                "the throw leaves the organ {ahead:.1f} mm ahead, into {tissue}",
                ahead=self.ahead_mm,
                tissue=tissue_words(self.name),
            )
        return sentence(
            "the throw meets {tissue} {ahead:.1f} mm ahead, for {length:.1f} mm",
            tissue=tissue_words(self.name),
            ahead=self.ahead_mm,
            length=self.length_mm,
        )


@dataclass(frozen=True, slots=True)
class Core:
    """What the notch holds and what the throw met.

    Attributes:
        lesion_mm: length of lesion in the core: its volume over the core's cross-section.
        lesion_share: of the core's volume, 0 to 1.
        volume_mm3: of the core.
        hits: what the throw should not have met, in order.
    """

    lesion_mm: float
    lesion_share: float
    volume_mm3: float
    hits: tuple[Ahead, ...]


def core(
    field: TissueField,
    tip_mm: ArrayLike,
    axis: ArrayLike,
    throw: Throw,
    target_mm: ArrayLike,
    notch_deg: float = 0.0,
    at_rest: AtRest | None = None,
) -> Core:
    """Take a sample.

    Args:
        field: of the patient.
        tip_mm: of the outer needle, LPS, shape (3,).
        axis: direction in which the tip goes on, shape (3,).
        throw: of the gun.
        target_mm: of the lesion at rest.
        notch_deg: direction of the notch about the axis, as `notch_side` counts it.
        at_rest: says where the tissue at places rests, as breathing has it; None where all rests.

    Raises:
        PlanError: if nobody labelled a lesion at the target, or the axis is none.
    """
    way = _unit(axis)
    lesion = lesion_code(field, target_mm)
    tip = frozen(tip_mm, (3,), "tip_mm")
    begin, end = throw.notch_span_mm
    places = _half_cylinder(tip, way, (begin, end), throw.radius_mm, notch_deg)
    places = places if at_rest is None else at_rest(places)
    share = float((field.codes_at(places) == lesion).mean())
    volume = 0.5 * np.pi * throw.radius_mm**2 * throw.notch_mm
    hits = on_the_throw(field, tip, way, throw.throw_mm, target_mm, at_rest)
    return Core(share * throw.notch_mm, share, float(volume), hits)


def lesion_code(field: TissueField, target_mm: ArrayLike) -> int:
    """Return the code of the lesion at a target.

    Raises:
        PlanError: if what lies there is no lesion that anybody labelled.
    """
    target = np.asarray(target_mm, np.float64)
    code = int(field.codes_at(target[None])[0])
    tissue = field.tissues[code]
    around = [one for one in holding(field, target).tolist() if one != code]
    if tissue.kind in _NO_LESION or not around:
        raise PlanError(
            sentence(
                "the target lies in {tissue}: nobody marked a lesion there, so that no sample can "
                "be judged; mark it as a structure of kind target",
                tissue=tissue.words,
            )
        )
    return code


def on_the_throw(
    field: TissueField,
    tip_mm: FloatArray,
    way: FloatArray,
    throw_mm: float,
    target_mm: ArrayLike,
    at_rest: AtRest | None = None,
) -> tuple[Ahead, ...]:
    """Return what a throw runs into and should not: vessels, bone, and what lies off the organ."""
    held = set(holding(field, target_mm).tolist())
    found = []
    line = tip_mm + np.linspace(0.0, throw_mm, 2 if at_rest is None else 41)[:, None] * way
    line = line if at_rest is None else at_rest(line)
    inside = bool(int(field.codes_at(line[:1])[0]) in held)
    for part in walk(field, line):
        tissue = field.tissues[part.code]
        inside = inside or part.code in held
        if part.code in held or part.length_mm < GRAZED_MM:
            continue
        if tissue.kind in _HARMED and tissue.name not in SMALL_VESSELS:
            found.append(_ahead(field, part))
        elif inside and tissue.kind is not TissueKind.VESSEL:
            found.append(_ahead(field, part, leaves=True))
    return tuple(found)


def _ahead(field: TissueField, part: Crossed, leaves: bool = False) -> Ahead:
    tissue = field.tissues[part.code]
    name = tissue.name or tissue.kind.value
    return Ahead(name, tissue.kind, part.begin_mm, part.length_mm, leaves)


@dataclass(frozen=True, slots=True)
class SamplePlan:
    """Where to stop the outer needle for a throw, by the planned path.

    Attributes:
        throw: the gun's.
        stop_mm: depth of the outer needle's tip along the path.
        lesion_mm: length of lesion in the core then.
        hits: what the throw would run into.
    """

    throw: Throw
    stop_mm: float
    lesion_mm: float
    hits: tuple[Ahead, ...]


def plan_sample(
    field: TissueField, entry_mm: ArrayLike, target_mm: ArrayLike, throw: Throw
) -> SamplePlan:
    """Find the place of the outer needle from which the notch holds most lesion.

    Of several the middle one, so that an error to either side costs least; those from which the
    throw harms nothing go before all others.

    Raises:
        PlanError: if nobody labelled a lesion at the target, or the path has no length.
    """
    entry, target = (np.asarray(place, np.float64) for place in (entry_mm, target_mm))
    way = _unit(target - entry)
    lesion = lesion_code(field, target)
    length = float(np.linalg.norm(target - entry))
    depths = np.arange(0.0, length + 30.0 + throw.throw_mm, ALONG_MM)
    inside = field.codes_at(entry + depths[:, None] * way) == lesion
    begin, end = throw.notch_span_mm
    sums = np.concatenate([[0.0], np.cumsum(inside) * ALONG_MM])
    stops = depths[depths <= length + 10.0]

    def held(depth: FloatArray) -> FloatArray:
        low, high = (np.clip((depth + s) / ALONG_MM, 0, len(inside)) for s in (begin, end))
        return np.asarray(sums[np.rint(high).astype(int)] - sums[np.rint(low).astype(int)])

    lesion_mm = held(stops)
    good = stops[lesion_mm >= lesion_mm.max() - 0.5 * ALONG_MM]
    met = [on_the_throw(field, entry + d * way, way, throw.throw_mm, target) for d in good.tolist()]
    free = [number for number, hits in enumerate(met) if not hits]
    of = free or list(range(len(good)))
    number = of[(len(of) - 1) // 2]
    stop = float(good[number])
    return SamplePlan(throw, stop, float(held(np.array([stop]))[0]), met[number])


def notch_side(axis: ArrayLike, notch_deg: float) -> FloatArray:
    """Return the unit direction to which the notch is open, shape (3,).

    0° is as far towards the patient's front as is square to the needle, 90° clockwise from there as
    seen from the hub; of a needle that comes straight from front or back, 0° is towards the head.
    """
    way = _unit(axis)
    front = np.array([0.0, -1.0, 0.0])
    if abs(float(front @ way)) > 0.999:
        front = np.array([0.0, 0.0, 1.0])
    up = _unit(front - float(front @ way) * way)
    right = np.cross(way, up)  # seen from the hub the needle points away
    angle = np.radians(notch_deg)
    return np.asarray(np.cos(angle) * up + np.sin(angle) * right)


def _half_cylinder(
    tip: FloatArray,
    way: FloatArray,
    span: tuple[float, float],
    radius: float,
    notch_deg: float,
) -> FloatArray:
    """Return places spread evenly over the core, LPS [mm], shape (n, 3)."""
    side = notch_side(way, notch_deg)
    across = np.cross(way, side)
    discs = max(1, int(np.ceil((span[1] - span[0]) / ALONG_MM - 1e-9)))
    along = span[0] + (np.arange(discs) + 0.5) * (span[1] - span[0]) / discs
    n = np.arange(ACROSS) + 0.5
    golden = np.pi * (3.0 - 5.0**0.5)
    r, turn = radius * np.sqrt(n / ACROSS), (n * golden) % np.pi - 0.5 * np.pi
    disc = (r * np.cos(turn))[:, None] * side + (r * np.sin(turn))[:, None] * across
    places: NDArray[np.float64] = tip + along[:, None, None] * way + disc
    return places.reshape(-1, 3)


def _unit(vector: ArrayLike) -> FloatArray:
    array = np.asarray(vector, np.float64)
    length = float(np.linalg.norm(array))
    if not (isfinite(length) and length > 1e-9):
        raise PlanError(sentence("the needle has no direction"))
    return np.asarray(array / length)
