"""`acus explain`: the force laws of an exercise, what it simulates and why, what each costs."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer

if TYPE_CHECKING:
    from app.core.arrays import FloatArray
    from app.mechanisms.profile import DeviceProfile
    from app.simulation.plan import SimulationPlan

_TICK_NS = 1e9 / 1000.0


def register(app: typer.Typer) -> None:
    """Add `acus explain`."""
    app.command("explain")(explain)


def explain(
    exercise: Annotated[
        str, typer.Argument(help="name or file of an exercise", autocompletion=completion.exercises)
    ],
    real: Annotated[
        bool, typer.Option("--real", help="for the real robot and hand, not the simulated ones")
    ] = False,
) -> Answer:
    """Print what an exercise simulates, why, and at what cost.

    Its force laws, its effects, and what it leaves out, each with the reason; and files of your own
    that cannot be used.
    """
    from app.compose.declared_views import declared_views
    from app.compose.plugins import refused_files
    from app.exercises.library import load_exercise
    from app.exercises.scene import compile_exercise, device_of, law_requests

    chosen = load_exercise(exercise)
    profile = device_of(chosen)
    if _is_first_time():
        typer.echo("compiling for the first time, up to a minute …", err=True)
    plan = compile_exercise(chosen, profile, declared_views(), simulated=not real)
    document = _document(chosen.id, chosen.device, not real, plan)
    document["assistance"] = chosen.assistance
    document["laws"] = _laws(law_requests(chosen), profile)
    document["refused"] = [
        {"kind": file.kind, "file": str(file.path), "reason": file.refused}
        for file in refused_files()
    ]
    return Answer(document, _lines(document))


def _is_first_time() -> bool:
    """Whether the cache of compiled kernels lacks what the costs are measured with."""
    import os
    from pathlib import Path

    from app.core import compiled  # noqa: F401  (names the cache's folder)

    folder = Path(os.environ["NUMBA_CACHE_DIR"])
    return next(folder.glob("control_*/kernel.repeat-*.nbi"), None) is None


def _document(
    exercise: str, device: str, simulated: bool, plan: "SimulationPlan"
) -> dict[str, Any]:
    costs = _costs(plan)
    return {
        "exercise": exercise,
        "device": device,
        "simulated_device": simulated,
        "simulated": [
            {
                "effect": kept.name,
                "title": kept.declaration.title,
                "model": kept.model,
                "model_description": kept.declaration.models[kept.model],
                "other_models": [name for name in kept.declaration.models if name != kept.model],
                "parameters": kept.parameters,
                "consumers": list(kept.consumers),
                "why": kept.why,
                "energy": kept.declaration.energy[0],
                "cost_ns": round(costs[kept.name] * 1e9, 1),
            }
            for kept in plan.kept
        ],
        "dropped": [{"effect": dropped.name, "why": dropped.why} for dropped in plan.dropped],
    }


def _laws(requests: dict[str, dict[str, float]], profile: "DeviceProfile") -> list[dict[str, Any]]:
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


def _costs(plan: "SimulationPlan") -> dict[str, float]:
    """Measured time of each effect in a tick [s], with the needle 60 mm deep in the tissue."""
    from app.device.control.cost import stage_cost

    state, costs = _working_state(), {}
    for name, function, parameters in plan.stages():
        function(state.copy(), parameters)  # the first tick lays the tissue down to this depth
        costs[name] = stage_cost(function, parameters, state)
    return costs


def _working_state() -> "FloatArray":
    from app.core import state_vector as sv

    state = sv.empty_state()
    state[sv.TIME], state[sv.DT] = 1.0, 1e-3
    state[sv.AXIS_X], state[sv.AXIS_Z] = 0.2, -(0.96**0.5)
    state[sv.DEPTH], state[sv.PLANT_DEPTH], state[sv.L_OUT] = 0.06, 0.06, 0.14
    state[sv.DEPTH_SOURCE] = 1.0
    return state


def _held_pose(profile: "DeviceProfile") -> "FloatArray":
    """Return the same with all that a force law reads: joints, path, dial and a moving hand."""
    from app.core import state_vector as sv
    from app.mechanisms.pantograph import inverse, jacobian

    state, fulcrum = _working_state(), profile.pantograph.fulcrum
    axis = state[sv.AXIS]
    state[sv.L_IN] = -fulcrum[2] / axis[2]
    p3 = fulcrum + state[sv.L_IN] * axis
    q = inverse(profile.pantograph, p3[:2])
    rates = jacobian(profile.pantograph, q)
    state[sv.P3] = p3[:2]
    state[[sv.Q_LEFT, sv.Q_RIGHT]], state[[sv.QD_LEFT, sv.QD_RIGHT]] = q, (0.3, -0.2)
    state[[sv.J_XL, sv.J_XR, sv.J_YL, sv.J_YR]] = rates.ravel()
    state[sv.P3_V] = rates @ (0.3, -0.2)
    state[sv.PATH_Z], state[sv.ASSISTANCE], state[sv.HUB_VX] = -1.0, 0.7, 0.02
    return state


def _lines(document: dict[str, Any]) -> list[str]:
    kind = "simulated" if document["simulated_device"] else "real"
    lines = [f"{document['exercise']} on the {kind} device {document['device']}"]
    for law in document["laws"]:
        lines += [
            f"\n  {law['law']}: {law['title']}",
            f"    energy   {law['energy']}: {law['energy_statement']}",
            f"    bound    {1000.0 * law['energy_bound_j']:.1f} mJ",
            f"    cost     {_cost(law['cost_ns'])}",
        ]
    for kept in document["simulated"]:
        lines += [
            f"\n  {kept['effect']}: {kept['title']}",
            f"    model    {kept['model']}: {kept['model_description']}",
            f"    why      {kept['why']}",
            f"    energy   {kept['energy']}",
            f"    cost     {_cost(kept['cost_ns'])}",
        ]
    lines += [f"\n  {dropped['effect']}\n    {dropped['why']}" for dropped in document["dropped"]]
    if not document["simulated"] and not document["dropped"]:
        lines.append("  no effects")
    for file in document["refused"]:
        lines.append(f"\n  refused {file['kind']}: {file['reason']}")
    return lines


def _cost(nanoseconds: float) -> str:
    return f"{nanoseconds:.0f} ns per tick, {100.0 * nanoseconds / _TICK_NS:.4f} % of 1 ms"
