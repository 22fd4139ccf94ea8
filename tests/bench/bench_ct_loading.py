"""Folder of CT to ready volume, against SimpleITK's GDCM reader on the same folder.

Each load runs in a fresh process of its own, sides in turn, so that time and peak memory are those
of one load; this process stays small, because a child's peak starts at its parent's.
Figures to reach: time ≤ 0.7 × SimpleITK's; rise of the peak ≤ 1.5 × the volume.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

ROUNDS = 7
TIME_RATIO, MEMORY_RATIO = 0.7, 1.5

_OURS = """
import json, resource, sys, time
from app.imaging.reading import load_ct
def peak(): return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
before, start = peak(), time.perf_counter()
volume = load_ct(sys.argv[1])
took = time.perf_counter() - start
print(json.dumps({"s": took, "rise": peak() - before, "bytes": volume.hu.nbytes}))
"""

_SIMPLEITK = """
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
    phantom = _python("from app.imaging.phantom import *; print(phantom_series(1))")
    folders = {"phantom, 300 slices": Path(phantom.strip())}
    if (chest := data / "ct_chest_lidc0314").is_dir():
        folders["real chest, 275 slices"] = chest
    for name, folder in folders.items():
        _compare(name, folder)


def _compare(name: str, folder: Path) -> None:
    sides: dict[str, list[dict[str, float]]] = {"Acus": [], "SimpleITK": []}
    for _ in range(ROUNDS):
        sides["Acus"].append(_run(_OURS, folder))
        sides["SimpleITK"].append(_run(_SIMPLEITK, folder))
    print(name)
    for side, runs in sides.items():
        seconds = [run["s"] for run in runs]
        rise = np.median([run["rise"] / run["bytes"] for run in runs])
        print(
            f"  {side:10s} median {np.median(seconds):.3f} s, "
            f"p99 {np.percentile(seconds, 99):.3f} s, peak rises by {rise:.2f} × the volume"
        )
    ours, theirs = (np.median([run["s"] for run in runs]) for runs in sides.values())
    print(
        f"  time {ours / theirs:.2f} × SimpleITK (to reach: {TIME_RATIO}); "
        f"memory to reach: {MEMORY_RATIO} ×"
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
