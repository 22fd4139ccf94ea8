"""How much memory a volume needs, how much there is, and how far it must be reduced to fit."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from app.imaging.header import SliceHeader

SHARE = 0.7
"""Of the memory that is available a volume and what is made of it may take this much."""

WORKING_COPIES = 1.5
"""Memory at work for each byte of a volume: itself, and body, masks and surfaces of it."""

_MEMINFO = Path("/proc/meminfo")
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
        factors: voxels to take together along i, j, k so that it fits; (1, 1, 1) if it does.
    """

    bytes: int
    available: int | None
    factors: tuple[int, int, int]

    @property
    def reason(self) -> str:
        """Why it cannot be read at full size; empty if it can."""
        if self.factors == (1, 1, 1) or self.available is None:
            return ""
        i, j, k = self.factors
        return (
            f"needs {self.bytes / 1e9:.1f} GB of memory, and {self.available / 1e9:.1f} GB are "
            f"free; fits with {i} × {j} × {k} voxels taken together"
        )


def need(headers: Sequence[SliceHeader]) -> Need:
    """Memory for a volume of these images at two bytes a voxel."""
    form = headers[0].format
    return need_of((form.columns, form.rows, len(headers)), 2)


def need_of(size: tuple[int, int, int], voxel_bytes: int) -> Need:
    """Memory for a volume of I × J × K voxels.

    Args:
        size: columns, rows, slices.
        voxel_bytes: of one voxel.
    """
    whole = int(size[0] * size[1] * size[2] * voxel_bytes * WORKING_COPIES)
    free = available()
    return Need(whole, free, _factors(size, whole, free))


def _factors(size: tuple[int, int, int], whole: int, free: int | None) -> tuple[int, int, int]:
    """Halve in the plane first, as pixels are mostly finer than slices; then along the slices."""
    factors = [1, 1, 1]
    limit = whole if free is None else free * SHARE
    while whole / (factors[0] * factors[1] * factors[2]) > limit and max(factors) < max(size):
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
        lines = _MEMINFO.read_text(encoding="ascii").splitlines()
    except OSError:
        return None
    for line in lines:
        if line.startswith("MemAvailable:"):
            return int(line.split()[1]) * 1024
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
