"""Pick and place: the tool from its tray to the trocar, as phases with times.

    approach   from where the arm is to above the tool, a way searched with an empty hand
    grasp      straight down onto it, and a rest for the hand to close
    lift       straight up
    transfer   to before the trocar, a way searched with the tool in the hand
    align      slowly onto the trocar's axis, the tip outside
    insert     along the axis, the shaft in the fulcrum

Pure planning: nothing is touched or weighed. How the hand lies about the shaft is free; the grips
are tried in the order of the margin that their postures keep, until one does all phases.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.mechanisms.arm import ArmProfile
from app.mechanisms.arm.kinematics import seven
from app.mechanisms.errors import MechanismError
from app.planning.arm.follow import MotionRefusedError, PoseLine, follow
from app.planning.arm.path import JointPath
from app.planning.arm.pivot import HeldTool, Pivot
from app.planning.arm.search import Budget, Collisions, SearchError, search
from app.planning.arm.timing import JointMotion, timed
from app.planning.errors import MotionError

ROLLS: Final = 12
"""Turns of the hand about the shaft that are tried at the trocar."""

SLOW: Final = 0.25
"""Share of the joints' speeds for phases in which something is near: grasp, align, insert."""


class PhaseName(StrEnum):
    """What the arm does."""

    APPROACH = "approach"
    GRASP = "grasp"
    LIFT = "lift"
    TRANSFER = "transfer"
    ALIGN = "align"
    INSERT = "insert"


@dataclass(frozen=True, slots=True, eq=False)
class Errand:
    """What is to be done.

    Attributes:
        T_world_needle: where the tool lies: its tip's frame, z out of the tip.
        up_world: away from the tray, shape (3,); across the shaft.
        depth: of the tip at the end [m].
        lift: how high above the tray the arm comes from and lifts to [m].
        before: how far the tip stands outside the fulcrum before it goes in [m].
        aside: how far from there, outwards along the axis, `align` begins [m].
        close: how long the hand takes to close [s].
    """

    T_world_needle: RigidTransform
    up_world: FloatArray
    depth: float
    lift: float = 100.0 * MILLIMETRE
    before: float = 20.0 * MILLIMETRE
    aside: float = 40.0 * MILLIMETRE
    close: float = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class ArmPhase:
    """A phase with its times.

    Attributes:
        name: what it is.
        begin: when [s] after the begin of all.
        motions: one after the other, at rest between.
        rest: how long it waits at its end [s].
        held: whether the tool is in the hand.
    """

    name: PhaseName
    begin: float
    motions: tuple[JointMotion, ...]
    rest: float
    held: bool

    @property
    def end(self) -> float:
        """When it ends [s]."""
        return self.begin + sum(one.duration for one in self.motions) + self.rest


@dataclass(frozen=True, slots=True, eq=False)
class PickPlace:
    """All phases, and the tool as it is held.

    Attributes:
        phases: one after the other.
        pivot: the trocar, with the tool in the grip that was chosen.
        tried: grips that could not, and why.
    """

    phases: tuple[ArmPhase, ...]
    pivot: Pivot
    tried: tuple[str, ...]

    @property
    def duration(self) -> float:
        """How long it takes [s]."""
        return self.phases[-1].end

    def phase_at(self, t: float) -> ArmPhase:
        """Return the phase at a time [s]; the last one after the end."""
        return next((one for one in self.phases if t < one.end), self.phases[-1])

    def at(self, t: float) -> FloatArray:
        """Joint angles at a time [s], shape (7,); at rest before the begin and after the end."""
        phase = self.phase_at(t)
        since = max(t - phase.begin, 0.0)
        for one in phase.motions:
            if since < one.duration:
                return np.asarray(one.at(since)[0][0])
            since -= one.duration
        last = phase.motions[-1]
        return np.asarray(last.at(last.duration)[0][0])


def pick_and_place(
    pivot: Pivot,
    errand: Errand,
    start: ArrayLike,
    empty: Collisions,
    holding: Callable[[HeldTool], Collisions],
    budget: Budget | None = None,
) -> PickPlace:
    """Plan the way of the tool from its tray into the trocar.

    Args:
        pivot: the trocar, arm and tool; the hand comes from above the tray with its z axis down,
            whatever `axis_tool` says, and the shaft lies along x of the tool frame or against it.
        errand: where the tool lies, and where it shall go.
        start: joint angles at the begin [rad], shape (7,).
        empty: what is free with an empty hand.
        holding: the same with a tool in the hand as given.
        budget: of each search; None for the default.

    Raises:
        MotionError: if no grip does all phases: says for each which phase, and why.
        FulcrumError, NoGripError: if the tip cannot be where it shall go.
        PlannerMissingError: if OMPL or Ruckig is not installed.
    """
    pivot.aim(pivot.p_world + errand.depth * pivot.inward_world)
    tried: list[str] = []
    q0 = seven(start, "start")
    for sign in (1.0, -1.0):
        tool = HeldTool(pivot.tool.length, pivot.tool.grip, np.array([sign, 0.0, 0.0]))
        there = Pivot(
            pivot.arm, tool, pivot.p_world, pivot.inward_world, pivot.tilt, pivot.clearance
        )
        job = _Errands(there, errand, q0, empty, holding(tool), budget or Budget())
        try:
            picked = job.picked()
        except _StuckError as error:
            tried.append(f"shaft {'along' if sign > 0 else 'against'} x: {error}")
            continue
        for roll, inserted in job.insertions(tried):
            try:
                placed = job.placed(picked[-1].path.q[-1], roll, inserted)
            except _StuckError as error:
                tried.append(f"roll {np.degrees(roll):.0f}°: {error}")
                continue
            return PickPlace(job.phases(picked, placed), there, tuple(tried))
    raise MotionError("no grip brings the tool into the trocar: " + "; ".join(tried))


