"""Turns needle poses into events of the attempt, with hysteresis so that noise moves nothing."""

from dataclasses import dataclass, replace
from typing import Final

from app.session.machine import Event, State
from app.session.needle import NeedlePose


@dataclass(frozen=True, slots=True)
class Thresholds:
    """When a phase changes.

    Attributes:
        insert_depth: depth from which the needle counts as inserted [m].
        withdraw_depth: depth below which it counts as withdrawn [m]; the gap to `insert_depth`
            is the hysteresis.
        hold_rate: mean axial speed below which the needle stands still [m/s].
        hold_time: how long it must stand still [s].
        hold_distance: how near to the target the tip must be to count as holding [m].
        move_distance: change of depth that ends a hold [m].
    """

    insert_depth: float = 0.002
    withdraw_depth: float = 0.0
    hold_rate: float = 0.001
    hold_time: float = 1.0
    hold_distance: float = 0.015
    move_distance: float = 0.002


DEFAULT: Final = Thresholds()


@dataclass(frozen=True, slots=True)
class Classifier:
    """What the classifier remembers between poses.

    Attributes:
        window: (time [s], depth [m]) of the poses of the last `hold_time`, oldest first.
        held_depth: depth at which the present hold began [m].
    """

    window: tuple[tuple[float, float], ...] = ()
    held_depth: float = 0.0


def classify(
    memory: Classifier,
    state: State,
    pose: NeedlePose,
    distance: float,
    limits: Thresholds = DEFAULT,
) -> tuple[Classifier, Event | None]:
    """Look at one pose.

    A depth that the cameras do not vouch for moves nothing and breaks a beginning hold. The speed
    is judged as the spread of the depth over the whole window, so that camera noise at one pose
    (0.1 mm in 1/30 s is 3 mm/s) counts for nothing.

    Args:
        memory: what the last call returned.
        state: the attempt's state.
        pose: newest pose.
        distance: from the tip to the target [m].
        limits: thresholds.

    Returns:
        The new memory, and the event that the pose means, if any.
    """
    if not pose.measured:
        return replace(memory, window=()), None
    memory = _remember(memory, pose, limits)
    if state is State.ALIGNING:
        return memory, Event.INSERT if pose.depth > limits.insert_depth else None
    if state not in (State.INSERTING, State.HOLDING):
        return memory, None
    if pose.depth < limits.withdraw_depth:
        return Classifier(), Event.WITHDRAW
    if state is State.INSERTING:
        return _begin_hold(memory, pose, distance, limits)
    if abs(pose.depth - memory.held_depth) > limits.move_distance:
        return Classifier(), Event.INSERT
    return memory, None


def _remember(memory: Classifier, pose: NeedlePose, limits: Thresholds) -> Classifier:
    """Append the pose; of those older than the window keep one, so that the window spans it."""
    window = (*(entry for entry in memory.window if entry[0] < pose.time), (pose.time, pose.depth))
    start = pose.time - limits.hold_time
    first = max((i for i, (time, _) in enumerate(window) if time <= start + 1e-9), default=0)
    return replace(memory, window=window[first:])


def _begin_hold(
    memory: Classifier, pose: NeedlePose, distance: float, limits: Thresholds
) -> tuple[Classifier, Event | None]:
    depths = [depth for _, depth in memory.window]
    spans = pose.time - memory.window[0][0] >= limits.hold_time - 1e-9
    still = max(depths) - min(depths) < limits.hold_rate * limits.hold_time
    if spans and still and distance < limits.hold_distance:
        return replace(memory, held_depth=pose.depth), Event.HOLD
    return memory, None
