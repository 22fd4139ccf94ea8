"""What is inserted of a needle, tissue by tissue: the sums of friction along its shaft.

Memory of the model `inserted` of the effect `shaft_friction`. As the tip goes on from place to
place (depth less the dimple in front of it) the shaft behind it lies in the tissue that the tip
went through: each bin of 1/1024 m keeps the sums from the skin to its upper edge, so nothing is
added twice and nothing drifts. Withdrawn, the needle is in what lies above; what was deeper is
forgotten.
"""

from typing import Final, NamedTuple

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.parameters import numbered
from app.simulation.along_needle import tissue_row
from app.simulation.channel import BIN


class SumPlaces(NamedTuple):
    """Kinetic and break-away level [N], viscous coefficient [N·s/m]."""

    kinetic: int
    static: int
    viscous: int


SUM: Final = numbered(SumPlaces)
ROW: Final = 1 + len(SUM)
"""Of a tissue: end of its layer [m], then the same per inserted length."""


@njit
def _withdraw(p: FloatArray, sums: int, edges: int, old: float, new: float) -> None:
    """Go back from the place `old` to `new`: what was laid within a bin is taken as even."""
    j, last = int(new / BIN), int(old / BIN)
    upper = edges + len(SUM) * j
    length = (old if j == last else (j + 1) * BIN) - j * BIN
    share = min((new - j * BIN) / length, 1.0) if length > 0.0 else 0.0
    for q in range(len(SUM)):
        low = p[upper + q]
        high = p[sums + q] if j == last else p[upper + len(SUM) + q]
        p[sums + q] = low + share * (high - low)


@njit
def go_to(
    p: FloatArray,
    state: FloatArray,
    sums: int,
    rows: int,
    count: int,
    edges: int,
    by_field: float,
    old: float,
    new: float,
) -> None:
    """Bring the sums from the place `old` to `new` [m], both 0 or more and within the bins.

    Args:
        p: the array.
        state: says in a field which tissue lies at the tip.
        sums: place of the sums now.
        rows: place of the first tissue.
        count: of tissues.
        edges: place of the sums at the bins' upper edges; a bin more than there are.
        by_field: 1 where tissue is looked up in a field.
        old: place before.
        new: place now.
    """
    if new < old:
        _withdraw(p, sums, edges, old, new)
        return
    for j in range(int(old / BIN), int(new / BIN) + 1):
        begin, end = max(old, j * BIN), min(new, (j + 1) * BIN)
        row = tissue_row(p, state, rows, ROW, count, by_field, 0.5 * (begin + end))
        for q in range(len(SUM)):
            p[sums + q] += max(end - begin, 0.0) * p[row + 1 + q]
        if new >= (j + 1) * BIN:
            for q in range(len(SUM)):
                p[edges + len(SUM) * (j + 1) + q] = p[sums + q]
