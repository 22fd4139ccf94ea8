"""MuJoCo, and what every model written for it shares: numbers without loss, capsules."""

from __future__ import annotations

import os
import sys
import xml.etree.ElementTree as ET
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from app.core.extras import not_installed
from app.simulation.errors import SimulationError


def import_mujoco(extra: str) -> Any:
    """Return the module `mujoco`, which draws without a display where the computer lets it.

    Args:
        extra: that the caller needs, named where the package is missing.

    Raises:
        SimulationError: if the extra is not installed; names it.
    """
    if sys.platform == "linux":  # it asks when it is imported
        os.environ.setdefault("MUJOCO_GL", "egl")
    try:
        import mujoco
    except ImportError as error:
        raise not_installed(SimulationError, "MuJoCo", extra) from error
    return mujoco


def text(*numbers: float) -> str:
    """Return numbers as an attribute, none of their digits lost."""
    return " ".join(repr(float(number)) for number in numbers)


def line(
    body: ET.Element, start: ArrayLike, end: ArrayLike, radius: float, colour: str, **more: str
) -> ET.Element:
    """Add a capsule from start to end [m] to a body; without `contype` in `more` to be seen only.

    Its mass is that of the body's `inertial`, so it has none.
    """
    touching = more if "contype" in more else {"contype": "0", "conaffinity": "0", **more}
    return ET.SubElement(
        body,
        "geom",
        touching,
        type="capsule",
        fromto=text(*np.asarray(start), *np.asarray(end)),
        size=text(radius),
        mass="0",
        rgba=colour,
    )
