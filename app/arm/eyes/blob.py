"""The tool in one picture: its pixels by colour, hull, centre of mass and principal axis.

A pixel counts by the share of it that the tool covers, so a flank in the shade counts in full. What
a lamp's reflection has bleached inside the tool's outline is bridged. Of these pixels (x right, y
down) centre and covariance are

    c = Σ wᵢ pᵢ / Σ wᵢ,   C = Σ wᵢ (pᵢ - c)(pᵢ - c)ᵀ / (Σ wᵢ - Σ wᵢ² / Σ wᵢ),

for whole pixels the mean and the covariance with 1/(N - 1) (section 4.2 of the third paper, with
one symbol for the number of pixels). The principal axis, the eigenvector of the larger eigenvalue,
has no sign: its angle ½ atan2(2 C_xy, C_xx - C_yy) lies in (-π/2, π/2], and which end is the tip is
another question (`pose`). Where the eigenvalues cannot be told apart there is no axis.

Uncertainty: a piece ds of the outline that is δ further out moves the centre by (p - c) δ ds / A,
and turns the axis by x y δ ds / (A (λ₁ - λ₂)), x and y along the axes. Of the pieces, each a pixel
long and independent, this adds up to one covariance of centre and angle.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import atan2, cos, hypot, pi, sin
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only, unit
from app.tracking.cameras.camera import Image
from app.tracking.markers.colour import ColourModel
from app.tracking.markers.extractor import Mask
from app.tracking.markers.outline_centroid import strengths

GREEN: Final = ColourModel(bgr=(70.0, 190.0, 60.0), angle_deg=20.0)
"""Colour of the tool of the simulated cameras."""

ROUND_SD: Final = 0.1
"""Standard deviation of the axis' angle [rad] from which on a blob is round: it has no axis."""

_HALF: Final = 0.5
"""Share from which on a pixel belongs to the tool."""

_OTHER: Final = 0.2
"""Area of a second patch, over that of the largest, from which on it is another tool."""

_SPECK: Final = 0.02
"""Area below which a patch is not looked at, over that of the largest."""

_LONGEST: Final = 1.8
"""Area of the hull over that of the blob: more is not one straight thing."""

_LIT: Final = 170
"""Least grey value of all three colours where a lamp is reflected."""

_LIT_SHARE: Final = 0.25
"""Largest area of one reflection over that of the tool: a white thing behind is no reflection."""

_EDGE_PX: Final = 0.05
"""Standard deviation of a piece of the outline besides the picture's noise [px]."""

_ROOM: Final = 16
_AROUND: Final = (25, 25)
"""What is looked at round a tool, and round a pixel of its outline [px]."""

_DARKEST: Final = 0.45
"""Light on a flank over that three pixels further in: what is darker is not the tool's alone."""

_TELLS: Final = 25.0
"""Length of what is behind across the tool's colour [grey levels], below which it says nothing."""

_SQUARE3: Final = np.ones((3, 3), np.uint8)
_SQUARE7: Final = np.ones((7, 7), np.uint8)


class ToolMissReason(StrEnum):
    """Why a picture gives no tool."""

    NOTHING = "nothing in the tool's colour"
    TOO_SMALL = "what has the tool's colour is too small for it"
    TWO_TOOLS = "two tools: take one away"
    NOT_STRAIGHT = "not one straight thing: two tools that cross, or one partly hidden"


@dataclass(frozen=True, slots=True)
class ToolMiss:
    """No tool, and why."""

    reason: ToolMissReason


@dataclass(frozen=True, slots=True, eq=False)
class AreaMoments:
    """Centre and principal axis of an area, in any flat coordinates.

    Attributes:
        area: of it.
        centre: shape (2,).
        covariance: of the area's points, shape (2, 2).
        angle: of the principal axis in (-π/2, π/2], from x towards y; None for a round area.
        spread: covariance of centre and angle, shape (3, 3); zero for the angle where it has none.
    """

    area: float
    centre: FloatArray
    covariance: FloatArray
    angle: float | None
    spread: FloatArray

    @property
    def axis(self) -> FloatArray | None:
        """Unit vector of the principal axis, shape (2,), or None."""
        return None if self.angle is None else np.array([cos(self.angle), sin(self.angle)])

    @property
    def length(self) -> float:
        """Length of the bar of the same variance along the principal axis."""
        return float(np.sqrt(12.0 * np.linalg.eigvalsh(self.covariance)[1]))

    @property
    def elongation(self) -> float:
        """Length over width, at least 1."""
        narrow, wide = np.linalg.eigvalsh(self.covariance)
        return float(np.sqrt(wide / max(float(narrow), 1e-12 * float(wide) + 1e-300)))


