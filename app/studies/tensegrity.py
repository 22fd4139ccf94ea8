"""Study: the tensegrity needle holder: how far it points, how well its formulas close, how stiff.

The paper's figure 5 redone with its lengths against the 40° cone it asks for, in both readings of
"40°" (half and full angle) and of the joints; direct kinematics in closed form beside the paper's
numerical way; what the paper leaves open: conditioning, encoders, cables, the remote centre itself.
"""

from collections.abc import Callable
from functools import partial
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.progress import Progress
from app.mechanisms.tensegrity import (
    EDGES_PER_LINE,
    ENCODER_LINES,
    Cables,
    CurvedBars,
    JointReading,
    TensegrityGeometry,
    force_limit,
    forward,
    guide_stiffness,
    inverse,
    length_jacobian,
    tensions,
    torques,
)
from app.mechanisms.tensegrity.cable_kernels import tensions_kernel
from app.mechanisms.tensegrity.frame import remote_centre_stiffness
from app.mechanisms.tensegrity.kernels import (
    dexterity_kernel,
    forward_kernel,
    inverse_kernel,
    jacobian_kernel,
)
from app.mechanisms.tensegrity.numerical import forward_by_root, newton_kernel
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey
from app.studies.timing import seconds

DECLARATION: Final[dict[str, Any]] = {
    "title": "The tensegrity needle holder: workspace, closure, conditioning, stiffness, encoders",
    "question": "What does the second machine reach, how exactly, and how stiffly?",
    "reference": "each map against its inverse; the paper's lengths; tilts, cables, bars assumed",
}

PAPER: Final = TensegrityGeometry()
SCISSOR: Final = TensegrityGeometry(reading=JointReading.SCISSOR)
NOT_TILTED: Final = TensegrityGeometry(first_tilt=0.0, second_tilt=0.0)
STEEL: Final = Cables()
STIFFENING: Final = Cables(stiffness=4e3, stiffening=300.0)
BARS: Final = CurvedBars()
HALF_DEG: Final = (20.0, 40.0)
"""Half angles of the two cones that "a 40° cone" may mean: 40° as the full, and as the half."""
POSES: Final = 200_000
_L_OUT: Final = 0.11  # [m] hub to remote centre
_SLOW: Final = 200  # calls of what takes 0.3 ms
_BEFORE: Final = 4e-3  # [rad] Newton's start: 10 ms before at 0.4 rad/s
_BLUE, _RED, _GREEN = "#0072B2", "#D55E00", "#009E73"


def cone(half: float, rings: int = 61, spokes: int = 180) -> FloatArray:
    """Directions (n, 3) in a cone about z0 of a half angle [rad], on rings up to its rim."""
    tilt, turn = np.meshgrid(
        np.linspace(0.0, half, rings), np.linspace(0.0, 2.0 * np.pi, spokes, endpoint=False)
    )
    return _directions(tilt.ravel(), turn.ravel())


def _directions(tilt: FloatArray, turn: FloatArray) -> FloatArray:
    sine = np.sin(tilt)
    return np.stack([sine * np.cos(turn), sine * np.sin(turn), np.cos(tilt)], axis=-1)


@njit
def _measured(t: FloatArray, bars: Any, out: FloatArray) -> None:
    # β1, β2, closure error, dexterity, largest encoder error per step; NaN out of reach.
    for k in range(len(t)):
        out[k, :] = np.nan
        status, b1, b2 = inverse_kernel(t[k, 0], t[k, 1], t[k, 2], *bars, 1.0)
        if status != 0:
            continue
        out[k, 0], out[k, 1] = b1, b2
        status, x, y, z = forward_kernel(b1, b2, *bars, 1.0)
        if status != 0:
            continue
        out[k, 2] = np.sqrt((x - t[k, 0]) ** 2 + (y - t[k, 1]) ** 2 + (z - t[k, 2]) ** 2)
        status, x1, x2, y1, y2, z1, z2 = jacobian_kernel(b1, b2, x, y, z, *bars)
        if status != 0:
            continue
        out[k, 3], _ = dexterity_kernel(x1, x2, y1, y2, z1, z2)
        both = np.sqrt((x1 + x2) ** 2 + (y1 + y2) ** 2 + (z1 + z2) ** 2)
        against = np.sqrt((x1 - x2) ** 2 + (y1 - y2) ** 2 + (z1 - z2) ** 2)
        out[k, 4] = 0.5 * max(both, against)


