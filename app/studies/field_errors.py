"""How far what a needle met and felt by one way lies off what it did by the reference.

Boundaries of the two are matched one to one, nearest first: the same two tissues in the same order,
within 3 mm along the path. A membrane gives way once in each; its peak is what it holds just
before. Force is compared farther than 1 mm from every boundary of the reference and from where a
membrane gives way in it, up to the first bone, which stops a needle.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.imaging.field import FieldTissue, TissueKind
from app.imaging.field.naming import SMALL_VESSEL
from app.imaging.field.walking import directions
from app.simulation.scene import TissueLayer
from app.studies.field_paths import STEP_MM, Codes, NeedleFeel, NeedlePath

NEAR_MM: Final = 1.0
MATCHED_MM: Final = 3.0
THIN_MM: Final = 0.3
GRAZING_DEG: Final = 75.0
_JUST_BEFORE: Final = 5  # ticks
_SPRUNG: Final = 6  # ticks in which a free dimple has sprung back

CodesAt = Callable[[FloatArray], Codes]


@dataclass(frozen=True, slots=True)
class Missing:
    """A boundary of the reference that a way has not.

    Attributes:
        patient, path: where.
        at_mm: along the path.
        into: "fat, liver", what lies before and behind.
        thickness_mm: along the path, of the thinner of the two.
        grazing_deg: between path and the boundary's normal.
        is_parted: whether the way meets another tissue between the two there.
    """

    patient: str
    path: int
    at_mm: float
    into: str
    thickness_mm: float
    grazing_deg: float
    is_parted: bool = False

    @property
    def reason(self) -> str:
        """Return what about it is hard; empty for nothing known."""
        if self.thickness_mm < THIN_MM:
            return "thin"
        if self.grazing_deg > GRAZING_DEG:
            return "grazed"
        if self.is_parted:
            return "a third between"
        return "small vessel" if SMALL_VESSEL in self.into else ""


@dataclass(frozen=True, slots=True, eq=False)
class PathErrors:
    """Errors along one path.

    Attributes:
        force: where it is compared [N].
        places: of boundaries along the path [mm]; `is_membrane` says which have one, `samples`
            where they are in the reference.
        peaks: of membranes, share of the reference's.
        missing: boundaries of the reference that are not there, by sample; whether another tissue
            lies between there.
        unknown: boundaries that the reference has not.
        lost: membranes that give way in one of the two only.
    """

    force: FloatArray
    places: FloatArray
    samples: Codes
    is_membrane: NDArray[np.bool_]
    peaks: FloatArray
    missing: tuple[tuple[int, bool], ...]
    unknown: int
    lost: int


def boundaries(codes: Codes) -> list[tuple[int, int, int]]:
    """Return where tissues of one path begin: (sample, code before, code)."""
    at = np.flatnonzero(np.diff(codes)) + 1
    return [(int(k), int(codes[k - 1]), int(codes[k])) for k in at]


def until_bone(codes: Codes, tissues: Sequence[FieldTissue]) -> int:
    """Return how many samples a path has up to the first of bone, which is the last."""
    bone = np.array([tissue.kind is TissueKind.BONE for tissue in tissues])[codes]
    return int(np.argmax(bone)) + 1 if bone.any() else len(codes)


def compare(reference: NeedleFeel, felt: NeedleFeel, values: Sequence[TissueLayer]) -> PathErrors:
    """Hold what was felt against the reference, both of one length."""
    wanted, there = boundaries(reference.codes), boundaries(felt.codes)
    pairs = _matched(wanted, there)
    matched = {n for n, _ in pairs}
    off = np.array([abs(wanted[n][0] - there[m][0]) * STEP_MM for n, m in pairs])
    membrane = [values[wanted[n][2]].puncture_force > 0.0 for n, _ in pairs]
    first, second = _given_way(reference), _given_way(felt)
    events = _matched([(k, 0, 0) for k, _ in first], [(k, 0, 0) for k, _ in second])
    peaks = np.array([second[m][1] / first[n][1] - 1.0 for n, m in events if first[n][1] > 0.0])
    near = np.zeros(len(reference.codes), bool)
    for k in (*(k for k, _, _ in wanted), *(k for k, _ in first)):
        reach = round(NEAR_MM / STEP_MM)
        near[max(0, k - reach) : k + reach + 1] = True
    return PathErrors(
        (felt.force - reference.force)[~near],
        off,
        np.array([wanted[n][0] for n, _ in pairs], np.intp),
        np.array(membrane, bool),
        peaks,
        tuple(
            (edge[0], _is_parted(edge, there)) for n, edge in enumerate(wanted) if n not in matched
        ),
        len(there) - len(pairs),
        len(first) + len(second) - 2 * len(events),
    )


def _is_parted(wanted: tuple[int, int, int], there: Sequence[tuple[int, int, int]]) -> bool:
    """Return whether a way leaves the one tissue and comes into the other there, by a third."""
    sample, before, code = wanted
    near = [(a, b) for m, a, b in there if abs(m - sample) * STEP_MM < MATCHED_MM]
    return any(a == before for a, _ in near) and any(b == code for _, b in near)


def _matched(
    wanted: Sequence[tuple[int, int, int]], there: Sequence[tuple[int, int, int]]
) -> list[tuple[int, int]]:
    """Return pairs of indices of the same boundary, each used once, nearest first."""
    near = sorted(
        (abs(k - m), n, other)
        for n, (k, *kind) in enumerate(wanted)
        for other, (m, *another) in enumerate(there)
        if kind == another and abs(k - m) * STEP_MM < MATCHED_MM
    )
    pairs: list[tuple[int, int]] = []
    used: tuple[set[int], set[int]] = (set(), set())
    for _, n, m in near:
        if n not in used[0] and m not in used[1]:
            pairs.append((n, m))
            used[0].add(n)
            used[1].add(m)
    return sorted(pairs)


def _given_way(felt: NeedleFeel) -> list[tuple[int, float]]:
    """Return when membranes give way, and with which force [N]."""
    ticks = np.flatnonzero(np.diff(felt.punctures) > 0.0) + 1
    events, before = [], 0
    for k in ticks.tolist():
        first = max(k - _JUST_BEFORE, before)
        events.append((k, float(felt.membrane[first:k].max()) if first < k else 0.0))
        before = min(k + _SPRUNG, len(felt.codes))
    return events


def describe(
    patient: str,
    number: int,
    sample: int,
    reference: NeedleFeel,
    path: NeedlePath,
    rest: FloatArray,
    codes_at: CodesAt,
    tissues: Sequence[FieldTissue],
    probe_mm: float,
) -> Missing:
    """Say all of a boundary that is missing.

    Args:
        patient: where.
        number: of the path.
        sample: of the boundary.
        reference: what the needle met.
        path: of it.
        rest: where the tissue at each sample rests [mm], shape (n, 3).
        codes_at: of the reference, at rest [mm].
        tissues: by code.
        probe_mm: how far around the normal is looked for.
    """
    codes = reference.codes
    edges = [0, *(k for k, _, _ in boundaries(codes)), len(codes)]
    at = edges.index(sample)
    thickness = min(sample - edges[at - 1], edges[at + 1] - sample) * STEP_MM
    before, code = int(codes[sample - 1]), int(codes[sample])
    ways = directions()
    middle = 0.5 * (rest[sample - 1] + rest[sample])
    around = codes_at(middle + probe_mm * ways)
    normal = ways[around == code].sum(axis=0) - ways[around == before].sum(axis=0)
    length = float(np.linalg.norm(normal))
    cosine = abs(float(normal @ path.ways[sample])) / length if length > 0.0 else 0.0
    return Missing(
        patient,
        number,
        round(sample * STEP_MM, 2),
        f"{tissues[before].words}, {tissues[code].words}",
        round(thickness, 2),
        round(float(np.degrees(np.arccos(min(cosine, 1.0)))), 1),
    )
