"""Rays against a needle with a band, in linear light: shares no code with the simulated cameras.

Camera frame; the camera looks from the origin. The needle is a shaft, a cone that ends in the tip
and a band round the shaft; `behind` counts from the tip towards the hub [m].
"""

from typing import NamedTuple

import numpy as np
from numba import njit


class Needle(NamedTuple):
    """Measures [m]."""

    shaft_radius: float
    point_length: float
    length: float
    band_radius: float
    band_from: float
    band_to: float


class Gloss(NamedTuple):
    """Share of the lamp's light that a surface mirrors, and how narrowly (Phong's exponent)."""

    shaft: float
    band: float
    exponent: float


@njit(cache=True)
def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit(cache=True)
def _cylinder(d, tip, axis, radius, nearest, farthest):
    """Distance along the ray and place behind the tip of its first hit; negative without one."""
    da, ta = _dot(d, axis), _dot(tip, axis)
    mm, mc, cc = _dot(d, d) - da * da, _dot(d, tip) - da * ta, _dot(tip, tip) - ta * ta
    root = mc * mc - mm * (cc - radius * radius)
    if root <= 0.0 or mm == 0.0:
        return -1.0, 0.0
    t = (mc - np.sqrt(root)) / mm
    behind = ta - t * da
    if t <= 0.0 or behind < nearest or behind > farthest:
        return -1.0, 0.0
    return t, behind


@njit(cache=True)
def _cone(d, tip, axis, slope, length):
    """The same for the point: radius `slope` times the place behind the tip."""
    da, ta = _dot(d, axis), _dot(tip, axis)
    k = 1.0 + slope * slope
    qa = _dot(d, d) - k * da * da
    qb = _dot(d, tip) - k * da * ta
    qc = _dot(tip, tip) - k * ta * ta
    root = qb * qb - qa * qc
    if root <= 0.0 or abs(qa) < 1e-12:
        return -1.0, 0.0
    best, place = -1.0, 0.0
    for sign in (-1.0, 1.0):
        t = (qb + sign * np.sqrt(root)) / qa
        behind = ta - t * da
        if t > 0.0 and 0.0 <= behind <= length and (best < 0.0 or t < best):
            best, place = t, behind
    return best, place


@njit(cache=True)
def _disc(d, tip, axis, behind, inner, outer):
    """Distance along the ray to a flat ring across the axis; negative without a hit."""
    da = _dot(d, axis)
    if abs(da) < 1e-12:
        return -1.0
    t = (_dot(tip, axis) - behind) / da
    square = 0.0
    for k in range(3):
        square += (t * d[k] - tip[k] + behind * axis[k]) ** 2
    return t if t > 0.0 and inner * inner <= square <= outer * outer else -1.0


@njit(cache=True)
def _first_hit(d, tip, axis, needle):
    """(distance, place behind the tip, part) of what a ray meets: 0 nothing, 1 shaft, 2 band,
    3 cone, 4 a face towards the tip, 5 one towards the hub; faces of the band are 14 and 15."""
    best, place, part = 1e30, 0.0, 0
    t, behind = _cylinder(d, tip, axis, needle.shaft_radius, needle.point_length, needle.length)
    if t > 0.0:
        best, place, part = t, behind, 1
        if needle.band_from <= behind <= needle.band_to:
            part = 2
    slope = needle.shaft_radius / needle.point_length
    t, behind = _cone(d, tip, axis, slope, needle.point_length)
    if 0.0 < t < best:
        best, place, part = t, behind, 3
    t = _disc(d, tip, axis, needle.length, 0.0, needle.shaft_radius)
    if 0.0 < t < best:
        best, place, part = t, needle.length, 5
    if needle.band_radius > needle.shaft_radius:
        t, behind = _cylinder(d, tip, axis, needle.band_radius, needle.band_from, needle.band_to)
        if 0.0 < t < best:
            best, place, part = t, behind, 2
        for end, face in ((needle.band_from, 14), (needle.band_to, 15)):
            t = _disc(d, tip, axis, end, needle.shaft_radius, needle.band_radius)
            if 0.0 < t < best:
                best, place, part = t, end, face
    return best, place, part


