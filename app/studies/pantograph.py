"""Study: the thesis' validation of the pantograph (figures 24 to 27), redone with numbers.

Forward and inverse kinematics close on each other everywhere but at one place; so does the complete
system. Beside each: the error of the formulas as the thesis prints them and as the laboratory's
public code has them. At the end: what joint torque the largest force at the hand needs by depth.
"""

from collections.abc import Callable
from functools import partial
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph.profile import PantographProfile, load_pantograph
from app.mechanisms.pantograph.statics import force_map, joint_torques, printed_force
from app.mechanisms.pantograph.system import needle_at
from app.studies import pantograph_tables
from app.studies.findings import Figure, Findings, Sheet, Survey
from app.studies.pantograph_tables import (
    closure,
    disc,
    elbows_apart,
    forward_many,
    hub_many,
    inverse_many,
    jacobian_many,
    printed_lever,
    tool_many,
    wrong_formulas,
)

DECLARATION: Final[dict[str, Any]] = {
    "title": "The pantograph's formulas: closure, and the errors of the printed ones",
    "question": "Are the formulas right, everywhere? How wrong are the printed ones?",
    "reference": "each map against its inverse, derivatives against differences; icube geometry",
}


_TILT: Final = float(np.deg2rad(45.0))
_LEAST: Final = 1e-18  # an error of exactly zero is drawn here
_BLUE: Final = "#0072B2"
_RED: Final = "#D55E00"


def joints(figure: Any, geometry: Geometry) -> None:
    """Figure 24: closure per joint over all joint angles, and the distance of the elbows."""
    line = np.linspace(-np.pi, np.pi, 401)
    q1, q2 = np.meshgrid(line, line)
    q = np.stack([q1.ravel(), q2.ravel()], axis=1)
    angle, _ = closure(geometry, q)
    apart = np.linalg.norm(elbows_apart(geometry, q), axis=1)
    rim = inverse_many(geometry, _rim(geometry))
    meeting = np.rad2deg(np.arccos(0.5 * geometry.links[2] / geometry.links[0]))
    panels = (
        ("|Δq1| [rad]", _exponent(angle[:, 0])),
        ("|Δq2| [rad]", _exponent(angle[:, 1])),
        ("distance of the elbows l22' [m]", _exponent(apart)),
    )
    degrees = np.rad2deg(line)
    for number, (title, values) in enumerate(panels):
        axes = figure.add_subplot(1, 3, number + 1)
        shown = axes.pcolormesh(
            degrees, degrees, values.reshape(q1.shape), shading="nearest", rasterized=True
        )
        figure.colorbar(shown, ax=axes, shrink=0.55, label="log10")
        axes.plot(*np.rad2deg((rim + np.pi) % (2.0 * np.pi) - np.pi).T, ",", color="white")
        axes.plot([meeting], [180.0 - meeting], "x", color=_RED, markersize=9, markeredgewidth=2)
        axes.plot([-meeting], [meeting - 180.0], "x", color="#999999", markersize=7)
        axes.set(xlabel="q1 [°]", ylabel="q2 [°]", aspect="equal")
        axes.set_title(title, fontsize=9)
    figure.suptitle(
        "Forward, then inverse: error per joint. Red cross: elbows meet at "
        f"q1 = {meeting:.3f}°, q2 = 180° - q1 (grey: its mirror image below the motors); "
        "white: rim of the 45° cone; ridges: an arm stretched or folded",
        fontsize=9,
    )
    figure.tight_layout()


def workspace(figure: Any, geometry: Geometry) -> None:
    """Figure 25: errors of the inverse over the 45° cone, as used, as printed, as coded."""
    p3 = disc(geometry, _TILT, 241)
    q = inverse_many(geometry, p3)
    found = np.linalg.norm(forward_many(geometry, q) - p3, axis=1)
    panels = [("used here: inverse, forward [m]", found)]
    formulas = wrong_formulas(geometry)
    for name in (
        "thesis, inverse, q1",
        "thesis 4.3, inverse, q2",
        "code, inverse, q2",
        "thesis 4.7, Jacobian",
        "code, Jacobian",
    ):
        _, unit, errors = formulas[name]
        panels.append((f"{name} [{unit}]", errors(p3, q)))
    _maps(figure, p3, panels, (2, 3))


