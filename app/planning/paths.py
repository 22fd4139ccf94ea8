"""How good straight paths to one target are: length, angle, what they meet, structures, reach.

A path that must not be is blocked, and says why. Any other has a cost, the weighted sum of its
parts, each 0 (best) to 1 (as bad as is allowed), and from it a score of 100 to 0.

The path for `acus demo` on a CT that comes without a plan knows nothing of organs and vessels, and
says so in its name: nobody practises on it unseen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, unit
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.units import DEGREE, MILLIMETRE
from app.imaging.body import Body, is_inside, skin_entry
from app.imaging.errors import InvalidEntryError
from app.imaging.field import TissueField
from app.imaging.interpolation import interpolate
from app.imaging.skin import SkinPatch
from app.imaging.volume import Volume
from app.planning.clearance import Field
from app.planning.errors import PlanError
from app.planning.field_clearance import ClearField
from app.planning.judged import WEIGHTS, Weights
from app.planning.limits import ReachLimits
from app.planning.placement import Placement
from app.planning.plan import Plan
from app.planning.tissues import along as along_paths

_ACROSS = (-0.45, 0.45, -0.35, 0.35, -0.25, 0.25, -0.15, 0.15)  # of the body's half width
_ALONG_MM = (0.0, 15.0, -15.0, 30.0, -30.0, 7.0, -7.0)
_TILTS_DEG = (12.0, -12.0, 5.0, -5.0)
_LENGTH_MM = 65.0
_BONE_HU = 180.0


def demonstration_plan(volume: Volume, body: Body, name: str = "demonstration") -> Plan:
    """Return a path from the anterior skin with the least bone on it (supine patient).

    Raises:
        PlanError: if no path of 65 mm from the anterior skin stays in the body.
    """
    candidates: list[tuple[float, int, tuple[FloatArray, FloatArray]]] = []
    for across, along, tilt in product(_ACROSS, _ALONG_MM, _TILTS_DEG):
        path = _path(volume, body, across, along, np.deg2rad(tilt))
        if path is not None:
            candidates.append((_bone_mm(volume, *path), len(candidates), path))
            if candidates[-1][0] == 0.0:
                break
    if not candidates:
        raise PlanError(
            sentence(
                "no path of {length_mm:g} mm from the anterior skin stays in the body of this CT;"
                " place entry and target yourself",
                length_mm=_LENGTH_MM,
            )
        )
    entry, target = min(candidates)[2]
    return Plan(entry, target, name)


def _path(
    volume: Volume, body: Body, across: float, along_mm: float, tilt: float
) -> tuple[FloatArray, FloatArray] | None:
    low, high = _extent_mm(volume, body)
    centre = 0.5 * (low + high)
    foot = centre + np.array([across * 0.5 * (high - low)[0], 0.0, along_mm])
    direction = unit([np.sin(tilt), np.cos(tilt), 0.1])  # posterior is +y in LPS
    outside = foot - direction * (foot[1] - low[1] + 30.0) / direction[1]
    try:
        entry = skin_entry(body, outside, foot)
    except InvalidEntryError:
        return None
    target = entry + _LENGTH_MM * direction
    return (entry, target) if is_inside(body, target) else None


def _extent_mm(volume: Volume, body: Body) -> tuple[FloatArray, FloatArray]:
    """Corners of the body's box in LPS [mm]."""
    cells = np.argwhere(body.coarse)[:, ::-1] * body.factors
    corners = volume.lps_mm(np.array([cells.min(axis=0), cells.max(axis=0)]))
    return corners.min(axis=0), corners.max(axis=0)


def _bone_mm(volume: Volume, entry: FloatArray, target: FloatArray) -> float:
    """Length of the path through what is as dense as bone [mm]."""
    steps = np.linspace(0.0, 1.0, int(_LENGTH_MM) + 1)[:, None]
    values = [volume.hu_at(p) for p in entry + steps * (target - entry)]
    return float(sum(value is not None and value > _BONE_HU for value in values))


STEP_MM = 1.0
"""Paths are looked at in steps of this."""

