"""From a running trainer to the facts of the daily check."""

from math import inf

import numpy as np

from app.core.arrays import FloatArray
from app.device.faults import Fault
from app.device.links.link import BoardInfo
from app.device.readiness import ForceClearance, Readiness
from app.session.checks.facts import CameraFacts, DailyFacts, RobotFacts, TouchFacts
from app.session.snapshot import Snapshot
from app.session.touch import Touch
from app.tracking.cameras.watch import CameraHealth, CameraState
from app.tracking.confidence import covariance_radius
from app.tracking.fix import FixStatus
from app.tracking.inspection import InspectedPicture, Inspection
from app.tracking.picture_quality import picture_quality

_WITH_RESIDUAL = (FixStatus.VALID, FixStatus.INCONSISTENT)
_QUIET = (Fault.NONE, Fault.NOT_HOMED)  # homing has a step of its own


def daily_facts(
    snapshot: Snapshot,
    inspection: Inspection,
    robot: RobotFacts,
    touch: TouchFacts | None = None,
    touch_failure: str = "",
) -> DailyFacts:
    """Gather what the cameras say beside what the robot says.

    Args:
        snapshot: newest of the trainer.
        inspection: newest of the tracker; masks are not needed.
        robot: see `robot_facts`.
        touch: newest touch; None before.
        touch_failure: why the last one could not be used.
    """
    fix, statistics = inspection.fix, snapshot.tracker
    health = {one.name: one for one in (statistics.cameras if statistics is not None else ())}
    seen = {one.picture.name: one for one in inspection.pictures}
    names = list(dict.fromkeys([*health, *seen]))
    residual = fix.residual_px if fix is not None and fix.status in _WITH_RESIDUAL else None
    good = fix is not None and fix.status is FixStatus.VALID
    return DailyFacts(
        robot,
        tuple(
            _camera(name, health.get(name), seen.get(name), inspection.rate_hz) for name in names
        ),
        residual,
        "" if good or fix is None else fix.reason,
        inspection.radius,
        touch,
        touch_failure,
    )


def robot_facts(
    snapshot: Snapshot,
    board: BoardInfo | None,
    clearance: ForceClearance | None,
    readiness: Readiness | None,
) -> RobotFacts:
    """Gather what the robot says; without a board it is simulated."""
    device, simulated = snapshot.device, board is None or board.simulated
    fault = Fault(int(device.fault)) if device is not None else Fault.NONE
    boot = board.boot if board is not None else 0
    known = readiness is not None and boot > 0
    return RobotFacts(
        simulated,
        device is not None and device.tick > 0,
        known and readiness is not None and readiness.homed_boot == boot,
        known and readiness is not None and readiness.signs_boot == boot,
        clearance,
        "" if fault in _QUIET else fault.message,
        snapshot.pose.orientation_age if device is not None else inf,
    )


def touch_facts(name: str, p_known: FloatArray, touch: Touch) -> TouchFacts:
    """Compare a touch with where the point is [m], shape (3,)."""
    return TouchFacts(name, np.asarray(p_known), touch.p_world, covariance_radius(touch.covariance))


def _camera(
    name: str, health: CameraHealth | None, seen: InspectedPicture | None, rate: float
) -> CameraFacts:
    trouble = ""
    if health is not None and health.state not in (CameraState.LIVE, CameraState.WAITING):
        trouble = health.text
    picture = seen.picture if seen is not None else None
    quality = picture_quality(picture.image, picture.pixel) if picture is not None else None
    miss = ""
    if picture is None:
        miss = "no picture"
    elif picture.pixel is None:
        miss = (seen.why if seen is not None else "") or "not found"
    delivered = health.figures.rate if health is not None else 0.0
    return CameraFacts(name, trouble, delivered, rate, quality, miss)
