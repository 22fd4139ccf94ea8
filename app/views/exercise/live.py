"""The live figures of an attempt, as the panel shows them."""

from dataclasses import dataclass

from app.session.machine import State
from app.views.exercise.felt import GuidanceLimit


@dataclass(frozen=True, slots=True)
class LiveFigures:
    """One moment of an attempt; SI.

    Attributes:
        state: state of the attempt; None without one.
        elapsed: time since it began [s].
        depth: tip beyond the entry [m].
        measured: whether the cameras vouch for the depth now.
        angle_error: between needle and planned path [rad].
        lateral: tip from the line of the path [m].
        to_target: depth of the target minus depth of the tip, along the path [m].
        force: felt at the hand [N].
        force_measured: whether a gauge measured it; else it is estimated from the torques.
        force_limit: the device's [N].
        force_at_most: whether `force` is only the largest that it can be, as nobody measures the
            depth.
        scans: control scans so far.
        radius: round the tip that holds the true one with 95 % [m]; None while it is not measured.
        deflection: of the tip from the straight needle (`NeedlePose.bending`) [m]; None where it
            is not known.
        deflection_sigma: its standard deviation [m].
        guidance: what holds the force below `force_limit` where the needle is; None if nothing.
        hidden: whether nothing of the needle may be told: only time and scans count then.
        ready: whether the attempt waits for the first movement of the hand.
    """

    state: State | None
    elapsed: float
    depth: float
    measured: bool
    angle_error: float
    lateral: float
    to_target: float
    force: float
    force_measured: bool
    force_limit: float
    scans: int
    radius: float | None = None
    deflection: float | None = None
    deflection_sigma: float = 0.0
    guidance: GuidanceLimit | None = None
    force_at_most: bool = False
    hidden: bool = False
    ready: bool = False