def measured(geometry: TensegrityGeometry, t: FloatArray) -> FloatArray:
    """β1, β2 [rad], closure error [1], dexterity, direction error per step of both encoders [1].

    Shape (n, 5) of directions (n, 3); NaN where the machine does not reach.
    """
    out = np.empty((len(t), 5))
    _measured(np.ascontiguousarray(t), geometry.bars, out)
    return out


@njit
def _closed_often(beta: FloatArray, bars: Any, out: FloatArray) -> None:
    for k in range(len(beta)):
        _, out[k, 0], out[k, 1], out[k, 2] = forward_kernel(beta[k, 0], beta[k, 1], *bars, 1.0)


@njit
def _newton_often(beta: FloatArray, near: FloatArray, bars: Any, out: FloatArray) -> None:
    for k in range(len(beta)):
        _, out[k, 0], out[k, 1], out[k, 2], _ = newton_kernel(
            beta[k, 0], beta[k, 1], near[k, 0], near[k, 1], near[k, 2], 1e-15, *bars
        )


@njit
def _tensions_often(beta: FloatArray, load: FloatArray, wanted: float, numbers: Any) -> float:
    total = 0.0
    for k in range(len(beta)):
        _, t1, t2, t3, t4, _, _ = tensions_kernel(
            beta[k, 0], beta[k, 1], load[k, 0], load[k, 1], wanted, wanted, *numbers
        )
        total += t1 + t2 + t3 + t4
    return total


def workspace() -> Sheet:
    """Return how much of the required cone is reached, in both readings of cone and joints."""
    rows: list[tuple[Cell, ...]] = []
    for name, geometry in (
        ("one rhombus", PAPER),
        ("scissor", SCISSOR),
        ("one rhombus, tilts 0", NOT_TILTED),
    ):
        whole = cone(np.pi, 181, 360)
        weights = np.sin(np.arccos(np.clip(whole[:, 2], -1.0, 1.0)))
        share = float(weights[~np.isnan(measured(geometry, whole)[:, 0])].sum() / weights.sum())
        for half, words in zip(HALF_DEG, ("full angle", "half angle"), strict=True):
            t = cone(np.deg2rad(half))
            found = measured(geometry, t)
            angles = [np.rad2deg(np.arccos(np.clip(t @ a, -1.0, 1.0))) for a in geometry.bases]
            slack = min(
                float(np.rad2deg(most) - own.max())
                for most, own in zip(geometry.largest, angles, strict=True)
            )
            reached = ~np.isnan(found[:, 0])
            worst = float(1.0 / np.nanmin(found[:, 3])) if reached.all() else "not covered"
            tilts = np.rad2deg([geometry.first_tilt, geometry.second_tilt])
            rows.append(
                (
                    name,
                    f"{tilts[0]:.0f}°, {tilts[1]:.0f}°",
                    f"40° as the {words}",
                    100.0 * float(reached.mean()),
                    slack,
                    worst,
                    100.0 * share,
                )
            )
    return Sheet(
        "workspace",
        "Workspace with the paper's lengths against its 40° cone",
        (
            "joints",
            "θ10, θ20 (assumed)",
            "cone",
            "reached [%]",
            "to the edge of reach [°]",
            "worst condition",
            "whole workspace [% of the sphere]",
        ),
        tuple(rows),
    )


