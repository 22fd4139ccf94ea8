"""Folder of CT to ready volume, against SimpleITK's GDCM reader on the same folder.

Each load runs in a fresh process of its own, sides in turn, so that time and peak memory are those
of one load; this process stays small, because a child's peak starts at its parent's. SimpleITK
reads on one thread; Acus reads headers in its worker processes and copies pixels on two threads, so
it needs two free cores to be what it is. "Warm" is Acus as the window has it, whose worker
processes were started behind it; "cold" counts the start of the worker into the load, as a command
does. Figures to reach: time ≤ 0.3 × SimpleITK's warm and ≤ 0.4 cold; rise of the peak ≤ 1.5 × the
volume.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

ROUNDS = 7
LIMITS, MEMORY_RATIO = (0.3, 0.4), 1.5
"""Time warm and cold over SimpleITK's, and rise of the peak over the volume."""

COLD = """
import json, resource, sys, time
from app.imaging.reading import load_ct
def peak(): return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
before, start = peak(), time.perf_counter()
volume = load_ct(sys.argv[1])
took = time.perf_counter() - start
rise = peak() - before
from app.imaging.worker.pool import shared_worker
shared_worker().close()
child = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
print(json.dumps({"s": took, "rise": rise, "bytes": volume.hu.nbytes, "child": child}))
"""

WARM = COLD.replace(
    "before, start",
    """
from app.core.progress import Progress
from app.imaging.worker.pool import shared_worker
from app.imaging.worker.service import read_headers, load_decoders
from pathlib import Path
load_decoders(Progress())
shared_worker().warm(2)
read_headers([Path(sys.argv[1])], Progress())  # the child is up, and has nothing in its cache
before, start""",
    1,
)

PEER = """
import json, resource, sys, time
import SimpleITK
def peak(): return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
before, start = peak(), time.perf_counter()
reader = SimpleITK.ImageSeriesReader()
reader.SetFileNames(reader.GetGDCMSeriesFileNames(sys.argv[1]))
image = reader.Execute()
took = time.perf_counter() - start
print(json.dumps({"s": took, "rise": peak() - before, "bytes": 2 * image.GetNumberOfPixels()}))
"""


def main() -> None:
    """Print medians, p99 and ratios for the phantom and the real chest."""
    root = Path(__file__).resolve().parents[2]
    data = Path(os.environ.get("ACUS_TEST_DATA") or root.parent / "shared" / "data")
    phantom = _python(
        "from app.imaging.phantom.series import phantom_series; print(phantom_series(1))"
    )
    folders = {"phantom, 300 slices": Path(phantom.strip())}
    if (chest := data / "ct_chest_lidc0314").is_dir():
        folders["real chest, 275 slices"] = chest
    for name, folder in folders.items():
        compare(name, folder)


def compare(
    name: str, folder: Path, limits: tuple[float, float] = LIMITS, rounds: int = ROUNDS
) -> None:
    """Load a folder by turns and print medians and ratios."""
    programs = {"Acus, warm": WARM, "Acus, cold": COLD, "SimpleITK": PEER}
    sides: dict[str, list[dict[str, float]]] = {side: [] for side in programs}
    for _ in range(rounds):
        for side, program in programs.items():
            sides[side].append(_run(program, folder))
    print(name)
    theirs = np.median([run["s"] for run in sides["SimpleITK"]])
    for side, runs in sides.items():
        seconds = [run["s"] for run in runs]
        rise = np.median([run["rise"] / run["bytes"] for run in runs])
        child = np.median([run.get("child", 0.0) for run in runs]) / 1e6
        print(
            f"  {side:10s} median {np.median(seconds):.3f} s = {np.median(seconds) / theirs:.2f} × "
            f"SimpleITK, p99 {np.percentile(seconds, 99):.3f} s, peak rises by {rise:.2f} × the "
            f"volume" + (f", worker's peak {child:.0f} MB" if child else "")
        )
    print(
        f"  to reach: {limits[0]} × the time warm, {limits[1]} × cold, {MEMORY_RATIO} × the volume"
    )


def _run(program: str, folder: Path) -> dict[str, float]:
    result: dict[str, float] = json.loads(_python(program, str(folder)))
    return result


def _python(program: str, *arguments: str) -> str:
    command = [sys.executable, "-c", program, *arguments]
    root = Path(__file__).resolve().parents[2]
    return subprocess.run(command, cwd=root, capture_output=True, text=True, check=True).stdout


if __name__ == "__main__":
    main()
