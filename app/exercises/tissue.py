"""Layers of tissue of an exercise from its CT, along its path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Final

from app.exercises.hand_bands import bands_among
from app.exercises.parts import KILOPASCAL, OF_OWN_PLANS, LayerPart, LayersFrom, TissueSource
from app.exercises.procedure import OF_PROCEDURES
from app.imaging.tissue import Tissue, tissue_along
from app.simulation.bound_field import MOVING
from app.simulation.scene import BONE, FAT, LIVER, LUNG, MUSCLE, SKIN, TissueLayer
from app.simulation.tissues import MODELS, PUBLISHED, tissue_values

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.imaging.field import TissueField
    from app.imaging.field.walking import Crossed
    from app.imaging.structures.structure import Structure
    from app.imaging.volume import Volume
    from app.planning.plan import Plan

REACH_MM: Final = 200.0
"""The last layer goes on to here: further than any needle [mm]."""

_KINDS: Final = {
    Tissue.SKIN: SKIN,
    Tissue.FAT: FAT,
    Tissue.MUSCLE: MUSCLE,
    Tissue.ORGAN: LIVER,
    Tissue.LUNG: LUNG,
    Tissue.BONE: BONE,
}


def layers_along(
    volume: Volume, plan: Plan, structures: Sequence[Structure] = ()
) -> tuple[LayerPart, ...]:
    """Return the layers that a needle meets, from the skin inwards, bone being the last.

    Thickness is the CT's, to a tenth of a millimetre; all else is that of the kind of tissue
    (`simulation.scene`), an organ being taken for liver.

    Raises:
        ImagingError: if the volume is no CT, or the entry lies outside it.
    """
    layers: list[LayerPart] = []
    for run in tissue_along(volume, plan.entry_mm, plan.target_mm, structures=structures):
        kind = _KINDS[run.tissue]
        layers.append(_part(kind, run.name or run.tissue.value, round(run.thickness_mm, 1)))
        if kind.rigid:
            return tuple(layers)
    missing = REACH_MM - sum(layer.thickness_mm for layer in layers)
    if missing > 0.0:
        thickness = round(layers[-1].thickness_mm + missing, 1)
        layers[-1] = layers[-1].model_copy(update={"thickness_mm": thickness})
    return tuple(layers)


def with_layers_met(exercise: Exercise, field: TissueField, met: Sequence[Crossed]) -> Exercise:
    """Return an exercise whose tissue lies in layers as a needle meets it in a field.

    Each has the field's own values, and goes along with breathing where it does so in the field;
    effects without a model take the one that goes with these values.

    Args:
        exercise: the exercise.
        field: of its patient.
        met: what the needle on its path meets, from the skin on; bone ends it.
    """
    effects = {
        name: part.model_copy(update={"model": part.model or MODELS[PUBLISHED].get(name, "")})
        for name, part in exercise.effects.items()
    }
    changes = {
        "tissue": TissueSource.LAYERS,
        "layers": _layers_of(field, met),
        "layers_from": LayersFrom.CT,  # they follow from CT and path, as a score is told
        "effects": effects,
    }
    return exercise.model_copy(update=changes)


def _layers_of(field: TissueField, met: Sequence[Crossed]) -> tuple[LayerPart, ...]:
    """Return what is met as layers: each ends where the next begins, the last beyond all reach."""
    values = tissue_values(field.tissues)
    runs = [part for n, part in enumerate(met) if n == 0 or part.code != met[n - 1].code]
    begins = [0.0, *(part.begin_mm for part in runs[1:])]
    ends = [*begins[1:], max(REACH_MM, begins[-1] + 1.0)]
    layers: list[LayerPart] = []
    for run, begin, end in zip(runs, begins, ends, strict=True):
        tissue = field.tissues[run.code]
        kind = values[run.code]
        if kind.moves is None:
            kind = replace(kind, moves=float(tissue.kind in MOVING))
        name = str(tissue.words)  # a file has it as plain text
        if layers and name.strip().casefold() == "skin":  # as a layer it would be refused
            name = f"{name} below {layers[-1].name}"
        layers.append(_part(kind, name, end - begin))
        if kind.rigid:
            break
    return tuple(layers)


def bone_before(layers: Sequence[LayerPart], length_mm: float) -> float | None:
    """Return the depth at which bone stands in the way of a target, None where it does not [mm].

    Args:
        layers: from the skin inwards.
        length_mm: of the path, from the entry to the target.
    """
    depth = 0.0
    for layer in layers:
        if layer.rigid:
            return depth if depth < length_mm else None
        depth += layer.thickness_mm
    return None


def with_tissue(
    exercise: Exercise, volume: Volume | None, plan: Plan, structures: Sequence[Structure] = ()
) -> Exercise:
    """Return an exercise with the layers of its CT, if it takes them from there and has layers.

    Raises:
        ImagingError: if the volume is no CT, or the entry lies outside it.
    """
    if exercise.tissue is TissueSource.FIELD or exercise.layers_from is not LayersFrom.CT:
        return exercise
    if volume is None:
        return exercise
    return exercise.model_copy(update={"layers": layers_along(volume, plan, structures)})


def in_layers(exercise: Exercise) -> Exercise:
    """Return an exercise without a patient: tissue in layers, by the effects' first models.

    For what needs no patient, as a check of robot and cameras; nothing that is met fails it, and no
    plan is judged.
    """
    if not exercise.needs_field:
        return exercise
    first = {"model": ""} if exercise.tissue is not TissueSource.LAYERS else {}
    effects = {
        name: part if name == "breathing" else part.model_copy(update=first)
        for name, part in exercise.effects.items()
    }
    rules = exercise.rules.model_copy(update={"forbidden": ()})
    asked = OF_OWN_PLANS.union(*OF_PROCEDURES.values())
    judged = {name: bands for name, bands in exercise.tolerances.items() if name not in asked}
    changes = {
        "tissue": TissueSource.LAYERS,
        "effects": effects,
        "rules": rules,
        "procedure": None,  # what a step meets is looked up in the field
        "tolerances": judged,
        "bands": bands_among(exercise.bands, judged),
    }
    return exercise.model_copy(update=changes)


def _part(kind: TissueLayer, name: str, thickness_mm: float) -> LayerPart:
    values = {one.name: getattr(kind, one.name) for one in fields(kind)}
    stiffness = values.pop("side_stiffness") / KILOPASCAL
    del values["name"], values["thickness"]
    return LayerPart(name=name, thickness_mm=thickness_mm, side_stiffness_kpa=stiffness, **values)
