"""Joint limits and the arm angle: where all joints are within them, and a solution that is.

Each joint of the inverse is atan2 of (or, the middle ones, arccos of) terms n·(cos ψ, sin ψ, 1), so
that it stands at a limit where one such term is zero: two arm angles at most. All of them, over all
joints, cut the circle of arm angles into pieces within which no joint passes a limit, and one point
of each piece tells for the whole. No piece is missed, however narrow; the cuts are tried too, for
poses that only a joint at its limit reaches. With the elbow stretched a pose determines θ4, and
with it the others, to 1e-8 only: a joint so little beyond its limit is put there, and the rest
settled by least squares. Solving is deterministic.
"""

from math import atan2, cos, hypot, pi, sin, sqrt
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.arm.mechanics import kernels
from app.arm.mechanics.kernels import (
    SHOULDER,
    WRIST,
    Nine,
    Three,
    direction_kernel,
    elbow_kernel,
    seen_from_reach,
    shoulder_matrix,
    split_kernel,
    wrapped,
    wrist_matrix,
)
from app.arm.mechanics.kinematics import (
    ArmBranch,
    ArmSolution,
    in_words,
    pose_arrays,
    seven,
    solution,
)
from app.arm.mechanics.least_squares import CLOSED, WORK, iterate_kernel
from app.arm.mechanics.profile import JOINTS, ROOM_FOR_ROUNDING, ArmProfile
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.mechanisms.errors import MechanismError
from app.mechanisms.status import NOT_FINITE, OK, check

CUTS: Final = 24
"""Most arm angles at which a joint stands at a limit: six joints, two limits, two roots."""

SCAN: Final = 32
"""Arm angles tried where no piece has a solution: aligned axes leave a joint free, without cuts."""

TOLD: Final = 6
"""Numbers that `solve_kernel` tells beside joint angles."""

SCRATCH: Final = CUTS + JOINTS + WORK[0] * WORK[1]
"""Length of the kernel's scratch."""

_UNSETTLED: Final = 1e-6
"""A joint less beyond its limit than this may be there because of rounding [rad]."""

_Elbow = tuple[float, float, float, float, float, float, float, float]
"""(θ4, sin φ, cos φ, sin β, cos β, sin ψp, cos ψp, θref) of a pose and a sign of θ4; β = θ4 - φ."""


class JointLimitError(MechanismError):
    """No arm angle of any branch reaches the pose with all joints within their limits."""


@njit
def _cut(cuts: FloatArray, count: int, c: float, s: float, value: float) -> int:
    # Roots of c cos ψ + s sin ψ + one = 0; of a double root what rounding leaves.
    size = hypot(c, s)
    if abs(value) > size * (1.0 + 1e-12) or size <= 1e-15:
        return count
    ratio = max(-1.0, min(1.0, -value / size))
    half, middle = atan2(sqrt((1.0 - ratio) * (1.0 + ratio)), ratio), atan2(s, c)
    cuts[count], cuts[count + 1] = wrapped(middle - half), wrapped(middle + half)
    return count + 2


@njit
def _cut_turn(cuts: FloatArray, count: int, n: Three, d: Three, lower: float, upper: float) -> int:
    # atan2(N, D) at a limit L, or half a turn from it: N cos L = D sin L.
    for limit in (lower, upper):
        c, s = cos(limit), sin(limit)
        count = _cut(cuts, count, n[0] * c - d[0] * s, n[1] * c - d[1] * s, n[2] * c - d[2] * s)
    return count


@njit
def _cut_lean(cuts: FloatArray, count: int, n: Three, lower: float, upper: float) -> int:
    # arccos(N) at a limit of either sign.
    for limit in (lower, upper):
        count = _cut(cuts, count, n[0], n[1], n[2] - cos(limit))
    return count


@njit
def cuts_kernel(e: _Elbow, m: Nine, lower: FloatArray, upper: FloatArray, cuts: FloatArray) -> int:
    """Fill the arm angles at which a joint stands at a limit, ascending; return how many.

    `m` is the hand in the frame of shoulder and wrist, Bᵀ R.
    """
    _, sf, cf, sb, cb, sp, cp, ref = e
    n1, d1 = (0.0, sf, 0.0), (cp * sf, 0.0, sp * cf)
    count = _cut_turn(cuts, 0, n1, d1, lower[0] - ref, upper[0] - ref)
    count = _cut_lean(cuts, count, (-sp * sf, 0.0, cp * cf), lower[1], upper[1])
    n3, d3 = (0.0, sp, 0.0), (sp * cf, 0.0, cp * sf)
    count = _cut_turn(cuts, count, n3, d3, lower[2], upper[2])
    n5, d5 = (m[5], -m[2], 0.0), (cb * m[2], cb * m[5], sb * m[8])
    count = _cut_turn(cuts, count, n5, d5, lower[4], upper[4])
    count = _cut_lean(cuts, count, (-sb * m[2], -sb * m[5], cb * m[8]), lower[5], upper[5])
    n7, d7 = (-sb * m[1], -sb * m[4], cb * m[7]), (sb * m[0], sb * m[3], -cb * m[6])
    count = _cut_turn(cuts, count, n7, d7, lower[6], upper[6])
    for i in range(1, count):
        value, j = cuts[i], i
        while j > 0 and cuts[j - 1] > value:
            cuts[j] = cuts[j - 1]
            j -= 1
        cuts[j] = value
    return count


