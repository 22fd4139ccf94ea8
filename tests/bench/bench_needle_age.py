"""How many states of the loop every pane paints whole, and how old the needle is that one sees.

Figures to reach on a quiet machine: ≥ 60 states a second in every slice pane and the bull's-eye,
the needle ≤ 20 ms old (median); with one core kept busy by another program ≥ 30 and ≤ 50 ms.

The real window is open at 1400 × 900 with five slice panes, first with the 3D view as the sixth,
then with the bull's-eye; an exercise is running with loop, simulated cameras and tracker, and the
slices follow the tip. For 30 s the simulated hand goes to and fro and turns; nothing else is put in
anybody's place: what is drawn is what cameras and encoders measured. A state counts once for each
pane: when the pane ends a painting whose needle is another one than before, over the picture that
was made for it. Its age is that moment minus the time of the loop's tick in the snapshot drawn.

`ACUS_BENCH_SECONDS` shortens it. The first argument `alone` or `busy` does one of both only.
"""

import os
import subprocess
import sys
import time
from math import pi, sin
from typing import Any

import numpy as np
from PySide6.QtCore import QObject

from app.core import state_vector as sv
from app.planning.needle_overlay import NeedleOverlay
from app.session.snapshot import Snapshot
from app.views.exercise.pad_canvas import PadCanvas
from app.views.slices.pane import SlicePane
from tests.bench.needle_moves import stay
from tests.bench.window_load import Session, pump

SECONDS = float(os.environ.get("ACUS_BENCH_SECONDS", "30"))
GOALS = {"alone": (60.0, 20.0), "busy": (30.0, 50.0)}
"""States a second, and age of the needle [ms], by what else the machine does."""

TILT, TILT_HZ, DEPTH, DEPTH_HZ = 0.06, 0.40, 0.012, 0.47
"""How far [rad, m] and how often the hand goes to and fro: at up to some 40 mm/s."""

PADDED: list[Any] = []
"""Called when a pad has been painted."""


def _tell_paintings() -> None:
    paint = PadCanvas.paintEvent

    def painted(self: PadCanvas, event: Any) -> None:
        paint(self, event)
        for told in PADDED:
            told(self)

    PadCanvas.paintEvent = painted  # type: ignore[method-assign]


class Painted:
    """When one pane had painted a state, and how old that was."""

    def __init__(self, hand: "Hand") -> None:
        self._hand = hand
        self._last: object = None
        self.times: list[float] = []
        self.ages: list[float] = []

    def note(self, shown: object, tick_time: float | None) -> None:
        """Count what is shown if it is new."""
        if tick_time is not None and shown is not self._last:
            self._last = shown
            self.times.append(time.monotonic())
            self.ages.append(self.times[-1] - tick_time)


class SlicePaintings(QObject):
    """Counts in a slice pane."""

    def __init__(self, pane: SlicePane, hand: "Hand", counter: Painted) -> None:
        super().__init__()
        self._canvas, self._hand, self._counter = pane.canvas, hand, counter
        pane.canvas.painted.connect(self.note)

    def note(self) -> None:
        feed, needle = self._canvas.feed, self._canvas.layers.needle.shown
        if feed.is_waiting and not feed.is_near:
            return  # over a picture that is late
        self._counter.note(needle, self._hand.time_of(needle))


