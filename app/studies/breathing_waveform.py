"""Study: how sin^2n of the breath is computed.

One breath in equal steps of phase; the error is that of the displacement of an organ that moves by
17.1 mm, the most of 14 tracked livers (PMC5978939).
"""

from collections.abc import Callable
from math import comb, pi
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence
from app.simulation.effects import breathing
from app.simulation.effects.breathing import lujan
from app.studies.in_use import called
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "The waveform of breathing: product, power, table, sum of cosines",
    "question": "How is sin^2n of the breath computed?",
    "reference": "sin^2n in extended precision (64 bits of mantissa), 1e-18",
}

_AMPLITUDE_MM: Final = 17.1
_SEEN_MM: Final = 0.1
_PHASES: Final = 4096


@njit
def power(phase: float, shape: float) -> float:
    """sin^2n by the power function, for any n."""
    return (np.sin(phase) ** 2) ** shape


@njit
def cosines(phase: float, weights: FloatArray) -> float:
    """sin^2n as the sum of cosines of even multiples, by Clenshaw's recurrence; whole n only."""
    two = 2.0 * np.cos(2.0 * phase)
    ahead = after = 0.0
    for k in range(len(weights) - 1, 0, -1):
        ahead, after = weights[k] + two * ahead - after, ahead
    return weights[0] + 0.5 * two * ahead - after


@njit
def tabled(phase: float, table: FloatArray) -> float:
    """Linear interpolation in equal steps over one breath, phase 0 to π."""
    cells = len(table) - 1
    place = phase * (cells / np.pi)
    cell = min(int(place), cells - 1)
    share = place - cell
    return (1.0 - share) * table[cell] + share * table[cell + 1]


@njit
def _product_often(phases: FloatArray, shape: float, out: FloatArray) -> None:
    for k in range(len(phases)):
        out[k] = lujan(phases[k], shape)


@njit
def _power_often(phases: FloatArray, shape: float, out: FloatArray) -> None:
    for k in range(len(phases)):
        out[k] = power(phases[k], shape)


@njit
def _cosines_often(phases: FloatArray, weights: FloatArray, out: FloatArray) -> None:
    for k in range(len(phases)):
        out[k] = cosines(phases[k], weights)


@njit
def _tabled_often(phases: FloatArray, table: FloatArray, out: FloatArray) -> None:
    for k in range(len(phases)):
        out[k] = tabled(phases[k], table)


def weights_of(n: int) -> FloatArray:
    """Weights of cos 2kx, k = 0 ... n, in sin^2n x; from (e^ix - e^-ix)^2n."""
    sides = [2.0 * (-1) ** k * comb(2 * n, n - k) / 4.0**n for k in range(1, n + 1)]
    return np.array([comb(2 * n, n) / 4.0**n, *sides])


def exact(phases: Any, shape: float) -> Any:
    """sin^2n in extended precision."""
    return np.sin(phases.astype(np.longdouble)) ** np.longdouble(2.0 * shape)


def _case(setting: Setting) -> Case:
    phases = (np.arange(_PHASES) + 0.5) * (pi / _PHASES)
    shape = setting.values["n"]
    true = exact(phases, shape)
    return Case(
        (phases, shape),
        lambda found: _AMPLITUDE_MM * float(np.abs(found - true).max()),
        _SEEN_MM,
    )


def _run(often: Callable[..., None], phases: FloatArray, by: Any) -> Prepared:
    out = np.empty(_PHASES)

    def run() -> FloatArray:
        often(phases, by, out)
        return out

    return Prepared(run, _PHASES)


def _by_cosines(case: Case) -> Prepared:
    phases, shape = case.data
    if shape != int(shape):
        raise ValueError(
            sentence("n = {shape:g} is no whole number: the sum has no end", shape=shape)
        )
    return _run(_cosines_often, phases, weights_of(int(shape)))


def _by_table(cells: int) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        phases, shape = case.data
        knots = np.linspace(0.0, pi, cells + 1)
        return _run(_tabled_often, phases, np.array(exact(knots, shape), dtype=np.float64))

    return prepare


STUDY: Final = Study(
    error_label="error of the organ's place [mm], 17.1 mm of breathing",
    ways=(
        Way(
            "product",
            "sine, multiplied",
            lambda case: _run(_product_often, *case.data),
            "a whole n by multiplying, any other by a power",
            lujan,
        ),
        Way("power", "sine, power", lambda case: _run(_power_often, *case.data), "pow for any n"),
        Way("cosines", "sum of cosines", _by_cosines, "Clenshaw's recurrence, one cosine"),
        *(
            Way(f"table {cells}", "table", _by_table(cells), f"linear between {cells + 1} places")
            for cells in (16, 64, 256, 1024)
        ),
    ),
    settings=tuple(Setting(f"n = {n:g}", {"n": n}) for n in (1.0, 2.0, 3.0, 2.5)),
    case=_case,
    deadline=Limit(50e-9, "50 ns: a closed-form effect"),
    perception=Limit(_SEEN_MM, "0.1 mm on the screen"),
    default="product",
    because="exact for any n, without a table to be built",
    exception=(
        "A table would be one more per exponent; what it saves, 30 ns of a tick of 1 ms, nobody "
        "could notice either."
    ),
    in_use=lambda: called(breathing.displace, "lujan"),
)
