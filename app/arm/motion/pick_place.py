"""Pick and place: the tool from its tray to the trocar, as phases with times.

    approach   from where the arm is to above the tool, a way searched with an empty hand
    grasp      straight down onto it, and a rest for the hand to close
    lift       straight up
    transfer   to before the trocar, a way searched with the tool in the hand
    align      slowly onto the trocar's axis, the tip outside
    pivot      about the fulcrum, from that axis to the wanted direction, the tip outside
    insert     along the wanted direction, the shaft in the fulcrum

Pure planning: nothing is touched or weighed. How the hand lies about the shaft is free; the grips
are tried in the order of the margin that their postures keep, until one does all phases.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from app.arm.mechanics import ArmProfile, solve
from app.arm.mechanics.kinematics import seven
from app.arm.motion.errors import MotionError
from app.arm.motion.following import MotionRefusedError, PoseArc, PoseLine, PoseMotion, follow
from app.arm.motion.path import JointPath
from app.arm.motion.pivot import HeldTool, Pivot
from app.arm.motion.searching import Budget, Collisions, SearchError, search
from app.arm.motion.timing import JointMotion, import_ruckig, timed
from app.core.arrays import FloatArray, angle_between, cross
from app.core.messages import joined, sentence, sentence_of
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.mechanisms.errors import MechanismError

ROLLS: Final = 12
"""Turns of the hand about the shaft that are tried at the trocar."""

SLOW: Final = 0.25
"""Share of the joints' speeds where something is near: in grasp, align, pivot and insert."""

_STRAIGHT: Final = 1e-6  # angle up to which there is nothing to pivot [rad]
_STARTS: Final = 4  # postures with which a way in is begun, for each grip
_WAYS: Final = 4  # grips for which a way is searched: the others keep less margin still


class PhaseName(StrEnum):
    """What the arm does."""

    APPROACH = "approach"
    GRASP = "grasp"
    LIFT = "lift"
    TRANSFER = "transfer"
    ALIGN = "align"
    PIVOT = "pivot"
    INSERT = "insert"


class Hindrance(StrEnum):
    """Why a phase cannot be."""

    REACH = "reach"  # no posture, or no going on from one to the next
    TOUCH = "touch"  # something is in the way
    WAY = "way"  # the search found none within its budget


@dataclass(frozen=True, slots=True, eq=False)
class PickPlaceTask:
    """What is to be done.

    Attributes:
        T_world_needle: where the tool lies: its tip's frame, z out of the tip.
        up_world: away from the tray, shape (3,); across the shaft.
        depth: of the tip at the end [m].
        axis_world: direction of the insertion, shape (3,); None: the trocar's axis.
        lift: how high above the tray the arm comes from and lifts to [m].
        before: how far the tip stands outside the fulcrum before it goes in [m].
        aside: how far from there, outwards along the axis, `align` begins [m].
        close: how long the hand takes to close [s].
        careful: share of the joints' speeds, accelerations and jerks with the tool in the hand.
    """

    T_world_needle: RigidTransform
    up_world: FloatArray
    depth: float
    axis_world: FloatArray | None = None
    lift: float = 100.0 * MILLIMETRE
    before: float = 20.0 * MILLIMETRE
    aside: float = 40.0 * MILLIMETRE
    close: float = 1.0
    careful: float = 1.0


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
        """Return when it ends [s]."""
        return self.begin + sum(one.duration for one in self.motions) + self.rest


@dataclass(frozen=True, slots=True, eq=False)
class PickPlace:
    """All phases, and the tool as it is held.

    Attributes:
        phases: one after the other.
        pivot: the trocar, with the tool in the grip that was chosen.
        task: what was to be done.
        tried: grips that could not, and why.
    """

    phases: tuple[ArmPhase, ...]
    pivot: Pivot
    task: PickPlaceTask
    tried: tuple[str, ...]

    @property
    def duration(self) -> float:
        """Return how long it takes [s]."""
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


