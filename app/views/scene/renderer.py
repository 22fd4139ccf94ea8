"""The thread that renders the 3D view, and when it is asked: coarsely while the view is turned."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QWidget

from app.core.loading import ONE_AT_A_TIME
from app.views.kit.text import tr, translated
from app.views.scene.orbit import Orbit

if TYPE_CHECKING:
    from app.views.scene.stage import Stage

Change = Callable[["Stage"], None]

_log = logging.getLogger(__name__)

POLL_MS = 25
SETTLE_S = 0.3
"""How long the view must not be turned before it is drawn fine."""

MOVING_S, LEAST_SIZE = 0.08, 0.4
"""What a picture may take while the view is turned, and how small it is made for that at most, as
a share of the pane's width and height."""

STIRRED_SIZE = 0.7
"""How small it is made at most where something in it moves: that is looked at, not turned away."""

SHORTEST_PAUSE_S, SHARE = 0.1, 0.25
"""Fine pictures come at most this often, and take at most this share of the time."""


@dataclass(frozen=True, slots=True, eq=False)
class Shot:
    """What to render: from where, how large, and whether quickly."""

    orbit: Orbit
    size_px: tuple[int, int]
    moving: bool


class SceneRenderer:
    """Owns the stage's thread. Requests neither wait nor queue up: the newest wins.

    Attributes:
        error: why no pictures come, one line; empty while all is well.
        seconds: what the newest fine picture took [s].
        moving_seconds: what the newest one of a turn took [s].
        driver: what draws, in the driver's own words; empty before the first picture.
        has_volume: whether it renders volumes in good time.
    """

    def __init__(self) -> None:
        self.error = ""
        self.seconds = self.moving_seconds = 0.0
        self.driver, self.has_volume = "", False
        self._changes: dict[str, Change] = {}
        self._shot: Shot | None = None
        self._picture: NDArray[np.uint8] | None = None
        self._busy = False
        self._closing = False
        self._wake = threading.Condition()
        self._thread: threading.Thread | None = None

    def open(self) -> None:
        """Start the thread; idempotent."""
        if self._thread is None:
            self._closing = False
            self._thread = threading.Thread(target=self._run, name="acus-scene", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Stop the thread and free the graphics; idempotent."""
        with self._wake:
            self._closing = True
            self._wake.notify_all()
        if self._thread is not None:
            self._thread.join(5.0)
            self._thread = None

    def change(self, kind: str, change: Change) -> None:
        """Have `change(stage)` called before the next picture; the newest of a kind wins."""
        with self._wake:
            self._changes[kind] = change

    def request(self, shot: Shot) -> None:
        """Ask for a picture; replaces a request that is still waiting."""
        with self._wake:
            self._shot = shot
            self._wake.notify_all()

    def take(self) -> NDArray[np.uint8] | None:
        """Return the newest picture not yet taken, RGBA, shape (height, width, 4)."""
        with self._wake:
            picture, self._picture = self._picture, None
            return picture

    @property
    def idle(self) -> bool:
        """Return whether every request was answered."""
        with self._wake:
            return not self._busy and self._shot is None

    def wait(self, timeout: float) -> bool:
        """Wait up to `timeout` [s] until idle; for pictures made by commands."""
        with self._wake:
            return self._wake.wait_for(lambda: not self._busy and self._shot is None, timeout)

    def _run(self) -> None:
        stage: Stage | None = None
        try:
            while (work := self._next()) is not None:
                if stage is None:  # only now: the window comes before VTK
                    stage = _new_stage()
                    stage.open()
                    self.driver, self.has_volume = stage.driver, stage.has_volume
                self._work(stage, *work)
        except Exception as error:  # the slices go on without the 3D view; the pane says why
            _log.warning("3D view stopped", exc_info=error)
            self.error = translated(error) or type(error).__name__
        finally:
            if stage is not None:
                stage.close()
            with self._wake:
                self._busy, self._shot = False, None
                self._wake.notify_all()

    def _next(self) -> tuple[list[Change], Shot] | None:
        with self._wake:
            self._busy = False
            self._wake.notify_all()
            self._wake.wait_for(lambda: self._closing or self._shot is not None)
            if self._closing or self._shot is None:
                return None
            work = list(self._changes.values()), self._shot
            self._changes, self._shot, self._busy = {}, None, True
            return work

    def _work(self, stage: Stage, changes: list[Any], shot: Shot) -> None:
        for change in changes:
            change(stage)
        start = monotonic()
        picture = stage.render(shot.orbit, shot.size_px, shot.moving)
        with self._wake:
            self._picture = picture
            if shot.moving:
                self.moving_seconds = monotonic() - start
            else:
                self.seconds = monotonic() - start


def _new_stage() -> Stage:
    with ONE_AT_A_TIME:
        from app.views.scene.stage import Stage
    return Stage()


class SceneFeed(QObject):
    """Gets the pictures of one widget from the render thread.

    Attributes:
        orbit: from where the pictures are taken.
        image: the newest picture.

    Signals:
        arrived(): there is a newer picture.
    """

    arrived = Signal()

    def __init__(self, renderer: SceneRenderer, orbit: Orbit, pane: QWidget) -> None:
        super().__init__(pane)
        self._renderer, self._pane = renderer, pane
        self.orbit, self.image = orbit, QImage()
        self._turned_at = self._fine_at = -SETTLE_S
        self._fine = self._pending = self._paused = self._still = False
        self._moving_size, self._least = 1.0, LEAST_SIZE
        self._timer = QTimer(self, interval=POLL_MS)
        self._timer.timeout.connect(self._poll)
        renderer.open()

    @property
    def error(self) -> str:
        """Return why no pictures come, one line; empty while all is well."""
        return self._renderer.error

    @property
    def why_no_volume(self) -> str:
        """Say why the volume cannot be rendered here; empty where it can."""
        renderer = self._renderer
        if renderer.has_volume:
            return ""
        return tr(
            "Volume rendering needs a graphics card; here {driver} draws.",
            driver=renderer.driver or tr("nothing yet"),
        )

    def set_paused(self, paused: bool) -> None:
        """Ask for no pictures while nobody may see them."""
        self._paused = paused
        self.refresh()

    def set_still(self, still: bool) -> None:
        """Leave the picture as it is, unless the user turns or changes it, or draw all again."""
        self._still = still
        self.refresh()

    @property
    def is_settled(self) -> bool:
        """Return whether the picture is the fine one of what there is to be seen."""
        if self._paused or self._still:
            return True
        return self._fine and not self._pending and self._renderer.idle

    def change(self, kind: str, change: Change, asked: bool = False) -> None:
        """Change what is seen; the newest of a kind wins.

        `asked`: by the user, so that it is drawn where the picture stands still too.
        """
        self._renderer.change(kind, change)
        if asked and self._still:
            self._turned_at = monotonic()
        self.refresh()

    def turn(self, orbit: Orbit) -> None:
        """Look from somewhere else."""
        self.orbit, self._turned_at, self._least = orbit, monotonic(), LEAST_SIZE
        self.refresh()

    def stir(self) -> None:
        """Draw a little coarsely for a while: something moves that is to be seen moving."""
        if self._still:
            return
        self._turned_at, self._least = monotonic(), STIRRED_SIZE

    def refresh(self) -> None:
        """Ask for another picture, as after a change of the size."""
        self._pending = True
        self.look()

    def look(self) -> None:
        """Look for pictures from now on, if anybody may see them: the pane has come to the front,
        or something has changed.
        """
        if self._pane.isVisible() and not self._timer.isActive():
            self._timer.start()

    def close(self) -> None:
        """Stop looking and stop the thread; idempotent."""
        self._timer.stop()
        self._renderer.close()

    def _poll(self) -> None:
        picture = self._renderer.take()
        if picture is not None:
            height, width, _ = picture.shape
            borrowed = QImage(picture.data, width, height, QImage.Format.Format_RGBX8888)
            self.image = borrowed.convertToFormat(QImage.Format.Format_RGB32)
            self.arrived.emit()
        if not self._renderer.idle:
            return
        now = monotonic()
        turns = now - self._turned_at < SETTLE_S
        nothing = self._paused or (self._still and not turns)
        if nothing or not self._pane.isVisible() or (self._fine and not self._pending):
            if picture is None:
                self._timer.stop()  # until something changes, or the pane is shown
            return
        if turns:
            if self._pending:
                self._request(moving=True)
                self._fine = False
        elif (self._pending or not self._fine) and now - self._fine_at >= self._pause():
            self._request(moving=False)
            self._fine, self._fine_at = True, now

    def _pause(self) -> float:
        """Shortest time between fine pictures [s]: a live needle must not take a whole core."""
        return max(SHORTEST_PAUSE_S, self._renderer.seconds / SHARE)

    def _request(self, moving: bool) -> None:
        ratio, pane = self._pane.devicePixelRatioF(), self._pane
        if moving:
            seconds = self._renderer.moving_seconds
            self._moving_size = max(self._least, moving_size(self._moving_size, seconds))
            ratio *= self._moving_size
        size = (max(1, int(pane.width() * ratio)), max(1, int(pane.height() * ratio)))
        self._pending = False
        self._renderer.request(Shot(self.orbit, size, moving))


def moving_size(size: float, seconds: float) -> float:
    """Size of the next picture of a turn, as a share of the pane's width and height.

    A picture's time falls with its pixels, the square of the size; the next one is to take
    `MOVING_S`. It grows by a tenth at most, so that it does not flicker.

    Args:
        size: of the last one.
        seconds: that the last one took; 0 before the first.
    """
    wanted = size * (MOVING_S / seconds) ** 0.5 if seconds > 0.0 else size
    return min(1.0, max(LEAST_SIZE, min(wanted, 1.1 * size)))
