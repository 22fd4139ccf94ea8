"""Memory of the window while ten patients are opened one after another, with surfaces and panes.

The real window on a display, the built-in patients of seeds 1 to 10, each until its surfaces stand
and with every slice pane scrolled through: what a patient needs is given back with the next one.
Resident memory of the process and of its children is printed after each.
"""

import tempfile
from pathlib import Path

from app.compose.desktop import Desktop
from app.views.shell.collector import collect_for
from app.views.slices.panes import MPR_PANES
from tests.bench.bench_idle import rest
from tests.bench.window_load import Session, pump

COUNT, GOAL_GB = 10, 1.2


def resident(process: str = "self") -> float:
    """Resident memory of a process [GB]."""
    words = Path(f"/proc/{process}/status").read_text()
    return int(words.split("VmRSS:")[1].split()[0]) / 2**20


def children() -> float:
    """Resident memory of all processes that this one has started [GB]."""
    total = 0.0
    for path in Path("/proc/self/task").glob("*/children"):
        for number in path.read_text().split():
            total += resident(number)
    return total


def shows(session: Session, seed: int) -> bool:
    """Whether the built-in patient of a seed is shown."""
    patient = session.window.conductor.patient
    return patient is not None and patient.phantom_seed == seed


def main() -> None:
    """Print the memory after each patient."""
    with tempfile.TemporaryDirectory() as folder:
        session = Session(Desktop(seed=1, sessions=Path(folder)), offscreen=False)
        window = session.window
        collector = collect_for(window)
        window.open_ct.may_replace = lambda: True
        pump(lambda: window.runs.is_prepared, 300.0)
        print(f"start page   {resident():.2f} GB + children {children():.2f} GB", flush=True)
        most = 0.0
        for seed in range(1, COUNT + 1):
            window.open_ct.open_phantom(seed)
            pump(lambda seed=seed: shows(session, seed), 300.0)
            pump(lambda: not window.conductor._surfaces.is_running, 300.0)
            pump(lambda: window.workspace.scene.is_settled, 20.0)
            for pane in MPR_PANES:
                for index in range(20, 120, 20):
                    window.workspace.viewing.show_slice(pane, index)
                    rest(0.05)
            pump(lambda: not collector.waits, 60.0)
            most = max(most, resident())
            print(
                f"patient {seed:4} {resident():.2f} GB + children {children():.2f} GB", flush=True
            )
        verdict = "reached" if most <= GOAL_GB else "NOT reached"
        print(f"most {most:.2f} GB; to reach {GOAL_GB:g} GB: {verdict}")
        session.close()


if __name__ == "__main__":
    main()
