"""What the robot's verdict on a plan says to the user: can it follow, and what is missing."""

from dataclasses import dataclass

from app.core.units import DEGREE, MILLIMETRE
from app.views.kit.text import tr, translated
from app.views.plan.editor import PlanEditor


@dataclass(frozen=True, slots=True)
class VerdictWords:
    """Kind (a key of `theme.VERDICTS`), sentence, measures, and whether a rotation would help."""

    kind: str
    text: str
    measures: str = ""
    remedy: bool = False


def verdict_words(editor: PlanEditor) -> VerdictWords:
    """Put the editor's verdict into words."""
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
        return VerdictWords("good", tr("The robot can follow this path."), measures)
    reasons = "; ".join(translated(reason.text) for reason in reached.reasons)
    text = tr("Out of reach: {reasons}.", reasons=reasons)
    if reached.remedy is None:
        return VerdictWords("bad", text, measures)
    text += "\n" + tr("Remedy: {words}", words=reached.remedy.words)
    return VerdictWords("bad", text, measures, remedy=True)


def missing_words(editor: PlanEditor) -> str:
    """Say what the plan lacks before an attempt can begin on it; empty where it lacks nothing."""
    if editor.verdict.placed is not None:
        return ""
    if editor.edit.draft.complete:
        return tr("Finish a plan that the robot can follow first.")
    return verdict_words(editor).text
