"""What a planner says of the path that a student chose: in the record as an event.

Of exercises alone in which the student plans, and only where a tissue field tells what lies there.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from math import inf, isfinite
from typing import Any, Final

from app.core.events import Event
from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueField, TissueKind
from app.imaging.field.tissue_words import tissue_words
from app.planning.errors import PlanError
from app.planning.judged import WEIGHTS, JudgedPlan, WayHindrance
from app.planning.lung_path.sentences import lung_sentences
from app.planning.lung_path.values import LungPathReport
from app.planning.placement import PlacedPlan

KIND: Final = "plan"
"""Kind of the event."""

VERSION: Final = 1


def judged_plan_of(
    placed: PlacedPlan, field: TissueField | None, asks_lung: bool = False
) -> JudgedPlan | None:
    """Judge the path of an attempt; None where nothing can tell.

    Args:
        placed: of the attempt.
        field: of the patient.
        asks_lung: whether the path report of a lung biopsy is asked for too.
    """
    if field is None:
        return None
    from app.planning.judged_plan import judge_plan  # computes: records are read without it

    ends = placed.plan.entry_mm, placed.plan.target_mm
    plan = None
    with suppress(PlanError):
        plan = judge_plan(field, *ends)
        if asks_lung:
            from app.planning.lung_path.reporting import LungPaths

            plan = replace(plan, lung=LungPaths(field).report(*ends))
    return plan


def event_of(plan: JudgedPlan, time: float) -> Event:
    """Return the event that keeps it in the record; `judged_plan` reads it back."""
    data: dict[str, object] = {
        "version": VERSION,
        "points": plan.points,
        "length_mm": plan.length_mm,
        "angle_deg": plan.angle_deg,
        "clear_mm": plan.clear_mm if isfinite(plan.clear_mm) else None,
        "nearest": plan.nearest,
        "nearest_mm": plan.nearest_mm,
        "pleural_deg": plan.pleural_deg,
        "is_long": plan.is_long,
        "is_flat": plan.is_flat,
        "meets": [
            {
                "name": one.name,
                "kind": one.kind.value,
                "depth_mm": one.depth_mm,
                "length_mm": one.length_mm,
                "is_sure": one.is_sure,
            }
            for one in plan.meets
        ],
    }
    if plan.lung is not None:
        data["lung"] = plan.lung.document()
    return Event(time, KIND, " ".join(plan_sentences(plan)), data)


def judged_plan(events: Iterable[Event]) -> JudgedPlan | None:
    """Read it back; None where the record says nothing of it, or what it says is damaged."""
    for event in events:
        if event.kind == KIND:
            with suppress(LookupError, TypeError, ValueError, AttributeError):
                return _of(dict(event.data))
    return None


def _of(data: dict[str, Any]) -> JudgedPlan:
    clear, pleura = data["clear_mm"], data["pleural_deg"]
    plan = JudgedPlan(
        points=float(data["points"]),
        length_mm=float(data["length_mm"]),
        angle_deg=float(data["angle_deg"]),
        clear_mm=inf if clear is None else float(clear),
        nearest=str(data["nearest"]),
        nearest_mm=float(data["nearest_mm"]),
        meets=tuple(
            WayHindrance(
                str(one["name"]),
                TissueKind(one["kind"]),
                float(one["depth_mm"]),
                float(one["length_mm"]),
                bool(one["is_sure"]),
            )
            for one in data["meets"]
        ),
        pleural_deg=None if pleura is None else float(pleura),
        is_long=bool(data["is_long"]),
        is_flat=bool(data["is_flat"]),
        lung=LungPathReport.of(data["lung"]) if data.get("lung") else None,
    )
    if not 0.0 <= plan.points <= 100.0:
        raise ValueError(plan.points)
    return plan


def plan_sentences(plan: JudgedPlan) -> tuple[str, ...]:
    """Say what speaks against a planned path, the worst first, and what it is like."""
    weights = WEIGHTS
    found = [
        sentence(
            "The path passes {length_mm:.1f} mm of {tissue}, {depth_mm:.0f} mm deep.",
            length_mm=one.length_mm,
            tissue=tissue_words(one.name),
            depth_mm=one.depth_mm,
        )
        for one in plan.meets
    ]
    if plan.is_long:
        found.append(
            sentence(
                "The path is {length_mm:.0f} mm long; {most_mm:.0f} mm are allowed.",
                length_mm=plan.length_mm,
                most_mm=weights.longest_mm,
            )
        )
    if plan.is_flat:
        found.append(
            sentence(
                "The path lies {angle:.0f}° off straight in at the skin; {most:.0f}° are allowed.",
                angle=plan.angle_deg,
                most=weights.flattest_deg,
            )
        )
    lung = () if plan.lung is None else lung_sentences(plan.lung)
    if found:
        return (*found, *lung)
    if plan.clear_mm < weights.free_mm:
        found.append(
            sentence(
                "The path comes within {mm:.1f} mm of {tissue}, {depth_mm:.0f} mm deep.",
                mm=plan.clear_mm,
                tissue=tissue_words(plan.nearest),
                depth_mm=plan.nearest_mm,
            )
        )
    if plan.pleural_deg is not None:
        found.append(sentence("It meets the pleura at {angle:.0f}°.", angle=plan.pleural_deg))
    found.append(
        sentence(
            "It is {length_mm:.0f} mm long and goes in {angle:.0f}° off straight.",
            length_mm=plan.length_mm,
            angle=plan.angle_deg,
        )
    )
    return (*found, *lung)
