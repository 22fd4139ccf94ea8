"""What an exercise simulates, why, and at what cost; and whether all that it names can be used."""

from __future__ import annotations

from time import perf_counter
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.compose.declared_views import declared_views
from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.exercises.ablation import check_electrodes, electrode_plans
from app.exercises.parts import TissueSource
from app.exercises.scene import (
    compile_exercise,
    device_of,
    law_requests,
    placed_plan_of,
)
from app.exercises.schema import Exercise
from app.exercises.taught import taught
from app.exercises.touching import check_touch
from app.mechanisms.profile import DeviceProfile
from app.scoring.complications.course import BLEEDS, DRAINED
from app.scoring.complications.factors import FACTOR_NAMES
from app.scoring.complications.risk import calibrated
from app.scoring.odds import HUO, ZHU
from app.scoring.pass_line import pass_lines
from app.session.ablation import AblationState
from app.session.complication_case import ComplicationCase, along_the_plan
from app.session.pad.hand import Handle
from app.simulation.plan import SimulationPlan

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.mechanisms.profile import DeviceProfile
    from app.simulation.bound_field import BoundField


if TYPE_CHECKING:
    from app.compose.exercise_field import ExercisePatient
    from app.simulation.bound_field import BoundField

_PICTURES: Final = 15  # that the time of an effect on them is the median of


def explanation(exercise: Exercise, simulated: bool = True) -> dict[str, Any]:
    """Return what an exercise simulates and why, its laws, and what each costs (docs/json.md).

    Compiles what is simulated: up to a minute the first time, else a second.

    Raises:
        AcusError: for a device, law, effect or parameter that there is not; names what is valid.
    """
    from app.compose.exercise_field import ExercisePatient  # the window begins without it

    patient, asked = ExercisePatient(exercise), exercise
    profile = patient.profile
    exercise, bound, why = patient.within(exercise)
    plan = compile_exercise(exercise, profile, declared_views(), simulated, bound=bound)
    document = _document(exercise, simulated, plan)
    document["tissue"] = {"source": exercise.tissue.value, "why": why, **_field_facts(bound)}
    document |= _called_for(asked, patient, plan, simulated)
    document["assistance"] = exercise.assistance
    document["laws"] = _laws(law_requests(exercise), profile)
    document["touch"] = _touch(exercise, profile)
    document["teaches"] = list(taught(exercise))
    document["complications"] = _complications(exercise, patient)
    document["ablation"] = planned_ablation(exercise, profile, bound)
    document["pass_lines"] = pass_lines(exercise.tolerances)
    return document


def _touch(exercise: Exercise, profile: DeviceProfile) -> dict[str, Any] | None:
    """Targets that are to be touched, each with what a way of the hand moves the tip there."""
    if exercise.touch is None:
        return None
    task = exercise.touch_task(placed_plan_of(exercise, profile))
    check_touch(task, profile)
    handle = Handle(profile.needle_length)
    return {
        "targets_lps_mm": [] if task is None else task.points_mm.tolist(),
        "depths_mm": [] if task is None else [plan.length / MILLIMETRE for plan in task.plans],
        "scales": [] if task is None else [handle.scale(plan.length) for plan in task.plans],
        "radius_mm": exercise.touch.radius_mm,
        "dwell_s": exercise.touch.dwell_s,
    }


def _complications(exercise: Exercise, patient: ExercisePatient) -> dict[str, Any] | None:
    """Return what can happen, and how likely to a needle along the plan; None where nothing can."""
    case = ComplicationCase.of(exercise, patient.placed, patient.field)
    if case is None:
        return None
    facts = along_the_plan(case)
    air = facts is not None and case.part.pneumothorax
    bleeds = case.part.bleeding
    return {
        "pneumothorax": calibrated().probability(facts) if air and facts is not None else 0.0,
        "drain_share": DRAINED,
        "bleeding": BLEEDS if bleeds else 0.0,
        "facts": {} if facts is None else facts.document(),
        "not_known": [] if facts is None else [n for n in FACTOR_NAMES if n not in facts.known],
        "sources": [HUO, ZHU],
    }


def _field_facts(bound: BoundField | None) -> dict[str, Any]:
    """Say of a field which it is and what it holds."""
    if bound is None:
        return {}
    field = bound.tissue
    return {
        "digest": field.digest,
        "spacing_mm": float(field.spacing_mm.min()),
        "megabytes": round(field.megabytes, 1),
        "tissues": [tissue.words for tissue in field.tissues[1:]],
        "notes": list(field.notes),
    }


