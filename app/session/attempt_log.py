"""Everything that one attempt leaves behind: samples, events, its record, and its result."""

from collections.abc import Callable
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from app.core.errors import AcusError
from app.core.events import Event
from app.core.json_values import finite
from app.imaging.field import TissueField
from app.planning.placement import PlacedPlan
from app.scoring.result import Score
from app.scoring.score import with_shown
from app.scoring.trajectory import Trajectory
from app.session import sample as encoding
from app.session.conditions import conditions_of
from app.session.control_scan import scan_marks
from app.session.curves import curves
from app.session.errors import RecordingError, SessionError
from app.session.header import Attachment
from app.session.journal import Journal, Step, carry_out, sealing
from app.session.machine import Attempt
from app.session.planned import event_of as event_of_plan
from app.session.planned import judged_plan_of
from app.session.procedure_marks import marks_of
from app.session.recorder import Recorder
from app.session.recording import Recording, deferred_inputs
from app.session.result import AttemptResult
from app.session.risks import Risk, event_of, risk_marks_of
from app.session.sample import Sample
from app.session.sample_columns import attachment
from app.session.samples import SampleHistory, Samples
from app.session.scored import (
    agreement_of,
    renders_force,
    score_document,
    seen_from,
    trajectory,
)
from app.session.sidecar import write_summary
from app.session.signature import signature_file, signed
from app.session.station import StationKey
from app.session.summary import Summary
from app.session.tissue_force import feels_along
from app.session.tissues import events_of, tissues_met_of
from app.session.touching import touches_of
from app.session.transitions import excused, waited_for_computer
from app.session.verify import SCORE_FILE

Scorer = Callable[[Trajectory], Score]
"""Scores a trajectory; raises an AcusError if it cannot."""


