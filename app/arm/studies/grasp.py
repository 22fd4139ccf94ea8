"""Study: how well a grasp closes, and which way finds it: closed form, hull, linear programmes.

Grasps of two and three contacts in the plane, and those of the hand on a tool of 5 mm. The margin
is the largest wrench that is resisted while the normal forces sum to 1 N; what a tool needs to be
held is its load over the margin, so that a share of the margin is a share of the force.

Beside it: the margin of the hand over friction and over the pose of the tool in it, the cone's
edges, where the fingers reach, and the firm grasp of the paper's figure 5.
"""

from collections.abc import Callable
from itertools import combinations
from math import cos, pi, radians, sin
from typing import Any, Final

import numpy as np

from app.arm.hand import (
    ClosureWay,
    Contacts,
    FirmGrasp,
    Grasp,
    GraspError,
    HandFinger,
    Lever,
    SoftContact,
    ToolShaft,
    close_hand,
    force_closure,
    forward,
    heights,
    hull_margin,
    load_hand,
    pair_closed,
    pair_margin,
    press,
    programme_margin,
    shot,
    wrenches,
)
from app.core.arrays import FloatArray
from app.core.units import DEGREE, MILLIMETRE
from app.studies.findings import Cell, Figure, Findings, Sheet
from app.studies.in_use import default_of
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Grasp: closed form, convex hull, linear programmes, directions tried",
    "question": "How well does a grasp close, and how is it found?",
    "reference": "every plane through as many rays as there are dimensions, tried; 1e-12",
}

PROFILE: Final = load_hand()
HAND: Final = PROFILE.hand
DIAMETER: Final = 5e-3  # of a laparoscopic tool [m]
SOFT: Final = 2e-3  # torque about the normal per normal force of a rubber pad [m]
FRICTIONS: Final = (0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0)
_DIRECTIONS: Final = (100, 1000, 10_000, 100_000)
_NOTICED: Final = 0.1
_RANDOM: Final = 150  # grasps on which the ways are compared
_SINGULAR: Final = 1e-12
_BESIDE: Final = 1e-9  # a ray so near a plane lies in it


def held(
    aside: float = 0.0, height: float | None = None, turned: float = 0.0, tilted: float = 0.0
) -> Grasp:
    """Return the hand closed on a tool that lies otherwise than planned, all in the hand's frame.

    Args:
        aside: along y, from the plane of the spread axes [m].
        height: of the tool above joint 2 [m]; as planned if left out.
        turned: about z, away from the palm [rad].
        tilted: about y, one end towards the palm [rad].

    Raises:
        GraspError: if the hand does not get hold of it.
    """
    z = heights(HAND, 0.5 * DIAMETER)[1] if height is None else height
    axis = (cos(turned) * cos(tilted), sin(turned) * cos(tilted), -sin(tilted))
    return close_hand(HAND, ToolShaft(np.array([0.0, aside, z]), np.array(axis), DIAMETER))


def _pair(aside_deg: float, friction: float) -> Contacts:
    """Two contacts 5 mm apart, the second one's normal turned aside."""
    turn = radians(180.0 - aside_deg)
    points = np.array([(-0.5 * DIAMETER, 0.0), (0.5 * DIAMETER, 0.0)])
    return Contacts(points, np.array([(1.0, 0.0), (cos(turn), sin(turn))]), friction)


def _three(friction: float) -> Contacts:
    turn = np.radians([90.0, 200.0, 340.0])
    points = 0.02 * np.column_stack([np.cos(turn), np.sin(turn)])
    return Contacts(points, -points, friction)


_GRASPS: Final[dict[str, tuple[Callable[[], Contacts], int]]] = {
    "pair, μ = 0.1": (lambda: _pair(0.0, 0.1), 2),
    "pair 20° aside, μ = 0.5": (lambda: _pair(20.0, 0.5), 2),
    "three in the plane, μ = 0.3": (lambda: _three(0.3), 2),
    "hand, μ = 0.3": (lambda: held().contacts(0.3), 8),
    "hand, μ = 0.5, soft, 4 mm aside": (lambda: held(aside=4e-3).contacts(0.5, SOFT), 4),
}
"""Name -> contacts, and edges of the cone in space."""