@njit
def elbowed(
    position: FloatArray, lengths: Three, sign: float, keep: float
) -> tuple[int, _Elbow, float, float, int]:
    """Elbow of a pose: (status, elbow, cos θref, sin θref, singular)."""
    reach, sp, cp, cr, sr, bits = direction_kernel(position, lengths[0], keep)
    status, theta, sf, cf, flag = elbow_kernel(reach, lengths, sign)
    c, s = cos(theta), sin(theta)
    e = (theta, sf, cf, s * cf - c * sf, c * cf + s * sf, sp, cp, atan2(sr, cr))
    return status, e, cr, sr, bits | flag


@njit
def _share(
    q: FloatArray, a: int, c: int, keep: float, lower: FloatArray, upper: FloatArray
) -> None:
    # Only a + c is defined: what is kept of a, changed as little as brings both within limits.
    for turns in (0.0, 2.0 * pi, -2.0 * pi):
        total = q[a] + q[c] + turns
        least, most = max(lower[a], total - upper[c]), min(upper[a], total - lower[c])
        if least <= most:
            q[a] = max(least, min(most, keep))
            q[c] = total - q[a]
            return


@njit
def _posture(e: _Elbow, m: Nine, angle: float, keep: tuple[float, float], q: FloatArray) -> int:
    # Joint angles with θ2, θ6 ≥ 0; returns what is singular.
    c, s = cos(angle), sin(angle)
    theta4, sf, cf, sb, cb, sp, cp, ref = e
    shoulder = shoulder_matrix(sp, cp, sf, cf, c, s)
    a, q[1], q[2], upright = split_kernel(shoulder, 1.0, keep[0] - ref)
    q[0], q[3] = wrapped(ref + a), theta4
    q[4], q[5], q[6], straight = split_kernel(wrist_matrix(m, sb, cb, c, s), 1.0, keep[1])
    return (SHOULDER if upright else 0) | (WRIST if straight else 0)


@njit
def _mirrored(q: FloatArray, a: int) -> None:
    # The other solution of Rz(a) Ry(b) Rz(c).
    q[a], q[a + 2] = wrapped(q[a] + pi), wrapped(q[a + 2] + pi)
    q[a + 1] = -q[a + 1]


@njit
def _beyond(q: FloatArray, lower: FloatArray, upper: FloatArray) -> tuple[float, int]:
    # Margin of the joint that is nearest to a limit, or furthest beyond it, and which that is.
    margin, joint = 1e9, 0
    for k in range(JOINTS):
        room = min(upper[k] - q[k], q[k] - lower[k])
        if room < margin:
            margin, joint = room, k
    return margin, joint


@njit
def _try(
    e: _Elbow,
    m: Nine,
    angle: float,
    near: FloatArray,
    close: bool,
    lower: FloatArray,
    upper: FloatArray,
    bits: int,
    trial: FloatArray,
    best: FloatArray,
    answer: FloatArray,
) -> None:
    # All four solutions at an arm angle against the best so far.
    singular = _posture(e, m, angle, (near[0], near[4]), trial)
    for turn in range(4):
        if turn:
            _mirrored(trial, 4)
        if turn == 2:
            _mirrored(trial, 0)
        if singular & SHOULDER:
            _share(trial, 0, 2, near[0], lower, upper)
        if singular & WRIST:
            _share(trial, 4, 6, near[4], lower, upper)
        margin, joint = _beyond(trial, lower, upper)
        within = margin >= -ROOM_FOR_ROUNDING
        score = margin
        if within and close:
            score = 0.0
            for k in range(JOINTS):
                score = min(score, -abs(trial[k] - near[k]))
        better = score > answer[1] if within == (answer[2] > 0.0) else within
        if better:
            answer[0], answer[1], answer[2] = angle, score, 1.0 if within else 0.0
            answer[3], answer[4], answer[5] = margin, float(joint), float(bits | singular)
            for k in range(JOINTS):
                best[k] = trial[k]


