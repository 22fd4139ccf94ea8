"""Study: what force can be had, and how fast a needle that is let go runs away with it.

Every needle is held by a simulated hand, pushed as hard as the rule allows, and let go; beside it
its twin runs with the motors off. Rules: the motors' torque alone, the fixed 0.25 m/s of decision
0008, and the limit of the profile (decision 0014).
"""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from app.core.messages import sentence
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.mechanisms.pantograph.profile import PantographProfile, load_pantograph
from app.mechanisms.profile import LetGoLimit
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey
from app.studies.releasing.device import Release, Rule, poses, release, upright

DECLARATION: Final[dict[str, Any]] = {
    "title": "Letting go of the needle: force to be had against run-away",
    "question": "What force is left if a needle let go must stay slow, and how slow does it stay?",
    "reference": "the simulated device beside its twin without motors, 160 forces per depth",
}

PROFILES: Final = ("icube", "haply-2diy")
POSES: Final = 20
AROUND: Final = 8  # directions of the force at a pose
DEPTHS_MM: Final = (-20.0, 0.0, 30.0, 60.0, 80.0)
FACTORS: Final = (0.7, 1.0, 1.3)
_ALIGNING: Final = -0.020  # [m] where students align
_SPEEDS: Final = (0.25, 0.3, 0.35, 0.4, 0.45, 0.5)
_ENERGIES_MJ: Final = (2.0, 4.0, 6.0, 8.0, 10.0)
_COLOURS: Final = {
    Rule.TORQUE_ALONE: "#777777",
    Rule.BEFORE: "#D55E00",
    Rule.PROFILE: "#0072B2",
}

Runs = dict[tuple[str, float, Rule], list[Release]]
"""Releases by profile, depth [mm] and rule: all poses, with each factor of the inertias."""


def _all_runs(progress: Progress | None) -> Runs:
    found: Runs = {}
    for number, name in enumerate(PROFILES):
        profile = load_pantograph(name)
        for depth in DEPTHS_MM:
            if progress is not None:
                share = (number + DEPTHS_MM.index(depth) / len(DEPTHS_MM)) / len(PROFILES)
                progress.report(
                    0.7 * share, sentence("{name}, {depth:g} mm", name=name, depth=depth)
                )
            at = poses(profile, depth * MILLIMETRE, POSES, AROUND)
            for rule in Rule:
                found[name, depth, rule] = [
                    release(profile, pose, rule, factor) for pose in at for factor in FACTORS
                ]
    return found


def _median(values: Sequence[float]) -> float:
    return float(np.median(values))


def _forces(runs: Runs) -> Sheet:
    rows: list[tuple[Cell, ...]] = []
    for name, depth in dict.fromkeys((name, depth) for name, depth, _ in runs):
        cells: list[Cell] = [name, depth]
        for rule in Rule:
            felt = [run.felt for run in runs[name, depth, rule]]
            cells += [_median(felt), float(np.percentile(felt, 5))]
        rows.append(tuple(cells))
    headings = [f"{rule}, {what} [N]" for rule in Rule for what in ("median", "5 %")]
    return Sheet(
        "force",
        "Largest force at the hand by depth, measured; all poses and directions",
        ("profile", "depth [mm]", *headings),
        tuple(rows),
    )


def _released(runs: Runs) -> Sheet:
    rows: list[tuple[Cell, ...]] = []
    for (name, depth, rule), found in runs.items():
        noticed = [run.noticed for run in found if run.noticed is not None]
        rows.append(
            (
                name,
                depth,
                str(rule),
                max(run.speed for run in found),
                1e3 * max(run.energy for run in found),
                len(noticed) / len(found),
                float(np.median(noticed)) if noticed else "",
            )
        )
    return Sheet(
        "released",
        "Let go under that force, inertias times 0.7, 1 and 1.3: worst beyond the twin",
        (
            "profile",
            "depth [mm]",
            "rule",
            "speed [m/s]",
            "energy [mJ]",
            "share noticed",
            "noticed after [ms]",
        ),
        tuple(rows),
    )


def with_limit(profile: PantographProfile, energy_mj: float, speed: float) -> PantographProfile:
    """Return the profile with another limit of a needle let go."""
    limit = LetGoLimit(energy_mj=energy_mj, speed=speed)
    limits = profile.limits.model_copy(update={"let_go": limit})
    return profile.model_copy(update={"limits": limits})


def _aligning() -> Sheet:
    rows: list[tuple[Cell, ...]] = []
    for name in PROFILES:
        profile = load_pantograph(name)
        at = upright(_ALIGNING, 24)
        for rule in Rule:
            felt = [release(profile, pose, rule, runs=1).felt for pose in at]
            rows.append((name, str(rule), _median(felt), min(felt)))
        blind = [release(profile, pose, Rule.PROFILE, measured=False, runs=1).pull for pose in at]
        rows.append((name, "limit of the profile, no fix", _median(blind), min(blind)))
    return Sheet(
        "aligning",
        "Needle upright, tip 20 mm outside: force in 24 directions",
        ("profile", "rule", "median [N]", "worst direction [N]"),
        tuple(rows),
    )


