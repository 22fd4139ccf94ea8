"""What makes cameras and robot disagree: a bent needle, a slipped marker or a bumped camera.

Every fix says how far the band seems beside the robot's line and how far the two pictures miss each
other. A single one means little; over the last seconds each cause leaves its own trace:

- a bumped camera: the pictures miss each other (epipolar residual) or the band is beside the line
  by the same amount wherever the needle is;
- swapped cameras: the pictures agree with left and right exchanged only;
- a bent needle: the pictures agree, and the band is beside the line the more, the deeper it is and
  the harder the hand pushes sideways, along that force;
- a robot or cameras turned: the axis by two bands on the shaft leans to the robot's by the same
  rotation all the time (only rigs with two bands tell that);
- an encoder that stands still or counts backwards: the robot's direction does not follow the one
  that the cameras see turn (`following`);
- a slipped marker: all of that is in order, but the tip is not where it touches a known place.
"""

from collections import deque
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.tracking.following import Following, following

BUMPED: Final = (
    "the two pictures, or pictures and robot, no longer fit each other: a camera was moved; run "
    "the daily check, then calibrate"
)
"""Said of a camera that was moved."""

STUCK: Final = (
    "the cameras see the needle turn and an encoder stands still: check its cable and plug, then "
    "home the robot again"
)
"""Said of an encoder that does not count."""

REVERSED: Final = (
    "the cameras see the needle turn one way and an encoder counts the other: check its plug and "
    "channels, then home the robot and check its signs again"
)
"""Said of an encoder that counts backwards."""

SWAPPED: Final = (
    "the pictures fit with left and right exchanged: the cameras are swapped; put both cables "
    "back, or exchange left and right in the settings"
)
"""Said of swapped cameras."""


def bent(size: float) -> str:
    """Speak of a needle that bends by so much at the deepest [m]."""
    return sentence(
        "the needle bends: up to {size_mm:.1f} mm off its line at the band",
        size_mm=size / MILLIMETRE,
    )


def lean(turn: float) -> str:
    """Speak of an axis by the cameras that is turned from the robot's [rad]."""
    return sentence(
        "the cameras see the needle turned by {turn_deg:.1f}° from the robot's direction: "
        "home the robot again, then run the daily check",
        turn_deg=np.degrees(turn),
    )


def unclear(rms: float) -> str:
    """Speak of a distance beside the line [m] without a cause."""
    return sentence(
        "the cameras see the needle {rms_mm:.1f} mm beside the robot's line: move it "
        "through its whole depth to tell a bent needle from a camera that was moved",
        rms_mm=rms / MILLIMETRE,
    )


def slipped(slip: float) -> str:
    """Speak of a marker that is off along the needle [m]."""
    where = sentence("towards the tip") if slip > 0.0 else sentence("towards the hub")
    return sentence(
        "the tip touches known places {slip_mm:.1f} mm from where the cameras see "
        "it: the marker has slipped {where}; set it back to its mark",
        slip_mm=abs(slip) / MILLIMETRE,
        where=where,
    )


WINDOW: Final = 300
"""Fixes that are looked at: 10 s of 30 Hz."""

ENOUGH: Final = 45
"""Fewer fixes [-] give no verdict."""

EPIPOLAR_LIMIT: Final = 3.0
"""Median residual of the pictures, in standard deviations of one, from which a camera has moved."""

LARGEST_BEND: Final = 8.0 * MILLIMETRE
"""A band further beside the line than this [m] is no bent needle's."""

BESIDE_LIMIT: Final = 3.0
"""RMS distance from the line, in standard deviations, from which there is a cause."""

EXPLAINED: Final = 0.5
"""A cause must leave at most this share of the squared distances, and of what the others leave."""

SPREAD: Final = 15.0 * MILLIMETRE
"""Range of depths [m] below which a growth with depth cannot be told from a constant."""

TURN_LIMIT: Final = 3.0
"""Mean turn of the axis, in standard deviations of one fix, from which something is turned."""

SLIP_LIMIT: Final = 0.5 * MILLIMETRE
"""Mean axial error at touches [m] from which the marker has slipped."""

_NOWHERE: Final = 1000.0
"""What counts as the residual of pictures whose rays do not meet [standard deviations]."""

_OFTEN: Final = 0.9
"""Share of the fixes that are no further beside the line than what is looked at."""

_FORCE: Final = 0.3
"""RMS sideways force [N] from which its direction is believed."""


