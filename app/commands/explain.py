"""`acus explain`: what an exercise simulates, with which model, why, and what it costs per tick."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from app.core.arrays import FloatArray
    from app.simulation.plan import SimulationPlan

_TICK_NS = 1e9 / 1000.0


def register(app: typer.Typer) -> None:
    """Add `acus explain`."""
    app.command("explain")(explain)


def explain(
    exercise: Annotated[str, typer.Argument(help="name or file of an exercise")],
    real: Annotated[
        bool, typer.Option("--real", help="for the real robot and hand, not the simulated ones")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="print JSON (docs/json.md)")] = False,
) -> None:
    """Print what an exercise simulates and what it leaves out, and why."""
    from app.exercises.library import load_exercise
    from app.exercises.scene import compile_exercise, device_of

    chosen = load_exercise(exercise)
    plan = compile_exercise(chosen, device_of(chosen), simulated=not real)
    document = _document(chosen.id, chosen.device, not real, plan)
    if as_json:
        from json import dumps

        typer.echo(dumps(document, indent=2))
    else:
        _print(document)


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


def _print(document: dict[str, Any]) -> None:
    kind = "simulated" if document["simulated_device"] else "real"
    typer.echo(f"{document['exercise']} on the {kind} device {document['device']}")
    for kept in document["simulated"]:
        typer.echo(f"\n  {kept['effect']}: {kept['title']}")
        typer.echo(f"    model    {kept['model']}: {kept['model_description']}")
        typer.echo(f"    why      {kept['why']}")
        typer.echo(f"    energy   {kept['energy']}")
        share = 100.0 * kept["cost_ns"] / _TICK_NS
        typer.echo(f"    cost     {kept['cost_ns']:.0f} ns per tick, {share:.4f} % of 1 ms")
    for dropped in document["dropped"]:
        typer.echo(f"\n  {dropped['effect']}\n    {dropped['why']}")
    if not document["simulated"] and not document["dropped"]:
        typer.echo("  no effects")
