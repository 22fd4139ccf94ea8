"""Bones of the phantom: ribs with their cartilage, vertebrae and iliac wings, model coordinates."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from app.imaging.phantom.shapes import Field, capsule, ellipsoid, smoothstep, union

VERTEBRAE: Final = (-26.0, 10.0, 46.0, 82.0, 118.0, 152.0, 184.0, 213.0, 240.0, 266.0, 291.0, 316.0)
"""Height of the lower end plate of L5's neighbour below, L5 ... L1, T12 ... T7 [mm]."""

SPINE_Y: Final = 27.0
"""How far the centres of the vertebral bodies lie behind the axis [mm]."""

_LUMBAR_BELOW: Final = 170.0


@dataclass(frozen=True, slots=True)
class Rib:
    """A rib's line over p, the share of the way from spine (0) to sternum (1).

    Attributes:
        height: of its vertebra [mm].
        end: p at which bone ends.
        cartilage_end: p at which its cartilage ends, or `end` where it has none.
        cartilage_rise: how far the cartilage climbs [mm].
    """

    height: float
    end: float
    cartilage_end: float
    cartilage_rise: float

    def z(self, p: Field) -> Field:
        """Height of the rib's middle [mm]: falls towards the front, its cartilage rises again."""
        fall = 76.0 * smoothstep(np.minimum(p, self.end) / 0.84)
        span = max(self.cartilage_end - self.end, 1e-6)
        return self.height - fall + self.cartilage_rise * smoothstep((p - self.end) / span)


RIBS: Final = (
    Rib(194.0, 0.34, 0.35, 0.0),
    Rib(223.0, 0.49, 0.51, 0.0),
    Rib(250.0, 0.66, 0.80, 22.0),
    Rib(276.0, 0.70, 0.87, 32.0),
    Rib(301.0, 0.74, 0.92, 32.0),
    Rib(326.0, 0.78, 0.97, 22.0),
    Rib(351.0, 0.80, 0.97, 14.0),
    Rib(376.0, 0.82, 0.97, 10.0),
)
"""Ribs XII to V."""

_FIRST_P, _AROUND_MM = 0.1, 430.0
"""Where the ribs begin; length of the way round, to turn p into millimetres."""

_HALF_HEIGHT, _HALF_THICKNESS = 6.4, 3.6


def rib_distance(off_mm: Field, p: Field, z: Field) -> tuple[Field, Field]:
    """Signed distances to rib bone and to cartilage.

    Args:
        off_mm: radial distance from the middle of the rib cage.
        p: share of the way from spine to sternum, 0 to 1.
        z: height.
    """
    bone = np.full(np.broadcast(off_mm, p, z).shape, 50.0, np.float32)
    cartilage = bone.copy()
    for rib in RIBS:
        dz = z - rib.z(p)
        tube = np.hypot(off_mm / _HALF_THICKNESS, dz / _HALF_HEIGHT)
        distance = (tube - 1.0) * _HALF_THICKNESS
        mm = _AROUND_MM
        np.minimum(bone, np.maximum(distance, mm * np.maximum(_FIRST_P - p, p - rib.end)), out=bone)
        past = mm * np.maximum(rib.end - p, p - rib.cartilage_end)
        np.minimum(cartilage, np.maximum(distance, past), out=cartilage)
    return bone, cartilage


def costal_arch_distance(off_mm: Field, p: Field, z: Field) -> Field:
    """Signed distance to the cartilage along the rim of the chest, arguments as of `rib_distance`.

    From rib X up each cartilage joins the next one; that of rib VII joins the sternum.
    """
    ends = [(rib.cartilage_end, float(rib.z(np.array(rib.cartilage_end)))) for rib in RIBS[2:6]]
    arch = np.full(np.broadcast(off_mm, p, z).shape, 50.0, np.float32)
    for (p0, z0), (p1, z1) in pairwise(ends):
        beside = capsule(_AROUND_MM * p, z, (_AROUND_MM * p0, z0), (_AROUND_MM * p1, z1), 0.0)
        tube = np.hypot(off_mm / _HALF_THICKNESS, beside / _HALF_HEIGHT)
        np.minimum(arch, (tube - 1.0) * _HALF_THICKNESS, out=arch)
    return arch


