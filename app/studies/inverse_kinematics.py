"""Study: joint angles from the tool point: closed form, Newton's steps, a table.

Points of the needle's cone; Newton begins where the tool was 10 ms before at 0.2 m/s. What is off
is measured with the forward map, whose own rounding is 1e-16 m.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.pantograph import inverse
from app.mechanisms.pantograph.kernels import forward_kernel, inverse_kernel, jacobian_kernel
from app.mechanisms.pantograph.profile import load_pantograph
from app.studies.in_use import called
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Inverse kinematics of the pantograph: closed form, Newton, table",
    "question": "How are the motor angles found from the tool point?",
    "reference": "forward kinematics of the answer against the point asked for, 1e-16 m",
}

_POINTS: Final = 2000
_BEFORE: Final = 2e-3  # [m] 10 ms at 0.2 m/s
_SEEN_MM: Final = 0.1
_GRIDS: Final = (16, 64, 256)

Arm = tuple[float, float, float]


@njit
def newton(x: float, y: float, q1: float, q2: float, links: Arm, steps: int) -> tuple[float, float]:
    """Newton's method on the forward map from angles nearby; stays where it is singular."""
    for _ in range(steps):
        status, px, py = forward_kernel(q1, q2, links[0], links[1], links[2], 1.0)
        if status != 0:
            break
        status, jxl, jxr, jyl, jyr = jacobian_kernel(q1, q2, px, py, *links)
        determinant = jxl * jyr - jxr * jyl
        if status != 0 or determinant == 0.0:
            break
        ex, ey = x - px, y - py
        q1 += (jyr * ex - jxr * ey) / determinant
        q2 += (jxl * ey - jyl * ex) / determinant
    return q1, q2


@njit
def looked_up(x: float, y: float, table: FloatArray, box: FloatArray) -> tuple[float, float]:
    """Bilinear interpolation in a grid of angles (n, n, 2) over a box (x0, y0, width)."""
    cells = table.shape[0] - 1
    u, v = (x - box[0]) / box[2] * cells, (y - box[1]) / box[2] * cells
    i, j = min(max(int(u), 0), cells - 1), min(max(int(v), 0), cells - 1)
    a, b = u - i, v - j
    w00, w10, w01, w11 = (1.0 - a) * (1.0 - b), a * (1.0 - b), (1.0 - a) * b, a * b
    q1 = w00 * table[i, j, 0] + w10 * table[i + 1, j, 0]
    q2 = w00 * table[i, j, 1] + w10 * table[i + 1, j, 1]
    return (
        q1 + w01 * table[i, j + 1, 0] + w11 * table[i + 1, j + 1, 0],
        q2 + w01 * table[i, j + 1, 1] + w11 * table[i + 1, j + 1, 1],
    )


@njit
def _closed_often(p3: FloatArray, links: Arm, out: FloatArray) -> None:
    for k in range(len(p3)):
        _, out[k, 0], out[k, 1] = inverse_kernel(
            p3[k, 0], p3[k, 1], links[0], links[1], links[2], 1.0, -1.0
        )


@njit
def _newton_often(
    p3: FloatArray, before: FloatArray, links: Arm, steps: int, out: FloatArray
) -> None:
    for k in range(len(p3)):
        out[k, 0], out[k, 1] = newton(p3[k, 0], p3[k, 1], before[k, 0], before[k, 1], links, steps)


@njit
def _table_often(p3: FloatArray, table: FloatArray, box: FloatArray, out: FloatArray) -> None:
    for k in range(len(p3)):
        out[k, 0], out[k, 1] = looked_up(p3[k, 0], p3[k, 1], table, box)


def _case(setting: Setting) -> Case:
    geometry, rng = load_pantograph("icube").pantograph, np.random.default_rng(3)
    reach = geometry.fulcrum[2] * np.tan(np.deg2rad(setting.values["tilt_deg"]))
    way = rng.uniform(-np.pi, np.pi, _POINTS)
    p3 = geometry.fulcrum[:2] + reach * np.sqrt(rng.uniform(size=_POINTS))[:, None] * np.stack(
        [np.cos(way), np.sin(way)], axis=1
    )
    turn = rng.uniform(-np.pi, np.pi, _POINTS)
    start = p3 + _BEFORE * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    before = np.array([inverse(geometry, point) for point in start])
    links: Arm = tuple(map(float, geometry.links))  # type: ignore[assignment]

    def error(q: FloatArray) -> float:
        found = np.array([forward_kernel(*angles, *links, 1.0)[1:] for angles in q])
        return 1e3 * float(np.linalg.norm(found - p3, axis=1).max())

    return Case((p3, before, links, reach), error, _SEEN_MM)


def _closed(case: Case) -> Prepared:
    p3, _, links, _ = case.data
    out = np.empty((_POINTS, 2))

    def run() -> FloatArray:
        _closed_often(p3, links, out)
        return out

    return Prepared(run, _POINTS)


def _newton(steps: int) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        p3, before, links, _ = case.data
        out = np.empty((_POINTS, 2))

        def run() -> FloatArray:
            _newton_often(p3, before, links, steps, out)
            return out

        return Prepared(run, _POINTS)

    return prepare


def _table(cells: int) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        p3, _, links, reach = case.data
        x0, y0 = load_pantograph("icube").fulcrum[:2] - reach
        xs, ys = (low + np.linspace(0.0, 2.0 * reach, cells + 1) for low in (x0, y0))
        table = np.array([[inverse_kernel(x, y, *links, 1.0, -1.0)[1:] for y in ys] for x in xs])
        box, out = np.array([x0, y0, 2.0 * reach]), np.empty((_POINTS, 2))

        def run() -> FloatArray:
            _table_often(p3, table, box, out)
            return out

        return Prepared(run, _POINTS)

    return prepare


STUDY: Final = Study(
    error_label="largest error of the tool point [mm]",
    ways=(
        Way("closed form", "closed form", _closed, "two arms by atan2", inverse_kernel),
        *(
            Way(f"Newton {n}", "Newton", _newton(n), f"{n} steps from 10 ms before")
            for n in (1, 2, 3, 4)
        ),
        *(Way(f"table {n}", "table", _table(n), f"bilinear in {n} by {n} cells") for n in _GRIDS),
    ),
    settings=tuple(Setting(f"within {t}°", {"tilt_deg": t}) for t in (15, 30, 45)),
    case=_case,
    deadline=Limit(1e-6, "1 µs: a third of the 3 µs that a whole tick may take"),
    perception=Limit(_SEEN_MM, "0.1 mm on the screen"),
    default="closed form",
    because="exact everywhere, needs no start, and says where there is no answer",
    exception=(
        "A table knows one geometry, no edge of the workspace and no calibration of the robot; "
        "the program asks for inverse kinematics when a pose is set, never in the tick."
    ),
    in_use=lambda: called(inverse, "kernels").inverse_kernel,  # type: ignore[attr-defined]
)