def closure() -> Sheet:
    """Errors of every map against its inverse over the whole workspace."""
    rng = np.random.default_rng(15)
    rows: list[tuple[Cell, ...]] = []
    for geometry in (PAPER, SCISSOR):
        t = rng.normal(size=(POSES, 3))
        t /= np.linalg.norm(t, axis=1)[:, None]
        found = measured(geometry, t)
        inside = ~np.isnan(found[:, 2])
        height = t @ np.cross(*geometry.bases)
        name = geometry.reading.value
        good = inside & (height >= 0.01)
        scaled = found[inside, 2] * height[inside]
        rows.append((f"{name}: t, inverse and direct, D ≥ 0.01", *_row(found[good, 2])))
        rows.append((f"{name}: the same times D, all poses", *_row(scaled)))
        beta = np.ascontiguousarray(found[inside, :2])
        again = np.empty((len(beta), 3))
        _closed_often(beta, geometry.bars, again)
        lever = np.sin(0.5 * beta).min(axis=1)
        error = np.abs(measured(geometry, again)[:, :2] - beta).max(axis=1)
        rows.append((f"{name}: β, direct and inverse, β > 0.01", *_row(error[lever > 0.005])))
        rows.append((f"{name}: the same times sin(β/2), all poses", *_row(error * lever)))
    return Sheet(
        "closure",
        "Closure errors (D = t·(a1 × a2))",
        ("what", "poses", "median", "largest"),
        tuple(rows),
    )


def _row(error: FloatArray) -> tuple[Cell, ...]:
    kept = error[~np.isnan(error)]
    return len(kept), float(np.median(kept)), float(kept.max())


def direct() -> Sheet:
    """Direct kinematics by every way over the 40° half angle cone: error and time."""
    rng = np.random.default_rng(16)
    t = cone(np.deg2rad(40.0), 91, 90)
    beta = np.ascontiguousarray(measured(PAPER, t)[:, :2])
    near = t + _BEFORE * rng.normal(size=t.shape)
    out = np.zeros((4, *t.shape))

    def called() -> None:
        for k in range(_SLOW):
            out[2, k] = forward(PAPER, beta[k])

    def by_root() -> None:
        for k in range(_SLOW):
            out[3, k] = forward_by_root(PAPER, beta[k], near[k])

    ways: tuple[tuple[str, Callable[[], object], int], ...] = (
        ("closed form, compiled", lambda: _closed_often(beta, PAPER.bars, out[0]), len(t)),
        ("Newton, compiled", lambda: _newton_often(beta, near, PAPER.bars, out[1]), len(t)),
        ("closed form, called from Python", called, _SLOW),
        ("scipy.optimize.root (the paper's way)", by_root, _SLOW),
    )
    times = seconds(*((run, calls) for _, run, calls in ways))
    return Sheet(
        "direct",
        "Direct kinematics: closed form beside the numerical way",
        ("way", "largest error of t", "time [ns]", "times the compiled closed form's"),
        tuple(
            (
                name,
                float(np.linalg.norm(found[:calls] - t[:calls], axis=1).max()),
                1e9 * taken,
                taken / times[0],
            )
            for (name, _, calls), found, taken in zip(ways, out, times, strict=True)
        ),
    )


def conditioning() -> Sheet:
    """Condition, and what the encoders leave of the direction, by tilt."""
    counts, edges = ENCODER_LINES, ENCODER_LINES * EDGES_PER_LINE
    rows: list[tuple[Cell, ...]] = []
    for tilt_deg in (0.0, 10.0, 20.0, 30.0, 40.0, 45.0):
        turn = np.linspace(0.0, 2.0 * np.pi, 361)
        found = measured(PAPER, _directions(np.full(361, np.deg2rad(tilt_deg)), turn))
        per_step = 2.0 * np.pi * float(np.nanmax(found[:, 4]))
        by = (np.rad2deg(per_step / counts), np.rad2deg(per_step / edges))
        rows.append(
            (
                tilt_deg,
                float(1.0 / np.nanmin(found[:, 3])),
                *map(float, by),
                float(np.tan(np.deg2rad(by[1])) * 100.0),
            )
        )
    return Sheet(
        "conditioning",
        f"Worst condition and encoder error by tilt: {counts} counts or {edges} edges per turn",
        (
            "tilt [°]",
            "condition of dt/dβ",
            "counts: largest error [°]",
            "edges: largest error [°]",
            "edges: at a tip 100 mm deep [mm]",
        ),
        tuple(rows),
    )


