"""The marker in pictures as cameras deliver them, by a renderer that shares no code with ours.

Run as `python -m tests.bench.bench_marker_pictures [pairs] [--seed N] [--kind KIND] [--tone linear]
[--delivery q95-444] [--extractor NAME] [--cases FOLDER]`: 1000 pairs by default, some ten minutes
of one core. Every pair goes alone, without history, through the tracker with each extractor.
`--cases` reads pairs with a `truth.json` from a folder instead.
"""

import argparse
import json
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np

from app.core import paths
from app.core.clock import VirtualClock
from app.tracking.cameras.camera import CameraFrame
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.tracker import Tracker
from tests.tracking.camera_fakes import NoCamera
from tests.tracking.camera_pictures import (
    DELIVERIES,
    FULCRUM,
    KINDS,
    TONES,
    CameraPictures,
    PicturePair,
)

OTHERS = (ExtractorName.OUTLINE_CENTROID, ExtractorName.ELLIPSE)
GATE = 16.27
"""0.1 % point of chi-square with three degrees of freedom."""
HELD = 7.815
"""Its 95 % point."""
FAR = 1e-3
"""Error [m] from which on a valid fix is wrong, whatever it states."""


@dataclass
class Tally:
    """What became of the pairs of one kind.

    Attributes:
        errors: of valid fixes [m].
        squares: (error' covariance⁻¹ error) of them.
        refused: how often, by status and reason.
    """

    errors: list[float] = field(default_factory=list)
    squares: list[float] = field(default_factory=list)
    refused: Counter[str] = field(default_factory=Counter)
    seconds: float = 0.0

    @property
    def pairs(self) -> int:
        """Pairs that were looked at."""
        return len(self.errors) + sum(self.refused.values())

    @property
    def valid(self) -> float:
        """Share of valid fixes."""
        return len(self.errors) / max(1, self.pairs)

    @property
    def wrong(self) -> int:
        """Valid fixes that are far off, or far outside what they state."""
        return sum(e > FAR or s > GATE for e, s in zip(self.errors, self.squares, strict=True))

    def add(self, fix: NeedleFix, tip: np.ndarray, seconds: float) -> None:
        """Take in the fix of one pair."""
        self.seconds += seconds
        if fix.status is not FixStatus.VALID:
            self.refused[f"{fix.status.value}: {fix.reason}"] += 1
            return
        error = fix.p_tip_world - tip
        self.errors.append(float(np.linalg.norm(error)))
        self.squares.append(float(error @ np.linalg.solve(fix.covariance, error)))

    def line(self, kind: str) -> str:
        """Write a row of the table."""
        start = f"  {kind:<9} {self.pairs:>5} {self.valid:>7.1%}"
        ms = 1e3 * self.seconds / max(1, self.pairs)
        if not self.errors:
            return f"{start} {'':>53} {ms:6.1f}"
        errors, squares = 1e3 * np.array(self.errors), np.array(self.squares)
        return (
            f"{start} {np.median(errors):8.3f} {np.quantile(errors, 0.98):8.3f} "
            f"{np.mean(errors <= 0.15):8.1%} {np.mean(squares <= HELD):8.1%} "
            f"{np.median(squares):8.2f} {self.wrong:>8} {ms:6.1f}"
        )


HEADER = (
    f"  {'kind':<9} {'pairs':>5} {'valid':>7} {'median':>8} {'98 %':>8} {'<.15 mm':>8} "
    f"{'in 95 %':>8} {'med d²':>8} {'wrong':>8} {'ms':>6}"
)


def fix_of(pair: PicturePair, rig: RigProfile, name: str | None = None) -> tuple[NeedleFix, float]:
    """Look at one pair alone, as the tracker does; the fix, and how long it took [s].

    `name` is another extractor than the rig's.
    """
    tracker = Tracker(
        (NoCamera(), NoCamera()),
        rig,
        VirtualClock(),
        lambda _: pair.axis,
        FULCRUM,
        extractors=extractors(rig, name),
    )
    frames = [CameraFrame(image.copy(), 0.0) for image in (pair.left, pair.right)]
    began = time.perf_counter()
    return tracker.process(*frames), time.perf_counter() - began


def tallied(
    pairs: Iterator[PicturePair], rig: RigProfile, names: tuple[str, ...]
) -> dict[str, dict[str, Tally]]:
    """Look at every pair with each extractor: extractor -> kind -> tally."""
    tallies: dict[str, dict[str, Tally]] = {name: {} for name in names}
    for number, pair in enumerate(pairs):
        for name in names:
            if number == 0:
                fix_of(pair, rig, name)  # compiles, or loads what is compiled
            fix, seconds = fix_of(pair, rig, name)
            tallies[name].setdefault(pair.kind, Tally()).add(fix, pair.tip, seconds)
    return tallies


def cases(folder: Path) -> Iterator[PicturePair]:
    """Pairs of a folder with `truth.json`, as `marker_cases` has it."""
    for one in json.loads((folder / "truth.json").read_text())["pairs"]:
        images = [cv2.imread(str(folder / one[side])) for side in ("left", "right")]
        tip, axis, centre = (np.array(one[k]) for k in ("tip_m", "axis", "marker_centre_m"))
        marker = tuple(
            np.array([one["marker_px"][side]["centre"], *one["marker_px"][side]["ends"]])
            for side in ("left", "right")
        )
        yield PicturePair(one["kind"], one["delivered"], *images, tip, axis, centre, marker)


def show(name: str, kinds: dict[str, Tally]) -> None:
    """Print the table of an extractor and why it refused."""
    print(f"{name}\n{HEADER}")
    whole = Tally()
    for kind, tally in kinds.items():
        print(tally.line(kind))
        whole.errors += tally.errors
        whole.squares += tally.squares
        whole.refused += tally.refused
        whole.seconds += tally.seconds
    print(whole.line("all"))
    for text, count in whole.refused.most_common(6):
        print(f"    {count:>5} {text}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pairs", nargs="?", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rig", default="wide")
    parser.add_argument("--tone", choices=TONES, default="srgb")
    parser.add_argument("--delivery", action="append", help="as q95-444, q80-420 or png")
    parser.add_argument("--kind", choices=KINDS, action="append")
    parser.add_argument("--extractor", action="append", help="instead of the rig's and its peers")
    parser.add_argument("--cases", type=Path, help="a folder of pairs with truth.json")
    chosen = parser.parse_args()
    cv2.setNumThreads(1)
    rig = load_rig(chosen.rig)
    names = tuple(chosen.extractor or (rig.extractor, *(name.value for name in OTHERS)))
    if chosen.cases:
        print(f"pairs of {chosen.cases.name}, rig {rig.name}")
        pairs = cases(chosen.cases)
    else:
        print(f"{chosen.pairs} pairs, seed {chosen.seed}, rig {rig.name}, tone {chosen.tone}")
        kinds = tuple(chosen.kind or KINDS)
        maker = CameraPictures(paths.resources() / "cameras" / f"{rig.name}.yaml", chosen.tone)
        pairs = maker.pairs(chosen.pairs, chosen.seed, kinds, tuple(chosen.delivery or DELIVERIES))
    for name, kinds in tallied(pairs, rig, names).items():
        show(name, kinds)


if __name__ == "__main__":
    main()
