"""Trunk of the phantom: skin, fat, muscle wall, body cavity and diaphragm.

Surfaces around the axis are radii over the angle theta = atan2(y, x); those across it are heights
over (x, y). All in model coordinates [mm], see `Patient`.
"""

import numpy as np

from app.imaging.phantom.patient import Patient
from app.imaging.phantom.shapes import Field, smoothstep

SKIN_MM = 2.0
HALF_WIDTH, HALF_DEPTH_FRONT, HALF_DEPTH_BACK = 163.0, 114.0, 100.0


def skin_radius(theta: Field, z: Field) -> Field:
    """Radius of the skin: a superellipse, flatter at the back, with a waist and a spinal furrow."""
    c, s = np.cos(theta), np.sin(theta)
    waist = np.exp(-(((z - 85.0) / 55.0) ** 2))
    chest = smoothstep((z - 170.0) / 130.0)
    width = HALF_WIDTH - 9.0 * waist - 5.0 * chest
    front = HALF_DEPTH_FRONT - 3.0 * waist - 8.0 * chest * np.exp(-((c / 0.25) ** 2))
    depth = np.where(s < 0.0, front, HALF_DEPTH_BACK)
    power = np.where(s < 0.0, 2.25, 2.25 + 0.55 * s)
    radius = ((np.abs(c) / width) ** power + (np.abs(s) / depth) ** power) ** (-1.0 / power)
    furrow = 5.0 * np.exp(-((c / 0.16) ** 2)) * (s > 0.0)
    median = 2.0 * np.exp(-((c / 0.1) ** 2)) * (s < 0.0)
    return radius - furrow - median


def fat_thickness(patient: Patient, theta: Field, z: Field) -> Field:
    """Subcutaneous fat: most in front of the belly and on the hips, least on the back and chest."""
    c, s = np.cos(theta), np.sin(theta)
    front, back = np.maximum(-s, 0.0) ** 2, np.maximum(s, 0.0) ** 2
    hips = smoothstep((70.0 - z) / 90.0) * np.abs(c) ** 2
    share = 0.72 + 0.5 * front - 0.2 * back + 0.55 * hips
    return patient.fat_mm * share * (1.0 - 0.45 * smoothstep((z - 130.0) / 110.0))


def wall_thickness(theta: Field, z: Field) -> Field:
    """Muscle (and rib) wall: thick beside the spine, with the flat recti in front."""
    c, s = np.cos(theta), np.sin(theta)
    back = np.abs(np.arctan2(c, s))  # angle from the posterior midline, 0 to pi
    chest = smoothstep((z - 165.0) / 60.0)
    lumbar = 33.0 * np.exp(-((back / 0.62) ** 4))
    gutter = 27.0 * np.exp(-((back / 0.38) ** 4))
    lateral = 15.0 - 3.0 * chest - 4.5 * np.exp(-(((np.pi - back) / 0.75) ** 4)) * (1.0 - chest)
    return lateral + (1.0 - chest) * lumbar + chest * gutter


def cavity_radius(patient: Patient, theta: Field, z: Field) -> Field:
    """Radius of the inner surface of the wall."""
    outer = skin_radius(theta, z) - SKIN_MM - fat_thickness(patient, theta, z)
    return outer - wall_thickness(theta, z)


def diaphragm_height(patient: Patient, x: Field, y: Field) -> Field:
    """Height of the diaphragm: two domes and the central tendon under the heart."""

    def dome(peak: float, cx: float, cy: float, rx: float, ry: float, drop: float) -> Field:
        return peak - drop * (((x - cx) / rx) ** 2 + ((y - cy) / ry) ** 2)

    right = dome(262.0, -66.0, -6.0, 78.0, 92.0, 72.0)
    left = dome(249.0, 74.0, -4.0, 78.0, 92.0, 68.0)
    tendon = dome(247.0, 6.0, -26.0, 84.0, 84.0, 40.0)
    soft = 8.0
    total = sum(np.exp((surface - 250.0) / soft) for surface in (right, left, tendon))
    ripple = 2.0 * np.sin(0.055 * x + 0.8) * np.sin(0.07 * y)
    return np.maximum(soft * np.log(total + 1e-12) + 250.0, 120.0) + ripple + patient.dome_mm


def mediastinum(x: Field, y: Field) -> Field:
    """Signed distance to what lies between the lungs: great vessels, gullet, spine."""
    norm = np.sqrt(((x - 3.0) / 31.0) ** 2 + ((y - 22.0) / 46.0) ** 2)
    return (norm - 1.0) * 34.0