def _called_for(
    exercise: Exercise, patient: ExercisePatient, plan: SimulationPlan, simulated: bool
) -> dict[str, Any]:
    """Return what the patient calls for, and what that which is absent would cost of a tick.

    Absent is what the exercise lacks, whatever the device; simulated, what `plan` has. A CT that
    cannot be read calls for nothing, and the reason is given.

    Raises:
        ExerciseError: if `without` names what is not called for.
    """
    from app.compose.physics import calls_of, completed
    from app.exercises.called_for import additions
    from app.imaging.errors import ImagingError

    try:
        calls, field = calls_of(exercise, patient=patient)
    except ImagingError as error:
        return {"called_for": [], "add": {}, "called_for_note": str(error)}
    costs: dict[str, float] = {}
    if field is not None and any(call.is_absent for call in calls):
        whole, bound, _ = patient.within(completed(exercise, calls))
        views = declared_views()
        costs = _own_costs(compile_exercise(whole, patient.profile, views, simulated, bound=bound))
    present = {kept.name for kept in plan.kept}
    rows = [
        {
            "effect": call.effect,
            "reason": call.reason,
            "simulated": call.effect in present,
            "without": call.without,
            "absent": call.is_absent,
            "cost_ns": costs.get(call.effect) if call.is_absent else None,
        }
        for call in calls
    ]
    note = ""
    if not calls:
        note = sentence("nothing is called for: a tool in a trocar moves in an inflated belly")
        if exercise.touch is None:
            note = sentence("nothing is called for: there is no CT in Hounsfield units")
    return {"called_for": rows, "add": additions(calls, exercise), "called_for_note": note}


def _own_costs(plan: SimulationPlan) -> dict[str, float]:
    """Measured time of each effect in a tick by its own model [ns]."""
    from app.device.control.cost import stage_cost

    state, costs = _working_state(), {}
    for kept in plan.kept:
        if kept.declaration.pictures:
            continue
        _, function, parameters = plan.stage(kept)
        function(state.copy(), parameters)
        costs[kept.name] = round(1e9 * stage_cost(function, parameters, state), 1)
    return costs


def quick_explanation(exercise: Exercise) -> tuple[dict[str, str], tuple[tuple[str, str], ...]]:
    """Return why each effect is simulated or left out, and what is wrong; compiles nothing.

    Returns:
        Effect -> why, beginning with ✔ or ✖; and pairs of a field and what is wrong with it.
    """
    wrong, why = [], {}
    try:
        profile = device_of(exercise)
    except AcusError as error:
        return {}, (("joint" if exercise.joint else "device", str(error)),)
    try:
        bound = None
        if exercise.tissue is TissueSource.FIELD:
            from app.simulation.bound_field import stand_in

            bound = stand_in()
        plan = compile_exercise(exercise, profile, declared_views(), bound=bound)
        why = {
            kept.name: "; ".join((f"✔ {kept.why}", *(f"note: {text}" for text in kept.warnings)))
            for kept in plan.kept
        }
        why |= {dropped.name: f"✖ {dropped.why}" for dropped in plan.dropped}
    except AcusError as error:
        wrong.append(("effects", str(error)))
    try:
        _check_laws(exercise, profile)
    except AcusError as error:
        wrong.append(("laws", str(error)))
    if exercise.touch is not None:
        try:
            check_touch(exercise.touch_task(placed_plan_of(exercise, profile)), profile)
        except AcusError as error:
            wrong.append(("touch", str(error)))
    try:
        planned_ablation(exercise, profile, None)
    except AcusError as error:
        wrong.append(("procedure", str(error)))
    missing = [part.file for part in exercise.structures if not part.file.is_file()]
    wrong += [("structures", f"there is no file {path}") for path in missing]
    if exercise.ct.folder is not None and not exercise.ct.folder.exists():
        wrong.append(("ct", f"there is no folder {exercise.ct.folder}: name that of the CT"))
    return why, tuple(wrong)


def _check_laws(exercise: Exercise, profile: DeviceProfile) -> None:
    from app.device.control.law import KIND

    for name, given in law_requests(exercise).items():
        KIND.find(name).checked(given, profile)


def _document(exercise: Exercise, simulated: bool, plan: SimulationPlan) -> dict[str, Any]:
    costs, warnings = _costs(plan), plan.warnings()
    pictures = _picture_costs(plan, exercise)
    return {
        "exercise": exercise.id,
        "device": exercise.device,
        "simulated_device": simulated,
        "simulated": [
            {
                "effect": kept.name,
                "title": kept.declaration.title,
                "model": kept.model,
                "model_description": kept.declaration.models[kept.model],
                "model_descriptions": dict(kept.declaration.models),
                "other_models": [name for name in kept.declaration.models if name != kept.model],
                "parameters": kept.parameters,
                "consumers": list(kept.consumers),
                "why": kept.why,
                "energy": kept.declaration.energy[0],
                "cost_ns": round(costs[kept.name].get(kept.model, 0.0) * 1e9, 1),
                "model_costs_ns": {m: round(s * 1e9, 1) for m, s in costs[kept.name].items()},
                "picture_ns": pictures.get(kept.name),
                "warnings": list(warnings[kept.name]),
            }
            for kept in plan.kept
        ],
        "dropped": [{"effect": dropped.name, "why": dropped.why} for dropped in plan.dropped],
    }


