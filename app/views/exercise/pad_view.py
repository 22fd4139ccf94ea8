"""What the bull's-eye pad and the depth bar show at one moment, as values."""

from collections.abc import Mapping
from dataclasses import dataclass

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.tolerance import Bands
from app.views.exercise.hand import HandLimits
from app.views.exercise.pad_geometry import PadScale, PathFrame


@dataclass(frozen=True, slots=True)
class PadScene:
    """What stays the same during an attempt.

    Attributes:
        frame: axes of the pad.
        scale: radial scale of the pad.
        rings: radii of the tolerance rings [m], from the inside.
        limits: how far the simulated hand may go.
        p_entry: the entry in world [m], shape (3,).
        target_depth: depth of the target beyond the entry [m].
        depth_tolerance: how far from it is still good [m].
        stop_depth: depth that must not be passed [m].
    """

    frame: PathFrame
    scale: PadScale
    rings: tuple[float, ...]
    limits: HandLimits
    p_entry: FloatArray
    target_depth: float
    depth_tolerance: float
    stop_depth: float


@dataclass(frozen=True, slots=True)
class PadView:
    """What changes from frame to frame.

    Attributes:
        direction: needle direction in world, shape (3,).
        p_tip, p_hub: tip and hub point in world [m], shape (3,).
        depth: depth of the tip beyond the entry [m].
        measured: whether the depth is a fresh measurement (else held or from the model).
        force: force felt at the hand [N], estimated.
        force_limit: largest force that the device may give [N].
    """

    direction: FloatArray
    p_tip: FloatArray
    p_hub: FloatArray
    depth: float
    measured: bool
    force: float
    force_limit: float


def rings(tolerances: Mapping[str, Bands] = DEFAULT_TOLERANCES) -> tuple[float, float]:
    """Radii of the rings [m]: the lateral error that counts as expert, and the one that passes.

    An exercise that does not score the lateral error gets the default's rings.
    """
    bands = tolerances.get("lateral_error", DEFAULT_TOLERANCES["lateral_error"])
    return MILLIMETRE * bands.expert, MILLIMETRE * bands.pass_