class Hand:
    """Moves the simulated hand at every look, and remembers which tick each needle shows."""

    def __init__(self, session: Session) -> None:
        self._conductor = session.window.conductor
        self._viewing = session.window.workspace.viewing
        self.looks, self.tick_time = 0, 0.0
        self._needles: dict[int, tuple[NeedleOverlay, float]] = {}
        controller = self._conductor.controller
        self._start = controller.run.trainer.snapshot().pose
        self._begin = time.monotonic()
        follow = self._viewing.follow_needle

        def noted(needle: NeedleOverlay) -> None:
            self._needles[id(needle)] = needle, self.tick_time  # kept: no other has its number
            follow(needle)

        self._viewing.follow_needle = noted
        controller.snapshot_taken.disconnect(self._conductor.show_snapshot)
        controller.snapshot_taken.connect(self.show)

    def time_of(self, needle: NeedleOverlay | None) -> float | None:
        """Time of the tick that a needle shows."""
        known = self._needles.get(id(needle))
        return None if known is None else known[1]

    def show(self, snapshot: Snapshot) -> None:
        """Show a look at the trainer, and go on."""
        if snapshot.device is not None:
            self.looks, self.tick_time = self.looks + 1, snapshot.device.time
        self._conductor.show_snapshot(snapshot)
        phase = 2.0 * pi * (time.monotonic() - self._begin)
        x, y, _ = self._start.axis.tolist()
        self._conductor.controller.run.trainer.hand(
            x + TILT * sin(TILT_HZ * phase),
            y + TILT * sin(TILT_HZ * phase + 1.0),
            self._start.depth + DEPTH * sin(DEPTH_HZ * phase),
        )


def measure(
    session: Session, hand: Hand, counters: dict[str, Painted], name: str, sixth: str
) -> None:
    """Count in the panes that are seen for a while, and print."""
    loop = session.window.conductor.controller.run.trainer._loop
    begin, start, looks = loop.latest().tick, time.monotonic(), hand.looks
    used = time.thread_time()
    stay(SECONDS)
    used, took = time.thread_time() - used, time.monotonic() - start
    late = 1e3 * loop.rows(begin)[:, sv.LATENESS]
    looks = hand.looks - looks
    print(
        f"{name}, with the {sixth}: {looks / took:.1f} looks a second, "
        f"{1e3 * used / max(looks, 1):.2f} ms of the window's thread each; "
        f"loop late median {np.median(late):.3f} ms, p99 {np.percentile(late, 99):.3f} ms"
    )
    rates, ages = [], []
    for pane, counter in counters.items():
        if not counter.times or counter.times[-1] < start:
            print(f"  {pane:<14}not seen")
            continue
        times = np.array(counter.times)
        inside = (times >= start) & (times <= start + took)
        found = 1e3 * np.array(counter.ages)[inside]
        rates.append(inside.sum() / took)
        ages.append(float(np.median(found)) if len(found) else np.inf)
        worst = np.percentile(found, 99) if len(found) else np.inf
        print(f"  {pane:<14}{rates[-1]:6.1f} states/s   age median {ages[-1]:5.1f} ms, "
              f"p99 {worst:5.1f} ms")  # fmt: skip
    hz, age = GOALS[name]
    good = min(rates) >= hz and max(ages) <= age
    print(f"  to reach {hz:g}/s and {age:g} ms: {'' if good else 'NOT '}reached", flush=True)


def main() -> None:
    """Measure alone, then beside a program that keeps one core busy."""
    wanted = sys.argv[1:] or list(GOALS)
    _tell_paintings()
    session = Session()
    session.open_exercise()
    window = session.window
    pump(lambda: window.conductor.settled, 60.0)
    workspace = window.workspace
    workspace.show_bullseye(False)
    workspace.show_layout("6-up")
    workspace.viewing.set_follows_tip(True)
    hand = Hand(session)
    counters = {}
    kept = []
    for pane in (*workspace.panes, *workspace.needle_panes):
        if pane.isVisible():
            counters[str(pane.pane)] = Painted(hand)
            kept.append(SlicePaintings(pane, hand, counters[str(pane.pane)]))
    pad = counters["bull's-eye"] = Painted(hand)
    PADDED.append(lambda canvas: pad.note(canvas._view, hand.tick_time))
    for name in wanted:
        other = None
        if name == "busy":
            other = subprocess.Popen([sys.executable, "-c", "while True: pass"])
        try:
            for sixth in ("3D view", "bull's-eye"):
                workspace.show_bullseye(sixth == "bull's-eye")
                stay(4.0)
                measure(session, hand, counters, name, sixth)
        finally:
            if other is not None:
                other.kill()
                other.wait()
    session.close()


if __name__ == "__main__":
    main()
