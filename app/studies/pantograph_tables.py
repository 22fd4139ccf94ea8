"""The tables of the study `pantograph`, and its formulas over arrays of poses."""

from collections.abc import Callable
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.geometry import Geometry
from app.mechanisms.lever import axis_kernel, tool_kernel
from app.mechanisms.pantograph.kernels import forward_kernel, inverse_kernel, jacobian_kernel
from app.mechanisms.pantograph.profile import PantographProfile
from app.mechanisms.pantograph.statics import felt_force, force_map, joint_torques, printed_force
from app.mechanisms.pantograph.system import needle_at
from app.studies import printed_formulas as printed
from app.studies.findings import Cell, Sheet
from app.studies.references.workspace import torque_per_newton


def disc(geometry: Geometry, tilt: float, points: int) -> FloatArray:
    """Tool points (n, 2) [m] on a square grid of `points` a side within a cone of `tilt` [rad]."""
    radius = geometry.fulcrum[2] * np.tan(tilt)
    line = np.linspace(-radius, radius, points)
    x, y = np.meshgrid(line, line)
    inside = np.hypot(x, y) <= radius
    return np.stack([x[inside], y[inside]], axis=1) + geometry.fulcrum[:2]


@njit
def _inverse(p3: FloatArray, a1: float, a2: float, base: float) -> FloatArray:
    q = np.full(p3.shape, np.nan)
    for k in range(len(p3)):
        status, left, right = inverse_kernel(p3[k, 0], p3[k, 1], a1, a2, base, 1.0, -1.0)
        if status == 0:
            q[k, 0], q[k, 1] = left, right
    return q


@njit
def _forward(q: FloatArray, a1: float, a2: float, base: float) -> FloatArray:
    p3 = np.full(q.shape, np.nan)
    for k in range(len(q)):
        status, x, y = forward_kernel(q[k, 0], q[k, 1], a1, a2, base, 1.0)
        if status == 0:
            p3[k, 0], p3[k, 1] = x, y
    return p3


@njit
def _jacobian(q: FloatArray, p3: FloatArray, a1: float, a2: float, base: float) -> FloatArray:
    out = np.full((len(q), 2, 2), np.nan)
    for k in range(len(q)):
        status, a, b, c, d = jacobian_kernel(q[k, 0], q[k, 1], p3[k, 0], p3[k, 1], a1, a2, base)
        if status == 0:
            out[k, 0, 0], out[k, 0, 1], out[k, 1, 0], out[k, 1, 1] = a, b, c, d
    return out


@njit
def _hub(p3: FloatArray, l_out: FloatArray, fx: float, fy: float, fz: float) -> FloatArray:
    hub = np.empty((len(p3), 3))
    for k in range(len(p3)):
        dx, dy, dz, _ = axis_kernel(p3[k, 0], p3[k, 1], fx, fy, fz)
        hub[k, 0] = fx - l_out[k] * dx
        hub[k, 1] = fy - l_out[k] * dy
        hub[k, 2] = fz - l_out[k] * dz
    return hub


@njit
def _tool(hub: FloatArray, fx: float, fy: float, fz: float) -> FloatArray:
    """P3 and L_out of hub points: (n, 3)."""
    out = np.full(hub.shape, np.nan)
    for k in range(len(hub)):
        status, x, y, _, l_out = tool_kernel(hub[k, 0], hub[k, 1], hub[k, 2], fx, fy, fz)
        if status == 0:
            out[k, 0], out[k, 1], out[k, 2] = x, y, l_out
    return out


@njit
def _closure(q: FloatArray, a1: float, a2: float, base: float) -> tuple[FloatArray, FloatArray]:
    """Forward, inverse in the pose's own mode, forward: errors (n, 2) [rad] and (n,) [m]."""
    angle, place = np.full(q.shape, np.nan), np.full(len(q), np.nan)
    for k in range(len(q)):
        q1, q2 = q[k, 0], q[k, 1]
        status, x, y = forward_kernel(q1, q2, a1, a2, base, 1.0)
        if status != 0:
            continue
        left = np.sin(q1) * (x + 0.5 * base) - np.cos(q1) * y
        right = np.sin(q2) * (x - 0.5 * base) - np.cos(q2) * y
        status, b1, b2 = inverse_kernel(x, y, a1, a2, base, np.sign(left), np.sign(right))
        if status != 0:
            continue
        angle[k, 0] = abs(np.arctan2(np.sin(b1 - q1), np.cos(b1 - q1)))
        angle[k, 1] = abs(np.arctan2(np.sin(b2 - q2), np.cos(b2 - q2)))
        status, u, v = forward_kernel(b1, b2, a1, a2, base, 1.0)
        if status == 0:
            place[k] = np.hypot(u - x, v - y)
    return angle, place


