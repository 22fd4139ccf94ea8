"""What the debrief shows of one attempt, as values; page and report draw the same ones."""

import json
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.planning.placement import PlacedPlan
from app.scoring.conditions import Conditions
from app.scoring.result import Score
from app.scoring.risks import RiskMark
from app.session.calibration_flag import CalibrationFlags
from app.session.control_scan import ControlScan
from app.session.ct_facts import UNKNOWN_CT, CtFacts
from app.session.curves import Curves, at_rest, curves
from app.session.errors import SessionError
from app.session.needle import FROM_CAMERAS
from app.session.pad.geometry import PadScale, PathFrame, path_frame
from app.session.pad.view import rings
from app.session.recording import Recording
from app.session.result import AttemptResult
from app.session.risks import risk_marks
from app.session.scored import renders_force
from app.session.summary import derive
from app.session.timeline import Span, TimeMark, marks, spans
from app.session.verify import verify

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

SHOWN_EVENTS: Final = ("scan", "fault", "abort")
"""Kinds of events that are marked on the curves."""

DEVICE_FILE: Final = "device.json"
"""Attachment that holds the device profile."""

FORCE_LIMIT: Final = 5.0
"""Limit of the force at the hand [N] where the record names none."""


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
        origin: moment that their times are told from [s].
        ct: the CT, and how it was read.
        risks: structures of risk, and how near the needle came.
        conditions: what the score was made under; None where nothing is known.
        tip_radius: round the tip that holds the true one with 95 %, median [m]; None if not known.
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
    origin: float = 0.0
    ct: CtFacts = UNKNOWN_CT
    risks: tuple[RiskMark, ...] = ()
    conditions: Conditions | None = None

    @property
    def rings(self) -> tuple[float, float]:
        """Rings of the pad by the tolerances that the attempt was judged by [m]."""
        rows = self.score.rows if self.score is not None else ()
        return rings({row.name: row.tolerance for row in rows if row.tolerance is not None})

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

    A stored score that cannot be read is no reason to show nothing: it becomes a problem line.

    Raises:
        BrokenRecordingError: if the record holds no plan.
    """
    found = verify(recording)
    summary = CalibrationFlags.read().flagged(derive(recording, found))
    placed = recording.placed_plan()
    samples = recording.samples
    measured = np.isin(samples.depth_source, FROM_CAMERAS)
    figures = only_measured(curves(samples, placed), measured)
    origin = float(samples.time[0]) if len(samples.time) else 0.0
    return Review(
        id=summary.id,
        student=summary.student,
        exercise=summary.exercise_title or summary.exercise_id,
        started=summary.started,
        state=summary.state,
        reason=summary.reason,
        duration=summary.duration,
        scans=summary.scans,
        software=summary.software,
        problems=summary.problems,
        score=found.standing,
        conditions=summary.conditions,
        curves=figures,
        spans=spans(figures.time, samples.state),
        marks=marks(recording.events, origin, SHOWN_EVENTS),
        placed=placed,
        tip=np.where(measured[:, None], at_rest(samples, placed), np.nan),
        force_limit=_force_limit(recording),
        measured_force=samples.measured if np.isfinite(samples.measured).any() else None,
        tip_radius=samples.tip_radius(),
        renders=renders_force(recording.metadata),
        control_scans=recording.control_scans(),
        origin=origin,
        ct=recording.ct,
        risks=risk_marks(recording.events),
    )


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
            result.unscored or result.reason or "the attempt left nothing to show: no valid pose"
        )
    return review(recording)


def _force_limit(recording: Recording) -> float:
    """Largest force at the hand [N] of the recorded device profile."""
    try:
        return float(json.loads(recording.attachments[DEVICE_FILE])["limits"]["hand_force"])
    except (KeyError, TypeError, ValueError):
        return FORCE_LIMIT
