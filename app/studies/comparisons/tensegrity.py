"""The needle holder in the table of machines."""

from collections.abc import Callable
from functools import partial
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms import tensegrity
from app.mechanisms.tensegrity import kernels as guide_kernels
from app.mechanisms.tensegrity.cable_kernels import hub_torque_kernel, tensions_kernel
from app.studies.machines import DEPTH, L_OUT, TILTS_DEG, ComparedMachine, ComparedPlugin, ring


@njit
def _tensegrity_often(
    beta: FloatArray, bars: Any, numbers: Any, l_out: float, out: FloatArray
) -> None:
    for k in range(len(beta)):
        b1, b2 = beta[k, 0], beta[k, 1]
        _, x, y, z = guide_kernels.forward_kernel(b1, b2, *bars, 1.0)
        _, x1, x2, y1, y2, z1, z2 = guide_kernels.jacobian_kernel(b1, b2, x, y, z, *bars)
        load1, load2 = hub_torque_kernel(1.0, -0.5, 0.2, l_out, x1, x2, y1, y2, z1, z2)
        _, out[k, 0], out[k, 1], out[k, 2], out[k, 3], _, _ = tensions_kernel(
            b1, b2, load1, load2, 0.0, 0.0, *numbers
        )


def _tensegrity() -> ComparedMachine:
    geometry, cables = tensegrity.TensegrityGeometry(), tensegrity.Cables()
    steps = tensegrity.ENCODER_LINES * tensegrity.EDGES_PER_LINE

    def joints(d: FloatArray) -> FloatArray:
        return tensegrity.inverse(geometry, -d)

    def turning(d: FloatArray) -> FloatArray:
        return -tensegrity.jacobian(geometry, joints(d))

    def efforts(d: FloatArray, force: FloatArray) -> FloatArray:
        beta = joints(d)
        load = tensegrity.hub_torques(tensegrity.jacobian(geometry, beta), force, L_OUT)
        return tensegrity.tensions(geometry, cables, beta, load).tensions

    def most(d: FloatArray) -> float:
        return tensegrity.force_limit(geometry, cables, joints(d), L_OUT)

    def stiffness(d: FloatArray) -> float:
        pulled = tensegrity.tensions(geometry, cables, joints(d), (0.0, 0.0)).tensions
        values = np.linalg.eigvalsh(tensegrity.guide_stiffness(geometry, cables, -d, pulled))
        return float(np.sort(values)[1]) / L_OUT**2  # the smallest, 0, belongs to the needle

    def tick() -> tuple[Callable[[], object], int]:
        poses = np.concatenate([ring(np.deg2rad(tilt)) for tilt in TILTS_DEG[:-1]])
        beta = np.tile([joints(d) for d in poses], (50, 1))
        out = np.empty((len(beta), 4))
        numbers = (*cables.law, *geometry.radii, *geometry.bars)
        return partial(_tensegrity_often, beta, geometry.bars, numbers, L_OUT, out), len(beta)

    return ComparedMachine(
        "tensegrity (paper)",
        "lengths and encoder lines published; tilts, four edges a line, cables and limits assumed",
        turning,
        lambda d: DEPTH * turning(d),
        2.0 * np.pi / steps,
        efforts,
        "N",
        most,
        stiffness,
        "the cables, winches held, least tensions; the loop can add the same as on any machine",
        tick,
    )


COMPARISON: Final = ComparedPlugin("the needle holder", _tensegrity)
"""What `acus study machines` finds."""