def _choice(progress: Progress | None) -> Sheet:
    rows: list[tuple[Cell, ...]] = []
    for name in PROFILES:
        profile = load_pantograph(name)
        at = [*upright(_ALIGNING, 8), *upright(profile.depth_range[1], 8)]
        for energy in _ENERGIES_MJ:
            cells: list[Cell] = [name, energy]
            for speed in _SPEEDS:
                limited = with_limit(profile, energy, speed)
                felt = [release(limited, pose, Rule.PROFILE, runs=1).felt for pose in at[:8]]
                deep = [release(limited, pose, Rule.PROFILE, runs=1).felt for pose in at[8:]]
                cells.append(f"{_median(felt):.2f} / {_median(deep):.2f}")
            rows.append(tuple(cells))
        if progress is not None:
            progress.report(0.9, sentence("limits of {name}", name=name))
    return Sheet(
        "choice",
        "Force upright by the limit, 20 mm outside / as deep as it goes: median [N]",
        ("profile", "energy [mJ]", *(f"{speed:g} m/s" for speed in _SPEEDS)),
        tuple(rows),
    )


def _draw_forces(figure: Any, sheet: Sheet) -> None:
    for number, name in enumerate(PROFILES):
        axes = figure.add_subplot(1, len(PROFILES), number + 1)
        table = np.array([row[1:] for row in sheet.rows if row[0] == name], dtype=np.float64)
        for column, rule in enumerate(Rule):
            style = "--" if rule is Rule.TORQUE_ALONE else "o-"
            middle, low = table[:, 1 + 2 * column], table[:, 2 + 2 * column]
            axes.plot(table[:, 0], middle, style, color=_COLOURS[rule], label=str(rule))
            axes.fill_between(table[:, 0], low, middle, color=_COLOURS[rule], alpha=0.12)
        axes.set(xlabel="depth of the tip, measured [mm]", ylabel="force at the hand [N]")
        axes.set_ylim(bottom=0.0)
        axes.set_title(f"{name}: median, down to the 5th percentile", fontsize=9)
        axes.grid(True, color="#DDDDDD", linewidth=0.5)
        axes.legend(fontsize=7)
    figure.tight_layout()


def _draw_released(figure: Any, runs: Runs) -> None:
    for number, name in enumerate(PROFILES):
        limit = load_pantograph(name).let_go
        for column, (what, line) in enumerate(
            (("speed [m/s]", limit.speed), ("energy [mJ]", limit.energy_mj))
        ):
            axes = figure.add_subplot(len(PROFILES), 2, 2 * number + column + 1)
            for rule in reversed(Rule):
                found = [
                    run for key, some in runs.items() if key[::2] == (name, rule) for run in some
                ]
                x = [run.speed if column == 0 else 1e3 * run.energy for run in found]
                felt = [run.felt for run in found]
                axes.semilogx(x, felt, ".", color=_COLOURS[rule], markersize=2, label=str(rule))
            axes.axvline(line, color="#222222", linewidth=1.0, label="limit of the profile")
            axes.set(xlabel=f"run-away beyond the twin, {what}", ylabel="force at the hand [N]")
            axes.set_title(name, fontsize=9)
            axes.grid(True, color="#DDDDDD", linewidth=0.5)
            axes.legend(fontsize=6, markerscale=4)
    figure.tight_layout()


def _measure(progress: Progress | None) -> Findings:
    runs = _all_runs(progress)
    forces, released, aligning = _forces(runs), _released(runs), _aligning()
    return Findings(
        (forces, released, aligning, _choice(progress)),
        (
            Figure("force", lambda figure: _draw_forces(figure, forces), (10.0, 4.2)),
            Figure("released", lambda figure: _draw_released(figure, runs), (10.0, 7.5)),
        ),
        _lines(released),
    )


def _lines(released: Sheet) -> tuple[str, ...]:
    found = []
    for name in PROFILES:
        limit = load_pantograph(name).let_go
        rows = [row for row in released.rows if row[0] == name and row[2] == Rule.PROFILE]
        speed, energy = (max(float(row[column]) for row in rows) for column in (3, 4))
        alone = max(
            float(row[3]) for row in released.rows if row[0] == name and row[2] == Rule.TORQUE_ALONE
        )
        found.append(
            f"{name}: at most {speed:.2f} m/s of {limit.speed:g} and {energy:.1f} mJ of "
            f"{limit.energy_mj:g} beyond the twin; {alone:.1f} m/s with the torque limit alone."
        )
    return tuple(found)


STUDY: Final = Survey(
    measure=_measure,
)
