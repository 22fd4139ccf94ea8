"""How much memory a volume needs, how much there is, and how far it must be reduced to fit."""

import weakref
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import psutil
from numpy.typing import NDArray

from app.core.messages import sentence
from app.imaging.header import SliceHeader
from app.imaging.rescaling import integral

SHARE = 0.7
"""Of the memory that is available a volume and what is made of it may take this much."""

WORKING_COPIES = 1.5
"""Memory at work for each byte of a volume: itself, and body, masks and surfaces of it."""

_held: dict[int, int] = {}

_GROUPS = (
    (Path("/sys/fs/cgroup"), "memory.max", "memory.current", "inactive_file"),
    (
        Path("/sys/fs/cgroup/memory"),
        "memory.limit_in_bytes",
        "memory.usage_in_bytes",
        "total_inactive_file",
    ),
)


@dataclass(frozen=True, slots=True)
class Need:
    """What a volume needs.

    Attributes:
        bytes: with working copies, at full size.
        available: what the machine can give now; None where it does not say.
        open: what the volumes that are open take beside that, and give back when they are closed.
        factors: voxels to take together along i, j, k so that it fits; (1, 1, 1) if it does.
    """

    bytes: int
    available: int | None
    factors: tuple[int, int, int]
    open: int = 0

    @property
    def reason(self) -> str:
        """Return why it cannot be read at full size; empty if it can."""
        if self.factors == (1, 1, 1) or self.available is None:
            return ""
        i, j, k = self.factors
        beside = (
            sentence(" beside the {open:.1f} GB of what is open", open=self.open / 1e9)
            if self.open
            else ""
        )
        return sentence(
            "needs {bytes:.1f} GB of memory, and {available:.1f} GB are "
            "free{beside}; fits with {i} × {j} × {k} voxels taken together",
            bytes=self.bytes / 1e9,
            available=self.available / 1e9,
            beside=beside,
            i=i,
            j=j,
            k=k,
        )


def voxel_bytes(headers: Sequence[SliceHeader]) -> int:
    """Bytes of a voxel: 2 where every value may be a whole number of 16 bits, else 4."""
    broken = (header.rescale is not None and not integral(header) for header in headers)
    return 4 if any(broken) else 2


def need(headers: Sequence[SliceHeader]) -> Need:
    """Memory for a volume of these images."""
    form = headers[0].format
    return need_of((form.columns, form.rows, len(headers)), voxel_bytes(headers))


def need_of(size: tuple[int, int, int], voxel_bytes: int, reading: float = 1.0) -> Need:
    """Memory for a volume of I × J × K voxels.

    While it is read, it lies beside what is open; once it is there, that goes, and what is made of
    the new volume comes.

    Args:
        size: columns, rows, slices.
        voxel_bytes: of one voxel.
        reading: copies of the volume that there are while it is read.
    """
    volume = size[0] * size[1] * size[2] * voxel_bytes
    free, held = available(), open_bytes()
    most = volume
    if free is not None:
        most = int(SHARE * min(free / reading, (free + held) / WORKING_COPIES))
    return Need(int(volume * WORKING_COPIES), free, _factors(size, volume, most), held)


def hold(array: NDArray[Any]) -> None:
    """Count the voxels of a volume as open for as long as anything of them is in use."""
    while isinstance(array.base, np.ndarray):
        array = array.base
    key = id(array)
    _held[key] = array.nbytes
    weakref.finalize(array, _held.pop, key, None).atexit = False


def open_bytes() -> int:
    """Memory of the volumes that are open."""
    return sum(tuple(_held.values()))


def _factors(size: tuple[int, int, int], volume: int, most: int) -> tuple[int, int, int]:
    """Halve in the plane first, as pixels are mostly finer than slices; then along the slices."""
    factors = [1, 1, 1]
    while volume / (factors[0] * factors[1] * factors[2]) > most and max(factors) < max(size):
        if factors[2] * 2 <= factors[0]:
            factors[2] *= 2
        else:
            factors[0], factors[1] = factors[0] * 2, factors[1] * 2
    return factors[0], factors[1], factors[2]


def available() -> int | None:
    """Memory that can be taken now without pushing others out [bytes]; None where nobody says."""
    found = [value for value in (_machine(), *map(_group, _GROUPS)) if value is not None]
    return min(found) if found else None


def _machine() -> int | None:
    try:
        return int(psutil.virtual_memory().available)
    except (OSError, RuntimeError, NotImplementedError):
        return None


def _group(names: tuple[Path, str, str, str]) -> int | None:
    """Read what is left of the limit of the control group this program runs in."""
    folder, limit, used, cached = names
    try:
        most, taken = (int((folder / name).read_text(encoding="ascii")) for name in (limit, used))
        lines = (folder / "memory.stat").read_text(encoding="ascii").splitlines()
        given_back = {key: int(value) for key, value in (line.split() for line in lines)}
    except (OSError, ValueError):  # no such group, or "max": no limit
        return None
    return max(most - taken + given_back.get(cached, 0), 0)