def system(figure: Any, geometry: Geometry) -> None:
    """Figure 26: closure of the complete system over the 45° cone, and the printed formulas."""
    p3 = disc(geometry, _TILT, 241)
    q = inverse_many(geometry, p3)
    hub = hub_many(geometry, p3, printed_lever(geometry, p3))
    tool, l_out = tool_many(geometry, hub)
    closed = hub_many(geometry, forward_many(geometry, inverse_many(geometry, tool)), l_out)
    panels = [("used here: P_u, Q, P_u [m]", np.linalg.norm(closed - hub, axis=1))]
    formulas = wrong_formulas(geometry)
    for name in ("thesis 4.2.4, system inverse", "thesis 4.5 and code, system inverse"):
        panels.append((f"{name} [rad]", formulas[name][2](p3, q)))
    _maps(figure, p3, panels, (1, 3))


def _maps(
    figure: Any, p3: FloatArray, panels: list[tuple[str, FloatArray]], shape: tuple[int, int]
) -> None:
    for number, (title, values) in enumerate(panels):
        axes = figure.add_subplot(*shape, number + 1)
        logarithmic = bool(np.nanmax(values) < 1e-6)
        colours = _exponent(values) if logarithmic else values
        shown = axes.scatter(*(p3.T / MILLIMETRE), c=colours, s=1.2, marker="s", rasterized=True)
        figure.colorbar(shown, ax=axes, shrink=0.7, label="log10" if logarithmic else "")
        axes.set_title(f"{title}\nlargest {np.nanmax(values):.3g}", fontsize=8)
        axes.set(aspect="equal", xlabel="x of P3 [mm]", ylabel="y of P3 [mm]")
    figure.tight_layout()


