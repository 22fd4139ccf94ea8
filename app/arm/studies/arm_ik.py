"""Study: inverse kinematics of the arm, the paper's empty section 2.2.4.

Every way gets poses made of joint angles within the limits, at random and near singular postures,
and answers with joint angles. What they miss is measured by Pinocchio on the published description
of the arm, which shares no number with the profile's table. Times are processor time for a pose.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from time import process_time
from typing import Any, Final

import numpy as np

from app.arm.mechanics import (
    CLOSED,
    SCRATCH,
    STEPS,
    TOLD,
    WORK,
    ArmProfile,
    Three,
    eight_kernel,
    elbow_kernel,
    forward,
    forward_kernel,
    iterate_kernel,
    link_frames,
    load_arm,
    published_arm,
    solve_kernel,
    starts,
)
from app.arm.studies.references.programs import EaikArm, PinocchioArm
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.studies.errors import StudyError
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey

DECLARATION: Final[dict[str, Any]] = {
    "title": "Inverse kinematics of the arm: closed forms, damped least squares, other programs",
    "question": "How are the arm's joint angles found from a pose, also where it is singular?",
    "reference": "Pinocchio's forward kinematics of the published iiwa14, 1e-15 m",
}

MET: Final = 1e-6
"""A pose is met within this [m, rad]."""

CLOSURE: Final = 1e-10
"""What the closed forms must keep [m, rad]."""

DISTANCES: Final = tuple(10.0**-k for k in (1, 2, 4, 6, 8, 10, 12, 14))
"""From singular [rad]."""

_COLOURS: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#555555")
_LEAST: Final = 1e-17  # an error of exactly zero is drawn here


@dataclass(frozen=True, slots=True)
class Size:
    """How much is measured: poses at random, near each singular posture, for slow ways, printed."""

    random: int
    near: int
    slow: int
    printed: int


FULL: Final = Size(100_000, 1_000, 1_000, 400)
SHORT: Final = Size(2_000, 100, 50, 50)


@dataclass(frozen=True, slots=True, eq=False)
class Poses:
    """Poses ⁰T₇ and the joint angles that they were made of."""

    q: FloatArray  # (n, 7)
    rotation: FloatArray  # (n, 3, 3)
    position: FloatArray  # (n, 3)

    def first(self, count: int) -> "Poses":
        """Return as many of them."""
        return Poses(self.q[:count], self.rotation[:count], self.position[:count])

    def pose(self, k: int) -> RigidTransform:
        """Return one of them."""
        return RigidTransform(self.rotation[k], self.position[k])


@dataclass(frozen=True, slots=True, eq=False)
class ArmAnswers:
    """What a way answered: joint angles (n, 7), NaN where none, and its time for a pose [s]."""

    q: FloatArray
    seconds: float


ArmWay = Callable[[Poses], ArmAnswers]


@njit
def pose_often(q: FloatArray, lengths: Three, rotation: FloatArray, position: FloatArray) -> None:
    """Forward kinematics of many."""
    for k in range(len(q)):
        forward_kernel(q[k], lengths, rotation[k], position[k])


@njit
def eight_often(
    rotation: FloatArray,
    position: FloatArray,
    lengths: Three,
    lower: FloatArray,
    upper: FloatArray,
    out: FloatArray,
) -> None:
    """Of the eight solutions with θ3 = 0 the one that is furthest within its limits, or beyond."""
    found, flags = np.empty((8, 7)), np.empty(8, np.int64)
    for k in range(len(position)):
        out[k] = np.nan
        if eight_kernel(rotation[k], position[k], lengths, (0.0, 0.0), found, flags) != 0:
            continue
        most = -1e9
        for row in found:
            margin = min((upper - row).min(), (row - lower).min())
            if margin > most:
                most = margin
                out[k] = row


@njit
def solve_often(
    rotation: FloatArray,
    position: FloatArray,
    lengths: Three,
    lower: FloatArray,
    upper: FloatArray,
    out: FloatArray,
) -> None:
    """Solutions within limits, over all arm angles."""
    near, work = np.zeros(7), np.empty(SCRATCH)
    best, told = np.empty(7), np.empty(TOLD)
    for k in range(len(position)):
        status = solve_kernel(
            rotation[k], position[k], lengths, lower, upper, near, False, work, best, told
        )
        out[k] = np.nan
        if status == 0 and told[2] > 0.0:
            out[k] = best


@njit
def iterate_often(
    rotation: FloatArray,
    position: FloatArray,
    lengths: Three,
    lower: FloatArray,
    upper: FloatArray,
    begin: FloatArray,
    out: FloatArray,
) -> None:
    """Damped least squares from starts (n, m, 7), one after the other until the pose is met."""
    work, q = np.empty(WORK), np.empty(7)
    for k in range(len(position)):
        least = 1e9
        for start in begin[k]:
            q[:] = start
            error, _ = iterate_kernel(
                rotation[k], position[k], lengths, lower, upper, STEPS, q, work
            )
            if error < least:
                least = error
                out[k] = q
            if error <= CLOSED:
                break


def posed(arm: ArmProfile, q: FloatArray) -> Poses:
    """Poses of joint angles (n, 7)."""
    rotation, position = np.empty((len(q), 3, 3)), np.empty((len(q), 3))
    pose_often(q, arm.lengths, rotation, position)
    return Poses(q, rotation, position)


def at_random(arm: ArmProfile, count: int, seed: int = 1) -> FloatArray:
    """Joint angles anywhere within the limits, (count, 7)."""
    rng = np.random.default_rng(seed)
    return rng.uniform(arm.lower, arm.upper, (count, len(arm.lower)))


def near_singular(arm: ArmProfile, kind: str, distance: float, count: int) -> FloatArray:
    """Joint angles so far from singular [rad] in one way, else anywhere, (count, 7)."""
    q = at_random(arm, count, seed=2)
    sign = np.where(np.arange(count) % 2, 1.0, -1.0)
    if kind == "first axis":
        # With θ3 = 0 the wrist centre leans by θ2 - φ.
        for row, side in zip(q, sign, strict=True):
            a, b = arm.upper_arm, arm.forearm
            away = np.sqrt(a * a + b * b + 2.0 * a * b * np.cos(row[3]))
            _, _, sf, cf, _ = elbow_kernel(away, arm.lengths, float(np.sign(row[3])))
            row[1:3] = np.arctan2(sf, cf) + side * distance, 0.0
    else:
        q[:, {"shoulder": 1, "elbow": 3, "wrist": 5}[kind]] = sign * distance
    return q


KINDS: Final = ("first axis", "shoulder", "elbow", "wrist")
"""Singular postures that are come near to."""


def _compiled(arm: ArmProfile, call: Callable[..., None], *more: FloatArray) -> ArmWay:
    """Time a compiled loop over the poses; `more` has a row for each pose."""
    limits = arm.lengths, np.array(arm.lower), np.array(arm.upper)

    def run(poses: Poses) -> ArmAnswers:
        count = len(poses.q)
        out = np.full((count, 7), np.nan)
        extra = [np.resize(values, (count, *values.shape[1:])) for values in more]
        call(poses.rotation[:2], poses.position[:2], *limits, *[x[:2] for x in extra], out[:2])
        begin = process_time()
        call(poses.rotation, poses.position, *limits, *extra, out)
        return ArmAnswers(out, (process_time() - begin) / count)

    return run


def _from_nearby(arm: ArmProfile) -> ArmWay:
    def run(poses: Poses) -> ArmAnswers:
        noise = 0.3 * np.random.default_rng(3).normal(size=poses.q.shape)
        return _compiled(arm, iterate_often, (poses.q + noise)[:, None, :])(poses)

    return run


def _pinocchio(arm: ArmProfile, other: PinocchioArm) -> ArmWay:
    start = np.full(7, 0.1)

    def run(poses: Poses) -> ArmAnswers:
        targets = [other.target(poses.pose(k) @ arm.T_wrist_flange) for k in range(len(poses.q))]
        begin = process_time()
        found = [other.iterate(target, start, STEPS, 1e-6, 1e-10) for target in targets]
        seconds = (process_time() - begin) / len(targets)
        turned = [np.mod(q + np.pi, 2.0 * np.pi) - np.pi for q, _ in found]
        return ArmAnswers(np.array(turned), seconds)

    return run


def _eaik(arm: ArmProfile, other: EaikArm) -> ArmWay:
    def best(result: FloatArray) -> FloatArray:
        if not len(result):
            return np.full(7, np.nan)
        margins = np.minimum(arm.upper - result, result - arm.lower).min(axis=1)
        return np.asarray(result[int(np.argmax(margins))])

    def run(poses: Poses) -> ArmAnswers:
        asked = [poses.pose(k) for k in range(len(poses.q))]
        begin = process_time()
        found = [other.solutions(pose) for pose in asked]
        seconds = (process_time() - begin) / len(asked)
        return ArmAnswers(np.array([best(rows) for rows in found]), seconds)

    return run


def missed(arm: ArmProfile, other: PinocchioArm, poses: Poses, q: FloatArray) -> FloatArray:
    """Measure by Pinocchio how far joint angles miss poses, (n, 2) [m, rad]; infinite without."""
    off = np.full((len(q), 2), np.inf)
    rows = np.flatnonzero(np.isfinite(q).all(axis=1))
    turn, place = np.empty((len(rows), 3, 3)), np.empty((len(rows), 3))
    for n, k in enumerate(rows):
        there = other.placed(q[k])
        turn[n], place[n] = there.rotation, there.translation
    wrist = place - arm.flange * turn[:, :, 2]
    off[rows, 0] = np.linalg.norm(wrist - poses.position[rows], axis=1)
    off[rows, 1] = np.linalg.norm(turn - poses.rotation[rows], axis=(1, 2)) / np.sqrt(2.0)
    return off


def forward_apart(arm: ArmProfile, other: PinocchioArm, q: FloatArray) -> float:
    """Return the largest difference of the poses of the wrist, Acus' and Pinocchio's [m, 1]."""
    poses = posed(arm, q)
    return float(missed(arm, other, poses, q).max())


def printed_sheet(arm: ArmProfile, count: int) -> Sheet:
    """Return how many combinations of signs solve poses, as the paper prints them and with the
    errata.
    """
    q = at_random(arm, count, seed=4)
    rows: list[tuple[Cell, ...]] = []
    for words, corrected in (("as printed", False), ("with errata D3 to D5", True)):
        # printed: θ1, θ2, θ4, θ6, each with a sign of its own; corrected: θ2's follows
        choices = list(product((1, -1), repeat=3 if corrected else 4))
        solved = np.zeros((len(q), len(choices)), dtype=bool)
        for k, posture in enumerate(q):
            there = forward(arm, posture)
            for n, signs in enumerate(choices):
                found = (
                    _corrected(arm, there, *signs) if corrected else _printed(arm, there, *signs)
                )
                solved[k, n] = np.abs(forward(arm, found).matrix() - there.matrix()).max() < MET
        each = solved.sum(axis=1)
        rows.append((words, len(q), len(choices), int(each.min()), int(each.max())))
    return Sheet(
        "printed",
        "Equations 2.2.1 to 2.2.4 with θ3 = 0 and d3 = 0.42 m: combinations that solve a pose",
        ("formulas", "poses", "combinations of signs", "solving, least", "most"),
        tuple(rows),
    )


def _angles_of_reach(arm: ArmProfile, there: RigidTransform) -> tuple[float, float, float, float]:
    # Lean, φ, cos θ4 and azimuth as the paper has them.
    x, y, z = there.translation - [0.0, 0.0, arm.pedestal]
    a, b = arm.upper_arm, arm.forearm
    square = x * x + y * y + z * z
    opening = float(np.arccos((a * a + square - b * b) / (2.0 * a * np.sqrt(square))))
    c4 = float((square - a * a - b * b) / (2.0 * a * b))
    return float(np.arctan2(np.hypot(x, y), z)), opening, c4, float(np.arctan2(y, x))


def _hand(arm: ArmProfile, there: RigidTransform, q: FloatArray) -> FloatArray:
    return np.asarray((link_frames(arm, q)[3][:3, :3].T @ there.rotation).T)  # rows i, j, k


def _printed(
    arm: ArmProfile, there: RigidTransform, s1: int, s2: int, s4: int, s6: int
) -> FloatArray:
    lean, opening, c4, azimuth = _angles_of_reach(arm, there)
    q = np.zeros(7)
    q[0] = azimuth if s1 > 0 else np.pi - azimuth
    q[1], q[3] = lean + s2 * opening, np.arctan2(s4 * np.sqrt(1.0 - c4 * c4), c4)
    i, j, k = _hand(arm, there, q)
    q[5] = np.arctan2(s6 * np.sqrt(max(1.0 - k[1] * k[1], 0.0)), k[1])
    q[4], q[6] = np.arctan2(-k[2], k[0]), np.arctan2(-j[1], i[1])
    return q


def _corrected(arm: ArmProfile, there: RigidTransform, s1: int, s4: int, s6: int) -> FloatArray:
    lean, opening, c4, azimuth = _angles_of_reach(arm, there)
    q = np.zeros(7)
    q[0] = azimuth if s1 > 0 else azimuth + np.pi
    q[1], q[3] = s1 * lean + s4 * opening, np.arctan2(s4 * np.sqrt(1.0 - c4 * c4), c4)
    i, j, k = _hand(arm, there, q)
    q[5] = np.arctan2(s6 * np.hypot(k[0], k[2]), k[1])
    q[4], q[6] = np.arctan2(-s6 * k[2], s6 * k[0]), np.arctan2(s6 * j[1], -s6 * i[1])
    return q


def _ways(arm: ArmProfile, other: PinocchioArm) -> tuple[dict[str, ArmWay], tuple[str, ...]]:
    """Ways by name, and what is left out; those named `slow` get fewer poses."""
    several = starts(arm, 8)
    ways = {
        "closed form, θ3 = 0, all eight": _compiled(arm, eight_often),
        "closed form, arm angle, within limits": _compiled(arm, solve_often),
        "least squares, 0.3 rad off": _from_nearby(arm),
        "least squares, one start": _compiled(arm, iterate_often, several[None, 1:2]),
        "least squares, up to eight starts": _compiled(arm, iterate_often, several[None]),
        "Pinocchio's example, no limits": _pinocchio(arm, other),
    }
    try:
        ways["EAIK, θ3 = 0, all it finds"] = _eaik(arm, EaikArm(arm))
    except StudyError as error:
        return ways, (f"EAIK is left out: {error}",)
    return ways, ()


SLOW: Final = ("Pinocchio", "EAIK")
"""Ways whose loop is Python's get fewer poses."""