BONE_HU = 250.0
"""What is this dense counts as bone; vessels with contrast agent may too."""

INSIDE_SHARE = 0.5
CHUNK = 256
"""Paths are scored so many at a time; between two chunks one may cancel."""


class PathObstacle(StrEnum):
    """Why a path must not be."""

    NONE = "free"
    REACH = "reach"
    LONG = "long"
    FLAT = "flat"
    AIR = "air"
    BONE = "bone"
    STRUCTURE = "structure"
    LUNG = "lung"
    VESSEL = "vessel"
    GUT = "gut"
    HEART = "heart"


@dataclass(frozen=True, slots=True, eq=False)
class PathScores:
    """Scores of many paths to one target; arrays of shape (n,).

    Attributes:
        target_mm: shape (3,).
        entries_mm: shape (n, 3).
        score: 0 to 100, the higher the better; NaN where blocked.
        block: one of `PathObstacle` for each, as its number in `tuple(Block)`.
        length_mm: of the paths.
        angle_deg: between path and the skin's normal, 0 is straight in.
        bone_mm: length through bone.
        lung_mm, vessel_mm, gut_mm, heart_mm: length through these, by the tissue field; 0 for what
            holds the target, NaN without a field.
        pleural_deg: between path and the pleura's normal, NaN where the lung is not entered.
        clear_mm: distance from the nearest of these that the path should not meet; infinite
            without any, NaN where blocked and without a field.
        nearest_mm: distance from the nearest structure that is to be avoided; infinite without.
        nearest: its number in `names`, -1 without.
        names: of the structures.
    """

    target_mm: FloatArray
    entries_mm: FloatArray
    score: FloatArray
    block: NDArray[np.intp]
    length_mm: FloatArray
    angle_deg: FloatArray
    bone_mm: FloatArray
    lung_mm: FloatArray
    vessel_mm: FloatArray
    gut_mm: FloatArray
    heart_mm: FloatArray
    pleural_deg: FloatArray
    clear_mm: FloatArray
    nearest_mm: FloatArray
    nearest: NDArray[np.intp]
    names: tuple[str, ...] = field(default=())

    def __len__(self) -> int:
        """Return the number of paths."""
        return len(self.entries_mm)

    @property
    def free(self) -> NDArray[np.bool_]:
        """Return which paths are not blocked."""
        result: NDArray[np.bool_] = self.block == 0
        return result

    def why(self, number: int) -> PathObstacle:
        """Return why a path is blocked."""
        return tuple(PathObstacle)[int(self.block[number])]


