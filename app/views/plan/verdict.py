"""What the robot's verdict on a plan says to the user: can it follow, and what is missing."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

from app.core.units import DEGREE, MILLIMETRE
from app.imaging.field.tissue_words import tissue_words
from app.views.kit.text import tr, translated
from app.views.plan.editor import PlanEditor

if TYPE_CHECKING:
    from app.planning.judged import WayHindrance


class WayState(Enum):
    """What is known of the way."""

    NOBODY_ASKS = auto()
    LOOKING = auto()
    KNOWN = auto()
    UNKNOWN = auto()


@dataclass(frozen=True, slots=True)
class PlannedWay:
    """What lies on the planned way.

    Attributes:
        state: what is known.
        hindrances: on it, the first one first.
        reason: why it is unknown, or what the look-up is at; empty otherwise.
    """

    state: WayState = WayState.NOBODY_ASKS
    hindrances: tuple[WayHindrance, ...] = ()
    reason: str = ""


MOST_LINES = 3
"""So many hindrances on the way are named, the first ones."""


@dataclass(frozen=True, slots=True)
class VerdictWords:
    """Kind (a key of `theme.VERDICTS`, or `open`), sentence, measures, whether a rotation helps."""

    kind: str
    text: str
    measures: str = ""
    remedy: bool = False


def verdict_words(editor: PlanEditor, way: PlannedWay | None = None) -> VerdictWords:
    """Put the editor's verdict into words, and what is known of the way."""
    draft, verdict = editor.edit.draft, editor.verdict
    if verdict.problem:
        return VerdictWords("bad", verdict.problem)
    if draft.entry_mm is None:
        return VerdictWords("warning", tr("Place the entry on the skin: press E, then click."))
    if draft.target_mm is None:
        return VerdictWords("warning", tr("Place the target: press T, then click."))
    reached = verdict.reach
    if reached is None:
        return VerdictWords("warning", tr("No device chosen yet."))
    measures = tr(
        "Path {length:.1f} mm, tilt {tilt:.1f}° from vertical",
        length=reached.depth / MILLIMETRE,
        tilt=reached.tilt / DEGREE,
    )
    if reached.reachable:
        return VerdictWords(*_way_words(way or PlannedWay()), measures)
    reasons = "; ".join(translated(reason.text) for reason in reached.reasons)
    text = tr("Out of reach: {reasons}.", reasons=reasons)
    if reached.remedy is None:
        return VerdictWords("bad", text, measures)
    text += "\n" + tr("Remedy: {words}", words=reached.remedy.words)
    return VerdictWords("bad", text, measures, remedy=True)


def _way_words(way: PlannedWay) -> tuple[str, str]:
    """Return kind and sentence of a path that the robot can follow."""
    follows = tr("The robot can follow this path.")
    if way.state is WayState.LOOKING:
        looked = tr("The robot can follow; what lies on the way is being looked up…")
        return "open", "\n".join(filter(None, (looked, way.reason)))
    if way.state is WayState.UNKNOWN:
        unknown = tr("What lies on the way is not known: {reason}.", reason=way.reason)
        return "warning", f"{follows}\n{unknown}"
    if way.state is not WayState.KNOWN:
        return "good", follows
    if not way.hindrances:
        clear = tr("No bone, lung, vessel, gut or heart is on the way to the target's organ.")
        return "good", f"{follows}\n{clear}"
    lines = [_hindrance_words(one) for one in way.hindrances[:MOST_LINES]]
    return "warning", "\n".join((*lines, follows))


def _hindrance_words(hindrance: WayHindrance) -> str:
    """Name a tissue on the way and where it begins."""
    tissue, depth = tissue_words(hindrance.name), hindrance.depth_mm
    if hindrance.is_sure:
        return tr("{tissue} on the way at {depth:.0f} mm", tissue=tissue, depth=depth)
    return tr("perhaps {tissue} on the way at {depth:.0f} mm", tissue=tissue, depth=depth)


def missing_words(editor: PlanEditor) -> str:
    """Say what the plan lacks before an attempt can begin on it; empty where it lacks nothing."""
    if editor.verdict.placed is not None:
        return ""
    if editor.edit.draft.complete:
        return tr("Finish a plan that the robot can follow first.")
    return verdict_words(editor).text
