"""`acus demo --device arm`: the simulated arm carries out an exercise's plan, in the window."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from app.core.errors import AcusError
from app.core.messages import sentence
from app.exercises.schema import Exercise

if TYPE_CHECKING:
    from PySide6.QtCore import SignalInstance

    from app.arm.features.arm import ArmFeature
    from app.session.snapshot import Snapshot
    from app.views.shell.demonstration import FeatureOf, StillPictures

DECLARATION: Final[dict[str, Any]] = {
    "title": "A simulated arm carries out the plan",
    "help": "a simulated arm carries out the plan; it never drives a real one.",
    "about": (
        "With --device arm a simulated arm carries out the exercise's plan: it finds its tool by"
        " the pictures of two cameras, grasps it, brings it to the entry and inserts it. Without a"
        " display its own scene is shown first: pictures of what it sees and does there, with a"
        " report. It is a simulation only and never drives a real arm. Ends with code 3 if the"
        " tool is not inserted; says why."
    ),
}


MIDDLE, LATEST, HOLD_PICTURE_S = 0.5, 0.9, 1.0
"""Share of a phase of the arm at which it is pictured, and at which without a fix of the cameras
too; after so long where it holds still [s]."""


def prepare(exercise: Exercise, simulated: bool, tell: Callable[[str], None]) -> None:
    """Refuse what the arm cannot show, say what it is, and import its packages.

    A missing one is named before a window opens for nothing.

    Args:
        exercise: that is shown.
        simulated: whether simulated cameras look at a robot.
        tell: is told a line.

    Raises:
        AcusError: if targets are touched in the exercise, cameras or a pen are real or in its
            place, or MuJoCo, OMPL or Ruckig is not installed.
    """
    if exercise.touch is not None:
        raise AcusError(
            sentence(
                "in {exercise_id} targets are touched, and the arm inserts along a path: name "
                "another exercise, or leave out --device arm",
                exercise_id=exercise.id,
            )
        )
    if not simulated:
        raise AcusError(
            sentence(
                "the arm works before its own simulated cameras; leave out --pen and --cameras"
            )
        )
    from app.arm.motion.searching import import_ompl
    from app.arm.motion.timing import import_ruckig
    from app.arm.run import SIMULATION_ONLY
    from app.simulation.mjcf import import_mujoco

    tell(SIMULATION_ONLY)
    import_mujoco("arm")
    import_ompl()
    import_ruckig()


def alone(seed: int, folder: Path, tell: Callable[[str], None]) -> str:
    """Show the arm's own scene: pictures and a report in a folder; return why it failed."""
    from app.arm.run import demonstrate

    shown = demonstrate(seed, folder, tell)
    if shown.failure is None:
        return ""
    return f"the tool was not inserted ({shown.failure}): {shown.message}"


def leader(feature: FeatureOf) -> ArmLeader:
    """Return what leads the window through the arm's attempt."""
    from app.arm.features.arm import ArmFeature

    return ArmLeader(feature(ArmFeature))


class ArmLeader:
    """Presses what a user would press, and takes a picture in the middle of each phase.

    Attributes:
        words: what it does first.
    """

    words: Final = "the arm works out its way"

    def __init__(self, arm: ArmFeature) -> None:
        self._arm, self._phase = arm, ""

    @property
    def failed(self) -> SignalInstance:
        """Emitted with why the arm cannot do it."""
        return self._arm.failed

    def begin(self) -> None:
        """Ask for the arm."""
        self._arm.watch()

    def follow(
        self,
        waited: float,
        snapshot: Snapshot | None,
        pictures: StillPictures,
        tell: Callable[[str], None],
    ) -> bool:
        """Take a picture in the middle of each phase; the arm ends its attempt itself."""
        from app.arm.views.play import PlayState
        from app.views.shell.demonstration import has_fresh_fix

        bar, play = self._arm.bar, self._arm.play
        if bar.offer.isVisible():
            tell(bar.words.text())
            bar.offer.click()
            return True
        if play is None:
            return False
        if play.state in (PlayState.FETCHING, PlayState.INSERTING, PlayState.HOLDING):
            phase = "hold" if play.state is PlayState.HOLDING else play.phase
            if phase != self._phase:
                self._phase = phase
                tell(bar.words.text())
            held = play.state is PlayState.HOLDING and waited >= HOLD_PICTURE_S
            fresh = snapshot is not None and snapshot.pose.measured and has_fresh_fix(snapshot)
            clear = fresh or phase != "insert" or play.share >= LATEST
            if held or (phase != "hold" and clear and play.share >= MIDDLE):
                pictures.take(f"arm-{phase}")
        return play.state is not PlayState.HOLDING
