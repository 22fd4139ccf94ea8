"""Closed meshes of a pantograph's parts, as STL beside its URDF: from its lengths, in metres.

They are plain shapes for the eye, not [the kit's parts](kit.md): plates with round ends for base
and links, turned bodies for motors and the needle's hub. Each stands in the frame of its link.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import pi
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.mechanisms.pantograph.profile import PantographProfile

WIDTH: Final = 0.012
THICK: Final = 0.008
"""Of a link [m]; the base is twice as wide."""

_SIDES: Final = 24

_MOTOR: Final = ((-0.045, 0.0), (-0.045, 0.016), (-0.008, 0.016), (-0.004, 0.006), (-0.004, 0.0))
_HUB: Final = ((-0.004, 0.0), (-0.004, 0.003), (0.002, 0.005), (0.022, 0.005), (0.022, 0.0))
"""Outlines: along z and away from it [m]."""

_HEADER: Final = b"written by Acus, metres".ljust(80)
_FACET: Final = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])


def meshes_of(profile: PantographProfile) -> dict[str, FloatArray]:
    """Return the triangles [m] of each part, shape (n, 3, 3), counter-clockwise from outside."""
    lengths = profile.geometry
    return {
        "base": _plate(lengths.base, 2.0 * WIDTH, THICK) - np.array([0.0, 0.0, 1.5 * THICK]),
        "motor": _turned(_MOTOR),
        "link1": _plate(lengths.proximal, WIDTH, THICK),
        "link2": _plate(lengths.distal, WIDTH, THICK) + np.array([0.0, 0.0, THICK]),
        "hub": _turned(_HUB),
    }


def stl(triangles: FloatArray) -> bytes:
    """Return triangles, shape (n, 3, 3), as binary STL."""
    facets = np.zeros(len(triangles), _FACET)
    a, b, c = np.moveaxis(triangles, 1, 0)
    normal = np.cross(b - a, c - a)
    facets["normal"] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    facets["corners"] = triangles
    return _HEADER + struct.pack("<I", len(facets)) + facets.tobytes()


def stl_files(profile: PantographProfile, stem: str) -> Mapping[str, bytes]:
    """Return the files of all parts by name: the stem, a hyphen and the part."""
    return {f"{stem}-{part}.stl": stl(shape) for part, shape in meshes_of(profile).items()}


def _plate(length: float, width: float, thick: float) -> FloatArray:
    """Triangles of a plate from one axis to the next, round at both, its middle at z = 0."""
    half = np.linspace(-0.5 * pi, 0.5 * pi, _SIDES // 2 + 1)
    arc = 0.5 * width * np.column_stack([np.cos(half), np.sin(half)])
    outline = np.concatenate([arc + np.array([length, 0.0]), -arc])
    ring = np.column_stack([outline, np.full(len(outline), -0.5 * thick)])
    middle = np.array([0.5 * length, 0.0, -0.5 * thick])
    up = np.array([0.0, 0.0, thick])
    return _closed([middle, middle + up], [ring, ring + up])


def _turned(outline: Sequence[tuple[float, float]]) -> FloatArray:
    """Triangles of a body turned about z; its outline begins and ends on the axis."""
    turn = np.linspace(0.0, 2.0 * pi, _SIDES, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(_SIDES)])
    rings = [radius * circle + np.array([0.0, 0.0, z]) for z, radius in outline[1:-1]]
    ends = [np.array([0.0, 0.0, z]) for z, _ in (outline[0], outline[-1])]
    return _closed(ends, rings)


def _closed(ends: Sequence[FloatArray], rings: Sequence[FloatArray]) -> FloatArray:
    """Join rings of as many points each, counter-clockwise seen from +z, and close both ends."""
    found = []
    for low, high in pairwise(rings):
        a, b, c, d = low, np.roll(low, -1, 0), np.roll(high, -1, 0), high
        found += [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
    for end, ring, forward in ((ends[0], rings[0], False), (ends[1], rings[-1], True)):
        middle = np.broadcast_to(end, ring.shape)
        pair = (ring, np.roll(ring, -1, 0)) if forward else (np.roll(ring, -1, 0), ring)
        found.append(np.stack([middle, *pair], axis=1))
    return np.concatenate(found)
