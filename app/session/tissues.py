"""What the needle met in the patient, from an attempt's samples; in the record as events.

The tip's way is followed through the tissue field, in the tissue's own coordinates: organs go along
with the target as they breathe, the wall of the body with its ribs stays. Only where the cameras
vouched for the tip; between two such samples the way is straight. A way forwards is followed once:
what the tip draws back through is not met again, what it then meets anew is. The shaft is looked at
too: it may be pushed into what the tip went past. The force is the largest along the needle from
where the tip came into a tissue until it left it, or was drawn back from it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.events import Event
from app.core.units import MILLIMETRE
from app.imaging.field.tissue_field import TissueField, TissueKind
from app.imaging.field.walking import Crossed, directions, holding, joined, walk
from app.planning.placement import PlacedPlan
from app.planning.tissues import SMALL_VESSELS
from app.scoring.errors import TrajectoryError
from app.scoring.met import BY_SHAFT, BY_TIP, Met
from app.session.risks import different_needles, needles_seen
from app.session.samples import Samples
from app.session.tissue_force import FeltAlong
from app.simulation.bound_field import BoundField

KIND: Final = "tissue"
"""Kind of the event."""

VERSION: Final = 1

FORWARD_MM: Final = 0.05
"""A step forwards that is shorter is none."""

BACK_MM: Final = 2.0
"""The tip was drawn back once it is so far behind where it had come; then a new way begins."""

GAP_MM: Final = 0.5
"""A tissue that is left for less is not left."""

CONTACT_MM: Final = 0.25
"""Bone is touched so near to its surface: it stops the tip, which never lies within."""

SLID_MM: Final = 1.0
"""Bone is felt until the tip is so much further: it slides along it."""

SHAFTS: Final = 200
"""So many needles at most are looked at along their shafts, evenly over the attempt."""

SHAFT_STEP_MM: Final = 1.0

_PROBES = 32  # places around the tip at which bone is looked for
_NOT_MET = (TissueKind.UNKNOWN, TissueKind.AIR)
_STEEPEST = 5.0  # tangent of the angle at which a boundary is met counts as no more than this


@dataclass(frozen=True, slots=True, eq=False)
class _Way:
    """One way forwards.

    Attributes:
        places: corners, LPS [mm], shape (n, 3).
        depths: of the tip there [mm], shape (n,).
        times: monotonic [s], shape (n,).
        spreads: standard deviations along and across [mm], shape (n, 2), NaN where not known.
        until: moment at which the tip was drawn back from its end, or nobody saw more of it [s].
    """

    places: FloatArray
    depths: FloatArray
    times: FloatArray
    spreads: FloatArray
    until: float

    @property
    def along(self) -> FloatArray:
        """Length of the way up to each corner [mm], shape (n,)."""
        lengths = np.linalg.norm(np.diff(self.places, axis=0), axis=1)
        return np.concatenate([[0.0], np.cumsum(lengths)])

    def left(self, end_mm: float) -> float:
        """Return the moment at which the tip left a place of the way [s]."""
        along = self.along
        if end_mm >= along[-1] - GAP_MM:
            return self.until
        return float(np.interp(end_mm, along, self.times))


@dataclass(frozen=True, slots=True, eq=False)
class _Needles:
    """Needles in the body, looked at where the tissue about them rests.

    Attributes:
        bound: the field in world.
        lines: corners in world [m], shape (n, corners, 3).
        shift: displacement of the target then [m], shape (n, 3).
    """

    bound: BoundField
    lines: FloatArray
    shift: FloatArray

    @property
    def tips(self) -> FloatArray:
        """Places of all tips, LPS [mm], shape (n, 3)."""
        return self._resting(self.lines[:, -1], self.shift)

    def shaft(self, number: int) -> tuple[FloatArray, FloatArray]:
        """Return places along a shaft, LPS [mm], shape (m, 3), and their shares of its length."""
        corners, shift = self.lines[number], self.shift[number]
        lengths = np.linalg.norm(np.diff(corners, axis=0), axis=1)
        along = np.concatenate([[0.0], np.cumsum(lengths)])
        shares = along / max(along[-1], 1e-9)
        if shift.any():  # what moves lies beside what does not: a line is none at rest
            fine = int(np.ceil(along[-1] / MILLIMETRE / SHAFT_STEP_MM)) + 1
            shares = np.union1d(shares, np.linspace(0.0, 1.0, fine))
            at = shares * along[-1]
            corners = np.column_stack([np.interp(at, along, column) for column in corners.T])
        return self._resting(corners, np.broadcast_to(shift, corners.shape)), shares

    def different(self) -> NDArray[np.intp]:
        """Return the numbers of needles that lie elsewhere in the target's tissue, ascending."""
        lines = (self.lines - self.shift[:, None, :]) / MILLIMETRE
        return np.asarray(different_needles(lines))

    def _resting(self, p_world: FloatArray, shift: FloatArray) -> FloatArray:
        resting = self.bound.at_rest(p_world, shift)
        return np.asarray(self.bound.T_world_patient.inverse() @ resting / MILLIMETRE)