class DiscrepancyCause(StrEnum):
    """Why cameras and robot disagree."""

    NONE = "none"
    BENT_NEEDLE = "bent_needle"
    SLIPPED_MARKER = "slipped_marker"
    BUMPED_CAMERA = "bumped_camera"
    SWAPPED_CAMERAS = "swapped_cameras"
    ENCODER_STUCK = "encoder_stuck"
    ENCODER_REVERSED = "encoder_reversed"
    TURNED = "turned"  # the axis by two bands is not the robot's
    UNCLEAR = "unclear"  # they disagree, and no cause explains how


@dataclass(frozen=True, slots=True)
class Discrepancy:
    """How cameras and robot disagree over the last seconds.

    Attributes:
        cause: what explains it.
        beside: root mean square distance of the band from the line [m].
        size: of the cause: deflection at the deepest, shift or slip [m].
        words: one line for people; empty for none.
        turn: angle from the robot's axis to that by two bands, of the mean rotation [rad]; 0 where
            the rig has one band.
    """

    cause: DiscrepancyCause = DiscrepancyCause.NONE
    beside: float = 0.0
    size: float = 0.0
    words: str = ""
    turn: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """One fix by both cameras.

    Attributes:
        depth: of the band beyond the fulcrum [m].
        beside: from the line to the band [m], shape (3,), world.
        sigma: standard deviation that this should have, per axis [m].
        epipolar: signed residual of the pictures, in standard deviations.
        force: by the hand on the needle, across it [N], shape (3,), world; zero where unknown.
        turn: rotation from the robot's axis to that by two bands [rad], shape (3,), world; None
            where both are not seen.
        turn_sigma: standard deviation that this should have about either normal [rad].
        exchanged: whether the pictures fit with left and right exchanged only; nothing else of such
            a pair counts.
        axis: needle's direction by the robot, shape (3,), world; None where it is not known.
    """

    depth: float
    beside: FloatArray
    sigma: float
    epipolar: float
    force: FloatArray
    turn: FloatArray | None = None
    turn_sigma: float = 0.0
    exchanged: bool = False
    axis: FloatArray | None = None

    @classmethod
    def of_exchanged(cls) -> "Evidence":
        """Evidence of a pair that fits with left and right exchanged only."""
        return cls(0.0, np.zeros(3), 1.0, 0.0, np.zeros(3), exchanged=True)

    @classmethod
    def of_rays_that_miss(cls) -> "Evidence":
        """Evidence of a pair whose rays meet nowhere before both cameras."""
        return cls(0.0, np.zeros(3), 1.0, _NOWHERE, np.zeros(3))


ENCODERS: Final = (DiscrepancyCause.ENCODER_STUCK, DiscrepancyCause.ENCODER_REVERSED)
"""Causes with which the robot does not know where the needle points: no force can be right."""


