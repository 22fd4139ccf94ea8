"""Soft organs of the phantom as signed distances [mm], model coordinates."""

from dataclasses import dataclass, replace

import numpy as np

from app.imaging.phantom.patient import Patient
from app.imaging.phantom.shapes import Field, ellipsoid, intersection, smoothstep, union
from app.imaging.phantom.trunk import cavity_radius, diaphragm_height, mediastinum, skin_radius


@dataclass(frozen=True, slots=True)
class Place:
    """Points of the trunk with what many organs need of them.

    Attributes:
        x, y, z: model coordinates [mm], broadcastable.
        skin: distance outwards from the skin.
        wall: distance outwards from the inner surface of the body wall.
        above: height above the diaphragm.
    """

    x: Field
    y: Field
    z: Field
    skin: Field
    wall: Field
    above: Field


def place_of(patient: Patient, x: Field, y: Field, z: Field) -> Place:
    """Look points up in the trunk, arrays of one shape."""
    theta, rho = np.arctan2(y, x), np.hypot(x, y)
    return Place(
        x,
        y,
        z,
        rho - skin_radius(theta, z),
        rho - cavity_radius(patient, theta, z),
        z - diaphragm_height(patient, x, y),
    )


def touching(at: Place, up_mm: float = 4.6) -> Place:
    """Points for organs that fill the dome: they reach so much further up, to the diaphragm."""
    return replace(at, above=at.above - np.float32(up_mm))


def lungs(patient: Patient, at: Place) -> Field:
    """Both lungs, down into the recess between diaphragm and ribs."""
    inside = intersection(at.wall + 2.5, 3.0 - 0.8 * at.above, 4.0)
    both = np.maximum(np.maximum(inside, -mediastinum(at.x, at.y)), 4.0 - heart(patient, at))
    # in front of the heart they touch in patients who have no lobes
    return np.maximum(both, 3.0 - np.abs(at.x - 3.0)) if patient.has_lobes else both


def heart(patient: Patient, at: Place) -> Field:
    """Lower end of the heart."""
    centre = (24.0, -36.0, 302.0 + patient.dome_mm)
    return ellipsoid((at.x, at.y, at.z), centre, (57.0, 45.0, 50.0))


def heart_chambers(patient: Patient, at: Place) -> Field:
    """Blood in both ventricles, the septum between them."""
    up = 312.0 + patient.dome_mm
    left = ellipsoid((at.x, at.y, at.z), (44.0, -28.0, up), (22.0, 24.0, 40.0))
    right = ellipsoid((at.x, at.y, at.z), (2.0, -46.0, up), (30.0, 24.0, 46.0))
    return np.maximum(union(left, right), 5.0 + heart(patient, at))


def liver(patient: Patient, at: Place) -> Field:
    """Right lobe down to its edge, left lobe across the midline, hollowed by kidney and vessels."""
    x, y = at.x, at.y
    lower = 121.0 - patient.liver_drop_mm + 72.0 * smoothstep((x + 100.0) / 120.0)
    lower = lower + 55.0 * smoothstep((x - 8.0) / 62.0)
    behind = smoothstep((y + 22.0 - 0.25 * x) / 46.0) * smoothstep((x + 52.0) / 46.0)
    lower = lower + 130.0 * behind + 26.0 * smoothstep((y - 12.0) / 60.0)
    lower = lower + 3.0 * np.sin(0.06 * x) * np.cos(0.07 * y)
    under = intersection(at.wall + 4.0, 0.75 * (at.above + 4.0), 12.0)
    lobe = intersection(under, 0.55 * (lower - at.z), 9.0)
    lobe = np.maximum(lobe, 8.0 - kidney(patient, at, right=True))
    groove = np.hypot(x + 21.0, y - 6.0) - 13.0  # of the vena cava
    fissure = np.abs(x - 6.0 + 0.2 * y) - 1.2 + 0.06 * np.maximum(at.z - 190.0, 0.0)
    fissure = np.maximum(fissure, np.maximum(-40.0 - y, at.z - 222.0))
    return np.maximum(np.maximum(lobe, -groove), -fissure)


def lesion(patient: Patient, at: Place) -> Field:
    """Return the distance to the lesion to hit: round with a slightly lobed rim."""
    dx, dy, dz = (p - c for p, c in zip((at.x, at.y, at.z), patient.lesion_mm, strict=True))
    rim = 0.9 * (np.sin(0.35 * dx + patient.seed) + np.sin(0.4 * dy) * np.cos(0.33 * dz))
    return np.sqrt(dx * dx + dy * dy + dz * dz) - patient.lesion_radius_mm - rim


