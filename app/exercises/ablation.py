"""Ablation as an exercise asks for it: electrodes one after another, and what the generator gives.

All electrodes go through the plan's entry, which is the fulcrum of the device: that is what one
robot can do without the patient being laid anew between them. Each has a target of its own.
"""

from __future__ import annotations

from typing import Annotated, Final

import numpy as np
from pydantic import Field, model_validator

from app.core.configuration import Strict
from app.core.errors import AcusError
from app.core.messages import joined, sentence, sentence_of
from app.exercises.errors import ExerciseError
from app.exercises.parts import Triple
from app.mechanisms.profile import DeviceProfile
from app.planning.ablation.generators import GeneratorTable, load_table
from app.planning.errors import PlanError
from app.planning.limits import ReachLimits
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.planning.reach import reach_within

LEAST_APART_MM: Final = 5.0
"""Electrodes whose tips lie nearer to each other stand at one place: they ablate one zone."""


class ElectrodePart(Strict):
    """One more electrode.

    Attributes:
        target_mm: where its tip is to be, DICOM LPS [mm]; its entry is that of the plan.
    """

    target_mm: Triple


class AblationPart(Strict):
    """Electrodes, generator, and the margin that is wanted.

    Attributes:
        generator: name of a table that comes with the program, or the path of one.
        power_w: of the generator, as planned; the table must have it.
        minutes: for so long, as planned.
        lesion_mm: a place in the lesion, DICOM LPS [mm]; None for the plan's target.
        electrodes: those after the first, which has the plan's target.
        margin_mm: wanted about the lesion, within its organ.
    """

    generator: Annotated[str, Field(min_length=1)] = "microwave-cooled-in-vivo"
    power_w: Annotated[float, Field(gt=0.0)]
    minutes: Annotated[float, Field(gt=0.0)]
    lesion_mm: Triple | None = None
    electrodes: Annotated[tuple[ElectrodePart, ...], Field(max_length=5)] = ()
    margin_mm: Annotated[float, Field(ge=0.0, le=15.0)] = 5.0

    @model_validator(mode="after")
    def _generator_gives_it(self) -> AblationPart:
        try:
            self.table().number_of(self.power_w, self.minutes)
        except AcusError as error:
            raise ValueError(sentence_of(error)) from error
        check_apart([part.target_mm for part in self.electrodes], 2)
        return self

    @property
    def count(self) -> int:
        """Return how many electrodes there are."""
        return 1 + len(self.electrodes)

    def table(self) -> GeneratorTable:
        """Return the generator's table.

        Raises:
            AcusError: if there is none.
        """
        return load_table(self.generator)


def check_apart(targets_mm: list[Triple], first: int = 1) -> None:
    """Refuse electrodes at one place; the one at index 0 is number `first`.

    Raises:
        ValueError: naming two of them and their distance.
    """
    places = np.array(targets_mm, dtype=np.float64).reshape(-1, 3)
    for k in range(len(places)):
        for n in range(k):
            apart = float(np.linalg.norm(places[k] - places[n]))
            if apart < LEAST_APART_MM:
                raise ValueError(
                    sentence(
                        "electrodes {one} and {other} are at one place, {apart:.1f} mm apart: lay "
                        "them at least {least:g} mm apart, or leave one out",
                        one=first + n,
                        other=first + k,
                        apart=apart,
                        least=LEAST_APART_MM,
                    )
                )


def electrode_plans(part: AblationPart, placed: PlacedPlan) -> tuple[PlacedPlan, ...]:
    """Return the path of each electrode on a placed plan, the plan's own first.

    Raises:
        ExerciseError: if one has no path, or two are at one place.
    """
    targets = [tuple(placed.plan.target_mm.tolist()), *(one.target_mm for one in part.electrodes)]
    try:
        check_apart([(x, y, z) for x, y, z in targets])
    except ValueError as error:
        raise ExerciseError(sentence("ablation: {error}", error=error)) from error
    plans = [placed]
    for number, one in enumerate(part.electrodes, start=2):
        try:
            target = np.array(one.target_mm, dtype=np.float64)
            plan = Plan(placed.plan.entry_mm, target, f"electrode {number}")
        except PlanError as error:
            raise ExerciseError(
                sentence("ablation: electrode {electrode}: {error}", electrode=number, error=error)
            ) from error
        plans.append(PlacedPlan.of(plan, placed.placement, placed.p_entry))
    return tuple(plans)


def check_electrodes(part: AblationPart | None, placed: PlacedPlan, profile: DeviceProfile) -> None:
    """Refuse electrodes that the machine cannot bring to their place.

    Args:
        part: of the exercise; None where it asks for none.
        placed: its plan.
        profile: the machine.

    Raises:
        ExerciseError: naming the electrode and what keeps it away.
    """
    if part is None:
        return
    limits = ReachLimits.of(profile)
    for number, one in enumerate(electrode_plans(part, placed), start=1):
        reasons = [reason.text for reason in reach_within(one.plan, one.placement, limits).reasons]
        if reasons:
            raise ExerciseError(
                sentence(
                    "ablation: electrode {electrode} cannot be placed with {profile_name}: "
                    "{reasons}",
                    electrode=number,
                    profile_name=profile.name,
                    reasons=joined("; ", reasons),
                )
            )