class DiscrepancyMonitor:
    """Gathers evidence; not thread-safe, the tracker's thread owns it."""

    def __init__(self) -> None:
        self._evidence: deque[Evidence] = deque(maxlen=WINDOW)
        self._touches: deque[float] = deque(maxlen=10)

    def add(self, evidence: Evidence) -> None:
        """Take in one fix; numbers that are not finite are passed over."""
        numbers = (evidence.depth, *evidence.beside, evidence.sigma, evidence.epipolar)
        turn = (*(evidence.turn if evidence.turn is not None else ()), evidence.turn_sigma)
        if np.isfinite([*numbers, *evidence.force, *turn]).all():
            self._evidence.append(evidence)

    def touch(self, measured: float, known: float) -> None:
        """Take in a touch of a known place: depth by the cameras and its true depth [m]."""
        if np.isfinite([measured, known]).all():
            self._touches.append(measured - known)

    def clear(self) -> None:
        """Forget everything, e.g. after the needle was changed or the cameras calibrated."""
        self._evidence.clear()
        self._touches.clear()

    def verdict(self) -> Discrepancy:
        """Say what the evidence so far means."""
        evidence = [one for one in self._evidence if not one.exchanged]
        exchanged = len(self._evidence) - len(evidence)
        if exchanged >= ENOUGH or exchanged >= max(ENOUGH // 2, len(evidence)):
            return Discrepancy(DiscrepancyCause.SWAPPED_CAMERAS, words=SWAPPED)
        if len(evidence) >= ENOUGH:
            found = self._turned(self._beside(evidence))
            if found.cause is not DiscrepancyCause.NONE:
                return found
        else:
            found = Discrepancy()
        if len(self._touches) >= 2:
            slip = float(np.mean(self._touches))
            scatter = float(np.std(self._touches)) / np.sqrt(len(self._touches))
            if abs(slip) > max(SLIP_LIMIT, 3.0 * scatter):
                return Discrepancy(
                    DiscrepancyCause.SLIPPED_MARKER, found.beside, abs(slip), slipped(slip)
                )
        return found

    def _turned(self, result: Discrepancy) -> Discrepancy:
        """Add the turn of the axis, as the cause where there is no other."""
        both = [(e.turn, e.turn_sigma) for e in self._evidence if e.turn is not None]
        if len(both) < ENOUGH:
            return result
        turn = float(np.linalg.norm(np.mean([turn for turn, _ in both], axis=0)))
        sigma = float(np.median([sigma for _, sigma in both]))
        if result.cause is DiscrepancyCause.NONE and turn > TURN_LIMIT * sigma:
            return replace(result, cause=DiscrepancyCause.TURNED, turn=turn, words=lean(turn))
        return replace(result, turn=turn)

    def _beside(self, evidence: list[Evidence]) -> Discrepancy:
        beside = np.array([e.beside for e in evidence])
        sigma = np.array([e.sigma for e in evidence])
        rms = float(np.sqrt(np.mean(np.sum(beside**2, axis=1))))
        epipolar = float(np.median([e.epipolar for e in evidence]))
        far = float(np.quantile(np.linalg.norm(beside, axis=1), _OFTEN))
        # Pictures that disagree, or fit when they are exchanged, tell nothing of the robot.
        agree = abs(epipolar) <= EPIPOLAR_LIMIT
        whole = agree and len(evidence) == len(self._evidence)
        if whole and far > LARGEST_BEND and (encoder := _encoder(evidence, rms)) is not None:
            return encoder
        if not agree or rms > LARGEST_BEND:
            return Discrepancy(DiscrepancyCause.BUMPED_CAMERA, rms, rms, BUMPED)
        if np.mean(np.sum(beside**2, axis=1) / (2.0 * sigma**2)) < BESIDE_LIMIT**2:
            return Discrepancy(beside=rms)
        return _explained(evidence, beside, rms)


def _encoder(evidence: list[Evidence], rms: float) -> Discrepancy | None:
    """Blame an encoder if the robot's direction does not follow the cameras'; else None."""
    known = [(e.axis, e.depth, e.beside) for e in evidence if e.axis is not None]
    if len(known) < ENOUGH:
        return None
    axes, depths, beside = (np.array(values) for values in zip(*known, strict=True))
    how = following(axes, depths, beside)
    if how is Following.STANDS_STILL:
        return Discrepancy(DiscrepancyCause.ENCODER_STUCK, rms, rms, STUCK)
    if how is Following.BACKWARDS:
        return Discrepancy(DiscrepancyCause.ENCODER_REVERSED, rms, rms, REVERSED)
    return None


def _explained(evidence: list[Evidence], beside: FloatArray, rms: float) -> Discrepancy:
    depth = np.maximum(np.array([e.depth for e in evidence]), 0.0)
    force = np.array([e.force for e in evidence])
    total = float(np.sum(beside**2))
    constant = beside.mean(axis=0)
    left_by_shift = float(np.sum((beside - constant) ** 2))
    # A beam that leaves the fulcrum straight: deflection as depth², and in proportion to a force.
    growth = depth[:, None] ** 2
    bend = (growth * beside).sum(axis=0) / max(float((growth**2).sum()), 1e-30)
    left_by_bend = float(np.sum((beside - growth * bend) ** 2))
    if float(np.sqrt(np.mean(np.sum(force**2, axis=1)))) > _FORCE:
        pattern = growth * force
        compliance = float((pattern * beside).sum()) / float((pattern**2).sum() + 1e-30)
        left_by_bend = min(left_by_bend, float(np.sum((beside - compliance * pattern) ** 2)))
    least = EXPLAINED * total
    if left_by_bend < least and (
        left_by_bend < EXPLAINED * left_by_shift and np.ptp(depth) > SPREAD
    ):
        size = float(np.max(np.linalg.norm(beside, axis=1)))
        return Discrepancy(DiscrepancyCause.BENT_NEEDLE, rms, size, bent(size))
    if left_by_shift < least and np.ptp(depth) > SPREAD:
        return Discrepancy(
            DiscrepancyCause.BUMPED_CAMERA, rms, float(np.linalg.norm(constant)), BUMPED
        )
    return Discrepancy(DiscrepancyCause.UNCLEAR, rms, rms, unclear(rms))