class _StuckError(MotionError):
    """A phase that cannot be."""


@dataclass(frozen=True, slots=True, eq=False)
class _Leg:
    name: PhaseName
    path: JointPath
    held: bool


@dataclass(frozen=True, slots=True, eq=False)
class _Errands:
    pivot: Pivot
    errand: Errand
    start: FloatArray
    empty: Collisions
    loaded: Collisions
    budget: Budget

    @property
    def arm(self) -> ArmProfile:
        return self.pivot.arm

    def lying(self, above: float) -> RigidTransform:
        """Pose of the tip's frame for the hand over the tool, `above` the tray's."""
        # the hand's z down, its x along the shaft: what the grip says of the tip's frame
        up = np.asarray(self.errand.up_world) / np.linalg.norm(self.errand.up_world)
        shaft = self.errand.T_world_needle.rotation[:, 2]
        x = self.pivot.tool.axis_tool[0] * (shaft - up * float(shaft @ up))
        x /= np.linalg.norm(x)
        hand = RigidTransform(
            np.stack([x, np.cross(-up, x), -up], axis=1),
            self.errand.T_world_needle.translation - self.pivot.tool.grip * shaft + above * up,
        )
        return hand @ self.pivot.tool.T_tool_needle

    def line(self, name: PhaseName, a: RigidTransform, b: RigidTransform, **more: Any) -> JointPath:
        """Follow a line of the tip's frame, or say in which phase it cannot be."""
        try:
            made = follow(
                self.arm, PoseLine(a, b), self.pivot.tool.T_tool_needle, suggest=False, **more
            )
        except (MotionRefusedError, MechanismError) as error:
            raise _StuckError(f"{name.value}: {error}") from error
        return made.path

    def clear(self, name: PhaseName, path: JointPath, things: Collisions) -> None:
        if (s := things.stopped(self.arm, path)) is not None:
            share = 100.0 * (s - path.s[0]) / (path.s[-1] - path.s[0])
            raise _StuckError(f"{name.value}: the arm touches something after {share:.0f} %")

    def way(self, name: PhaseName, things: Collisions, a: FloatArray, b: FloatArray) -> list[_Leg]:
        """Search a way; none is needed where the arm is there already."""
        if not np.abs(a - b).max() > 0.0:
            return []
        try:
            found = search(self.arm, things, a, b, budget=self.budget)
        except SearchError as error:
            raise _StuckError(f"{name.value}: {error}") from error
        return [_Leg(name, path, name is PhaseName.TRANSFER) for path in found.paths]

    def picked(self) -> list[_Leg]:
        """Approach, grasp and lift."""
        above, on = self.lying(self.errand.lift), self.lying(0.0)
        down = self.line(PhaseName.GRASP, above, on)
        up = JointPath(down.s, down.q[::-1])
        self.clear(PhaseName.GRASP, down, self.empty)
        way = self.way(PhaseName.APPROACH, self.empty, self.start, down.q[0])
        return [*way, _Leg(PhaseName.GRASP, down, False), _Leg(PhaseName.LIFT, up, True)]

    def insertions(self, tried: list[str]) -> list[tuple[float, JointPath]]:
        """Ways in, by the turn of the hand about the shaft; the best margin first."""
        axis, found = self.pivot.inward_world, []
        for roll in 2.0 * np.pi * np.arange(ROLLS) / ROLLS - np.pi:
            outside, inside = (
                self.pivot.pose(axis, depth, float(roll))
                for depth in (-self.errand.before, self.errand.depth)
            )
            try:
                path = self.line(PhaseName.INSERT, outside, inside, pivot=self.pivot)
                self.clear(PhaseName.INSERT, path, self.loaded)
            except _StuckError as error:
                tried.append(f"roll {np.degrees(roll):.0f}°: {error}")
                continue
            q = path.q
            margin = float(np.minimum(self.arm.upper - q, q - self.arm.lower).min())
            found.append((margin, float(roll), path))
        found.sort(key=lambda one: -one[0])
        return [(roll, path) for _, roll, path in found]

    def placed(self, q: FloatArray, roll: float, inserted: JointPath) -> list[_Leg]:
        """Transfer, align and insert, for one way in."""
        axis, errand = self.pivot.inward_world, self.errand
        far, near = (
            self.pivot.pose(axis, -depth, roll)
            for depth in (errand.before + errand.aside, errand.before)
        )
        # planned backwards from where the way in begins, so that the two meet in one posture
        back = self.line(PhaseName.ALIGN, near, far, start=inserted.q[0])
        align = JointPath(back.s, back.q[::-1])
        self.clear(PhaseName.ALIGN, align, self.loaded)
        way = self.way(PhaseName.TRANSFER, self.loaded, q, align.q[0])
        return [
            *way,
            _Leg(PhaseName.ALIGN, align, True),
            _Leg(PhaseName.INSERT, inserted, True),
        ]

    def phases(self, picked: list[_Leg], placed: list[_Leg]) -> tuple[ArmPhase, ...]:
        """Give all legs their times."""
        slow = (PhaseName.GRASP, PhaseName.ALIGN, PhaseName.INSERT)
        done: list[ArmPhase] = []
        for name in PhaseName:
            legs = [leg for leg in (*picked, *placed) if leg.name is name]
            if not legs:
                continue
            scale = SLOW if name in slow else 1.0
            done.append(
                ArmPhase(
                    name,
                    done[-1].end if done else 0.0,
                    tuple(timed(self.arm, leg.path, scale) for leg in legs),
                    self.errand.close if name is PhaseName.GRASP else 0.0,
                    legs[0].held,
                )
            )
        return tuple(done)