def measured(size: Size, progress: Progress | None = None) -> Findings:
    """Do the whole study."""
    arm = load_arm()
    other = PinocchioArm(published_arm())
    ways, lines = _ways(arm, other)
    poses = posed(arm, at_random(arm, size.random))
    apart = forward_apart(arm, other, poses.q)
    rows: list[tuple[Cell, ...]] = []
    errors: dict[str, FloatArray] = {}
    for number, (name, way) in enumerate(ways.items()):
        if progress is not None:
            progress.report(0.7 * number / len(ways), name)
        asked = poses.first(size.slow) if name.startswith(SLOW) else poses
        answers = way(asked)
        off = missed(arm, other, asked, answers.q)
        errors[name] = off
        rows.append((name, len(asked.q), *_judged(arm, answers, off)))
    near = _near(arm, other, ways, size, progress)
    sheets = (
        Sheet(
            "random",
            "Poses of random joint angles within the limits",
            (
                "way",
                "poses",
                "met [%]",
                "met within limits [%]",
                "median error [m]",
                "worst [m]",
                "worst turn [rad]",
                "time [µs]",
            ),
            tuple(rows),
        ),
        _near_sheet(near),
        printed_sheet(arm, size.printed),
    )
    closed = errors["closed form, arm angle, within limits"]
    nearby = [off.max() for (way, _, _), off in near.items() if way.startswith("closed")]
    worst = max(float(closed.max()), float(max(nearby)))
    share = 100.0 * float((closed.max(axis=1) <= CLOSURE).mean())
    passed = worst <= CLOSURE and apart <= 1e-12
    lines = (
        f"Forward kinematics differ from Pinocchio's by {apart:.2g} at most (goal 1e-12).",
        f"The closed form over the arm angle solves {share:.6g} % of {size.random} random poses"
        f" within limits; near singular postures too, it misses by {worst:.2g} m or rad at most"
        f" (goal {CLOSURE:g}).",
        *lines,
    )
    figures = (
        Figure("success", lambda figure: _draw_success(figure, rows), (8.0, 5.0)),
        Figure("errors", lambda figure: _draw_errors(figure, errors), (8.0, 5.0)),
        Figure("singular", lambda figure: _draw_near(figure, near), (10.0, 8.0)),
    )
    return Findings(sheets, figures, lines, passed)