@njit(cache=True)
def _normal(t, behind, part, d, tip, axis, slope, out):
    """Unit normal, in place, of the part that a ray meets."""
    if part in (4, 5, 14, 15):
        towards = 1.0 if part in (4, 14) else -1.0
        for k in range(3):
            out[k] = towards * axis[k]
        return
    for k in range(3):
        out[k] = t * d[k] - tip[k] + behind * axis[k]
    length = np.sqrt(_dot(out, out)) + 1e-300
    for k in range(3):
        out[k] /= length
        if part == 3:
            out[k] = (out[k] + slope * axis[k]) / np.sqrt(1.0 + slope * slope)


@njit(cache=True)
def _light(normal, d, light, up, brightness, gloss, exponent):
    """(matte share, mirrored share) of the light that a surface sends along a ray."""
    facing = _dot(normal, light)
    matte = brightness[0] * (0.7 + 0.3 * _dot(normal, up)) + brightness[1] * max(0.0, facing)
    if facing <= 0.0:
        return matte, 0.0
    along = (_dot(light, d) - 2.0 * facing * _dot(normal, d)) / np.sqrt(_dot(d, d))
    return matte, brightness[1] * gloss * max(0.0, along) ** exponent


@njit(cache=True)
def trace(corners, offsets, tip, axis, needle, albedo, gloss, light, up, brightness, out):
    """Add the needle to a picture of linear light.

    Args:
        corners: normalised coordinates of the corners of all pixels, (H + 1, W + 1, 2).
        offsets: of the rays in a pixel, 0 to 1, (n, 2).
        tip: [m], (3,).
        axis: unit vector from hub to tip, (3,).
        needle: a `Needle`.
        albedo: of shaft and band, blue green red, (2, 3).
        gloss: a `Gloss`.
        light: unit vector towards the lamp, (3,).
        up: unit vector towards the bright half of the room, (3,).
        brightness: of room and lamp, (2,).
        out: blue, green, red, share of the needle, share of the band: added to, (H, W, 5).
    """
    slope = needle.shaft_radius / needle.point_length
    widest = max(needle.shaft_radius, needle.band_radius)
    far = np.sqrt(_dot(tip, tip)) + needle.length
    d, normal, count = np.ones(3), np.empty(3), offsets.shape[0]
    for v in range(out.shape[0]):
        for u in range(out.shape[1]):
            for k in range(2):
                d[k] = 0.5 * (corners[v, u, k] + corners[v + 1, u + 1, k])
            beside = (
                (d[1] * axis[2] - axis[1]) * tip[0]
                + (axis[0] - d[0] * axis[2]) * tip[1]
                + (d[0] * axis[1] - d[1] * axis[0]) * tip[2]
            )
            square = _dot(d, d) - _dot(d, axis) ** 2
            pixel = abs(corners[v, u + 1, 0] - corners[v, u, 0])
            if abs(beside) > (widest + 2.0 * pixel * far) * np.sqrt(square):
                continue
            # the same pattern moved about from pixel to pixel: no error repeats along an edge
            right, down = 0.75487766 * u + 0.56984029 * v, 0.34729635 * u + 0.81917251 * v
            for i in range(count):
                p, q = (offsets[i, 0] + right) % 1.0, (offsets[i, 1] + down) % 1.0
                for k in range(2):
                    above = (1.0 - p) * corners[v, u, k] + p * corners[v, u + 1, k]
                    below = (1.0 - p) * corners[v + 1, u, k] + p * corners[v + 1, u + 1, k]
                    d[k] = (1.0 - q) * above + q * below
                t, behind, part = _first_hit(d, tip, axis, needle)
                if part == 0:
                    continue
                _normal(t, behind, part, d, tip, axis, slope, normal)
                band = 1 if part in (2, 14, 15) else 0
                shine = gloss.band if band else gloss.shaft
                matte, mirror = _light(normal, d, light, up, brightness, shine, gloss.exponent)
                for k in range(3):
                    out[v, u, k] += (albedo[band, k] * matte + mirror) / count
                out[v, u, 3] += 1.0 / count
                out[v, u, 4] += band / count
