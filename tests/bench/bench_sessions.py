"""A list of 1000 attempts from the files beside their records, beside reading those files alone."""

import shutil
import tempfile
from pathlib import Path

from app.session.sidecar import fresh_summary, sidecar
from app.session.store import list_sessions
from tests.bench.in_turn import compare

COUNT, LIMIT_S, RUNS = 1000, 0.3, 7
RECORDS = Path(__file__).resolve().parents[1] / "data" / "records"


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


def main() -> None:
    """Print the times of both."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        fill(folder)
        assert len(list_sessions(folder)) == COUNT
        ways = {
            f"list of {COUNT} sessions": lambda: list_sessions(folder),
            "reading the files alone": lambda: [
                path.read_bytes() for path in sorted(folder.glob("*.json"))
            ],
        }
        compare(ways, RUNS, LIMIT_S)


if __name__ == "__main__":
    main()
