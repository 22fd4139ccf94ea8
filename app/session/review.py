"""What the debrief shows of one attempt, as values; page and report draw the same ones."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.events import Event
from app.core.loading import ONE_AT_A_TIME
from app.core.messages import sentence
from app.core.units import DEGREE, MILLIMETRE
from app.exercises.drill import DrillKind, DrillPart
from app.exercises.scene import scene_of
from app.exercises.schema import Exercise
from app.mechanisms.profile import parse_profile
from app.planning.judged import JudgedPlan
from app.planning.placement import PlacedPlan
from app.scoring.conditions import Conditions
from app.scoring.met import Met
from app.scoring.procedure import ProcedureMarks
from app.scoring.result import Score
from app.scoring.risks import RiskMark
from app.scoring.score import with_shown
from app.scoring.tolerance import Bands
from app.session.ablation_shown import AblationShown
from app.session.along_path import AlongPath
from app.session.attempt_clock import AttemptClock
from app.session.calibration_flag import CalibrationFlags
from app.session.complication_case import KIND as COMPLICATION
from app.session.control_scan import ControlScan
from app.session.ct_facts import UNKNOWN_CT, CtFacts
from app.session.curves import Curves, at_rest, curves
from app.session.drill_choice import drill_for, exercise_in
from app.session.errors import SessionError
from app.session.header import TISSUE_FILE
from app.session.motion import NeedleMotion, motion, needle_length
from app.session.needle import FROM_CAMERAS
from app.session.pad.geometry import PadScale, PathFrame, path_frame
from app.session.pad.view import rings, touch_rings
from app.session.people import NOTHING_SAID, Remarks
from app.session.planned import judged_plan
from app.session.procedure_marks import marks_of, shown_events
from app.session.reasons import AttemptEvidence, reasons
from app.session.recording import Recording
from app.session.result import AttemptResult
from app.session.risks import risk_marks
from app.session.samples import Samples
from app.session.scored import renders_force
from app.session.sidecar import BEING_RECORDED, under_way
from app.session.signature import Signed, judge_whole
from app.session.station import this_station
from app.session.summary import derive
from app.session.timeline import Span, TimeMark, marks, spans
from app.session.tissues import tissues_met
from app.session.touching import KIND, TASK, TargetMarks, marks_at, radius_of
from app.session.verify import Verification, judged_by, verify
from app.simulation.scene import Binding

__all__ = [
    "Review",
    "Span",
    "TimeMark",
    "marks",
    "only_measured",
    "review",
    "review_of_result",
    "spans",
]

SHOWN_EVENTS: Final = ("scan", "touch", "breath", "procedure", "fault", "abort")
"""Kinds of events that are marked on the curves."""

TURN_S: Final = 2.0
"""A correction is a turn of the needle within this time [s]."""

SMALLEST_TURN: Final = 1.0 * DEGREE
"""Less is no correction, but a hand [rad]."""

TISSUE_BEGINS: Final = 0.01
"""Nearer to the skin than this a needle turns freely [m]."""

DEVICE_FILE: Final = "device.json"
"""Attachment that holds the device profile."""

FORCE_LIMIT: Final = 5.0
"""Limit of the force at the hand [N] where the record names none."""


@dataclass(frozen=True, slots=True)
class Correction:
    """The largest turn of the needle in the tissue, and what it would have cost earlier.

    Attributes:
        depth: at which the needle was turned [m].
        angle: by which [rad].
        earlier: a third of that depth [m].
        share: of the side force at the hand that the same turn takes there, for a needle pushed in
            straight, by the attempt's own tissue and needle; None where no tissue was simulated.
    """

    depth: float
    angle: float
    earlier: float
    share: float | None


def correction(
    samples: Samples,
    measured: NDArray[np.bool_],
    force: Callable[[float], float] | None,
) -> Correction | None:
    """Find the largest turn within `TURN_S` in the tissue; None where there is none to speak of.

    Args:
        samples: of the attempt.
        measured: whether the cameras vouch for the depth, shape (n,).
        force: side force at the hand for each radian at a depth [m]: [N/rad]; None if not known.
    """
    inside = np.flatnonzero(measured & (samples.depth > TISSUE_BEGINS))
    if inside.size < 2:
        return None
    time, axis, depth = samples.time[inside], samples.axis[inside], samples.depth[inside]
    later = np.searchsorted(time, time + TURN_S, side="right") - 1
    across = np.linalg.norm(np.cross(axis, axis[later]), axis=1)
    turned = np.arctan2(across, np.einsum("ij,ij->i", axis, axis[later]))
    best = int(np.argmax(turned))
    if not turned[best] >= SMALLEST_TURN:
        return None
    at = float(depth[best] + depth[later[best]]) / 2.0
    earlier = max(at / 3.0, TISSUE_BEGINS)
    there = force(at) if force is not None else 0.0
    share = force(earlier) / there if force is not None and there > 0.0 else None
    return Correction(at, float(turned[best]), earlier, share)


def side_force(recording: Recording, exercise: Exercise | None) -> Callable[[float], float] | None:
    """Side force of an attempt's tissue on its needle: depth [m] -> [N/rad] at the hand.

    None where the exercise has no side stiffness, or the record does not say what it was.
    """
    if exercise is None:
        return None
    with ONE_AT_A_TIME:  # compiled: loaded only where a record has tissue
        from app.simulation.effects import lateral_tissue
    try:
        profile = parse_profile(json.loads(recording.attachments[DEVICE_FILE]), DEVICE_FILE)
        part = exercise.effects["lateral_tissue"]
        known = lateral_tissue.DECLARATION["parameters"]
        values = {name: facts[0] for name, facts in known.items()} | dict(part.parameters)
        binding = Binding(scene_of(exercise, profile), model=part.model or "beam")
        tissue = lateral_tissue.parameters(values, binding)
    except (KeyError, TypeError, ValueError, AcusError):  # another version's; the debrief says less
        return None
    length, shortest = profile.needle_length, values["shortest_lever"]

    def force(depth: float) -> float:
        moment = float(lateral_tissue.rotational_stiffness(tissue, depth))
        return moment / max(length - depth, shortest)

    return force


@dataclass(frozen=True, slots=True, eq=False)
class Review:
    """One attempt.

    Attributes:
        id: of the session.
        student: pseudonym.
        exercise: title.
        started: wall-clock time, ISO 8601.
        state: `ended`, `aborted`, `unfinished`.
        reason: why it was aborted.
        duration: [s].
        scans: control scans taken.
        software: version that recorded it.
        problems: what the record lacks, one line each.
        score: None if there is none.
        curves: figures over time.
        spans: states over time.
        marks: events over time.
        placed: the plan.
        tip: tip as it was to the target [m], shape (n, 3), NaN where not valid: with the target at
            rest its place, with a moving one as far off the path and from the target as it was.
        force_limit: of the device [N].
        measured_force: force across the needle that a gauge measured [N], shape (n,), NaN where it
            did not; None if there was none: then the force is the estimate in `curves`.
        renders: whether something could push the hand; without it there is no curve of the force.
        control_scans: those with slices, in order.
        origin: moment of the first sample [s], from which curves, spans, marks and motion count.
        clock: of the attempt, by which the student is told every time.
        ct: the CT, and how it was read.
        risks: structures of risk, and how near the needle came.
        met: what the needle met; None where the record says nothing of it.
        conditions: what the score was made under; None where nothing is known.
        tip_radius: round the tip that holds the true one with 95 %, median [m]; None if not known.
        correction: the largest turn of the needle in the tissue; None if there was none.
        motion: where the needle was in the patient; None where nothing can be replayed.
        said: what the instructor says of it; no part of the record.
        steps: of the procedure; None without.
        touches: events that tell of targets to be touched; none where there were none.
        tolerances: of the attempt's exercise, by metric; those left out are the default's.
        reasons: metric -> sentences that say why it cost points; those left out cost none, or the
            record does not tell.
        tissue: field of the patient's tissue as the record holds it, where a scan shows what has
            changed in the patient; else empty.
        complications: events of complications, those among them of which nobody was told then.
        planned: what a planner says of the student's own path; None where it was given.
        drill: what it was a drill of; None for a whole exercise.
        practise: the drill that it calls for; None where it calls for none.
        ablation: planned against reached; None where nothing was ablated.
    """

    id: str
    student: str
    exercise: str
    started: str
    state: str
    reason: str
    duration: float
    scans: int
    software: str
    problems: tuple[str, ...]
    score: Score | None
    curves: Curves
    spans: tuple[Span, ...]
    marks: tuple[TimeMark, ...]
    placed: PlacedPlan
    tip: FloatArray
    force_limit: float
    measured_force: FloatArray | None = None
    tip_radius: float | None = None
    renders: bool = True
    control_scans: tuple[ControlScan, ...] = ()
    tissue: bytes = b""
    complications: tuple[Event, ...] = ()
    origin: float = 0.0
    clock: AttemptClock | None = None
    ct: CtFacts = UNKNOWN_CT
    risks: tuple[RiskMark, ...] = ()
    met: tuple[Met, ...] | None = None
    conditions: Conditions | None = None
    correction: Correction | None = None
    motion: NeedleMotion | None = None
    said: Remarks = NOTHING_SAID
    steps: ProcedureMarks | None = None
    touches: tuple[Event, ...] = ()
    tolerances: Mapping[str, Bands] = field(default_factory=dict)
    reasons: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    planned: JudgedPlan | None = None
    drill: DrillPart | None = None
    practise: DrillKind | None = None
    ablation: AblationShown | None = None

    def targets(self, row: int) -> TargetMarks | None:
        """Return the targets that were to be touched as they stood at a sample; None without."""
        if not self.touches or self.motion is None or not len(self.motion):
            return None
        return marks_at(self.touches, self.origin + float(self.motion.time[row]))

    def clock_at(self, moment: float) -> float:
        """Return what the student's clock showed at a moment [s]."""
        return moment - self.origin if self.clock is None else self.clock.at(moment)

    def shown_time(self, time: float) -> float:
        """Return what the student's clock showed at a time of the curves [s]."""
        return self.clock_at(self.origin + time)

    def curve_time(self, shown: float) -> float:
        """Return the time of the curves at which the student's clock showed so many seconds [s]."""
        return shown if self.clock is None else self.clock.moment(shown) - self.origin

    @property
    def rings(self) -> tuple[float, float]:
        """Rings of the pad by the tolerances of the attempt, whether it has points or not [m]."""
        if radius := radius_of(self.touches):
            return touch_rings(radius)
        return rings(self.tolerances)

    @property
    def frame(self) -> PathFrame:
        """Frame of the pad in which the tip's track is drawn."""
        return path_frame(self.placed.axis, self.placed.T_world_patient.rotation)

    @property
    def scale(self) -> PadScale:
        """Scale of the pad."""
        return PadScale(self.placed.length, self.rings[0])

    def track(self) -> FloatArray:
        """Place of the tip on the pad, shape (n, 2), NaN where not valid."""
        frame, scale = self.frame, self.scale
        offsets = np.column_stack(
            [(self.tip - self.placed.p_entry) @ axis for axis in (frame.right, frame.up)]
        )
        lengths = np.hypot(offsets[:, 0], offsets[:, 1])
        radii = scale.radii(np.arctan2(lengths, scale.length))
        with np.errstate(invalid="ignore", divide="ignore"):
            ratio = np.where(lengths > 1e-12, radii / lengths, 0.0)
        result: FloatArray = offsets * np.where(np.isnan(lengths), np.nan, ratio)[:, None]
        return result


