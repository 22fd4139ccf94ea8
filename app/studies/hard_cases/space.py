"""Hard cases of rotations, distances and planning: opposite directions, half turns, far origins."""

from collections.abc import Callable
from dataclasses import replace
from math import pi
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, angle_between, unit
from app.core.errors import NumericalError
from app.core.rotation import rotation_exp, rotation_log
from app.core.transform import RigidTransform, rotation_between
from app.mechanisms.pantograph.profile import load_pantograph
from app.planning.errors import PlanError
from app.planning.limits import cone, tilt_of
from app.planning.measurements import Angle
from app.planning.measuring import measured
from app.planning.needle_planes import frame_of
from app.planning.off_path import angles, offset
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.plan import Plan
from app.planning.reach import Obstacle, reach, smallest_turn
from app.planning.registration.errors import DegenerateFiducialsError
from app.planning.registration.rigid import rigid_fit
from app.studies.hard_cases.case import Beyond, HardCase, analytic, answers, digits, named
from app.studies.hard_cases.volumes import volume_of

DOWN: Final = np.array([0.0, 0.0, -1.0])
PROFILE: Final = load_pantograph("icube")
FULCRUM: Final = PROFILE.pantograph.fulcrum

_Way = Callable[..., Any]


def _turned() -> HardCase:
    reference = digits("rotation by 1e-9 short of half a turn")
    vector = np.array(reference.given)

    return HardCase(
        subsystem="rotations",
        case="rotation matrix of a turn by 1e-9 short of half a turn",
        given="axis (0.36, -0.48, 0.8)",
        way=rotation_exp,
        found=lambda way: way(vector),
        reference=reference,
        unit="1",
        bound=1e-15,
        beyond=_identity(),
    )


def _barely_turned() -> tuple[HardCase, ...]:
    # What a small turn leaves beside the ones of the diagonal must keep its own digits.
    found = []
    for words in ("1e-8", "1e-160"):
        kept = digits(f"rotation by {words}")
        r = kept.value
        reference = replace(kept, value=(r[7] - r[5], r[2] - r[6], r[3] - r[1]))
        found.append(
            HardCase(
                subsystem="rotations",
                case=f"rotation matrix of a turn by {words} rad, its antisymmetric part",
                given="axis (0.36, -0.48, 0.8)",
                way=rotation_exp,
                found=lambda way, v=kept.given: _antisymmetric(way(np.array(v))),
                reference=reference,
                unit="1",
                bound=1e-15,
                relative=True,
                beyond=_identity(),
            )
        )
    return tuple(found)


def _identity() -> Beyond:
    return answers(
        "exactly the identity at 0",
        lambda: bool((rotation_exp(np.zeros(3)) == np.eye(3)).all()),
    )


def _antisymmetric(r: Any) -> FloatArray:
    return np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])


def _logs() -> tuple[HardCase, ...]:
    found = []
    for words, angle, bound in (
        ("1e-9 short of half a turn", pi - 1e-9, 1e-15),
        ("1e-10 rad", 1e-10, 1e-16),
        ("3 rad", 3.0, 2e-15),
    ):
        axis = np.array([0.36, -0.48, 0.8])
        turn = angle * axis
        found.append(
            HardCase(
                subsystem="rotations",
                case=f"rotation vector of a turn by {words}",
                given="matrix of the turn about (0.36, -0.48, 0.8)",
                way=rotation_log,
                found=lambda way, v=turn: way(rotation_exp(v)),
                reference=analytic("the vector that the matrix was made of", turn),
                unit="rad",
                bound=bound,
                beyond=answers(
                    "at half a turn either axis, and its length is π",
                    lambda: (
                        abs(float(np.linalg.norm(rotation_log(np.diag([-1.0, -1.0, 1.0])))) - pi)
                        < 1e-15
                    ),
                ),
            )
        )
    return tuple(found)


