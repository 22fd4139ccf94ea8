"""Colours as DICOM writes them, CIELab, and as screens do, sRGB."""

from typing import Any

import numpy as np

from app.imaging.structures.structure import Colour

_XYZ_TO_RGB = np.array([
    [3.1338561, -1.6168667, -0.4906146],
    [-0.9787684, 1.9161415, 0.0334540],
    [0.0719453, -0.2289914, 1.4052427],
])  # fmt: skip
"""From D50 to linear sRGB (Bradford adapted)."""

_WHITE = (0.96422, 1.0, 0.82521)


def rgb_of(lab: Any) -> Colour:
    """Colour of CIELab values, white point D50 as DICOM has it, in sRGB (IEC 61966-2-1)."""
    fy = (lab[0] + 16.0) / 116.0
    f = np.array([fy + lab[1] / 500.0, fy, fy - lab[2] / 200.0])
    xyz = np.where(f > 6 / 29, f**3, 3 * (6 / 29) ** 2 * (f - 4 / 29)) * _WHITE
    linear = _XYZ_TO_RGB @ xyz
    curve = np.where(linear <= 0.0031308, 12.92 * linear,
                     1.055 * np.clip(linear, 1e-9, None) ** (1 / 2.4) - 0.055)  # fmt: skip
    r, g, b = (int(v) for v in np.rint(255.0 * np.clip(curve, 0.0, 1.0)))
    return r, g, b


def lab_of(colour: Colour) -> Any:
    """CIELab of a colour: L* 0 to 100, a*, b*."""
    c = np.array(colour) / 255.0
    linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    xyz = np.linalg.solve(_XYZ_TO_RGB, linear) / _WHITE
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])
