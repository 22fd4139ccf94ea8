"""The view `three_d`: shows the newest picture of the render thread, and turns it by mouse."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np
from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import (
    QCloseEvent,
    QColor,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.imaging.volume import Volume
from app.planning.draft import DraftPlan
from app.planning.error_overlay import Enlargement
from app.planning.needle_overlay import NeedleOverlay
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.scene.compass import draw_compass
from app.views.scene.feed import SceneFeed
from app.views.scene.orbit import Orbit
from app.views.scene.renderer import SceneRenderer
from app.views.scene.robot import RobotShape
from app.views.scene.words import Entry, draw_words

if TYPE_CHECKING:
    from app.imaging.structures.structure import Colour
    from app.views.plan.entry_map import EntryMap
    from app.views.scene.mesh import Mesh
    from app.views.scene.surfaces import Surfaces

DECLARATION: Final[dict[str, Any]] = {
    "view": "three_d",
    "title": "3D view",
    "reads": ("tip_offset_x", "tip_offset_y", "tip_offset_z"),
}

HOME_TURN_PX = (-50.0, 30.0)
"""From the front one first looks a little from the left and from above, for depth."""

ZOOM_PER_PX, ZOOM_PER_NOTCH, NOTCH = 1.01, 1.15, 120

STANDS_MM = 1.0
"""The home view is fitted anew when the robot's base moved more than this in the patient."""