def vectors(figure: Any, geometry: Geometry) -> None:
    """Figure 27: forces and torques for 2 N at the hand, in the plane of the links."""
    plan, bars = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2)
    foot = geometry.fulcrum[:2]
    for tilt_deg in (10.0, 20.0, 30.0, 40.0):
        radius = geometry.fulcrum[2] * np.tan(np.deg2rad(tilt_deg))
        for azimuth in np.deg2rad(np.arange(0.0, 360.0, 30.0)):
            p3 = foot + radius * np.array([np.cos(azimuth), np.sin(azimuth)])
            right, printed, torques = _pulled_upright(geometry, p3)
            for law, colour, width in ((printed, _RED, 0.004), (right, _BLUE, 0.006)):
                plan.quiver(*(p3 / MILLIMETRE), *law, color=colour, width=width, **_ARROWS)
            bars.plot(tilt_deg, torques[0], "o", color=_BLUE, markersize=4)
            bars.plot(tilt_deg + 1.0, torques[1], "s", color="#009E73", markersize=4)
    plan.plot(*(foot / MILLIMETRE), "+", color="black")
    plan.set(aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    plan.set_title(
        "force at P3 for 2 N at the hand that rights the needle\n"
        "blue: virtual work; red: printed 4.12 (longer: too strong)",
        fontsize=9,
    )
    bars.set(xlabel="tilt [°]", ylabel="joint torque [N·m]")
    bars.set_title("torques by virtual work; blue: left motor, green: right motor", fontsize=9)
    bars.grid(True, color="#DDDDDD")
    figure.tight_layout()


_ARROWS: Final[dict[str, Any]] = {"angles": "xy", "scale_units": "xy", "scale": 0.2}


def _pulled_upright(
    geometry: Geometry, p3: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    needle = needle_at(geometry, p3)
    up = np.array([0.0, 0.0, -1.0]) - needle.axis * -needle.axis[2]
    force = -2.0 * up / np.linalg.norm(up)
    q = inverse_many(geometry, p3[None, :])
    jacobian = jacobian_many(geometry, q, p3[None, :])[0]
    right = force_map(needle, force)
    return right, printed_force(needle, force), joint_torques(jacobian, right)


def torque(figure: Any, profile: PantographProfile, sheet: Sheet) -> None:
    """Torque for the largest force at the hand over the measured depth, and the force to be had."""
    table = np.array(sheet.rows, dtype=np.float64)
    limits = profile.limits
    need, have = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2)
    names = ("upright", f"cone of {np.degrees(profile.tilt_limit):g}°")
    for number, (name, colour) in enumerate(zip(names, (_BLUE, _RED), strict=True)):
        style = "-" if number == 0 else "--"
        need.plot(table[:, 0], table[:, 1 + 2 * number], style, color=colour, label=name)
        most = np.minimum(table[:, 2 + 2 * number], limits.hand_force)
        have.plot(table[:, 0], most, style, color=colour, label=name)
    need.axhline(limits.joint_torque, color="#777777", linestyle=":", label="limit of the profile")
    need.set(ylabel=f"joint torque for {limits.hand_force:g} N at the hand [N·m]")
    have.axhline(limits.hand_force, color="#777777", linestyle=":", label="limit of the profile")
    have.set(ylabel=f"force at the hand for {limits.joint_torque:g} N·m [N]")
    for axes in (need, have):
        axes.set(xlabel="depth of the tip beyond the fulcrum, measured [mm]")
        axes.set_ylim(bottom=0.0)
        axes.grid(True, color="#DDDDDD", linewidth=0.5)
        axes.legend(fontsize=8)
    figure.suptitle(f"{profile.name}: worst direction of the force and of the needle", fontsize=10)
    figure.tight_layout()


def _exponent(values: FloatArray) -> FloatArray:
    return np.asarray(np.log10(np.maximum(np.abs(values), _LEAST)))


def _rim(geometry: Geometry) -> FloatArray:
    radius, turn = geometry.fulcrum[2] * np.tan(_TILT), np.linspace(0.0, 2.0 * np.pi, 2000)
    return np.asarray(
        geometry.fulcrum[:2] + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    )


_DEVICE: Final = "icube"


def _measure(progress: Progress | None) -> Findings:
    profile = load_pantograph(_DEVICE)
    geometry = profile.pantograph
    steps: tuple[tuple[str, Callable[[], Sheet]], ...] = (
        ("closure", lambda: pantograph_tables.closures(geometry)),
        ("singular place", lambda: pantograph_tables.singular_places(geometry)),
        ("printed formulas", lambda: pantograph_tables.printed_errors(geometry)),
        ("forces", lambda: pantograph_tables.forces(profile)),
        ("torques", lambda: pantograph_tables.torques(profile)),
    )
    sheets: list[Sheet] = []
    for number, (name, step) in enumerate(steps):
        if progress is not None:
            progress.report(number / len(steps), name)
        sheets.append(step())
    return Findings(
        tuple(sheets),
        (
            Figure("joints", partial(joints, geometry=geometry), (13.0, 4.6)),
            Figure("workspace", partial(workspace, geometry=geometry), (12.0, 7.5)),
            Figure("system", partial(system, geometry=geometry), (12.0, 4.0)),
            Figure("vectors", partial(vectors, geometry=geometry), (11.0, 5.2)),
            Figure(
                "torque",
                partial(torque, profile=profile, sheet=sheets[-1]),
                (10.0, 4.2),
            ),
        ),
        _lines(*sheets),
    )


def _lines(
    closure: Sheet, singular: Sheet, printed: Sheet, forces: Sheet, torques: Sheet
) -> tuple[str, ...]:
    tool = next(row for row in closure.rows if str(row[0]).startswith("all poses: P3"))
    skin = next(row for row in torques.rows if row[0] == 0.0)
    place = next(row for row in singular.rows if str(row[2]).startswith("above"))
    worst = max(printed.rows, key=lambda row: float(row[5]) if row[2] == "rad" else 0.0)
    return (
        f"Forward, inverse, forward over {tool[2]} poses: median {tool[4]:.2g} m, "
        f"worst {tool[5]:.2g} m.",
        f"Forward kinematics fails at one place above the motors: q1 = {place[0]:.3f}°, "
        f"q2 = {place[1]:.3f}° (and at its mirror image); neither lies in the 45° cone.",
        f"The largest error of a printed or coded formula: {worst[0]}, {worst[5]:.3g} rad.",
        f"2 N wanted at 45°: the printed law 4.12 gives {forces.rows[-1][3]:.3f} N.",
        f"5 N at the skin need {skin[1]:.3f} N·m upright, {skin[3]:.3f} N·m over the cone; the "
        f"profile's torque gives {skin[4]:.2f} N there in the worst direction.",
    )


STUDY: Final = Survey(
    measure=_measure,
)