def _laws(requests: dict[str, dict[str, float]], profile: DeviceProfile) -> list[dict[str, Any]]:
    """Describe each force law: its statement, the energy it may store, its time in a tick."""
    from app.device.control import laws
    from app.device.control.cost import stage_cost

    bounds, rows = laws.energy_bounds(requests, profile), []
    for name, function, parameters in laws.stages_of(requests, profile):
        law, state = laws.declaration(name), _held_pose(profile)
        rows.append(
            {
                "law": name,
                "title": law.title,
                "parameters": law.checked(requests[name], profile),
                "energy": law.energy[0],
                "energy_statement": law.energy[1],
                "energy_bound_j": round(bounds[name], 6),
                "cost_ns": round(stage_cost(function, parameters, state) * 1e9, 1),
            }
        )
    return rows


def _costs(plan: SimulationPlan) -> dict[str, dict[str, float]]:
    """Measured time of each effect in a tick by each of its models [s], the needle 60 mm deep.

    None for effects on pictures: they cost nothing of a tick.
    """
    from app.device.control.cost import stage_cost

    state = _working_state()
    costs: dict[str, dict[str, float]] = {kept.name: {} for kept in plan.kept}
    for kept in plan.kept:
        for model in kept.declaration.models if not kept.declaration.pictures else ():
            _, function, parameters = plan.stage(kept, model)
            function(state.copy(), parameters)  # the first tick lays the tissue to this depth
            costs[kept.name][model] = stage_cost(function, parameters, state)
    return costs


def _picture_costs(plan: SimulationPlan, exercise: Exercise) -> dict[str, float]:
    """Measured time of each effect on pictures, for one picture of the rig's first camera [ns].

    Each acts on what those before it leave of the housing.
    """
    if not (asked := plan.pictures()):
        return {}
    from app.tracking.optics.rig import load_rig
    from app.tracking.simulated.cameras import NeedleRenderer
    from app.tracking.simulated.picture_effects import draws_light, in_order, picture_effects

    rig, chain = load_rig(exercise.rig), picture_effects(asked)
    model, light = rig.models[0], draws_light(chain)
    image = NeedleRenderer(model, rig.needle, rig.blur_px, light=light).background
    random, found = np.random.default_rng(1), {}
    for name, (effect, memory) in zip(in_order(asked), chain, strict=True):
        times, made = [], effect(image.copy(), memory, random)  # compiled, and its noise drawn
        for _ in range(_PICTURES):
            fresh = image.copy()
            start = perf_counter()
            effect(fresh, memory, random)
            times.append(perf_counter() - start)
        image = made
        found[name] = round(1e9 * float(np.median(times)), 1)
    return found


def _working_state() -> FloatArray:
    from app.core import state_vector as sv

    state = sv.empty_state()
    state[sv.TIME], state[sv.DT] = 1.0, 1e-3
    state[sv.AXIS_X], state[sv.AXIS_Z] = 0.2, -(0.96**0.5)
    state[sv.DEPTH], state[sv.PLANT_DEPTH], state[sv.L_OUT] = 0.06, 0.06, 0.14
    state[sv.DEPTH_SOURCE] = 1.0
    return state


def _held_pose(profile: DeviceProfile) -> FloatArray:
    """Return the same with all that a force law reads: joints, path, dial and a moving hand."""
    from app.core import state_vector as sv

    state, fulcrum = _working_state(), profile.fulcrum
    axis = state[sv.AXIS]
    state[sv.L_IN] = -fulcrum[2] / axis[2]
    machine = profile.machine
    state[sv.Q], state[sv.QD] = machine.usable(axis), (0.3, -0.2)
    stages = machine.stages()
    for stage in (stages.pose, stages.dynamics):
        if stage is not None:
            stage.function(state, stage.parameters)
    state[sv.P3_V] = state[sv.JACOBIAN].reshape(2, 2) @ (0.3, -0.2)
    state[sv.PATH_Z], state[sv.ASSISTANCE], state[sv.HUB_VX] = -1.0, 0.7, 0.02
    return state


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