def _judged(arm: ArmProfile, answers: ArmAnswers, off: FloatArray) -> tuple[Cell, ...]:
    met = off.max(axis=1) <= MET
    within = met & (arm.beyond(np.nan_to_num(answers.q)) <= 1e-9).all(axis=1)
    shown = off[met] if met.any() else np.full((1, 2), np.inf)
    return (
        round(100.0 * float(met.mean()), 4),
        round(100.0 * float(within.mean()), 4),
        float(np.median(shown[:, 0])),
        float(shown[:, 0].max()),
        float(shown[:, 1].max()),
        1e6 * answers.seconds,
    )


NearErrors = dict[tuple[str, str, float], FloatArray]
"""Errors by way, kind of singular posture and distance from it."""


def _near(
    arm: ArmProfile,
    other: PinocchioArm,
    ways: dict[str, ArmWay],
    size: Size,
    progress: Progress | None,
) -> NearErrors:
    found: NearErrors = {}
    for number, (kind, distance) in enumerate(product(KINDS, DISTANCES)):
        if progress is not None:
            share = number / (len(KINDS) * len(DISTANCES))
            progress.report(
                0.7 + 0.3 * share,
                sentence("{kind}, {distance:g} rad", kind=kind, distance=distance),
            )
        poses = posed(arm, near_singular(arm, kind, distance, size.near))
        for name, way in ways.items():
            asked = poses.first(max(size.slow // 20, 5)) if name.startswith(SLOW) else poses
            found[name, kind, distance] = missed(arm, other, asked, way(asked).q)
    return found


def _near_sheet(near: NearErrors) -> Sheet:
    names = tuple(dict.fromkeys(name for name, _, _ in near))
    rows: list[tuple[Cell, ...]] = []
    for kind, distance in product(KINDS, DISTANCES):
        cells: list[Cell] = [kind, f"{distance:g}"]
        for name in names:
            off = near[name, kind, distance].max(axis=1)
            met = off <= MET
            worst = f"{off[met].max():.1e}" if met.any() else "-"
            cells.append(f"{100.0 * met.mean():.4g} %, {worst}")
        rows.append(tuple(cells))
    return Sheet(
        "singular",
        "Near singular postures: poses met, and the largest error of those [m, rad]",
        ("near", "by [rad]", *names),
        tuple(rows),
    )


def _draw_success(figure: Any, rows: list[tuple[Cell, ...]]) -> None:
    axes = figure.add_subplot()
    for row, colour in zip(rows, _COLOURS, strict=False):
        axes.semilogy(row[2], row[7], "o", color=colour, label=str(row[0]))
        axes.semilogy(row[3], row[7], "o", color=colour, fillstyle="none")
    axes.axhline(20.0, color="#777777", linestyle=":", label="goal of all eight, 20 µs")
    axes.set(xlabel="poses met [%] (hollow: within limits)", ylabel="time for a pose [µs]")
    axes.grid(True, color="#DDDDDD")
    axes.legend(fontsize=8)
    figure.tight_layout()


def _draw_errors(figure: Any, errors: dict[str, FloatArray]) -> None:
    axes = figure.add_subplot()
    for (name, off), colour in zip(errors.items(), _COLOURS, strict=False):
        size = np.sort(np.maximum(np.minimum(off.max(axis=1), 10.0), _LEAST))
        axes.semilogx(size, np.linspace(0.0, 100.0, len(size)), color=colour, label=name)
    axes.axvline(CLOSURE, color="#777777", linestyle=":", label="goal of the closed forms")
    axes.set(xlabel="error, the larger of metres and radians", ylabel="poses within it [%]")
    axes.grid(True, color="#DDDDDD")
    axes.legend(fontsize=8, loc="center right")
    figure.tight_layout()


def _draw_near(figure: Any, near: NearErrors) -> None:
    names = tuple(dict.fromkeys(name for name, _, _ in near))
    for number, kind in enumerate(KINDS):
        axes = figure.add_subplot(2, 2, number + 1)
        for name, colour in zip(names, _COLOURS, strict=False):
            worst = [
                np.clip(near[name, kind, distance].max(), _LEAST, 10.0) for distance in DISTANCES
            ]
            axes.loglog(DISTANCES, worst, "o-", color=colour, markersize=3, label=name)
        axes.axhline(CLOSURE, color="#777777", linestyle=":")
        axes.set(xlabel="distance from singular [rad]", ylabel="worst error [m, rad]")
        axes.set_title(kind, fontsize=9)
        axes.grid(True, color="#DDDDDD")
    figure.axes[0].legend(fontsize=6)
    figure.tight_layout()


def _measure(progress: Progress | None = None) -> Findings:
    return measured(FULL, progress)


def _quick(progress: Progress | None = None) -> Findings:
    return measured(SHORT, progress)


STUDY: Final = Survey(measure=_measure, quick=_quick)
"""Closed forms against iteration, by Pinocchio's forward kinematics."""
