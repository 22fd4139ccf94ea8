"""Five slice views that follow the needle, with the robot's loop running beside them.

Figure to reach: every view shows a new needle at 30 Hz or more. The real window is open at
1400 × 900 with an exercise running (loop at 1000 Hz, cameras, 3D view) in the layout with axial,
sagittal, coronal, in-plane and in-plane 90°. Every look of the window at the trainer (60 Hz) gives
it a needle that has moved by more than a slice and turned beyond the dead band since the last look,
by the way that the measured one comes: status, panels, slices and 3D view.

What counts is a painting that shows another needle in its own slice: the picture is new, or at
least the tip's mark has moved over a picture that belongs to it. Its age is the time since the
needle that it shows was handed to the views. The loop's lateness is that of the same seconds, and
the processor's time that of the window's thread alone.
"""

import os
import time
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QObject

from app.core import state_vector as sv
from app.core.arrays import unit
from app.core.units import MILLIMETRE
from app.session.needle import DepthSource
from app.session.snapshot import Snapshot
from app.views.slices.pane import SlicePane
from tests.bench.window_load import Session, pump

GOAL_HZ, SECONDS = 30.0, float(os.environ.get("ACUS_BENCH_SECONDS", "10"))


class Counter(QObject):
    """Counts the paintings of one pane that show another needle."""

    def __init__(self, pane: SlicePane, hand: "Hand") -> None:
        super().__init__()
        self.times: list[float] = []
        self.ages: list[float] = []
        self._canvas, self._hand = pane.canvas, hand
        self._shown: tuple[object, ...] = ()
        pane.canvas.painted.connect(self.note)

    def note(self) -> None:
        tip = self._canvas.layers.needle.tip
        shown = (id(self._canvas.feed.hu), tip.x(), tip.y())
        if shown != self._shown:
            self._shown = shown
            self.times.append(time.perf_counter())
            self.ages.append(self.times[-1] - self._hand.moved_at)


class Hand:
    """Puts a moving needle in place of the measured one."""

    def __init__(self, session: Session) -> None:
        self._conductor = session.window.conductor
        self._viewing = session.window.workspace.viewing
        self.number, self.moved_at = 0, 0.0
        controller = self._conductor.controller
        controller.snapshot_taken.disconnect(self._conductor.show_snapshot)
        controller.snapshot_taken.connect(self.move)

    def move(self, snapshot: Snapshot) -> None:
        """Go to and fro through the volume and turn."""
        run, volume = self._conductor.controller.run, self._viewing.volume
        assert run is not None
        assert volume is not None
        self.number += 1
        phase = 2.0 * np.pi * self.number / 60.0
        middle = volume.lps_mm((np.array(volume.size) - 1) / 2)
        tip = middle + 25.0 * np.array([np.sin(phase), np.sin(phase + 1.0), np.sin(phase + 2.0)])
        axis = unit([0.4 * np.cos(phase), 0.9, 0.4 * np.sin(0.7 * phase)])
        T_world_patient = run.placed.T_world_patient
        pose = replace(
            snapshot.pose,
            p_tip=T_world_patient @ (tip * MILLIMETRE),
            axis=T_world_patient.rotation @ axis,
            depth_source=DepthSource.TRACKED,
            valid=True,
        )
        self.moved_at = time.perf_counter()
        self._conductor.show_snapshot(replace(snapshot, pose=pose))


def main() -> None:
    """Print the rate of each view and the loop's lateness."""
    session = Session()
    session.open_exercise()
    window = session.window
    pump(lambda: window.conductor.settled, 60.0)
    run = window.conductor.controller.run
    assert run is not None
    loop = run.trainer._loop
    workspace = window.workspace
    workspace.show_bullseye(False)
    workspace.show_layout("6-up")
    workspace.viewing.set_follows_tip(True)
    hand = Hand(session)
    panes = [p for p in (*workspace.panes, *workspace.needle_panes) if p.isVisible()]
    counters = {str(pane.pane): Counter(pane, hand) for pane in panes}
    pump(lambda: False, 2.0)
    begin, start, moved = loop.latest().tick, time.perf_counter(), hand.number
    used = time.thread_time()
    pump(lambda: False, SECONDS)
    used = time.thread_time() - used
    rows, seconds = loop.rows(begin), time.perf_counter() - start
    steps = hand.number - moved
    print(f"needle moved {steps / seconds:.1f} times a second; {len(panes)} slice views, 3D view")
    print(f"window's thread: {1e3 * used / max(steps, 1):.1f} ms of processor time for each move")
    rates = []
    for name, counter in counters.items():
        times = np.array(counter.times)
        inside = (times >= start) & (times <= start + seconds)
        gaps, ages = 1e3 * np.diff(times[inside]), 1e3 * np.array(counter.ages)[inside]
        rates.append(inside.sum() / seconds)
        print(
            f"{name:<14}{rates[-1]:7.1f} Hz   between paintings median {np.median(gaps):6.1f} ms, "
            f"p99 {np.percentile(gaps, 99):6.1f} ms   age of the needle median "
            f"{np.median(ages):5.1f} ms, p99 {np.percentile(ages, 99):5.1f} ms"
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
