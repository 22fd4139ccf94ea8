"""What the window shows: one frozen value per tick."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from math import hypot, isfinite
from typing import TYPE_CHECKING, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.device.readiness import ForceClearance
from app.device.state import DeviceState
from app.planning.off_path import Offset
from app.planning.placement import PlacedPlan
from app.session.ablation import AblationState
from app.session.complications import ComplicationsState
from app.session.machine import COUNTING, FINAL, State
from app.session.needle import DepthSource, NeedlePose
from app.session.pad.aim import CERTAIN, passes, spread
from app.session.procedure import ProcedureState, ToolInHand
from app.session.recorder import RecordingStatus
from app.session.touching import TargetMarks, TouchState
from app.session.transitions import PauseCause
from app.tracking.fix import FixStatus

if TYPE_CHECKING:
    from app.device.control.timing import Timing
    from app.tracking.statistics import TrackerStatistics


@dataclass(frozen=True, slots=True)
class BreathHold:
    """How a patient stands who holds the breath on command.

    Attributes:
        asked: whether he is asked to.
        held: whether he holds it, so that the target rests.
        left: for how long he still can [s].
        spent: whether he breathes although he is asked: he could not hold it any longer.
    """

    asked: bool = False
    held: bool = False
    left: float = 0.0
    spent: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Snapshot:
    """Everything about the running trainer at one moment.

    Attributes:
        time: moment [s].
        state: the attempt's state.
        reason: why it was aborted; empty otherwise.
        elapsed: time since the attempt began [s]; stands still once it is over.
        phases: time spent per state [s].
        pose: needle, world, predicted to the moment of display (`predicted` says how far); what is
            recorded and scored is the measured one, `measured_pose`.
        offset: from the tip to the target.
        p_target: target now, with its motion [m], shape (3,).
        device: newest state of the loop; None before its first tick.
        timing: lateness of the loop, as it reports it; None before it was asked.
        tracker: statistics of the tracker, as it reports them; None without one.
        fix_status: newest status of the tracker; empty before the first fix.
        scans: control scans taken.
        assistance: dial, 0...1.
        armed: whether forces are armed.
        recording: how the record stands; None before the first attempt.
        messages: what the student should know, one line each, most urgent first.
        held_arming: whether the forces are on only while a key or pedal is held.
        clearance: how much force the device is cleared for; None where nobody is asked.
        withdrawal: what happens, or is to be done, before the attempt can begin with the needle out
            of the skin; empty otherwise.
        may_confirm: whether the student may say that the needle is out.
        ready: whether all is in place and the first movement of the student's hand begins it.
        breath: how the breath-hold stands; None where the patient is not told.
        roll: of a bevelled needle [rad], clockwise seen from the hub; None where none is bevelled.
        measured_pose: the pose as measured, behind by its age; None in snapshots made by hand.
        touch: how the attempt stands with its targets; None where there is nothing to touch.
        procedure: how it stands with the steps of the procedure; None where there are none.
        complications: what the student sees of complications; None where none can happen.
        pause: why the attempt waits; None while it does not.
        simulated: whether robot and cameras both are: nobody can show them a marker.
        out_of_room: time until the student is back from a control scan [s]; None while he is there.
    """

    time: float
    state: State
    reason: str
    elapsed: float
    phases: Mapping[State, float]
    pose: NeedlePose
    offset: Offset
    p_target: FloatArray
    device: DeviceState | None
    timing: Timing | None
    tracker: TrackerStatistics | None
    fix_status: str
    scans: int
    assistance: float
    armed: bool
    recording: RecordingStatus | None
    messages: tuple[str, ...]
    held_arming: bool = False
    clearance: ForceClearance | None = None
    measured_pose: NeedlePose | None = None
    withdrawal: str = ""
    may_confirm: bool = False
    ready: bool = False
    breath: BreathHold | None = None
    roll: float | None = None
    touch: TouchState | None = None
    procedure: ProcedureState | None = None
    complications: ComplicationsState | None = None
    pause: PauseCause | None = None
    simulated: bool = False
    out_of_room: float | None = None

    @property
    def takes_steps(self) -> bool:
        """Return whether a step of the procedure can be done now: while the attempt counts, and
        while it waits for its first movement what needs no needle, which begins it.
        """
        waits = self.ready and self.procedure is not None and self.procedure.checks_left
        return self.state in COUNTING or waits

    @property
    def aim(self) -> PlacedPlan | None:
        """Return the path to the target at hand, where there are several; else None."""
        if self.touch is not None:
            return self.touch.aim
        electrodes = None if self.procedure is None else self.procedure.ablation
        return None if electrodes is None else electrodes.aim

    @property
    def target_marks(self) -> TargetMarks | None:
        """Return the targets as they are drawn, where there are several; else None."""
        if self.touch is not None:
            return self.touch.marks
        electrodes = None if self.procedure is None else self.procedure.ablation
        if electrodes is None:
            return None
        points = np.array([plan.plan.target_mm for plan in electrodes.plans])
        return TargetMarks(points, len(electrodes.electrodes))

    def at_rest(self, placed: PlacedPlan) -> PlacedPlan:
        """Return the plan whose target is the present one where it rests.

        Args:
            placed: of the run.
        """
        return self.aim or placed


def excursion(snapshot: Snapshot) -> float | None:
    """Return how far what breathes is from where the CT has it [m]; None if not told."""
    if snapshot.device is None:
        return None
    return float(np.linalg.norm(snapshot.device.row[sv.BREATH]))


_FIX_TEXT = {
    "out_of_view": "marker out of view",
    "no_picture": "a camera's picture is late",
    "not_yet_visible": "the marker has not come out of the tube yet",
    "one_camera": "marker seen by one camera only",
    "inconsistent": "the cameras disagree about the marker",
    "no_orientation": "the cameras see the marker, but the robot gives no direction",
}


DRAWN_LATE: Final = sentence(
    "this computer is busy: the pictures that it draws for its simulated cameras come late; close "
    "other programs"
)


def unmeasured(pose: NeedlePose) -> str:
    """Say that nobody measures the depth now, why, and what follows from it."""
    why = f" ({pose.doubt})" if pose.doubt else ""
    if not (isfinite(pose.depth_least) and isfinite(pose.depth_most)):
        return sentence("depth not measured{reason}", reason=why)
    low, high = pose.depth_least / MILLIMETRE, pose.depth_most / MILLIMETRE
    return sentence(
        "depth not measured{reason}: it may be anywhere from {low:.0f} to {high:.0f} mm, and "
        "the force is held back for the worst of it",
        reason=why,
        low=low,
        high=high,
    )


def advice(
    pose: NeedlePose,
    fix_status: str,
    fault: str,
    reason: str,
    recording: RecordingStatus | None,
    held_back: str = "",
    waits: str = "",
    simulated: bool = False,
) -> tuple[str, ...]:
    """Messages for the student, most urgent first.

    Args:
        pose: newest pose.
        fix_status: newest status of the tracker; empty before the first fix.
        fault: name of the device's fault; empty if there is none.
        reason: why the attempt was aborted; empty otherwise.
        recording: how the record stands.
        held_back: why the device is not cleared for full force; empty if it is.
        waits: why the attempt waits; empty if it does not.
        simulated: whether this computer draws what the cameras see.
    """
    found = []
    if reason:
        found.append(f"attempt aborted: {reason}")
    if waits:
        found.append(waits)
    if fault:
        found.append(f"no force: {fault}")
    if held_back:
        found.append(held_back)
    if recording is not None and recording.failure:
        found.append(recording.failure)
    if pose.reason:
        found.append(pose.reason)
    if fix_status in _FIX_TEXT:
        late = simulated and fix_status == FixStatus.NO_PICTURE
        found.append(DRAWN_LATE if late else _FIX_TEXT[fix_status])
    if pose.bends:
        found.append(
            sentence(
                "the needle bends: its tip is {pose_deflection:.1f} mm off its line",
                pose_deflection=pose.deflection * 1e3,
            )
        )
    if pose.depth_source is DepthSource.ONE_CAMERA:
        found.append(sentence("depth from one camera and the needle's line: less exact"))
    elif pose.depth_source is DepthSource.HELD:
        found.append(
            sentence("depth held for {pose_depth_age:.0f} ms", pose_depth_age=pose.depth_age * 1e3)
        )
    elif pose.depth_source is DepthSource.MODEL:
        found.append(unmeasured(pose))
    if recording is not None and recording.lost_rows:
        found.append(
            sentence(
                "{recording_lost_rows} ticks of the loop were not recorded",
                recording_lost_rows=recording.lost_rows,
            )
        )
    return tuple(found)


class StepKind(StrEnum):
    """What the student is to do next."""

    START = "start"
    WITHDRAW = "withdraw"
    MOVE = "move"
    SEE = "see"
    WAIT = "wait"
    SCAN = "scan"
    LOOK = "look"
    TILT = "tilt"
    INSERT = "insert"
    FEEL = "feel"
    BONE = "bone"
    DEEPER = "deeper"
    BACK = "back"
    HOLD = "hold"
    TOUCH = "touch"
    STAY = "stay"
    PROCEDURE = "procedure"
    AWAY = "away"
    FINISH = "finish"


def tip_inside(snapshot: Snapshot, live: bool = True) -> bool | None:
    """Return whether the tip is in the body; None where the needle may not be told of.

    Args:
        snapshot: as it may be shown.
        live: whether the needle may be told of; else the snapshot has none.
    """
    return snapshot.pose.measured and snapshot.pose.depth > 0.0 if live else None


@dataclass(frozen=True, slots=True)
class NextStep:
    """One thing to do.

    Attributes:
        kind: what.
        towards: sides of the patient to which the hub goes, the larger part first, of `LRAPSI`.
        distance: along the needle that is left, or too much [m].
        left: until the student is back in the room [s].
        across: way of the tip to a target that is to be touched, across the path to it [m]; of a
            needle to be tilted, how far from the target its line passes.
        touch: how the attempt stands with its targets; None where there is nothing to touch.
        pause: what the attempt waits for that the student cannot mend with the needle; else None.
        procedure: how it stands with the steps of the procedure, where one of them is next.
        inside: whether the tip is in the body then; None where nobody is told.
    """

    kind: StepKind
    towards: str = ""
    distance: float = 0.0
    across: float = 0.0
    touch: TouchState | None = None
    pause: PauseCause | None = None
    procedure: ProcedureState | None = None
    inside: bool | None = False
    left: float = 0.0


ORDERS: Final = frozenset(
    {
        *(StepKind.TILT, StepKind.INSERT, StepKind.FEEL, StepKind.DEEPER, StepKind.BACK),
        *(StepKind.HOLD, StepKind.FINISH),
    }
)
"""Steps that say how the needle is to be moved, and when it is where it belongs."""

_DURING: Final = ORDERS | {StepKind.SCAN, StepKind.LOOK}

NOTCH_WITHIN: Final = 2.0 * MILLIMETRE
"""A notch is at the lesion so near to where it belongs [m]."""

CALM: Final = 0.6
"""Share of a limit below which what was asked for is done: an order does not flicker."""

CALM_SIGMA: Final = 2.0
"""And below the limit by so many standard deviations of what it is measured by."""

SECOND_SIDE: Final = 0.4
"""A side is named beside another where the way towards it is this share of the other's."""