def inverse_many(geometry: Geometry, p3: FloatArray) -> FloatArray:
    """Joint angles (n, 2) of tool points (n, 2); NaN where there are none."""
    return np.asarray(_inverse(p3, *geometry.links))


def forward_many(geometry: Geometry, q: FloatArray) -> FloatArray:
    """Tool points (n, 2) of joint angles (n, 2); NaN where there are none."""
    return np.asarray(_forward(q, *geometry.links))


def jacobian_many(geometry: Geometry, q: FloatArray, p3: FloatArray) -> FloatArray:
    """Jacobians (n, 2, 2) of poses with their tool points; NaN where there are none."""
    return np.asarray(_jacobian(q, p3, *geometry.links))


def closure(geometry: Geometry, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Closure errors of poses (n, 2) in their own working mode: per joint (n, 2) [rad] after
    forward and inverse, and of the tool (n,) [m] after one more forward; NaN where FKM fails.
    """
    angle, place = _closure(q, *geometry.links)
    return np.asarray(angle), np.asarray(place)


def hub_many(geometry: Geometry, p3: FloatArray, l_out: FloatArray) -> FloatArray:
    """Hub points P_u (n, 3) of tool points (n, 2) and L_out (n,)."""
    return np.asarray(_hub(p3, l_out, *geometry.fulcrum_xyz))


def tool_many(geometry: Geometry, hub: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Tool points (n, 2) and L_out (n,) of hub points (n, 3)."""
    found = _tool(hub, *geometry.fulcrum_xyz)
    return np.ascontiguousarray(found[:, :2]), np.ascontiguousarray(found[:, 2])


def elbows_apart(geometry: Geometry, q: FloatArray) -> FloatArray:
    """Vector from elbow to elbow l22' (n, 2) [m]."""
    a1, _, base = geometry.links
    return np.stack(
        [
            base + a1 * (np.cos(q[:, 1]) - np.cos(q[:, 0])),
            a1 * (np.sin(q[:, 1]) - np.sin(q[:, 0])),
        ],
        axis=1,
    )


def wrapped(angle: FloatArray) -> FloatArray:
    """Angles in (-π, π]."""
    return np.asarray(np.arctan2(np.sin(angle), np.cos(angle)))


POSES: Final = 1_000_000
TILTS_DEG: Final = (30.0, 39.0, 45.0)
GRID: Final = 501
_STEP: Final = 1e-6  # [rad] of the central differences
_WANTED: Final = 2.0  # [N]


def printed_lever(geometry: Geometry, p3: FloatArray) -> FloatArray:
    """L_out = C - L_in of tool points [m], (n,)."""
    reach = np.linalg.norm(p3 - geometry.fulcrum[:2], axis=1)
    return np.asarray(geometry.needle_length - np.hypot(reach, geometry.fulcrum[2]))


def closures(geometry: Geometry) -> Sheet:
    """Closure of five-bar and complete system, and the Jacobian by central differences."""
    random = np.random.default_rng(24)
    q = random.uniform(-np.pi, np.pi, (POSES, 2))
    angle, place = closure(geometry, q)
    apart = np.linalg.norm(elbows_apart(geometry, q), axis=1)
    p3 = disc(geometry, np.deg2rad(45.0), GRID)
    inside, inside_place = closure(geometry, inverse_many(geometry, p3))
    hub_angle, hub_place, depth = _system(geometry, p3, random)
    rows = [
        _row("all poses: q1, forward and inverse", "rad", angle[:, 0]),
        _row("all poses: q2, forward and inverse", "rad", angle[:, 1]),
        _row("all poses: P3, once more forward", "m", place[apart > 1e-6]),
        _row("45° cone: q1", "rad", inside[:, 0]),
        _row("45° cone: q2", "rad", inside[:, 1]),
        _row("45° cone: P3", "m", inside_place),
        _row("complete system: Q to P_u to Q", "rad", hub_angle),
        _row("complete system: P_u to Q to P_u", "m", hub_place),
        _row("complete system: L_out", "m", depth),
        _row("45° cone: Jacobian against differences, relative", "-", _differences(geometry, p3)),
    ]
    return Sheet(
        "closure",
        "Closure errors (thesis, figures 24 to 26)",
        ("what", "unit", "poses", "without an answer", "median", "largest"),
        tuple(rows),
    )


def _row(what: str, unit: str, error: FloatArray) -> tuple[Cell, ...]:
    error = np.abs(error)
    missing = int(np.isnan(error).sum())
    return what, unit, len(error), missing, float(np.nanmedian(error)), float(np.nanmax(error))


def _system(
    geometry: Geometry, p3: FloatArray, random: np.random.Generator
) -> tuple[FloatArray, FloatArray, FloatArray]:
    q = inverse_many(geometry, p3)
    l_out = random.uniform(0.02, geometry.needle_length, len(p3))  # as the cameras measure it
    hub = hub_many(geometry, p3, l_out)
    tool, length = tool_many(geometry, hub)
    again = inverse_many(geometry, tool)
    closed = hub_many(geometry, forward_many(geometry, again), length)
    angle = np.abs(wrapped(again - q)).max(axis=1)
    return angle, np.linalg.norm(closed - hub, axis=1), length - l_out


def _differences(geometry: Geometry, p3: FloatArray) -> FloatArray:
    q = inverse_many(geometry, p3)
    exact = jacobian_many(geometry, q, p3)
    columns = [
        (forward_many(geometry, q + step) - forward_many(geometry, q - step)) / (2.0 * _STEP)
        for step in (np.array([_STEP, 0.0]), np.array([0.0, _STEP]))
    ]
    error = np.abs(np.stack(columns, axis=2) - exact).max(axis=(1, 2))
    return np.asarray(error / np.abs(exact).max(axis=(1, 2)))


def singular_places(geometry: Geometry) -> Sheet:
    """Return where the elbows coincide (l22' = 0), found by Newton's method from 400 starting
    poses.
    """
    random = np.random.default_rng(22)
    q = random.uniform(-np.pi, np.pi, (400, 2))
    a1 = geometry.links[0]
    for _ in range(60):
        miss = elbows_apart(geometry, q)
        slope = a1 * np.array(
            [[np.sin(q[:, 0]), -np.sin(q[:, 1])], [-np.cos(q[:, 0]), np.cos(q[:, 1])]]
        )
        square = np.einsum("ijn,ikn->njk", slope, slope) + 1e-12 * np.eye(2)  # Levenberg
        step = np.linalg.solve(square, np.einsum("ijn,ni->nj", slope, miss)[:, :, None])[:, :, 0]
        q = q - np.clip(step, -0.5, 0.5)
    q = wrapped(q)
    left = np.linalg.norm(elbows_apart(geometry, q), axis=1)
    found = np.unique(np.round(q[left < 1e-12], 9), axis=0)
    rows: list[tuple[Cell, ...]] = []
    for place in found:
        near = place + np.array([1e-9, 0.0])
        rows.append(
            (
                float(np.rad2deg(place[0])),
                float(np.rad2deg(place[1])),
                "above the motors" if np.sin(place[0]) > 0.0 else "below the motors (mirror image)",
                int((np.abs(wrapped(q - place)).max(axis=1) < 1e-6).sum()),
                float(closure(geometry, near[None, :])[1][0]),
            )
        )
    rows.append(("all others", "", "not singular", int((left >= 1e-12).sum()), ""))
    return Sheet(
        "singular",
        "Where forward kinematics fails: l22' = 0",
        ("q1 [°]", "q2 [°]", "elbows meet", "starts that ended there", "P3 1e-9 rad beside [m]"),
        tuple(rows),
    )


Errors = Callable[[FloatArray, FloatArray], FloatArray]


def wrong_formulas(geometry: Geometry) -> dict[str, tuple[str, str, Errors]]:
    """Name printed and coded formulas: to (errata entry, unit, errors (n,) of (p3, q))."""

    def hub(p3: FloatArray) -> FloatArray:
        return hub_many(geometry, p3, printed_lever(geometry, p3))

    def by_joint(angle: Callable[[Geometry, FloatArray], FloatArray], joint: int) -> Errors:
        return lambda p3, q: np.abs(wrapped(angle(geometry, p3) - q[:, joint]))

    def by_tool(tool: Callable[[Geometry, FloatArray], FloatArray]) -> Errors:
        return lambda p3, q: np.abs(
            wrapped(inverse_many(geometry, tool(geometry, hub(p3))) - q)
        ).max(axis=1)

    def largest(entries: FloatArray, q: FloatArray, p3: FloatArray) -> FloatArray:
        return np.asarray(np.abs(entries - jacobian_many(geometry, q, p3)).max(axis=(1, 2)))

    return {
        "thesis, inverse, q1": ("A5", "rad", by_joint(printed.printed_left_angle, 0)),
        "thesis 4.3, inverse, q2": ("A4", "rad", by_joint(printed.printed_right_angle, 1)),
        "thesis 4.7, Jacobian": (
            "A3",
            "m/rad",
            lambda p3, q: largest(printed.printed_jacobian(geometry, q, p3), q, p3),
        ),
        "thesis 4.2.4, system inverse": ("A6", "rad", by_tool(printed.printed_tool_point)),
        "thesis 4.5 and code, system inverse": (
            "A7",
            "rad",
            by_tool(printed.printed_display_point),
        ),
        "code, inverse, q1": ("-", "rad", by_joint(printed.code_left_angle, 0)),
        "code, inverse, q2": ("-", "rad", by_joint(printed.code_right_angle, 1)),
        "code, Jacobian": (
            "-",
            "m/rad",
            lambda p3, q: largest(printed.code_jacobian(geometry, q), q, p3),
        ),
    }


def printed_errors(geometry: Geometry) -> Sheet:
    """Errors of every printed or coded formula over the cones; NaN (no answer) is counted."""
    rows: list[tuple[Cell, ...]] = []
    for name, (entry, unit, errors) in wrong_formulas(geometry).items():
        cells: list[Cell] = [name, entry, unit]
        for tilt in TILTS_DEG:
            p3 = disc(geometry, np.deg2rad(tilt), GRID)
            found = errors(p3, inverse_many(geometry, p3))
            cells.append(float(np.nanmax(found)))
        rows.append((*cells, float(np.nanmedian(found)), int(np.isnan(found).sum())))
    headings = tuple(f"largest, {tilt:g}° cone" for tilt in TILTS_DEG)
    return Sheet(
        "printed",
        "Errors of the formulas as printed and as in the laboratory's public code",
        ("formula", "errata", "unit", *headings, "median, 45°", "no answer, 45°"),
        tuple(rows),
    )


def forces(profile: PantographProfile) -> Sheet:
    """Tool force and torques for 2 N at the hand in the tilt plane, by both laws."""
    geometry, rows = profile.pantograph, []
    for tilt_deg in (0.0, 10.0, 20.0, 30.0, 39.0, 45.0):
        tilt = np.deg2rad(tilt_deg)
        p3 = geometry.fulcrum[:2] + np.array([0.0, -geometry.fulcrum[2] * np.tan(tilt)])
        needle = needle_at(geometry, p3)
        force = _WANTED * np.array([0.0, np.cos(tilt), -np.sin(tilt)])  # across the needle
        q = inverse_many(geometry, p3[None, :])
        jacobian = jacobian_many(geometry, q, p3[None, :])[0]
        right, printed = force_map(needle, force), printed_force(needle, force)
        torques = joint_torques(jacobian, right)
        rows.append(
            (
                tilt_deg,
                float(right[1]),
                float(printed[1]),
                float(np.linalg.norm(felt_force(needle, printed))),
                *torques.tolist(),
                float(np.linalg.norm(felt_force(needle, right) - force)),
            )
        )
    return Sheet(
        "forces",
        "2 N wanted at the hand, needle tilted towards the motors, force in the tilt plane",
        (
            "tilt [°]",
            "tool force, virtual work [N]",
            "tool force, printed 4.12 [N]",
            "felt with 4.12 [N]",
            "left torque [N·m]",
            "right torque [N·m]",
            "felt minus wanted [N]",
        ),
        tuple(rows),
    )


def torques(profile: PantographProfile, step: float = 0.010) -> Sheet:
    """Torque that the hand's largest force needs at each measured depth, and what can be had.

    Args:
        profile: of a robot; its depth range, tilt limit and limits.
        step: of the depths [m].
    """
    geometry, limits = profile.pantograph, profile.limits
    low, high = profile.depth_range
    rows: list[tuple[Cell, ...]] = []
    for depth in np.arange(low, high + 0.5 * step, step).tolist():
        cells: list[Cell] = [round(1e3 * depth, 6)]
        for tilt in (0.0, profile.tilt_limit):
            each = torque_per_newton(geometry, geometry.needle_length - depth, tilt)
            cells += [limits.hand_force * each, limits.joint_torque / each]
        rows.append(tuple(cells))
    force, torque = limits.hand_force, limits.joint_torque
    cone = f"cone of {np.degrees(profile.tilt_limit):g}°"
    return Sheet(
        "torque",
        f"{profile.name}: joint torque for {force:g} N at the hand, worst direction, and the force"
        f" that {torque:g} N·m can give everywhere (below {force:g} N it limits)",
        (
            "depth [mm]",
            f"upright, {force:g} N [N·m]",
            f"upright, {torque:g} N·m [N]",
            f"{cone}, {force:g} N [N·m]",
            f"{cone}, {torque:g} N·m [N]",
        ),
        tuple(rows),
    )
