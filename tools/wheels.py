"""Whether every package of the trainer is there as a wheel for other systems; asks the index.

Run as `python -m tools.wheels` (`make wheels`). Nothing is installed. What pip cannot find as a
wheel in the version of `constraints.txt` is printed, and the exit code is 1.
"""

import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[1]
PLATFORMS: Final = ("win_amd64", "macosx_14_0_arm64")
PYTHONS: Final = ("3.11", "3.13")


def missing(platform: str, python: str) -> str:
    """Return what pip says is missing; empty where everything is there."""
    with tempfile.TemporaryDirectory() as target:
        asked = subprocess.run(
            [
                *(sys.executable, "-m", "pip", "install", "--dry-run", "--quiet"),
                *("--disable-pip-version-check", "--ignore-installed", "--target", target),
                *("--platform", platform, "--python-version", python, "--only-binary=:all:"),
                *("--constraint", str(ROOT / "constraints.txt"), f"{ROOT}[trainer]"),
            ],
            capture_output=True,
            text=True,
            check=False,
        )
    errors = [line for line in asked.stderr.splitlines() if line.startswith("ERROR")]
    return "" if asked.returncode == 0 else "\n".join(errors) or asked.stderr[-500:]


def main() -> int:
    """Ask for each system and version of Python, and print the answers."""
    bad = False
    for platform in PLATFORMS:
        for python in PYTHONS:
            lacks = missing(platform, python)
            bad = bad or bool(lacks)
            print(
                f"{platform}, Python {python}: {lacks or 'every package has a wheel'}", flush=True
            )
    return int(bad)


if __name__ == "__main__":
    sys.exit(main())