def review(recording: Recording) -> Review:
    """Gather what the debrief shows of a record.

    A stored score that cannot be read is no reason to show nothing: it becomes a problem line. A
    record that was altered after it was signed has no score, as in lists; nor has one that is being
    recorded, of which the end is no fault either.

    Raises:
        BrokenRecordingError: if the record holds no plan.
    """
    found = verify(recording)
    summary = CalibrationFlags.read().flagged(derive(recording, found))
    withheld = _withheld(recording)
    placed = recording.placed_plan()
    samples = recording.samples
    measured = np.isin(samples.depth_source, FROM_CAMERAS)
    figures = only_measured(curves(samples, placed), measured)
    origin = float(samples.time[0]) if len(samples.time) else 0.0
    clock = AttemptClock.of(recording.events)
    if clock.began is None:  # of a damaged record, or of an attempt that did not come so far
        clock = AttemptClock(origin)
    score = None if withheld else _shown(recording, found)
    tolerances = judged_by(recording, found.standing)[0]
    rows = () if score is None else score.rows
    deep = next((row for row in rows if row.name == "depth_error"), None)
    past = AttemptEvidence(
        AlongPath.of(samples, placed),
        tolerances,
        gate_mm=rings(tolerances)[0] / MILLIMETRE,
        unsure_mm=(samples.tip_radius() or 0.0) / MILLIMETRE,
        origin=origin,
        clock=clock,
        met=tissues_met(recording.events) or (),
        risks=risk_marks(recording.events),
        planned=judged_plan(recording.events),
        steps=marks_of(recording.events, samples, tissues_met(recording.events)),
        scans=tuple(event.time for event in recording.events if event.kind == "scan"),
        depth_error_mm=None if deep is None else deep.value,
        depth_sd_mm=0.0 if deep is None else deep.sd or 0.0,
    )
    exercise = exercise_in(recording)
    return Review(
        id=summary.id,
        student=summary.student,
        exercise=summary.exercise_title or summary.exercise_id,
        started=summary.started,
        state=summary.state,
        reason=withheld or summary.reason,
        duration=summary.duration,
        scans=summary.scans,
        software=summary.software,
        problems=() if withheld == BEING_RECORDED else summary.problems,
        score=score,
        conditions=summary.conditions,
        curves=figures,
        spans=spans(figures.time, samples.state),
        marks=marks(shown_events(recording.events), origin, SHOWN_EVENTS),
        placed=placed,
        tip=np.where(measured[:, None], at_rest(samples, placed), np.nan),
        force_limit=_force_limit(recording),
        measured_force=samples.measured if np.isfinite(samples.measured).any() else None,
        tip_radius=samples.tip_radius(),
        renders=renders_force(recording.metadata),
        control_scans=(scans := recording.control_scans()),
        tissue=_tissue(recording) if any(scan.inside for scan in scans) else b"",
        complications=tuple(event for event in recording.events if event.kind == COMPLICATION),
        origin=origin,
        clock=clock,
        ct=recording.ct,
        risks=risk_marks(recording.events),
        met=tissues_met(recording.events),
        correction=correction(samples, measured, side_force(recording, exercise)),
        touches=tuple(event for event in recording.events if event.kind in (TASK, KIND)),
        tolerances=tolerances,
        motion=motion(samples, placed, needle_length(recording)) if len(samples.time) else None,
        reasons={row.name: reasons(row.name, past) for _, row in score.losses} if score else {},
        planned=None if withheld else past.planned,
        steps=None if withheld else past.steps,
        drill=None if exercise is None else exercise.drill,
        ablation=AblationShown.of_events(recording.events),
        practise=drill_for(score, past, exercise),
    )


