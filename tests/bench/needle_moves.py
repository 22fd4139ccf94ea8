"""One side of `bench_follow`: what a needle that moves costs the window's thread of one tree.

Run by its path, with the tree to measure as `PYTHONPATH`; prints one line of JSON. The window is
open at 1400 × 900 with an exercise running (loop, simulated cameras, tracker, 3D view) in the
layout of five slice views. Every look at the trainer shows a needle that has moved by more than a
slice. A state counts as painted in a pane when the picture and the tip's mark that the pane ends
painting belong to it; its age is the end of that painting minus the time at which the state was
handed over.
"""

import importlib
import json
import os
import sys
import time
from collections import defaultdict
from dataclasses import replace
from typing import Any

import numpy as np
from PySide6.QtCore import QEvent, QEventLoop, QObject, QTimer

from app.core import state_vector as sv
from app.core.arrays import unit
from app.core.units import MILLIMETRE
from app.session.needle import DepthSource
from tests.bench.window_load import Session, pump

PARTS = {
    "planes": ("app.views.slices.planes:Planes.lay", "app.views.slices.viewing:Planes.lay"),
    "placing": (
        "app.views.slices.layer_stack:LayerStack.place",
        "app.views.slices.layers:LayerStack.place",
    ),
    "words": ("app.views.slices.canvas:SliceCanvas._write",),
    "painting": (
        "pyqtgraph:GraphicsView.paintEvent",
        "app.views.slices.canvas:SliceCanvas.paintEvent",
    ),
    "panels": ("app.views.exercise.controller:ExerciseDisplay.show",),
}
"""Functions whose processor time is told apart; those that a tree does not have are left out."""


def stay(seconds: float) -> None:
    """Let Qt work for a while, as it does in the program: it sleeps only until there is more."""
    loop = QEventLoop()
    QTimer.singleShot(round(1e3 * seconds), loop.quit)
    loop.exec()


class Parts:
    """Processor time of the window's thread in named functions, less what other named ones took."""

    def __init__(self) -> None:
        self.used: dict[str, float] = defaultdict(float)
        self._inner = [0.0]
        for part, places in PARTS.items():
            for place in places:
                self._watch(part, place)

    def _watch(self, part: str, place: str) -> None:
        module, _, path = place.partition(":")
        owner_name, _, name = path.partition(".")
        try:
            owner = getattr(importlib.import_module(module), owner_name)
            function = owner.__dict__[name]
        except (ImportError, AttributeError, KeyError):
            return

        def timed(*args: Any, **options: Any) -> Any:
            start = time.thread_time()
            self._inner.append(0.0)
            try:
                return function(*args, **options)
            finally:
                whole = time.thread_time() - start
                self.used[part] += whole - self._inner.pop()
                self._inner[-1] += whole

        setattr(owner, name, timed)


class Painted(QObject):
    """Counts the states of the needle that one pane has painted completely."""

    def __init__(self, pane: Any, hand: "Hand") -> None:
        super().__init__()
        self.times: list[float] = []
        self.ages: list[float] = []
        self._canvas, self._hand, self._shown = pane.canvas, hand, ()
        if hasattr(pane.canvas, "painted"):
            pane.canvas.painted.connect(self._note)
        else:
            pane.canvas.viewport().installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Paint:
            self._note()
        return False

    def _note(self) -> None:
        tip = self._canvas.layers.needle.tip
        shown = (id(self._canvas.feed.hu), tip.x(), tip.y())
        if shown != self._shown:
            self._shown = shown
            self.times.append(time.perf_counter())
            self.ages.append(self.times[-1] - self._hand.moved_at)


class Hand:
    """Puts a moving needle in place of the measured one."""

    def __init__(self, session: Any) -> None:
        self._conductor = session.window.conductor
        self._viewing = session.window.workspace.viewing
        self.number, self.moved_at = 0, 0.0
        controller = self._conductor.controller
        controller.snapshot_taken.disconnect(self._conductor.show_snapshot)
        controller.snapshot_taken.connect(self.move)

    def move(self, snapshot: Any) -> None:
        """Go to and fro through the volume and turn."""
        run, volume = self._conductor.controller.run, self._viewing.volume
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
    """Measure the tree that `PYTHONPATH` names."""
    seconds, period = float(sys.argv[1]), int(sys.argv[2])
    parts = Parts() if os.environ.get("ACUS_BENCH_PARTS") else None
    session = Session()
    session.open_exercise()
    window = session.window
    pump(lambda: window.conductor.settled, 60.0)
    controller = window.conductor.controller
    if period:
        controller._timer.setInterval(period)
    loop, workspace = controller.run.trainer._loop, window.workspace
    workspace.show_bullseye(False)
    workspace.show_layout("6-up")
    workspace.viewing.set_follows_tip(True)
    hand = Hand(session)
    panes = [p for p in (*workspace.panes, *workspace.needle_panes) if p.isVisible()]
    painted = {str(pane.pane): Painted(pane, hand) for pane in panes}
    stay(3.0)
    if parts is not None:
        parts.used.clear()
    begin, start, moved = loop.latest().tick, time.perf_counter(), hand.number
    used = time.thread_time()
    stay(seconds)
    used = time.thread_time() - used
    rows, took = loop.rows(begin), time.perf_counter() - start
    moves = hand.number - moved
    found: dict[str, Any] = {"hz": moves / took, "ms_per_move": 1e3 * used / max(moves, 1)}
    found["late_p99_ms"] = float(np.percentile(1e3 * rows[:, sv.LATENESS], 99))
    found["missed"] = int(rows[-1, sv.MISSED] - rows[0, sv.MISSED])
    found["panes"] = {}
    for name, one in painted.items():
        times = np.array(one.times)
        inside = (times >= start) & (times <= start + took)
        ages, gaps = 1e3 * np.array(one.ages)[inside], 1e3 * np.diff(times[inside])
        found["panes"][name] = {
            "hz": int(inside.sum()) / took,
            "age_ms": np.percentile(ages, (50, 99)).tolist(),
            "gap_ms": np.percentile(gaps, (50, 99)).tolist(),
        }
    if parts is not None:
        found["parts"] = {part: 1e3 * s / max(moves, 1) for part, s in parts.used.items()}
    print("FOUND " + json.dumps(found), flush=True)
    session.close()


if __name__ == "__main__":
    main()