@dataclass(slots=True)
class AttemptLog:
    """Log of one attempt.

    Attributes:
        recorder: its record.
        placed: its plan.
        scorer: scores it.
        history: samples.
        events: events in order.
        scans: control scans taken.
        risks: structures that the needle has to keep away from.
        tissues: field of the patient that tells what the needle met; None for none.
        judges_plan: whether the student chose the path, so that it is judged.
        asks_lung: whether the path report of a lung biopsy is part of that.
    """

    recorder: Recorder
    placed: PlacedPlan
    scorer: Scorer
    history: SampleHistory = field(default_factory=SampleHistory)
    events: list[Event] = field(default_factory=list)
    scans: int = 0
    risks: tuple[Risk, ...] = ()
    tissues: TissueField | None = None
    judges_plan: bool = False
    asks_lung: bool = False

    def open(self, threaded: bool) -> str:
        """Start recording; returns why it cannot be recorded, or nothing."""
        try:
            self.recorder.open()
        except RecordingError as error:
            return str(error)
        if threaded:
            self.recorder.start()
        return ""

    def sample(self, sample: Sample) -> None:
        """Keep a sample, thinned to 100 Hz, and record it."""
        if self.history.add(sample):
            self.recorder.sample(sample)

    def event(self, event: Event) -> None:
        """Keep and record an event."""
        self.events.append(event)
        self.recorder.event(event)

    def finish(self, attempt: Attempt) -> AttemptResult:
        """Score the attempt, finish its record and write its summary."""
        samples = self.history.arrays()
        path, score, unscored = None, None, ""
        try:
            renders = renders_force(self.recorder.header.metadata)
            scans = scan_marks(self.events)
            near = risk_marks_of(samples, self.placed, self.risks)
            for mark in near:
                self.event(event_of(mark))
            head = self.recorder.header
            attached = {a.name: a.data for a in head.attachments}
            felt = feels_along(head.metadata, attached)
            met = tissues_met_of(samples, self.placed, self.tissues, felt)
            for event in events_of(met, samples):
                self.event(event)
            planned = (
                judged_plan_of(self.placed, self.tissues, self.asks_lung)
                if self.judges_plan
                else None
            )
            if planned is not None and len(samples.time):
                self.event(event_of_plan(planned, float(samples.time[-1])))
            path = trajectory(
                samples,
                self.placed,
                attempt.reason,
                renders,
                scans,
                near,
                excused(self.events),
                agreement_of(self.recorder.header.metadata),
                touches_of(self.events),
                met,
                computer=waited_for_computer(self.events),
                seen_from=seen_from(attached),
                planned=planned,
                procedure=marks_of(self.events, samples, met, self.placed),
            )
            score = self.scorer(path)
        except AcusError as error:
            unscored = str(error)
        files = self._files(score, samples)
        summary = self._finish_record(attempt, score, samples, files)
        if score is not None and path is not None:  # not before the record is closed and sealed
            score = with_shown(score, path)
        status = self.recorder.status()
        return AttemptResult(
            summary=summary,
            state=attempt.state,
            reason=attempt.reason,
            duration=summary.duration,
            phases=attempt.phases(attempt.since),
            scans=self.scans,
            score=score,
            unscored=unscored,
            curves=curves(samples, self.placed),
            trajectory=path,
            events=tuple(self.events),
            record=status.path if status.published and not status.failure else None,
            recording=self._recording(attempt, samples, files, summary.problems),
        )

    def _files(self, score: Score | None, samples: Samples) -> tuple[Attachment, ...]:
        """Return what stands at the record's end: the score first, should there be little space."""
        columns = (attachment(samples),) if len(samples.time) else ()
        if score is None:
            return columns
        document = encoding.encode(score_document(score))
        return Attachment(SCORE_FILE, "application/json", document), *columns

    def _result(self, attempt: Attempt) -> dict[str, str]:
        duration = attempt.duration(attempt.since)
        return {
            "state": attempt.state.value,
            "reason": attempt.reason,
            "duration_s": repr(duration),
        }

    def _recording(
        self,
        attempt: Attempt,
        samples: Samples,
        files: tuple[Attachment, ...],
        problems: tuple[str, ...],
    ) -> Recording:
        """Return what the record holds, from memory; its ticks are read if they are wanted."""
        header = self.recorder.header
        status = self.recorder.status()
        return Recording(
            path=status.path,
            complete=not status.failure,
            problems=problems,
            metadata=MappingProxyType({**header.records(), "result": self._result(attempt)}),
            attachments=MappingProxyType({a.name: a.data for a in (*header.attachments, *files)}),
            events=tuple(replace(e, data=finite(dict(e.data))) for e in self.events),
            samples=samples,
            inputs=deferred_inputs(status.path),
        )

    def _finish_record(
        self,
        attempt: Attempt,
        score: Score | None,
        samples: Samples,
        files: tuple[Attachment, ...],
    ) -> Summary:
        header = self.recorder.header
        document = score_document(score) if score is not None else None
        summary = Summary(
            id=header.id,
            started=header.records()["session"]["started"],
            student=header.student,
            exercise_id=header.exercise_id,
            exercise_title=header.exercise_title,
            state=attempt.state.value,
            reason=attempt.reason,
            duration=attempt.duration(attempt.since),
            scans=self.scans,
            score=document,
            conditions=conditions_of(
                header.records(),
                samples,
                score.version if score is not None else 0,
                self.events,
            ),
        )
        if not self.recorder.status().published:
            self.recorder.finish(files, self._result(attempt))
            return self._with_problems(summary)
        return self._end(summary, files, self._result(attempt))

    def _end(
        self, summary: Summary, files: tuple[Attachment, ...], result: dict[str, str]
    ) -> Summary:
        """End the record, sign it and write the summary beside it.

        The signature is planned before the record's last bytes are written, so that no finished
        attempt is without one, whatever ends the program in between. What hinders it is told.
        """
        path, unsigned = self.recorder.status().path, ""
        held = {a.name: a.data for a in (*self.recorder.header.attachments, *files)}
        steps: list[Step] = []
        try:
            key = StationKey.of()
            with ExitStack() as stack:

                def seal(digest: str) -> None:
                    text = signed(path, digest, summary, held, key)
                    steps.append(sealing(path, digest, signature_file(path), text))
                    with suppress(SessionError, OSError):  # then it is signed right after its end
                        stack.enter_context(Journal(path.parent)).plan(steps)

                self.recorder.finish(files, result, seal)
            carry_out(steps)  # nothing where the journal has done it
        except (SessionError, OSError) as error:
            unsigned = f"{path.name} is not signed: {error}"
            self.recorder.finish(files, result)
        summary = self._with_problems(summary, unsigned)
        with suppress(OSError):  # the list derives it from the record, which is complete
            write_summary(path, summary)
        return summary

    def _with_problems(self, summary: Summary, unsigned: str = "") -> Summary:
        """Return the summary with what the record lacks."""
        status = self.recorder.status()
        lost = f"{status.lost_rows} ticks of the loop were lost while recording"
        found = (status.failure, lost if status.lost_rows else "", status.full, unsigned)
        return replace(summary, problems=tuple(text for text in found if text))
