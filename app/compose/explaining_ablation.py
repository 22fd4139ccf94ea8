"""What an exercise's ablation is planned to do, as `acus explain` tells it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from app.core.units import MILLIMETRE
from app.exercises.ablation import check_electrodes, electrode_plans
from app.exercises.scene import placed_plan_of
from app.session.ablation import AblationState

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.mechanisms.profile import DeviceProfile
    from app.simulation.bound_field import BoundField


def planned_ablation(
    exercise: Exercise, profile: DeviceProfile, bound: BoundField | None
) -> dict[str, Any] | None:
    """Return generator, electrodes and, where the patient is known, the planned margin.

    None where the exercise ablates nothing.

    Raises:
        AcusError: if an electrode cannot be placed.
    """
    part = None if exercise.procedure is None else exercise.procedure.ablation
    if part is None:
        return None
    placed, table = placed_plan_of(exercise, profile), part.table()
    check_electrodes(part, placed, profile)
    plans = electrode_plans(part, placed)
    tissue = None if bound is None else bound.tissue
    state = AblationState.of(exercise.procedure, placed, tissue)
    planned = None if state is None else state.planned
    return {
        "generator": table.words,
        "source": table.source,
        "ex_vivo": table.ex_vivo,
        "power_w": part.power_w,
        "minutes": part.minutes,
        "wanted_mm": part.margin_mm,
        "electrodes_lps_mm": [plan.plan.target_mm.tolist() for plan in plans],
        "depths_mm": [plan.length / MILLIMETRE for plan in plans],
        "planned_margin_mm": None if planned is None else planned.least_mm,
        "planned_share": None if planned is None else planned.share,
        "vessels": [] if planned is None else [one.name for one in planned.vessels],
        "reached": [] if planned is None else [one.name for one in planned.reached],
    }
