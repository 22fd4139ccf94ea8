"""Study: the machines that point a needle, side by side: reach, resolution, stiffness, force, cost.

All are asked the same: the needle pointed at by rings of directions about the vertical, hub 110 mm
above the remote centre, tip 90 mm below it; the worst direction of each ring counts. A further
machine is a file in `comparisons/`, here or in a folder of plug-ins, that defines `COMPARISON`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from importlib import import_module
from itertools import product
from pkgutil import iter_modules
from typing import Any, Final

import numpy as np

from app.core import plugin_folders
from app.core.arrays import FloatArray, cross, unit
from app.core.compiled import njit
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.units import DEGREE, MILLIMETRE
from app.mechanisms.errors import MechanismError
from app.mechanisms.lever import axis_kernel, force_map_kernel, torque_kernel
from app.mechanisms.pantograph import (
    force_map,
    inverse,
    jacobian,
    joint_torques,
    needle_at,
)
from app.mechanisms.pantograph.kernels import forward_kernel, jacobian_kernel
from app.mechanisms.pantograph.profile import load_pantograph
from app.studies import comparisons as own
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey
from app.studies.timing import seconds

DECLARATION: Final[dict[str, Any]] = {
    "title": "The machines side by side: workspace, resolution, stiffness, force, effort, cost",
    "question": "What is each machine good at?",
    "reference": "the same directions and forces for all; estimates and assumptions named",
}

L_OUT: Final = 0.110
"""From the remote centre to the hub [m]."""

DEPTH: Final = 0.090
"""From the remote centre to the tip [m]."""

TILTS_DEG: Final = (0.0, 10.0, 20.0, 30.0, 39.0, 45.0)
_RING: Final = 24
_TURNS: Final = 36
_COLOURS: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")
_DASHES: Final = ("o-", "s--", "^:", "v-.")


@dataclass(frozen=True, slots=True)
class ComparedMachine:
    """What a machine is asked; d is the needle's direction from hub to tip, shape (3,).

    Attributes:
        name: for tables.
        said: what its numbers rest on.
        turning: d -> dd/dq [1/rad], shape (3, n), of motions with the needle in the centre.
        tip: d -> motion of the tip per angle of each joint [m/rad], shape (3, n).
        step: by which a joint is measured [rad].
        efforts: (d, force at the hub [N], shape (3,)) -> what the actuators give, any shape.
        unit: of an effort.
        force: d -> largest force that the hand can be made to feel in its worst direction [N].
        stiffness: d -> of the hub in its softest direction [N/m].
        stiff_by: what gives that stiffness.
        tick: what a tick computes, and how often a call of it does so: pose, Jacobian, efforts.

    `turning`, `tip`, `efforts`, `force` and `stiffness` raise a `MechanismError` out of reach.
    """

    name: str
    said: str
    turning: Callable[[FloatArray], FloatArray]
    tip: Callable[[FloatArray], FloatArray]
    step: float
    efforts: Callable[[FloatArray, FloatArray], FloatArray]
    unit: str
    force: Callable[[FloatArray], float]
    stiffness: Callable[[FloatArray], float]
    stiff_by: str
    tick: Callable[[], tuple[Callable[[], object], int]]


@dataclass(frozen=True, slots=True)
class ComparedPlugin:
    """A further machine.

    Attributes:
        title: what it is, for whoever waits: "the arm".
        make: makes what is asked of it.
        more: makes tables and lines of this machine alone, if there are any.
    """

    title: str
    make: Callable[[], ComparedMachine]
    more: Callable[[], tuple[tuple[Sheet, ...], tuple[str, ...]]] | None = None


def ring(tilt: float, count: int = _RING) -> FloatArray:
    """Needle directions (n, 3), hub to tip, at a tilt from the vertical [rad]."""
    turn = np.linspace(0.0, 2.0 * np.pi, count if tilt > 0.0 else 1, endpoint=False)
    flat = np.sin(tilt)
    return np.stack(
        [flat * np.cos(turn), flat * np.sin(turn), np.full(len(turn), -np.cos(tilt))], axis=1
    )


def across(d: FloatArray) -> FloatArray:
    """Return unit vectors (n, 3) across the needle, all around it."""
    first = unit(cross(d, np.array((0.8, 0.6, 0.0))))
    turn = np.linspace(0.0, 2.0 * np.pi, _TURNS, endpoint=False)[:, None]
    return np.asarray(np.cos(turn) * first + np.sin(turn) * cross(d, first))


@njit
def _pantograph_often(
    q: FloatArray, links: Any, fulcrum: Any, l_out: float, out: FloatArray
) -> None:
    for k in range(len(q)):
        _, x, y = forward_kernel(q[k, 0], q[k, 1], links[0], links[1], links[2], 1.0)
        dx, dy, dz, l_in = axis_kernel(x, y, *fulcrum)
        _, a, b, c, d = jacobian_kernel(q[k, 0], q[k, 1], x, y, links[0], links[1], links[2])
        gx, gy = force_map_kernel(1.0, -0.5, 0.2, dx, dy, dz, l_in, l_out)
        out[k, 0], out[k, 1] = torque_kernel(gx, gy, a, b, c, d)


def _pantograph() -> ComparedMachine:
    profile = load_pantograph("icube")
    geometry = profile.pantograph
    foot, height = geometry.fulcrum[:2], float(geometry.fulcrum[2])

    def tool(d: FloatArray) -> FloatArray:
        if np.hypot(d[0], d[1]) > -d[2] * np.tan(profile.tilt_limit) * (1.0 + 1e-12):
            raise MechanismError(
                sentence(
                    "unreachable: the ball joint stops at {profile_tilt_limit_deg:g}° of tilt",
                    profile_tilt_limit_deg=profile.tilt_limit_deg,
                )
            )
        return np.asarray(foot - d[:2] / d[2] * height)

    def turning(d: FloatArray) -> FloatArray:
        by_tool = (np.eye(3) - np.outer(d, d))[:, :2] * -d[2] / height
        return np.asarray(by_tool @ jacobian(geometry, inverse(geometry, tool(d))))

    def efforts(d: FloatArray, force: FloatArray) -> FloatArray:
        p3 = tool(d)
        gamma = force_map(needle_at(geometry, p3, L_OUT), force)
        return joint_torques(jacobian(geometry, inverse(geometry, p3)), gamma)

    def most(d: FloatArray) -> float:
        each = max(float(np.abs(efforts(d, way)).max()) for way in across(d))
        return min(profile.limits.joint_torque / each, profile.limits.hand_force)

    def stiffness(d: FloatArray) -> float:
        tool(d)
        return float(profile.fixture.stiffness) / L_OUT

    def tick() -> tuple[Callable[[], object], int]:
        poses = np.concatenate([ring(np.deg2rad(tilt)) for tilt in TILTS_DEG[:-1]])
        q = np.tile([inverse(geometry, tool(d)) for d in poses], (50, 1))
        out = np.empty((len(q), 2))
        call = partial(_pantograph_often, q, geometry.links, geometry.fulcrum_xyz, L_OUT, out)
        return call, len(q)

    return ComparedMachine(
        "pantograph (icube)",
        "lengths and encoders published, torque limit estimated; force within the profile's limit",
        turning,
        lambda d: DEPTH * turning(d),
        2.0 * np.pi / profile.encoder.counts_per_turn,
        efforts,
        "N·m",
        most,
        stiffness,
        "the loop, with the profile's fixture: its motors give torque, not place",
        tick,
    )


@cache
def machines() -> tuple[ComparedMachine, ...]:
    """Return the machines that are compared."""
    return tuple(make() for make in (_pantograph, *(one.make for one in comparisons())))


def comparisons() -> tuple[ComparedPlugin, ...]:
    """Return further machines: those of this room, then those of folders of plug-ins."""
    names = [f"{own.__name__}.{info.name}" for info in iter_modules(own.__path__)]
    modules = [*map(import_module, names), *plugin_folders.modules("comparisons")]
    found = (getattr(one, "COMPARISON", None) for one in modules)
    return tuple(one for one in found if isinstance(one, ComparedPlugin))


def at_tilt(machine: ComparedMachine, tilt: float) -> dict[str, float]:
    """Worst of a ring of directions at a tilt [rad]; NaN where some of the ring is out of reach.

    Returns:
        `reached` share; `condition` of dd/dq; `resolution` at the tip [m], half a step of all
        joints in the worst combination; `force` [N]; `effort` for 1 N; `stiffness` [N/m].
    """
    found: list[tuple[float, ...]] = []
    poses = ring(tilt)
    for d in poses:
        try:
            values = np.linalg.svd(machine.turning(d), compute_uv=False)
            tip = machine.tip(d)
            corners = 0.5 * machine.step * np.array([*product((1.0, -1.0), repeat=tip.shape[1])]).T
            found.append(
                (
                    float(values[0] / values[1]),  # a direction has two ways to turn
                    float(np.linalg.norm(tip @ corners, axis=0).max()),
                    -machine.force(d),
                    max(float(np.abs(machine.efforts(d, way)).max()) for way in across(d)),
                    -machine.stiffness(d),
                )
            )
        except MechanismError:
            continue
    names = ("condition", "resolution", "force", "effort", "stiffness")
    worst = np.max(found, axis=0) if len(found) == len(poses) else np.full(len(names), np.nan)
    return {"reached": len(found) / len(poses)} | {
        name: abs(float(value)) for name, value in zip(names, worst, strict=True)
    }


def by_tilt() -> Sheet:
    """Every machine at every tilt."""
    rows: list[tuple[Cell, ...]] = []
    for machine in machines():
        for tilt_deg in TILTS_DEG:
            found = at_tilt(machine, np.deg2rad(tilt_deg))
            rows.append(
                (
                    machine.name,
                    tilt_deg,
                    100.0 * found["reached"],
                    *(
                        "-" if np.isnan(value) else value
                        for value in (
                            found["condition"],
                            found["resolution"] / MILLIMETRE,
                            found["stiffness"],
                            found["force"],
                            found["effort"],
                        )
                    ),
                    machine.unit,
                )
            )
    return Sheet(
        "tilts",
        "Worst direction of each ring of tilts; - where not all of it is reached",
        (
            "machine",
            "tilt [°]",
            "reached [%]",
            "condition",
            "resolution at the tip [mm]",
            "stiffness at the hub [N/m]",
            "largest force at the hub [N]",
            "largest effort for 1 N",
            "unit",
        ),
        tuple(rows),
    )


def reach() -> Sheet:
    """Return how far each machine tilts all round, what its numbers rest on, what a tick costs."""
    times = seconds(*(machine.tick() for machine in machines()))
    rows: list[tuple[Cell, ...]] = []
    for machine, taken in zip(machines(), times, strict=True):
        rows.append(
            (
                machine.name,
                _all_round(machine),
                float(np.rad2deg(machine.step)),
                1e9 * taken,
                100.0 * taken / 1e-3,
                machine.stiff_by,
                machine.said,
            )
        )
    return Sheet(
        "machines",
        "The machines: reach in all directions, cost of a tick's pose, Jacobian and efforts",
        (
            "machine",
            "tilt reached all round [°]",
            "step of a joint [°]",
            "time of a tick [ns]",
            "share of 1 ms [%]",
            "stiffness by",
            "rests on",
        ),
        tuple(rows),
    )


def holds(machine: ComparedMachine, d: FloatArray) -> bool:
    """Return whether a machine can point the needle in a direction, shape (3,)."""
    try:
        machine.tip(d)
    except MechanismError:
        return False
    return True


def _all_round(machine: ComparedMachine) -> float:
    """Largest tilt [°] below which every ring is held: steps of 2.5°, then of 0.25° from there."""
    reached = 0.0
    for step, count in ((2.5, _RING), (0.25, 3 * _RING)):
        tilts = np.arange(reached, 90.0 + step, step)
        free = (t for t in tilts if not all(holds(machine, d) for d in ring(t * DEGREE, count)))
        reached = max(0.0, float(next(free, 90.0 + step)) - step)
    return reached


def by_turn(machine: ComparedMachine, step_deg: float = 2.5) -> FloatArray:
    """Tilt held from the vertical on [°], one for each turn of a ring, shape (24,)."""
    tilts = np.arange(0.0, 90.0, step_deg)
    rings = [ring(np.deg2rad(max(tilt, 1e-9)), _RING) for tilt in tilts]
    return np.array(
        [
            next(
                (
                    tilt
                    for tilt, poses in zip(tilts, rings, strict=True)
                    if not holds(machine, poses[k])
                ),
                90.0,
            )
            - step_deg
            for k in range(_RING)
        ]
    )


def draw(figure: Any) -> None:
    """Every quantity by tilt, one line a machine; the tilt that is reached, by turn."""
    tilts = np.arange(0.0, 60.5, 2.5)
    panels = (
        ("reached", 100.0, "directions reached [%]"),
        ("condition", 1.0, "condition of dd/dq"),
        ("resolution", 1.0 / MILLIMETRE, "resolution at the tip [mm]"),
        ("stiffness", 1e-3, "stiffness at the hub [N/mm]"),
        ("force", 1.0, "largest force at the hub [N]"),
        ("effort", 1.0, "largest effort for 1 N [N·m or N]"),
    )
    found = [[at_tilt(machine, np.deg2rad(tilt)) for tilt in tilts] for machine in machines()]
    for (name, scale, words), place in zip(panels, (1, 2, 3, 5, 6, 7), strict=True):
        axes = figure.add_subplot(2, 4, place)
        for machine, rows, colour, dash in zip(machines(), found, _COLOURS, _DASHES, strict=False):
            values = scale * np.array([row[name] for row in rows])
            axes.plot(tilts, values, dash, color=colour, markersize=3, label=machine.name)
        if name != "reached":
            axes.set_yscale("log")
        axes.set(xlabel="tilt [°]")
        axes.set_title(words, fontsize=9)
        axes.grid(True, color="#DDDDDD", linewidth=0.5)
    polar = figure.add_subplot(2, 4, 4, projection="polar")
    turns = np.linspace(0.0, 2.0 * np.pi, _RING + 1)
    for machine, colour, dash in zip(machines(), _COLOURS, _DASHES, strict=False):
        reached = by_turn(machine)
        polar.plot(turns, [*reached, reached[0]], dash, color=colour, markersize=3)
    polar.set_ylim(0.0, 90.0)
    polar.set_yticks([30.0, 60.0, 90.0])
    polar.set_title("tilt reached [°], by turn", fontsize=9)
    handles, names = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, names, fontsize=9, loc="center", bbox_to_anchor=(0.87, 0.27))
    figure.suptitle("Worst direction of each ring, hub 110 mm above, tip 90 mm below", fontsize=10)
    figure.tight_layout()


def _measure(progress: Progress | None) -> Findings:
    if progress is not None:
        progress.report(0.0, sentence("reach and cost"))
    overview = reach()
    if progress is not None:
        progress.report(0.3, sentence("by tilt"))
    tilts = by_tilt()
    sheets = [overview, tilts]
    lines = [
        f"{row[0]}: {row[1]:.1f}° all round, a tick's kinematics {row[3]:.0f} ns."
        for row in overview.rows
    ]
    for machine in machines():
        upright = next(row for row in tilts.rows if row[:2] == (machine.name, 0.0))
        lines.append(
            f"{machine.name}, upright: {float(upright[4]):.3f} mm at the tip, "
            f"{float(upright[5]):.0f} N/m at the hub by {machine.stiff_by}; "
            f"{float(upright[6]):.1f} N at most, 1 N needs {float(upright[7]):.3g} {machine.unit}."
        )
    for one in comparisons():
        if one.more is None:
            continue
        if progress is not None:
            progress.report(0.6, one.title)
        more, said = one.more()
        sheets += more
        lines += said
    return Findings(tuple(sheets), (Figure("tilts", draw, (16.0, 7.0)),), tuple(lines))


STUDY: Final = Survey(
    measure=_measure,
)