def every_facet(rays: FloatArray) -> float:
    """Margin by trying every plane through d of k rays, shape (k, d), and knowing no hull.

    A plane n · w = 1 bounds the hull if no ray is beyond it; the nearest one is the margin. If all
    rays are beyond one, the origin is outside: 0.
    """
    k, d = rays.shape
    corners = rays[np.array(list(combinations(range(k), d)))]
    regular = np.abs(np.linalg.det(corners)) > _SINGULAR * np.abs(rays).max() ** d
    planes = np.linalg.solve(corners[regular], np.ones((int(regular.sum()), d, 1)))[..., 0]
    sides = planes @ rays.T
    if (sides.min(axis=1) >= 1.0 - _BESIDE).any():
        return 0.0
    bounding = sides.max(axis=1) <= 1.0 + _BESIDE
    return float(1.0 / np.linalg.norm(planes[bounding], axis=1).max())


def sampled_margin(rays: FloatArray, count: int) -> float:
    """Margin as the least that any of so many random directions gets; never below it."""
    directions = np.random.default_rng(1).normal(size=(count, rays.shape[1]))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return max(float((directions @ rays.T).max(axis=1).min()), 0.0)


def shot_margin(rays: FloatArray) -> float:
    """Margin as the nearest facet that rays along both ends of each axis end in, without a walk."""
    found = []
    for direction in np.vstack([np.eye(rays.shape[1]), -np.eye(rays.shape[1])]):
        reach, normal = shot(rays, direction)
        found.append(reach / float(np.linalg.norm(normal)))
    return min(found)


def _case(setting: Setting) -> Case:
    make, edges = _GRASPS[setting.name]
    rays = wrenches(make(), edges).rays
    right = every_facet(rays)
    return Case(rays, lambda margin: abs(float(margin) / right - 1.0), _NOTICED)


def _way(margin: Callable[[FloatArray], float]) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        margin(case.data)  # a way without an answer says so before anything is timed
        return Prepared(lambda: margin(case.data))

    return prepare


def _directions(count: int) -> Callable[[FloatArray], float]:
    return lambda rays: sampled_margin(rays, count)


def _margin(contacts: Callable[[], Contacts]) -> float:
    """Margin; 0 where the hand does not get hold of the tool."""
    try:
        return force_closure(contacts()).margin
    except GraspError:
        return 0.0


_POSES: Final[dict[str, Callable[[float], Contacts]]] = {
    "as planned": lambda mu: held().contacts(mu),
    "soft": lambda mu: held().contacts(mu, SOFT),
    "4 mm aside": lambda mu: held(aside=4e-3).contacts(mu),
    "turned by 5°": lambda mu: held(turned=radians(5.0)).contacts(mu),
    "2 mm lower": lambda mu: held(height=heights(HAND, 0.5 * DIAMETER)[1] - 2e-3).contacts(mu),
}


def _over_friction() -> Sheet:
    rows: list[tuple[Cell, ...]] = []
    for mu in FRICTIONS:
        margins = (_margin(lambda mu=mu, pose=pose: pose(mu)) for pose in _POSES.values())  # type: ignore[misc]
        rows.append((mu, *margins))
    return Sheet(
        "friction",
        f"Margin of the hand on a tool of {DIAMETER / MILLIMETRE:g} mm [N per N], torques over the"
        " largest distance of a contact from their mean (25 mm)",
        ("μ", *_POSES),
        tuple(rows),
    )


def _over_edges() -> Sheet:
    grasp = held(aside=2e-3)
    margins = {
        m: force_closure(grasp.contacts(0.5), m).margin for m in (3, 4, 6, 8, 12, 16, 24, 32)
    }
    rows: list[tuple[Cell, ...]] = [
        (m, margin, margin / margins[32] - 1.0) for m, margin in margins.items()
    ]
    return Sheet(
        "edges",
        "Edges of the friction cone, the tool 2 mm aside, μ = 0.5",
        ("edges", "margin [N per N]", "against 32 edges"),
        tuple(rows),
    )


