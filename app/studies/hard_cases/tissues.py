"""Hard cases of the tissue field: walls within voxels, along needles, together, and its ends."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.imaging.field import NOBODYS, FieldError, FieldTissue, TissueField, TissueKind
from app.imaging.field.band import distances
from app.imaging.field.walking import walk
from app.studies.hard_cases.case import HardCase, analytic, answers, named

_SIZE = 24
_WAY = np.array([0.36, -0.48, 0.8])  # a unit vector


def _field(levels: tuple[Callable[[FloatArray], FloatArray], ...]) -> TissueField:
    """Label 24³ voxels of 1 mm by signed distances, negative inside, the last on top."""
    k, j, i = np.indices((_SIZE,) * 3)
    points = np.stack([i, j, k], axis=-1).reshape(-1, 3).astype(float)
    labels, level = np.ones(len(points), np.uint8), np.full(len(points), 6.0)
    for code, shape in enumerate(levels, start=2):
        at = shape(points)
        level = np.where(at < 0.0, -at, np.minimum(level, np.abs(at)))
        labels[at < 0.0] = code
    grid = labels.reshape((_SIZE,) * 3)
    distance = distances(grid, np.ones(3), lambda a, b: level[a] / (level[a] + level[b]))
    kinds = (TissueKind.FAT, TissueKind.MUSCLE, TissueKind.ORGAN)
    table = (NOBODYS, *(FieldTissue(n, kind) for n, kind in enumerate(kinds, start=1)))
    return TissueField(grid, distance, np.eye(4), table)


@cache
def _slanted() -> TissueField:
    return _field((lambda p: 11.7 * _WAY.sum() - p @ _WAY,))


@cache
def _upright() -> TissueField:
    return _field((lambda p: 11.5 - p[:, 2],))


@cache
def _meeting() -> TissueField:
    """Two membranes in one place: fat below 11.4 mm, and above it muscle beside organ."""
    return _field((lambda p: 11.4 - p[:, 2], lambda p: np.maximum(11.4 - p[:, 2], 12.3 - p[:, 0])))


@cache
def _with_hole() -> TissueField:
    field = _upright()
    labels = np.array(field.labels)
    labels[8:16, 8:16, 8:16] = 0
    return TissueField(labels, field.distance, field.affine_mm, field.tissues)


def look_up(field: TissueField, points: FloatArray) -> Any:
    """Return codes, and distances of the nearest wall [mm], of points, each of shape (n,)."""
    found = field.look_up(points)
    return found.code, found.wall_mm


def _places(offsets: Any) -> FloatArray:
    foot = np.array([11.7, 11.7, 11.7])
    return np.asarray(foot + np.asarray(offsets)[:, None] * _WAY)


def _nowhere() -> bool:
    far = [[np.nan] * 3, [1e300] * 3, [-1e-9, 5, 5], [5, 5, _SIZE - 1 + 1e-6], [np.inf, 0, 0]]
    found = _slanted().look_up(far)
    return not found.code.any() and bool(np.isfinite(found.wall_mm).all())


def _slant() -> HardCase:
    offsets = np.array([-0.4, -0.2, -0.05, 0.05, 0.2, 0.4])

    def signed(way: Callable[..., Any]) -> FloatArray:
        codes, walls = way(_slanted(), _places(offsets))
        return np.where(codes == 2, walls, -walls)

    return HardCase(
        subsystem="distances",
        case="a wall of tissue across voxels of 1 mm, turned about two axes",
        given="points 0.05 to 0.4 mm on both sides of a plane",
        way=look_up,
        found=signed,
        reference=analytic("the points' distances from the plane", offsets),
        unit="mm",
        bound=0.03,
        beyond=answers("unknown tissue outside the field, and where there is no number", _nowhere),
    )


def _along() -> HardCase:
    def lengths(way: Callable[..., Any]) -> FloatArray:
        found = []
        for off in (-1e-12, 0.0, 1e-12):
            crossed = way(_upright(), [[2.0, 11.0, 11.5 + off], [22.0, 11.0, 11.5 + off]])
            found.append(sum(part.length_mm for part in crossed) - 10.0 * (len(crossed) - 1))
        return np.array(found)

    return HardCase(
        subsystem="distances",
        case="a needle that lies along a wall of tissue, to 1e-12 mm",
        given="20 mm on the wall, and beside it on both sides",
        way=walk,
        found=lengths,
        reference=analytic("one tissue throughout", (20.0, 20.0, 20.0)),
        unit="mm",
        bound=1e-9,
        beyond=answers(
            "no tissue where the way has no length",
            lambda: walk(_upright(), [[2.0, 2.0, 11.5]] * 3) == [],
        ),
    )


def _together() -> HardCase:
    def walls(way: Callable[..., Any]) -> FloatArray:
        _, found = way(_meeting(), np.array([[12.3, 9.0, 11.4], [12.3, 9.5, 11.4]]))
        return np.asarray(found)

    return HardCase(
        subsystem="distances",
        case="two membranes at one place",
        given="the edge at which three tissues meet",
        way=look_up,
        found=walls,
        reference=analytic("a wall where the point is", (0.0, 0.0)),
        unit="mm",
        bound=0.25,
        beyond=named(
            FieldError,
            lambda: TissueField(
                _meeting().labels,
                _meeting().distance,
                _meeting().affine_mm,
                _meeting().tissues[:2],
            ),
        ),
    )


def _hole() -> HardCase:
    def codes(way: Callable[..., Any]) -> FloatArray:
        last = float(_SIZE - 1)
        points = [[12.0, 12.0, 12.0], [last, last, last], [0.0, 0.0, 0.0], [last + 1e-9, 5, 5]]
        return np.asarray(way(_with_hole(), np.array(points))[0], float)

    return HardCase(
        subsystem="distances",
        case="a hole of the tissue field, its last voxel, and 1e-9 mm beyond",
        given="24 voxels of 1 mm, 8 of them without a label",
        way=look_up,
        found=codes,
        reference=analytic("unknown, the two tissues, unknown", (0.0, 2.0, 1.0, 0.0)),
        unit="code",
        bound=0.0,
        beyond=answers("unknown tissue outside the field, and where there is no number", _nowhere),
    )


CASES: Final = (_slant(), _along(), _together(), _hole())
"""Distances."""
