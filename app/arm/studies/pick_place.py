"""Study: does the arm, by the pictures alone, insert its tool where it shall?

In each trial a seed lays tool and trocar, chooses a direction within 25° of straight down and a
depth of 40 to 120 mm. Two simulated cameras look once, before the arm moves; a plan is made from
what they say and carried out in MuJoCo. The truth only measures; but where the cameras stand is
known exactly, as from a perfect calibration of hand and eye. A trial has succeeded if all
phases were done, the tool is still held, its tip is within 3 mm of where it should be and its axis
within 1 mm of the true fulcrum.
"""

from collections import Counter
from collections.abc import Callable
from typing import Any, Final

import numpy as np

from app.arm.run import trial
from app.arm.scene import ArmTrial
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.studies.findings import Figure, Findings, Sheet, Survey

DECLARATION: Final[dict[str, Any]] = {
    "title": "The arm inserts its tool by pictures alone: success, failures and errors",
    "question": "How often and how exactly is the tool where it shall be, and what goes wrong?",
    "reference": "the simulated scene itself: tip, axis and fulcrum as they are there",
}

TIP_MM: Final = 3.0
"""Largest error of the tip [mm] of a trial that succeeds."""

AXIS_MM: Final = 1.0
"""Largest distance of the shaft's axis from the fulcrum [mm]."""

LEAST: Final = 0.90
"""Share of trials that must succeed."""

Trial = Callable[..., ArmTrial]
"""Seed, progress -> what it came to."""

INEXACT: Final = "inserted, not as exactly as asked"
_SUCCESS: Final = "succeeded"
_BLUE, _ORANGE = "#0072B2", "#D55E00"


def outcome(done: ArmTrial) -> str:
    """Success, or the cause why not, in a word or some."""
    if done.failure is not None:
        return done.failure.value.replace("_", " ")
    last = done.phases[-1].errors
    exact = last["tip_mm"] <= TIP_MM and last["axis_from_fulcrum_mm"] <= AXIS_MM
    return _SUCCESS if exact else INEXACT


def _outcomes(trials: list[ArmTrial]) -> Sheet:
    counted = Counter(outcome(one) for one in trials)
    rows = tuple((cause, count, 100.0 * count / len(trials)) for cause, count in counted.items())
    rows = tuple(sorted(rows, key=lambda row: -row[1]))
    return Sheet("outcomes", "What the trials came to", ("outcome", "trials", "share [%]"), rows)


def _phases(trials: list[ArmTrial]) -> Sheet:
    """Median and worst of every error of every phase, of all trials that came so far."""
    found: dict[tuple[str, str], list[float]] = {}
    for one in trials:
        for name, errors in [("look", one.looked), *((p.name, p.errors) for p in one.phases)]:
            for error, value in errors.items():
                found.setdefault((name, error), []).append(abs(value))
    rows = tuple(
        (phase, *_named(error), len(values), float(np.median(values)), max(values))
        for (phase, error), values in found.items()
    )
    columns = ("phase", "error", "unit", "trials", "median", "worst")
    return Sheet("phases", "Errors by phase, sizes, against the truth", columns, rows)


def _named(error: str) -> tuple[str, str]:
    what, unit_name = error.rsplit("_", 1)
    return what.replace("_", " "), unit_name.replace("deg", "°")


def _times(trials: list[ArmTrial]) -> Sheet:
    kinds = {
        "simulated": [one.simulated for one in trials if one.failure is None],
        "planner, computed": [one.planning for one in trials],
        "physics, computed": [one.physics for one in trials],
    }
    rows = tuple(
        (name, float(np.median(values)), max(values)) for name, values in kinds.items() if values
    )
    return Sheet("times", "How long it takes", ("time", "median [s]", "worst [s]"), rows)


def _each(trials: list[ArmTrial]) -> Sheet:
    rows = []
    for one in trials:
        errors = one.phases[-1].errors if one.failure is None else {}
        rows.append(
            (
                one.seed,
                float(np.degrees(one.tilt)),
                one.depth / MILLIMETRE,
                outcome(one),
                errors.get("tip_mm", "–"),
                errors.get("axis_from_fulcrum_mm", "–"),
                errors.get("ring_N", "–"),
            )
        )
    columns = (
        "seed",
        "tilt [°]",
        "depth [mm]",
        "outcome",
        "tip [mm]",
        "axis from fulcrum [mm]",
        "ring [N]",
    )
    return Sheet("trials", "Every trial", columns, tuple(rows))


def _figure(trials: list[ArmTrial]) -> Figure:
    done = [one for one in trials if one.failure is None]

    def draw(figure: Any) -> None:
        left, right = figure.subplots(1, 2)
        for good, colour, mark, name in (
            (True, _BLUE, "o", _SUCCESS),
            (False, _ORANGE, "x", INEXACT),
        ):
            group = [one for one in done if (outcome(one) == _SUCCESS) is good]
            if not group:
                continue
            last = [one.phases[-1].errors for one in group]
            tips = [errors["tip_mm"] for errors in last]
            axis = [errors["axis_from_fulcrum_mm"] for errors in last]
            depths = [one.depth / MILLIMETRE for one in group]
            left.plot(axis, tips, mark, color=colour, alpha=0.7, label=name)
            right.plot(depths, tips, mark, color=colour, alpha=0.7, label=name)
        left.axvline(AXIS_MM, color="black", linewidth=0.8, linestyle=":")
        for axes in (left, right):
            axes.axhline(TIP_MM, color="black", linewidth=0.8, linestyle=":")
            axes.set_ylabel("tip from where it should be [mm]")
            axes.set_ylim(0.0, 1.1 * TIP_MM)
            axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.9))
        left.set_xlim(0.0, 1.1 * AXIS_MM)
        left.set_xlabel("axis from the fulcrum [mm]")
        right.set_xlabel("depth [mm]")

    return Figure("errors", draw, (9.0, 4.0))


def measured(seeds: range, one_trial: Trial, progress: Progress | None = None) -> Findings:
    """Do the trials.

    Args:
        seeds: of the trials.
        one_trial: does one.
        progress: told how far it is; may cancel.

    Raises:
        SimulationError, PlannerMissingError: if a package is missing; names the extra.
    """
    trials: list[ArmTrial] = []
    for number, seed in enumerate(seeds):
        part = None
        if progress is not None:
            part = progress.part(number / len(seeds), (number + 1) / len(seeds))
        trials.append(one_trial(seed, part))
    good = sum(outcome(one) == _SUCCESS for one in trials)
    pressed = [one.phases[-1].errors["ring_N"] for one in trials if one.failure is None]
    lines = (
        f"{good} of {len(trials)} tools inserted: tip within {TIP_MM:g} mm, axis within"
        f" {AXIS_MM:g} mm of the fulcrum, still held (least share {100.0 * LEAST:g} %)",
        f"the shaft touched the ring in {sum(one > 0.0 for one in pressed)} of {len(pressed)},"
        f" with {max(pressed, default=0.0):.2g} N at most",
        "the place of the cameras was known exactly: no error of calibration, hand or eye is in it",
    )
    sheets = (_outcomes(trials), _phases(trials), _times(trials), _each(trials))
    return Findings(sheets, (_figure(trials),), lines, good >= LEAST * len(trials))


def _measure(progress: Progress | None) -> Findings:
    return measured(range(100), trial, progress)


def _quick(progress: Progress | None) -> Findings:
    return measured(range(3), trial, progress)


STUDY: Final = Survey(measure=_measure, quick=_quick)
"""A hundred insertions by pictures alone."""
