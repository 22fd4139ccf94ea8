"""Three stations with 800 attempts each, gathered at a fourth: 30 s to reach.

Run as `make bench BENCH=stations`. Records are copies of one small record, signed by each station,
with remarks on every tenth; the course limits attempts, so that limits are held over all of them.
"""

import shutil
import sys
import tempfile
from pathlib import Path
from time import perf_counter

import pytest

from app.session.gathering import gather_file
from app.session.index import Index
from app.session.results_file import write_course, write_results

sys.path.append(str(Path(__file__).resolve().parents[1] / "session"))  # its fakes

from school_stations import SchoolStation, headed, pool

STATIONS, ATTEMPTS, LIMIT_S = 3, 800, 30.0


def filled(root: Path, name: str, patch: pytest.MonkeyPatch, course: Path) -> SchoolStation:
    """Return a station with its attempts."""
    station = SchoolStation(root / name, name, patch)
    station.enter()
    gather_file(course, station.folder, trust=True)
    for number in range(ATTEMPTS):
        station.record(list(pool()[1])[number % 3])
    people = station.enter()
    people.remark_all(
        [f"2026-{name}-{number:04d}" for number in range(1, ATTEMPTS, 10)], comment="well done"
    )
    return station


def main() -> None:
    """Print how long each part takes."""
    patch = pytest.MonkeyPatch()
    with tempfile.TemporaryDirectory() as name:
        root = Path(name)
        head = headed(root / "head", patch)
        write_course(root / "course", head.folder)
        some = [filled(root, name, patch, root / "course") for name in "ABC"[:STATIONS]]
        size = sum(path.stat().st_size for path in some[0].folder.glob("*.mcap")) / ATTEMPTS
        print(f"records of {size / 1e3:.0f} kB")
        for one in some:
            one.enter()
            start = perf_counter()
            write_results(root / one.name / "results", one.folder)
            print(f"results of {one.name} written {perf_counter() - start:18.2f} s")
        head.enter()
        whole = perf_counter()
        for one in some:
            start = perf_counter()
            done = gather_file(root / one.name / "results", head.folder, trust=True)
            assert done.attempts == ATTEMPTS
            print(f"results of {one.name} gathered {perf_counter() - start:17.2f} s")
        total = perf_counter() - whole
        print(f"{STATIONS} x {ATTEMPTS} attempts gathered {total:14.2f} s, {LIMIT_S:.0f} to reach")
        start = perf_counter()
        Index(head.folder).refresh()
        print(f"first list after it {perf_counter() - start:22.2f} s")
        shutil.rmtree(pool()[0])
    patch.undo()


if __name__ == "__main__":
    main()