def spleen(patient: Patient, at: Place) -> Field:
    """Crescent against the left ribs."""
    outer = ellipsoid((at.x, at.y, at.z), (100.0, 26.0, 202.0), (46.0, 52.0, 46.0))
    hollow = ellipsoid((at.x, at.y, at.z), (62.0, 2.0, 196.0), (48.0, 46.0, 60.0))
    under = intersection(at.wall + 4.0, 0.75 * (at.above + 4.0), 8.0)
    return np.maximum(
        intersection(np.maximum(outer, under), -hollow, 6.0), 7.0 - kidney(patient, at, right=False)
    )


def kidney(patient: Patient, at: Place, right: bool) -> Field:
    """Outline of a kidney, upper pole leaning to the spine."""
    u, v, w = _kidney_frame(patient, at, right)
    bean = ellipsoid((u, v, w), (0.0, 0.0, 0.0), (27.0, 25.0, 55.0))
    hilum = ellipsoid((u, v, w), (-29.0, -4.0, 0.0), (11.0, 9.0, 15.0))
    return intersection(bean, -hilum, 6.0)


def kidney_sinus(patient: Patient, at: Place, right: bool) -> Field:
    """Fat and pelvis in the middle of a kidney."""
    u, v, w = _kidney_frame(patient, at, right)
    return ellipsoid((u, v, w), (-12.0, -2.0, 0.0), (14.0, 7.5, 26.0))


def kidney_medulla(patient: Patient, at: Place, right: bool) -> Field:
    """Pyramids between sinus and cortex."""
    u, v, w = _kidney_frame(patient, at, right)
    shell = np.abs(ellipsoid((u, v, w), (-4.0, 0.0, 0.0), (16.0, 15.0, 40.0))) - 4.2
    spokes = np.cos(7.0 * np.arctan2(v, u + 8.0)) + np.cos(0.42 * w)
    return shell + 3.0 * (0.25 - 0.5 * spokes)


def _kidney_frame(patient: Patient, at: Place, right: bool) -> tuple[Field, Field, Field]:
    """Coordinates of a kidney: lateral, back, up."""
    sign, height = (-1.0, 136.0) if right else (1.0, 150.0)
    w = at.z - height - patient.kidney_mm[0 if right else 1]
    u = sign * at.x - 62.0 + 0.22 * w
    v = at.y - 44.0 + 0.18 * u + 0.06 * w
    return u, v, w


def stomach(patient: Patient, at: Place) -> Field:
    """Fundus and body, tapering towards the pylorus on the right."""
    body = ellipsoid((at.x, at.y, at.z), (58.0, -26.0, 206.0), (40.0, 40.0, 40.0))
    antrum = ellipsoid((at.x, at.y, at.z), (28.0, -52.0, 168.0), (44.0, 20.0, 20.0))
    under = intersection(at.wall + 5.0, 0.75 * (at.above + 5.0), 8.0)
    free = np.maximum(6.0 - spleen(patient, at), 4.0 - liver(patient, at))
    return np.maximum(np.maximum(union(body, antrum, 22.0), under), free)


def gallbladder(at: Place) -> Field:
    """Pear under the liver's edge."""
    return ellipsoid(
        (at.x, at.y + 0.35 * (at.z - 158.0), at.z), (-42.0, -38.0, 158.0), (14.0, 15.0, 26.0)
    )


def pancreas(at: Place) -> Field:
    """Lobulated band across the great vessels."""
    arch = at.y + 14.0 - 0.35 * np.abs(at.x - 5.0) + 3.0 * np.sin(0.22 * at.x)
    height = at.z - 164.0 - 0.22 * at.x
    band = np.hypot(arch / 9.5, height / 13.0)
    ends = np.maximum(-38.0 - at.x, at.x - 78.0)
    lobes = 1.6 * np.sin(0.5 * at.x) * np.sin(0.45 * at.z + 0.4 * at.y)
    return np.maximum((band - 1.0) * 9.5 + lobes, ends)


def psoas(at: Place) -> Field:
    """Both psoas muscles, growing downwards beside the spine."""
    size = smoothstep((165.0 - at.z) / 140.0)
    side = np.abs(at.x) - 31.0 - 10.0 * size
    norm = np.hypot(side / (6.0 + 13.0 * size), (at.y - 30.0 + 4.0 * size) / (8.0 + 13.0 * size))
    return (norm - 1.0) * (6.0 + 13.0 * size)