def _agreement() -> Sheet:
    rng = np.random.default_rng(2)
    counts = {"pairs in the plane": [0, 0, 0, 0], "two to four in space": [0, 0, 0, 0]}
    for _ in range(_RANDOM):
        points = rng.normal(size=(2, 2))
        line = points[1] - points[0]
        normals = np.array([line, -line]) + 0.7 * rng.normal(size=(2, 2))
        pair = Contacts(points, normals, rng.uniform(0.05, 1.2))
        _counted(counts["pairs in the plane"], pair, pair_closed(pair))
        number = int(rng.integers(2, 5))
        points = rng.normal(size=(number, 3))
        normals = -points + 0.3 * rng.normal(size=(number, 3))
        soft = float(rng.choice([0.0, 0.1]))
        _counted(
            counts["two to four in space"],
            Contacts(points, normals, rng.uniform(0.3, 1.2), soft),
            None,
        )
    return Sheet(
        "agreement",
        "Random grasps: closed, and in how many closed form, hull and programme agree",
        ("grasps", "of", "closed by hull", "programme agrees", "closed form agrees"),
        tuple(
            (name, *(str(n) if n >= 0 else "-" for n in found)) for name, found in counts.items()
        ),
    )


def _counted(found: list[int], contacts: Contacts, closed: bool | None) -> None:
    hull = force_closure(contacts).closed
    programme = force_closure(contacts, way=ClosureWay.PROGRAMME).closed
    found[0] += 1
    found[1] += hull
    found[2] += hull is programme
    found[3] = -1 if closed is None else found[3] + (hull is closed)


def _law(goal: float, stiffness: float) -> FirmGrasp:
    """Finger 3 on the tool as planned, its law designed for a contact of this stiffness [N/m]."""
    touch = next(one for one in held().touches if one.finger is HandFinger.THREE)
    T_finger_hand = HandFinger.THREE.placed(HAND).inverse()
    normal, point = T_finger_hand.rotate(touch.normal), T_finger_hand @ touch.point
    lever = Lever.of(HAND, touch.joints, normal, point)
    drive = PROFILE.drive
    contact = SoftContact(stiffness, 1e-3 * stiffness)
    return FirmGrasp(goal, lever, contact, drive.lag, drive.period, drive.top_speed)


_PRESSES: Final = ((4.0, 1e3, 1e3), (4.0, 1e5, 1e5), (4.0, 1e5, 1e4), (8.0, 1e4, 1e4))
"""Goal [N], stiffness that the law is for, stiffness that it meets [N/m]."""


def _presses() -> Sheet:
    rows: list[tuple[Cell, ...]] = []
    for goal, expected, met in _PRESSES:
        law = _law(goal, expected)
        found = press(law, SoftContact(met, 1e-3 * met), 5.0)
        broken = "-" if found.broken_at is None else f"{found.broken_at:.3f}"
        rows.append(
            (goal, expected, met, law.used_gain, found.settled(goal), found.overshoot(goal), broken)
        )
    return Sheet(
        "press",
        "Firm grasp from the moment of contact, finger 3; the breakaway is an estimate",
        (
            "goal [N]",
            "designed for [N/m]",
            "meets [N/m]",
            "gain [rad/s per N]",
            "within 2 % after [s]",
            "overshoot, share",
            "joint 2 lets go after [s]",
        ),
        tuple(rows),
    )