class SceneView(QWidget):
    """Surfaces, robot, needle and plan in 3D.

    Signals:
        maximise_wanted(): double click.
        clicked(object, object): a click that did not turn: point and direction [mm, LPS] of the
            line of sight.
    """

    maximise_wanted = Signal()
    clicked = Signal(object, object)

    def __init__(self, renderer: SceneRenderer, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(120, 90)
        self._home = Orbit.look_from("A", np.zeros(3), 250.0)
        self._feed = SceneFeed(renderer, self._home, self)
        self._feed.arrived.connect(self.update)
        self._body: FloatArray = _box(np.zeros((1, 3)))
        self._robot: FloatArray | None = None
        self.note = self.off = ""
        self.legend: tuple[Entry, ...] = ()
        self._enlargement = Enlargement()
        self._pressed, self._last = QPointF(), QPointF()

    @property
    def orbit(self) -> Orbit:
        """From where one looks."""
        return self._feed.orbit

    @property
    def is_settled(self) -> bool:
        """Whether the picture is the fine one of what there is to be seen."""
        return self._feed.is_settled

    # --- what is shown ------------------------------------------------------------------------
    def set_volume(self, volume: Volume) -> None:
        """Look at another patient; the old surfaces go."""
        corners = volume.lps_mm(np.array([(0, 0, 0), volume.size]) - 0.5)
        self._body, self._robot = _box(corners), None
        self._feed.change("surfaces", lambda stage: stage.set_surfaces(None))
        self._fit_home()
        self.set_orbit(self._home)

    def set_surfaces(self, surfaces: Surfaces | None) -> None:
        """Show skin and bone."""
        self._feed.change("surfaces", lambda stage: stage.set_surfaces(surfaces))
        if surfaces is not None and len(surfaces.skin.points):
            self._body = _box(surfaces.skin.points.astype(np.float64))
            self._fit_home()

    def set_structures(
        self, shown: tuple[tuple[Colour, Mesh], ...], legend: tuple[Entry, ...] = ()
    ) -> None:
        """Show structures as surfaces, each in its colour, and say which is which."""
        self._feed.change("structures", lambda stage: stage.set_structures(shown))
        self.legend = legend
        self.update()

    def set_entry_map(self, shown: EntryMap | None) -> None:
        """Show scored entries on the skin, or none."""
        self._feed.change("entry map", lambda stage: stage.set_entry_map(shown))

    def set_plan(self, draft: DraftPlan) -> None:
        """Show entry, target and path."""
        self._feed.change("plan", lambda stage: stage.set_plan(draft))

    def set_off(self, words: str) -> None:
        """Show nothing but these words, because the exercise does not show this view; empty ends
        that.
        """
        self.off = words
        self._feed.set_paused(bool(words))
        self.update()

    def set_needle(self, needle: NeedleOverlay | None) -> None:
        """Show the needle."""
        scale = self._enlargement.follow(needle.error if needle is not None else None)
        self._feed.change("needle", lambda stage: stage.set_needle(needle, scale))

    def set_robot(self, robot: RobotShape | None, T_patient_world: RigidTransform) -> None:
        """Show the robot, placed under the patient."""
        self._feed.change("robot", lambda stage: stage.set_robot(robot, T_patient_world))
        if robot is None:
            return
        rods = np.array([point for rod in robot.links() for point in rod])
        points = (T_patient_world @ rods) / MILLIMETRE
        if self._robot is None or np.abs(points[:2] - self._robot[:2]).max() > STANDS_MM:
            self._robot = points
            self._fit_home()

    def _fit_home(self) -> None:
        """Let the home view show patient and robot whole; go there, unless one looks elsewhere."""
        was_home = self.orbit is self._home
        points = self._body if self._robot is None else np.vstack([self._body, self._robot])
        front = Orbit.look_from("A", points.mean(axis=0), 1.0).turned(*HOME_TURN_PX)
        self._home = front.fitted(points)
        if was_home:
            self.set_orbit(self._home)

    def _size(self) -> tuple[int, int]:
        return self.width(), self.height()

    def set_orbit(self, orbit: Orbit) -> None:
        """Look from somewhere else."""
        self._feed.turn(orbit)

    def set_note(self, note: str) -> None:
        """Write a line at the bottom, such as the progress of the surfaces."""
        self.note = note
        self.update()

    def picture(self) -> QImage:
        """Return the newest picture."""
        return self._feed.image

    def close_renderer(self) -> None:
        """Stop looking and stop the thread; idempotent."""
        self._feed.close()

    # --- events -------------------------------------------------------------------------------
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the newest picture, stretched while a better one is on its way."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(theme.IMAGE_BACKGROUND))
        if self.off:
            painter.setPen(QColor(theme.IMAGE_DIM))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.rect().adjusted(8, 8, -8, -8), flags, self.off)
            return
        if not self._feed.image.isNull():
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.drawImage(self.rect(), self._feed.image)
        draw_compass(painter, self.orbit, QPointF(50.0, self.height() - 50.0))
        error = self._feed.error and tr("3D view off: {why}", why=self._feed.error)
        scale, note = self._enlargement.scale, error or self.note
        draw_words(painter, self.rect(), scale, self.legend, note)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Ask for a picture of the new size."""
        self._feed.refresh()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin to turn, pan or zoom."""
        self._pressed = self._last = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Left turns, middle pans, right zooms."""
        step = event.position() - self._last
        self._last = event.position()
        buttons = event.buttons()
        if buttons & Qt.MouseButton.LeftButton:
            self.set_orbit(self.orbit.turned(step.x(), step.y()))
        elif buttons & Qt.MouseButton.MiddleButton:
            self.set_orbit(self.orbit.panned(step.x(), step.y(), self._size()))
        elif buttons & Qt.MouseButton.RightButton:
            self.set_orbit(self.orbit.zoomed(ZOOM_PER_PX ** -step.y()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Tell of a click that stayed in place."""
        moved = (event.position() - self._pressed).manhattanLength()
        if event.button() is Qt.MouseButton.LeftButton and moved < 4 and not self.off:
            at = event.position()
            self.clicked.emit(*self.orbit.ray(at.x(), at.y(), self._size()))

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask to be maximised, or restored."""
        self.maximise_wanted.emit()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom."""
        notches = event.angleDelta().y() / NOTCH
        self.set_orbit(self.orbit.zoomed(ZOOM_PER_NOTCH**notches))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Look from A, P, L, R (Shift+R), S or I; r and Space reset."""
        letter = event.text().upper()
        if event.text() == "r" or event.key() == Qt.Key.Key_Space:
            self.set_orbit(self._home)
        elif letter and letter in "APLRSI":
            self.set_orbit(self.orbit.seen_from(letter))
        else:
            super().keyPressEvent(event)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Stop the thread with the pane."""
        self.close_renderer()
        super().closeEvent(event)


def _box(points_mm: FloatArray) -> FloatArray:
    """Eight corners of the box around points, shape (8, 3)."""
    low, high = points_mm.min(axis=0), points_mm.max(axis=0)
    return np.array([np.where(bits, high, low) for bits in np.ndindex(2, 2, 2)])