@njit
def _search(
    rotation: FloatArray,
    position: FloatArray,
    lengths: Three,
    lower: FloatArray,
    upper: FloatArray,
    near: FloatArray,
    close: bool,
    effort: int,
    work: FloatArray,
    best: FloatArray,
    answer: FloatArray,
) -> int:
    # Effort 0: the middles of all pieces; 1: their ends too; 2: a scan, for joints without cuts.
    # Nearness (`close`) asks for the ends, and for the arm angle of `near`, at once.
    cuts, trial = work[:CUTS], work[CUTS : CUTS + JOINTS]
    for sign in (1.0, -1.0):
        status, e, cr, sr, bits = elbowed(position, lengths, sign, near[0])
        if status != OK:
            return status
        m = seen_from_reach(rotation, e[5], e[6], cr, sr)
        if not isfinite_matrix(m):
            return NOT_FINITE
        if effort == 2:
            for i in range(SCAN):
                angle = wrapped(2.0 * pi * i / SCAN)
                _try(e, m, angle, near, close, lower, upper, bits, trial, best, answer)
            continue
        count = cuts_kernel(e, m, lower, upper, cuts)
        for i in range(max(count, 1)):
            middle = 0.0
            if count:
                following = cuts[i + 1] if i + 1 < count else cuts[0] + 2.0 * pi
                middle = wrapped(0.5 * (cuts[i] + following))
                if close or effort == 1:
                    _try(e, m, cuts[i], near, close, lower, upper, bits, trial, best, answer)
            if effort == 0:
                _try(e, m, middle, near, close, lower, upper, bits, trial, best, answer)
        if close:
            # the elbow plane as it was: its arm angle jumps where its zero does, on the first axis
            wanted = kernels.angle_of_normal(kernels.normal_kernel(near), e[5], e[6], cr, sr)
            _try(e, m, wanted, near, close, lower, upper, bits, trial, best, answer)
    return OK


@njit
def _approach(
    rotation: FloatArray,
    position: FloatArray,
    lengths: Three,
    lower: FloatArray,
    upper: FloatArray,
    near: FloatArray,
    work: FloatArray,
    best: FloatArray,
    answer: FloatArray,
) -> None:
    # From the nearest solution so far along the arm angle to one that is nearer still.
    trial = work[CUTS : CUTS + JOINTS]
    sign = 1.0 if best[3] >= 0.0 else -1.0
    _, e, cr, sr, bits = elbowed(position, lengths, sign, near[0])
    m = seen_from_reach(rotation, e[5], e[6], cr, sr)
    step = 0.1
    while step > 1e-7:
        before = answer[1]
        for side in (step, -step):
            angle = wrapped(answer[0] + side)
            _try(e, m, angle, near, True, lower, upper, bits, trial, best, answer)
        if answer[1] <= before:
            step *= 0.5


