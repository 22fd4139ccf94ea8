"""From a snapshot of the trainer to what the widgets show. Pure; nothing here judges anything."""

from collections.abc import Sequence
from math import inf
from typing import Final

from app.device.faults import Fault
from app.session.machine import State
from app.session.snapshot import Snapshot
from app.tracking.cameras.watch import CameraState
from app.tracking.fix import FixStatus
from app.tracking.statistics import TrackerStatistics
from app.views.exercise.camera_view import camera_name
from app.views.exercise.energy_gauge import energy_figures
from app.views.exercise.felt import felt, guidance_limit
from app.views.exercise.live import LiveFigures
from app.views.exercise.status_items import (
    LoopFigures,
    TipTeller,
    depth_item,
    encoder_item,
    heartbeat_item,
    loop_item,
    no_cameras_item,
    recorder_item,
    robot_item,
    tracker_item,
)
from app.views.exercise.tracker_panel import TrackerFigures
from app.views.kit.text import listing, tr, translated
from app.views.kit.verdict import StatusItem

_BAD_STATES = (CameraState.STALLED, CameraState.FROZEN, CameraState.FAILED)


def figures(snapshot: Snapshot, force_limit: float, hidden: bool = False) -> LiveFigures:
    """Live figures for the panel; `force_limit` [N]; `hidden`: of a snapshot without the needle."""
    force = felt(snapshot)
    return LiveFigures(
        state=snapshot.state,
        elapsed=snapshot.elapsed,
        depth=snapshot.pose.depth,
        measured=snapshot.pose.measured,
        angle_error=snapshot.offset.angle,
        lateral=snapshot.offset.lateral,
        to_target=snapshot.offset.remaining,
        force=force.force,
        force_measured=force.measured,
        force_at_most=force.at_most,
        force_limit=force_limit,
        scans=snapshot.scans,
        radius=snapshot.pose.radius if snapshot.pose.measured else None,
        deflection=snapshot.pose.bending,
        deflection_sigma=snapshot.pose.deflection_sigma,
        guidance=guidance_limit(snapshot, force_limit),
        hidden=hidden,
        ready=snapshot.ready,
    )


def status_items(
    snapshot: Snapshot, rate: float, missing: float, heartbeat_age: float, stored: bool = True
) -> tuple[StatusItem, ...]:
    """Health of every part, for the status strip.

    Args:
        snapshot: newest state.
        rate: measured rate of the loop [Hz].
        missing: share of its deadlines that it missed of late, 0…1.
        heartbeat_age: since the window's last sign of life [s].
        stored: whether what runs is somebody's attempt; of a demonstration nothing is kept.
    """
    device, timing, pose = snapshot.device, snapshot.timing, snapshot.pose
    items = []
    if timing is not None:
        loop = LoopFigures(rate, timing.median, timing.p99, missing, timing.missed, timing.ticks)
        items.append(loop_item(loop))
    fault = int(device.fault) if device is not None else 0
    items.append(encoder_item(pose.orientation_age, fault_text(fault)))
    items.append(tracker_status(snapshot))
    items.append(depth_item(str(pose.depth_source), pose.depth_age, teller_of(snapshot)))
    items.append(heartbeat_item(heartbeat_age))
    record = snapshot.recording
    if record is not None and record.failure:
        items.append(recorder_item(False, failure=record.failure))
    else:
        lost = record.lost_rows + record.lost_samples if record is not None else 0
        items.append(recorder_item(stored and bool(record and record.active), lost))
    return tuple(items)


_IN_TISSUE: Final = (State.INSERTING, State.HOLDING, State.PAUSED)


def robot_status(snapshot: Snapshot, items: Sequence[StatusItem]) -> StatusItem:
    """Return the one light of the robot, from the items of `status_items`."""
    device = snapshot.device
    loop = items[0] if snapshot.timing is not None and device is not None else None
    encoders = items[0 if snapshot.timing is None else 1]
    energy = energy_figures(snapshot)
    return robot_item(
        loop,
        encoders,
        items[-2],
        fault_text(int(device.fault)) if device is not None else "",
        energy is not None and energy.acting,
        snapshot.state in _IN_TISSUE and felt(snapshot).at_most,
    )


def teller_of(snapshot: Snapshot) -> TipTeller:
    """Return what tells where the needle is."""
    statistics: TrackerStatistics | None = snapshot.tracker
    if statistics is None:
        return TipTeller(snapshot.simulated)
    return TipTeller(snapshot.simulated, statistics.told_by, statistics.looks_for == "pen")


def tracker_status(snapshot: Snapshot) -> StatusItem:
    """Health of the cameras, or of what tells the needle in their place."""
    statistics: TrackerStatistics | None = snapshot.tracker
    if statistics is None:
        return no_cameras_item()
    age = inf if statistics.age is None else statistics.age
    return tracker_item(
        statistics.rate,
        statistics.valid_share,
        age,
        problem(statistics, snapshot.simulated),
        teller_of(snapshot),
    )


def tracker_figures(snapshot: Snapshot) -> TrackerFigures:
    """Figures below the camera pictures."""
    statistics: TrackerStatistics | None = snapshot.tracker
    if statistics is None:
        return TrackerFigures(0.0, None, tracker_status(snapshot))
    measured = statistics.status in (
        FixStatus.VALID,
        FixStatus.INCONSISTENT,
        FixStatus.ONE_CAMERA,
    )
    return TrackerFigures(
        rate=statistics.rate,
        residual_px=statistics.residual_px if measured else None,
        item=tracker_status(snapshot),
        valid_share=statistics.valid_share,
        latency=statistics.latency,
        skew=statistics.skew.median if statistics.skew is not None else None,
        instead=tr("No camera looks at the needle: {source} tells it", source=told)
        if (told := statistics.told_by)
        else "",
    )


def problem(statistics: TrackerStatistics, simulated: bool = False) -> str:
    """Say what keeps the cameras from a fix, naming the cameras; empty if nothing does.

    A camera that has stopped or failed is said before anything about the marker. `simulated`
    cameras' pictures are late where this computer does not come to draw them.
    """
    troubled = [c for c in statistics.cameras if c.state in _BAD_STATES]
    own = statistics.told_by or statistics.looks_for != "marker"
    if statistics.fault or troubled or (own and statistics.reason):
        return translated(statistics.reason)
    if statistics.status is FixStatus.OUT_OF_VIEW:
        return tr("marker out of view (both cameras)")
    if statistics.status is FixStatus.NOT_YET_VISIBLE:
        return tr("marker still in the tube")
    if statistics.status is FixStatus.NO_PICTURE:
        return (
            tr("pictures come late: this computer is busy, close other programs")
            if simulated
            else tr("a picture is late")
        )
    if statistics.status is FixStatus.ONE_CAMERA:
        names = listing(camera_name(name) for name in statistics.missing)
        return tr("marker out of view ({cameras})", cameras=names)
    if statistics.discrepancy:
        return statistics.discrepancy
    if statistics.status is FixStatus.INCONSISTENT:
        return tr("the cameras disagree")
    return statistics.reason


def fault_text(code: int) -> str:
    """Say what holds the force at zero; empty for 0."""
    if code == 0:
        return ""
    known = code in set(Fault)
    return Fault(code).message if known else tr("fault {code}: no force", code=code)