def tissues_met_of(
    samples: Samples, placed: PlacedPlan, field: TissueField | None, felt: bool = False
) -> tuple[Met, ...] | None:
    """Return what the needle met, in order; None where there is no field to tell it by.

    `felt` says that a hand felt the field along the needle: then the force is told too.
    """
    if field is None:
        return None
    rows, lines, shift = needles_seen(samples, placed)
    if not len(rows):
        return ()
    bound = BoundField(field, placed.T_world_patient, placed.p_target)
    needles = _Needles(bound, lines, shift)
    target = placed.T_world_patient.inverse() @ placed.p_target / MILLIMETRE
    held = set(holding(field, target).tolist())
    found: list[Met] = []
    forces = FeltAlong.of(samples, felt)
    for way in _ways(samples, rows, needles):
        found += _met_on(field, way, held, forces)
    return (*found, *_by_shaft(field, samples, rows, needles, held, found))


def event_of(met: Met) -> Event:
    """Return the event that keeps it in the record; `tissues_met` reads it back."""
    data = {key: value for key, value in met.document().items() if key != "time"}
    return Event(met.time, KIND, met.sentence, {"version": VERSION, **data})


def tissues_met(events: Iterable[Event]) -> tuple[Met, ...] | None:
    """Read back what was met; None where the record says nothing of it; damaged ones left out."""
    looked, found = False, []
    for event in events:
        if event.kind != KIND:
            continue
        looked = True
        data: dict[str, Any] = dict(event.data)
        if data.get("nothing"):
            continue
        try:
            found.append(Met.of(data | {"time": event.time}))
        except (LookupError, TypeError, ValueError, TrajectoryError):
            continue
    return tuple(found) if looked else None


def events_of(met: tuple[Met, ...] | None, samples: Samples) -> tuple[Event, ...]:
    """Return the events of all that was met; one that says so where nothing was."""
    if met is None:
        return ()
    if not met and len(samples.time):
        data: dict[str, object] = {"version": VERSION, "nothing": True}
        return (Event(float(samples.time[-1]), KIND, "the needle met no tissue", data),)
    return tuple(map(event_of, met))


def _ways(samples: Samples, rows: NDArray[np.intp], needles: _Needles) -> list[_Way]:
    """Take the tip's ways forwards out of the needles in the body."""
    depth = samples.depth[rows] / MILLIMETRE
    spread = np.full((len(samples.time), 2), np.nan)
    if samples.spread is not None:
        spread = samples.spread[:, :2] / MILLIMETRE
    ways: list[_Way] = []
    tips = needles.tips
    for stay in _stays(rows, samples):
        corners: list[tuple[FloatArray, float, float, FloatArray]] = []
        first = stay[0]
        for place, share in zip(*needles.shaft(first), strict=True):
            corners.append(
                (place, share * depth[first], samples.time[rows[first]], spread[rows[first]])
            )
        front, back = depth[first], None
        for n in stay[1:]:
            here = (tips[n], depth[n], samples.time[rows[n]], spread[rows[n]])
            if back is not None:
                if here[1] < back[1]:
                    back = here
                elif here[1] > back[1] + GAP_MM:
                    corners, front, back = [back, here], here[1], None
            elif here[1] > front + FORWARD_MM:
                corners.append(here)
                front = here[1]
            elif here[1] < front - BACK_MM:
                ways.append(_way(corners, samples.time[rows[n]]))
                back = here
        if back is None:
            ways.append(_way(corners, samples.time[rows[stay[-1]]]))
    return ways


