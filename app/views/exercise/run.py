"""What an exercise hands to its views: the trainer and the numbers of its device and plan."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from app.core.arrays import FloatArray
from app.exercises.guidance import GuidancePart
from app.mechanisms.profile import DeviceProfile
from app.planning.placement import PlacedPlan
from app.session.pad.view import PadScene, depth_tolerance, rings
from app.session.shown_views import Shown

if TYPE_CHECKING:
    from app.device.links.link import BoardInfo
    from app.device.readiness import ForceClearance, Readiness
    from app.session.resting import Resting
    from app.session.trainer import Trainer
    from app.tracking.inspection import Inspection


@dataclass(frozen=True, slots=True, eq=False)
class ExerciseRun:
    """A running trainer with what its views must know.

    Attributes:
        trainer: does everything.
        placed: the plan in world.
        profile: of the device.
        interactive: whether the mouse moves a simulated hand, with a real robot its depth alone;
            False for a scripted trainee.
        rings: tolerance rings of the pad [m], from the inside.
        depth_tolerance: how far from the target along the path is still at it [m].
        touched: takes the depth [m] that the cameras measured while the tip touched a known place,
            and the true one; None where no cameras watch a marker.
        learn_colour: takes a camera's name and a pixel of its picture that shows the marker; raises
            an `AcusError` where it cannot be one; None where no cameras watch a marker.
        inspect: newest pictures of the cameras with what was found in them; asked with (masks,
            epipolar curves), each computed only if wanted; None without cameras.
        board: who is at the other end of the wire; None where nobody tells.
        port: where the robot is plugged in; empty in memory.
        clearance: how much force the robot is cleared for and why it is not more; None where
            nobody tells.
        readiness: what was commissioned on it; None where nobody tells.
        velocity: name of the estimator of joint velocities; empty where nobody tells.
        forceful: whether anything can push a hand: False with a pen in place of the robot.
        held_arming: whether the forces are armed only while key, pedal or button is held.
        guidance: control scans as the exercise has them.
        shown: what may be told of the needle.
        demonstrates: whether a scripted expert shows the exercise: it is nobody's attempt.
        touches: whether targets are to be touched with a tool whose handle the hand moves.
        breathes: whether the exercise has a patient who breathes, and something computes it.
        resting: by which simulated robot and cameras rest; None where they never do.
    """

    trainer: Trainer
    placed: PlacedPlan
    profile: DeviceProfile
    interactive: bool = True
    rings: tuple[float, ...] = field(default_factory=rings)
    depth_tolerance: float = field(default_factory=depth_tolerance)
    inspect: Callable[[bool, bool], Inspection] | None = None
    touched: Callable[[float, float], None] | None = None
    learn_colour: Callable[[str, FloatArray], None] | None = None
    board: BoardInfo | None = None
    port: str = ""
    clearance: ForceClearance | None = None
    readiness: Readiness | None = None
    velocity: str = ""
    forceful: bool = True
    held_arming: bool = False
    guidance: GuidancePart = field(default_factory=GuidancePart)
    shown: Shown = field(default_factory=Shown)
    demonstrates: bool = False
    touches: bool = False
    breathes: bool = False
    resting: Resting | None = None

    @property
    def is_real(self) -> bool:
        """Return whether there is a robot that can push a hand."""
        return self.board is not None and not self.board.simulated

    @property
    def held_at_hub(self) -> bool:
        """Return whether a person holds the needle itself, and so its hub: not with mouse, keys or
        stick, nor where it is shown how those do it.
        """
        return self.is_real or not (self.interactive or self.demonstrates)

    def scene(self, aim: PlacedPlan | None = None) -> PadScene:
        """Return the pad of this run; `aim` is the path to the present one of several targets."""
        pad = self.rings, self.depth_tolerance, self.touches
        scene = PadScene.of(aim or self.placed, self.profile, *pad)
        return scene if aim is None else replace(scene, stop_depth=scene.limits.deepest)
