"""A panel with the angles of both rings, beside that of the robot."""

from typing import Any, ClassVar, Final

from acus_gimbal.views.ring_dial import RingDial
from app.session.snapshot import Snapshot
from app.views.kit.text import tr
from app.views.shell.feature import Context, Feature

DECLARATION: Final[dict[str, Any]] = {"title": "Angles of the rings", "after": "robot"}


class RingsFeature(Feature):
    """Follows the needle."""

    topic: ClassVar[str] = "rings"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.panel = RingDial()
        context.shell.add_panel(self.panel, tr("Rings"))
        context.conductor.controller.snapshot_taken.connect(self._show)

    def forget(self) -> None:
        """Say nothing of a patient who leaves."""
        self.panel.clear()

    def _show(self, snapshot: Snapshot) -> None:
        if snapshot.pose is not None:
            self.panel.show_axis(snapshot.pose.axis)


FEATURE: Final = RingsFeature
