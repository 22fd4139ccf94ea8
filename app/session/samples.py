"""The attempt over time as arrays: gathered while it runs, or read back from its record."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, read_only
from app.core.bend import SIZE
from app.session.felt import felt_force
from app.session.sample import Sample, radius_95, spread

SAMPLE_PERIOD: Final = 0.01
"""Samples are kept at most this often [s]: 100 Hz."""


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """The attempt over time at the recorder's rate; n samples, SI, world, read-only.

    Where `valid` is False, tip and depth are NaN; the axis is where the robot measured none. Where
    the robot said nothing or nothing finite, hub, guide and felt are.

    Attributes:
        time: monotonic time [s], shape (n,).
        state: state of the attempt, shape (n,), text.
        valid: whether the pose is valid, shape (n,).
        depth_source: `needle.DepthSource`, shape (n,), text.
        depth: depth of the tip [m], shape (n,).
        tip: tip [m], shape (n, 3).
        axis: needle direction, shape (n, 3).
        target: target with its motion [m], shape (n, 3).
        hub: hub point [m], shape (n, 3).
        guide: the virtual fixture's share of the wanted force [N], shape (n, 3).
        felt: force at the hub point after all limits [N], shape (n, 3), estimated from torques.
        measured: force across the needle that a gauge measured [N], shape (n,); NaN without one.
        radius: round the tip that holds the true one with 95 % [m], shape (n,); NaN where no camera
            vouches for the tip. None in records of versions that did not keep it.
        bend: numbers of `core.bend.Bend`, shape (n, 10), NaN where the needle is straight; None
            where it always is.
        assistance: the dial, -1...1, shape (n,); NaN where the robot said nothing. None where it is
            not known.
        spread: what is unsure of the tip, as `sample.spread` says it, shape (n, 3); NaN where no
            camera vouches for it. None in records of versions that did not keep it.
        clamped: whether the wanted force was at the robot's limit, shape (n,); None where it is not
            known.
        felt_least, felt_most: sizes between which `felt` lies for every depth that the needle can
            have [N], shape (n,); NaN where that is not known. None in records of versions that did
            not keep them; those also said `felt` at the model's depth where no camera vouched for
            one, and called that valid.
        along: force of the tissue along the needle as the loop has it [N], positive where it pushes
            the tip out, shape (n,), NaN where the robot said nothing. Whether a hand feels it is
            another matter. None in records of versions that did not keep it.
    """

    time: FloatArray
    state: NDArray[np.str_]
    valid: NDArray[np.bool_]
    depth_source: NDArray[np.str_]
    depth: FloatArray
    tip: FloatArray
    axis: FloatArray
    target: FloatArray
    hub: FloatArray
    guide: FloatArray
    felt: FloatArray
    measured: FloatArray
    radius: FloatArray | None = None
    bend: FloatArray | None = None
    assistance: FloatArray | None = None
    spread: FloatArray | None = None
    clamped: NDArray[np.bool_] | None = None
    felt_least: FloatArray | None = None
    felt_most: FloatArray | None = None
    along: FloatArray | None = None

    def tip_radius(self) -> float | None:
        """Median radius round the tip that holds the true one with 95 % [m]; None if not known."""
        if self.radius is None or not np.isfinite(self.radius).any():
            return None
        return float(np.nanmedian(self.radius))


class SampleHistory:
    """Samples of a running attempt, at most one per `SAMPLE_PERIOD`."""

    def __init__(self) -> None:
        self._samples: list[Sample] = []

    def add(self, sample: Sample) -> bool:
        """Keep a sample unless it follows too closely; tell whether it was kept."""
        previous = self._samples[-1].time if self._samples else -np.inf
        if sample.time - previous < SAMPLE_PERIOD * (1.0 - 1e-6):
            return False
        self._samples.append(sample)
        return True

    def arrays(self) -> Samples:
        """All samples so far."""
        kept = tuple(self._samples)
        poses = [s.pose if s.pose_valid else None for s in kept]
        felt = [felt_force(s.device, s.pose) if s.device else None for s in kept]
        return Samples(
            time=floats([s.time for s in kept]),
            state=words([s.state.value for s in kept]),
            valid=read_only(np.array([p is not None for p in poses], dtype=np.bool_)),
            depth_source=words([s.pose.depth_source.value for s in kept]),
            depth=floats([p.depth if p else None for p in poses]),
            tip=vectors([xyz(p.p_tip) if p else None for p in poses]),
            axis=vectors([xyz(s.pose.axis) if s.axis_valid else None for s in kept]),
            target=vectors([xyz(s.p_target) for s in kept]),
            hub=vectors([xyz(s.device.hub) if s.device else None for s in kept]),
            guide=vectors([xyz(s.device.guide) if s.device else None for s in kept]),
            felt=vectors([xyz(f.force) if f else None for f in felt]),
            measured=floats([_measured(s) for s in kept]),
            radius=floats([radius_95(s) for s in kept]),
            bend=bends([p.bend.numbers() if p and p.bend else None for p in poses]),
            assistance=floats([s.assistance if s.device else None for s in kept]),
            spread=spreads([spread(s) for s in kept]),
            clamped=flags([s.device is not None and s.device.limit_scale < 1.0 for s in kept]),
            felt_least=known([f.least if f else None for f in felt]),
            felt_most=known([f.most if f else None for f in felt]),
            along=known([s.device.axial_force if s.device else None for s in kept]),
        )


def _measured(sample: Sample) -> float | None:
    device = sample.device
    return device.measured_force if device is not None and device.force_measured else None


def xyz(values: FloatArray) -> dict[str, float]:
    """Three numbers as a mapping, as they stand in JSON."""
    x, y, z = np.asarray(values, dtype=np.float64).tolist()
    return {"x": x, "y": y, "z": z}


def floats(values: Sequence[float | None]) -> FloatArray:
    """Read-only array, shape (n,), NaN for None."""
    return read_only(np.array([np.nan if v is None else v for v in values], dtype=np.float64))


def known(values: Sequence[float | None]) -> FloatArray | None:
    """Read-only array, shape (n,), NaN for None; None if nothing is known."""
    array = floats(values)
    return array if np.isfinite(array).any() else None


def flags(values: Sequence[bool]) -> NDArray[np.bool_]:
    """Read-only array, shape (n,)."""
    return read_only(np.array(values, dtype=np.bool_))


def spreads(values: Sequence[Sequence[float | None] | None]) -> FloatArray | None:
    """Read-only array, shape (n, 3), NaN for None; None if all are."""
    known = [None if v is None or len(v) != 3 else v for v in values]
    if all(v is None for v in known):
        return None
    missing = (None, None, None)
    return read_only(np.array([missing if v is None else v for v in known], dtype=np.float64))


def bends(values: Sequence[ArrayLike | None]) -> FloatArray | None:
    """Read-only array, shape (n, 10), NaN for None; None if all are."""
    if all(v is None for v in values):
        return None
    rows = np.full((len(values), SIZE), np.nan)
    for row, value in zip(rows, values, strict=True):
        if value is not None and np.shape(value) == (SIZE,):
            row[:] = value
    return read_only(rows)


def words(values: Sequence[str]) -> NDArray[np.str_]:
    """Read-only array of text, shape (n,)."""
    return read_only(np.array(values, dtype=np.str_))


def vectors(values: Sequence[Mapping[str, float | None] | None]) -> FloatArray:
    """Read-only array, shape (n, 3), NaN for None."""
    missing: Mapping[str, float | None] = dict.fromkeys("xyz", None)
    rows = [[(v or missing)[key] for key in "xyz"] for v in values]
    array = np.array(
        [[np.nan if x is None or not isfinite(x) else x for x in row] for row in rows],
        dtype=np.float64,
    )
    return read_only(array.reshape(len(rows), 3))
