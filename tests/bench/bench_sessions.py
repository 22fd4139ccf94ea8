"""A list of 1000 attempts from the files beside their records, beside reading those files alone."""

import shutil
import statistics
import tempfile
import time
from pathlib import Path

from app.session.sidecar import fresh_summary, sidecar
from app.session.store import list_sessions

COUNT, LIMIT_S, RUNS = 1000, 0.3, 7
RECORDS = Path(__file__).resolve().parents[1] / "data" / "records-kept"


def fill(folder: Path) -> None:
    """Copies of one record with the summary beside each, as recording leaves them."""
    source = min(RECORDS.glob("*.mcap"), key=lambda path: path.stat().st_size)
    for number in range(COUNT):
        path = folder / f"{source.stem}-{number:04d}.mcap"
        path.hardlink_to(first) if (first := folder / f"{source.stem}-0000.mcap").exists() else (
            shutil.copy2(source, path)
        )
        if number == 0:
            fresh_summary(path)
        else:
            shutil.copy2(sidecar(first), sidecar(path))


def seconds(work: object) -> float:
    """Time of one call [s]."""
    began = time.perf_counter()
    work()  # type: ignore[operator]
    return time.perf_counter() - began


def main() -> None:
    """Print the median of both, in turn."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        fill(folder)
        ways = {
            "list of sessions": lambda: list_sessions(folder),
            "reading the files alone": lambda: [
                path.read_bytes() for path in sorted(folder.glob("*.json"))
            ],
        }
        assert len(list_sessions(folder)) == COUNT
        times: dict[str, list[float]] = {way: [] for way in ways}
        for _ in range(RUNS):
            for way, work in ways.items():
                times[way].append(seconds(work))
    for way, taken in times.items():
        print(
            f"{way:24} median {statistics.median(taken):.3f} s for {COUNT} "
            f"(min {min(taken):.3f}, max {max(taken):.3f})"
        )
    median = statistics.median(times["list of sessions"])
    print(f"to reach {LIMIT_S:g} s: {'reached' if median <= LIMIT_S else 'NOT reached'}")


if __name__ == "__main__":
    main()
