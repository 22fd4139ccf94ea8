"""`acus explain`: the force laws of an exercise, what it simulates and why, what each costs."""

from typing import Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer
from app.commands.reader_language import language, local, tell
from app.core.messages import joined, listed, sentence

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
        tell(sentence("compiling for the first time, up to a minute …"), err=True)
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
    names = {"exercise": document["exercise"], "device": document["device"]}
    lines: list[str] = [
        sentence("{exercise} on the simulated device {device}", **names)
        if document["simulated_device"]
        else sentence("{exercise} on the real device {device}", **names)
    ]
    for law in document["laws"]:
        energy = joined("", (f"{law['energy']}: ", law["energy_statement"]))
        bound = sentence("{energy:.1f} mJ", energy=1000.0 * law["energy_bound_j"])
        lines += [
            f"\n  {law['law']}: {language().text(law['title'])}",
            _row(sentence("energy"), energy),
            _row(sentence("bound"), bound),
            _row(sentence("cost"), _cost(law["cost_ns"])),
        ]
    for effect in document["simulated"]:
        model = joined("", (f"{effect['model']}: ", effect["model_description"]))
        lines += [
            f"\n  {effect['effect']}: {language().text(effect['title'])}",
            _row(sentence("model"), model),
            _row(sentence("why"), effect["why"]),
            _row(sentence("energy"), effect["energy"]),
            _row(sentence("cost"), _cost(effect["cost_ns"], effect["picture_ns"])),
            *(_row(sentence("note"), warning) for warning in effect["warnings"]),
        ]
    lines += [
        joined("", (f"\n  {dropped['effect']}\n    ", dropped["why"]))
        for dropped in document["dropped"]
    ]
    if not document["simulated"] and not document["dropped"]:
        lines.append(sentence("  no effects"))
    lines += ["", *called_for_lines(document)]
    if (touch := document["touch"]) is not None:
        lines.append(
            sentence(
                "\n  touches {targets} targets, each for {dwell:g} s within {radius:g} mm; "
                "the hand moves the tool's handle",
                targets=len(touch["depths_mm"]),
                dwell=touch["dwell_s"],
                radius=touch["radius_mm"],
            )
        )
        for number, (at, depth, scale) in enumerate(
            zip(touch["targets_lps_mm"], touch["depths_mm"], touch["scales"], strict=True), 1
        ):
            place = ", ".join(f"{value:.1f}" for value in at)
            lines.append(
                sentence(
                    "    {target}  at ({place}) mm LPS, {depth:.0f} mm deep: 1 mm of hand moves "
                    "the tip {scale:.2f} mm the other way",
                    target=number,
                    place=place,
                    depth=depth,
                    scale=-scale,
                )
            )
    lines += taught_lines(document["teaches"])
    lines += complication_lines(document["complications"])
    if document["ablation"] is not None:
        lines += ablation_lines(document["ablation"])
    for line in document["pass_lines"]:
        lines.append(
            sentence(
                "\n  {metric} passes to {limit:g}: {reason}",
                metric=line["metric"],
                limit=line["pass"],
                reason=line["words"],
            )
        )
    for file in document["refused"]:
        lines.append(
            sentence("\n  refused {kind}: {reason}", kind=file["kind"], reason=file["reason"])
        )
    return lines


def taught_lines(names: list[str]) -> list[str]:
    """Return which steps of an intervention an exercise teaches."""
    from app.exercises.taught import NOTHING, STEPS

    words = [words for name, words, _ in STEPS if name in names] or [NOTHING]
    return [sentence("\n  teaches: {steps}", steps=listed(words))]


def complication_lines(document: dict[str, Any] | None) -> list[str]:
    """Return what can happen to the patient, and how likely; nothing where nothing can."""
    if document is None:
        return []
    from app.scoring.complications.factors import FACTORS

    known = [factor.words for factor in FACTORS if document["facts"].get(factor.name)]
    unknown = [factor.words for factor in FACTORS if factor.name in document["not_known"]]
    lines: list[str] = [
        sentence(
            "\n  complications, by lot at published odds: pneumothorax {air:.0f} % of a needle "
            "along the plan, {drain:.0f} % of those with a drain; blood in the lung {blood:.0f} %",
            air=100.0 * document["pneumothorax"],
            drain=100.0 * document["drain_share"],
            blood=100.0 * document["bleeding"],
        )
    ]
    if known:
        lines.append(sentence("    it has: {factors}", factors=listed(known)))
    if unknown:
        lines.append(
            sentence("    not known, as in the case mix: {factors}", factors=listed(unknown))
        )
    lines += [sentence("    {source}", source=source) for source in document["sources"]]
    return lines


def ablation_lines(ablation: dict[str, Any]) -> list[str]:
    """Return what is ablated: generator, electrodes and the planned margin."""
    lines: list[str] = [
        sentence(
            "\n  ablates with {electrodes} electrodes, one after another through one entry, "
            "{power:g} W for {minutes:g} min",
            electrodes=len(ablation["depths_mm"]),
            power=ablation["power_w"],
            minutes=ablation["minutes"],
        ),
        _row(sentence("generator"), ablation["generator"]),
        _row(sentence("source"), ablation["source"]),
    ]
    if ablation["planned_margin_mm"] is not None:
        words = sentence(
            "{margin:.1f} mm planned of {wanted:g} wanted, {share:.1f} % of the lesion",
            margin=ablation["planned_margin_mm"],
            wanted=ablation["wanted_mm"],
            share=100.0 * ablation["planned_share"],
        )
        lines.append(_row(sentence("margin"), words))
    lines += [
        _row(
            sentence("note"),
            sentence(
                "{vessel} lies within 3 mm of the zone: what it cools is not reckoned", vessel=name
            ),
        )
        for name in ablation["vessels"]
    ]
    return lines


def called_for_lines(document: dict[str, Any]) -> list[str]:
    """Return what the patient calls for, and whether it is there, absent or left out."""
    if not document["called_for"]:
        return [joined("", ("  ", document["called_for_note"]))]
    lines: list[str] = [sentence("  the patient calls for")]
    for call in document["called_for"]:
        mark = "✔" if call["simulated"] else "–" if call["without"] else "✖"
        lines.append(joined("", (f"    {mark} {call['effect']}: ", call["reason"])))
        if call["without"] and not call["simulated"]:
            lines.append(sentence("      left out: {reason}", reason=call["without"]))
        if call["absent"]:
            lines.append(
                sentence("      absent")
                if call["cost_ns"] is None
                else sentence("      absent, {cost}", cost=_cost(call["cost_ns"]))
            )
    if document["add"]:
        lines.append(
            sentence("  add it: `acus exercise suggest {name}`", name=document["exercise"])
        )
    return lines


def _cost(nanoseconds: float, picture: float | None = None) -> str:
    if picture is not None:
        return sentence(
            "{time:.2f} ms for each picture of a camera, nothing of a tick", time=picture / 1e6
        )
    return sentence(
        "{time:.0f} ns per tick, {share:.4f} % of 1 ms",
        time=nanoseconds,
        share=100.0 * nanoseconds / _TICK_NS,
    )


def _row(name: str, value: str) -> str:
    """Return a line of a table of two columns in the reader's language."""
    return f"    {local(name):8} {local(value)}"
