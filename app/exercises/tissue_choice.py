"""Layers or the field: which of both an exercise with `tissue: auto` needs, and why.

Every needle that the machine can hold at the entry, to the end of its reach, is followed through
the field. Layers along the plan stand for all of them only where each meets the same tissues in the
same order and, at every depth, the same force along the needle to a tenth of a newton, which is
what a hand tells apart. One that meets another tissue, or the same ones elsewhere, needs the field.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.rotation import rotation_exp
from app.core.units import MILLIMETRE
from app.exercises.parts import TissueSource
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.scene import TissueLayer
from app.simulation.tissues import tissue_values

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.imaging.field import TissueField
    from app.imaging.field.walking import Crossed
    from app.mechanisms.profile import DeviceProfile
    from app.planning.placement import PlacedPlan

FELT: Final = 0.1
"""Difference of force that a hand tells [N]."""

_RINGS: Final = 6
_AROUND: Final = 16
_STEP_MM: Final = 0.5
_LEAST_MM: Final = 0.7  # shorter stretches are edges of voxels


@dataclass(frozen=True, slots=True)
class TissueChoice:
    """Which of both.

    Attributes:
        source: layers or the field.
        because: part of a sentence that says why.
    """

    source: TissueSource
    because: str

    @property
    def reason(self) -> str:
        """Return both in one sentence."""
        if self.source is TissueSource.FIELD:
            return sentence("the field: {because}", because=self.because)
        return sentence("layers: {because}", because=self.because)


class Needles:
    """Needles that a machine can hold at an entry, each followed through a field once, when asked.

    Iterates over (angle from upright [rad], what that one meets to the end of its reach).

    Args:
        field: of the patient.
        placed: the plan that says the entry, in the robot's frame.
        profile: of the machine.
    """

    def __init__(self, field: TissueField, placed: PlacedPlan, profile: DeviceProfile) -> None:
        self.field, self._placed = field, placed
        self.reach_mm = profile.depth_range[1] / MILLIMETRE
        self._ways = ways(np.radians(profile.workspace.tilt_limit_deg[profile.workspace.joint]))
        self._met: list[list[Crossed]] = []

    @cached_property
    def planned(self) -> list[Crossed]:
        """Return what the needle on the plan's path meets."""
        return met_by(self.field, self._placed, self._placed.axis, self.reach_mm)

    def __iter__(self) -> Iterator[tuple[float, list[Crossed]]]:
        """Follow one needle after the other."""
        for number, (angle, way) in enumerate(self._ways):
            if number == len(self._met):
                self._met.append(met_by(self.field, self._placed, way, self.reach_mm))
            yield angle, self._met[number]


def choose(exercise: Exercise, needles: Needles) -> TissueChoice:
    """Return what an exercise needs on a machine; see the top of the file."""
    field, planned = needles.field, needles.planned
    values = tissue_values(field.tissues)
    diameter = OUTER_DIAMETER[exercise.needle.gauge]
    depths = np.arange(0.0, needles.reach_mm, _STEP_MM)
    names = [field.tissues[part.code].words for part in planned]
    force = static_force(planned, depths, values, diameter)
    most = 0.0
    for angle, met in needles:
        others = [field.tissues[part.code].words for part in met]
        where = sentence("a needle {angle:.0f}° from upright", angle=float(np.degrees(angle)))
        if new := [part for part in met if field.tissues[part.code].words not in names]:
            name = field.tissues[new[0].code].words
            because = sentence(
                "{where} meets {name} at {begin_mm:.0f} mm, which the path does not",
                where=where,
                name=name,
                begin_mm=new[0].begin_mm,
            )
            return TissueChoice(TissueSource.FIELD, because)
        if others != names:
            because = sentence(
                "{where} meets {others}, the path {own}",
                where=where,
                others=_listed(others),
                own=_listed(names),
            )
            return TissueChoice(TissueSource.FIELD, because)
        off = np.abs(static_force(met, depths, values, diameter) - force)
        most = max(most, float(off.max()))
        if most > FELT:
            because = sentence(
                "{where} feels {most:.1f} N more or less at {depth:.0f} mm than the path",
                where=where,
                most=most,
                depth=float(depths[int(off.argmax())]),
            )
            return TissueChoice(TissueSource.FIELD, because)
    return TissueChoice(
        TissueSource.LAYERS,
        sentence(
            "every needle within reach meets {names} with the same force to {most:.2f} N",
            names=_listed(names),
            most=most,
        ),
    )


def ways(limit: float) -> list[tuple[float, FloatArray]]:
    """Directions that a machine can hold, in world: (angle from upright [rad], unit vector)."""
    down = np.array([0.0, 0.0, -1.0])
    ways = [(0.0, down)]
    for ring in range(1, _RINGS + 1):
        angle = limit * ring / _RINGS
        for turn in np.linspace(0.0, 2.0 * np.pi, _AROUND, endpoint=False):
            axis = np.array([np.cos(turn), np.sin(turn), 0.0])
            ways.append((angle, rotation_exp(angle * axis) @ down))
    return ways


def met_by(
    field: TissueField, placed: PlacedPlan, way: FloatArray, reach_mm: float
) -> list[Crossed]:
    """Return what a straight needle from the entry meets, from the skin on; depths from there."""
    from app.imaging.field.walking import walk

    direction = placed.T_world_patient.rotation.T @ way
    entry = np.asarray(placed.plan.entry_mm, np.float64)
    crossed = walk(field, [entry, entry + reach_mm * direction], _STEP_MM)
    return [part for part in crossed if part.length_mm >= _LEAST_MM]


def static_force(
    met: Sequence[Crossed], depths: FloatArray, values: Sequence[TissueLayer], diameter: float
) -> FloatArray:
    """Force along a needle that is pushed slowly, without membranes, at depths [mm] -> [N].

    As the effects' published models have it: friction and pressing grow with the circumference.
    """
    total = np.zeros_like(depths)
    thick = diameter / OUTER_DIAMETER[18]  # friction and pressing are stated for 18 G
    for part in met:
        tissue = values[part.code]
        within = np.clip(depths - part.begin_mm, 0.0, part.length_mm) * MILLIMETRE
        total += within * tissue.friction * thick
        here = (depths >= part.begin_mm) & (depths < part.end_mm)
        total += here * (tissue.toughness * diameter + tissue.pressing * thick)
    return total


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names) if names else "nothing"
