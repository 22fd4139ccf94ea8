"""Mutated files through the reader: a named error or a right volume, and never anything else."""

import random
import resource
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from app.core.errors import AcusError
from app.core.progress import Progress
from app.imaging.reading import choose, read_series
from app.imaging.scanning import scan_folder
from app.imaging.worker import process
from tests.fuzz.mutations import mutate
from tests.fuzz.seeds import MIDDLE, OFFSETS, Seed, bomb, seeds

MOST_SECONDS = 2.0
_LOST = "the process that read it "
MOST_CHILD_BYTES = 3 << 30


@dataclass
class Tally:
    """What came of the mutated files.

    Attributes:
        outcomes: how often which.
        slowest_s: longest time that one took, with the processor's time of all that read it.
        lost: children that a file crashed or hung.
        child_bytes: most memory that a child ever had.
        wrong: description of each that broke the rule.
    """

    outcomes: Counter[str] = field(default_factory=Counter)
    slowest_s: float = 0.0
    lost: int = 0
    child_bytes: int = 0
    wrong: list[str] = field(default_factory=list)


def campaign(folder: Path, count: int, seed: int, progress: Progress | None = None) -> Tally:
    """Read `count` series of three files, the middle one mutated.

    Args:
        folder: empty, for the files.
        count: series.
        seed: of everything random.
        progress: told how far it is.
    """
    progress = progress or Progress()
    (folder / "made").mkdir()
    known = list(seeds(folder / "made"))
    dice, tally = random.Random(seed), Tally()
    watch = _Watch(tally)
    _one(folder / "warm", known[0], known[0].files[MIDDLE], "unspoilt", Tally())
    try:
        for number in range(count):
            chosen = known[number % len(known)]
            data, how = mutate(chosen.files[MIDDLE], dice)
            if chosen.name == "deflated" and number % 450 == 3:
                data, how = bomb(chosen.files[MIDDLE]), "bomb"
            _one(folder / "case", chosen, data, f"{number} ({chosen.name}: {how})", tally)
            progress.report((number + 1) / count, f"{number + 1} of {count}")
    finally:
        watch.close()
    return tally


def _one(folder: Path, seed: Seed, data: bytes, name: str, tally: Tally) -> None:
    folder.mkdir(exist_ok=True)
    for k, content in enumerate(seed.files):
        (folder / f"s{k}").write_bytes(data if k == MIDDLE else content)
    begin = time.monotonic()
    try:
        listing = scan_folder(folder)
        for ignored in listing.ignored:
            if _LOST in ignored.reason:
                tally.outcomes[f"lost at {name}: {ignored.reason.split(_LOST)[1]}"] += 1
        volume = read_series(choose(listing))
    except AcusError as error:
        tally.outcomes[type(error).__name__] += 1
        if not str(error):
            tally.wrong.append(f"{name}: an error without words")
    except Exception as error:
        tally.wrong.append(f"{name}: {type(error).__name__}: {error}")
    else:
        tally.outcomes["volume"] += 1
        if wrong := _wrong(volume, seed):
            tally.wrong.append(f"{name}: {wrong}")
    tally.slowest_s = max(tally.slowest_s, time.monotonic() - begin)


def _wrong(volume, seed: Seed) -> str:
    """What is wrong with a volume: the whole files keep their values and their places in it."""
    if not (np.isfinite(volume.affine_mm).all() and np.isfinite(volume.hu).all()):
        return "not finite"
    if volume.size[:2] != seed.hu.shape[:0:-1]:
        return f"size {volume.size}"
    for k in (0, len(OFFSETS) - 1):
        ends = {0: 0, len(OFFSETS) - 1: volume.size[2] - 1}
        if not np.array_equal(volume.hu[ends[k]], seed.hu[k]):
            return f"slice {k} has other values"
        place = volume.lps_mm((0, 0, ends[k]))
        if abs(place[2] - (-100.0 + OFFSETS[k])) > 0.01:
            return f"slice {k} lies at {place}"
    return ""


class _Watch:
    """Looks at every child before it ends."""

    def __init__(self, tally: Tally) -> None:
        self._tally, self._close = tally, process.Child.close
        watch = self

        def close(child: process.Child) -> None:
            watch.look(child)
            tally.lost += bool(child.open)
            watch._close(child)

        process.Child.close = close

    def look(self, child: process.Child) -> None:
        try:
            status = Path(f"/proc/{child._process.pid}/status").read_text()
        except OSError:
            return
        for line in status.splitlines():
            if line.startswith("VmHWM"):
                most = int(line.split()[1]) << 10
                self._tally.child_bytes = max(self._tally.child_bytes, most)

    def close(self) -> None:
        from app.imaging.worker.pool import shared_worker

        shared_worker().close()
        process.Child.close = self._close
        used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss << 10
        self._tally.outcomes["(peak of the program, MB)"] = used >> 20