def _findings() -> Findings:
    friction, edges, agreement, presses = (
        _over_friction(),
        _over_edges(),
        _agreement(),
        _presses(),
    )
    plain = next(row for row in friction.rows if row[0] == 0.5)
    load = 0.5
    return Findings(
        (friction, edges, agreement, presses),
        (
            Figure("friction", lambda figure: _draw_friction(figure, friction), (8.0, 4.5)),
            Figure("pose", _draw_poses, (9.0, 4.0)),
            Figure("reach", _draw_reach, (8.0, 5.0)),
            Figure("press", _draw_presses, (8.0, 4.5)),
        ),
        (
            f"At μ = 0.5 the hand's margin is {float(plain[1]):.3g}, with soft pads"
            f" {float(plain[2]):.3g}: a load of {load:g} N is held from any side by"
            f" {load / float(plain[1]):.3g} N of normal forces together, or"
            f" {load / float(plain[2]):.3g} N.",
            "Without friction nothing closes on a cylinder: no contact turns it about its axis.",
        ),
    )


_LINES: Final = (
    ("o-", "#0072B2"),
    ("s-", "#D55E00"),
    ("^--", "#009E73"),
    ("v--", "#CC79A7"),
    ("d:", "#222222"),
)


def _draw_friction(figure: Any, sheet: Sheet) -> None:
    axes = figure.add_subplot(1, 1, 1)
    table = np.array(sheet.rows, dtype=np.float64)
    for column, (style, colour) in enumerate(_LINES[: table.shape[1] - 1], 1):
        axes.plot(table[:, 0], table[:, column], style, color=colour, markersize=4)
        axes.lines[-1].set_label(sheet.columns[column])
    axes.set(xlabel="friction μ", ylabel="margin [N per N of normal forces]", ylim=(0.0, None))
    axes.grid(True, color="#DDDDDD", linewidth=0.5)
    axes.legend(fontsize=8)
    figure.tight_layout()


def _draw_poses(figure: Any) -> None:
    planned = heights(HAND, 0.5 * DIAMETER)[1]
    aside, turned = np.linspace(-0.012, 0.012, 25), np.linspace(-0.5, 0.5, 25)
    lower, tilted = np.linspace(-6e-3, 6e-3, 25), np.linspace(-0.25, 0.25, 25)
    maps = (
        (
            (aside / MILLIMETRE, "aside [mm]"),
            (turned / DEGREE, "turned [°]"),
            [[_at(aside=a, turned=t) for a in aside] for t in turned],
        ),
        (
            (lower / MILLIMETRE, "above the planned height [mm]"),
            (tilted / DEGREE, "tilted [°]"),
            [[_at(height=planned + h, tilted=t) for h in lower] for t in tilted],
        ),
    )
    figure.set_layout_engine("constrained")
    top = max(float(np.max(values)) for _, _, values in maps)
    for number, ((x, x_label), (y, y_label), values) in enumerate(maps, 1):
        axes = figure.add_subplot(1, 2, number)
        shown = np.ma.masked_equal(np.array(values), 0.0)
        mesh = axes.pcolormesh(x, y, shown, vmin=0.0, vmax=top, cmap="viridis", shading="nearest")
        axes.set_facecolor("#DDDDDD")
        axes.plot(0.0, 0.0, "+", color="#D55E00", markersize=10)
        axes.set(xlabel=x_label, ylabel=y_label)
        if number == 1:
            axes.set_title("margin, μ = 0.5; grey: open, or not gripped", fontsize=9, loc="left")
    figure.colorbar(mesh, ax=list(figure.axes), label="margin [N per N]")


def _at(**pose: float) -> float:
    return _margin(lambda: held(**pose).contacts(0.5))


