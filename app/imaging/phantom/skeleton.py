"""Bones of the phantom: ribs with their cartilage, vertebrae and iliac wings, model coordinates."""

from dataclasses import dataclass
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

_FIRST_P: Final = 0.1
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
        mm = 430.0  # length of the way round, to turn p into millimetres
        np.minimum(bone, np.maximum(distance, mm * np.maximum(_FIRST_P - p, p - rib.end)), out=bone)
        past = mm * np.maximum(rib.end - p, p - rib.cartilage_end)
        np.minimum(cartilage, np.maximum(distance, past), out=cartilage)
    return bone, cartilage


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
        """How far [mm] the phase is outside a part's share of the vertebra."""
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
    """Signed distance to the lower end of the sternum, in front of the cavity's wall."""
    half_width = 15.0 * float(np.sqrt(min(1.0, max(0.02, (z - 244.0) / 22.0))))
    return np.maximum(np.abs(x) - half_width, np.abs(wall - 5.0) - 4.6)


def iliac_distance(x: Field, y: Field, z: float) -> Field:
    """Signed distance to the iliac wings, which end at their crests."""
    side = np.abs(x)
    flare = 0.25 * z
    knots = ((42.0, 72.0), (68.0, 58.0), (98.0 + flare, 22.0), (121.0 + flare, -22.0))
    crest = (38.0, 50.0, 58.0, 30.0)
    wing = np.full(np.broadcast(x, y).shape, 50.0, np.float32)
    for n in range(3):
        top = 0.5 * (crest[n] + crest[n + 1])
        radius = (8.0, 4.6, 5.2)[n] * float(np.sqrt(max(0.0, min(1.0, (top - z) / 14.0))))
        if radius > 0.3:
            wing = union(wing, capsule(side, y, knots[n], knots[n + 1], radius), 7.0)
    return wing