def _way(corners: list[tuple[FloatArray, float, float, FloatArray]], until: float) -> _Way:
    places, depths, times, spreads = zip(*corners, strict=True)
    return _Way(
        np.array(places), np.array(depths), np.array(times), np.array(spreads), float(until)
    )


def _stays(rows: NDArray[np.intp], samples: Samples) -> list[NDArray[np.intp]]:
    """Part the needles where the tip was out of the body in between."""
    outside = np.cumsum(samples.valid & (samples.depth <= 0.0))
    return np.split(np.arange(len(rows)), np.flatnonzero(np.diff(outside[rows])) + 1)


def _met_on(field: TissueField, way: _Way, held: set[int], forces: FeltAlong) -> list[Met]:
    """Return what was met on one way forwards."""
    walked = walk(field, way.places)
    crossed = _touching(field, way, walked)
    lung = {tissue.code for tissue in field.of_kind(TissueKind.LUNG)}
    small = {tissue.code for tissue in field.tissues if tissue.name in SMALL_VESSELS}
    found: list[tuple[float, Met]] = []
    for code in sorted({part.code for part in crossed}):
        tissue = field.tissues[code]
        if tissue.kind in _NOT_MET:
            continue
        # what lies within an organ, and a lesion in it, does not part it
        within = small | held if code in lung | held else small
        for part in stretches(crossed, len(walked), code, within - {code}):
            met = _met(field, way, part, crossed, held)
            if code in lung:  # a nodule does not part it, nor another lobe, and is none of it
                solid = _solid_mm(crossed, part, (held | lung) - {code})
                met = replace(met, length_mm=max(0.0, met.length_mm - solid))
            # Bone is left where something else is met, or the tip slid on.
            left = way.left(part.end_mm + (SLID_MM if met.is_bone else 0.0))
            force = forces.largest(met.time, left)
            found.append((part.begin_mm, replace(met, force_n=force)))
    return [met for _, met in sorted(found, key=lambda one: one[0])]


def stretches(crossed: list[Crossed], walked: int, code: int, within: set[int]) -> list[Crossed]:
    """Return the stretches of one tissue, each of a length that can be.

    Bone that was touched on the way to where the tip lay in it stands behind that in `crossed`: it
    is met on its own, and not joined backwards.

    Args:
        crossed: of a way, what was only touched behind all else.
        walked: how many of them were walked through.
        code: which tissue.
        within: what does not part it.
    """
    whole = joined(crossed, {code}, GAP_MM, within)
    if all(part.length_mm >= 0.0 for part in whole):
        return whole
    lain = joined(crossed[:walked], {code}, GAP_MM, within)
    return lain + joined(crossed[walked:], {code}, GAP_MM, within)


def _solid_mm(crossed: list[Crossed], part: Crossed, codes: set[int]) -> float:
    """Return how much of some codes lies within a stretch [mm]."""
    return sum(
        other.length_mm
        for other in crossed
        if other.code in codes and part.begin_mm <= other.begin_mm and other.end_mm <= part.end_mm
    )


