"""Structures that the needle has to keep away from: how near it came, in the record and the score.

Measured when the attempt ends, of its samples: nothing of it can be told while control scans guide.
Structures move with the target, as the whole picture of a control scan does. The distance is told
of the needle's part in the body, from the entry to the tip, where the cameras vouched for it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.bend import CURVE_POINTS, Bend, needle_curve
from app.core.events import Event
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.planning.placement import PlacedPlan
from app.scoring.errors import TrajectoryError
from app.scoring.risks import RiskMark
from app.session.machine import IN_BODY, State
from app.session.needle import FROM_CAMERAS
from app.session.samples import Samples

if TYPE_CHECKING:
    from app.imaging.structures.distance import SignedDistance

KIND: Final = "risk"
"""Kind of the event."""

VERSION: Final = 2
"""Of the event's data; 1 told the time inside by samples of a grid of distances."""

STEP_MM: Final = 1.0
"""The shaft is looked at in steps of this."""

SAME_MM: Final = 0.1
"""Of needles whose ends are all this near, the distance is measured once."""

CLOSEST: Final = 24
"""So many needles, the nearest by the grid of distances, are measured exactly."""

_LOOKED_AT: Final = tuple(state.value for state in IN_BODY | {State.PAUSED})


@dataclass(frozen=True, slots=True, eq=False)
class Risk:
    """One structure.

    Attributes:
        name: of the structure.
        limit_mm: the needle should stay at least this far off.
        field: its distances.
    """

    name: str
    limit_mm: float
    field: SignedDistance


def risk_marks_of(
    samples: Samples, placed: PlacedPlan, risks: Iterable[Risk]
) -> tuple[RiskMark, ...]:
    """Return how near the needle came to each structure; none if it was never seen in the body."""
    wanted = tuple(risks)
    if not wanted:
        return ()
    rows, lines, spans = needles_in_body(samples, placed)
    if not len(rows):
        return ()
    kept = different_needles(lines)
    found = []
    for risk in wanted:
        meets = risk.field.boundary.meets(lines)
        looked_at = kept
        if meets.any():  # then the deepest is one of these
            inside = np.flatnonzero(meets)
            looked_at = inside[different_needles(lines[inside])]
        rough = _roughly(lines[looked_at], risk.field)
        order = looked_at[np.argsort(rough, kind="stable")[:CLOSEST]].tolist()
        closest, n = _closest(lines, order, risk.field)
        row = rows[n]
        depth = float(samples.depth[row]) / MILLIMETRE
        at, inside_s = float(samples.time[row]), float(spans[meets].sum())
        found.append(RiskMark(risk.name, risk.limit_mm, closest, at, depth, inside_s))
    return tuple(found)


def event_of(mark: RiskMark) -> Event:
    """Return the event that keeps it in the record; `risk_marks` reads it back."""
    data: dict[str, object] = {
        "version": VERSION,
        "structure": mark.name,
        "limit_mm": mark.limit_mm,
        "closest_mm": mark.closest_mm,
        "breach_mm": mark.breach_mm,
        "depth_mm": mark.depth_mm,
    } | ({} if mark.inside_s is None else {"inside_s": mark.inside_s})
    return Event(mark.time, KIND, mark_sentence(mark), data)


def risk_marks(events: Iterable[Event]) -> tuple[RiskMark, ...]:
    """Read the structures back from events; those of a damaged one are left out."""
    found = []
    for event in events:
        if event.kind == KIND:
            data: dict[str, Any] = dict(event.data)
            try:
                numbers = (float(data[key]) for key in ("limit_mm", "closest_mm"))
                limit, closest = numbers
                name, depth = str(data["structure"]), float(data["depth_mm"])
                inside = float(data["inside_s"]) if "inside_s" in data else None
                mark = RiskMark(name, limit, closest, event.time, depth, inside)
            except (LookupError, TypeError, ValueError, TrajectoryError):
                continue
            found.append(mark)
    return tuple(found)


def mark_sentence(mark: RiskMark) -> str:
    """Say it in one line."""
    nearness = _limit_sentence(mark, _place(mark))
    if not mark.inside_s:
        return nearness
    return sentence(
        "{nearness}; inside for {inside_s:.1f} s", nearness=nearness, inside_s=mark.inside_s
    )