def _tissue(recording: Recording) -> bytes:
    return recording.attachments.get(TISSUE_FILE, b"")


def _withheld(recording: Recording) -> str:
    """Say why a record has no points whatever it holds; empty if it has them."""
    if not recording.path.is_file():
        return ""
    if under_way(recording.path):
        return BEING_RECORDED
    check = judge_whole(recording.path, this_station())
    if check.verdict is not Signed.ALTERED:
        return ""
    return sentence("altered after it was signed: {check}; it has no points", check=check.why)


def only_measured(figures: Curves, measured: NDArray[np.bool_]) -> Curves:
    """Leave out what rests on a depth that the cameras did not vouch for, shape (n,): gaps."""
    return replace(
        figures,
        depth=np.where(measured, figures.depth, np.nan),
        lateral=np.where(measured, figures.lateral, np.nan),
        remaining=np.where(measured, figures.remaining, np.nan),
    )


def review_of_result(result: AttemptResult) -> Review:
    """Gather what the debrief shows of an attempt that has just finished, from memory.

    Raises:
        BrokenRecordingError: if it has no plan.
        SessionError: if there is neither record nor trajectory: nothing was ever measured.
    """
    recording = result.recording
    if recording is None or (result.record is None and result.trajectory is None):
        raise SessionError(
            result.unscored
            or result.reason
            or sentence("the attempt left nothing to show: no valid pose")
        )
    return review(recording)


def _shown(recording: Recording, result: Verification) -> Score | None:
    """Return the score that stands, with the metrics of others that no exercise counts."""
    standing = result.standing
    if standing is None or standing is not result.recomputed:
        return standing
    return with_shown(standing, recording.trajectory())


def _force_limit(recording: Recording) -> float:
    """Largest force at the hand [N] of the recorded device profile."""
    try:
        return float(json.loads(recording.attachments[DEVICE_FILE])["limits"]["hand_force"])
    except (KeyError, TypeError, ValueError):
        return FORCE_LIMIT