class NotPlacedError(MotionError):
    """No grip brings the tool into the trocar.

    Attributes:
        phase: the latest that a grip could not do.
        hindrance: why it could not.
        why: the same in words.
        tried: all grips, and why each could not.
    """

    def __init__(self, stuck: _StuckError, tried: tuple[str, ...]) -> None:
        super().__init__(
            sentence("no grip brings the tool into the trocar: {tried}", tried=joined("; ", tried))
        )
        self.phase, self.hindrance, self.why = stuck.phase, stuck.hindrance, stuck.why
        self.tried = tried


def pick_and_place(
    pivot: Pivot,
    task: PickPlaceTask,
    start: ArrayLike,
    empty: Collisions,
    holding: Callable[[HeldTool], Collisions],
    budget: Budget | None = None,
    inside: Callable[[HeldTool], Collisions] | None = None,
) -> PickPlace:
    """Plan the way of the tool from its tray into the trocar.

    Args:
        pivot: the trocar, arm and tool; the hand comes from above the tray with its z axis down,
            whatever `axis_tool` says, and the shaft lies along x of the tool frame or against it.
        task: where the tool lies, and where it shall go.
        start: joint angles at the begin [rad], shape (7,).
        empty: what is free with an empty hand.
        holding: the same with a tool in the hand as given.
        budget: of each search; None for the default.
        inside: the same while the shaft is in the fulcrum, from `align` on, where the trocar round
            it is none of its business; None: as `holding`.

    Raises:
        NotPlacedError: if no grip does all phases: says for each which phase, and why.
        FulcrumError, NoGripError: if the tip cannot be where it shall go.
        PlannerMissingError: if OMPL or Ruckig is not installed.
    """
    import_ruckig()
    found = _first(pivot, task, start, (empty, holding, inside or holding), budget or Budget())
    job, picked, placed, tried = found
    return PickPlace(job.phases(picked, placed), job.pivot, task, tried)


def can_place(
    pivot: Pivot,
    task: PickPlaceTask,
    start: ArrayLike,
    empty: Collisions,
    holding: Callable[[HeldTool], Collisions],
    inside: Callable[[HeldTool], Collisions] | None = None,
) -> bool:
    """Return whether one of the first grips does all that `pick_and_place` does but the searched
    ways.

    Raises:
        FulcrumError, NoGripError: as `pick_and_place`.
    """
    try:
        _first(pivot, task, start, (empty, holding, inside or holding), None)
    except NotPlacedError:
        return False
    return True


_Things = tuple[Collisions, Callable[[HeldTool], Collisions], Callable[[HeldTool], Collisions]]


def _first(
    pivot: Pivot, task: PickPlaceTask, start: ArrayLike, things: _Things, budget: Budget | None
) -> tuple[_Planning, list[_Leg], list[_Leg], tuple[str, ...]]:
    """Return the first grip that does all, with its legs; those before it, and why not."""
    wanted = pivot.inward_world if task.axis_world is None else task.axis_world
    pivot.aim(pivot.p_world + task.depth * np.asarray(wanted))
    tried: list[str] = []
    stuck: list[_StuckError] = []
    empty, holding, inside = things
    q0 = seven(start, "start")

    def failed(grip: str, error: _StuckError) -> None:
        tried.append(sentence("{grip}: {reason}", grip=grip, reason=error))
        stuck.append(error)

    for sign in (1.0, -1.0):
        tool = HeldTool(pivot.tool.length, pivot.tool.grip, np.array([sign, 0.0, 0.0]))
        there = replace(pivot, tool=tool)
        job = _Planning(there, task, wanted, q0, empty, holding(tool), inside(tool), budget)
        try:
            picked = job.picked()
        except _StuckError as error:
            failed(f"shaft {'along' if sign > 0 else 'against'} x", error)
            continue
        searched = 0
        for roll, inserted in job.insertions(failed):
            try:
                placed = job.placed(picked[-1].path.q[-1], roll, inserted)
            except _StuckError as error:
                failed(f"roll {np.degrees(roll):.0f}°", error)
                searched += error.phase is PhaseName.TRANSFER
                if searched >= _WAYS:
                    break
                continue
            return job, picked, placed, tuple(tried)
    order = list(PhaseName)
    raise NotPlacedError(max(stuck, key=lambda one: order.index(one.phase)), tuple(tried))


