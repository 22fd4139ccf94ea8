"""What the window costs while nobody does anything: share of one core, by the process's own time.

The real window on a display (a virtual one by `tools/with-display`), VTK, the built-in patient, the
simulated robot and cameras of an exercise by mouse. Each state is left alone until it rests, then
its time of computing is counted for a while: of the process, all its threads and its children. The
clock of the wall only divides, so a busy machine makes the shares smaller, never larger: its load
is printed beside them.

`python -m tests.bench.bench_idle threads` also prints which threads computed.
"""

import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEventLoop, QTimer

from app.compose.desktop import Desktop
from app.session.result import AttemptResult
from app.views.shell.collector import collect_for
from tests.bench.window_load import Session, pump

SECONDS, RESTS_AFTER = 15.0, 14.0
"""Each state is measured for so long, and left alone for so long before [s]."""

GOALS = {"start page over a loaded exercise": 2.0, "an ended attempt": 3.0, "debrief": 2.0}
"""Largest share of one core [%]."""

TICK = os.sysconf("SC_CLK_TCK")


def stat(path: Path) -> tuple[str, int, float]:
    """Name, parent and time of computing [s] of a process or thread."""
    name, rest = path.read_text().rsplit(")", 1)
    fields = rest.split()
    return name.split("(", 1)[1], int(fields[1]), (int(fields[11]) + int(fields[12])) / TICK


def children(parent: int) -> float:
    """Time of computing of everything that a process has started and that still runs [s]."""
    spent = 0.0
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            _, above, own = stat(folder / "stat")
        except (OSError, ValueError):  # ended meanwhile
            continue
        if above == parent:
            spent += own + children(int(folder.name))
    return spent


def threads() -> dict[str, float]:
    """Time of computing of each thread [s], by number and name."""
    found = {}
    for folder in Path("/proc/self/task").iterdir():
        try:
            name, _, spent = stat(folder / "stat")
        except OSError:
            continue
        found[f"{folder.name} {name}"] = spent
    return found


def rest(seconds: float) -> None:
    """Let Qt work as it does for a user: nothing of ours is computed meanwhile."""
    loop = QEventLoop()
    QTimer.singleShot(round(1e3 * seconds), loop.quit)
    loop.exec()


def share(name: str, tell: bool) -> float:
    """Print and return the share of one core that a state costs [%]."""
    rest(RESTS_AFTER)
    own, others, wall = time.process_time(), children(os.getpid()), time.monotonic()
    each = threads()
    rest(SECONDS)
    wall = time.monotonic() - wall
    own, others = time.process_time() - own, children(os.getpid()) - others
    cost = 100.0 * (own + others) / wall
    goal = GOALS.get(name)
    verdict = ""
    if goal is not None:
        verdict = f"; to reach {goal:g} %: {'reached' if cost <= goal else 'NOT reached'}"
    print(
        f"{name:36} {cost:6.2f} % of a core in {wall:.1f} s (children "
        f"{100.0 * others / wall:.2f} %; load {os.getloadavg()[0]:.1f}){verdict}",
        flush=True,
    )
    if tell:
        spent = {key: now - each.get(key, 0.0) for key, now in threads().items()}
        for key, seconds in sorted(spent.items(), key=lambda item: -item[1])[:8]:
            print(f"    {key:30} {100.0 * seconds / wall:6.2f} %")
    return cost


def attempt(session: Session) -> AttemptResult:
    """Begin an attempt, do nothing in it, end it; returns its result."""
    controller, results = session.window.conductor.controller, []
    controller.finished.connect(results.append)
    controller.begin("idle")
    if not pump(lambda: controller.is_running, 10.0):
        raise SystemExit("no attempt began")
    pump(bool, 3.0)
    controller.end()
    if not pump(lambda: bool(results), 60.0):
        raise SystemExit("the attempt did not end")
    return results[0]


def main(tell: bool = False) -> None:
    """Print the share of each state."""
    with tempfile.TemporaryDirectory() as folder:
        session = Session(Desktop(seed=1, sessions=Path(folder)), offscreen=False)
        window = session.window
        collect_for(window)
        pump(lambda: window.runs.is_prepared, 300.0)
        states: dict[str, Callable[[], object]] = {
            "start page": window.show_start,
            "workspace, before an attempt": session.open_exercise,
            "start page over a loaded exercise": window.show_start,
        }
        for name, show in states.items():
            show()
            if window.conductor.patient is not None:
                pump(lambda: window.conductor.settled, 120.0)
            share(name, tell)
        window.show_workspace()
        result = attempt(session)
        rest(2.0)
        window.show_workspace()
        share("an ended attempt", tell)
        window.show_result(result)
        share("debrief", tell)
        window.show_start()
        share("start page over an ended attempt", tell)
        session.close()


if __name__ == "__main__":
    main("threads" in sys.argv[1:])
