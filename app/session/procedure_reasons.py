"""Why steps of a procedure cost points: each sample, deposit and open hub, in words."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from app.core.messages import joined, sentence
from app.scoring.procedure import ProcedureMarks, SampleMark, TurningMark

Moment = Callable[[float], str]
"""Tells a monotonic time [s] as the student's clock showed it."""

OF_SAMPLES: Final = frozenset({"diagnostic_samples", "lesion_in_sample", "throw_hits"})


def procedure_reasons(metric: str, steps: ProcedureMarks | None, moment: Moment) -> tuple[str, ...]:
    """Say why a metric of a step cost points; empty for every other one.

    Args:
        metric: its name.
        steps: of the attempt; None without.
        moment: tells the time of a step.
    """
    if steps is None:
        return ()
    if metric in OF_SAMPLES:
        return tuple(
            _sample(number, sample, moment) for number, sample in enumerate(steps.samples, start=1)
        ) or (sentence("No sample was taken."),)
    if metric == "anaesthetic_gap":
        return _deposits(steps, moment)
    if metric == "pierced_by_anaesthetic":
        return tuple(
            sentence(
                "The needle for local anaesthetic: {met}, at {clock}.",
                met=met.sentence,
                clock=moment(met.time),
            )
            for met in steps.pierced
        )
    if metric == "checklist_done" and steps.checked < 1.0:
        return (sentence("Consent or coagulation was not checked before the needle went in."),)
    if metric == "rollover_time" and steps.turning is not None:
        return (_turned(steps.turning),)
    if metric == "hub_open_time" and steps.open_s > 0.0:
        return (
            sentence(
                "The hub was open to air for {seconds:.1f} s with the tip in the body.",
                seconds=steps.open_s,
            ),
        )
    return ()


def _turned(turning: TurningMark) -> str:
    if turning.turned is None:
        return sentence("Nobody turned the patient after the needle was out.")
    return sentence(
        "The patient was turned {seconds:.0f} s after the needle was out.", seconds=turning.wait
    )


def _sample(number: int, sample: SampleMark, moment: Moment) -> str:
    aside = sample.aside_mm
    said = (
        sentence(
            "Sample {ordinal} at {clock}: {mm:.1f} mm of lesion; the core passed {aside:.1f} mm "
            "beside its middle.",
            ordinal=number,
            clock=moment(sample.time),
            mm=sample.lesion_mm,
            aside=aside,
        )
        if aside is not None
        else sentence(
            "Sample {ordinal} at {clock}: {mm:.1f} mm of lesion.",
            ordinal=number,
            clock=moment(sample.time),
            mm=sample.lesion_mm,
        )
    )
    hits = (sentence("{hit}.", hit=hit) for hit in sample.hits)
    return joined(" ", (said, *hits))


def _deposits(steps: ProcedureMarks, moment: Moment) -> tuple[str, ...]:
    lines = []
    for deposit in steps.deposits:
        gap, clock = deposit.gap_mm, moment(deposit.time)
        if gap is None:
            continue
        template = (
            sentence(
                "Local anaesthetic at {clock}, {mm:.1f} mm short of pleura or capsule.",
                clock=clock,
                mm=gap,
            )
            if gap >= 0.0
            else sentence(
                "Local anaesthetic at {clock}, {mm:.1f} mm beyond pleura or capsule.",
                clock=clock,
                mm=-gap,
            )
        )
        lines.append(template)
    return tuple(lines)