class _StuckError(MotionError):
    """A phase that cannot be."""

    def __init__(self, phase: PhaseName, hindrance: Hindrance, reason: str) -> None:
        super().__init__(sentence("{phase}: {reason}", phase=phase.value, reason=reason))
        self.phase, self.hindrance, self.why = phase, hindrance, reason


@dataclass(frozen=True, slots=True, eq=False)
class _Leg:
    name: PhaseName
    path: JointPath
    held: bool


@dataclass(frozen=True, slots=True, eq=False)
class _Planning:
    pivot: Pivot
    task: PickPlaceTask
    wanted: FloatArray
    start: FloatArray
    empty: Collisions
    loaded: Collisions
    inside: Collisions
    budget: Budget | None  # None: no way is searched

    @property
    def arm(self) -> ArmProfile:
        return self.pivot.arm

    def lying(self, above: float) -> RigidTransform:
        """Pose of the tip's frame for the hand over the tool, `above` the tray's."""
        # the hand's z down, its x along the shaft: what the grip says of the tip's frame
        up = np.asarray(self.task.up_world) / np.linalg.norm(self.task.up_world)
        shaft = self.task.T_world_needle.rotation[:, 2]
        x = self.pivot.tool.axis_tool[0] * (shaft - up * float(shaft @ up))
        x /= np.linalg.norm(x)
        hand = RigidTransform(
            np.stack([x, np.cross(-up, x), -up], axis=1),
            self.task.T_world_needle.translation - self.pivot.tool.grip * shaft + above * up,
        )
        return hand @ self.pivot.tool.T_tool_needle

    def line(self, name: PhaseName, motion: PoseMotion, **more: Any) -> JointPath:
        """Follow a motion of the tip's frame, or say in which phase it cannot be."""
        try:
            made = follow(self.arm, motion, self.pivot.tool.T_tool_needle, suggest=False, **more)
        except (MotionRefusedError, MechanismError) as error:
            raise _StuckError(name, Hindrance.REACH, sentence_of(error)) from error
        return made.path

    def clear(self, name: PhaseName, path: JointPath, things: Collisions) -> None:
        if (s := things.stopped(self.arm, path)) is not None:
            share = 100.0 * (s - path.s[0]) / (path.s[-1] - path.s[0])
            what = things.touched(path.at(s))
            raise _StuckError(
                name,
                Hindrance.TOUCH,
                sentence("{collision} after {share:.0f} %", collision=what, share=share),
            )

    def way(self, name: PhaseName, things: Collisions, a: FloatArray, b: FloatArray) -> list[_Leg]:
        """Search a way; none is needed where the arm is there already."""
        if self.budget is None or not np.abs(a - b).max() > 0.0:
            return []
        for q in (a, b):
            if not things.free(q):
                raise _StuckError(
                    name,
                    Hindrance.TOUCH,
                    sentence("{things_touched} at its end", things_touched=things.touched(q)),
                )
        try:
            found = search(self.arm, things, a, b, budget=self.budget)
        except SearchError as error:
            raise _StuckError(name, Hindrance.WAY, sentence_of(error)) from error
        return [_Leg(name, path, name is PhaseName.TRANSFER) for path in found.paths]

    def picked(self) -> list[_Leg]:
        """Approach, grasp and lift."""
        above, on = self.lying(self.task.lift), self.lying(0.0)
        down = self.line(PhaseName.GRASP, PoseLine(above, on))
        up = JointPath(down.s, down.q[::-1])
        self.clear(PhaseName.GRASP, down, self.empty)
        way = self.way(PhaseName.APPROACH, self.empty, self.start, down.q[0])
        return [*way, _Leg(PhaseName.GRASP, down, False), _Leg(PhaseName.LIFT, up, True)]

    def insertions(
        self, failed: Callable[[str, _StuckError], None]
    ) -> Iterator[tuple[float, JointPath]]:
        """Ways in, by the turn of the hand about the shaft; the best margin first.

        Where none of these does, those between.
        """
        for between in (0.0, 0.5) if self.budget is not None else (0.0,):
            found = []
            for roll in 2.0 * np.pi * (np.arange(ROLLS) + between) / ROLLS - np.pi:
                outside, within = (
                    self.pivot.pose(self.wanted, depth, float(roll))
                    for depth in (-self.task.before, self.task.depth)
                )
                try:
                    solve(self.arm, self.pivot.wrist_pose(within))  # quickly told if it cannot
                    path = self.line(
                        PhaseName.INSERT,
                        PoseLine(outside, within),
                        pivot=self.pivot,
                        starts=_STARTS,
                    )
                    self.clear(PhaseName.INSERT, path, self.inside)
                except MechanismError as error:
                    stuck = _StuckError(PhaseName.INSERT, Hindrance.REACH, sentence_of(error))
                    failed(f"roll {np.degrees(roll):.0f}°", stuck)
                    continue
                except _StuckError as error:
                    failed(f"roll {np.degrees(roll):.0f}°", error)
                    continue
                q = path.q
                margin = float(np.minimum(self.arm.upper - q, q - self.arm.lower).min())
                found.append((margin, float(roll), path))
            found.sort(key=lambda one: -one[0])
            yield from ((roll, path) for _, roll, path in found)

    def placed(self, q: FloatArray, roll: float, inserted: JointPath) -> list[_Leg]:
        """Transfer, align, pivot and insert, for one way in."""
        axis, task = self.pivot.inward_world, self.task
        turns = angle_between(self.wanted, axis) > _STRAIGHT
        far, near = (
            self.pivot.pose(axis if turns else self.wanted, -depth, roll)
            for depth in (task.before + task.aside, task.before)
        )
        # planned backwards from where the way in begins, so that they meet in one posture
        legs, begin = [_Leg(PhaseName.INSERT, inserted, True)], inserted.q[0]
        if turns:
            leaning = self.pivot.pose(self.wanted, -task.before, roll)
            about = cross(self.wanted, axis)
            upright = PoseArc(leaning, near, self.pivot.p_world, about)
            path = self.line(PhaseName.PIVOT, upright, start=begin, pivot=self.pivot)
            legs, begin = [self.backwards(PhaseName.PIVOT, path), *legs], path.q[-1]
        path = self.line(PhaseName.ALIGN, PoseLine(near, far), start=begin)
        legs = [self.backwards(PhaseName.ALIGN, path), *legs]
        return [*self.way(PhaseName.TRANSFER, self.loaded, q, path.q[-1]), *legs]

    def backwards(self, name: PhaseName, path: JointPath) -> _Leg:
        """Return what was planned backwards as it is gone, if nothing is in its way."""
        there = JointPath(path.s, path.q[::-1])
        self.clear(name, there, self.inside)
        return _Leg(name, there, True)

    def phases(self, picked: list[_Leg], placed: list[_Leg]) -> tuple[ArmPhase, ...]:
        """Give all legs their times."""
        slow = (PhaseName.GRASP, PhaseName.ALIGN, PhaseName.PIVOT, PhaseName.INSERT)
        care, arm = self.task.careful, self.arm
        gentle = replace(arm, acceleration=care * arm.acceleration, jerk=care * arm.jerk)
        done: list[ArmPhase] = []
        for name in PhaseName:
            legs = [leg for leg in (*picked, *placed) if leg.name is name]
            if not legs:
                continue
            held = legs[0].held
            scale = (SLOW if name in slow else 1.0) * (care if held else 1.0)
            done.append(
                ArmPhase(
                    name,
                    done[-1].end if done else 0.0,
                    tuple(timed(gentle if held else arm, leg.path, scale) for leg in legs),
                    self.task.close if name is PhaseName.GRASP else 0.0,
                    held,
                )
            )
        return tuple(done)
