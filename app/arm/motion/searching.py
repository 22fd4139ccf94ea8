"""A way for the arm around what stands about: search, shortening, smoothing, and a last check.

What is free is asked of whoever knows (`Collisions`). OMPL searches in the space of the joints, or,
while the tool is in the trocar, in that of the tip, whose postures keep the shaft in the fulcrum by
their making. Random shortcuts and a spline follow, and what comes out has been checked as it will
be moved. With a distance the check is certain: what moves by less than the distances at both ends
of a step cannot have touched anything between. With `free` alone it looks every `step`.

The same seed gives the same way on every machine, as long as it is the number of tests, not the
time, that ends the search. OMPL's seed is one for a process: searches at once in threads mix.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike

from app.arm.mechanics import ArmProfile
from app.arm.mechanics.kinematics import seven
from app.arm.motion.errors import MotionError, PlannerMissingError
from app.arm.motion.path import Bends, JointPath
from app.arm.motion.timing import timed
from app.core.arrays import FloatArray
from app.core.extras import not_installed
from app.core.messages import sentence
from app.core.units import MILLIMETRE

if TYPE_CHECKING:
    from collections.abc import Iterator

TOUCH: Final = 0.5 * MILLIMETRE
"""Motion [m] below which a step that distances do not prove free counts as touching."""

_HALVINGS: Final = 5  # of a spline's intervals, until it is free
_SHORTCUTS: Final = 60
_ATTEMPTS: Final = 3


class Planner(StrEnum):
    """Ways of searching.

    `RRT_CONNECT` grows two trees and ends with the first way; the others go on for a shorter one
    until the budget ends: `RRT_STAR` by rewiring a tree, `BIT_STAR` by batches of samples in an
    order of promise. OMPL's road maps are left out: they look for a way in a second thread.
    """

    RRT_CONNECT = "RRTConnect"
    RRT_STAR = "RRTstar"
    BIT_STAR = "BITstar"


@dataclass(frozen=True, slots=True)
class Budget:
    """When a search gives up (or, of those that go on, ends).

    Attributes:
        seconds: of time.
        tests: of whether a posture is free.
        seed: of the search.
    """

    seconds: float = 5.0
    tests: int = 20_000
    seed: int = 1


@dataclass(frozen=True, slots=True, eq=False)
class Collisions:
    """Whether the arm, with what it holds, touches something.

    Attributes:
        free: of joint angles [rad], shape (7,).
        distance: to what is nearest [m], never too large; None where nobody knows it.
        beyond: how far hand and what it holds reach from the flange [m], and the thickness of the
            links: what the levers of the joints, which `distance` relies on, are longer than links.
        step: largest turn of a joint between tests where there is no distance [rad].
        names: what a posture that is not free touches, in words; None if nobody knows.
    """

    free: Callable[[FloatArray], bool]
    distance: Callable[[FloatArray], float] | None = None
    beyond: float = 0.4
    step: float = 0.02
    names: Callable[[FloatArray], str | None] | None = None

    def touched(self, q: FloatArray) -> str:
        """Say what a posture touches, as the end of a sentence."""
        what = self.names(q) if self.names is not None else None
        return what or sentence("the arm touches something")

    def stopped(self, arm: ArmProfile, path: JointPath) -> float | None:
        """Return where along a path something is touched, or a joint is beyond its limit; None:
        nowhere.

        Args:
            arm: its lengths and limits.
            path: the path.
        """
        hand = arm.flange + self.beyond
        levers = np.array([arm.upper_arm + arm.forearm + hand] * 3 + [arm.forearm + hand] * 1)
        levers = np.append(levers, [hand] * 3)
        bends = Bends.of(arm, path)
        if (bad := ~(arm.beyond(bends.q) <= 1e-9).all(axis=1)).any():
            return float(bends.s[int(np.argmax(bad))])
        if not self.free(bends.q[0]):
            return float(bends.s[0])
        for k in range(len(bends.speeds)):
            a, b = float(bends.s[k]), float(bends.s[k + 1])
            if (s := self._step(path, bends.speeds[k], levers, a, b)) is not None:
                return s
        return None

    def _step(
        self, path: JointPath, speeds: FloatArray, levers: FloatArray, a: float, b: float
    ) -> float | None:
        """Return where a step from a place that is free stops, or None."""
        pieces = max(1, int(np.ceil((b - a) * float(speeds.max()) / self.step)))
        if self.distance is None:
            for s in a + (b - a) * np.arange(1, pieces + 1) / pieces:
                if not self.free(path.at(s)):
                    return float(s)
            return None
        ends = [(s, self.distance(path.at(s))) for s in (a, b)]
        if not self.free(path.at(b)):
            return b
        open_ = [(ends[0], ends[1])]
        while open_:
            (s0, d0), (s1, d1) = open_.pop()
            moved = float(speeds @ levers) * (s1 - s0)
            if d0 + d1 > moved:
                continue
            if moved < TOUCH:
                return s0
            middle = 0.5 * (s0 + s1)
            q = path.at(middle)
            if not self.free(q):
                return middle
            there = (middle, self.distance(q))
            open_ += [(there, (s1, d1)), ((s0, d0), there)]
        return None


@dataclass(frozen=True, slots=True, eq=False)
class FoundWay:
    """A way.

    Attributes:
        paths: of the joints, one after the other, at rest between; all checked.
        tests: how many postures were tested for it.
        seconds: how long it took.
        first_length: length in the searched space before it was shortened [rad, or m of the tip].
        length: of the paths, in the space of the joints [rad].
    """

    paths: tuple[JointPath, ...]
    tests: int
    seconds: float
    first_length: float
    length: float


class SearchError(MotionError):
    """No way was found: within the budget, or because an end of it is not free."""


def import_ompl() -> Any:
    """Import OMPL.

    Raises:
        PlannerMissingError: if it is not installed; names the extra.
    """
    try:
        import ompl.base
        import ompl.geometric
        import ompl.util
    except ImportError as error:
        raise not_installed(PlannerMissingError, "OMPL", "arm") from error
    return ompl


def search(
    arm: ArmProfile,
    collisions: Collisions,
    start: ArrayLike,
    goal: ArrayLike,
    planner: Planner = Planner.RRT_CONNECT,
    budget: Budget | None = None,
) -> FoundWay:
    """Find a way between two postures; the straight line of the joints, where that is free.

    Args:
        arm: its limits.
        collisions: what is free.
        start: joint angles [rad], shape (7,).
        goal: joint angles [rad], shape (7,).
        planner: how to search.
        budget: when to give up, and the seed; None for the default.

    Raises:
        SearchError: if an end is not free or not within the limits, or no way was found.
        PlannerMissingError: if OMPL or Ruckig is not installed.
    """
    a, b = seven(start, "start"), seven(goal, "goal")
    run = _Run(budget or Budget(), collisions.free)
    for name, q in (("start", a), ("goal", b)):
        if not arm.allows(q):
            raise SearchError(
                sentence(
                    "the {name} has a joint {excess:.3g} rad beyond",
                    name=name,
                    excess=arm.beyond(q).max(),
                )
            )
        if not collisions.free(q):
            raise SearchError(
                sentence(
                    "the arm touches something at the {name}: begin and end where it is free",
                    name=name,
                )
            )
    if not np.abs(b - a).max() > 0.0:
        raise SearchError(sentence("start and goal are the same posture: there is nothing to move"))
    counted = Collisions(run.valid, collisions.distance, collisions.beyond, collisions.step)

    def clear(path: JointPath) -> bool:
        return counted.stopped(arm, path) is None

    if clear(straight := JointPath.straight(a, b)):
        return run.found((straight,), straight.length)
    points = run.search((arm.lower, arm.upper), a, b, run.valid, collisions.step, planner)
    first = _length(points)
    points = _shortened(points, lambda p, q: clear(JointPath.straight(p, q)), run.rng)
    straights = tuple(JointPath.straight(p, q) for p, q in pairwise(points))
    smooth = _smooth(points, clear)
    if smooth is None:
        return run.found(straights, first)
    stopping = sum(timed(arm, one).duration for one in straights)
    faster = timed(arm, smooth).duration < stopping
    return run.found((smooth,) if faster else straights, first)


class _Run:
    """One search: its budget, what it has used of it, and its random numbers."""

    def __init__(self, budget: Budget, free: Callable[[FloatArray], bool]) -> None:
        self.budget, self._free = budget, free
        self.tests, self.begun = 0, time.perf_counter()
        self.rng = np.random.default_rng(budget.seed)

    def valid(self, q: FloatArray) -> bool:
        """Return whether a posture is free; counted."""
        self.tests += 1
        return bool(self._free(q))

    def spent(self) -> bool:
        """Return whether the budget is."""
        late = time.perf_counter() - self.begun > self.budget.seconds
        return late or self.tests > self.budget.tests

    def found(self, paths: tuple[JointPath, ...], first: float) -> FoundWay:
        """Wrap a way."""
        seconds = time.perf_counter() - self.begun
        return FoundWay(paths, self.tests, seconds, first, sum(path.length for path in paths))

    def search(
        self,
        box: tuple[FloatArray, FloatArray],
        start: FloatArray,
        goal: FloatArray,
        valid: Callable[[FloatArray], bool],
        step: float,
        planner: Planner,
        attempt: int = 0,
    ) -> list[FloatArray]:
        """Return places from start to goal, straight between them, as OMPL finds them.

        Raises:
            SearchError: if it finds none.
        """
        seed = self.budget.seed + 1_000_003 * attempt
        found = _places(box, (start, goal), valid, step, planner, seed, self.spent)
        if found is None:
            raise SearchError(
                sentence(
                    "{planner} found no way in {time_perf_counter:.3g} s and"
                    " {tests} tests (budget {budget_seconds:g} s, {budget_tests} tests,"
                    " seed {budget_seed}): give it more, or make room",
                    planner=planner.value,
                    time_perf_counter=time.perf_counter() - self.begun,
                    tests=self.tests,
                    budget_seconds=self.budget.seconds,
                    budget_tests=self.budget.tests,
                    budget_seed=self.budget.seed,
                )
            )
        return found


def _places(
    box: tuple[FloatArray, FloatArray],
    ends: tuple[FloatArray, FloatArray],
    valid: Callable[[FloatArray], bool],
    step: float,
    planner: Planner,
    seed: int,
    spent: Callable[[], bool],
) -> list[FloatArray] | None:
    """Let OMPL search; None if it finds no way. What it made is gone when this returns."""
    ompl = import_ompl()
    base, count = ompl.base, len(ends[0])
    with _quiet(ompl.util):
        ompl.util.RNG.setSeed(seed)
        space, bounds = base.RealVectorStateSpace(count), base.RealVectorBounds(count)
        for k in range(count):
            bounds.setLow(k, float(box[0][k]))
            bounds.setHigh(k, float(box[1][k]))
        space.setBounds(bounds)
        setup = ompl.geometric.SimpleSetup(space)
        setup.setStateValidityChecker(lambda s: valid(np.array([s[k] for k in range(count)])))
        information = setup.getSpaceInformation()
        information.setStateValidityCheckingResolution(step / space.getMaximumExtent())
        states = space.allocState(), space.allocState()
        for state, place in zip(states, ends, strict=True):
            for k in range(count):
                state[k] = float(place[k])
        setup.setStartAndGoalStates(*states)
        setup.setPlanner(getattr(ompl.geometric, planner.value)(information))
        setup.solve(base.PlannerTerminationCondition(spent))
        if not setup.haveExactSolutionPath():
            return None
        way = setup.getSolutionPath().getStates()
        return [np.array([state[k] for k in range(count)]) for state in way]


@contextmanager
def _quiet(util: Any) -> Iterator[None]:
    """OMPL says nothing meanwhile: neither of its steps, nor that it was seeded before."""
    util.noOutputHandler()
    try:
        yield
    finally:
        util.restorePreviousOutputHandler()


def _length(points: Sequence[FloatArray]) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _shortened(
    points: list[FloatArray],
    clear: Callable[[FloatArray, FloatArray], bool],
    rng: np.random.Generator,
) -> list[FloatArray]:
    """Replace parts of a way by straight lines where these are free; never longer."""
    for _ in range(_SHORTCUTS):
        lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
        if len(lengths) < 2:
            break
        along = np.append(0.0, np.cumsum(lengths))
        a, b = np.sort(rng.uniform(0.0, along[-1], 2))
        i, j = (int(np.clip(np.searchsorted(along, x) - 1, 0, len(lengths) - 1)) for x in (a, b))
        if i == j:
            continue
        p, q = (
            points[k] + (x - along[k]) / lengths[k] * (points[k + 1] - points[k])
            for k, x in ((i, a), (j, b))
        )
        if clear(p, q):
            points = [*points[: i + 1], p, q, *points[j + 1 :]]
            keep = np.append(True, np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9)
            points = [point for point, kept in zip(points, keep, strict=True) if kept]
    return points


def _smooth(points: list[FloatArray], clear: Callable[[JointPath], bool]) -> JointPath | None:
    """Spline through the places, with more of the straight lines between until it is free."""
    places = np.array(points)
    for _ in range(_HALVINGS):
        lengths = np.linalg.norm(np.diff(places, axis=0), axis=1)
        path = JointPath(np.append(0.0, np.cumsum(lengths)) / lengths.sum(), places)
        if clear(path):
            return path
        middles = 0.5 * (places[1:] + places[:-1])
        both = np.empty((2 * len(places) - 1, places.shape[1]))
        both[::2], both[1::2] = places, middles
        places = both
    return None