def _between() -> HardCase:
    end = unit([1e-9, 2e-9, 1.0])

    return HardCase(
        subsystem="rotations",
        case="turn of a direction onto one 2e-9 rad short of its opposite",
        given="(0, 0, -1) onto (1e-9, 2e-9, 1)",
        way=rotation_between,
        found=lambda way: way(DOWN, end) @ DOWN,
        reference=analytic("the end itself", end),
        unit="1",
        bound=1e-15,
        beyond=named(NumericalError, lambda: rotation_between(DOWN, np.zeros(3))),
    )


def _twist() -> HardCase:
    reference = digits("left jacobian at 2e-4 rad")
    twist = np.array(reference.given)
    return HardCase(
        subsystem="rotations",
        case="shift of a screw of 2e-4 rad, just beyond where the series ends",
        given="ρ = (1, -2, 3) m",
        way=RigidTransform.exp,
        found=lambda way: way(twist).translation,
        reference=reference,
        unit="m",
        bound=1e-13,
        beyond=answers(
            "the series goes on without a jump",
            lambda: bool(
                np.abs(
                    RigidTransform.exp([1, -2, 3, 1.0000001e-4, 0, 0]).translation
                    - RigidTransform.exp([1, -2, 3, 0.9999999e-4, 0, 0]).translation
                ).max()
                < 1e-10
            ),
        ),
    )


def _screw_and_back() -> HardCase:
    twist = np.array([0.1, -0.2, 0.3, *((pi - 1e-7) * np.array([0.36, -0.48, 0.8]))])
    return HardCase(
        subsystem="rotations",
        case="screw of a transform 1e-7 rad short of half a turn",
        given="exponential of a screw",
        way=RigidTransform.log,
        found=lambda way: way(RigidTransform.exp(twist)),
        reference=analytic("the screw that it was made of", twist),
        unit="m, rad",
        bound=1e-14,
        beyond=named(NumericalError, lambda: RigidTransform(-np.eye(3), np.zeros(3))),
    )


def _angles() -> tuple[HardCase, ...]:
    found = []
    for words, name, bound, relative in (
        ("1e-9 apart", "1e-9 apart", 1e-15, True),
        ("1e-150 apart", "1e-150 apart", 1e-15, True),
        ("1e-9 short of opposite", "1e-9 short of opposite", 1e-15, False),
    ):
        reference = digits(f"angle of directions {name}")
        found.append(
            HardCase(
                subsystem="rotations",
                case=f"angle between directions {words}",
                given="both in double precision",
                way=angle_between,
                found=lambda way, v=reference.given: way(v, DOWN),
                reference=reference,
                unit="1" if relative else "rad",
                bound=bound,
                relative=relative,
                beyond=named(NumericalError, lambda: angle_between(np.zeros(3), DOWN)),
            )
        )
    return tuple(found)


# --- distances ------------------------------------------------------------------------------------
def _placed(length_mm: float = 80.0, origin_mm: float = 0.0) -> PlacedPlan:
    entry = np.full(3, origin_mm)
    return PlacedPlan.of(Plan(entry, np.add(entry, (0.0, length_mm, 0.0))), Placement(), FULCRUM)


def _aside() -> HardCase:
    placed = _placed()
    off = 1e-9
    tip = placed.p_target + off * np.array([1.0, 0.0, 0.0])

    return HardCase(
        subsystem="distances",
        case="a tip 1 nm off a path of 80 mm, at its end",
        given="tip = target + (1e-9, 0, 0) m",
        way=offset,
        found=lambda way: way(tip, placed.axis, placed, placed.p_target).lateral,
        reference=analytic("what it was moved by", tip[0] - placed.p_target[0]),
        unit="m",
        bound=1e-17,
        beyond=answers(
            "exactly 0 on the path",
            lambda: offset(placed.p_target, placed.axis, placed, placed.p_target).lateral == 0.0,
        ),
    )