@dataclass(frozen=True, slots=True, eq=False)
class ToolBlob:
    """The tool in one picture.

    Attributes:
        pixels: that it covers, columns and rows [px], shape (n, 2).
        shares: of each pixel that it covers, 0 to 1, shape (n,).
        rim: which pixels are the outline's, shape (n,).
        edge_px: standard deviation of a piece of the outline across itself [px].
        moments: of these pixels.
        hull: corners of the convex hull [px], shape (m, 2).
        cut: whether the picture's edge cuts it: the axis counts, the centre is of what is seen.
        bridged: share of the area that was bridged because it is overexposed.
    """

    pixels: FloatArray
    shares: FloatArray
    rim: NDArray[np.bool_]
    edge_px: float
    moments: AreaMoments
    hull: FloatArray
    cut: bool
    bridged: float


def moments(
    points: FloatArray,
    shares: FloatArray,
    areas: FloatArray,
    rim: NDArray[np.bool_],
    edge_px: float,
) -> AreaMoments:
    """Return centre, principal axis and their covariance of pixels in any flat coordinates.

    Args:
        points: where the pixels are, shape (n, 2).
        shares: of each pixel that counts, shape (n,).
        areas: of the pixels in these coordinates, shape (n,); 1 in pixels.
        rim: pixels along the outline, shape (n,).
        edge_px: standard deviation of the outline's place there [px].
    """
    weights = shares * areas
    total = float(weights.sum())
    centre = points[0] + np.asarray(weights @ (points - points[0])) / total
    away = points - centre
    divisor = total - float(weights @ weights) / total
    covariance = (away * weights[:, None]).T @ away / max(divisor, 1e-12 * total)
    wide, twice = float(covariance[0, 0] - covariance[1, 1]), 2.0 * float(covariance[0, 1])
    angle, gap = 0.5 * atan2(twice, wide), hypot(twice, wide)
    if angle <= -0.5 * pi:
        angle = 0.5 * pi
    # A piece of the outline: as long as its pixel is wide, and that far off.
    reach = away[rim]
    moved = edge_px * areas[rim] / total
    along = reach @ [cos(angle), sin(angle)]
    across = reach @ [-sin(angle), cos(angle)]
    turned = along * across * moved
    turn_sd = float(np.linalg.norm(turned))
    found: float | None = angle
    if not turn_sd < ROUND_SD * gap:
        found, turned, gap = None, np.zeros_like(turned), 1.0
    changes = np.column_stack([reach * moved[:, None], turned / gap])
    spread = changes.T @ changes
    return AreaMoments(total, read_only(centre), read_only(covariance), found, read_only(spread))


def find_tool(
    image: Image,
    colour: ColourModel = GREEN,
    noise_grey: float = 4.0,
    area_min: float = 150.0,
) -> ToolBlob | ToolMiss:
    """Find the tool in a picture.

    Args:
        image: blue, green, red, shape (height, width, 3).
        colour: of the tool.
        noise_grey: standard deviation of a grey value, for the covariance.
        area_min: least area [px²].
    """
    strength = strengths(image, colour)
    strong = _of_colour(image, np.asarray(strength > colour.strength, np.uint8), colour)
    if not strong.any():
        return ToolMiss(ToolMissReason.NOTHING)
    x, y, width, height = cv2.boundingRect(strong)
    left, top = max(0, x - _ROOM), max(0, y - _ROOM)
    box = slice(top, y + height + _ROOM), slice(left, x + width + _ROOM)
    share, per_grey = _shares(image[box], strength[box], strong[box])
    body, bridged = _bridged(image[box], np.asarray(share > _HALF, np.uint8))
    one = _one(body, area_min)
    if isinstance(one, ToolMiss):
        return one
    # Whole inside, the share along the outline, nothing beyond it.
    share = np.where(cv2.erode(one, _SQUARE3) | (one & bridged), 1.0, share)
    share = np.where(cv2.dilate(one, _SQUARE3), share, 0.0)
    inner = cv2.erode(one, _SQUARE3, borderType=cv2.BORDER_CONSTANT, borderValue=0)
    rim = (one > 0) & (inner == 0)
    found = np.argwhere(share > 0.0)
    rows, columns = found[:, 0], found[:, 1]
    pixels = found[:, ::-1].astype(np.float64) + np.array([left, top])
    shares, at_rim = share[rows, columns].astype(np.float64), rim[rows, columns]
    on_edge = (pixels <= 0.0) | (pixels >= np.array(image.shape[1::-1]) - 1.0)
    edge_px = hypot(2.0**0.5 * noise_grey * per_grey, _EDGE_PX)  # two mixed pixels across
    measured = moments(pixels, shares, np.ones(shares.shape), at_rim, edge_px)
    corners = cv2.convexHull(pixels[at_rim].astype(np.float32))[:, 0].astype(np.float64)
    return ToolBlob(
        read_only(pixels),
        read_only(shares),
        read_only(at_rim),
        edge_px,
        measured,
        read_only(corners),
        bool(on_edge.any()),
        float((one & bridged).sum()) / float(one.sum()),
    )