def _draw_reach(figure: Any) -> None:
    axes = figure.add_subplot(1, 1, 1)
    phi2 = np.linspace(0.0, HAND.most_proximal, 60)
    edge = [
        *((a, 0.0) for a in phi2),
        *((HAND.most_proximal, b) for b in np.linspace(0.0, HAND.most_distal, 20)),
        *((a, HAND.most_distal) for a in phi2[::-1]),
        *((0.0, b) for b in np.linspace(HAND.most_distal, 0.0, 20)),
    ]
    for joints, style in (
        (edge, {"color": "#999999", "label": "both joints within their limits"}),
        (
            [(a, HAND.coupling * a) for a in phi2],
            {"color": "#0072B2", "linewidth": 2.0, "label": "free motion, φ3 = φ2 / 3"},
        ),
    ):
        tips = np.array([forward(HAND, (0.0, *q)) for q in joints]) / MILLIMETRE
        axes.plot(tips[:, 0], tips[:, 2], **style)
    for a in np.radians([20.0, 85.0, 130.0]):
        middle = HAND.knuckle + HAND.proximal * cos(a), HAND.proximal * sin(a)
        tip = forward(HAND, (0.0, a, HAND.coupling * a))
        corners = np.array([(0.0, 0.0), (HAND.knuckle, 0.0), middle, (tip[0], tip[2])])
        axes.plot(*(corners / MILLIMETRE).T, "o-", color="#222222", markersize=3, linewidth=1.0)
    radius, (_, height) = 0.5 * DIAMETER, heights(HAND, 0.5 * DIAMETER)
    turn = np.linspace(0.0, 2.0 * pi, 60)
    axes.plot(
        radius * np.cos(turn) / MILLIMETRE,
        (height + radius * np.sin(turn)) / MILLIMETRE,
        color="#D55E00",
        label=f"tool of {DIAMETER / MILLIMETRE:g} mm",
    )
    axes.axvline(0.0, color="#BBBBBB", linestyle=":")
    axes.axhline(-HAND.joint_height / MILLIMETRE, color="#BBBBBB")
    axes.set(xlabel="ρ from the spread axis [mm]", ylabel="z above joint 2 [mm]")
    axes.set_aspect("equal")
    axes.legend(fontsize=8)
    figure.tight_layout()


def _draw_presses(figure: Any) -> None:
    axes = figure.add_subplot(1, 1, 1)
    for (goal, expected, met), (style, colour) in zip(_PRESSES, _LINES, strict=False):
        found = press(_law(goal, expected), SoftContact(met, 1e-3 * met), 1.0)
        width = 3.5 if expected < 1e4 else 1.5  # the first and the second are one line
        axes.plot(found.times, found.force, style[1:], color=colour, linewidth=width)
        axes.lines[-1].set_label(f"{goal:g} N, for {expected:g} N/m, meets {met:g} N/m")
        axes.axhline(goal, color="#BBBBBB", linewidth=0.8)
        if found.broken_at is not None:
            axes.axvline(found.broken_at, color=colour, linestyle=":", linewidth=0.8)
            axes.lines[-1].set_label("joint 2 lets go")
    axes.set(xlabel="time since contact [s]", ylabel="force [N]", ylim=(0.0, None))
    axes.grid(True, color="#DDDDDD", linewidth=0.5)
    axes.legend(fontsize=8, loc="lower right")
    figure.tight_layout()


STUDY: Final = Study(
    error_label="error of the margin, as a share of it",
    ways=(
        Way("closed form", "closed form", _way(pair_margin), "a tetrahedron", ClosureWay.PAIR),
        Way("hull", "hull", _way(hull_margin), "nearest facet, by qhull", ClosureWay.HULL),
        Way(
            "programmes",
            "linear programmes",
            _way(programme_margin),
            "closed? then rays, walking to the nearest facet",
            ClosureWay.PROGRAMME,
        ),
        Way(
            "single programmes",
            "linear programmes",
            _way(shot_margin),
            "one ray along both ends of each axis",
        ),
        *(
            Way(f"{n} directions", "directions", _way(_directions(n)), "drawn at random")
            for n in _DIRECTIONS
        ),
    ),
    settings=tuple(Setting(name, {"edges": edges}) for name, (_, edges) in _GRASPS.items()),
    case=_case,
    deadline=Limit(10e-3, "10 ms: a hundred poses of the palm in a second"),
    perception=Limit(_NOTICED, "10 % of the force that holds"),
    default="hull",
    because="exact in plane and space, and quick enough to try many poses",
    in_use=lambda: default_of(force_closure, "way"),
    findings=_findings,
)