def rib_neck_distance(side: Field, y: Field, z: float) -> Field:
    """Signed distance to heads and necks of the ribs, from the vertebrae to where ribs begin.

    Args:
        side: distance from the midline.
        y: to the back.
        z: height.
    """
    neck = np.full(np.broadcast(side, y).shape, 50.0, np.float32)
    for rib in RIBS:
        top = float(rib.z(np.array(_FIRST_P)))
        start, end = np.array([11.0, 47.0, rib.height + 2.0]), np.array([25.0, 66.0, top])
        way = end - start
        t = (side - start[0]) * way[0] + (y - start[1]) * way[1] + (z - start[2]) * way[2]
        t = np.clip(t / (way @ way), 0.0, 1.0)
        gap = np.sqrt(
            (side - start[0] - t * way[0]) ** 2
            + (y - start[1] - t * way[1]) ** 2
            + (z - start[2] - t * way[2]) ** 2
        )
        np.minimum(neck, gap - 4.2, out=neck)
    return neck


@dataclass(frozen=True, slots=True)
class SpineSection:
    """What one slice through the spine shows, as signed distances over the slice."""

    bone: Field
    disc: Field
    canal: Field
    end_plate: float


def spine_section(x: Field, y: Field, z: float) -> SpineSection:
    """Cut the spine at a height; `end_plate` is 1 at the end plates and 0 between them."""
    k = int(np.searchsorted(VERTEBRAE, z, side="right")) - 1
    low, high = VERTEBRAE[k], VERTEBRAE[min(k + 1, len(VERTEBRAE) - 1)]
    pitch = high - low
    disc_share = 0.24 if z < _LUMBAR_BELOW else 0.17
    phase = (z - low) / pitch / (1.0 - disc_share)  # 0 to 1 over the bone, above it the disc
    lumbar = float(smoothstep(np.array((215.0 - z) / 80.0)))
    body = _body(x, y, phase, lumbar)
    canal = ellipsoid((x, y), (0.0, SPINE_Y + 25.0), (9.5 + 2.0 * lumbar, 8.0))
    arch = _arch(x, y, phase, lumbar)
    if phase <= 1.0:
        bone = np.maximum(union(body, arch, 3.0), -canal)
        end = float(np.exp(-((min(phase, 1.0 - phase) * pitch / 1.4) ** 2)))
        return SpineSection(bone, np.full_like(body, 50.0), canal, end)
    return SpineSection(np.maximum(arch, -canal), body, canal, 0.0)


def _body(x: Field, y: Field, phase: float, lumbar: float) -> Field:
    waist = 1.6 * np.sin(np.pi * min(max(phase, 0.0), 1.0))
    width, depth = 16.5 + 7.0 * lumbar - waist, 14.5 + 2.5 * lumbar - waist
    oval = ellipsoid((x, y), (0.0, SPINE_Y), (width, depth))
    hollow = ellipsoid((x, y), (0.0, SPINE_Y + depth + 9.0), (12.0, 11.5))
    return -union(-oval, hollow, 3.0)