def _one(body: Mask, area_min: float) -> Mask | ToolMiss:
    """Return the only tool of a mask, or why there is none."""
    count, labels, statistics, _ = cv2.connectedComponentsWithStats(body)
    areas = statistics[1:count, cv2.CC_STAT_AREA]
    if areas.max(initial=0) < area_min:
        return ToolMiss(ToolMissReason.TOO_SMALL)
    order = np.argsort(-areas)
    if len(order) > 1 and areas[order[1]] >= _OTHER * areas[order[0]]:
        return ToolMiss(ToolMissReason.TWO_TOOLS)
    one = np.asarray(labels == order[0] + 1, np.uint8)
    corners = cv2.convexHull(np.ascontiguousarray(np.argwhere(one), np.int32))
    if cv2.contourArea(corners) > _LONGEST * areas[order[0]]:
        return ToolMiss(ToolMissReason.NOT_STRAIGHT)
    return one


def _of_colour(image: Image, strong: Mask, colour: ColourModel) -> Mask:
    """Leave out patches whose mean colour is another."""
    count, labels, statistics, _ = cv2.connectedComponentsWithStats(strong)
    kept = np.zeros(count, np.uint8)
    areas = statistics[:, cv2.CC_STAT_AREA]
    least = _SPECK * areas[1:].max(initial=0)
    for k in range(1, count):
        if areas[k] >= max(least, 4):
            x, y, w, h = statistics[k, :4]
            box = slice(y, y + h), slice(x, x + w)
            inside = np.asarray(labels[box] == k, np.uint8)
            kept[k] = colour.is_marker(np.array(cv2.mean(image[box], inside)[:3]))
    return kept[labels]


def _shares(image: Image, strength: Mask, strong: Mask) -> tuple[NDArray[np.float32], float]:
    """Share of each pixel that the tool covers, and the error of one over that of a grey value.

    A pixel of share s is s g t + (1 - s) b: the tool's colour t under more or less light g, and
    what is behind, b, as it is a little way off. Across t it shows 1 - s, whatever the light. Where
    b says nothing (it is black, or of the tool's colour) the strength must do, over what is
    strongest within three pixels: nowhere is the share less than that, even where a lamp adds its
    white, or much more.
    """
    near = cv2.dilate(strong, _SQUARE7)
    outside = (near == 0).astype(np.float32)
    colours = image.astype(np.float32)
    seen = cv2.boxFilter(outside, -1, _AROUND, normalize=False)
    behind = cv2.boxFilter(colours * outside[..., None], -1, _AROUND, normalize=False)
    behind /= np.maximum(seen, 1.0)[..., None]
    inside = cv2.erode(strong, _SQUARE3)
    t = unit(np.array(cv2.mean(image, inside if inside.any() else strong)[:3])).astype(np.float32)
    across = behind - (behind @ t)[..., None] * t
    length = np.sqrt(np.einsum("ijk,ijk->ij", across, across))
    through = np.einsum("ijk,ijk->ij", colours, across) / np.maximum(length, 1.0) ** 2
    own = np.where(near, strength, 0).astype(np.float32)
    beside = np.maximum(cv2.dilate(cv2.blur(own, (3, 3)), _SQUARE7), 1.0)
    by_strength = own / beside
    by_colour = np.minimum(1.0 - through, by_strength / _DARKEST)
    share = np.where(length > _TELLS, np.maximum(by_colour, by_strength), by_strength)
    share = np.where(near > 0, np.clip(share, 0.0, 1.0), 0.0).astype(np.float32)
    rim = strong > inside
    usual = float(np.median(length[rim])) if rim.any() else 0.0
    return share, 1.0 / max(usual, _TELLS)


def _bridged(image: Image, body: Mask) -> tuple[Mask, Mask]:
    """Take in what is bleached within the hull of the tool's colour; what was taken in."""
    lit = np.asarray(image.min(axis=2) >= _LIT, np.uint8)
    corners = cv2.convexHull(np.ascontiguousarray(np.argwhere(body)[:, ::-1], np.int32))
    hull = np.zeros_like(body)
    cv2.fillConvexPoly(hull, corners, 1)
    count, labels, statistics, _ = cv2.connectedComponentsWithStats(lit * hull)
    small = statistics[:, cv2.CC_STAT_AREA] <= _LIT_SHARE * int(body.sum())
    small[0] = False
    touching = np.zeros(count, np.bool_)
    touching[np.unique(labels[cv2.dilate(body, _SQUARE7) > 0])] = True
    taken = (small & touching)[labels].astype(np.uint8)
    if taken.any():
        taken = cv2.dilate(taken, _SQUARE3) & hull  # its soft rim
    joined = cv2.morphologyEx(body | taken, cv2.MORPH_CLOSE, _SQUARE3)
    filled = np.zeros_like(body)
    outlines = cv2.findContours(joined, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0]
    cv2.drawContours(filled, outlines, -1, 1, cv2.FILLED)
    return filled, np.asarray(filled & ~body & 1, np.uint8)