def _see(snapshot: Snapshot) -> NextStep:
    """Have the marker shown to the cameras; where robot and cameras are simulated, wait."""
    if snapshot.simulated:
        return NextStep(StepKind.WAIT, pause=snapshot.pause)
    return NextStep(StepKind.SEE)


class NextSteps:
    """Says at every moment what comes next, by what the program knows and may tell."""

    def __init__(self, placed: PlacedPlan, across: float, along: float) -> None:
        """Begin before the skin.

        Args:
            placed: the plan.
            across: distance off the path within which the tip is at the target [m].
            along: the same along the path [m].
        """
        self._placed, self._across, self._along = placed, across, along
        self._last = StepKind.START

    def of(self, snapshot: Snapshot, live: bool = True, orders: bool = True) -> NextStep:
        """Return the next step.

        Args:
            snapshot: as it may be shown.
            live: whether the needle may be told of at all.
            orders: whether it is said how to move it; else only what must not go on.
        """
        step = self._step(snapshot, live)
        if snapshot.procedure is not None:
            told = step if orders else NextStep(StepKind.LOOK) if step.kind in ORDERS else step
            inside = tip_inside(snapshot, live)
            step = self._in_procedure(told, snapshot, snapshot.procedure, inside)
        if not orders and step.kind in ORDERS:
            step = NextStep(StepKind.LOOK)
        if snapshot.out_of_room is not None and step.kind in (*_DURING, StepKind.PROCEDURE):
            step = NextStep(StepKind.AWAY, left=snapshot.out_of_room)
        self._last = step.kind
        return step

    def _step(self, snapshot: Snapshot, live: bool) -> NextStep:
        if snapshot.state is State.READY or snapshot.state in FINAL:
            return NextStep(StepKind.START)
        if snapshot.state is State.WITHDRAWING:
            return NextStep(StepKind.MOVE if snapshot.ready else StepKind.WITHDRAW)
        if snapshot.pause not in (None, PauseCause.CAMERAS):
            return NextStep(StepKind.WAIT, pause=snapshot.pause)
        if not live:
            return NextStep(StepKind.SCAN)
        if snapshot.state is State.PAUSED or not snapshot.pose.valid:
            return _see(snapshot)
        offset, pose = snapshot.offset, snapshot.pose
        if snapshot.touch is not None:
            return self._to_touch(snapshot, snapshot.touch)
        if snapshot.device is not None and snapshot.device.row[sv.BONE_CONTACT] > 0.0:
            return NextStep(StepKind.BONE)  # whoever pushed on would bend the needle, or turn it
        sigma_across, sigma_along = spread(pose.covariance, offset.path)
        across = max(self._across, CERTAIN * sigma_across)
        along = max(self._along, CERTAIN * sigma_along)
        held = snapshot.state is State.HOLDING  # it counts as there: nothing smaller is asked for
        if pose.measured and -offset.remaining > self._within(
            StepKind.BACK, along, sigma_along, held
        ):
            return NextStep(StepKind.BACK, distance=-offset.remaining)
        # The hub goes to the side that the line passes on; the dot of the bull's-eye stands there.
        length = self._placed.length
        wrong = passes(
            pose.axis, offset.path, offset.across, pose.depth, length, measured=pose.measured
        )
        miss = float(np.linalg.norm(wrong))
        if miss > self._within(StepKind.TILT, across, sigma_across, held):
            return NextStep(StepKind.TILT, self._sides(wrong), across=miss)
        if not pose.measured:
            return NextStep(StepKind.FEEL)
        if pose.depth <= 0.0:
            return NextStep(StepKind.INSERT, distance=offset.remaining)
        if offset.remaining > self._within(StepKind.DEEPER, along, sigma_along, held):
            return NextStep(StepKind.DEEPER, distance=offset.remaining)
        return NextStep(StepKind.FINISH if snapshot.state is State.HOLDING else StepKind.HOLD)

    def _in_procedure(
        self, step: NextStep, snapshot: Snapshot, state: ProcedureState, inside: bool | None
    ) -> NextStep:
        """Say which step of the procedure is next, once the needle is where it belongs.

        Where nobody is told where the needle is, the order of the steps is said all the same.
        """
        if step.kind is StepKind.MOVE:  # what comes first once the attempt runs
            return replace(step, procedure=state)
        if step.kind not in _DURING:
            return step
        own = NextStep(StepKind.PROCEDURE, procedure=state, inside=inside)
        if not inside and (state.checks_left or state.rolled):
            return own
        if state.ablation is not None and state.tool is ToolInHand.ELECTRODE:
            return _in_ablation(step, own, state.ablation)
        if state.tool is ToolInHand.ANAESTHETIC:
            aims = step.kind in (StepKind.TILT, StepKind.LOOK) and not inside
            return step if aims and not state.deposits else own
        if state.tool is not ToolInHand.STYLET or state.part.biopsy is None:
            return own if state.part.biopsy is not None else step
        ends = state.part.rollover is not None and bool(state.samples)
        if step.kind in (StepKind.LOOK, StepKind.SCAN):
            return step if inside is False and not ends else own
        if ends:
            return own
        if step.kind in (StepKind.TILT, StepKind.INSERT, StepKind.FEEL):
            return step
        # The notch lies ahead of the tip: its middle goes to the target, not the tip.
        begin, end = state.part.biopsy.throw(0).notch_span_mm
        left = snapshot.offset.remaining - 0.5 * (begin + end) * MILLIMETRE
        if abs(left) <= max(self._along, NOTCH_WITHIN):
            return own
        return NextStep(StepKind.DEEPER if left > 0.0 else StepKind.BACK, distance=abs(left))

    def _to_touch(self, snapshot: Snapshot, touch: TouchState) -> NextStep:
        """Lead the tip of a tool to the present target: across the path to it, and along."""
        pose, offset = snapshot.pose, snapshot.offset
        if touch.done:
            return NextStep(StepKind.FINISH, touch=touch)
        if not pose.measured:
            return _see(snapshot) if pose.depth > 0.0 else NextStep(StepKind.FEEL)
        if hypot(offset.lateral, offset.remaining) <= touch.task.radius:
            return NextStep(StepKind.STAY, touch=touch)
        if pose.depth <= 0.0:
            return NextStep(StepKind.INSERT, distance=offset.remaining)
        sides = self._sides(-offset.across)
        return NextStep(
            StepKind.TOUCH,
            towards=sides,
            distance=offset.remaining,
            across=offset.lateral,
            touch=touch,
        )

    def _within(self, kind: StepKind, limit: float, sigma: float, held: bool) -> float:
        """Return the limit of a quantity [m]: a smaller one while it is being mended, by more than
        the noise of what it is measured by, unless it is `held`.
        """
        if held or self._last is not kind:
            return limit
        return min(CALM * limit, limit - CALM_SIGMA * sigma)

    def _sides(self, way: FloatArray) -> str:
        """Sides of the patient towards which a way in the world leads."""
        left, back, head = (self._placed.T_world_patient.rotation.T @ way).tolist()
        parts = [
            (abs(left), "RL"[left > 0]),
            (abs(back), "AP"[back > 0]),
            (abs(head), "IS"[head > 0]),
        ]
        parts.sort(reverse=True)
        return parts[0][1] + (parts[1][1] if parts[1][0] > SECOND_SIDE * parts[0][0] else "")


def _in_ablation(step: NextStep, own: NextStep, ablation: AblationState) -> NextStep:
    """Say what is next with electrodes: leave one, draw back for the next, ablate, end."""
    if ablation.reached is not None:
        turns = own.procedure is not None and own.procedure.part.rollover is not None
        return own if turns else NextStep(StepKind.FINISH)
    if ablation.all_placed or own.inside is None:
        return own
    if own.inside and step.kind in (StepKind.HOLD, StepKind.FINISH, StepKind.LOOK):
        return own
    if own.inside and ablation.electrodes and step.kind is StepKind.TILT:
        return replace(own, inside=False)  # it still lies beside the electrode that was left
    return step
