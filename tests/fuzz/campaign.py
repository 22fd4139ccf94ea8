"""Mutated files through the readers: a named error or something right, and never anything else."""

import random
import resource
import shutil
import signal
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType

from app.core.errors import AcusError
from app.imaging.worker.pool import shared_worker
from tests.fuzz.kinds import Kind, kinds
from tests.fuzz.mutations import mutate
from tests.fuzz.seeds import bomb
from tests.fuzz.watch import Watch

MOST_SECONDS = 2.0
"""Processor time that no file may cost, of the program and its children together [s]."""

HANGS_SECONDS = 60
"""Time on the clock after which a file counts as one that is never read [s]."""

MOST_CHILD_BYTES = 3 << 30
_LOST = "the process that read it "
_SLOWEST = 5


@dataclass
class Tally:
    """What came of the mutated files.

    Attributes:
        outcomes: how often which.
        lost: what happened to each child that was lost, and at which file.
        slow: processor time, time on the clock and name of the files that cost most.
        waited_s: longest time on the clock.
        child_bytes: most memory that a child ever had.
        own_bytes: most memory that the program ever had.
        wrong: description of each that broke the rule.
    """

    outcomes: Counter[str] = field(default_factory=Counter)
    lost: list[str] = field(default_factory=list)
    slow: list[tuple[float, float, str]] = field(default_factory=list)
    waited_s: float = 0.0
    child_bytes: int = 0
    own_bytes: int = 0
    wrong: list[str] = field(default_factory=list)

    def timed(self, processor_s: float, waited_s: float, name: str) -> None:
        """Take up what a file cost."""
        self.waited_s = max(self.waited_s, waited_s)
        self.slow = sorted([*self.slow, (processor_s, waited_s, name)], reverse=True)[:_SLOWEST]
        if processor_s > MOST_SECONDS:
            self.wrong.append(f"{name}: {processor_s:.2f} s of processor time")

    def add(self, other: "Tally") -> None:
        """Take up what came of other files."""
        self.outcomes += other.outcomes
        self.lost += other.lost
        self.slow = sorted([*self.slow, *other.slow], reverse=True)[:_SLOWEST]
        self.waited_s = max(self.waited_s, other.waited_s)
        self.child_bytes = max(self.child_bytes, other.child_bytes)
        self.own_bytes = max(self.own_bytes, other.own_bytes)
        self.wrong += other.wrong


def campaign(
    folder: Path,
    count: int,
    seed: int,
    numbers: range | None = None,
    tell: Callable[[int], None] | None = None,
) -> Tally:
    """Read mutated files of every kind in turn.

    Args:
        folder: empty, for the files.
        count: how many.
        seed: of everything random; with its number it makes a file again.
        numbers: which of them; all if left out.
        tell: told how many are done.
    """
    (folder / "made").mkdir(parents=True)
    (folder / "temporary").mkdir()
    before, tempfile.tempdir = tempfile.tempdir, str(folder / "temporary")
    try:
        known = list(kinds(folder / "made"))
        _warm(folder / "case", known)
        with Watch() as watch:
            tally = Tally()
            for done, number in enumerate(numbers or range(count), 1):
                _one(folder / "case", known[number % len(known)], number, seed, tally, watch)
                if tell is not None:
                    tell(done)
            shared_worker().close()
            tally.child_bytes = watch.most_bytes
        tally.own_bytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss << 10
        return tally
    finally:
        tempfile.tempdir = before


def _warm(folder: Path, known: list[Kind]) -> None:
    """Read every kind unspoilt: it must be right, and its packages are loaded then."""
    for kind in known:
        _lay(folder, kind, kind.content)
        if wrong := kind.read(folder):
            raise AssertionError(f"{kind.name}, unspoilt: {wrong}")


def _lay(folder: Path, kind: Kind, data: bytes) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    kind.lay(folder, data)


@contextmanager
def _in_time() -> Iterator[None]:
    """Interrupt what takes for ever, so that the file is named instead of waited for."""

    def late(number: int, frame: FrameType | None) -> None:
        raise TimeoutError(f"not read after {HANGS_SECONDS} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(HANGS_SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def _one(folder: Path, kind: Kind, number: int, seed: int, tally: Tally, watch: Watch) -> None:
    dice = random.Random(f"{seed} {number}")
    data, how = mutate(kind.content, dice, kind.text)
    if kind.name == "deflated" and number % 50 == 3:
        data, how = bomb(kind.content), "bomb"
    name = f"{number} ({kind.name}: {how})"
    _lay(folder, kind, data)
    watch.begin()
    begin = time.monotonic()
    try:
        with _in_time():
            wrong = kind.read(folder)
    except AcusError as error:
        outcome, wrong = type(error).__name__, "" if str(error) else "an error without words"
        if _LOST in str(error):
            tally.lost.append(f"{name}: {str(error).split(_LOST)[1]}")
    except Exception as error:
        outcome, wrong = "wrong", f"{type(error).__name__}: {error}"
    else:
        outcome = "right"
    tally.timed(watch.end(), time.monotonic() - begin, name)
    tally.outcomes["wrong" if wrong else outcome] += 1
    if wrong:
        tally.wrong.append(f"{name}: {wrong}")
