"""Intercostal arteries and veins along the ribs; of patients who have lobes alone.

From where an artery has reached it, it runs in the costal groove: inside the rib, above its lower
border. Nearer to the spine it runs in the middle of the space. Where it reaches the groove differs:
the rib shields 17 % of arteries 3 cm off the spine and 97 % at 6 cm (Helm et al. 2013, doi
10.1378/chest.12-1285, CT angiography).
"""

from __future__ import annotations

from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.imaging.phantom.patient import Patient
from app.imaging.phantom.shapes import smoothstep
from app.imaging.phantom.skeleton import RIBS
from app.imaging.phantom.trunk import cavity_radius
from app.imaging.phantom.tubes import Tubes

ARTERY_MM, VEIN_MM = 1.0, 1.2
"""Radii."""

_REACHED_MM, _SPREAD_MM = 43.3, 10.6
"""Mean and deviation of where the groove is reached, sideways from the midline: of a normal
distribution with 17 % below 30 mm and 97 % below 60 mm (mean 40.1 mm), and 3.2 mm more: the artery
lies above the border 1.9 mm before, and 1.3 mm nearer to the midline than the rib's middle."""

_RISES_MM: Final = 14.0  # over which it climbs from the middle of the space
_IN_SPACE: Final = (-3.2, -13.0)  # off the rib cage's middle, and below the rib's
_IN_GROOVE: Final = (-4.2, -5.0)
_VEIN_OFF: Final = (-0.8, 2.6)  # from the artery
_RIB_AT: Final = 5.0  # of the rib cage's middle from the wall's inner surface [mm]


def intercostals(patient: Patient) -> tuple[Tubes, Tubes]:
    """Return arteries and veins."""
    rng = patient.generator(13)
    arteries, veins = [], []
    for rib in RIBS:
        for sign in (-1.0, 1.0):
            reached = float(rng.normal(_REACHED_MM, _SPREAD_MM))
            p = np.arange(0.055, rib.end, 0.0011)
            theta = np.arctan2(np.cos(p * np.pi), sign * np.sin(p * np.pi))
            below = rib.z(p)
            for _ in range(2):  # how far aside a place is depends on the wall there
                rho = cavity_radius(patient, theta, below) + _RIB_AT
                aside = rho * np.sin(p * np.pi) * patient.scale[0]
                share = smoothstep((aside - reached + _RISES_MM) / _RISES_MM)
                off, drop = (
                    a + (b - a) * share for a, b in zip(_IN_SPACE, _IN_GROOVE, strict=True)
                )
                below = rib.z(p) + drop
            arteries.append(_balls(patient, theta, below, off, ARTERY_MM))
            out, up = _VEIN_OFF
            veins.append(_balls(patient, theta, below + up, off + out, VEIN_MM))
    return Tubes(np.vstack(arteries)), Tubes(np.vstack(veins))


def _balls(
    patient: Patient, theta: FloatArray, z: FloatArray, off: FloatArray, radius: float
) -> FloatArray:
    rho = cavity_radius(patient, theta, z) + _RIB_AT + off
    width = np.full_like(z, radius)
    return np.column_stack([rho * np.cos(theta), rho * np.sin(theta), z, width])
