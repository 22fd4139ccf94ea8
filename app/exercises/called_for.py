"""Effects that an exercise's CT, path, reach and target call for, and which of them are absent.

Every needle that the machine can hold at the entry is followed through the patient's field, to the
end of its reach; where the student chooses the entry, all that the CT holds is within reach. What
lies there calls for what it does to a needle: skin is punctured, bone stops, the liver breathes. An
exercise has it, or says in `without:` why it does without.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.core.messages import sentence
from app.exercises.errors import ExerciseError
from app.exercises.parts import TipShape, TissueSource
from app.exercises.tissue_choice import Needles, choose
from app.imaging.field.tissue_field import TissueKind
from app.simulation.plan import TISSUE_FIELD

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.imaging.field import FieldTissue

LEAST_CONFIDENCE: Final = 0.5
"""A label less sure than this calls for nothing."""

_MEMBRANES: Final = {
    TissueKind.SKIN: "skin",
    TissueKind.MUSCLE: "fascia",
    TissueKind.ORGAN: "capsule",
    TissueKind.LUNG: "pleura",
    TissueKind.VESSEL: "wall of a vessel",
    TissueKind.GUT: "wall of the gut",
    TissueKind.HEART: "wall of the heart",
}
"""What is pierced where a tissue begins."""

_BREATHES: Final = (TissueKind.LUNG, TissueKind.ORGAN)
_HOLDS: Final = frozenset(TissueKind) - {TissueKind.UNKNOWN, TissueKind.AIR, TissueKind.BONE}
_FEW: Final = 4

AMPLITUDES: Final[Mapping[str, tuple[float, float, float]]] = {
    "liver": (0.0119, 0.0038, 0.0013),
    "kidney": (0.0111, 0.0036, 0.0017),
    "lung": (0.006, 0.002, 0.001),
}
"""Organ -> how far it breathes to the feet, front and left [m], as is proposed. Liver: 14
patients (PMC5978939). Kidney: means of 39 kidneys (doi 10.1186/2193-1801-3-131). Lung: nodules that
move by more than 5 mm go 5 to 15 mm (doi 10.1155/2013/872739, table 3), from 4 in the mean of all
(doi 10.1186/s13014-015-0435-3)."""


@dataclass(frozen=True, slots=True)
class Call:
    """One effect that is called for.

    Attributes:
        effect: its name; `tissue_field` is what `tissue: field` brings.
        reason: what calls for it, in words.
        is_present: whether it is simulated.
        without: the exercise's reason to do without it; empty for none.
    """

    effect: str
    reason: str
    is_present: bool
    without: str = ""

    @property
    def is_absent(self) -> bool:
        """Return whether it is neither simulated nor declined with a reason."""
        return not self.is_present and not self.without

    @property
    def words(self) -> str:
        """Say it in one line."""
        if self.is_present:
            return f"{self.effect}: {self.reason}"
        if self.without:
            return sentence(
                "{effect}: {reason}; left out: {without}",
                effect=self.effect,
                reason=self.reason,
                without=self.without,
            )
        return sentence(
            "{effect} is called for and absent: {reason}; add it, or say why not: without: "
            '{{{effect}: "…"}}',
            effect=self.effect,
            reason=self.reason,
        )


@dataclass(frozen=True, slots=True)
class Reachable:
    """A tissue within reach, and the least depth at which a needle meets it [mm]; None: unknown."""

    tissue: FieldTissue
    depth_mm: float | None

    @property
    def words(self) -> str:
        """Say it: "rib at 12 mm"."""
        if self.depth_mm is None:
            return self.tissue.words
        return sentence(
            "{tissue} at {depth_mm:.0f} mm", tissue=self.tissue.words, depth_mm=self.depth_mm
        )


def called_for(
    exercise: Exercise, needles: Needles | None, simulated: Collection[str]
) -> tuple[Call, ...]:
    """Return all that is called for, as it is named under Effects in docs/exercises.md.

    Args:
        exercise: as the library has it, with `tissue: auto` where it says so.
        needles: that its device can hold, in the field of its CT; None where there is none in
            Hounsfield units: it calls for nothing then.
        simulated: names of the effects that the compiled exercise simulates.

    Raises:
        ExerciseError: if `without` names what is not called for.
    """
    reasons = _reasons(exercise, needles)
    if strangers := [name for name in exercise.without if name not in reasons]:
        raise ExerciseError(
            sentence(
                "exercise {exercise_id}: without: {stranger} is not called for: nothing within "
                "reach needs it ({reasons}); take it out",
                exercise_id=exercise.id,
                stranger=strangers[0],
                reasons=", ".join(reasons) or "nothing is",
            )
        )
    return tuple(
        Call(name, reason, name in simulated, exercise.without.get(name, ""))
        for name, reason in reasons.items()
    )


def within_reach(exercise: Exercise, needles: Needles) -> tuple[Reachable, ...]:
    """Return the tissues that a needle can meet, by the table of the field."""
    least: dict[int, float | None] = {}
    field = needles.field
    if exercise.is_own_plan:
        least = dict.fromkeys(np.unique(field.labels).tolist(), None)
    else:
        for _, parts in needles:
            for part in parts:
                before = least.get(part.code)
                if before is None or part.begin_mm < before:
                    least[part.code] = part.begin_mm
    met = (
        Reachable(tissue, least[tissue.code])
        for tissue in field.tissues
        if tissue.code in least and tissue.confidence >= LEAST_CONFIDENCE
    )
    return tuple(sorted(met, key=lambda one: one.depth_mm or 0.0))


def additions(calls: Sequence[Call], exercise: Exercise) -> dict[str, Any]:
    """Return what to add to an exercise's file for all that is absent: JSON-ready values."""
    absent = [call.effect for call in calls if call.is_absent]
    effects = {
        name: _breathing(exercise) if name == "breathing" else {}
        for name in absent
        if name != TISSUE_FIELD
    }
    field = {"tissue": TissueSource.FIELD.value} if TISSUE_FIELD in absent else {}
    return {**field, **({"effects": effects} if effects else {})}


