"""`acus explain`: the force laws of an exercise, what it simulates and why, what each costs."""

from typing import Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer

_TICK_NS = 1e9 / 1000.0


RANK = 180


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
    from app.compose.explaining import explanation
    from app.compose.plugins import refused_files
    from app.exercises.library import load_exercise

    chosen = load_exercise(exercise)
    if _is_first_time():
        typer.echo("compiling for the first time, up to a minute …", err=True)
    document = explanation(chosen, simulated=not real)
    document["refused"] = [
        {"kind": file.kind, "file": str(file.path), "reason": file.refused}
        for file in refused_files()
    ]
    return Answer(document, _lines(document))


def _is_first_time() -> bool:
    """Return whether the cache of compiled kernels lacks what the costs are measured with."""
    import os
    from pathlib import Path

    from app.core import compiled  # noqa: F401  (names the cache's folder)

    folder = Path(os.environ["NUMBA_CACHE_DIR"])
    return next(folder.glob("control_*/kernel.repeat-*.nbi"), None) is None


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
            f"    cost     {_cost(kept['cost_ns'], kept['picture_ns'])}",
            *(f"    note     {warning}" for warning in kept["warnings"]),
        ]
    lines += [f"\n  {dropped['effect']}\n    {dropped['why']}" for dropped in document["dropped"]]
    if not document["simulated"] and not document["dropped"]:
        lines.append("  no effects")
    lines += ["", *called_for_lines(document)]
    if (touch := document["touch"]) is not None:
        lines.append(
            f"\n  touches {len(touch['depths_mm'])} targets, each for {touch['dwell_s']:g} s within"
            f" {touch['radius_mm']:g} mm; the hand moves the tool's handle"
        )
        for number, (at, depth, scale) in enumerate(
            zip(touch["targets_lps_mm"], touch["depths_mm"], touch["scales"], strict=True), 1
        ):
            place = ", ".join(f"{value:.1f}" for value in at)
            lines.append(
                f"    {number}  at ({place}) mm LPS, {depth:.0f} mm deep:"
                f" 1 mm of hand moves the tip {-scale:.2f} mm the other way"
            )
    for line in document["pass_lines"]:
        lines.append(f"\n  {line['metric']} passes to {line['pass']:g}: {line['words']}")
    for file in document["refused"]:
        lines.append(f"\n  refused {file['kind']}: {file['reason']}")
    return lines


def called_for_lines(document: dict[str, Any]) -> list[str]:
    """Return what the patient calls for, and whether it is there, absent or left out."""
    if not document["called_for"]:
        return [f"  {document['called_for_note']}"]
    lines = ["  the patient calls for"]
    for call in document["called_for"]:
        mark = "✔" if call["simulated"] else "–" if call["without"] else "✖"
        lines.append(f"    {mark} {call['effect']}: {call['reason']}")
        if call["without"] and not call["simulated"]:
            lines.append(f"      left out: {call['without']}")
        if call["absent"]:
            cost = "" if call["cost_ns"] is None else f", {_cost(call['cost_ns'])}"
            lines.append(f"      absent{cost}")
    if document["add"]:
        lines.append(f"  add it: acus exercise suggest {document['exercise']}")
    return lines


def _cost(nanoseconds: float, picture: float | None = None) -> str:
    if picture is not None:
        return f"{picture / 1e6:.2f} ms for each picture of a camera, nothing of a tick"
    return f"{nanoseconds:.0f} ns per tick, {100.0 * nanoseconds / _TICK_NS:.4f} % of 1 ms"