def _arch(x: Field, y: Field, phase: float, lumbar: float) -> Field:
    """Pedicles, laminae, transverse and spinous processes and facets at this height."""
    side = np.abs(x)
    back = SPINE_Y + 14.0

    def gone(low: float, high: float) -> float:
        """Return how far [mm] the phase is outside a part's share of the vertebra."""
        return 30.0 * max(low - phase, phase - high, 0.0)

    reach = 24.0 + 14.0 * lumbar
    parts = (
        (((13.0, back - 4.0), (14.0, back + 9.0)), 4.6, 0.45, 0.9),  # pedicle
        (((15.0, back + 8.0), (3.0, back + 23.0)), 3.6, 0.1, 0.75),  # lamina
        (((15.0, back + 9.0), (reach, back + 14.0 + 4.0 * (1.0 - lumbar))), 3.4, 0.5, 0.72),
        (((0.0, back + 23.0), (0.0, back + 40.0)), 3.4 + lumbar, 0.0, 0.5),  # spinous
        (((15.0, back + 10.0), (16.0, back + 17.0)), 4.8, -0.2, 0.25),  # lower facet
        (((18.0, back + 9.0), (19.5, back + 13.0)), 4.4, 0.85, 1.35),  # upper facet
    )
    arch = np.full(np.broadcast(x, y).shape, 50.0, np.float32)
    for (start, end), radius, low, high in parts:
        arch = union(arch, capsule(side, y, start, end, radius) + gone(low, high), 2.0)
    return arch


def sternum_distance(x: Field, wall: Field, z: float) -> Field:
    """Signed distance to the lower end of the sternum, in front of the cavity's wall.

    Below stands the xiphoid process; the body is waisted between the cartilages that join it.
    """
    xiphoid = 7.0 * float(np.sqrt(min(1.0, max(0.0, (z - 232.0) / 8.0))))
    body = 9.0 * float(smoothstep(np.array((z - 252.0) / 20.0)))
    waist = 1.6 * float(np.cos(2.0 * np.pi * (z - 278.0) / 24.0)) * body / 9.0
    half_width = max(0.1, xiphoid + body + waist)
    flat = np.hypot(x / half_width, (wall - 5.0) / 4.8)
    return np.maximum((flat - 1.0) * 4.8, np.abs(x) - half_width)


_WING: Final = np.array(
    [
        # side, back, crest, half thickness
        (41.0, 74.0, 30.0, 9.5),
        (54.0, 67.0, 44.0, 7.0),
        (72.0, 54.0, 54.0, 4.2),
        (90.0, 34.0, 58.0, 3.8),
        (105.0, 12.0, 55.0, 4.2),
        (115.0, -6.0, 47.0, 5.0),
        (121.0, -20.0, 33.0, 5.6),
        (123.0, -29.0, 18.0, 5.0),
    ]
)
"""An iliac wing from the sacrum to the anterior spine at the height of L5 [mm]."""

_FLARE: Final = 0.25
"""How far the wings lean outwards for each millimetre up, at their front."""


def pelvis_distance(side: Field, y: Field, z: float) -> Field:
    """Signed distance to one half of the pelvis: the iliac wing under its crest, and the sacrum.

    Args:
        side: distance from the midline.
        y: to the back.
        z: height.
    """
    lean = np.clip((72.0 - _WING[:, 1]) / 60.0, 0.0, 1.0) * _FLARE * z
    knots = np.column_stack([_WING[:, 0] + lean, _WING[:, 1]])
    bone = np.full(np.broadcast(side, y).shape, 50.0, np.float32)
    for (x0, y0), (x1, y1), (top0, half0), (top1, half1) in zip(
        knots[:-1], knots[1:], _WING[:-1, 2:], _WING[1:, 2:], strict=True
    ):
        dx, dy = x1 - x0, y1 - y0
        t = np.clip(((side - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy), 0.0, 1.0)
        below = top0 + t * (top1 - top0) - z
        lip = 2.4 * np.exp(-(((below - 6.0) / 7.0) ** 2))  # the crest is thicker than the wing
        half = (half0 + t * (half1 - half0) + lip) * np.sqrt(np.clip(below / 7.0, 0.0, 1.0))
        gap = np.hypot(side - x0 - t * dx, y - y0 - t * dy)
        np.minimum(bone, np.where(half > 0.3, gap - half, 50.0), out=bone)
    ala = 13.0 * float(np.sqrt(max(0.0, min(1.0, (15.0 - z) / 16.0))))
    if ala > 0.3:
        bone = union(bone, capsule(side, y, (16.0, 42.0), (36.0, 63.0), ala), 3.0)
    return bone