def _place(mark: RiskMark) -> str:
    if mark.closest_mm <= 0.0:
        return sentence(
            "{depth_mm:.1f} mm deep in {structure}",
            depth_mm=-mark.closest_mm,
            structure=mark.name,
        )
    return sentence(
        "{distance_mm:.1f} mm from {structure}",
        distance_mm=mark.closest_mm,
        structure=mark.name,
    )


def _limit_sentence(mark: RiskMark, place: str) -> str:
    if mark.breach_mm > 0.0:
        return sentence(
            "needle {place} at the closest; limit {limit_mm:g} mm: too near",
            place=place,
            limit_mm=mark.limit_mm,
        )
    return sentence(
        "needle {place} at the closest; limit {limit_mm:g} mm: kept",
        place=place,
        limit_mm=mark.limit_mm,
    )


def needles_seen(samples: Samples, placed: PlacedPlan) -> tuple[Any, FloatArray, FloatArray]:
    """Find the needles in the body: numbers of their samples, corners, and the target's motion [m].

    Two corners each, entry and tip, in world; as many as a bent needle has where one is bent.
    """
    seen = samples.valid & np.isin(samples.depth_source, FROM_CAMERAS)
    seen &= np.isin(samples.state, _LOOKED_AT) & (samples.depth > 0.0)
    seen &= np.isfinite(samples.tip).all(axis=1) & np.isfinite(samples.axis).all(axis=1)
    rows = np.flatnonzero(seen)
    if not len(rows):
        return rows, np.empty((0, 2, 3)), np.empty((0, 3))
    shift = samples.target[rows] - placed.p_target
    shift = np.where(np.isfinite(shift), shift, 0.0)
    tips = samples.tip[rows]
    lines = np.stack([tips - samples.depth[rows, None] * samples.axis[rows], tips], axis=1)
    if samples.bend is not None:
        lines = _bent(lines, samples.axis[rows], samples.depth[rows], samples.bend[rows])
    return rows, lines, shift


def needles_in_body(samples: Samples, placed: PlacedPlan) -> tuple[Any, FloatArray, FloatArray]:
    """Find the needles in the body: number of their sample, corners in LPS [mm], how long [s].

    All of the patient is taken to move with the target, as a control scan's whole picture does.
    """
    rows, lines, shift = needles_seen(samples, placed)
    lines = lines - shift[:, None, :]
    corners = placed.T_world_patient.inverse() @ lines.reshape(-1, 3) / MILLIMETRE
    lines = corners.reshape(lines.shape)
    return rows, lines, np.diff(samples.time, append=samples.time[-1:])[rows]


def different_needles(lines: FloatArray) -> Any:
    """Numbers of needles that differ, ascending."""
    alike = np.rint(lines.reshape(len(lines), -1) / SAME_MM)
    return np.sort(np.unique(alike, axis=0, return_index=True)[1])


def _bent(lines: FloatArray, axes: FloatArray, depths: FloatArray, bends: FloatArray) -> FloatArray:
    """Corners of needles [m], shape (n, CURVE_POINTS, 3), of those that may be bent."""
    shares = np.linspace(0.0, 1.0, CURVE_POINTS)
    result = np.empty((len(lines), CURVE_POINTS, 3))
    for n, line in enumerate(lines):
        bend = Bend.of_numbers(bends[n])
        if bend is None:
            result[n] = line[0] + shares[:, None] * (line[1] - line[0])
        else:
            result[n] = needle_curve(line[1], axes[n], float(depths[n]), bend)
    return result


def _closest(lines: FloatArray, order: Sequence[int], field: SignedDistance) -> tuple[float, int]:
    """Smallest distance of some needles [mm], and whose it is; a piece further off is passed by."""
    best, whose = inf, order[0]
    for n in order:
        for start, end in pairwise(lines[n]):
            found = field.nearer(start, end, best)
            if found is not None and found < best:
                best, whose = found, n
    return best, whose


def _roughly(lines: FloatArray, field: SignedDistance) -> FloatArray:
    """Distance of each needle by the grid of distances [mm], shape (n,)."""
    pieces = np.diff(lines, axis=1)
    longest = float(np.linalg.norm(pieces, axis=2).max())
    shares = np.linspace(0.0, 1.0, int(np.ceil(longest / STEP_MM)) + 2)
    points = lines[:, :-1, None] + shares[:, None] * pieces[:, :, None]
    distances = field.at(points.reshape(-1, 3)).reshape(len(lines), -1)
    result: FloatArray = distances.min(axis=1)
    return result