def pretensions(cables: Cables, t: FloatArray, levels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean tension [N] and least stiffness of the guide [N·m/rad] by level of pretension 0...1."""
    beta = inverse(PAPER, t)
    lever = length_jacobian(PAPER, beta)
    null = np.array([-lever[1, 0], lever[0, 0], -lever[3, 1], lever[2, 1]])
    null[:2] /= null[:2].max()
    null[2:] /= null[2:].max()
    least = cables.least / np.repeat([null[:2].min(), null[2:].min()], 2)
    mean, soft = [], []
    for level in levels:
        pulled = null * (least + level * (cables.most - least))
        values = np.linalg.eigvalsh(guide_stiffness(PAPER, cables, t, pulled))
        mean.append(pulled.mean())
        soft.append(np.sort(values)[1])  # the smallest belongs to t itself
    return np.array(mean), np.array(soft)


def _poses() -> tuple[tuple[str, FloatArray], ...]:
    """Upright, and tilted by 40° between both base joints (the weak side) and away from them."""
    tilt = np.deg2rad(40.0)
    return (
        ("upright", _directions(np.array(0.0), np.array(0.0))),
        ("40° between A1 and A2", _directions(np.array(tilt), np.array(np.deg2rad(45.0)))),
        ("40° away from them", _directions(np.array(tilt), np.array(np.deg2rad(225.0)))),
    )


def stiffness() -> Sheet:
    """Stiffness of guide and remote centre from the least to the most pretension."""
    rows: list[tuple[Cell, ...]] = []
    for words, t in _poses():
        give = np.linalg.inv(remote_centre_stiffness(PAPER, BARS, t))
        centre = (float(1.0 / give[2, 2]), float(1.0 / (t @ give @ t)))
        for name, cables in (("constant 20 kN/m", STEEL), ("4 kN/m, stiffening", STIFFENING)):
            _, soft = pretensions(cables, t, np.array([0.0, 1.0]))
            force = force_limit(PAPER, cables, inverse(PAPER, t), _L_OUT)
            rows.append(
                (
                    words,
                    name,
                    *map(float, soft),
                    *map(float, soft / _L_OUT**2),
                    force,
                    *centre,
                )
            )
    return Sheet(
        "stiffness",
        "Stiffness of the guide in its softest direction, winches held; everything elastic assumed",
        (
            "pose",
            "cables",
            "least pretension [N·m/rad]",
            "most pretension [N·m/rad]",
            "least, at the hub [N/m]",
            "most, at the hub [N/m]",
            "force at the hub, worst direction [N]",
            "remote centre, vertical [N/m]",
            "remote centre, along the needle [N/m]",
        ),
        tuple(rows),
    )


def cables() -> Sheet:
    """Tensions over the 40° half angle cone: equilibrium, limits, time."""
    rng = np.random.default_rng(17)
    t = cone(np.deg2rad(40.0), 21, 24)
    beta = np.ascontiguousarray(measured(PAPER, t)[:, :2])
    load = rng.uniform(-1.0, 1.0, beta.shape)
    numbers = (*STEEL.law, *PAPER.radii, *PAPER.bars)
    rows: list[tuple[Cell, ...]] = []
    for name, wanted in (("least norm", 0.0), ("with a stiffness of 110 N·m/rad", 110.0)):
        off, short = [], 0
        ask = None if wanted == 0.0 else (wanted, wanted)
        for b, x in zip(beta, load, strict=True):
            found = tensions(PAPER, STEEL, b, x, ask)
            off.append(np.abs(torques(PAPER, b, found.tensions) + found.shortfall - x).max())
            short += int(np.abs(found.shortfall).max() > 0.0)
        (taken,) = seconds((partial(_tensions_often, beta, load, wanted, numbers), len(beta)))
        rows.append((name, len(beta), float(np.max(off)), short, 1e9 * taken))
    return Sheet(
        "tensions",
        "Tensions of four cables, 2 to 60 N, for loads up to 1 N·m on each joint",
        ("request", "poses", "largest imbalance [N·m]", "loads short", "time of one tick [ns]"),
        tuple(rows),
    )


def _map(limit: float, points: int) -> tuple[FloatArray, FloatArray]:
    """Grid of tilts in x and y [rad] (azimuthal, equidistant) and its directions (n, n, 3)."""
    line = np.linspace(-limit, limit, points)
    x, y = np.meshgrid(line, line)
    return line, _directions(np.hypot(x, y), np.arctan2(y, x))


def draw_workspace(figure: Any) -> None:
    """Figure 5: the workspace on its sphere, and as a map seen from above."""
    solid = figure.add_subplot(1, 2, 1, projection="3d")
    b1, b2 = np.meshgrid(np.linspace(0.0, np.pi, 61), np.linspace(0.0, np.pi, 61))
    beta, t = np.stack([b1.ravel(), b2.ravel()], axis=1), np.empty((b1.size, 3))
    _closed_often(beta, PAPER.bars, t)
    radius = 1e3 * PAPER.first_radius
    kept = radius * t[np.linalg.norm(t, axis=1) > 0.5]
    solid.scatter(*kept.T, s=2.0, color=_BLUE, alpha=0.35, depthshade=False)
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    for half, colour in zip(HALF_DEG, (_GREEN, _RED), strict=True):
        rim = radius * _directions(np.full(181, np.deg2rad(half)), turn)
        solid.plot(*rim.T, color=colour, linewidth=2)
        for k in range(0, 180, 30):
            solid.plot(*np.stack([np.zeros(3), rim[k]]).T, color=colour, linewidth=0.6)
    for number, base in enumerate(PAPER.bases, start=1):
        solid.plot(*np.stack([np.zeros(3), radius * base]).T, color="black", linewidth=1)
        solid.text(*(1.08 * radius * base), f"A{number}")
    solid.set(xlabel="x0 [mm]", ylabel="y0 [mm]", zlabel="z0 [mm]", box_aspect=(1, 1, 1))
    solid.view_init(28.0, 40.0)
    axes = figure.add_subplot(1, 2, 2)
    limit = np.deg2rad(100.0)
    line, grid = _map(limit, 401)
    for geometry, colour in ((PAPER, _BLUE), (SCISSOR, "#CC79A7"), (NOT_TILTED, "#999999")):
        reached = ~np.isnan(measured(geometry, grid.reshape(-1, 3))[:, 0])
        shown = reached.reshape(grid.shape[:2]).astype(float)
        degrees = np.rad2deg(line)
        if geometry is PAPER:
            axes.contourf(degrees, degrees, shown, levels=[0.5, 1.5], colors=[colour], alpha=0.25)
        style = "--" if geometry is SCISSOR else "-"
        axes.contour(degrees, degrees, shown, levels=[0.5], colors=[colour], linestyles=[style])
        axes.plot([], [], style, color=colour, label=_NAMES[geometry])
    _cones(axes)
    for number, base in enumerate(PAPER.bases, start=1):
        tilt, turn_ = np.rad2deg(np.arccos(base[2])), np.arctan2(base[1], base[0])
        axes.plot(tilt * np.cos(turn_), tilt * np.sin(turn_), "k^")
        axes.annotate(f"A{number}", (tilt * np.cos(turn_) + 3, tilt * np.sin(turn_) + 3))
    axes.legend(fontsize=7, loc="lower left")
    axes.set(xlabel="tilt towards x0 [°]", ylabel="tilt towards y0 [°]", aspect="equal")
    figure.suptitle(
        "Where T stands for β = 0 ... π; the 40° cone with 40° as the full (green) and as the half "
        "angle (red)",
        fontsize=10,
    )
    figure.subplots_adjust(left=0.0, right=0.98, top=0.93, bottom=0.09, wspace=0.12)


_NAMES: Final = {
    PAPER: "one rhombus, tilts 25° and 30°",
    SCISSOR: "scissor, the same tilts (same edge)",
    NOT_TILTED: "tilts 0: misses 2.6° of the 20° cone",
}


def _cones(axes: Any) -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    for half, colour in zip(HALF_DEG, (_GREEN, _RED), strict=True):
        axes.plot(half * np.cos(turn), half * np.sin(turn), color=colour, linewidth=1.5)


def draw_maps(figure: Any) -> None:
    """Condition, encoder error and closure over the workspace, seen from above."""
    line, grid = _map(np.deg2rad(75.0), 301)
    found = measured(PAPER, grid.reshape(-1, 3)).reshape(*grid.shape[:2], 5)
    per_edge = 2.0 * np.pi / (ENCODER_LINES * EDGES_PER_LINE)
    panels = (
        ("condition of dt/dβ", 1.0 / np.maximum(found[..., 3], 0.05), 1.0, 10.0),
        ("encoder error, 2000 edges [°]", np.rad2deg(found[..., 4] * per_edge), 0.0, 0.5),
        ("closure of t, log10", np.log10(np.maximum(found[..., 2], 1e-17)), -17.0, -13.0),
    )
    degrees = np.rad2deg(line)
    for number, (title, values, low, high) in enumerate(panels):
        axes = figure.add_subplot(1, 3, number + 1)
        shown = axes.pcolormesh(
            degrees, degrees, values, vmin=low, vmax=high, shading="nearest", rasterized=True
        )
        figure.colorbar(shown, ax=axes, shrink=0.6)
        _cones(axes)
        axes.set(aspect="equal", xlabel="tilt towards x0 [°]", ylabel="tilt towards y0 [°]")
        axes.set_title(title, fontsize=9)
    figure.tight_layout()


def draw_stiffness(figure: Any) -> None:
    """Stiffness of the guide against pretension: softer with constant cables."""
    levels = np.linspace(0.0, 1.0, 41)
    for number, (name, law) in enumerate(
        (("cables of constant 20 kN/m", STEEL), ("cables of 4 kN/m + 300/m · tension", STIFFENING))
    ):
        axes = figure.add_subplot(1, 2, number + 1)
        for (words, t), colour in zip(_poses(), (_BLUE, _GREEN, _RED), strict=True):
            mean, soft = pretensions(law, t, levels)
            label = f"{words}: {soft[0]:.0f} N·m/rad"
            axes.plot(mean, 100.0 * soft / soft[0], color=colour, label=label)
        axes.set(xlabel="mean tension [N]", ylabel="softest direction, of that at the least [%]")
        axes.set_title(f"{name} (assumed)", fontsize=9)
        axes.grid(True, color="#DDDDDD", linewidth=0.5)
        axes.legend(fontsize=8)
    figure.tight_layout()


def _measure(progress: Progress | None) -> Findings:
    steps = (workspace, closure, direct, conditioning, stiffness, cables)
    sheets: list[Sheet] = []
    for number, step in enumerate(steps):
        if progress is not None:
            progress.report(number / len(steps), step.__name__)
        sheets.append(step())
    return Findings(
        tuple(sheets),
        (
            Figure("workspace", draw_workspace, (12.0, 6.0)),
            Figure("maps", draw_maps, (14.0, 4.6)),
            Figure("stiffness", draw_stiffness, (10.0, 4.2)),
        ),
        _lines(*sheets),
    )


def _lines(
    space: Sheet, closed: Sheet, ways: Sheet, condition: Sheet, stiff: Sheet, pulled: Sheet
) -> tuple[str, ...]:
    full, half = space.rows[:2]
    constant, stiffening = stiff.rows[:2]
    called, by_root = (float(row[2]) for row in ways.rows[2:])
    give = 1e3 / float(constant[7])
    return (
        f"The 40° cone is covered to {full[3]:.0f} % as the full angle and {half[3]:.0f} % as the "
        f"half angle, worst condition {full[5]:.2f} and {half[5]:.2f}; the paper does not give "
        "the tilts θ10 and θ20: 25° and 30° are assumed.",
        f"Closure of t where D ≥ 0.01: worst {closed.rows[0][3]:.2g}; of β: {closed.rows[2][3]:.2g}"
        " rad.",
        f"The closed form takes {ways.rows[0][2]:.0f} ns; Newton {ways.rows[1][3]:.1f} times as "
        f"long to the same residual, scipy.optimize.root {ways.rows[3][3]:.0f} times, and "
        f"{by_root / called:.0f} times the closed form called from Python as it is.",
        f"Over the 40° half angle cone {ENCODER_LINES} lines leave {condition.rows[4][2]:.2f}° by "
        f"counts and {condition.rows[4][3]:.2f}° by edges.",
        f"Upright, from the least to the most pretension: constant cables {constant[2]:.0f} to "
        f"{constant[3]:.0f} N·m/rad (softer), stiffening ones {stiffening[2]:.0f} to "
        f"{stiffening[3]:.0f}.",
        f"The remote centre gives {give:.2f} mm/N under a vertical force, with bars assumed.",
        f"Tensions cost {pulled.rows[0][4]:.0f} ns a tick, with a stiffness asked for "
        f"{pulled.rows[1][4]:.0f} ns.",
    )


STUDY: Final = Survey(
    measure=_measure,
)
