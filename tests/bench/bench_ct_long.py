"""1200 slices beside 300 of the same patient: load, memory and surfaces grow no faster than the CT.

Both series are made of the real chest: its slices there and back again, laid on one another at its
own distance, each with a number of its own. Each run is a process of its own, short and long by
turns, so that times and peaks are those of one. Figures to reach: everything of the long series
within 4 × the short one's; the peak of a load rises by 1.0 × the volume (beside what a load of any
size takes).
"""

import copy
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pydicom
from pydicom.uid import generate_uid

ROUNDS = 3
SHORT, LONG = 300, 1200
LIMIT = LONG / SHORT

PROGRAM = """
import json, resource, sys, time
from app.core.progress import Progress
from app.imaging.body import find_body
from app.imaging.reading import load_ct
from app.views.scene.surfaces import extract_surfaces
def peak(): return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
before, start = peak(), time.perf_counter()
volume = load_ct(sys.argv[1])
found = {"load": time.perf_counter() - start, "rise": peak() - before, "bytes": volume.hu.nbytes}
if len(sys.argv) > 2:
    start = time.perf_counter()
    body = find_body(volume)
    found["body"] = time.perf_counter() - start
    start = time.perf_counter()
    extract_surfaces(volume, body, Progress())
    found["surfaces"] = time.perf_counter() - start
print(json.dumps(found))
"""


def main() -> None:
    """Print medians of both, and their ratios."""
    root = Path(__file__).resolve().parents[2]
    data = Path(os.environ.get("ACUS_TEST_DATA") or root.parent / "shared" / "data")
    chest = data / "ct_chest_lidc0314"
    if not chest.is_dir():
        print("needs the real chest in ACUS_TEST_DATA")
        return
    with tempfile.TemporaryDirectory() as folder:
        series = {count: lengthened(chest, Path(folder) / str(count), count)
                  for count in (SHORT, LONG)}  # fmt: skip
        runs: dict[int, list[dict[str, float]]] = {SHORT: [], LONG: []}
        for number in range(ROUNDS):
            for count, path in series.items():
                runs[count].append(_run(path, surfaces=number == 0))
    for what in ("load", "body", "surfaces"):
        seconds = {
            count: float(np.median([run[what] for run in found if what in run]))
            for count, found in runs.items()
        }
        print(
            f"  {what:8s} {SHORT} slices {seconds[SHORT]:.2f} s, {LONG} slices "
            f"{seconds[LONG]:.2f} s = {seconds[LONG] / seconds[SHORT]:.2f} ×; to reach {LIMIT:g} ×"
        )
    for count, found in runs.items():
        rise = np.median([run["rise"] / run["bytes"] for run in found])
        print(f"  memory   {count} slices: the peak rises by {rise:.2f} × the volume")


def lengthened(source: Path, to: Path, count: int) -> Path:
    """Write a series of `count` slices, made of the slices of another, there and back again."""
    to.mkdir()
    files = sorted(
        (pydicom.dcmread(path) for path in source.rglob("*.dcm")),
        key=lambda file: float(file.ImagePositionPatient[2]),
    )
    first, between = files[0], _between(files)
    x, y, z = (float(value) for value in first.ImagePositionPatient)
    series = generate_uid()
    for number in range(count):
        lap, place = divmod(number, len(files))
        file = copy.copy(files[place if lap % 2 == 0 else len(files) - 1 - place])
        file.file_meta = copy.copy(file.file_meta)
        file.SeriesInstanceUID, file.InstanceNumber = series, number + 1
        file.SOPInstanceUID = file.file_meta.MediaStorageSOPInstanceUID = generate_uid()
        file.ImagePositionPatient = [x, y, round(z + number * between, 4)]
        file.save_as(to / f"{number:04d}.dcm")
    return to


def _between(files: list[pydicom.Dataset]) -> float:
    """Distance of two slices [mm]."""
    return float(files[1].ImagePositionPatient[2]) - float(files[0].ImagePositionPatient[2])


def _run(folder: Path, surfaces: bool) -> dict[str, float]:
    root = Path(__file__).resolve().parents[2]
    command = [sys.executable, "-c", PROGRAM, str(folder), *(["surfaces"] if surfaces else [])]
    told = subprocess.run(command, cwd=root, capture_output=True, text=True, check=True).stdout
    found: dict[str, float] = json.loads(told)
    return found


if __name__ == "__main__":
    main()