def _breathing(exercise: Exercise) -> dict[str, Any]:
    organ = exercise.target_organ
    named = next((name for name in AMPLITUDES if name in organ.casefold()), "liver")
    axes = ("superior_inferior", "anterior_posterior", "left_right")
    values = dict(zip(axes, AMPLITUDES[named], strict=True))
    return {**({"organ": organ} if organ else {}), "parameters": values}


def _reasons(exercise: Exercise, needles: Needles | None) -> dict[str, str]:
    """Effect -> what calls for it."""
    if exercise.touch is not None or needles is None:
        return {}  # a tool in a trocar moves in an inflated belly, of which the CT shows nothing
    met = within_reach(exercise, needles)
    of = {kind: [one for one in met if one.tissue.kind is kind] for kind in TissueKind}
    holds = [one for one in met if one.tissue.kind in _HOLDS]
    pierced = [one for one in met if one.tissue.kind in _MEMBRANES]
    bones, breathing = of[TissueKind.BONE], [m for kind in _BREATHES for m in of[kind]]
    reasons: dict[str, str] = {}
    if holds:
        listed = _listed(one.words for one in holds)
        reasons["lateral_tissue"] = sentence("{listed} hold the shaft", listed=listed)
        reasons["shaft_friction"] = sentence("{listed} rub along the shaft", listed=listed)
        reasons["cutting"] = sentence("the tip cuts its way: {listed}", listed=listed)
    if pierced:
        walls = [f"{_MEMBRANES[one.tissue.kind]} ({one.words})" for one in pierced]
        reasons["puncture"] = sentence("it is pierced: {listed}", listed=_listed(walls))
        reasons["relaxation"] = sentence("what is pierced gives way while the needle rests")
    if bones:
        listed = _listed(one.words for one in bones)
        reasons["bone_contact"] = sentence("no needle goes through {listed}", listed=listed)
    if breathing:
        listed = _listed(one.words for one in breathing)
        reasons["breathing"] = sentence("along with the breath go {listed}", listed=listed)
    if exercise.needle.tip is TipShape.BEVEL and holds:
        reasons["bevel"] = sentence("a bevelled tip cuts a curved way")
    if holds and (why := _field_reason(exercise, needles)):
        reasons[TISSUE_FIELD] = why
    return reasons


def _field_reason(exercise: Exercise, needles: Needles) -> str:
    """Return what makes layers along the path too little; empty where they are enough."""
    if exercise.is_own_plan:
        return sentence("the student chooses the entry: no layers lie along all paths")
    choice = choose(exercise, needles)
    if choice.source is not TissueSource.FIELD:
        return ""
    return choice.because


def _listed(names: Any) -> str:
    """Return the first few of names, each once, and how many more there are."""
    each = list(dict.fromkeys(names))
    more = len(each) - _FEW
    text = ", ".join(each[:_FEW])
    return (
        sentence("{first_names} and {more} more", first_names=text, more=more) if more > 0 else text
    )