def _touching(field: TissueField, way: _Way, crossed: list[Crossed]) -> list[Crossed]:
    """Return what was crossed, and bone that the tip came to without lying in it."""
    bones = [tissue.code for tissue in field.of_kind(TissueKind.BONE)]
    if not crossed or not bones:
        return crossed
    along = way.along
    around = way.places[:, None, :] + CONTACT_MM * directions(_PROBES)
    codes = field.codes_at(around.reshape(-1, 3)).reshape(len(along), _PROBES)
    near = np.asarray(np.isin(codes, bones))
    for part in crossed:
        if part.code in bones:  # lain in, and told already
            inside = (along >= part.begin_mm - 1.0) & (along <= part.end_mm + 1.0)
            near[inside] = False
    touched = np.asarray(near.any(axis=1))
    first = np.flatnonzero(touched & ~np.concatenate([[False], touched[:-1]]))
    found = list(crossed)
    for n in first.tolist():
        probe = int(near[n].argmax())
        ahead = way.places[n] - way.places[max(0, n - 5)]
        normal = field.look_up(around[n, probe][None]).normal[0]
        cosine = float(normal @ ahead) / max(float(np.linalg.norm(ahead)), 1e-9)
        angle = float(np.degrees(np.arccos(np.clip(abs(cosine), 0.0, 1.0))))
        at, place = float(along[n]), way.places[n]
        found.append(Crossed(int(codes[n, probe]), at, at, place, place, angle))
    return found


def _met(
    field: TissueField, way: _Way, part: Crossed, crossed: list[Crossed], held: set[int]
) -> Met:
    tissue, along = field.tissues[part.code], way.along
    depth = float(np.interp(part.begin_mm, along, way.depths))
    number = min(int(np.searchsorted(along, part.begin_mm)), len(along) - 1)
    before = [one for one in crossed if one.end_mm <= part.begin_mm + 1e-9 and one is not part]
    after = [one for one in crossed if one.begin_mm >= part.end_mm - 1e-9 and one is not part]
    (a, b, c), (d, e, f) = part.begin.tolist(), part.end.tolist()
    return Met(
        kind=tissue.kind.value,
        name=tissue.name,
        entered_mm=depth,
        length_mm=part.length_mm,
        points=((a, b, c), (d, e, f)),
        sd_mm=_sd(way.spreads[number], part.angle_deg),
        angle_deg=part.angle_deg,
        time=float(np.interp(part.begin_mm, along, way.times)),
        confidence=tissue.confidence,
        holds_target=part.code in held,
        before=field.tissues[before[-1].code].kind.value if before else "",
        after=field.tissues[after[0].code].kind.value if after else "",
        by=BY_TIP,
    )


def _sd(spread: FloatArray, angle_deg: float) -> float | None:
    """Deviation of where a boundary is met along the way [mm]: along, and across where flat."""
    along, across = spread.tolist()
    if not np.isfinite(along) or not np.isfinite(across):
        return None
    steep = min(_STEEPEST, float(np.tan(np.radians(min(angle_deg, 89.0)))))
    return float(np.hypot(along, across * steep))


def _by_shaft(
    field: TissueField,
    samples: Samples,
    rows: NDArray[np.intp],
    needles: _Needles,
    held: set[int],
    by_tip: list[Met],
) -> list[Met]:
    """Return what shafts lie in that no tip has met, the longest of each tissue."""
    chosen = needles.different()
    if len(chosen) > SHAFTS:
        chosen = chosen[np.linspace(0, len(chosen) - 1, SHAFTS).astype(np.intp)]
    known = {(met.kind, met.name) for met in by_tip}
    longest: dict[int, Met] = {}
    for n in chosen.tolist():
        row = int(rows[n])
        depth = float(samples.depth[row]) / MILLIMETRE
        spread = np.full(2, np.nan)
        if samples.spread is not None:
            spread = samples.spread[row, :2] / MILLIMETRE
        places, shares = needles.shaft(n)
        way = _Way(
            places,
            shares * depth,
            np.full(len(shares), samples.time[row]),
            np.broadcast_to(spread, (len(shares), 2)),
            float(samples.time[row]),
        )
        for part in walk(field, way.places, SHAFT_STEP_MM):
            tissue = field.tissues[part.code]
            if tissue.kind in _NOT_MET or (tissue.kind.value, tissue.name) in known:
                continue
            if part.length_mm > (longest[part.code].length_mm if part.code in longest else GAP_MM):
                met = _met(field, way, part, [], held)
                longest[part.code] = replace(met, by=BY_SHAFT)
    return [longest[code] for code in sorted(longest)]
