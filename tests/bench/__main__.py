"""Run every benchmark in its own process: `python -m tests.bench [NAME …]`."""

import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).parent


def names(wanted: list[str]) -> list[str]:
    """Benchmarks of the folder, or those asked for."""
    found = sorted(path.stem.removeprefix("bench_") for path in FOLDER.glob("bench_*.py"))
    if unknown := sorted(set(wanted) - set(found)):
        sys.exit(f"unknown benchmark {', '.join(unknown)}; there are: {', '.join(found)}")
    return wanted or found


def main() -> None:
    """Run them one after the other; end with an error if any of them failed to run."""
    failed = []
    for name in names(sys.argv[1:]):
        print(f"\n=== {name} ===", flush=True)
        code = subprocess.run([sys.executable, "-m", f"tests.bench.bench_{name}"], check=False)
        if code.returncode:
            failed.append(name)
    if failed:
        sys.exit(f"failed: {', '.join(failed)}")


if __name__ == "__main__":
    main()
