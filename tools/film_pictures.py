"""Makes the film strip of a needle that meets a rib, slides, is withdrawn, and passes the pleura.

`python -m tools.film_pictures FOLDER`; part of `make docs-pictures`. Two attempts of the scripted
novice at `lung-between-ribs`: one planned onto a rib, one along the exercise's own path. What is
shown is the plane along the needle, as the window draws it.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final

import numpy as np
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QPainter, QPixmap

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.exercises.parts import PlanPoints
from app.exercises.schema import Exercise
from app.session.snapshot import Snapshot
from app.views.shell.application import start
from tools.palette import small_png
from tools.reading_studio import Studio
from tools.robot_pictures import wait

EXERCISE: Final = "lung-between-ribs"
ONTO_A_RIB: Final = PlanPoints(
    entry_mm=(-111.7, -83.8, 272.9), target_mm=(-77.3, -21.6, 277.7), name="onto a rib"
)
"""13 mm nearer to the head than the exercise's entry: 6 mm of rib, 12 mm below the skin."""

SLID: Final = 0.6e-3
"""Way along the bone after which the needle has slid [m]."""

DRAWN_BACK: Final = 2e-3
"""Way back from the bone after which the needle is withdrawn [m]."""

IN_LUNG: Final = 0.028
"""Depth on the exercise's own path at which the pleura is passed: it lies at 23 mm [m]."""

SIZE: Final = (412, 330)
"""Of a frame [px]; cut from the middle of the pane, a third of it above the skin."""

GAP: Final = 6
STRIP: Final = 3
"""Frames in a row."""


class OtherPlan(Studio):
    """A studio whose exercise has another plan, while it has one."""

    other: PlanPoints | None = None

    def exercise(self, identifier: str) -> Exercise:
        """Return an exercise with the plan that it is to have."""
        exercise = super().exercise(identifier)
        return exercise if self.other is None else exercise.model_copy(update={"plan": self.other})


class Film:
    """A window, and what its needle plane showed."""

    def __init__(self, studio: OtherPlan, frames: list[tuple[str, QPixmap]]) -> None:
        self.studio, self.frames = studio, frames

    def begin(self, plan: PlanPoints | None) -> None:
        """Open the exercise, with another plan if one is given, and begin an attempt."""
        self.studio.other = plan
        self.studio.begin(EXERCISE)
        self.studio.window.workspace.exercise_panel.start_requested.emit("demo")

    def end(self) -> None:
        """End the attempt, and close the window."""
        window = self.studio.window
        window.conductor.controller.abort()
        wait(lambda: not window.conductor.controller.is_running)
        window.editor.saved(None)
        window.close()

    def until(self, reached: Callable[[FloatArray], bool]) -> FloatArray:
        """Let virtual time pass until the loop's state is so; returns it."""

        def look(now: Snapshot) -> bool:
            return now.device is not None and reached(now.device.row)

        self.studio.trainer.go_on(look)
        device = self.studio.trainer.snapshot().device
        if device is None:
            raise RuntimeError("an attempt has a robot")
        return device.row.copy()

    def take(self, caption: str) -> None:
        """Keep what the first needle plane shows, about the needle's tip."""
        self.studio.settle()
        pane = self.studio.window.workspace.needle_panes[0]
        middle = pane.rect().center()
        around = QRect(0, 0, *SIZE)
        around.moveCenter(middle)
        self.frames.append((caption, pane.grab(around)))


def strip(frames: Sequence[tuple[str, QPixmap]]) -> QPixmap:
    """Return the frames in rows, each with its caption below."""
    width, height = SIZE
    high = height + 34
    rows = -(-len(frames) // STRIP)
    sheet = QPixmap(STRIP * (width + GAP) - GAP, rows * (high + GAP) - GAP)
    sheet.fill(QColor("white"))
    painter = QPainter(sheet)
    font = painter.font()
    font.setPixelSize(18)
    painter.setFont(font)
    for number, (caption, frame) in enumerate(frames):
        row, column = divmod(number, STRIP)
        x, y = column * (width + GAP), row * (high + GAP)
        painter.drawPixmap(x, y, frame)
        place = QRect(x, y + height, width, 34)
        painter.drawText(place, Qt.AlignmentFlag.AlignCenter, f"{number + 1}. {caption}")
    painter.end()
    return sheet


def onto_a_rib(film: Film) -> None:
    """Meet the rib, slide along it, and draw back."""
    film.begin(ONTO_A_RIB)
    film.until(lambda row: row[sv.PLANT_DEPTH] > 0.005)
    film.take("Through the skin")
    met = film.until(lambda row: row[sv.BONE_CONTACT] > 0.0)
    film.take(f"A rib, {1e3 * met[sv.PLANT_DEPTH]:.0f} mm deep: it stops")

    def slid(row: FloatArray) -> float:
        return float(np.linalg.norm(row[sv.TIP] - met[sv.TIP]))

    row = film.until(lambda row: row[sv.BONE_CONTACT] > 0.0 and slid(row) > SLID)
    film.take(f"Pushed on, it slides {1e3 * slid(row):.1f} mm along")
    back = met[sv.PLANT_DEPTH] - DRAWN_BACK
    film.until(lambda row: row[sv.BONE_CONTACT] == 0.0 and row[sv.PLANT_DEPTH] < back)
    film.take("Withdrawn")
    film.end()


def between_ribs(film: Film) -> None:
    """Pass the pleura and reach the nodule along the exercise's own path."""
    film.begin(None)
    film.until(lambda row: row[sv.PLANT_DEPTH] > IN_LUNG)
    film.take("Between two ribs, through the pleura")
    film.studio.trainer.go_on(lambda now: now.pose.measured and now.offset.remaining < 3e-3)
    film.take("At the nodule")
    film.end()


def main(folder: Path) -> None:
    """Make the strip."""
    start()
    with tempfile.TemporaryDirectory() as sessions:
        frames: list[tuple[str, QPixmap]] = []
        for scene in (onto_a_rib, between_ribs):
            scene(Film(OtherPlan(folder, Path(sessions), None), frames))
        small_png(strip(frames), folder / "patient-film.png")


if __name__ == "__main__":
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    main(Path(sys.argv[1]))
