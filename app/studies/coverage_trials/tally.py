"""Sums over many trials, kept as files so that a run that is broken off goes on."""

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, Self

import numpy as np

from app import __version__
from app.core.files import write_atomically
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.planning.registration.check import check_points
from app.planning.registration.plate import load_plate
from app.planning.registration.points import NamedPoints
from app.studies.coverage_trials.deviation import Deviation
from app.tracking.errors import CalibrationError


@dataclass(slots=True)
class CoverageTally:
    """Sums of one quantity's deviations.

    Attributes:
        trials: how many.
        squares, freedom: sums of squared Mahalanobis distances and of their degrees of freedom.
        held: 95 % ellipsoids that hold the truth.
        points, within: how many are points, and 95 % spheres that hold the truth.
        ratios: sum of squared errors over variances, and how many, by parameter.
    """

    trials: int = 0
    squares: float = 0.0
    freedom: int = 0
    held: int = 0
    points: int = 0
    within: int = 0
    ratios: dict[str, list[float]] = field(default_factory=dict)

    def add(self, result: Deviation) -> None:
        """Take in one trial."""
        self.trials += 1
        self.squares += result.square
        self.freedom += result.freedom
        self.held += result.held
        self.points += result.within is not None
        self.within += bool(result.within)
        for name, ratio in result.ratios.items():
            total = self.ratios.setdefault(name, [0.0, 0])
            total[0] += ratio**2
            total[1] += 1

    @property
    def spread(self) -> dict[str, float]:
        """Root mean square of error over standard deviation, by parameter.

        One that is estimated now and then only, where its value seems beyond doubt, is left out:
        it was chosen by its error.
        """
        most = max(count for _, count in self.ratios.values())
        return {
            name: float(np.sqrt(total / count))
            for name, (total, count) in self.ratios.items()
            if 2 * count >= most
        }


@dataclass(slots=True)
class CoverageCell:
    """All quantities of one kind of trial.

    Attributes:
        name: of the kind; of the file as well.
        trial: seed -> deviations by quantity, of the same one at several places where there are.
        done: trials so far; the next one's seed.
        refused: trials that ended with a refusal, which states nothing.
        tallies: by quantity.
    """

    name: str
    trial: Callable[[int], dict[str, tuple[Deviation, ...]]]
    done: int = 0
    refused: int = 0
    tallies: dict[str, CoverageTally] = field(default_factory=dict)

    def run(self, count: int) -> None:
        """Try some more."""
        for seed in range(self.done, self.done + count):
            try:
                found_here = self.trial(seed)
            except CalibrationError:
                self.refused += 1
                continue
            for quantity, each in found_here.items():
                tally = self.tallies.setdefault(quantity, CoverageTally())
                for found in each:
                    tally.add(found)
        self.done += count

    def keep(self, folder: Path) -> None:
        """Write what there is so far.

        Raises:
            OSError: if the file cannot be written.
        """
        tallies = {name: _fields(tally) for name, tally in self.tallies.items()}
        data = {"version": __version__, "done": self.done, "tallies": tallies}
        data["refused"] = self.refused
        write_atomically(self._file(folder), json.dumps(data) + "\n")

    def go_on(self, folder: Path) -> Self:
        """Take in what an earlier run of this version kept; nothing where there is none."""
        try:
            data = json.loads(self._file(folder).read_text(encoding="utf-8"))
            if data["version"] == __version__:
                tallies = {name: CoverageTally(**known) for name, known in data["tallies"].items()}
                self.done, self.refused, self.tallies = int(data["done"]), data["refused"], tallies
        except (OSError, ValueError, KeyError, TypeError):
            pass  # begins anew
        return self

    def _file(self, folder: Path) -> Path:
        return folder / f"{self.name.replace(' ', '').replace('=', '')}.json"


def _fields(tally: CoverageTally) -> dict[str, Any]:
    return {name: getattr(tally, name) for name in CoverageTally.__slots__}


KINDS: Final = {
    "as large in every direction, not stated": ((0.3, 0.3, 0.3), False, 0.0),
    "five times larger in one, not stated": ((0.1, 0.1, 0.5), False, 0.0),
    "as large in every direction, stated": ((0.3, 0.3, 0.3), True, 0.0),
    "five times larger in one, stated": ((0.1, 0.1, 0.5), True, 0.0),
    "all share 0.3 mm, the plate says so": ((0.1, 0.1, 0.1), True, 0.3),
}
"""Standard deviations per axis [mm], whether they come with the points, and what all share [mm]."""

_TARGET: Final = np.array([0.0, 0.01, 0.0])
"""In the plate's frame [m], below its points."""


def touched(kind: str, seed: int) -> dict[str, tuple[Deviation, ...]]:
    """Touch the shipped plate once; the target's deviation."""
    sds, stated, shared = KINDS[kind]
    plate, rng = load_plate("stepped-plate"), np.random.default_rng([seed, len(kind)])
    T = RigidTransform.exp(np.r_[0.1 * rng.normal(size=3), 0.3 * rng.normal(size=3)])
    sd = np.array(sds) * MILLIMETRE
    noise = sd * rng.normal(size=plate.touch.shape) + shared * MILLIMETRE * rng.normal(size=3)
    spread = np.diag(sd**2) if stated else np.zeros((3, 3))
    points = NamedPoints(plate.names, T @ plate.touch + noise, np.tile(spread, (len(noise), 1, 1)))
    check = check_points(plate, plate.touch, points, (shared * MILLIMETRE) ** 2)
    error = check.fit.T_measured_reference @ _TARGET - T @ _TARGET
    names = ("x", "y", "z")
    return {"target": (Deviation.of(error, check.bounded(T @ _TARGET), names, point=True),)}