def score_paths(
    target_mm: FloatArray,
    skin: SkinPatch,
    body: Body,
    fields: Sequence[Field],
    placement: Placement,
    limits: ReachLimits,
    weights: Weights = WEIGHTS,
    progress: Progress | None = None,
    tissues: TissueField | None = None,
) -> PathScores:
    """Score the paths from every point of the skin to a target.

    Args:
        target_mm: LPS, shape (3,).
        skin: entries.
        body: of the CT, which also gives the bone.
        fields: structures with their distances; those that warn are kept away from.
        placement: how the patient lies.
        limits: of the device.
        weights: what counts how much.
        progress: reports, and may be cancelled.
        tissues: field of the CT, which tells bone from contrast, lung, vessels, gut and heart.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    target = np.asarray(target_mm, np.float64)
    avoided = [one for one in fields if one[0].kind.is_avoided and one[0].warn_mm > 0.0]
    parts = []
    for start in range(0, max(1, len(skin)), CHUNK):
        progress.report(start / max(1, len(skin)), sentence("scoring paths"))
        part = slice(start, start + CHUNK)
        parts.append(
            _chunk(
                target,
                skin.points_mm[part],
                skin.outward[part],
                body,
                avoided,
                placement,
                limits,
                weights,
                tissues,
            )
        )
    progress.report(1.0, sentence("paths scored"))
    columns: list[Any] = [np.concatenate(column) for column in zip(*parts, strict=True)]
    block, length, angle, bone, *others, pleura, nearest, which, worst = columns
    lung, vessel, gut, heart = others
    clear = np.full(len(block), np.nan)
    free = np.flatnonzero(block == 0)
    if tissues is not None and free.size:
        clear[free] = _clear(tissues, target, skin.points_mm[free], weights)
        worst[free] = np.maximum(worst[free], crowding(clear[free], weights))
    score = points(length, angle, worst, pleura, weights, longest_mm(weights, limits))
    score[block != 0] = np.nan
    names = tuple(structure.name for structure, _ in avoided)
    return PathScores(
        target_mm=target,
        entries_mm=skin.points_mm,
        score=score,
        block=block,
        length_mm=length,
        angle_deg=angle,
        bone_mm=bone,
        lung_mm=lung,
        vessel_mm=vessel,
        gut_mm=gut,
        heart_mm=heart,
        pleural_deg=pleura,
        clear_mm=clear,
        nearest_mm=nearest,
        nearest=which,
        names=names,
    )


def _chunk(
    target: FloatArray,
    entries: FloatArray,
    outward: FloatArray,
    body: Body,
    avoided: Sequence[Field],
    placement: Placement,
    limits: ReachLimits,
    weights: Weights,
    tissues: TissueField | None,
) -> tuple[NDArray[np.generic], ...]:
    count = len(entries)
    path = target - entries
    length = np.linalg.norm(path, axis=1)
    way = path / np.maximum(length, 1e-9)[:, None]
    cosine = np.clip(-(way * outward).sum(axis=1), -1.0, 1.0)
    angle = np.arccos(cosine) / DEGREE
    block = np.zeros(count, np.intp)
    longest = longest_mm(weights, limits)
    _mark(block, (length > longest) | (length < 1.0), PathObstacle.LONG)
    _mark(block, angle > weights.flattest_deg, PathObstacle.FLAT)
    _mark(block, ~_reached(way, block == 0, placement, limits), PathObstacle.REACH)
    bone, air = np.zeros(count), np.zeros(count)
    nearest, which = np.full(count, np.inf), np.full(count, -1, np.intp)
    worst = np.zeros(count)
    others = {name: np.full(count, np.nan) for name in ("lung", "vessel", "gut", "heart")}
    pleura = np.full(count, np.nan)
    left = np.flatnonzero(block == 0)
    if left.size:
        steps = int(np.ceil(length[left].max() / STEP_MM)) + 1
        shares = np.linspace(0.0, 1.0, steps)
        points = entries[left, None, :] + shares[None, :, None] * path[left, None, :]
        flat = points.reshape(-1, 3)
        hu = interpolate(body.volume.hu, body.volume.voxel(flat)).reshape(len(left), steps)
        bone[left] = (hu > BONE_HU).mean(axis=1) * length[left]
        inside = body.share(flat).reshape(len(left), steps) >= INSIDE_SHARE
        deep = shares[None, :] * length[left, None] > 4.0  # the skin itself is not sharp
        air[left] = (~inside & deep).mean(axis=1) * length[left]
        for number, (structure, distance) in enumerate(avoided):
            least = distance.at(flat).reshape(len(left), steps).min(axis=1)
            closer = least < nearest[left]
            nearest[left[closer]] = least[closer]
            which[left[closer]] = number
            room = structure.warn_mm + weights.free_mm
            worst[left] = np.maximum(worst[left], np.clip(1.0 - least / room, 0.0, 1.0))
        if tissues is not None:
            met = along_paths(tissues, target, points, length[left])
            known = met.unknown_mm < 0.5 * length[left]  # else the values have to tell
            bone[left[known]] = met.bone_mm[known]
            others["lung"][left], others["vessel"][left] = met.lung_mm, met.vessel_mm
            others["gut"][left], others["heart"][left] = met.gut_mm, met.heart_mm
            pleura[left] = met.pleural_deg
        _mark(block, air > 2.0, PathObstacle.AIR)
        _mark(block, bone > weights.most_bone_mm, PathObstacle.BONE)
        _mark(block, others["lung"] > weights.most_lung_mm, PathObstacle.LUNG)
        _mark(block, others["vessel"] > weights.most_vessel_mm, PathObstacle.VESSEL)
        _mark(block, others["gut"] > weights.most_gut_mm, PathObstacle.GUT)
        _mark(block, others["heart"] > weights.most_heart_mm, PathObstacle.HEART)
        _mark(block, nearest <= 0.0, PathObstacle.STRUCTURE)
    return block, length, angle, bone, *others.values(), pleura, nearest, which, worst


def points(
    length_mm: FloatArray,
    angle_deg: FloatArray,
    worst: FloatArray,
    pleural_deg: FloatArray,
    weights: Weights,
    longest: float,
) -> FloatArray:
    """Return the score of paths that are not blocked, 100 to 0, shape (n,).

    Args:
        length_mm: of the paths.
        angle_deg: between path and the skin's normal.
        worst: how near they come to what is to be avoided, 0 far enough to 1 on it.
        pleural_deg: between path and the pleura's normal, NaN where the lung is not entered.
        weights: what counts how much.
        longest: path that is allowed [mm].
    """
    cost = (
        weights.length * np.clip(length_mm / longest, 0.0, 1.0)
        + weights.angle * np.clip(angle_deg / weights.flattest_deg, 0.0, 1.0)
        + weights.clearance * worst
    )
    entered = np.isfinite(pleural_deg)
    cost = cost + np.where(entered, weights.pleura * np.nan_to_num(pleural_deg) / 90.0, 0.0)
    most = weights.length + weights.angle + weights.clearance + weights.pleura * entered
    result: FloatArray = 100.0 * (1.0 - cost / most)
    return result


def longest_mm(weights: Weights, limits: ReachLimits) -> float:
    """Return how long a path may be [mm]."""
    return min(weights.longest_mm, limits.depth_limit / MILLIMETRE)


def crowding(clear_mm: FloatArray, weights: Weights) -> FloatArray:
    """Return how near to what they should not meet paths come, 0 far enough to 1 on it."""
    result: FloatArray = np.clip(1.0 - clear_mm / weights.free_mm, 0.0, 1.0)
    return result


def _clear(
    tissues: TissueField, target: FloatArray, entries: FloatArray, weights: Weights
) -> FloatArray:
    """Return how far paths stay from what the tissue field says they should not meet [mm]."""
    about = ClearField.about(tissues, target, np.vstack([entries, target]), weights.free_mm)
    parts = []
    for start in range(0, len(entries), CHUNK):
        some = entries[start : start + CHUNK]
        steps = int(np.ceil(np.linalg.norm(target - some, axis=1).max() / STEP_MM)) + 1
        shares = np.linspace(0.0, 1.0, steps)[None, :, None]
        parts.append(about.of(some[:, None, :] + shares * (target - some)[:, None, :]).clear_mm)
    return np.concatenate(parts)


def _mark(block: NDArray[np.intp], bad: NDArray[np.bool_], reason: PathObstacle) -> None:
    """Block what is bad and not blocked already."""
    block[bad & (block == 0)] = tuple(PathObstacle).index(reason)


def _reached(
    way: FloatArray, asked: NDArray[np.bool_], placement: Placement, limits: ReachLimits
) -> NDArray[np.bool_]:
    """Return whether the device can point along directions in the patient, where asked."""
    axes = way @ placement.rotation.T
    tilt = np.arctan2(np.hypot(axes[:, 0], axes[:, 1]), -axes[:, 2])
    reached: NDArray[np.bool_] = tilt <= limits.tilt_limit + 1e-9
    for number in np.flatnonzero(reached & asked):
        reached[number] = limits.holds(axes[number])
    return reached


def best(scores: PathScores, count: int = 8, apart_mm: float = 15.0) -> tuple[int, ...]:
    """Numbers of the best paths whose entries lie apart, best first; none is chosen by this."""
    order = np.argsort(-np.nan_to_num(scores.score, nan=-1.0), kind="stable")
    found: list[int] = []
    for number in order[scores.free[order]]:
        gaps = scores.entries_mm[found] - scores.entries_mm[number]
        if not found or np.linalg.norm(gaps, axis=1).min() >= apart_mm:
            found.append(int(number))
        if len(found) == count:
            break
    return tuple(found)