@njit
def _settle(
    rotation: FloatArray,
    position: FloatArray,
    lengths: Three,
    lower: FloatArray,
    upper: FloatArray,
    near: FloatArray,
    work: FloatArray,
    best: FloatArray,
    answer: FloatArray,
) -> None:
    # A joint is beyond its limit by no more than rounding may have put it: put it there, and let
    # least squares move the others.
    trial, room = work[CUTS : CUTS + JOINTS], work[CUTS + JOINTS :].reshape(WORK)
    keep = near[0], near[4]
    for i in range(SCAN * 8):
        angle = wrapped(2.0 * pi * (i // 8) / SCAN)
        branch = 1.0 - 2.0 * (i % 2), 1.0 - 2.0 * (i // 2 % 2), 1.0 - 2.0 * (i // 4 % 2)
        kernels.redundant_kernel(rotation, position, lengths, angle, branch, keep, trial)
        if _beyond(trial, lower, upper)[0] < -_UNSETTLED:
            continue
        left, _ = iterate_kernel(rotation, position, lengths, lower, upper, 50, trial, room)
        if left <= CLOSED:
            for k in range(JOINTS):
                best[k] = trial[k]
            answer[0], _ = kernels.arm_angle_kernel(best, lengths, near[0])
            answer[2] = 1.0
            return


@njit
def solve_kernel(
    rotation: FloatArray,
    position: FloatArray,
    lengths: Three,
    lower: FloatArray,
    upper: FloatArray,
    near: FloatArray,
    close: bool,
    work: FloatArray,
    best: FloatArray,
    answer: FloatArray,
) -> int:
    """Joint angles within limits for a pose, over all arm angles and branches: the status.

    Args:
        rotation: of the pose ⁰T₇, (3, 3).
        position: of the pose ⁰T₇, (3,) [m].
        lengths: d1, d3, d5.
        lower: joint limits, (7,).
        upper: joint limits, (7,).
        near: joint angles that tell what is kept of θ1 and θ5 where they are not defined.
        close: whether the solution nearest to `near` (in its largest joint) is sought; else the
            one whose least margin to a limit is largest.
        work: scratch, (SCRATCH,).
        best: filled with the joint angles (7,); beyond limits if none are within.
        answer: filled with (arm angle, score, whether within limits, margin [rad], its joint,
            singular).
    """
    answer[0], answer[1], answer[2] = 0.0, -1e9, 0.0
    for effort in range(3):
        status = _search(
            rotation, position, lengths, lower, upper, near, close, effort, work, best, answer
        )
        if status != OK:
            return status
        if answer[2] > 0.0:
            if close:
                _approach(rotation, position, lengths, lower, upper, near, work, best, answer)
            for k in range(JOINTS):
                best[k] = max(lower[k], min(upper[k], best[k]))
            return OK
    if answer[3] > -_UNSETTLED:
        _settle(rotation, position, lengths, lower, upper, near, work, best, answer)
    return OK


@njit
def isfinite_matrix(m: Nine) -> bool:
    """Return whether no entry is NaN or infinite."""
    total = 0.0
    for value in m:
        total += abs(value)
    return total < 1e300


def solve(arm: ArmProfile, pose: RigidTransform, near: ArrayLike | None = None) -> ArmSolution:
    """Joint angles within the limits for a pose ⁰T₇, wherever there are any.

    Args:
        arm: its lengths and limits.
        pose: ⁰T₇ (`ArmProfile.wrist_pose` of a tool's pose).
        near: joint angles [rad], shape (7,), to which the solution shall be near (the largest
            change of a joint counts): the nearest of those with the same elbow plane and of the
            middles and ends of all pieces, and from there along the arm angle to one that is
            nearer still. Without it the one furthest from its joints' limits is taken, of those in
            the middle of their pieces.

    Raises:
        UnreachableError: if the wrist centre is too far from the shoulder, or too near, for the
            links.
        JointLimitError: if the links reach it, but only with a joint beyond its limits: says which,
            and by how much at the best arm angle tried.
        MechanismError: as `inverse`.
    """
    rotation, position = pose_arrays(pose)
    start = np.zeros(JOINTS) if near is None else seven(near, "near")
    work, best, told = np.empty(SCRATCH), np.empty(JOINTS), np.zeros(TOLD)
    status = solve_kernel(
        rotation,
        position,
        arm.lengths,
        arm.lower,
        arm.upper,
        start,
        near is not None,
        work,
        best,
        told,
    )
    check(status, in_words(arm, pose))
    angle, _, within, margin, joint, bits = told.tolist()
    if not within:
        raise JointLimitError(
            sentence(
                "joint {joint} would stand {margin_deg:.3g}° beyond its limits, at"
                " the best arm angle tried: {in_words}",
                joint=int(joint) + 1,
                margin_deg=np.degrees(-margin),
                in_words=in_words(arm, pose),
            )
        )
    return solution(arm, best, angle, int(bits))


def feasible(arm: ArmProfile, pose: RigidTransform, branch: ArmBranch) -> FloatArray:
    """Arm angles of a branch at which all joints are within their limits.

    Returns:
        Intervals (from, to) [rad], shape (n, 2), ascending; from in (-π, π], to up to 2π further.
        A single arm angle (a joint that only touches its limit) is an interval of no width.

    Raises:
        MechanismError: as `inverse`.
    """
    rotation, position = pose_arrays(pose)
    status, e, cr, sr, _ = elbowed(position, arm.lengths, float(branch.elbow), 0.0)
    check(status, in_words(arm, pose))
    room = np.empty(CUTS)
    m = seen_from_reach(rotation, e[5], e[6], cr, sr)
    cuts = room[: cuts_kernel(e, m, arm.lower, arm.upper, room)]

    def within(angle: float) -> bool:
        q = np.empty(JOINTS)
        kernels.redundant_kernel(
            rotation, position, arm.lengths, angle, branch.signs, (0.0, 0.0), q
        )
        return bool((arm.beyond(q) <= ROOM_FOR_ROUNDING).all())

    if not len(cuts):
        return np.array([[-np.pi, np.pi]]) if within(0.0) else np.empty((0, 2))
    following = np.append(cuts[1:], cuts[0] + 2.0 * np.pi)
    pieces = [
        (float(a), float(b))
        for a, b in zip(cuts, following, strict=True)
        if within(0.5 * (a + b)) or (within(a) and a == b)
    ]
    touching = [(float(a), float(a)) for a in cuts if within(a)]
    return _joined(sorted(pieces + touching))


def _joined(intervals: list[tuple[float, float]]) -> FloatArray:
    """Intervals on the circle, those that meet made one."""
    found: list[list[float]] = []
    for low, high in intervals:
        if found and low <= found[-1][1]:
            found[-1][1] = max(found[-1][1], high)
        else:
            found.append([low, high])
    if len(found) > 1 and found[-1][1] >= found[0][0] + 2.0 * np.pi:
        low, high = found.pop(0)
        found[-1][1] = max(found[-1][1], high + 2.0 * np.pi)
    return np.array(found).reshape(-1, 2)