def _needle_and_path() -> HardCase:
    reference = digits("angle of directions 1e-9 apart")
    axis = np.array(reference.given)
    return HardCase(
        subsystem="distances",
        case="angle of a needle 1e-9 rad from its path",
        given="needle (1e-9, -5e-10, -1), path straight down",
        way=angles,
        found=lambda way: way(axis, DOWN),
        reference=reference,
        unit="1",
        bound=1e-15,
        relative=True,
        beyond=answers("π for opposite ones", lambda: float(angles(DOWN, -DOWN)) == pi),
    )


def _drawn_angle() -> HardCase:
    volume = volume_of(np.eye(3))
    drawn = Angle((1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (-1.0, 1e-9, 0.0))
    flat = Angle((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0))

    def untold() -> bool:
        return measured(flat, volume).quantities[0].value is None

    return HardCase(
        subsystem="distances",
        case="an angle drawn 1e-9 rad short of a straight line",
        given="arms (1, 0, 0) and (-1, 1e-9, 0) mm",
        way=measured,
        found=lambda way: way(drawn, volume).quantities[0].value,
        reference=analytic("180° - 1e-9 rad", 180.0 - np.degrees(1e-9)),
        unit="°",
        bound=3e-14,
        beyond=answers("no number where an arm has no length", untold),
    )


def _fitted() -> tuple[HardCase, ...]:
    triangle = np.array([[0.0, 0.0, 0.0], [0.08, 0.0, 0.0], [0.02, 0.05, 0.0]])
    half = RigidTransform(rotation_exp([0.0, pi, 0.0]), np.array([0.1, 0.2, 0.3]))
    far = RigidTransform(rotation_exp([0.3, -0.2, 0.1]), np.array([9.0, -9.0, 9.0]))
    line = np.outer([0.0, 1.0, 2.0, 5.0], [0.02, 0.01, -0.01])
    thin = line + np.outer([0.0, 1.0, 0.0, 0.0], [0.0, 0.002, 0.002])

    return tuple(
        HardCase(
            subsystem="distances",
            case=f"registration of {words}",
            given="reference points and the same moved",
            way=rigid_fit,
            found=lambda way, p=points, T=pose: way(p, T @ p).T_measured_reference.matrix(),
            reference=analytic("the transform that moved them", pose.matrix()),
            unit="m, 1",
            bound=bound,
            beyond=named(DegenerateFiducialsError, lambda: rigid_fit(line, line)),
        )
        for words, points, pose, bound in (
            ("three points turned by half a turn", triangle, half, 1e-14),
            ("points 9 m from the origin", triangle, far, 2e-13),
            ("points within 3 mm of one line", thin, half, 1e-12),
        )
    )


# --- planning -------------------------------------------------------------------------------------
def _plan(entry_mm: Any, target_mm: Any) -> Plan:
    return Plan(np.array(entry_mm, dtype=np.float64), np.array(target_mm, dtype=np.float64))


def _opposite_turn() -> HardCase:
    end = unit([1e-7, 2e-7, 1.0])

    return HardCase(
        subsystem="planning",
        case="smallest turn of a path 2e-7 rad short of straight up",
        given="(0, 0, -1) onto (1e-7, 2e-7, 1)",
        way=smallest_turn,
        found=lambda way: rotation_exp(way(DOWN, end)) @ DOWN,
        reference=analytic("the end itself", end),
        unit="1",
        bound=4e-9,  # of the axis ε / 2e-7, doubled by half a turn, twice over
        beyond=answers(
            "half a turn about the world's y between exact opposites",
            lambda: bool(np.allclose(smallest_turn(DOWN, -DOWN), [0.0, pi, 0.0], atol=1e-15)),
        ),
    )


def _turned_over() -> HardCase:
    direction = PatientOrientation.SUPINE.rotation.T @ unit([1e-9, -1e-9, 1.0])
    plan = Plan(np.zeros(3), 80.0 * direction)

    def angle(way: _Way) -> Any:
        remedy = way(plan, Placement(), PROFILE).remedy
        return remedy.angle

    return HardCase(
        subsystem="planning",
        case="remedy of a path that leads straight up, but for 1e-9",
        given="80 mm along (1e-9, -1e-9, 1) in the world",
        way=reach,
        found=angle,
        reference=analytic("180° less the tilt that is allowed, and 2°", pi - np.radians(37.0)),
        unit="rad",
        bound=3e-9,
        beyond=answers(
            "named UPWARD",
            lambda: reach(plan, Placement(), PROFILE).reasons[0].obstacle is Obstacle.UPWARD,
        ),
    )


def _far_patient() -> HardCase:
    far = 9.9e6 + 0.3
    plan = _plan((far, -far, far), (far + 10.4, -far + 60.3, far - 20.2))
    placement = Placement(rotation_deg=(3.0, 20.0, -7.0))
    near = PlacedPlan.of(_plan((0.0, 0.0, 0.0), (10.4, 60.3, -20.2)), placement, FULCRUM)

    return HardCase(
        subsystem="planning",
        case="a patient 10 km from the scanner's origin",
        given="entry at ±9900000.3 mm",
        way=PlacedPlan.of,
        found=lambda way: way(plan, placement, FULCRUM).p_target,
        reference=analytic("the target of the same plan at the origin", near.p_target),
        unit="m",
        bound=8e-12 * 2,  # 8 roundings of 10 km
        beyond=named(PlanError, lambda: _plan((1.0000001e7, 0.0, 0.0), (0.0, 0.0, 0.0))),
    )


def _short_path() -> HardCase:
    plan = _plan((1e6, 1e6, 1e6), (1e6, 1e6 + 1.0, 1e6))
    return HardCase(
        subsystem="planning",
        case="direction of the shortest path that may be planned, 1 km off",
        given="1 mm along y at (1e6, 1e6, 1e6) mm",
        way=Plan.direction.__get__,
        found=lambda way: way(plan),
        reference=analytic("(0, 1, 0)", (0.0, 1.0, 0.0)),
        unit="1",
        bound=0.0,
        beyond=named(PlanError, lambda: _plan((0.0, 0.0, 0.0), (0.999, 0.0, 0.0))),
    )


def _small_cone() -> HardCase:
    return HardCase(
        subsystem="planning",
        case="directions on a cone of 1e-9 rad about the vertical",
        given="axis (0, 0, -1)",
        way=cone,
        found=lambda way: tilt_of(way(DOWN, 1e-9)[1]),
        reference=analytic("the cone's own angle", 1e-9),
        unit="1",
        bound=1e-15,
        relative=True,
        beyond=answers("the axis itself at 0", lambda: tilt_of(cone(DOWN, 0.0)[1]) == 0.0),
    )


def _planes_along_the_head() -> HardCase:
    axis = unit([1e-9, -2e-9, 1.0])

    def square(way: _Way) -> Any:
        frame = way(np.zeros(3), axis)
        axes = np.stack([frame.axis, frame.x, frame.y])
        return axes @ axes.T

    return HardCase(
        subsystem="planning",
        case="the needle's planes along the body, 2e-9 rad off",
        given="axis (1e-9, -2e-9, 1) in LPS",
        way=frame_of,
        found=square,
        reference=analytic("three unit vectors at right angles", np.eye(3)),
        unit="1",
        bound=1e-14,
        beyond=named(NumericalError, lambda: frame_of(np.zeros(3), np.zeros(3))),
    )


CASES: Final = (
    _turned(),
    *_barely_turned(),
    *_logs(),
    _between(),
    _twist(),
    _screw_and_back(),
    *_angles(),
    _aside(),
    _needle_and_path(),
    _drawn_angle(),
    *_fitted(),
    _opposite_turn(),
    _turned_over(),
    _far_patient(),
    _short_path(),
    _small_cone(),
    _planes_along_the_head(),
)
"""Rotations, distances, planning."""
