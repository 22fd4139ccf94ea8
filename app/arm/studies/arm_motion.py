"""Study: how the arm's motion is planned, and what a longer search is worth.

An arm goes around a post, from postures on one side to postures on the other; each planner gets
several budgets of tests and several seeds. Beside it: what a check in steps overlooks that a check
by distances does not, what the shaft's bound in the fulcrum costs in knots, and what the limits of
the joints leave of a path's time.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final

import numpy as np

from app.arm.mechanics import ArmProfile, link_frames, load_arm, solve
from app.arm.motion import (
    Budget,
    Collisions,
    FoundWay,
    HeldTool,
    JointPath,
    Pivot,
    Planner,
    PoseLine,
    SearchError,
    follow,
    free_move,
    import_ompl,
    import_ruckig,
    search,
    timed,
)
from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.studies.findings import Figure, Findings, Sheet, Survey

DECLARATION: Final[dict[str, Any]] = {
    "title": "The arm's motion: planner and budget against success and length",
    "question": "Which planner finds a way in which budget, and is a longer search a shorter way?",
    "reference": "distances along the way, looked at 500 times a path; the joints' limits",
}

COLOURS: Final = {
    Planner.RRT_CONNECT: "#0072B2",
    Planner.RRT_STAR: "#D55E00",
    Planner.BIT_STAR: "#009E73",
}
_DOWN: Final = np.diag([1.0, -1.0, -1.0])
_TURN: Final = 2.1  # of the hand about the shaft [rad], where it can be inserted
_ALONG: Final = np.linspace(0.0, 1.0, 16)[:, None]
_TIME: Final = 20.0  # of a search [s]: tests end it, so that the table is the same elsewhere


@dataclass(frozen=True, slots=True)
class MotionSize:
    """How much is measured: seeds for each budget, and budgets [tests]."""

    seeds: int = 4
    budgets: tuple[int, ...] = (300, 1000, 3000, 10_000)


@dataclass(frozen=True, slots=True, eq=False)
class Post:
    """An upright post beside the arm, which is three thick lines.

    Attributes:
        arm: the arm.
        p_base: its foot [m], shape (2,).
        radius, height: of it [m].
        thick: of the arm [m].
    """

    arm: ArmProfile
    p_base: tuple[float, float] = (0.5, 0.0)
    radius: float = 0.06
    height: float = 0.7
    thick: float = 0.05

    def distance(self, q: FloatArray) -> float:
        """Return how far the arm is from it [m], joint angles q [rad], shape (7,)."""
        frames = link_frames(self.arm, q)
        shoulder, elbow, wrist = (frames[k][:3, 3] for k in (1, 3, 6))
        ends = (shoulder, elbow, wrist, wrist + self.arm.flange * frames[6][:3, 2])
        places = np.concatenate([a + _ALONG * (b - a) for a, b in pairwise(ends)])
        aside = np.hypot(places[:, 0] - self.p_base[0], places[:, 1] - self.p_base[1])
        outside = np.maximum(aside - self.radius, places[:, 2] - self.height)
        return float(outside.min()) - self.thick

    def collisions(self, step: float | None = None) -> Collisions:
        """Return the test by distances; with a step [rad], by that alone."""
        if step is None:
            return Collisions(self.free, self.distance, beyond=0.0)
        return Collisions(self.free, beyond=0.0, step=step)

    def free(self, q: FloatArray) -> bool:
        """Return whether the arm does not touch it."""
        return self.distance(q) > 0.0


@dataclass(frozen=True, slots=True, eq=False)
class TriedSearch:
    """A search: planner, budget, seed, and what was found, if anything."""

    planner: Planner
    tests: int
    seed: int
    found: FoundWay | None


def ends(arm: ArmProfile) -> tuple[FloatArray, FloatArray]:
    """Postures on both sides of the post."""
    first, second = (
        arm.wrist_pose(RigidTransform(_DOWN, np.array([0.5, y, 0.3]))) for y in (-0.35, 0.35)
    )
    start = solve(arm, first).q
    return start, solve(arm, second, near=start).q


def searches(
    arm: ArmProfile, size: MotionSize, progress: Callable[[], object]
) -> list[TriedSearch]:
    """Search with every planner, budget and seed."""
    post, (start, goal), tried = Post(arm), ends(arm), []
    for planner in Planner:
        for tests in size.budgets:
            for seed in range(1, size.seeds + 1):
                budget = Budget(_TIME, tests, seed)
                try:
                    found = search(arm, post.collisions(), start, goal, planner, budget)
                except SearchError:
                    found = None
                tried.append(TriedSearch(planner, tests, seed, found))
                progress()
    return tried


def _planners(arm: ArmProfile, tried: list[TriedSearch]) -> Sheet:
    rows = []
    for planner in Planner:
        for tests in sorted({one.tests for one in tried}):
            group = [one for one in tried if (one.planner, one.tests) == (planner, tests)]
            good = [one.found for one in group if one.found is not None]
            lasts = [sum(timed(arm, path).duration for path in one.paths) for one in good]
            rows.append(
                (
                    planner.value,
                    tests,
                    100.0 * len(good) / len(group),
                    *(
                        float(np.median(values)) if good else "–"
                        for values in (
                            [one.seconds for one in good],
                            [one.first_length for one in good],
                            [one.length for one in good],
                            lasts,
                        )
                    ),
                )
            )
    columns = (
        "planner",
        "budget [tests]",
        "found [%]",
        "time [s]",
        "as found [rad]",
        "shortened [rad]",
        "motion [s]",
    )
    return Sheet("planners", "Around a post: medians of those found", columns, tuple(rows))


def _checks(arm: ArmProfile, size: MotionSize) -> Sheet:
    """Return what ways touch that were checked in steps, and by distances."""
    post, (start, goal), rows = Post(arm), ends(arm), []
    for name, step in (("distances", None), ("0.02 rad", 0.02), ("0.1 rad", 0.1)):
        least, tests = np.inf, []
        for seed in range(1, size.seeds + 1):
            try:
                found = search(
                    arm, post.collisions(step), start, goal, budget=Budget(_TIME, 20_000, seed)
                )
            except SearchError:
                continue
            tests.append(found.tests)
            for path in found.paths:
                q = path.at(np.linspace(path.s[0], path.s[-1], 500))
                least = min(least, min(post.distance(one) for one in q))
        rows.append((name, float(np.median(tests)), least / MILLIMETRE))
    columns = ("checked by", "tests, median", "least distance [mm]")
    return Sheet("checks", "What the check of a way overlooks", columns, tuple(rows))


def _insertions(arm: ArmProfile) -> Sheet:
    """Knots that an insertion needs for how exactly the shaft stays in the fulcrum."""
    tool = HeldTool(0.35, 0.25, np.array([1.0, 0.0, 0.0]))
    pivot = Pivot(arm, tool, np.array([0.55, 0.0, 0.25]), np.array([0.05, -0.1, -1.0]))
    axis = pivot.inward_world
    line = PoseLine(pivot.pose(axis, -0.05, _TURN), pivot.pose(axis, 0.1, _TURN))
    rows = []
    for within in (1.0, 0.05, 0.01, 0.001):
        made = follow(
            arm, line, tool.T_tool_needle, pivot=pivot, within=within * MILLIMETRE, suggest=False
        )
        q = made.path.at(np.linspace(0.0, 1.0, 2000))
        seen = max(pivot.state(one).off for one in q)
        rows.append((within, len(made.path.s), made.off / MILLIMETRE, seen / MILLIMETRE))
    columns = ("asked [mm]", "knots", "shaft off, bound [mm]", "shaft off, seen [mm]")
    return Sheet("insertion", "An insertion of 150 mm through the fulcrum", columns, tuple(rows))


def _profiles(arm: ArmProfile, size: MotionSize) -> Sheet:
    """Return times of straight and curved paths, and what they use of the limits."""
    rng, rows = np.random.default_rng(1), []
    kinds: dict[str, list[tuple[float, float]]] = {
        "straight": [],
        "free": [],
        "curved, 6 knots": [],
    }
    for _ in range(10 * size.seeds):
        q = 0.5 * rng.uniform(arm.lower, arm.upper, (6, 7))
        made = (
            timed(arm, JointPath.straight(q[0], q[-1])),
            free_move(arm, q[0], q[-1]),
            timed(arm, JointPath(np.linspace(0.0, 1.0, 6), q)),
        )
        for kind, one in zip(kinds, made, strict=True):
            kinds[kind].append((one.duration, float(one.use_of_limits(arm).max())))
    for kind, values in kinds.items():
        times, used = np.array(values).T
        rows.append((kind, float(np.median(times)), 100.0 * used.min(), 100.0 * used.max()))
    columns = ("path", "time, median [s]", "least use of limits [%]", "largest use [%]")
    return Sheet("profiles", "Fastest motions between random postures", columns, tuple(rows))


def _budget_figure(tried: list[TriedSearch]) -> Figure:
    def draw(figure: Any) -> None:
        left, right = figure.subplots(1, 2)
        budgets = sorted({one.tests for one in tried})
        for planner, colour in COLOURS.items():
            groups = [
                [one.found for one in tried if (one.planner, one.tests) == (planner, tests)]
                for tests in budgets
            ]
            share = [100.0 * sum(one is not None for one in group) / len(group) for group in groups]
            left.semilogx(budgets, share, "o-", color=colour, label=planner.value)
            places = [
                (tests, one.length)
                for tests, group in zip(budgets, groups, strict=True)
                for one in group
                if one is not None
            ]
            if places:
                x, y = np.array(places).T
                right.semilogx(x, y, "o", color=colour, label=planner.value, alpha=0.6)
        left.set_ylabel("found [%]")
        right.set_ylabel("length, shortened [rad]")
        for axes in (left, right):
            axes.set_xticks(budgets, [str(tests) for tests in budgets])
            axes.minorticks_off()
            axes.set_xlabel("budget [tests]")
            axes.legend()

    return Figure("budget", draw, (9.0, 4.0))


def _motion_figure(arm: ArmProfile, tried: list[TriedSearch]) -> Figure:
    def draw(figure: Any) -> None:
        best = min(
            (one.found for one in tried if one.found is not None), key=lambda found: found.length
        )
        rows = figure.subplots(3, 1, sharex=True)
        begin = 0.0
        for path in best.paths:
            motion = timed(arm, path)
            t = np.linspace(0.0, motion.duration, 400)
            _, *derivatives = motion.at(t)
            limits = (arm.speed, arm.acceleration, arm.jerk)
            for axes, values, most in zip(rows, derivatives, limits, strict=True):
                axes.plot(begin + t, 100.0 * values / most, linewidth=0.9)
            begin += motion.duration
        for axes, name in zip(rows, ("speed", "acceleration", "jerk"), strict=True):
            axes.axhline(100.0, color="black", linewidth=0.5)
            axes.axhline(-100.0, color="black", linewidth=0.5)
            axes.set_ylabel(f"{name} [%]")
        rows[-1].set_xlabel("time [s]")

    return Figure("limits", draw, (8.0, 6.0))


def measured(size: MotionSize, progress: Progress | None = None) -> Findings:
    """Search, check, insert and time.

    Raises:
        PlannerMissingError: if OMPL or Ruckig is not installed; names the extra.
    """
    import_ompl()
    import_ruckig()
    arm, done = load_arm(), 0
    total = len(Planner) * len(size.budgets) * size.seeds

    def step() -> None:
        nonlocal done
        done += 1
        if progress is not None:
            progress.report(0.7 * done / total, sentence("searches"))

    tried = searches(arm, size, step)
    checks, insertion, profiles = _checks(arm, size), _insertions(arm), _profiles(arm, size)
    found = [one.found for one in tried if one.found is not None]
    figures = [_budget_figure(tried)] + ([_motion_figure(arm, tried)] if found else [])
    seen = float(checks.rows[0][2])
    bounded = all(float(row[3]) <= float(row[2]) <= 0.1 for row in insertion.rows)
    within = max(float(row[3]) for row in profiles.rows)
    lines = (
        f"ways checked by distances keep {seen:.2g} mm at least; in steps of 0.1 rad"
        f" {float(checks.rows[2][2]):.2g} mm",
        f"an insertion keeps the shaft within {max(float(row[2]) for row in insertion.rows):.2g} mm"
        " of the fulcrum, bounded (limit 0.1 mm)",
        f"no motion uses more than {within:.4g} % of a limit",
    )
    return Findings(
        (_planners(arm, tried), checks, insertion, profiles),
        tuple(figures),
        lines,
        bool(seen > 0.0 and bounded and within < 100.0001),
    )


def _measure(progress: Progress | None = None) -> Findings:
    return measured(MotionSize(), progress)


def _quick(progress: Progress | None = None) -> Findings:
    return measured(MotionSize(2, (300, 1000)), progress)


STUDY: Final = Survey(measure=_measure, quick=_quick)
"""Planners by their budgets, and what of their ways is checked, kept and timed."""
