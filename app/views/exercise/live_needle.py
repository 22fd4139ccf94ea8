"""The view `live_overlay`: the live needle on the slices; and needle and robot in 3D."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.exercises.parts import View
from app.planning.needle_overlay import NeedleOverlay
from app.session.snapshot import Snapshot
from app.views.exercise.run import ExerciseRun
from app.views.reading.workspace import WorkspacePage
from app.views.scene.robot import RobotShape

DECLARATION: Final[dict[str, Any]] = {
    "view": "live_overlay",
    "title": "Needle on the slices",
    "reads": ("tip_offset_x", "tip_offset_y", "tip_offset_z"),
}

SCENE_DEAD_BAND_MM = 0.25
"""The 3D picture is made anew when the needle moved more than this."""


class LiveNeedle:
    """Draws needle and robot where a snapshot says they are."""

    def __init__(self, workspace: WorkspacePage) -> None:
        self._workspace = workspace
        self._drawn: FloatArray | None = None
        self._hidden = False

    def forget(self) -> None:
        """Draw everything anew at the next snapshot: another run, or another plan."""
        self._drawn, self._hidden = None, False

    def show(self, run: ExerciseRun, snapshot: Snapshot) -> None:
        """Draw a moment; nothing where the run tells nothing of its needle."""
        if not run.shown.live:
            if not self._hidden:
                self.hide()
            return
        self._hidden = False
        pose, transform = snapshot.pose, run.placed.T_world_patient
        length = run.profile.geometry.needle_length
        # Without a measured depth only the line is known: it ends at the entry, grey.
        p_end = pose.p_tip if pose.measured else run.placed.p_entry
        spread = pose.covariance if pose.measured else None
        bent = pose.curve if pose.measured and pose.bend is not None and pose.depth > 0.0 else None
        needle = NeedleOverlay.of_world(
            p_end, pose.axis, length, transform, pose.measured, spread, bent
        )
        viewing = self._workspace.viewing
        if run.shown.shows(View.LIVE_OVERLAY):
            viewing.follow_needle(needle)
        else:
            viewing.set_needle(None)
        if not run.shown.shows(View.THREE_D):
            return
        ends = needle.points_mm
        if self._drawn is None or _apart(self._drawn, ends):
            self._drawn = ends
            self._workspace.scene.set_needle(needle)
            q = None if snapshot.device is None else snapshot.device.q
            robot = RobotShape.of(run.profile.pantograph, q)
            self._workspace.scene.set_robot(robot, transform.inverse())

    def hide(self) -> None:
        """Take the needle, and the robot, whose arms point along it, out of every view."""
        self._drawn, self._hidden = None, True
        self._workspace.viewing.set_needle(None)
        self._workspace.scene.set_needle(None)
        self._workspace.scene.set_robot(None, RigidTransform.identity())


def _apart(one: FloatArray, other: FloatArray) -> bool:
    """Whether two drawn shafts differ enough for another picture."""
    return one.shape != other.shape or bool(np.abs(one - other).max() > SCENE_DEAD_BAND_MM)
