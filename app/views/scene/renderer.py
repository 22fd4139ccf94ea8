"""The thread that renders: takes changes and the newest eye, hands out the newest picture."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from app.core.loading import ONE_AT_A_TIME
from app.views.scene.orbit import Orbit

if TYPE_CHECKING:
    from app.views.scene.stage import Stage

Change = Callable[["Stage"], None]

_log = logging.getLogger(__name__)


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
        """Whether every request was answered."""
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
            self.error = str(error) or type(error).__name__
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
