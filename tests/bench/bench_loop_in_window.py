"""Lateness of the loop beside the real load: scrolling slices, turning 3D view, tracker running.

Ours: the loop of the running exercise. Peer: a Python thread that sleeps to the same deadlines
beside the same load (the loop and the tracker go on).
"""

import threading
from collections.abc import Callable

import numpy as np

from app.core import state_vector as sv
from tests.bench.bench_loop import show, thread_lateness
from tests.bench.window_load import Session, pump

MEDIAN_MS, RATIO = 0.2, 10.0
SECONDS = 10.0


def beside_load(session: Session, work: Callable[[], None]) -> None:
    """Do `work` in a thread while the window is kept busy."""
    timers = session.load()
    thread = threading.Thread(target=work)
    thread.start()
    pump(lambda: not thread.is_alive(), 10 * SECONDS)
    for timer in timers:
        timer.stop()


def main() -> None:
    """Print both distributions and the ratio."""
    session = Session()
    session.open_exercise()
    run = session.window.conductor.controller.run
    assert run is not None
    loop = run.trainer._loop
    pump(lambda: session.window.conductor.settled, 60.0)
    begin = loop.latest().tick
    beside_load(session, lambda: _rest(SECONDS))
    rows = loop.rows(begin)
    missed = int(rows[-1, sv.MISSED] - rows[0, sv.MISSED])
    statistics = run.trainer.snapshot().tracker
    peer: list[tuple[np.ndarray, int]] = []
    beside_load(session, lambda: peer.append(thread_lateness(SECONDS)))
    print(
        f"{'lateness [ms] at 1000 Hz':46}{'median':>9}{'p90':>9}{'p99':>9}{'max':>9}{'missed':>8}"
    )
    ours = show("compiled loop beside the window's load", rows[:, sv.LATENESS], missed)
    theirs = show("Python thread beside the same load", *peer[0])
    print(f"tracker meanwhile: {statistics.rate:.1f} fixes/s, {statistics.valid_share:.0%} valid")
    print(
        f"median {ours:.3f} ms; to reach {MEDIAN_MS} ms: "
        f"{'reached' if ours < MEDIAN_MS else 'NOT reached'}; ratio {theirs / ours:.0f}"
    )
    session.close()


def _rest(seconds: float) -> None:
    threading.Event().wait(seconds)


if __name__ == "__main__":
    main()
