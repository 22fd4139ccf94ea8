"""Five slice views that follow the needle, with the robot's loop running beside them.

Figure to reach: every view shows new pictures at 30 Hz or more. The real window is open at
1400 × 900 with an exercise running (loop at 1000 Hz, cameras, 3D view at its own pace) in the
layout with axial, sagittal, coronal, in-plane and in-plane 90°; the needle moves by more than a
slice and turns beyond the dead band with every step, so that all five have something new each time.
What counts is a new picture that was painted. The loop's lateness is that of the same seconds.
"""

import time

import numpy as np
from PySide6.QtCore import QTimer

from app.core import state_vector as sv
from app.core.arrays import unit
from app.views.needle_overlay import NeedleOverlay
from app.views.slices.items import ImageItem
from tests.bench.window_load import Session, pump

GOAL_HZ, SECONDS, STEP_MS = 30.0, 10.0, 20


class Counter:
    """Counts the pictures of one pane that reach the screen."""

    def __init__(self, item: ImageItem) -> None:
        self.times: list[float] = []
        self._item, self._image = item, item.image
        item.image = self._count  # type: ignore[method-assign]

    def _count(self) -> object:
        if self._item._stale is not None:
            self.times.append(time.perf_counter())
        return self._image()


def needle(middle: np.ndarray, number: int) -> NeedleOverlay:
    """Go to and fro through the volume and turn."""
    phase = 2.0 * np.pi * number / 60.0
    tip = middle + 25.0 * np.array([np.sin(phase), np.sin(phase + 1.0), np.sin(phase + 2.0)])
    axis = unit([0.4 * np.cos(phase), 0.9, 0.4 * np.sin(0.7 * phase)])
    return NeedleOverlay(tip - 150.0 * axis, tip)


def main() -> None:
    """Print the rate of each view and the loop's lateness."""
    session = Session()
    session.open_exercise()
    window = session.window
    pump(lambda: window.conductor.settled, 60.0)
    run = window.conductor.controller.run
    assert run is not None
    loop = run.trainer._loop
    window.conductor.controller.snapshot_taken.disconnect(window.conductor.show_snapshot)
    workspace, viewing = window.workspace, window.workspace.viewing
    workspace.show_bullseye(False)
    workspace.show_layout("6-up")
    viewing.set_follows_tip(True)
    panes = [p for p in (*workspace.panes, *workspace.needle_panes) if p.isVisible()]
    counters = {str(pane.pane): Counter(pane.canvas._image) for pane in panes}
    assert viewing.volume is not None
    middle, number = viewing.volume.lps_mm((np.array(viewing.volume.size) - 1) / 2), 0

    def move() -> None:
        nonlocal number
        number += 1
        viewing.set_needle(needle(middle, number))

    timer = QTimer(interval=STEP_MS)
    timer.timeout.connect(move)
    timer.start()
    pump(lambda: False, 2.0)
    begin, start, moved = loop.latest().tick, time.perf_counter(), number
    pump(lambda: False, SECONDS)
    rows, seconds = loop.rows(begin), time.perf_counter() - start
    steps = number - moved
    timer.stop()
    print(f"needle moved {steps / seconds:.1f} times a second; {len(panes)} slice views, 3D view")
    rates = []
    for name, counter in counters.items():
        times = np.array([t for t in counter.times if start <= t <= start + seconds])
        gaps = 1e3 * np.diff(times)
        rates.append(len(times) / seconds)
        print(
            f"{name:<14}{rates[-1]:7.1f} Hz   between pictures median {np.median(gaps):6.1f} ms   "
            f"p99 {np.percentile(gaps, 99):6.1f} ms"
        )
    reached = "reached" if min(rates) >= GOAL_HZ else "NOT reached"
    print(f"slowest view {min(rates):.1f} Hz; to reach {GOAL_HZ:g} Hz: {reached}")
    late = 1e3 * rows[:, sv.LATENESS]
    missed = int(rows[-1, sv.MISSED] - rows[0, sv.MISSED])
    print(
        f"loop meanwhile: lateness median {np.median(late):.3f} ms, "
        f"p99 {np.percentile(late, 99):.3f} ms, {missed} ticks missed of {len(rows)}"
    )
    session.close()


if __name__ == "__main__":
    main()
